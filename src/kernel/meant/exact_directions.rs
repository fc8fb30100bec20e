//! Directions made exact one after another: each lies in the planes that earlier ones span or are square to, where it does so
//! within its error: no such plane and it is free, one and it is kept in it, two and it is where they meet.

use super::directions::Direction;
use super::number::{Rational3, axes, cross, decimal, is_zero, scaled, to_f64};
use crate::geom::vector::{Vector, cross as cross_f64, dot, length, unit};
use num_traits::Zero;

/// A direction, exact in the scene's frame.
#[derive(Debug, Clone)]
pub(super) struct Exact {
    pub(super) exact: Rational3,
    pub(super) unit: Vector,
    /// What it may still be off from the truth `[rad]`: what was not told by other directions.
    pub(super) error: f64,
}

impl Exact {
    /// An axis of the frame.
    pub(super) fn of_axis(exact: Rational3) -> Exact {
        Exact::new(exact, 0.0)
    }

    /// One instead of another that is near.
    pub(super) fn near(exact: Rational3, other: &Exact) -> Exact {
        Exact::new(exact, other.error)
    }

    fn new(exact: Rational3, error: f64) -> Exact {
        let unit = unit(to_f64(&exact));
        Exact { exact, unit, error }
    }
}

/// Relations of directions hold to this by now.
const TOGETHER: f64 = 1e-12;
/// What doubles leave of a plane that two directions span.
const ROUND_OFF: f64 = 1e-14;
/// Planes are told apart by this sine.
const APART: f64 = 1e-4;

/// Exact directions of a scene, in the order of `all`; `inside` turns to the scene's frame, `written` gives those that are
/// written exactly.
pub(super) fn exact(
    all: &[Direction],
    inside: impl Fn(Vector) -> Vector,
    written: impl Fn(usize) -> Rational3,
    digits: u32,
) -> Vec<Exact> {
    let mut order: Vec<usize> = (0..all.len()).collect();
    // The best known first, for they move least.
    order.sort_by(|&a, &b| {
        all[a]
            .error
            .total_cmp(&all[b].error)
            .then(all[b].rays.cmp(&all[a].rays))
    });
    let mut fixed: Vec<Exact> = axes().map(|e| Exact::new(e, 0.0)).to_vec();
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
        // What is in a plane is so to rounding by now.
        let found = placed(v, TOGETHER, &fixed, digits);
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

/// A direction near one, in the planes that fixed ones make.
pub(super) fn placed(v: Vector, error: f64, fixed: &[Exact], digits: u32) -> Exact {
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
    let planes = offered(v, error, fixed);
    let first = planes.first();
    let second = first.and_then(|f| {
        planes
            .iter()
            .find(|p| length(cross_f64(f.normal, p.normal)) > APART.max(3.0 * error))
    });
    match (first, second) {
        (Some(a), Some(b)) => {
            let first = a.exact(fixed);
            let meet = scaled(cross(&first, &b.exact(fixed)));
            let along = dot(to_f64(&meet), v);
            let meet = if along < 0.0 { meet.map(|x| -x) } else { meet };
            let of = Exact::new(meet, error.min(1e-15));
            let sine = length(cross_f64(a.normal, b.normal));
            if length(cross_f64(of.unit, v)) <= 2.0 * a.within.max(b.within) / sine {
                return of;
            }
            in_plane(v, &first, error, digits)
        }
        (Some(a), None) => in_plane(v, &a.exact(fixed), error, digits),
        _ => free(v, error, digits),
    }
}

/// Planes that a direction may lie in, those it fits best first.
fn offered(v: Vector, error: f64, fixed: &[Exact]) -> Vec<OfferedPlane> {
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
    // Square to two frame axes is an axis, told above; squares before spans, then by how well it fits.
    planes.sort_by(|a, b| a.off.total_cmp(&b.off));
    planes
}

/// A plane that a direction may lie in.
struct OfferedPlane {
    /// The two directions that span it; one twice is its normal.
    of: [usize; 2],
    normal: Vector,
    off: f64,
    /// What it may be off by.
    within: f64,
}

impl OfferedPlane {
    /// The normal, exact. Its numbers are long, so that it is made of those alone that are taken.
    fn exact(&self, fixed: &[Exact]) -> Rational3 {
        let [i, j] = self.of;
        if i == j {
            fixed[i].exact.clone()
        } else {
            cross(&fixed[i].exact, &fixed[j].exact)
        }
    }
}

fn free(v: Vector, error: f64, digits: u32) -> Exact {
    Exact::new(v.map(|x| decimal(x, digits)), error.max(last(digits)))
}

/// What a direction of so many decimals is off by.
fn last(digits: u32) -> f64 {
    10f64.powi(-i32::try_from(digits).unwrap_or(i32::MAX))
}

/// A rational direction near one, square to a normal.
fn in_plane(v: Vector, normal: &Rational3, error: f64, digits: u32) -> Exact {
    let n = to_f64(normal);
    let i = (0..3)
        .max_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs()))
        .unwrap_or(0);
    let mut w = v.map(|x| decimal(x, digits));
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    if normal[i].is_zero() {
        return free(v, error, digits);
    }
    w[i] = -(&w[j] * &normal[j] + &w[k] * &normal[k]) / &normal[i];
    if is_zero(&w) {
        return free(v, error, digits);
    }
    Exact::new(w, error.max(last(digits)))
}
