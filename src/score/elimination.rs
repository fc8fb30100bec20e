//! The two small dense problems of one variant: its equations, and the ends of its spectrum.

/// Pivots below this are none: rows are unit twists.
const PIVOT: f64 = 1e-9;

/// Work space of one thread.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    /// Rows (equations | right sides), one after another.
    pub rows: Vec<f64>,
    /// Σ of outer products of the equations, columns × columns.
    pub gram: Vec<f64>,
    pub(super) solution: Vec<f64>,
    order: Vec<usize>,
    pivot: Vec<f64>,
    diagonal: Vec<f64>,
    beside: Vec<f64>,
    vector: Vec<f64>,
    product: Vec<f64>,
}

/// How an elimination ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ended {
    /// With a solution; the greatest first right side left in the equations beyond the unknowns.
    Solved {
        /// What is left over.
        left: f64,
    },
    /// The equations do not determine the unknowns.
    Open,
}

impl Scratch {
    /// Solves `count` equations for `unknowns` with several right sides each, by Gaussian elimination with row pivots;
    /// rows that have a zero in the pivot's column are not touched, which is most of them. The solution goes to
    /// `solution`, unknowns × right sides.
    ///
    /// # Complexity
    /// O(count · unknowns · width).
    pub fn eliminate(&mut self, count: usize, unknowns: usize, width: usize) -> Ended {
        let sides = width - unknowns;
        self.order.clear();
        self.order.extend(0..count);
        if count < unknowns {
            return Ended::Open;
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
                return Ended::Open;
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
        Ended::Solved { left }
    }

    /// Smallest over greatest singular value of the equations whose Gram matrix is in `gram`, n × n: by a tridiagonal form
    /// and Newton's method from both ends of the spectrum, which it approaches from outside only [Parlett 1998, ch. 7].
    /// Ratios below some 1e-8 are rounding.
    ///
    /// # Complexity
    /// O(n³).
    pub fn conditioning(&mut self, n: usize) -> f64 {
        if n == 0 {
            return 1.0;
        }
        self.tridiagonal(n);
        let (d, e) = (&self.diagonal, &self.beside);
        let bound = (0..n)
            .map(|i| d[i] + e[i].abs() + if i + 1 < n { e[i + 1].abs() } else { 0.0 })
            .fold(0.0, f64::max);
        if bound <= 0.0 {
            return 1.0;
        }
        let greatest = newton(d, e, n, bound * (1.0 + 1e-12));
        let smallest = newton(d, e, n, -1e-17 * bound);
        (smallest.max(0.0) / greatest).sqrt()
    }

    /// Householder's reduction of the lower triangle of `gram`; `beside[i]` is next to `diagonal[i]` and `diagonal[i - 1]`.
    fn tridiagonal(&mut self, n: usize) {
        self.diagonal.clear();
        self.diagonal.resize(n, 0.0);
        self.beside.clear();
        self.beside.resize(n, 0.0);
        for k in 0..n {
            self.diagonal[k] = self.gram[k * n + k];
            if k + 1 >= n {
                break;
            }
            // The column below the diagonal, from the symmetric row to its right.
            let below = n - k - 1;
            self.vector.clear();
            self.vector
                .extend_from_slice(&self.gram[k * n + k + 1..(k + 1) * n]);
            let size = self.vector.iter().map(|x| x * x).sum::<f64>().sqrt();
            if size == 0.0 {
                continue;
            }
            let head = if self.vector[0] > 0.0 { -size } else { size };
            self.beside[k + 1] = head;
            self.vector[0] -= head;
            let square: f64 = self.vector.iter().map(|x| x * x).sum();
            if square == 0.0 {
                continue;
            }
            let scale = 2.0 / square;
            // p = scale · A v, then w = p - (scale/2 · p·v) v, A -= v wᵀ + w vᵀ.
            self.product.clear();
            self.product.resize(below, 0.0);
            for i in 0..below {
                let row = &self.gram[(k + 1 + i) * n + k + 1..(k + 2 + i) * n];
                let v = self.vector[i];
                if v != 0.0 {
                    for (p, a) in self.product.iter_mut().zip(row) {
                        *p += v * a;
                    }
                }
            }
            self.product.iter_mut().for_each(|p| *p *= scale);
            let along: f64 = self
                .product
                .iter()
                .zip(&self.vector)
                .map(|(p, v)| p * v)
                .sum();
            let half = 0.5 * scale * along;
            for (p, v) in self.product.iter_mut().zip(&self.vector) {
                *p -= half * v;
            }
            for i in 0..below {
                let (v, w) = (self.vector[i], self.product[i]);
                let row = &mut self.gram[(k + 1 + i) * n + k + 1..(k + 2 + i) * n];
                for ((a, vj), wj) in row.iter_mut().zip(&self.vector).zip(&self.product) {
                    *a -= v * wj + w * vj;
                }
            }
        }
    }
}

/// The eigenvalue of a symmetric tridiagonal matrix that is nearest to `x`, which lies outside of the spectrum.
fn newton(d: &[f64], e: &[f64], n: usize, mut x: f64) -> f64 {
    for _ in 0..60 {
        // q_i = d_i - x - e_i² / q_(i-1); Σ q'/q is the logarithmic derivative of the characteristic polynomial.
        let (mut q, mut dq, mut sum) = (1.0, 0.0, 0.0);
        for i in 0..n {
            let inverse = 1.0 / q;
            let ratio = e[i] * e[i] * inverse;
            let next = d[i] - x - ratio;
            dq = -1.0 + ratio * inverse * dq;
            q = if next == 0.0 { f64::MIN_POSITIVE } else { next };
            sum += dq / q;
        }
        let step = 1.0 / sum;
        if !step.is_finite() {
            break;
        }
        x -= step;
        if step.abs() <= 1e-14 * x.abs() {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    /// Numbers from a small generator.
    fn numbers(seed: u64, n: usize) -> Vec<f64> {
        let mut s = seed;
        let mut one = || {
            s = s.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            f64::from(u32::try_from(s >> 33).unwrap_or(0)) / f64::from(1u32 << 31) - 0.5
        };
        (0..n).map(|_| one()).collect()
    }

    #[test]
    fn elimination_and_spectrum_agree_with_faer() {
        for (n, m, sides, seed) in [(24, 24, 7, 1), (30, 24, 4, 2), (6, 3, 1, 3), (1, 1, 1, 4)] {
            let a = numbers(seed, n * m);
            let x = numbers(seed + 9, m * sides);
            let width = m + sides;
            let mut s = Scratch {
                rows: vec![0.0; n * width],
                ..Scratch::default()
            };
            for r in 0..n {
                s.rows[r * width..r * width + m].copy_from_slice(&a[r * m..(r + 1) * m]);
                for c in 0..sides {
                    s.rows[r * width + m + c] =
                        (0..m).map(|k| a[r * m + k] * x[k * sides + c]).sum();
                }
            }
            s.gram = vec![0.0; m * m];
            for i in 0..m {
                for j in 0..m {
                    s.gram[i * m + j] = (0..n).map(|r| a[r * m + i] * a[r * m + j]).sum();
                }
            }
            let Ended::Solved { left } = s.eliminate(n, m, width) else {
                panic!("open")
            };
            assert!(left < 1e-10, "{left}");
            for (found, wanted) in s.solution.iter().zip(&x) {
                assert!((found - wanted).abs() < 1e-9, "{found} {wanted}");
            }
            let values = Mat::from_fn(n, m, |r, c| a[r * m + c])
                .singular_values()
                .unwrap_or_default();
            let wanted = values[m - 1] / values[0];
            let found = s.conditioning(m);
            assert!((found - wanted).abs() < 1e-7 * wanted, "{found} {wanted}");
        }
    }
}
