//! The written directions of a scene, with parallel ones merged.

use super::consensus::{Refined, refined, square_to};
use super::written::{Ray, pairs};
use crate::geom::vector::{Vector, X, Y, Z, add_scaled, cross, dot, length, scale, unit};

/// Maximum move of a direction's components, in halves of their last digit. Such a direction is fitted, not solved for.
pub(crate) const WITHIN: f64 = 1.1;

/// Rules for accepting relations.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Caution {
    /// Factor by which moves may be larger.
    pub(crate) bold: f64,
    /// Whether relations count that may exist by chance.
    pub(crate) weak: bool,
}

/// A direction of a scene.
#[derive(Debug, Clone)]
pub(super) struct Direction {
    pub(super) unit: Vector,
    /// Its possible error `[rad]`.
    pub(super) error: f64,
    /// Number of rays with this direction; 0 if only points define it.
    pub(super) rays: usize,
    /// The ray that gives it exactly, if it is written exactly.
    pub(super) exact: Option<usize>,
    /// Whether it is the normal of a plane of points.
    pub(super) plane: bool,
    /// Two axes of possible turns, with the error of each `[rad]`.
    pub(super) tilts: [(Vector, f64); 2],
}

/// Directions, and the direction and sign of each ray.
pub(super) struct Directions {
    pub(super) all: Vec<Direction>,
    pub(super) of_ray: Vec<(usize, f64)>,
}

/// Merges rays that are parallel within their errors into one direction, refined by the points.
pub(super) fn of_rays(rays: &[Ray], points: &[Vector], errors: &[f64]) -> Directions {
    let pairs = pairs(points, errors);
    let mut order: Vec<usize> = (0..rays.len()).collect();
    // The most accurate come first, so that others are compared with them.
    order.sort_by(|&a, &b| rays[a].error().total_cmp(&rays[b].error()));
    let (mut all, mut of_ray) = (Vec::<Direction>::new(), vec![(0, 1.0); rays.len()]);
    let mut sums: Vec<(Vector, f64)> = Vec::new();
    for i in order {
        let (v, error) = (rays[i].unit(), rays[i].error());
        let near = |d: &Direction| length(cross(d.unit, v)) <= 1.05 * (d.error + error);
        let nearest = |a: &usize, b: &usize| {
            let off = |k: &usize| length(cross(all[*k].unit, v));
            off(a).total_cmp(&off(b))
        };
        let known = (0..all.len()).filter(|&k| near(&all[k])).min_by(nearest);
        if let Some(k) = known {
            let sign = dot(all[k].unit, v).signum();
            of_ray[i] = (k, sign);
            all[k].rays += 1;
            if error > 0.0 {
                let weight = error.powi(-2);
                let (sum, of) = &mut sums[k];
                *sum = add_scaled(*sum, sign * weight, v);
                *of += weight;
            }
        } else {
            of_ray[i] = (all.len(), 1.0);
            all.push(Direction {
                unit: v,
                error,
                rays: 1,
                exact: rays[i].is_exact().then_some(i),
                plane: false,
                tilts: square_to(v).map(|e| (e, error)),
            });
            let weight = if error > 0.0 { error.powi(-2) } else { 0.0 };
            sums.push((scale(v, weight), weight));
        }
    }
    for (k, (d, (sum, _))) in all.iter_mut().zip(sums).enumerate() {
        if d.exact.is_some() {
            continue;
        }
        let own: Vec<&Ray> = rays
            .iter()
            .zip(&of_ray)
            .filter(|r| r.1.0 == k)
            .map(|r| r.0)
            .collect();
        let allowed = |v: Vector| own.iter().all(|r| r.moved(v, 0.0) <= WITHIN);
        let Refined { unit, error, tilts } = refined(unit(sum), d.error, &pairs, allowed);
        (d.unit, d.error, d.tilts) = (unit, error, tilts);
    }
    Directions { all, of_ray }
}

impl Direction {
    /// Creates a direction defined by points.
    pub(super) fn of_points(unit: Vector, error: f64) -> Direction {
        Direction {
            unit,
            error,
            rays: 0,
            exact: None,
            plane: false,
            tilts: square_to(unit).map(|e| (e, error)),
        }
    }
}

impl Directions {
    /// Adds the file's own axes as exact directions, if they are missing.
    pub(super) fn add_axes(&mut self) {
        for e in [X, Y, Z] {
            if self.all.iter().any(|d| length(cross(d.unit, e)) == 0.0) {
                continue;
            }
            self.all.push(Direction::of_points(e, 0.0));
        }
    }
}
