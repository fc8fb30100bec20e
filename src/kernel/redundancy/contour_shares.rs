//! Distribution of the redundant constraints among the contours, exactly, or by singular values for measured geometry.
//!
//! Adding a contour to more contours never adds more rank, because rank is submodular. So σ_i is smallest if the
//! contour is added first and largest if it is added last, and no order has to be tried. All of it follows from one
//! basis of the self-stresses, the left kernel of J:
//! - Those within the first i contours are the left kernel of the first i contours' rows. So σ_i in the given order is
//!   the number of self-stresses within the first i contours less those within the first i - 1.
//! - Those without contour i are the left kernel of the other rows. So the largest σ_i is the dimension of the basis
//!   restricted to the rows of contour i.
//! - The smallest is the number of rows less the rank of the contour's own columns.

use crate::closure::contour::Contour;
use crate::closure::{Closure, Column};
use crate::geom::Reals;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::joint_type::Coupling;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::rank::numeric::scaling::{Scaling, scaled_matrix};
use crate::redundancy::stress::stress_basis;
use ozols_dense::{Matrix, norm, singular_values, svd};

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

/// The self-stresses of a J, in some numbers.
trait Stresses {
    /// Returns the number of independent self-stresses that load only the first rows.
    fn count_within(&self, rows: usize) -> usize;

    /// Returns the dimension of the loads in the rows of the contours, times these weights and summed.
    fn count_carried(&self, weights: &[i64]) -> usize;

    /// Returns true if a self-stress loads a row.
    fn loads_row(&self, row: usize) -> bool;

    /// Returns the rank of the rows of a contour.
    fn rank_alone(&self, contour: usize) -> usize;
}

/// Returns σ_i of each contour in the order of the basis, and its range over all orders.
fn shares_of(stresses: &impl Stresses, contours: &[Contour], dim: usize) -> Vec<ContourShare> {
    let share = |(i, contour): (usize, &Contour)| {
        let mut own = vec![0; contours.len()];
        own[i] = 1;
        let greatest = stresses.count_carried(&own);
        ContourShare {
            contour: contour.clone(),
            redundant: stresses.count_within(dim * (i + 1)) - stresses.count_within(dim * i),
            range: (dim - stresses.rank_alone(i), greatest),
            over_bases: over_bases(contours, i, greatest, |w| stresses.count_carried(w)),
        }
    };
    contours.iter().enumerate().map(share).collect()
}

/// Returns the shares of the couplings, which come after all contours.
fn coupling_shares_of<N>(
    stresses: &impl Stresses,
    mechanism: &Mechanism,
    closure: &Closure<N>,
) -> Vec<CouplingShare> {
    let couplings = mechanism.couplings_in(closure.state);
    let rows = closure.dim * closure.contours.len()..;
    let share = |(coupling, row): (&Coupling, usize)| CouplingShare {
        name: coupling.name(mechanism),
        redundant: stresses.count_within(row + 1) - stresses.count_within(row),
        most: usize::from(stresses.loads_row(row)),
    };
    couplings.zip(rows).map(share).collect()
}

/// The self-stresses modulo a prime.
struct Exactly<'a> {
    exact: &'a ExactField,
    closure: &'a Closure<Residue>,
    basis: Vec<Vec<Residue>>,
}

impl<'a> Exactly<'a> {
    fn new(exact: &'a ExactField, closure: &'a Closure<Residue>) -> Exactly<'a> {
        Exactly {
            exact,
            closure,
            basis: stress_basis(exact, closure),
        }
    }

    fn rank_of<V: AsRef<[Residue]>>(&self, mut vectors: impl Iterator<Item = V>) -> usize {
        let mut span = Echelon::new(self.exact.field());
        while span.rank() < self.closure.dim {
            let Some(v) = vectors.next() else { break };
            if v.as_ref().iter().any(|&x| x != 0) {
                span.insert(v.as_ref());
            }
        }
        span.rank()
    }
}

impl Stresses for Exactly<'_> {
    fn count_within(&self, rows: usize) -> usize {
        // The vectors of the basis end in different rows.
        let within = |s: &&Vec<Residue>| s[rows..].iter().all(|&x| x == 0);
        self.basis.iter().filter(within).count()
    }

    fn count_carried(&self, weights: &[i64]) -> usize {
        let (field, dim) = (self.exact.field(), self.closure.dim);
        self.rank_of(self.basis.iter().map(|stress| {
            let mut sum = vec![0; dim];
            // Rows of couplings come after those of contours.
            for (part, &weight) in stress.chunks(dim).zip(weights) {
                if weight != 0 {
                    field.add_multiple(&mut sum, field.from_i64(weight), part);
                }
            }
            sum
        }))
    }

    fn loads_row(&self, row: usize) -> bool {
        self.basis.iter().any(|s| s[row] != 0)
    }

    fn rank_alone(&self, contour: usize) -> usize {
        let passes = |c: &&Column<Residue>| {
            let joints = &self.closure.contours[contour].joints;
            joints.iter().any(|&(j, _)| j == c.joint)
        };
        let own = self.closure.columns.iter().filter(passes);
        self.rank_of(own.map(|c| &c.twist))
    }
}

/// Returns the shares of the couplings, which come after all contours.
///
/// # Complexity
/// As [`contour_shares`].
#[must_use]
pub(crate) fn coupling_shares(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Vec<CouplingShare> {
    if closure.couplings.is_empty() {
        return Vec::new();
    }
    coupling_shares_of(&Exactly::new(exact, closure), mechanism, closure)
}

/// Returns σ_i of each contour in the order of the basis, and its range over all orders.
///
/// # Complexity
/// One elimination of J by rows. Then O(σ·k) to examine the basis and an elimination of at most `dim` independent rows
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
    let stresses = Exactly::new(exact, closure);
    shares_of(&stresses, &closure.contours, closure.dim)
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
    pub(super) closure: Closure<f64>,
    /// The scaled J.
    matrix: Matrix,
    /// Limit at or below which singular values count as zero.
    floor: f64,
    /// Motions: columns of an orthonormal basis of the null space.
    kernel: Matrix,
    /// Self-stresses: columns of an orthonormal basis of the left null space.
    stresses: Matrix,
    /// Loads at or below which a self-stress has none.
    unloaded: f64,
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
        let mut stresses = Matrix::identity(closure.rows(), closure.rows());
        if let Some(svd) = svd(&matrix) {
            floor = tolerance * svd.values.first().copied().unwrap_or(0.0);
            kernel = svd.null_space(svd.rank(tolerance));
            stresses = svd.left_null_space(svd.rank(tolerance));
        }
        Ok(Measured {
            mechanism,
            closure,
            matrix,
            floor,
            kernel,
            stresses,
            // Errors of the size of the tolerance turn the self-stresses by more.
            unloaded: tolerance.sqrt().clamp(1e-6, 0.1),
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
        count_above(matrix, self.floor)
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

    /// Returns σ_i of each contour in the order of the basis, and its range over all orders.
    ///
    /// # Complexity
    /// About 4k decompositions.
    #[must_use]
    pub fn contour_shares(&self) -> Vec<ContourShare> {
        shares_of(self, &self.closure.contours, self.closure.dim)
    }

    /// Returns the shares of the couplings, which come after the contours.
    ///
    /// # Complexity
    /// 2c decompositions.
    #[must_use]
    pub(crate) fn coupling_shares(&self) -> Vec<CouplingShare> {
        coupling_shares_of(self, self.mechanism, &self.closure)
    }
}

impl Stresses for Measured<'_> {
    fn count_within(&self, rows: usize) -> usize {
        let beyond: Vec<usize> = (rows..self.stresses.nrows()).collect();
        let beyond = self.stresses.select_rows(&beyond);
        self.stresses.ncols() - count_above(&beyond, self.unloaded)
    }

    fn count_carried(&self, weights: &[i64]) -> usize {
        let dim = self.closure.dim;
        let sum = Matrix::from_fn(dim, self.stresses.ncols(), |r, s| {
            let of = |(j, &w): (usize, &i64)| w as f64 * self.stresses[(dim * j + r, s)];
            weights.iter().enumerate().map(of).sum()
        });
        count_above(&sum, self.unloaded)
    }

    fn loads_row(&self, row: usize) -> bool {
        norm(&self.stresses.row(row)) > self.unloaded
    }

    fn rank_alone(&self, contour: usize) -> usize {
        let dim = self.closure.dim;
        let rows: Vec<usize> = (dim * contour..dim * (contour + 1)).collect();
        self.rank_of(&self.matrix.select_rows(&rows))
    }
}

/// Returns the number of singular values above a limit.
fn count_above(matrix: &Matrix, limit: f64) -> usize {
    let values = singular_values(matrix).unwrap_or_default();
    values.iter().filter(|&&v| v > limit).count()
}
