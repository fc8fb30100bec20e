//! Distribution of the redundant constraints among the contours, exactly, or by singular values for measured geometry.

use crate::closure::Closure;
use crate::closure::contour::Contour;
use crate::geom::Reals;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::rank::numeric::scaling::{Scaling, scaled_matrix};
use crate::redundancy::stress::stress_basis;
use ozols_dense::{Matrix, singular_values, svd};

/// Redundant constraints of one contour.
#[derive(Debug, Clone)]
pub struct ContourShare {
    /// The contour.
    pub contour: Contour,
    /// σ_i when contours are added in the order reported.
    pub redundant: usize,
    /// Smallest and largest σ_i over all orders of the given contours.
    pub range: (usize, usize),
    /// The largest σ_i over all bases of contours that include this one, as a value reached and an upper bound. The
    /// smallest is that of `range`.
    pub over_bases: (usize, usize),
}

/// Whether a coupling is a redundant constraint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CouplingShare {
    /// Names of the two freedoms, as the file writes them.
    pub name: String,
    /// 1 if the contours and earlier couplings already imply it, otherwise 0.
    pub redundant: usize,
    /// 1 if all other constraints imply it, otherwise 0: the maximum over all orders. On its own it is never redundant.
    pub most: usize,
}

/// Returns the shares of the couplings, which come after all contours.
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

/// Returns σ_i of each contour in the order of the basis, and its range over all orders.
///
/// Adding a contour to more contours never adds more rank, because rank is submodular. So σ_i is smallest if the
/// contour is added first and largest if it is added last, and no order has to be tried. All of it follows from one
/// basis of the self-stresses, the left kernel of J:
/// - Those within the first i contours are the left kernel of the first i contours' rows. So σ_i in the given order is
///   the number of vectors of an echelon basis that end in contour i.
/// - Those without contour i are the left kernel of the other rows. So the largest σ_i is the dimension of the basis
///   restricted to the rows of contour i.
/// - The smallest is the number of rows less the rank of the contour's own columns.
///
/// # Complexity
/// One elimination of J by rows, then O(σ·k) to examine the basis and an elimination of at most `dim` independent rows
/// per contour. By the definition it would be k + 2 eliminations of J.
///
/// # Examples
/// ```
/// use ozols::{closure::Closure, model::mechanism::StateId, rank::exact::field::field_of};
/// use ozols::redundancy::contour_shares::contour_shares;
/// let gripper = ozols::built_in("gripper-10")?;
/// let exact = field_of(&gripper, StateId::FREE, 0)?;
/// let shares = contour_shares(&exact, &Closure::new(&exact, &gripper, StateId::FREE)?);
/// assert_eq!(shares.iter().map(|s| s.redundant).sum::<usize>(), 11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn contour_shares(exact: &ExactField, closure: &Closure<Residue>) -> Vec<ContourShare> {
    let dim = closure.dim;
    let stresses = stress_basis(exact, closure);
    let mut ending = vec![0; closure.contours.len()];
    for s in &stresses {
        // A self-stress that ends in the row of a coupling belongs to the coupling.
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
    // Most self-stresses load few contours.
    let loaded = stresses.iter().map(|s| loaded_parts(s, dim).collect());
    let loaded: Vec<Vec<(usize, &[Residue])>> = loaded.collect();
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
                    let mixed = loaded.iter().map(|s| combine_parts(exact, s, weights, dim));
                    let mixed: Vec<Vec<Residue>> = mixed.collect();
                    ranks(&mut mixed.iter().map(Vec::as_slice))
                }),
            }
        })
        .collect()
}

/// Returns the loops that a self-stress loads, with its entries in their rows.
fn loaded_parts(stress: &[Residue], dim: usize) -> impl Iterator<Item = (usize, &[Residue])> {
    let parts = stress.chunks(dim).enumerate();
    parts.filter(|(_, part)| part.iter().any(|&x| x != 0))
}

/// Returns the parts of a self-stress in the loops' rows, times these weights and summed.
fn combine_parts(
    exact: &ExactField,
    stress: &[(usize, &[Residue])],
    weights: &[i64],
    dim: usize,
) -> Vec<Residue> {
    let field = exact.field();
    let mut sum = vec![0; dim];
    // Rows of couplings come after those of contours.
    for &(contour, part) in stress.iter().filter(|(c, _)| *c < weights.len()) {
        field.add_multiple(&mut sum, field.from_i64(weights[contour]), part);
    }
    sum
}

/// Returns the largest σ_i of a contour over all bases that include it, as a value reached and an upper bound.
/// `greatest` is that of the given basis. `carried` returns the dimension of the self-stresses in a combination of the
/// contours' rows.
///
/// In another basis with contour i, the rows of i hold a sum over the contours j. Each term is the part of the
/// self-stress in the rows of j, times the coefficient of i in j. A joint of i gives such coefficients: 1, -1 or 0 if
/// contour j passes it in the same direction, in the other, or not at all. They belong to the bases whose other
/// contours do not contain the joint, and σ_i there is the dimension of its loads. Any coefficients, here random ones,
/// give at least the value of every basis.
///
/// # Complexity
/// At most one call for each joint of the contour, and one more.
pub(crate) fn over_bases(
    contours: &[Contour],
    i: usize,
    greatest: usize,
    carried: impl Fn(&[i64]) -> usize,
) -> (usize, usize) {
    let any: Vec<i64> = (0..contours.len())
        .map(|j| if j == i { 1 } else { scattered_number(j) })
        .collect();
    let most = carried(&any).max(greatest);
    let mut reached = greatest;
    let mut asked: Vec<Vec<i64>> = Vec::new();
    for &(joint, forward) in &contours[i].joints {
        if reached == most {
            break;
        }
        let passes = |c: &Contour| {
            c.direction_of(joint)
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

/// Returns numbers unrelated to the geometry, of either sign and up to about a thousand.
fn scattered_number(n: usize) -> i64 {
    let mixed = (n as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    i64::try_from(mixed >> 53).unwrap_or(1) - 1023
}

/// Ranks and motions of one J at one relative tolerance.
#[derive(Debug)]
pub struct Measured<'a> {
    mechanism: &'a Mechanism,
    closure: Closure<f64>,
    /// The scaled J.
    matrix: Matrix,
    /// Limit at or below which singular values count as zero.
    floor: f64,
    /// Motions: columns of an orthonormal basis of the null space.
    kernel: Matrix,
}

impl<'a> Measured<'a> {
    /// Decomposes J of a state and its null space at a relative tolerance.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value.
    ///
    /// # Complexity
    /// One decomposition, O(6k · f · min(6k, f)).
    pub fn new(
        mechanism: &'a Mechanism,
        state: StateId,
        tolerance: f64,
    ) -> Result<Self, ExactError> {
        let closure = Closure::new(&Reals, mechanism, state)?;
        let matrix = scaled_matrix(&closure);
        let f = closure.columns.len();
        let (mut floor, mut kernel) = (0.0, Matrix::identity(f, f));
        if let Some(svd) = svd(&matrix) {
            floor = tolerance * svd.values.first().copied().unwrap_or(0.0);
            kernel = svd.null_space(svd.rank(tolerance));
        }
        Ok(Measured {
            mechanism,
            closure,
            matrix,
            floor,
            kernel,
        })
    }

    /// Returns W at the pose.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, redundancy::contour_shares::Measured};
    /// let gripper = ozols::built_in("gripper-10")?;
    /// assert_eq!(Measured::new(&gripper, StateId::FREE, 1e-9)?.mobility(), 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn mobility(&self) -> usize {
        self.kernel.ncols()
    }

    fn rank_of(&self, matrix: &Matrix) -> usize {
        singular_values(matrix)
            .unwrap_or_default()
            .iter()
            .filter(|&&v| v > self.floor)
            .count()
    }

    /// Returns the dimension of the joint motion of some links.
    #[must_use]
    pub(crate) fn span_of_links(&self, links: &[LinkId]) -> usize {
        let scaling = Scaling::of_closure(&self.closure);
        let twists: Vec<Vec<Vec<f64>>> = links
            .iter()
            .map(|&l| {
                let path = self.closure.link_motion(&Reals, self.mechanism, l);
                path.iter()
                    .enumerate()
                    .map(|(c, t)| scaling.scale_column(c, t))
                    .collect()
            })
            .collect();
        let dim = self.closure.dim;
        let motion = Matrix::from_fn(dim * links.len(), self.closure.columns.len(), |r, c| {
            twists[r / dim][c][r % dim]
        });
        self.rank_of(&motion.times(&self.kernel))
    }

    /// Returns the dimension of the motions restricted to some joints.
    #[must_use]
    pub(crate) fn span_of_joints(&self, joints: &[JointId]) -> usize {
        let columns: Vec<usize> = (0..self.closure.columns.len())
            .filter(|&c| joints.contains(&self.closure.columns[c].joint))
            .collect();
        self.rank_of(&self.kernel.select_rows(&columns))
    }

    /// Returns the rank of the rows of some contours and couplings.
    fn rank_of_rows(&self, contours: &[usize], couplings: &[usize]) -> usize {
        let (dim, first) = (self.closure.dim, self.closure.contour_rows());
        let of_contours = contours.iter().flat_map(|k| dim * k..dim * (k + 1));
        let rows: Vec<usize> = of_contours
            .chain(couplings.iter().map(|q| first + q))
            .collect();
        self.rank_of(&self.matrix.select_rows(&rows))
    }

    /// Returns the rank of the rows of all couplings and of contours j less a multiple of contour i. These rows are the
    /// remainder of J in a basis in which contour i has these coefficients in the given contours.
    fn rank_without(&self, i: usize, weights: &[i64]) -> usize {
        let dim = self.closure.dim;
        let first = self.closure.contour_rows();
        let others: Vec<usize> = (0..self.matrix.nrows())
            .filter(|&r| r >= first || r / dim != i)
            .collect();
        let part = Matrix::from_fn(others.len(), self.matrix.ncols(), |r, c| {
            let row = others[r];
            let own = self.matrix[(row, c)];
            match weights.get(row / dim).filter(|_| row < first) {
                // Rows of similar size keep zeros below the floor.
                Some(&w) => {
                    let w = w as f64;
                    (own - w * self.matrix[(dim * i + row % dim, c)]) / w.abs().max(1.0)
                }
                None => own,
            }
        });
        self.rank_of(&part)
    }

    /// Returns σ_i of each contour in the order of the basis, and its range over all orders.
    ///
    /// # Complexity
    /// 3k decompositions.
    #[must_use]
    pub fn contour_shares(&self) -> Vec<ContourShare> {
        let dim = self.closure.dim;
        let all: Vec<usize> = (0..self.closure.contours.len()).collect();
        let couplings: Vec<usize> = (0..self.closure.couplings.len()).collect();
        let prefix: Vec<usize> = (0..=all.len())
            .map(|i| self.rank_of_rows(&all[..i], &[]))
            .collect();
        let whole = self.rank_of_rows(&all, &couplings);
        all.iter()
            .map(|&i| {
                let others: Vec<usize> = all.iter().copied().filter(|&j| j != i).collect();
                let greatest = dim + self.rank_of_rows(&others, &couplings) - whole;
                ContourShare {
                    contour: self.closure.contours[i].clone(),
                    redundant: dim + prefix[i] - prefix[i + 1],
                    range: (dim - self.rank_of_rows(&[i], &[]), greatest),
                    over_bases: over_bases(&self.closure.contours, i, greatest, |weights| {
                        (dim + self.rank_without(i, weights)).saturating_sub(whole)
                    }),
                }
            })
            .collect()
    }

    /// Returns the shares of the couplings, which come after the contours.
    ///
    /// # Complexity
    /// 2c + 1 decompositions.
    #[must_use]
    pub(crate) fn coupling_shares(&self) -> Vec<CouplingShare> {
        let all: Vec<usize> = (0..self.closure.contours.len()).collect();
        let couplings: Vec<usize> = (0..self.closure.couplings.len()).collect();
        let whole = self.rank_of_rows(&all, &couplings);
        let of_state = self.mechanism.couplings_in(self.closure.state);
        of_state
            .enumerate()
            .map(|(q, coupling)| {
                let others: Vec<usize> = couplings.iter().copied().filter(|&x| x != q).collect();
                let before = self.rank_of_rows(&all, &couplings[..q]);
                let with = self.rank_of_rows(&all, &couplings[..=q]);
                CouplingShare {
                    name: coupling.name(self.mechanism),
                    redundant: usize::from(with == before),
                    most: usize::from(self.rank_of_rows(&all, &others) == whole),
                }
            })
            .collect()
    }
}
