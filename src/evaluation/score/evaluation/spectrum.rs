//! The ends of the spectrum of one variant's equations.

/// Most iterations; from outside of the spectrum some five are needed, more where eigenvalues crowd at its end.
const ITERATIONS: usize = 60;

/// Work space of one thread.
#[derive(Debug, Clone, Default)]
pub struct Spectrum {
    diagonal: Vec<f64>,
    /// `beside[i]` is next to `diagonal[i]` and `diagonal[i - 1]`.
    beside: Vec<f64>,
    vector: Vec<f64>,
    product: Vec<f64>,
}

impl Spectrum {
    /// Returns the ratio of the smallest to the greatest singular value of the equations. Their Gram matrix is in the upper
    /// triangle of `gram`, n × n, row by row, and is overwritten. Uses a tridiagonal form and Laguerre's method from both
    /// ends of the spectrum, which it approaches from outside only [Parlett 1998, ch. 7]. Ratios below some 1e-8 are
    /// rounding.
    ///
    /// # Complexity
    /// O(n³), 4/3 n³ of it additions and products.
    pub fn conditioning_of(&mut self, gram: &mut [f64], n: usize) -> f64 {
        if n == 0 {
            return 1.0;
        }
        self.reduce_tridiagonal(gram, n);
        let (d, e) = (&self.diagonal, &self.beside);
        let bound = (0..n)
            .map(|i| d[i] + e[i].abs() + e.get(i + 1).map_or(0.0, |x| x.abs()))
            .fold(0.0, f64::max);
        if bound <= 0.0 {
            return 1.0;
        }
        let [greatest, smallest] = extreme_eigenvalues(d, e, bound);
        (smallest.max(0.0) / greatest).sqrt()
    }

    /// Applies Householder's reduction to tridiagonal form.
    fn reduce_tridiagonal(&mut self, gram: &mut [f64], n: usize) {
        self.diagonal.clear();
        self.beside.clear();
        self.beside.push(0.0);
        for k in 0..n {
            let (row, rest) = gram[k * n..n * n].split_at_mut(n);
            self.diagonal.push(row[k]);
            let Some((&first, others)) = row[k + 1..].split_first() else {
                break;
            };
            let far = dot_product(others, others);
            if far == 0.0 {
                // Nothing to reflect.
                self.beside.push(first);
                continue;
            }
            let size = (first * first + far).sqrt();
            let head = if first > 0.0 { -size } else { size };
            self.beside.push(head);
            self.vector.clear();
            self.vector.push(first - head);
            self.vector.extend_from_slice(others);
            let (v, p) = (&self.vector, &mut self.product);
            // 2 / v·v, as v·v = 2 size (size + |first|).
            let scale = 1.0 / (size * (size + first.abs()));
            // p = scale · A v, then w = p - (scale/2 · p·v) v, A -= v wᵀ + w vᵀ, all on the triangle.
            p.clear();
            p.resize(v.len(), 0.0);
            for (i, row) in rest.chunks_exact(n).enumerate() {
                let (diagonal, right) = (row[k + 1 + i], &row[k + 2 + i..]);
                let head = v[i];
                add_scaled(&mut p[i + 1..], head, right);
                p[i] += diagonal * head + dot_product(right, &v[i + 1..]);
            }
            let half = 0.5 * scale * scale * dot_product(p, v);
            for (p, v) in p.iter_mut().zip(v) {
                *p = scale * *p - half * v;
            }
            for (i, row) in rest.chunks_exact_mut(n).enumerate() {
                let right = &mut row[k + 1 + i..];
                let (a, b) = (v[i], p[i]);
                for ((x, w), v) in right.iter_mut().zip(&p[i..]).zip(&v[i..]) {
                    *x -= a * w + b * v;
                }
            }
        }
    }
}

/// Returns the dot product. Computes four sums in parallel, so that they do not wait for each other.
pub(super) fn dot_product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (mut left, mut right) = (a.chunks_exact(4), b.chunks_exact(4));
    for (x, y) in left.by_ref().zip(right.by_ref()) {
        for l in 0..4 {
            sums[l] += x[l] * y[l];
        }
    }
    let tail = left.remainder().iter().zip(right.remainder());
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + tail.map(|(x, y)| x * y).sum::<f64>()
}

/// Computes `out += factor · row`.
pub(super) fn add_scaled(out: &mut [f64], factor: f64, row: &[f64]) {
    for (o, x) in out.iter_mut().zip(row) {
        *o += factor * x;
    }
}

/// Returns the greatest and smallest eigenvalue of a symmetric tridiagonal matrix, not indefinite, whose eigenvalues are at
/// most `bound`. Both are computed at the same time, so that the divisions of one fill the waiting times of the other.
fn extreme_eigenvalues(d: &[f64], e: &[f64], bound: f64) -> [f64; 2] {
    let n = d.len() as f64;
    let mut x = [bound * (1.0 + 1e-12), -1e-17 * bound];
    let mut done = [false; 2];
    for _ in 0..ITERATIONS {
        let (slope, bend) = logarithmic_derivatives(d, e, x);
        for l in 0..2 {
            if done[l] {
                continue;
            }
            let spread = ((n - 1.0) * (n * bend[l] - slope[l] * slope[l])).max(0.0);
            let step = n / (slope[l] + spread.sqrt().copysign(slope[l]));
            // From outside all steps go one way; one the other way, or below rounding, is the end.
            let inward = if l == 0 { step > 0.0 } else { step < 0.0 };
            if step.is_finite() && inward {
                x[l] -= step;
            }
            done[l] =
                !step.is_finite() || !inward || step.abs() <= 1e-16 * bound + 1e-15 * x[l].abs();
        }
        if done == [true; 2] {
            break;
        }
    }
    x
}

/// Returns the first derivative of the logarithm of the characteristic polynomial at two places, and the second with its
/// sign changed: Σ 1/(x - λ) and Σ 1/(x - λ)².
fn logarithmic_derivatives(d: &[f64], e: &[f64], x: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let (mut slope, mut bend) = ([0.0; 2], [0.0; 2]);
    // With q_i = d_i - x - e_i²/q_(i-1): u = q'/q and w = q''/q.
    let (mut inverse, mut u, mut w) = ([1.0; 2], [0.0; 2], [0.0; 2]);
    for (&d, &e) in d.iter().zip(e) {
        for l in 0..2 {
            let ratio = e * e * inverse[l];
            let q = d - x[l] - ratio;
            inverse[l] = 1.0 / if q == 0.0 { f64::MIN_POSITIVE } else { q };
            w[l] = ratio * (w[l] - 2.0 * u[l] * u[l]) * inverse[l];
            u[l] = (ratio * u[l] - 1.0) * inverse[l];
            slope[l] += u[l];
            bend[l] += u[l] * u[l] - w[l];
        }
    }
    (slope, bend)
}

#[cfg(test)]
pub(in crate::score) mod tests {
    use super::*;
    use ozols_dense::{Matrix, singular_values};

    /// Returns numbers from a small random generator.
    pub(in crate::score) fn numbers(seed: u64, n: usize) -> Vec<f64> {
        let mut s = seed;
        let mut one = || {
            s = s.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            f64::from(u32::try_from(s >> 33).unwrap_or(0)) / f64::from(1u32 << 31) - 0.5
        };
        (0..n).map(|_| one()).collect()
    }

    /// Returns the ratio by this program, and by singular values.
    fn both(a: &[f64], n: usize, m: usize) -> (f64, f64) {
        let mut gram = vec![0.0; m * m];
        for i in 0..m {
            for j in 0..m {
                gram[i * m + j] = (0..n).map(|r| a[r * m + i] * a[r * m + j]).sum();
            }
        }
        let values = Matrix::from_fn(n, m, |r, c| a[r * m + c]);
        let values = singular_values(&values).unwrap_or_default();
        let found = Spectrum::default().conditioning_of(&mut gram, m);
        (found, values[m - 1] / values[0])
    }

    #[test]
    fn ends_agree_with_singular_values() {
        for seed in 0..200 {
            for (n, m) in [(24, 24), (30, 24), (13, 12), (6, 3), (5, 2), (1, 1)] {
                let (found, wanted) = both(&numbers(seed, n * m), n, m);
                // What rounding of the Gram matrix leaves.
                let allowed = 1e-13 / wanted.powi(2) + 1e-12;
                assert!(
                    (found - wanted).abs() <= allowed * wanted,
                    "{n} {m} {seed}: {found} {wanted}"
                );
            }
        }
    }

    #[test]
    fn repeated_eigenvalues_are_found() {
        // Two equal blocks: every eigenvalue is double; and a multiple of the unit matrix.
        let block = numbers(7, 36);
        let mut a = vec![0.0; 144];
        for (i, x) in block.iter().enumerate() {
            a[i / 6 * 12 + i % 6] = *x;
            a[(i / 6 + 6) * 12 + i % 6 + 6] = *x;
        }
        let (found, wanted) = both(&a, 12, 12);
        assert!((found - wanted).abs() <= 1e-7 * wanted, "{found} {wanted}");
        let unit: Vec<f64> = (0..25)
            .map(|i| if i % 6 == 0 { 3.0 } else { 0.0 })
            .collect();
        let (found, _) = both(&unit, 5, 5);
        assert!((found - 1.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn dependent_equations_have_no_conditioning() {
        let mut a = numbers(3, 36);
        let (first, last) = a.split_at_mut(30);
        last.copy_from_slice(&first[..6]);
        let (found, _) = both(&a, 6, 6);
        assert!(found < 1e-7, "{found}");
        let mut nothing = vec![0.0; 9];
        assert_eq!(Spectrum::default().conditioning_of(&mut nothing, 3), 1.0);
        assert_eq!(Spectrum::default().conditioning_of(&mut [], 0), 1.0);
    }
}
