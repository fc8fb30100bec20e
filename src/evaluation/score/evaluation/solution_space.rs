//! All solutions of linear equations that are added one after another, for several right sides at a time.

use crate::score::evaluation::spectrum::{add_scaled, dot_product};

/// An equation whose distance from those before it is below this depends on them: rows are unit twists.
const DEPENDENT: f64 = 1e-9;

/// The solutions of some equations: a fixed one for each right side, and any combination of open directions.
///
/// # Sources
/// The null-space method, with Householder reflections [Golub & Van Loan 2013, section 6.2].
#[derive(Debug, Clone, Default)]
pub(super) struct SolutionSpace {
    unknowns: usize,
    /// The solution of each right side, one after another.
    fixed: Vec<f64>,
    /// The open directions, one after another. They are orthonormal.
    open: Vec<f64>,
    /// The least distance of an equation from those before it, at most 1.
    pub(super) weakest: f64,
}

impl SolutionSpace {
    /// Returns all values of some unknowns.
    pub(super) fn unrestricted(unknowns: usize, sides: usize) -> SolutionSpace {
        let mut open = vec![0.0; unknowns * unknowns];
        open.iter_mut().step_by(unknowns + 1).for_each(|x| *x = 1.0);
        SolutionSpace {
            unknowns,
            fixed: vec![0.0; unknowns * sides],
            open,
            weakest: 1.0,
        }
    }

    /// Takes the solutions of another space, in the memory that it has.
    pub(super) fn copy_from(&mut self, other: &SolutionSpace) {
        (self.unknowns, self.weakest) = (other.unknowns, other.weakest);
        self.fixed.clone_from(&other.fixed);
        self.open.clone_from(&other.open);
    }

    /// Returns true if there is one solution for each right side.
    pub(super) fn is_determined(&self) -> bool {
        self.open.is_empty()
    }

    /// Returns the fixed solution of a right side.
    pub(super) fn values(&self, side: usize) -> &[f64] {
        &self.fixed[side * self.unknowns..(side + 1) * self.unknowns]
    }

    /// Returns by how much the fixed solution of the first right side misses an equation: its coefficients, and then its right sides.
    pub(super) fn first_gap(&self, equation: &[f64]) -> f64 {
        let (row, right) = equation.split_at(self.unknowns);
        right[0] - dot_product(row, self.values(0))
    }

    /// Adds an equation, in work space that is kept. Returns false if it depends on those before it; then nothing has changed.
    ///
    /// # Complexity
    /// O(unknowns · (right sides + open directions)).
    pub(super) fn add_equation(
        &mut self,
        equation: &[f64],
        [along, decided]: &mut [Vec<f64>; 2],
    ) -> bool {
        if self.is_determined() {
            return false;
        }
        let (row, right) = equation.split_at(self.unknowns);
        let open = self.open.chunks_exact(self.unknowns);
        along.clear();
        along.extend(open.clone().map(|open| dot_product(row, open)));
        let square = dot_product(along, along);
        let size = square.sqrt();
        if size < DEPENDENT {
            return false;
        }
        decided.clear();
        decided.resize(self.unknowns, 0.0);
        for (open, &c) in open.zip(&*along) {
            add_scaled(decided, c, open);
        }
        for (fixed, b) in self.fixed.chunks_exact_mut(self.unknowns).zip(right) {
            let gap = b - dot_product(row, fixed);
            add_scaled(fixed, gap / square, decided);
        }
        // The reflection takes what the equation decides to the last direction, which is dropped.
        let left = self.open.len() - self.unknowns;
        let (others, last) = self.open.split_at_mut(left);
        let c = along[along.len() - 1];
        add_scaled(decided, size.copysign(c), last);
        let scale = -1.0 / (square + size * c.abs());
        for (open, &c) in others.chunks_exact_mut(self.unknowns).zip(&*along) {
            add_scaled(open, scale * c, decided);
        }
        self.open.truncate(left);
        self.weakest = self.weakest.min(size);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::SolutionSpace;
    use crate::score::evaluation::spectrum::tests::numbers;
    use ozols_dense::{Matrix, singular_values, svd};

    /// The fixed solution solves all equations, each open direction solves them without their right sides, and dependent equations are
    /// known as such.
    #[test]
    fn solutions_solve_the_equations_that_were_added() {
        let (unknowns, sides) = (9, 3);
        for seed in 0..50 {
            let mut space = SolutionSpace::unrestricted(unknowns, sides);
            let mut equations: Vec<Vec<f64>> = Vec::new();
            let mut scratch = [Vec::new(), Vec::new()];
            let drawn = numbers(seed, unknowns * (unknowns + sides));
            for (n, new) in drawn.chunks_exact(unknowns + sides).enumerate() {
                let mut new = new.to_vec();
                if n % 3 == 1 {
                    // As sparse as those of a joint.
                    new[..4].fill(0.0);
                }
                if n == 4 {
                    new = (0..unknowns + sides)
                        .map(|i| equations[0][i] - 2.0 * equations[3][i])
                        .collect();
                }
                assert_eq!(space.add_equation(&new, &mut scratch), n != 4);
                equations.push(new);
                let mut copy = SolutionSpace::unrestricted(1, 0);
                copy.copy_from(&space);
                space = copy;
                let matrix = Matrix::from_fn(equations.len(), unknowns, |r, c| equations[r][c]);
                let values = singular_values(&matrix).unwrap();
                let rank = values.iter().filter(|s| **s > 1e-9).count();
                assert_eq!(space.open.len(), (unknowns - rank) * unknowns);
                let open = Matrix::from_fn(unknowns, space.open.len() / unknowns, |r, c| {
                    space.open[c * unknowns + r]
                });
                let count = open.ncols();
                let mut square = open.transpose_times(&open);
                square.add_multiple(-1.0, &Matrix::identity(count, count));
                assert!(square.norm() < 1e-12 && matrix.times(&open).norm() < 1e-9);
                for equation in &equations {
                    assert!(space.first_gap(equation).abs() < 1e-9);
                    for side in 0..sides {
                        let sum: f64 = (0..unknowns)
                            .map(|u| equation[u] * space.values(side)[u])
                            .sum();
                        assert!((sum - equation[unknowns + side]).abs() < 1e-9);
                    }
                }
                // The fixed solution is the shortest one.
                let right = Matrix::from_fn(equations.len(), 1, |r, _| equations[r][unknowns]);
                let found = svd(&matrix).unwrap();
                let least = found.least_norm(rank, &right);
                for u in 0..unknowns {
                    assert!((least[(u, 0)] - space.values(0)[u]).abs() < 1e-8);
                }
            }
        }
    }
}
