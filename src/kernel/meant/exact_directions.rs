//! Directions made exact one after another. Each may lie, within its error, in planes that earlier directions span or
//! are normal to. Without such a plane it is free, with one it is kept in it, and with two it is their intersection.

use super::directions::Direction;
use super::number::{Rational3, cross, frame_axes, is_zero, nearest_decimal, scale_to_one, to_f64};
use crate::geom::vector::{Vector, cross as cross_f64, dot, length, unit};
use num_traits::Zero;

/// A direction that is exact in the scene's frame.
#[derive(Debug, Clone)]
pub(super) struct Exact {
    pub(super) exact: Rational3,
    pub(super) unit: Vector,
    /// Its remaining error `[rad]`, in what other directions did not determine.
    pub(super) error: f64,
}

impl Exact {
    /// Creates a direction with its error `[rad]`.
    pub(super) fn new(exact: Rational3, error: f64) -> Exact {
        let unit = unit(to_f64(&exact));
        Exact { exact, unit, error }
    }
}

/// Accuracy to which relations between directions hold at this stage.
const TOGETHER: f64 = 1e-12;
/// Rounding error of a plane that two directions span.
const ROUND_OFF: f64 = 1e-14;
/// Minimum sine between distinct planes.
const APART: f64 = 1e-4;

/// Returns the exact directions of a scene, in the order of `all`. `inside` rotates to the scene's frame, `written`
/// gives those that are written exactly.
pub(super) fn make_exact(
    all: &[Direction],
    inside: impl Fn(Vector) -> Vector,
    written: impl Fn(usize) -> Rational3,
    digits: u32,
) -> Vec<Exact> {
    let mut order: Vec<usize> = (0..all.len()).collect();
    // The most accurate come first, because they move least.
    order.sort_by(|&a, &b| {
        all[a]
            .error
            .total_cmp(&all[b].error)
            .then(all[b].rays.cmp(&all[a].rays))
    });
    let mut fixed: Vec<Exact> = frame_axes().map(|e| Exact::new(e, 0.0)).to_vec();
    let mut out: Vec<Option<Exact>> = vec![None; all.len()];
    for k in order {
        let d = &all[k];
        if let Some(ray) = d.exact {
            let of = Exact::new(written(ray), 0.0);
            fixed.push(of.clone());
            out[k] = Some(of);
            continue;
        }
        let v = inside(d.unit);
        // A direction in a plane lies in it up to rounding at this stage.
        let found = place_direction(v, TOGETHER, &fixed, digits);
        if !fixed
            .iter()
            .any(|f| length(cross_f64(f.unit, found.unit)) == 0.0)
        {
            fixed.push(found.clone());
        }
        out[k] = Some(found);
    }
    out.into_iter().flatten().collect()
}

/// Returns a direction near `v`, in the planes that fixed ones define.
pub(super) fn place_direction(v: Vector, error: f64, fixed: &[Exact], digits: u32) -> Exact {
    if let Some(same) = fixed
        .iter()
        .find(|f| length(cross_f64(f.unit, v)) <= 1.1 * (error + f.error))
    {
        let sign = dot(same.unit, v);
        let exact = if sign < 0.0 {
            same.exact.clone().map(|x| -x)
        } else {
            same.exact.clone()
        };
        return Exact::new(exact, same.error);
    }
    let planes = planes_offered(v, error, fixed);
    let first = planes.first();
    let second = first.and_then(|f| {
        planes
            .iter()
            .find(|p| length(cross_f64(f.normal, p.normal)) > APART.max(3.0 * error))
    });
    match (first, second) {
        (Some(a), Some(b)) => {
            let first = a.exact_normal(fixed);
            let meet = scale_to_one(cross(&first, &b.exact_normal(fixed)));
            let along = dot(to_f64(&meet), v);
            let meet = if along < 0.0 { meet.map(|x| -x) } else { meet };
            let of = Exact::new(meet, error.min(1e-15));
            let sine = length(cross_f64(a.normal, b.normal));
            if length(cross_f64(of.unit, v)) <= 2.0 * a.within.max(b.within) / sine {
                return of;
            }
            in_plane(v, &first, error, digits)
        }
        (Some(a), None) => in_plane(v, &a.exact_normal(fixed), error, digits),
        _ => place_freely(v, error, digits),
    }
}

/// Returns the planes in which a direction may lie, best fit first.
fn planes_offered(v: Vector, error: f64, fixed: &[Exact]) -> Vec<OfferedPlane> {
    let mut planes: Vec<OfferedPlane> = Vec::new();
    let mut offer = |of: [usize; 2], normal: Vector, slack: f64| {
        let off = dot(normal, v).abs();
        let within = error + slack;
        if off <= 1.1 * within {
            planes.push(OfferedPlane {
                of,
                normal,
                off,
                within,
            });
        }
    };
    for (i, a) in fixed.iter().enumerate() {
        offer([i, i], a.unit, a.error);
        for (j, b) in fixed[..i].iter().enumerate() {
            let normal = cross_f64(a.unit, b.unit);
            let sine = length(normal);
            if sine > 0.01 {
                offer([i, j], unit(normal), (a.error + b.error) / sine + ROUND_OFF);
            }
        }
    }
    // A direction perpendicular to two frame axes is an axis, handled above. Normal planes come before spans, then by
    // fit.
    planes.sort_by(|a, b| a.off.total_cmp(&b.off));
    planes
}

/// A plane that a direction may lie in.
struct OfferedPlane {
    /// The two directions that span it; a single direction given twice is its normal.
    of: [usize; 2],
    normal: Vector,
    off: f64,
    /// Its tolerance.
    within: f64,
}

impl OfferedPlane {
    /// Returns the exact normal. Its numbers are long, so it is computed only for accepted planes.
    fn exact_normal(&self, fixed: &[Exact]) -> Rational3 {
        let [i, j] = self.of;
        if i == j {
            fixed[i].exact.clone()
        } else {
            cross(&fixed[i].exact, &fixed[j].exact)
        }
    }
}

fn place_freely(v: Vector, error: f64, digits: u32) -> Exact {
    Exact::new(
        v.map(|x| nearest_decimal(x, digits)),
        error.max(last_digit_error(digits)),
    )
}

/// Returns the error of a direction with this many decimals.
fn last_digit_error(digits: u32) -> f64 {
    10f64.powi(-i32::try_from(digits).unwrap_or(i32::MAX))
}

/// Returns a rational direction near `v` and perpendicular to a normal.
fn in_plane(v: Vector, normal: &Rational3, error: f64, digits: u32) -> Exact {
    let n = to_f64(normal);
    let i = (0..3)
        .max_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs()))
        .unwrap_or(0);
    let mut w = v.map(|x| nearest_decimal(x, digits));
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    if normal[i].is_zero() {
        return place_freely(v, error, digits);
    }
    w[i] = -(&w[j] * &normal[j] + &w[k] * &normal[k]) / &normal[i];
    if is_zero(&w) {
        return place_freely(v, error, digits);
    }
    Exact::new(w, error.max(last_digit_error(digits)))
}
