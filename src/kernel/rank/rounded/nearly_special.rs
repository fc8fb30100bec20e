//! Joints that are nearly special: axes that are almost parallel, perpendicular, coaxial or concurrent, with the
//! relation and the deviation from it.

use crate::format::four_digits;
use crate::geom::vector::{
    Vector, X, Y, Z, across, add_scaled, cross, dot, length, sub, to_vector, unit,
};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Joint, JointId, Mechanism, Mode};
use crate::model::rounded::looks_rounded;
use crate::rank::rounded::mechanism_size;
use crate::rank::rounded::verdict::allowed_uncertainty;
use itertools::Itertools;

/// Minimum sine between two directions that define a plane.
const PLANE: f64 = 0.1;
/// Minimum sine between two lines that may meet. Below it, the position of the crossing is too uncertain.
const SKEW: f64 = 1e-2;
/// Deviations caused by the rounding of doubles, in radians and sizes of the mechanism.
const ROUND_OFF: f64 = 1e-12;

/// Maximum deviation of a joint from a special position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Deviation of its point or line, in the file's unit of length.
    pub length: f64,
    /// Deviation of its axes `[rad]`.
    pub angle: f64,
}

impl Reach {
    /// Returns a reach relative to the size of a mechanism: radians, and fractions of the size.
    #[must_use]
    pub fn relative(tolerance: f64, size: f64) -> Reach {
        Reach {
            length: tolerance * size,
            angle: tolerance,
        }
    }
}

/// Special position of a joint, relative to another joint if there is one. The one that states most comes last.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Relation {
    /// Its axis is in one plane with two others.
    InPlane,
    /// Its axis is perpendicular to another.
    Square,
    /// Its axis is parallel to another, or to a global axis.
    Parallel,
    /// Its axis or centre passes through a common point with another.
    Meeting,
    /// Its centre is the same point as another.
    Concentric,
    /// Its axis is the same line as another.
    Coaxial,
}

/// A joint that is nearly special.
#[derive(Debug, Clone, PartialEq)]
pub struct NearJoint {
    /// The joint.
    pub joint: JointId,
    /// Deviation of its line or centre, in the file's unit of length.
    pub shift: f64,
    /// Deviation of its axes `[rad]`.
    pub turn: f64,
    /// The special positions, and the joints they refer to.
    pub relations: Vec<(Relation, Option<JointId>)>,
}

impl NearJoint {
    /// Returns the deviation: "0.002 degrees and 0.13 mm".
    #[must_use]
    pub fn describe_deviation(&self, m: &Mechanism) -> String {
        let small = |x: f64| match x {
            1e-4..1e4 => four_digits(x),
            _ => format!("{x:.1e}"),
        };
        let turn = (self.turn > 0.0).then(|| format!("{} degrees", small(self.turn.to_degrees())));
        let shift =
            (self.shift > 0.0).then(|| format!("{} {}", small(self.shift), m.length_unit.symbol));
        turn.into_iter().chain(shift).join(" and ")
    }
}

/// Returns how far the rounding of coordinates can have moved two joints of a mechanism apart, or `None` if its digits
/// are exact.
///
/// # Examples
/// ```
/// use ozols::rank::rounded::nearly_special::rounding_reach;
/// assert!(rounding_reach(&ozols::built_in("bennett")?).is_none()); // It is exact.
/// assert!(rounding_reach(&ozols::built_in("jansen-leg")?).is_some_and(|r| r.length == 0.02));
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn rounding_reach(mechanism: &Mechanism) -> Option<Reach> {
    let half = allowed_uncertainty(mechanism, looks_rounded(mechanism).as_ref())?;
    let [length, direction] = half.largest_half_units(mechanism).map(|h| 2.0 * h);
    let size = mechanism_size(mechanism);
    Some(Reach {
        length: 2.0 * (length + size * direction),
        angle: 2.0 * direction.max(length / size),
    })
}

/// Returns the joints that are nearly special, in file order. Their directions are within the angle of an earlier one
/// or of a right angle. Their lines and centres are within the length of an earlier one. Deviations that doubles
/// cannot distinguish from none do not count.
///
/// # Guarantee
/// No deviation exceeds the reach.
///
/// # Complexity
/// O(p³) in the number of joints p.
#[must_use]
pub fn nearly_special(mechanism: &Mechanism, reach: Reach) -> Vec<NearJoint> {
    let near = |joint| NearJoint {
        joint,
        shift: 0.0,
        turn: 0.0,
        relations: Vec::new(),
    };
    let mut out: Vec<NearJoint> = mechanism.joint_ids().map(near).collect();
    let mut directions = Directions::new(mechanism, reach.angle);
    let mut axes: Vec<Vector> = Vec::new();
    for (joint, near) in mechanism.joints.iter().zip(&mut out) {
        let axis = unit(to_vector(&joint.frame.axis));
        axes.push(if joint.joint_type.is_directed() {
            directions.place_direction(axis, near)
        } else {
            axis
        });
    }
    for (joint, near) in mechanism.joints.iter().zip(&mut out) {
        if joint.joint_type.has_second_axis() {
            let axis = unit(to_vector(&joint.frame.axis));
            directions.place_direction(unit(across(to_vector(&joint.frame.reference), axis)), near);
        }
    }
    let least = ROUND_OFF * mechanism_size(mechanism);
    let mut places: Vec<Place> = Vec::new();
    for ((joint, near), axis) in mechanism.joints.iter().zip(&mut out).zip(axes) {
        places.extend(Place::of_joint(joint, near.joint, axis));
        let Some((own, earlier)) = places.split_last().filter(|(p, _)| p.joint == near.joint)
        else {
            continue;
        };
        let found = earlier.iter().filter_map(|other| {
            let (relation, shift) = own.relation_to(other)?;
            (shift <= reach.length).then_some((relation, shift, other.joint))
        });
        let strongest = found.max_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let inexact = |(relation, shift, _): &(Relation, f64, _)| {
            *shift > least || (*relation == Relation::Coaxial && near.turn > ROUND_OFF)
        };
        if let Some((relation, shift, other)) = strongest.filter(inexact) {
            near.relations.push((relation, Some(other)));
            near.shift = shift;
        }
    }
    out.retain(|x| x.turn > ROUND_OFF || x.shift > least);
    out
}

/// The directions collected so far, with their joints: none for the global axes and the normal of a plane.
struct Directions {
    known: Vec<(Vector, Option<JointId>)>,
    /// Maximum turn of a direction. `[rad]`
    angle: f64,
}

/// A special direction, the relation it has, and the joint it refers to.
type Special = (Vector, Relation, Option<JointId>);

fn sine_between(a: Vector, b: Vector) -> f64 {
    length(cross(a, b))
}

impl Directions {
    fn new(mechanism: &Mechanism, angle: f64) -> Directions {
        let normal = match &mechanism.mode {
            Mode::Spatial => None,
            Mode::Planar { normal } => Some(unit(to_vector(normal))),
        };
        let known = normal.into_iter().chain([X, Y, Z]);
        Directions {
            known: known.map(|v| (v, None)).collect(),
            angle,
        }
    }

    /// Returns the special direction that a unit vector of a joint is within the angle of, or the vector itself, and
    /// records its relation and the turn.
    fn place_direction(&mut self, v: Vector, near: &mut NearJoint) -> Vector {
        let parallel = self.known.iter().map(|k| (k, sine_between(k.0, v)));
        let parallel = parallel.filter(|(_, s)| *s <= self.angle);
        let parallel = parallel.min_by(|a, b| a.1.total_cmp(&b.1));
        let special: Option<Special> = match parallel {
            Some((&(u, joint), _)) => Some((u, Relation::Parallel, joint)),
            None => {
                let found = self.square_to_known(v).or_else(|| self.in_plane(v));
                let own = found.map_or(v, |(u, ..)| u);
                self.known.push((own, Some(near.joint)));
                found
            }
        };
        let Some((u, relation, joint)) = special else {
            return v;
        };
        let turn = sine_between(u, v).min(1.0).asin();
        if turn > ROUND_OFF {
            near.turn = near.turn.max(turn);
            near.relations.push((relation, joint));
        }
        u
    }

    /// Returns the direction perpendicular to two known directions, or to one.
    fn square_to_known(&self, v: Vector) -> Option<Special> {
        let square = self
            .known
            .iter()
            .filter(|k| dot(k.0, v).abs() <= self.angle);
        let square: Vec<&(Vector, Option<JointId>)> = square.collect();
        let first = square.first()?.0;
        let second = square.iter().find(|k| sine_between(first, k.0) > PLANE);
        let both = second.map(|k| unit(cross(first, k.0)));
        let special = both
            .filter(|u| sine_between(*u, v) <= self.angle)
            .unwrap_or_else(|| unit(across(v, first)));
        Some((special, Relation::Square, square.iter().find_map(|k| k.1)))
    }

    /// Returns the direction in the plane of two known directions of joints.
    fn in_plane(&self, v: Vector) -> Option<Special> {
        let own = self.known.iter().filter(|k| k.1.is_some());
        own.tuple_combinations().find_map(|(a, b)| {
            let normal = cross(a.0, b.0);
            let near = length(normal) > PLANE && dot(unit(normal), v).abs() <= self.angle;
            near.then(|| (unit(across(v, unit(normal))), Relation::InPlane, b.1))
        })
    }
}

/// The relevant part of a joint's position: the line of its axis, or its point.
struct Place {
    joint: JointId,
    point: Vector,
    /// Direction of the line, or `None` for a point.
    along: Option<Vector>,
}

impl Place {
    /// Returns the place of a joint whose axis is this special direction, or `None` if the joint only slides.
    fn of_joint(joint: &Joint, id: JointId, axis: Vector) -> Option<Place> {
        let turns = |f: &&Freedom| f.is_turn() || **f == Freedom::Screw;
        let turning: Vec<&Freedom> = joint.joint_type.freedoms().iter().filter(turns).collect();
        let along = match turning[..] {
            [] => return None,
            [Freedom::Rz | Freedom::Screw] => Some(axis),
            _ => None,
        };
        Some(Place {
            joint: id,
            point: to_vector(&joint.frame.point),
            along,
        })
    }

    /// Returns the relation that this place has to another if their distance is none, and that distance. Returns
    /// `None` for parallel lines that are no longer the same, and for lines whose crossing is uncertain.
    fn relation_to(&self, other: &Place) -> Option<(Relation, f64)> {
        let off = sub(self.point, other.point);
        let from = |u: Vector| length(add_scaled(off, -dot(off, u), u));
        Some(match (self.along, other.along) {
            (None, None) => (Relation::Concentric, length(off)),
            (Some(u), None) | (None, Some(u)) => (Relation::Meeting, from(u)),
            (Some(u), Some(w)) => {
                let normal = cross(u, w);
                match length(normal) {
                    s if s <= ROUND_OFF => (Relation::Coaxial, from(w)),
                    s if s > SKEW => (Relation::Meeting, dot(off, normal).abs() / s),
                    _ => return None,
                }
            }
        })
    }
}
