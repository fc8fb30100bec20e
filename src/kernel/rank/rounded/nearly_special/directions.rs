//! Directions that are nearly parallel, perpendicular or coplanar to earlier directions.

use super::relation::Relation;
use crate::geom::exact_vector::{ExactVector, across, cross, is_zero};
use crate::geom::expr::Expr;
use crate::geom::vector::{self, Vector, dot, length, real, unit};
use crate::model::mechanism::JointId;

/// Minimum sine between two directions that define a plane.
const PLANE: f64 = 0.1;

/// An earlier direction.
struct Known {
    exact: ExactVector,
    unit: Vector,
    /// The joint it belongs to, or `None` for the global axes and the normal of a plane.
    joint: Option<JointId>,
}

/// The exact directions collected so far.
pub(super) struct Directions {
    known: Vec<Known>,
    /// Maximum turn of a direction. `[rad]`
    angle: f64,
}

/// The new direction, if it changes.
pub(super) type Placed = Option<(ExactVector, Relation, Option<JointId>)>;

fn sine(a: Vector, b: Vector) -> f64 {
    length(vector::cross(a, b))
}

impl Directions {
    /// Creates a collection of the global axes, after the normal of the plane of motion if there is one.
    pub(super) fn new(angle: f64, normal: Option<&ExactVector>) -> Directions {
        let axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|a| a.map(Expr::from));
        let known = normal.cloned().into_iter().chain(axes);
        Directions {
            known: known
                .map(|exact| Known {
                    unit: unit(real(&exact)),
                    exact,
                    joint: None,
                })
                .collect(),
            angle,
        }
    }

    /// Returns the exact direction that the direction `d` of a joint is within reach of, with the relation used.
    pub(super) fn place(&mut self, d: &ExactVector, joint: JointId) -> Placed {
        let v = unit(real(d));
        if let Some((k, _)) = self
            .known
            .iter()
            .map(|k| (k, sine(k.unit, v)))
            .filter(|(_, s)| *s <= self.angle)
            .min_by(|a, b| a.1.total_cmp(&b.1))
        {
            let same = is_zero(&cross(&k.exact, d));
            return (!same).then(|| (k.exact.clone(), Relation::Parallel, k.joint));
        }
        let found = self.square(d, v).or_else(|| self.in_plane(d, v));
        let exact = found.as_ref().map_or(d, |(exact, ..)| exact).clone();
        self.known.push(Known {
            unit: unit(real(&exact)),
            exact,
            joint: Some(joint),
        });
        found.filter(|(exact, ..)| !is_zero(&cross(exact, d)))
    }

    /// Returns the direction perpendicular to two known directions, or to one.
    fn square(&self, d: &ExactVector, v: Vector) -> Placed {
        let near = |k: &&Known| dot(k.unit, v).abs() <= self.angle;
        let square: Vec<&Known> = self.known.iter().filter(near).collect();
        let first = square.first()?;
        let second = square.iter().find(|k| sine(first.unit, k.unit) > PLANE);
        let both = second.map(|k| cross(&first.exact, &k.exact));
        let exact = both
            .filter(|exact| sine(unit(real(exact)), v) <= self.angle)
            .unwrap_or_else(|| across(d, &first.exact));
        let named = square.iter().find_map(|k| k.joint);
        Some((exact, Relation::Square, named))
    }

    /// Returns the direction in the plane of two known directions of joints.
    fn in_plane(&self, d: &ExactVector, v: Vector) -> Placed {
        let own: Vec<&Known> = self.known.iter().filter(|k| k.joint.is_some()).collect();
        for (n, a) in own.iter().enumerate() {
            for b in &own[..n] {
                let normal = vector::cross(a.unit, b.unit);
                if length(normal) > PLANE && dot(unit(normal), v).abs() <= self.angle {
                    let exact = across(d, &cross(&a.exact, &b.exact));
                    return Some((exact, Relation::InPlane, a.joint));
                }
            }
        }
        None
    }
}
