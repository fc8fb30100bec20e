//! Motions that the second order stops or lets pass: proven at singular poses, or for any rounding of the coordinates.
//!
//! At a pose whose J has its intended rank, a motion is stopped if self-stresses do work on its gaps of second order.
//! That work changes with each coordinate, both directly and through the motion and the self-stress. Perturbation
//! theory gives these changes to first order [Stewart & Sun, "Matrix Perturbation Theory", 1990]. The sum of the
//! changes over half a unit of each coordinate bounds the effect of rounding on the work.
//!
//! Singular poses are poses without motion, crossings of branches, and cusps in which a branch turns back.
//!
//! J leaves open s equations g(x) = 0 in n free coordinates. Their number s is the dimension of the groups of the
//! contours less the rank of J. To second order they are quadratic forms. If a combination of them is definite, nothing
//! moves, as in a taut chain [Connelly & Whiteley 1996]. At a common zero with independent gradients, a motion of n - s
//! freedoms begins [Avakov 1985; Izmailov & Tretyakov 1994].
//!
//! A single equation has zeros of n - 1 dimensions as soon as it changes its sign. It does so along a line on which it
//! begins with an odd power, which finds cusps. Motions of more freedoms are excluded by power series in a random
//! subspace (`higher_order`).

use crate::closure::twist::MotionSpace;
use crate::geom::Reals;
use crate::geom::exact::ExactError;
use crate::linalg::echelon::{linear_combination, linear_relations};
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, Mechanism};
use crate::model::rounded::Uncertainties;
use crate::motion::pose::Pose;
use crate::rank::exact::modular::ExactState;
use crate::rank::finite::higher_order::{HigherOrder, Line, ORDER};
use crate::rank::finite::mobility::{Finite, How, group_dimensions};
use crate::rank::finite::tangent_cone::{
    self, Flat, Quadrics, find_zeros, second_order_works, sparse_motions,
};
use crate::rank::rounded::{Coordinate, frame_with, mechanism_size, rounded_coordinates};
use itertools::Itertools;
use ozols_dense::{Matrix, Svd, dot, svd};

/// Step of finite differences, in radians and fractions of the size.
const STEP: f64 = 1e-5;
/// Factor by which first-order changes bound those of all orders.
const SAFE: f64 = 1.5;
/// Changes of J above this share of its smallest nonzero singular value are not small.
const SMALL: f64 = 0.1;
/// Work below this counts as zero in doubles.
const ZERO: f64 = 1e-11;
/// Number of standard deviations that rounding alone exceeds once in ten thousand times.
const RARE: f64 = 4.0;
/// Maximum product of coordinates, pairs of motions and entries of J.
const LARGEST: usize = 400_000_000;

/// Accuracy of the coordinates of a mechanism.
#[derive(Debug, Clone)]
pub(crate) struct Roundings {
    half: Uncertainties,
    /// Number of half units by which coordinates may be off.
    times: f64,
    /// One unit of the coarsest coordinate: radians, or a fraction of the size.
    pub(super) unit: f64,
}

impl Roundings {
    /// Creates the accuracy from half units of the coordinates, which may be off by `times` of them.
    pub(crate) fn new(mechanism: &Mechanism, half: Uncertainties, times: f64) -> Roundings {
        let [length, direction] = half.largest_half_units(mechanism);
        Roundings {
            unit: 2.0 * direction.max(length / mechanism_size(mechanism)),
            half,
            times,
        }
    }

    /// Returns the coordinates of some joints that may be off and matter.
    fn inexact_coordinates(&self, mechanism: &Mechanism, joints: &[JointId]) -> Vec<Coordinate> {
        let matters = |c: &Coordinate| match c.vector {
            0 => true,
            1 => mechanism.joints[c.joint].joint_type.is_directed(),
            _ => mechanism.joints[c.joint].joint_type.has_second_axis(),
        };
        let mut all = rounded_coordinates(mechanism, joints.iter().copied(), &self.half);
        all.retain(matters);
        all
    }
}

/// The second-order work at a pose, and the possible effect of rounding on it.
pub(super) struct SecondOrder {
    table: Matrix,
    /// Change of the table by half a unit of each coordinate.
    changes: Vec<Matrix>,
    quadrics: Quadrics,
    motions: usize,
}

impl SecondOrder {
    /// Creates the table of a pose with `motions` instantaneous motions. Returns `None` if it is too large, or if J is
    /// too close to having more motions.
    ///
    /// # Complexity
    /// O(n²) matrices J for n motions and each coordinate.
    pub(super) fn new(
        mechanism: &Mechanism,
        pose: &Pose,
        motions: usize,
        known: &Roundings,
    ) -> Option<SecondOrder> {
        let f = pose.columns.len();
        let here = pose.jacobian_at(&vec![0.0; f]);
        let joints: Vec<JointId> = pose.columns.iter().map(|c| c.joint).dedup().collect();
        let matrices = 18 * joints.len() * motions * (motions + 1);
        if matrices * pose.rows() * f > LARGEST {
            return None;
        }
        let factors = svd(&here)?;
        let rank = f.checked_sub(motions)?;
        let least = *factors.values.get(rank.checked_sub(1)?)?;
        let flat = Flat {
            kernel: factors.null_space(rank),
            stresses: factors.left_null_space(rank),
            clear: true,
        };
        let turned = Svd {
            values: factors.values.clone(),
            u: factors.v.clone(),
            v: factors.u.clone(),
        };
        // The table with one joint displaced, and the change of J there.
        let table_at = |there: &Pose| {
            let mut change = there.jacobian_at(&vec![0.0; f]);
            change.add_multiple(-1.0, &here);
            let mut flat = Flat {
                kernel: flat.kernel.clone(),
                stresses: flat.stresses.clone(),
                clear: true,
            };
            let motion = factors.least_norm(rank, &change.times(&flat.kernel));
            let stress = turned.least_norm(rank, &change.transpose_times(&flat.stresses));
            flat.kernel.add_multiple(-1.0, &motion);
            flat.stresses.add_multiple(-1.0, &stress);
            (second_order_works(there, &flat), change)
        };
        let space = MotionSpace::new(&Reals, &mechanism.mode).ok()?;
        let (mut changes, mut moved) = (Vec::new(), 0.0);
        for c in known.inexact_coordinates(mechanism, &joints) {
            let at = |by: f64| {
                let frame = frame_with(mechanism, &c, c.written + by);
                table_at(&pose.with_frame(mechanism, &space, c.joint, &frame))
            };
            let step = STEP * c.scale;
            let ((mut up, mut up_by), (down, down_by)) = (at(step), at(-step));
            up.add_multiple(-1.0, &down);
            up_by.add_multiple(-1.0, &down_by);
            let part = known.times * c.half / (2.0 * step);
            moved += (part * up_by.norm()).powi(2);
            changes.push(Matrix::from_fn(up.nrows(), up.ncols(), |r, c| {
                part * up[(r, c)]
            }));
        }
        if moved.sqrt() > SMALL * least {
            return None;
        }
        let table = second_order_works(pose, &flat);
        Some(SecondOrder {
            quadrics: Quadrics::of_table(&table, motions, ZERO),
            table,
            changes,
            motions,
        })
    }

    /// Returns the maximum number of motions left for any rounding. It is 0 if the work of a combination of
    /// self-stresses is definite, and one less if any work is nonzero.
    pub(super) fn at_most(&self) -> usize {
        let stresses = self.quadrics.stresses();
        let definite = self
            .quadrics
            .definite_combination()
            .filter(|(weights, least)| {
                let stress: Vec<f64> = (0..self.table.nrows())
                    .map(|r| stresses.iter().zip(weights).map(|(s, w)| s[r] * w).sum())
                    .collect();
                *least > SAFE * self.change_of_form(&stress)
            });
        // As a row of the table, a form has size 1.
        let is_there = |stress: &Vec<f64>| SAFE * self.change_of_form(stress) < 0.5;
        match definite {
            Some(_) if self.motions > 0 => 0,
            _ => self.motions - usize::from(stresses.iter().any(is_there)),
        }
    }

    /// Returns the possible effect of rounding on the form of a self-stress.
    fn change_of_form(&self, stress: &[f64]) -> f64 {
        let one = |change: &Matrix| {
            let row = change.transpose_times(&Matrix::from_column(stress));
            tangent_cone::form_of_row(row.col(0), self.motions).norm()
        };
        self.changes.iter().map(one).sum()
    }

    /// Returns true if rounding can explain all the work.
    pub(super) fn may_vanish(&self) -> bool {
        let Some(factors) = svd(&self.table) else {
            return false;
        };
        (0..factors.values.len()).all(|k| {
            let (u, v) = (factors.u.col(k), factors.v.col(k));
            let one = |change: &Matrix| -> f64 {
                dot(change.transpose_times(&Matrix::from_column(u)).col(0), v)
            };
            let squares: f64 = self.changes.iter().map(|c| one(c).powi(2) / 3.0).sum();
            factors.values[k] <= ZERO.max(RARE * squares.sqrt())
        })
    }
}

/// Returns the mobility at a pose where not every first-order motion is finite, or `None` if this test does not decide.
/// `stopped` is the order that stops a motion in a random direction.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// O(n²) expansions to second order, and one of a line.
pub(super) fn mobility_at_singular(
    at: &ExactState<'_>,
    pose: &Pose,
    series: &HigherOrder,
    stopped: usize,
) -> Result<Option<Finite>, ExactError> {
    let n = at.mobility();
    let flat = Flat::new(pose, Some(n));
    let quadrics = Quadrics::new(pose, &flat);
    if quadrics.is_definite() {
        let (order, motions) = (2, n);
        return Ok(Some(Finite::new(0, How::Stopped { order, motions })));
    }
    let equations = group_dimensions(at)? - at.rank;
    if equations == 0 || equations >= n {
        return Ok(None);
    }
    let through = |order| Some(Finite::new(n - equations, How::Singular { order }));
    if equations == 1
        && let Some(order) = [Some(stopped), flat_line(series)]
            .into_iter()
            .flatten()
            .find(|order| order % 2 == 1)
    {
        return Ok(through(order));
    }
    let zeros = find_zeros(&quadrics, sparse_motions(&flat.kernel), start_directions(n));
    let crossing =
        quadrics.cross_at_zeros(equations, &zeros) && series.isolating_degree(equations).is_some();
    Ok(if crossing { through(2) } else { None })
}

/// Returns the order of the single equation along a line without second-order terms, bent to remove the fourth order if
/// possible. Returns `None` if there is no such line.
fn flat_line(series: &HigherOrder) -> Option<usize> {
    let (field, n) = series.free_coordinates();
    let kernel = linear_relations(field, &single_form(series)?);
    let weights: Vec<Residue> = (0..kernel.len())
        .map(|k| unrelated_number(field, k))
        .collect();
    let line = linear_combination(field, &kernel, &weights);
    if line.iter().all(|&x| x == 0) {
        return None;
    }
    let across: Vec<Residue> = (0..n).map(|k| unrelated_number(field, n + k)).collect();
    let along = |a: Residue| {
        let bent: Vec<Residue> = across.iter().map(|&x| field.mul(a, x)).collect();
        series.bent_line(&line, &bent, ORDER)
    };
    let straight = along(0);
    if straight.stopped != Some(4) {
        return straight.stopped;
    }
    // The fourth order is of second degree in a: c + b a + q a², a square if its discriminant is 0.
    let fourth = |a: Residue| match along(a) {
        Line {
            stopped: Some(4),
            value,
            ..
        } => value,
        _ => 0,
    };
    let (one, two) = (field.one(), field.from_i64(2));
    let (c, plus, minus) = (straight.value, fourth(one), fourth(field.neg(one)));
    let half = field.inv(two);
    let b = field.mul(half, field.sub(plus, minus));
    let q = field.sub(field.mul(half, field.add(plus, minus)), c);
    let square = field.mul(b, b) == field.mul(field.from_i64(4), field.mul(q, c));
    let bent = (q != 0 && square).then(|| field.neg(field.mul(b, field.inv(field.mul(two, q)))));
    bent.map_or(straight.stopped, |a| along(a).stopped)
}

/// Returns twice the matrix of the quadratic form of the single equation, or `None` if it has no second-order terms.
fn single_form(series: &HigherOrder) -> Option<Vec<Vec<Residue>>> {
    let (field, n) = series.free_coordinates();
    let unit = |set: &[usize]| -> Vec<Residue> {
        let one = |i: usize| if set.contains(&i) { field.one() } else { 0 };
        (0..n).map(one).collect()
    };
    let single: Vec<Vec<Residue>> = (0..n).map(|i| series.second_order(&unit(&[i]))).collect();
    // One form for each remaining row; all are multiples of one another.
    let mut forms = vec![vec![vec![0; n]; n]; single.first()?.len()];
    for i in 0..n {
        for j in 0..n {
            let both = if i == j {
                let twice = |&x: &Residue| field.mul(field.from_i64(4), x);
                single[i].iter().map(twice).collect()
            } else {
                series.second_order(&unit(&[i, j]))
            };
            for (k, form) in forms.iter_mut().enumerate() {
                form[i][j] = field.sub(field.sub(both[k], single[i][k]), single[j][k]);
            }
        }
    }
    let some = |form: &Vec<Vec<Residue>>| form.iter().flatten().any(|&x| x != 0);
    forms.into_iter().find(some)
}

/// Returns numbers unrelated to the geometry.
fn unrelated_number(field: Field, k: usize) -> Residue {
    field.from_i64(0x2545_f491_4f6c_dd1d_i64.wrapping_mul(2 * k as i64 + 1) >> 2)
}

/// Returns start directions for the search for zeros, spread evenly by the plastic numbers of that many dimensions.
fn start_directions(n: usize) -> Vec<Vec<f64>> {
    let share = |i: usize, k: usize| {
        let step = 1.0 / 1.220_744_084_6_f64.powi(1 + i32::try_from(k).unwrap_or(0));
        (0.5 + (i + 1) as f64 * step).fract() - 0.5
    };
    (0..40)
        .map(|i| (0..n).map(|k| share(i, k)).collect())
        .collect()
}
