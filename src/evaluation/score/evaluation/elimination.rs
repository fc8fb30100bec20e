//! The equations of one variant.

use crate::score::evaluation::spectrum::Spectrum;

/// Pivots below this are none: rows are unit twists.
const PIVOT: f64 = 1e-9;

/// Work space of one thread.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    /// Rows (equations | right sides), one after another.
    pub rows: Vec<f64>,
    /// Σ of outer products of the equations, columns × columns, the upper triangle.
    pub gram: Vec<f64>,
    /// Work space for its spectrum.
    pub spectrum: Spectrum,
    pub(in crate::score) solution: Vec<f64>,
    order: Vec<usize>,
    pivot: Vec<f64>,
}

impl Scratch {
    /// Solves `count` equations for `unknowns` with several right sides each, by Gaussian elimination with row pivots;
    /// rows that have a zero in the pivot's column are not touched, which is most of them. The solution goes to
    /// `solution`, unknowns × right sides. Returns the greatest first right side left in the equations beyond the unknowns, or `None` if
    /// the equations do not determine the unknowns.
    ///
    /// # Complexity
    /// O(count · unknowns · width).
    pub fn solve_equations(&mut self, count: usize, unknowns: usize, width: usize) -> Option<f64> {
        let sides = width - unknowns;
        self.order.clear();
        self.order.extend(0..count);
        if count < unknowns {
            return None;
        }
        for c in 0..unknowns {
            let mut best = (c, 0.0);
            for (r, &row) in self.order.iter().enumerate().skip(c) {
                let size = self.rows[row * width + c].abs();
                if size > best.1 {
                    best = (r, size);
                }
            }
            if best.1 < PIVOT {
                return None;
            }
            self.order.swap(c, best.0);
            let from = self.order[c] * width;
            self.pivot.clear();
            self.pivot
                .extend_from_slice(&self.rows[from + c..from + width]);
            let inverse = 1.0 / self.pivot[0];
            for &row in &self.order[c + 1..] {
                let row = &mut self.rows[row * width + c..(row + 1) * width];
                if row[0] != 0.0 {
                    let factor = row[0] * inverse;
                    for (x, p) in row.iter_mut().zip(&self.pivot) {
                        *x -= factor * p;
                    }
                }
            }
        }
        let left = self.order[unknowns..]
            .iter()
            .map(|&r| self.rows[r * width + unknowns].abs())
            .fold(0.0, f64::max);
        self.solution.clear();
        self.solution.resize(unknowns * sides, 0.0);
        for c in (0..unknowns).rev() {
            let row = &self.rows[self.order[c] * width..(self.order[c] + 1) * width];
            let (done, todo) = self.solution.split_at_mut((c + 1) * sides);
            let out = &mut done[c * sides..];
            out.copy_from_slice(&row[unknowns..]);
            for (k, a) in row[c + 1..unknowns].iter().enumerate() {
                if *a != 0.0 {
                    for (o, x) in out.iter_mut().zip(&todo[k * sides..]) {
                        *o -= a * x;
                    }
                }
            }
            let inverse = 1.0 / row[c];
            out.iter_mut().for_each(|o| *o *= inverse);
        }
        Some(left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score::evaluation::spectrum::tests::numbers;

    /// Equations (matrix | right sides) made from a matrix, rows × unknowns, and a solution, unknowns × sides.
    fn equations(a: &[f64], x: &[f64], unknowns: usize, sides: usize) -> Scratch {
        let mut s = Scratch::default();
        for row in a.chunks_exact(unknowns) {
            s.rows.extend_from_slice(row);
            for c in 0..sides {
                let right = row.iter().zip(x.iter().skip(c).step_by(sides));
                s.rows.push(right.map(|(a, x)| a * x).sum());
            }
        }
        s
    }

    #[test]
    fn equations_give_back_the_solution_they_were_made_from() {
        for (n, m, sides, seed) in [(24, 24, 7, 1), (30, 24, 4, 2), (6, 3, 1, 3), (1, 1, 1, 4)] {
            let (a, x) = (numbers(seed, n * m), numbers(seed + 9, m * sides));
            let mut s = equations(&a, &x, m, sides);
            let Some(left) = s.solve_equations(n, m, m + sides) else {
                panic!("open")
            };
            assert!(left < 1e-10, "{left}");
            for (found, wanted) in s.solution.iter().zip(&x) {
                assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
            }
        }
    }

    #[test]
    fn a_zero_pivot_is_swapped_away() {
        let mut s = equations(&[0.0, 1.0, 1.0, 0.0], &[3.0, 5.0], 2, 1);
        assert_eq!(s.solve_equations(2, 2, 3), Some(0.0));
        assert_eq!(s.solution, [3.0, 5.0]);
    }

    #[test]
    fn too_few_or_dependent_equations_are_open() {
        let mut s = equations(&[1.0, 2.0], &[1.0, 1.0], 2, 1);
        assert_eq!(s.solve_equations(1, 2, 3), None);
        let mut s = equations(&[1.0, 2.0, 2.0, 4.0, -3.0, -6.0], &[1.0, 1.0], 2, 1);
        assert_eq!(s.solve_equations(3, 2, 3), None);
    }

    #[test]
    fn what_contradicts_is_left_over() {
        let mut s = equations(&[1.0, 0.0, 0.0, 1.0, 1.0, 1.0], &[1.0, 2.0], 2, 1);
        s.rows[8] += 0.25;
        assert_eq!(s.solve_equations(3, 2, 3), Some(0.25));
    }
}
