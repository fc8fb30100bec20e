//! The structure of a state by singular values, for measured geometry that exact arithmetic would take exactly as
//! written.

use crate::closure::Closure;
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::rank::numeric::scaling::{Scaling, scaled};
use crate::redundancy::contour_shares::{ContourShare, CouplingShare, over_bases};
use ozols_dense::{Matrix, singular_values, svd};

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
        let matrix = scaled(&closure);
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
        let scaling = Scaling::of(&self.closure);
        let twists: Vec<Vec<Vec<f64>>> = links
            .iter()
            .map(|&l| {
                let path = self.closure.link_motion(&Reals, self.mechanism, l);
                path.iter()
                    .enumerate()
                    .map(|(c, t)| scaling.apply(c, t))
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
    pub fn shares(&self) -> Vec<ContourShare> {
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
