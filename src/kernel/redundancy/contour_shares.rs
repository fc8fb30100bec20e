//! How the redundant constraints are shared out among the contours.

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::geom::exact::ExactField;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::Mechanism;
use crate::redundancy::stress::stress_basis;

/// Redundant constraints of one contour.
#[derive(Debug, Clone)]
pub struct ContourShare {
    /// The contour.
    pub contour: Contour,
    /// σ_i when contours are added in the order reported.
    pub redundant: usize,
    /// Least and greatest σ_i over all orders of the contours given.
    pub range: (usize, usize),
    /// The greatest σ_i over all bases of contours that this one is part of: what some basis reaches, and what none exceeds.
    /// The least is that of `range`.
    pub over_bases: (usize, usize),
}

/// The redundant constraint that a coupling is, or not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CouplingShare {
    /// Names of the two freedoms, as the file writes them.
    pub name: String,
    /// 1 where the contours and the couplings before it imply it already, else 0.
    pub redundant: usize,
    /// 1 where all else implies it, else 0: the greatest over all orders. Alone it never is redundant.
    pub most: usize,
}

/// Shares of the couplings, which come after all contours.
///
/// # Complexity
/// As [`shares`].
#[must_use]
pub(crate) fn coupling_shares(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Vec<CouplingShare> {
    if closure.couplings.is_empty() {
        return Vec::new();
    }
    let stresses = stress_basis(exact, closure);
    mechanism
        .couplings_in(closure.state)
        .zip(closure.contour_rows()..)
        .map(|(coupling, row)| {
            let ends = |s: &&Vec<Residue>| s.iter().rposition(|&x| x != 0) == Some(row);
            CouplingShare {
                name: coupling.name(mechanism),
                redundant: stresses.iter().filter(ends).count(),
                most: usize::from(stresses.iter().any(|s| s[row] != 0)),
            }
        })
        .collect()
}

/// σ_i of each contour in the order of the basis, and its range over all orders.
///
/// Adding a contour to more contours never adds more rank (rank is submodular), so σ_i is least when the contour is
/// added first and greatest when it is added last: no order need be tried. And all of it can be read off one basis of
/// the self-stresses, the left kernel of J:
/// - those within the first i contours are the left kernel of the first i contours' rows, so σ_i in the order given is
///   the number of vectors of an echelon basis that end in contour i;
/// - those without contour i are the left kernel of the other rows, so the greatest σ_i is the dimension of what the
///   basis has in the rows of contour i;
/// - the least is the number of rows less the rank of the contour's own columns.
///
/// # Complexity
/// One elimination of J by rows, then O(σ·k) to look at the basis and an elimination of at most `dim` independent rows
/// per contour; k + 2 eliminations of J by the definition.
#[must_use]
pub fn shares(exact: &ExactField, closure: &Closure<Residue>) -> Vec<ContourShare> {
    let dim = closure.dim;
    let stresses = stress_basis(exact, closure);
    let mut ending = vec![0; closure.contours.len()];
    for s in &stresses {
        // Those that end in the row of a coupling are the coupling's.
        let last = s.iter().rposition(|&x| x != 0);
        if let Some(of) = last.and_then(|last| ending.get_mut(last / dim)) {
            *of += 1;
        }
    }
    let ranks = |vectors: &mut dyn Iterator<Item = &[Residue]>| {
        let mut span = Echelon::new(exact.field());
        while span.rank() < dim {
            let Some(v) = vectors.next() else { break };
            if v.iter().any(|&x| x != 0) {
                span.insert(v);
            }
        }
        span.rank()
    };
    // Columns are grouped by joint, in file order.
    let of_joint = |j| {
        let from = closure.columns.partition_point(|c| c.joint < j);
        closure.columns[from..]
            .iter()
            .take_while(move |c| c.joint == j)
    };
    closure
        .contours
        .iter()
        .enumerate()
        .map(|(i, contour)| {
            let mut own = contour
                .joints
                .iter()
                .flat_map(|&(j, _)| of_joint(j))
                .map(|c| c.twist.as_slice());
            let mut carried = stresses.iter().map(|s| &s[i * dim..(i + 1) * dim]);
            let greatest = ranks(&mut carried);
            ContourShare {
                contour: contour.clone(),
                redundant: ending[i],
                range: (dim - ranks(&mut own), greatest),
                over_bases: over_bases(&closure.contours, i, greatest, |weights| {
                    let mixed = stresses.iter().map(|s| combined(exact, s, weights, dim));
                    let mixed: Vec<Vec<Residue>> = mixed.collect();
                    ranks(&mut mixed.iter().map(Vec::as_slice))
                }),
            }
        })
        .collect()
}

/// What a self-stress has in the contours' rows, times these weights and summed.
fn combined(exact: &ExactField, stress: &[Residue], weights: &[i64], dim: usize) -> Vec<Residue> {
    let field = exact.field();
    let mut sum = vec![0; dim];
    for (&w, part) in weights.iter().zip(stress.chunks(dim)) {
        let w = field.from_i64(w);
        for (x, &y) in sum.iter_mut().zip(part) {
            *x = field.add(*x, field.mul(w, y));
        }
    }
    sum
}

/// The greatest σ_i of a contour over all bases that it is part of: what one reaches, and what none exceeds. `greatest` is that
/// of the basis given, and `carried` the dimension of what self-stresses have in a combination of the contours' rows.
///
/// In another basis with contour i, a self-stress has in the rows of i the sum of what it has in those of contour j times the
/// coefficient of i in j. A joint of i gives such coefficients, 1, -1 or 0 as contour j passes it the same way, the other or
/// not at all: those of the bases whose other contours leave it out, where σ_i is what the joint bears. Any coefficients at
/// all, here random ones, give no less than those of any basis.
///
/// # Complexity
/// At most one question for each joint of the contour, and one more.
pub(crate) fn over_bases(
    contours: &[Contour],
    i: usize,
    greatest: usize,
    carried: impl Fn(&[i64]) -> usize,
) -> (usize, usize) {
    let any: Vec<i64> = (0..contours.len())
        .map(|j| if j == i { 1 } else { scattered(j) })
        .collect();
    let most = carried(&any).max(greatest);
    let mut reached = greatest;
    let mut asked: Vec<Vec<i64>> = Vec::new();
    for &(joint, forward) in &contours[i].joints {
        if reached == most {
            break;
        }
        let passes = |c: &Contour| {
            c.direction(joint)
                .map_or(0, |d| if d == forward { 1 } else { -1 })
        };
        let weights: Vec<i64> = contours.iter().map(passes).collect();
        if !asked.contains(&weights) {
            reached = reached.max(carried(&weights));
            asked.push(weights);
        }
    }
    (reached, most.max(reached))
}

/// Numbers that no geometry knows, of either sign and at most some thousand.
fn scattered(n: usize) -> i64 {
    let mixed = (n as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    i64::try_from(mixed >> 53).unwrap_or(1) - 1023
}
