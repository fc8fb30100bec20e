//! The tangent cone to second order: the instantaneous motions that no self-stress obstructs.
//!
//! A motion that begins with speeds x, J x = 0, has accelerations only if each self-stress ω does no work on the gaps
//! of second order: ω·q(x) = 0. These are quadratic forms in the weights of the motions [Connelly & Whiteley 1996;
//! Müller 2016]. Their real zeros are found from many starts by damped Newton steps. If a combination of the forms is
//! definite, there are none.

use crate::motion::pose::{FLAT, Pose};
use ozols_dense::{Matrix, dot, norm, singular_values, solve, svd, symmetric_eigen};

/// Values of a form, relative to the largest coefficient, that count as zero.
const ZERO: f64 = 1e-6;

/// Minimum gradient of forms of size 1 that is clearly nonzero.
const CLEAR: f64 = 1e-2;

/// Singular values in this range are too close to zero to be distinguished from it.
const UNCLEAR: std::ops::Range<f64> = 1e-9..1e-6;

/// The flat directions of J at a pose.
pub(in crate::rank) struct Flat {
    /// Instantaneous motions as orthonormal columns.
    pub(in crate::rank) kernel: Matrix,
    /// Self-stresses as orthonormal columns.
    pub(in crate::rank) stresses: Matrix,
    /// Whether all singular values are either clearly zero or clearly nonzero.
    pub(in crate::rank) clear: bool,
}

impl Flat {
    /// Computes the flat directions, with `motions` columns if their number is known.
    pub(in crate::rank) fn new(pose: &Pose, motions: Option<usize>) -> Flat {
        let (f, rows) = (pose.columns.len(), pose.rows());
        let Some(svd) = svd(&pose.jacobian_at(&vec![0.0; f])) else {
            return Flat {
                kernel: Matrix::zeros(f, 0),
                stresses: Matrix::identity(rows, rows),
                clear: false,
            };
        };
        let values = &svd.values;
        let scale = values.first().map_or(1.0, |s| s.max(1.0));
        let flat = FLAT.max(10.0 * pose.accuracy());
        let rank = match motions {
            Some(n) => f - n.min(f),
            None => values.iter().filter(|&&s| s > flat * scale).count(),
        };
        Flat {
            kernel: svd.null_space(rank),
            stresses: svd.left_null_space(rank),
            clear: motions.is_some()
                || pose.accuracy() > 0.0
                || values.iter().all(|s| !UNCLEAR.contains(&(s / scale))),
        }
    }
}

/// The quadratic forms.
#[derive(Debug)]
pub(in crate::rank) struct Quadrics {
    /// Symmetric matrices, n × n.
    forms: Vec<Matrix>,
    /// The self-stress whose work each form is.
    stresses: Vec<Vec<f64>>,
    motions: usize,
}

impl Quadrics {
    /// Returns the independent forms of the self-stresses at a pose.
    pub(in crate::rank) fn new(pose: &Pose, flat: &Flat) -> Quadrics {
        let floor = ZERO.max(10.0 * pose.accuracy());
        Quadrics::of_table(&second_order_works(pose, flat), flat.kernel.ncols(), floor)
    }

    /// Returns the forms of a table of [`works`], without those below a floor.
    pub(in crate::rank) fn of_table(table: &Matrix, motions: usize, floor: f64) -> Quadrics {
        let (mut forms, mut stresses) = (Vec::new(), Vec::new());
        if let Some(svd) = svd(table) {
            for k in (0..svd.values.len()).filter(|&k| svd.values[k] > floor) {
                forms.push(form_of_row(svd.v.col(k), motions));
                let of = svd.u.col(k).iter().map(|x| x / svd.values[k]);
                stresses.push(of.collect());
            }
        }
        Quadrics {
            forms,
            stresses,
            motions,
        }
    }

    /// Returns the self-stresses whose work the forms are, as weights of the rows of the table.
    pub(in crate::rank) fn stresses(&self) -> &[Vec<f64>] {
        &self.stresses
    }

    /// Returns true if there are no second-order terms.
    pub(in crate::rank) fn is_empty(&self) -> bool {
        self.forms.is_empty()
    }

    fn form_values(&self, x: &[f64]) -> Vec<f64> {
        self.forms
            .iter()
            .map(|q| dot(&q.combine_columns(x), x))
            .collect()
    }

    /// Returns the zero of all forms near a unit vector, if there is one.
    fn zero_near(&self, mut x: Vec<f64>) -> Option<Vec<f64>> {
        let n = self.motions;
        for _ in 0..40 {
            let values = self.form_values(&x);
            let gap = norm(&values);
            if gap < 1e-13 {
                break;
            }
            let gradients: Vec<Vec<f64>> =
                self.forms.iter().map(|q| q.combine_columns(&x)).collect();
            // (GᵀG + xxᵀ + λ) step = Gᵀ values, G = 2 gradients.
            let damping = gap.min(1e-2) * 1e-2 + 1e-14;
            let normal = Matrix::from_fn(n, n, |i, j| {
                let sum: f64 = gradients.iter().map(|g| 4.0 * g[i] * g[j]).sum();
                sum + x[i] * x[j] + if i == j { damping } else { 0.0 }
            });
            let weighted = |i| {
                let pairs = gradients.iter().zip(&values);
                pairs.map(|(g, v)| 2.0 * g[i] * v).sum::<f64>()
            };
            let right: Vec<f64> = (0..n).map(weighted).collect();
            for (x, step) in x.iter_mut().zip(solve(&normal, &right)) {
                *x -= step;
            }
            let size = norm(&x);
            if !size.is_finite() || size < 1e-9 {
                return None;
            }
            x.iter_mut().for_each(|x| *x /= size);
        }
        (norm(&self.form_values(&x)) < ZERO).then_some(x)
    }

    /// Returns the dimension that the cone can have at a zero: the number of directions that change no form.
    fn nullity_at(&self, x: &[f64]) -> usize {
        self.nullity_above(x, 1e-3)
    }

    /// Returns the number of directions that change no form, with gradients below `floor` treated as zero.
    fn nullity_above(&self, x: &[f64], floor: f64) -> usize {
        let n = self.motions;
        if self.forms.is_empty() {
            return n;
        }
        let gradients: Vec<Vec<f64>> = self.forms.iter().map(|q| q.combine_columns(x)).collect();
        let matrix = Matrix::from_fn(gradients.len(), n, |i, j| gradients[i][j]);
        let values = singular_values(&matrix).unwrap_or_default();
        n - values.iter().filter(|&&s| s > floor).count()
    }

    /// Returns true if there are this many forms, and their gradients at one of the zeros are clearly independent.
    ///
    /// Then the exact forms have a nearby zero, where they are also independent [Kantorovich: the gap there is below
    /// 1e-6, and 2e-3 would be enough]. A motion of as many freedoms as are left begins in its direction [Avakov 1985;
    /// Izmailov & Tretyakov 1994, "2-regular"].
    pub(in crate::rank) fn cross_at_zeros(&self, forms: usize, zeros: &[Vec<f64>]) -> bool {
        let independent = |x: &Vec<f64>| self.motions - self.nullity_above(x, CLEAR) == forms;
        self.forms.len() == forms && zeros.iter().any(independent)
    }

    /// Returns the largest dimension of the cone at the zeros found.
    pub(in crate::rank) fn cone_dimension(&self, zeros: &[Vec<f64>]) -> usize {
        let of = |x: &Vec<f64>| self.nullity_at(x);
        zeros.iter().map(of).max().unwrap_or(0)
    }

    /// Returns true if some combination of the forms is definite, so that they have no common zero.
    pub(in crate::rank) fn is_definite(&self) -> bool {
        self.definite_combination().is_some()
    }

    /// Returns the weights of a positive definite combination of the forms, with its smallest eigenvalue.
    pub(in crate::rank) fn definite_combination(&self) -> Option<(Vec<f64>, f64)> {
        let n = self.motions;
        let mut sum: Matrix = Matrix::zeros(n, n);
        let mut all = Vec::new();
        for q in &self.forms {
            let trace: f64 = (0..n).map(|i| q[(i, i)]).sum();
            sum.add_multiple(trace, q);
            all.push(trace);
        }
        // Increases the smallest eigenvalue by adding the forms, weighted by their values at its eigenvector.
        for _ in 0..200 {
            let (values, vectors) = symmetric_eigen(&sum)?;
            let largest = values[0].abs().max(values[n - 1].abs());
            if values[0] > 1e-3 * largest {
                return Some((all, values[0]));
            }
            let weights = self.form_values(vectors.col(0));
            let size = norm(&weights);
            if size < 1e-9 {
                return None;
            }
            for ((q, w), sum_of) in self.forms.iter().zip(weights).zip(&mut all) {
                let more = w / size * largest.max(1e-3) * 0.2;
                sum.add_multiple(more, q);
                *sum_of += more;
            }
        }
        None
    }
}

/// Returns the pairs of motions of the columns of a table of [`works`].
fn motion_pairs(motions: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..motions).flat_map(|i| (0..=i).map(move |j| (i, j)))
}

/// Returns the symmetric matrix of a row of a table of [`works`].
pub(in crate::rank) fn form_of_row(row: &[f64], motions: usize) -> Matrix {
    let mut form = Matrix::zeros(motions, motions);
    for (x, (i, j)) in row.iter().zip(motion_pairs(motions)) {
        form[(i, j)] = *x;
        form[(j, i)] = *x;
    }
    form
}

/// Returns the work of the self-stresses on the gaps of second order: one row per self-stress, one column per pair of
/// motions.
///
/// # Complexity
/// O(n² (f + rows · stresses)) for n motions.
pub(in crate::rank) fn second_order_works(pose: &Pose, flat: &Flat) -> Matrix {
    let n = flat.kernel.ncols();
    let s = flat.stresses.ncols();
    let works = |x: &[f64]| -> Vec<f64> {
        let bend = Matrix::from_column(&pose.bend_along(&flat.kernel.combine_columns(x)));
        let work = flat.stresses.transpose_times(&bend);
        work.col(0).iter().map(|w| w / 2.0).collect()
    };
    let unit = |pairs: &[usize]| {
        let mut x = vec![0.0; n];
        pairs.iter().for_each(|&i| x[i] += 1.0);
        works(&x)
    };
    let single: Vec<Vec<f64>> = (0..n).map(|i| unit(&[i])).collect();
    let columns: Vec<Vec<f64>> = motion_pairs(n)
        .map(|(i, j)| {
            if i == j {
                return single[i].clone();
            }
            let mixed = unit(&[i, j]);
            (0..s)
                .map(|k| (mixed[k] - single[i][k] - single[j][k]) / 2.0)
                .collect()
        })
        .collect();
    Matrix::from_fn(s, columns.len(), |k, p| columns[p][k])
}

/// Returns the zeros of all forms found from the given starts.
pub(in crate::rank) fn find_zeros(
    quadrics: &Quadrics,
    sparse: Vec<Vec<f64>>,
    random: Vec<Vec<f64>>,
) -> Vec<Vec<f64>> {
    if quadrics.is_empty() {
        return Vec::new();
    }
    let mut found: Vec<Vec<f64>> = Vec::new();
    for x in sparse.into_iter().chain(random) {
        if let Some(x) = quadrics.zero_near(x) {
            let known = |y: &Vec<f64>| dot(y, &x).abs() > 1.0 - 1e-8;
            if !found.iter().any(known) {
                found.push(x);
            }
        }
    }
    found
}

/// Selects zeros to begin with: a few of each dimension of the cone, largest dimension first.
pub(in crate::rank) fn choose_zeros(
    quadrics: &Quadrics,
    zeros: &[Vec<f64>],
    most: usize,
) -> Vec<Vec<f64>> {
    let mut by: Vec<(usize, &Vec<f64>)> =
        zeros.iter().map(|x| (quadrics.nullity_at(x), x)).collect();
    by.sort_by_key(|(n, _)| std::cmp::Reverse(*n));
    let mut kinds: Vec<usize> = by.iter().map(|(n, _)| *n).collect();
    kinds.dedup();
    let each = most.div_ceil(kinds.len().max(1));
    let of = |k: usize| {
        by.iter()
            .filter(move |(n, _)| *n == k)
            .take(each)
            .map(|(_, x)| (*x).clone())
    };
    kinds.into_iter().flat_map(of).take(most).collect()
}

/// Returns motions of few joints: a basis of the kernel in reduced form, as weights of its columns.
pub(in crate::rank) fn sparse_motions(kernel: &Matrix) -> Vec<Vec<f64>> {
    let (f, n) = (kernel.nrows(), kernel.ncols());
    let mut rows: Vec<Vec<f64>> = (0..n).map(|c| kernel.col(c).to_vec()).collect();
    for i in 0..n {
        // The largest remaining entry is the pivot.
        let largest = |row: &Vec<f64>| {
            let at = (0..f).max_by(|&a, &b| row[a].abs().total_cmp(&row[b].abs()));
            at.map_or((0, 0.0), |c| (c, row[c].abs()))
        };
        let Some(r) = (i..n).max_by(|&a, &b| largest(&rows[a]).1.total_cmp(&largest(&rows[b]).1))
        else {
            break;
        };
        rows.swap(i, r);
        let (c, size) = largest(&rows[i]);
        if size < 1e-12 {
            break;
        }
        let scale = rows[i][c];
        rows[i].iter_mut().for_each(|x| *x /= scale);
        let pivot = rows[i].clone();
        for (k, row) in rows.iter_mut().enumerate() {
            if k != i {
                let by = row[c];
                row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= by * p);
            }
        }
    }
    let weights = |row: &Vec<f64>| -> Vec<f64> {
        let x: Vec<f64> = (0..n).map(|c| dot(kernel.col(c), row)).collect();
        let size = norm(&x).max(1e-12);
        x.into_iter().map(|v| v / size).collect()
    };
    rows.iter().map(weights).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::drawn::{draw_mechanism, hinges};
    use crate::model::mechanism::StateId;

    /// A flat parallelogram, hinges at 0, 2, 5 and 3 on a line, continues as a parallelogram or crossed. By hand, for
    /// the speeds a, b and c of crank, coupler and rocker: 2a + 3b = 2c, and 2a² + 3b² = 2c² to second order, so b = 0
    /// or b = -4a.
    #[test]
    fn a_flat_parallelogram_goes_on_both_ways_and_no_other() {
        let at = |x: f64| [x, 0.0, 0.0];
        let joints = [
            ([0, 1], at(0.0)),
            ([1, 2], at(2.0)),
            ([2, 3], at(5.0)),
            ([3, 0], at(3.0)),
        ];
        let pose = Pose::of_file(&draw_mechanism(&hinges(&joints), &[]), StateId::FREE).unwrap();
        let flat = Flat::new(&pose, Some(2));
        let quadrics = Quadrics::new(&pose, &flat);
        let values = |a: f64, b: f64, c: f64| {
            // Each link relative to the one before it.
            let q = [a, b - a, c - b, -c];
            let x = flat.kernel.transpose_times(&Matrix::from_column(&q));
            let gap = norm(&q).powi(2) - norm(x.col(0)).powi(2);
            assert!(gap.abs() < 1e-9, "no motion at all");
            norm(&quadrics.form_values(x.col(0)))
        };
        assert_eq!(quadrics.forms.len(), 1);
        assert!(values(1.0, 0.0, 1.0) < 1e-6 && values(1.0, -4.0, -5.0) < 1e-6);
        assert!(values(0.0, 2.0, 3.0) > 1e-2 && values(1.0, 4.0, 7.0) > 1e-2);
    }
}
