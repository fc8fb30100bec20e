//! A joint of an assembly at a pose: its type, and its frame on I and on J. The two differ by the misfit.

use crate::robots::cad::holds::Holds;
use crate::robots::prelude::*;

/// Sines and lengths below this have no direction.
const FLAT: f64 = 1e-6;

/// A joint at its place in the world.
#[derive(Debug, Clone)]
pub(crate) struct Meeting {
    pub(super) kind: JointType,
    /// The joint's frame by I.
    pub(super) near: RigidMotion,
    /// The joint's frame by J; equal to that by I if the two fit.
    pub(super) far: RigidMotion,
    /// Translation per radian of a screw.
    pub(super) pitch: f64,
    /// Whether the type is valid at this pose only, because the constrained directions move with the parts.
    pub(super) here_only: bool,
}

/// A joint, or the reason why there is none.
type Met = Result<Meeting, &'static str>;

/// Returns a frame at a point, with a z and an x made perpendicular to it.
fn make_frame(point: Vector, z: Vector, x: Vector) -> RigidMotion {
    let z = unit_or_z(z);
    let x = sub(x, scale(z, dot(x, z)));
    let x = if length(x) > FLAT {
        unit_or_z(x)
    } else {
        perpendicular(z)
    };
    let y = cross(z, x);
    RigidMotion {
        rotation: [0, 1, 2].map(|i| [x[i], y[i], z[i]]),
        translation: point,
    }
}

fn frame_axis(m: &RigidMotion, k: usize) -> Vector {
    m.rotation.map(|row| row[k])
}

/// Returns a frame rotated by the smallest angle so that its z is a given direction.
fn tilt_to(m: &RigidMotion, z: Vector) -> RigidMotion {
    let from = frame_axis(m, 2);
    let about = cross(from, z);
    let turn = match length(about) {
        sine if sine > 0.0 => RigidMotion::from_turn(about, sine.atan2(dot(from, z))),
        _ => RigidMotion::IDENTITY,
    };
    at_point(turn.then(&at_point(*m, [0.0; 3])), m.translation)
}

/// Returns a frame moved to a point.
fn at_point(m: RigidMotion, translation: Vector) -> RigidMotion {
    RigidMotion { translation, ..m }
}

/// Returns the orientation of J that is nearest to I among those along the same lines: a cosine of 0 also holds for a flipped
/// part.
fn nearest_frame(i: &RigidMotion, j: &RigidMotion) -> RigidMotion {
    let [x, y] = [0, 1].map(|k| {
        let a = frame_axis(j, k);
        scale(a, dot(a, frame_axis(i, k)).signum())
    });
    make_frame([0.0; 3], cross(x, y), x)
}

/// Returns the joint that connects two frames at their pose, given in the world.
///
/// # Errors
/// Returns the reason, in words, if it constrains nothing that can be determined at this pose.
pub(crate) fn find_meeting(holds: Holds, i: &RigidMotion, j: &RigidMotion) -> Met {
    use Freedom::{Rx, Ry, Rz, Tx, Ty, Tz};
    let custom = |freedoms: &[Freedom]| JointType::Custom(freedoms.to_vec());
    let (x, z) = (frame_axis(i, 0), frame_axis(i, 2));
    let (oi, oj) = (i.translation, j.translation);
    let d = sub(oj, oi);
    let along = dot(d, z);
    let foot = add_scaled(d, -along, z);
    // J's z in the sense of I's.
    let zj = frame_axis(j, 2);
    let zj = scale(zj, if dot(zj, z) < 0.0 { -1.0 } else { 1.0 });
    let at = |point| make_frame(point, z, x);
    let tilted = |point| tilt_to(&at(point), zj);
    let as_j = |point| at_point(nearest_frame(i, j), point);
    let simple = Meeting::new;
    Ok(match holds {
        Holds::Fixed => simple(JointType::Fixed, at(oi), as_j(oj)),
        Holds::Revolute => simple(JointType::Revolute, at(oi), tilted(oj)),
        Holds::Translational => simple(JointType::Prismatic, at(oi), as_j(add(oi, foot))),
        Holds::Cylindrical => simple(JointType::Cylindrical, at(oi), tilted(add(oi, foot))),
        Holds::Spherical => simple(JointType::Spherical, at(oi), at(oj)),
        Holds::PointInLine => simple(JointType::SphereInCylinder, at(sub(oj, foot)), at(oj)),
        Holds::ParallelAxes => simple(custom(&[Rz, Tx, Ty, Tz]), at(oi), tilted(oi)),
        Holds::NoRotation => simple(custom(&[Tx, Ty, Tz]), at(oi), as_j(oi)),
        Holds::Planar(offset) => {
            let meets_at = add_scaled(oj, offset - along, z);
            simple(JointType::Planar, at(meets_at), tilted(oj))
        }
        Holds::PointInPlane(offset) => {
            let meets_at = add_scaled(oj, offset - along, z);
            simple(JointType::SphereOnPlane, at(meets_at), at(oj))
        }
        Holds::Universal | Holds::LineInPlane(_) => square_joint(holds, i, j)?,
        Holds::ConstantVelocity => constant_velocity_joint(i, j)?,
        Holds::Angle(cosine) => angle_joint(i, j, cosine)?,
        Holds::PointPoint(_) | Holds::PointLine(_) | Holds::LineLine(_) | Holds::Hinges(_) => {
            distance_joint(holds, i, j)?
        }
        Holds::Gear(radii) => gear_joint(i, j, radii)?,
        Holds::RackPinion(radius) => {
            // The teeth meet where the pinion's pitch circle touches the rack's line.
            let point = add_scaled(oj, -radius, frame_axis(i, 1));
            let there = make_frame(point, x, z);
            at_this_pose(Meeting::new(JointType::SphereOnPlane, there, there))
        }
        Holds::Screw(lead) => {
            let kind = custom(&[Freedom::Screw, Rx, Ry, Tx, Ty]);
            Meeting {
                pitch: lead / std::f64::consts::TAU,
                ..at_this_pose(Meeting::new(kind, at(oj), at(oj)))
            }
        }
    })
}

impl Meeting {
    /// Returns a joint that is the same in any pose.
    pub(super) fn new(kind: JointType, near: RigidMotion, far: RigidMotion) -> Meeting {
        Meeting {
            kind,
            near,
            far,
            pitch: 0.0,
            here_only: false,
        }
    }
}

fn at_this_pose(mut m: Meeting) -> Meeting {
    m.here_only = true;
    m
}

/// Returns the joint that keeps two z axes perpendicular and the origins together, or J's line in a plane: z is I's, x is J's z.
fn square_joint(holds: Holds, i: &RigidMotion, j: &RigidMotion) -> Met {
    let (z, line, oj) = (frame_axis(i, 2), frame_axis(j, 2), j.translation);
    if length(cross(z, line)) < FLAT {
        return Err("its two axes are parallel, but must be at a right angle");
    }
    // J's frame has its own x, and a z as near to I's as this allows.
    let across = cross(line, cross(z, line));
    let far = make_frame(oj, across, line);
    Ok(match holds {
        Holds::LineInPlane(offset) => {
            let gap = offset - dot(sub(oj, i.translation), z);
            let near = make_frame(add_scaled(oj, gap, z), z, line);
            Meeting::new(JointType::CylinderOnPlane, near, far)
        }
        _ => {
            let near = make_frame(i.translation, z, line);
            Meeting::new(JointType::Universal, near, far)
        }
    })
}

/// Returns the joint that constrains the rotation about one line, Ix·Jy + Iy·Jx = 0; the line moves as the joint turns.
fn constant_velocity_joint(i: &RigidMotion, j: &RigidMotion) -> Met {
    let normal = |a, b| cross(frame_axis(j, a), frame_axis(i, b));
    let n = add(normal(1, 0), normal(0, 1));
    if length(n) < FLAT {
        return Err("its two shafts are placed so that it constrains no rotation");
    }
    let sum = dot(frame_axis(i, 0), frame_axis(j, 1)) + dot(frame_axis(i, 1), frame_axis(j, 0));
    let near = make_frame(i.translation, n, frame_axis(i, 0));
    let off = RigidMotion::from_turn(n, sum / length(n)).then(&at_point(near, [0.0; 3]));
    let far = at_point(off, j.translation);
    let kind = JointType::Custom(vec![Freedom::Rx, Freedom::Ry]);
    Ok(at_this_pose(Meeting::new(kind, near, far)))
}

/// Returns the joint that fixes the angle between two z axes: it constrains the rotation about their common normal.
fn angle_joint(i: &RigidMotion, j: &RigidMotion, cosine: f64) -> Met {
    use Freedom::{Rx, Ry, Tx, Ty, Tz};
    let (a, b) = (frame_axis(i, 2), frame_axis(j, 2));
    let n = cross(a, b);
    if length(n) < FLAT {
        return Err(
            "its two axes are parallel here, where an angle between them constrains nothing to first order",
        );
    }
    let off = length(n).atan2(dot(a, b)) - cosine.clamp(-1.0, 1.0).acos();
    let near = make_frame(i.translation, n, a);
    let turned = RigidMotion::from_turn(n, off).then(&at_point(near, [0.0; 3]));
    let far = at_point(turned, i.translation);
    let kind = JointType::Custom(vec![Rx, Ry, Tx, Ty, Tz]);
    Ok(at_this_pose(Meeting::new(kind, near, far)))
}

/// Returns the joint that fixes a distance of points or of lines, along the direction from one to the other.
fn distance_joint(holds: Holds, i: &RigidMotion, j: &RigidMotion) -> Met {
    use Freedom::{Rz, Ty, Tz};
    let (z, oj) = (frame_axis(i, 2), j.translation);
    let d = sub(oj, i.translation);
    let along = dot(d, z);
    let (way, wanted) = match holds {
        Holds::PointPoint(r) => (d, r),
        Holds::PointLine(r) | Holds::LineLine(r) | Holds::Hinges(r) => {
            (add_scaled(d, -along, z), r)
        }
        _ => return Err("it is not a distance"),
    };
    if length(way) < FLAT {
        return Err("its two elements coincide, so the distance has no direction");
    }
    let u = unit_or_z(way);
    let gap = length(way) - wanted.abs();
    let point = add_scaled(oj, -gap, u);
    let zj = frame_axis(j, 2);
    let zj = scale(zj, if dot(zj, z) < 0.0 { -1.0 } else { 1.0 });
    let lines = |kind, slip: f64| {
        let near = make_frame(add_scaled(point, -slip, z), z, u);
        let far = at_point(tilt_to(&near, zj), oj);
        Meeting::new(kind, near, far)
    };
    Ok(at_this_pose(match holds {
        Holds::LineLine(_) => lines(JointType::Custom(vec![Rz, Ty, Tz]), 0.0),
        Holds::Hinges(_) => lines(JointType::Custom(vec![Rz, Ty]), along),
        _ => {
            let [near, far] = [point, oj].map(|at| make_frame(at, u, z));
            Meeting::new(JointType::SphereOnPlane, near, far)
        }
    }))
}

/// Returns the contact of two gears at the pitch point on the line of centres. They do not slip normal to that line. The pitch point of a
/// belt is outside.
fn gear_joint(i: &RigidMotion, j: &RigidMotion, [a, b]: [f64; 2]) -> Met {
    use Freedom::{Rx, Ry, Tx, Ty, Tz};
    let z = frame_axis(i, 2);
    let d = sub(j.translation, i.translation);
    let d = sub(d, scale(z, dot(d, z)));
    if length(d) < FLAT {
        return Err("its two axes coincide, so they have no line of centres");
    }
    if (a + b).abs() < FLAT * a.abs() {
        // A belt on equal wheels: both turn in the same way.
        let there = make_frame(i.translation, z, d);
        let kind = JointType::Custom(vec![Rx, Ry, Tx, Ty, Tz]);
        return Ok(at_this_pose(Meeting::new(kind, there, there)));
    }
    let point = add_scaled(i.translation, a / (a + b), d);
    let there = make_frame(point, cross(z, d), z);
    let contact = Meeting::new(JointType::SphereOnPlane, there, there);
    Ok(at_this_pose(contact))
}

/// Rates below this fraction of the other count as zero.
const NONE: f64 = 1e-9;

/// Returns true for a belt on equal wheels.
fn is_belt(m: &Meeting) -> bool {
    matches!(&m.kind, JointType::Custom(list) if !list.contains(&Freedom::Screw))
}

/// Returns the constrained component of J's motion relative to I, given a velocity at the frame's origin and an angular velocity.
fn constrained_rate(m: &Meeting, velocity: Vector, turn: Vector) -> f64 {
    let z = m.near.rotation.map(|row| row[2]);
    match &m.kind {
        JointType::SphereOnPlane => dot(z, velocity),
        _ if is_belt(m) => dot(z, turn),
        _ => dot(z, velocity) - m.pitch * dot(z, turn),
    }
}

/// Returns the rate of the constrained component if a joint moves its second link at rate 1.
fn joint_rate(m: &Meeting, joint: &Part, places: &[RigidMotion]) -> Option<f64> {
    let frame = places[joint.links[0]].then(&joint.sides[0]);
    let d = frame.map_direction(joint.axis);
    Some(match joint.joint_type {
        JointType::Revolute => {
            constrained_rate(m, cross(d, sub(m.near.translation, frame.translation)), d)
        }
        JointType::Prismatic => constrained_rate(m, d, [0.0; 3]),
        _ => return None,
    })
}

/// Returns the coupling that a joint between two links represents, if any; `joints` are those that connect parts.
pub(crate) fn find_coupling(
    m: &Meeting,
    [i, j]: [usize; 2],
    joints: &[Part],
    places: &[RigidMotion],
    said: (&str, usize),
) -> Option<Ratio> {
    let at = |link: usize| {
        joints
            .iter()
            .filter(move |p| p.links.contains(&link))
            .filter_map(move |p| {
                let second = p.links[1] == link;
                let other = p.links[usize::from(!second)];
                let rate = joint_rate(m, p, places)?;
                Some((p, other, if second { rate } else { -rate }))
            })
    };
    for (a, on, i_rate) in at(i) {
        for (b, also_on, j_rate) in at(j) {
            let size = i_rate.abs().max(j_rate.abs());
            let least = i_rate.abs().min(j_rate.abs());
            if on != also_on || on == j || a.id == b.id || least <= NONE * size {
                continue;
            }
            // The relative motion of J and I is zero in the constrained direction.
            return Some(Ratio {
                joints: [a.id.clone(), b.id.clone()],
                ratio: i_rate / j_rate,
                higher: [0.0; 3],
                element: said.0.to_owned(),
                said_by: said.1,
                gear: !is_belt(m),
            });
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector::{X, Y, Z};

    fn misfit(m: &Meeting) -> [f64; 2] {
        let apart = m.near.inverse().then(&m.far);
        [length(apart.translation), apart.angle()]
    }

    #[test]
    fn a_hinge_that_is_turned_and_flipped_still_fits() {
        let i = RigidMotion::from_translation([1.0, 2.0, 3.0]);
        let flipped = i.then(&RigidMotion::from_turn(X, std::f64::consts::PI));
        let j = flipped.then(&RigidMotion::from_turn(Z, 0.7));
        let m = find_meeting(Holds::Revolute, &i, &j).unwrap_or_else(|e| panic!("{e}"));
        assert!(misfit(&m).iter().all(|x| *x < 1e-12), "{m:?}");
        // A slider holds the turn, too: so much is it out.
        let m = find_meeting(Holds::Translational, &i, &j).unwrap_or_else(|e| panic!("{e}"));
        assert!((misfit(&m)[1] - 0.7).abs() < 1e-12);
    }

    #[test]
    fn a_tilted_hinge_is_out_by_its_tilt_and_its_way() {
        let j =
            RigidMotion::from_translation([0.0, 0.3, 0.4]).then(&RigidMotion::from_turn(Y, 0.02));
        for (holds, wanted) in [
            (Holds::Revolute, [0.5, 0.02]),
            (Holds::Cylindrical, [0.3, 0.02]),
            (Holds::Spherical, [0.5, 0.0]),
            (Holds::Planar(0.1), [0.3, 0.02]),
            (Holds::PointInPlane(0.4), [0.0, 0.0]),
            (Holds::PointInLine, [0.3, 0.0]),
            (Holds::ParallelAxes, [0.0, 0.02]),
            (Holds::PointPoint(0.2), [0.3, 0.0]),
            (Holds::LineLine(0.3), [0.0, 0.02]),
            (Holds::Hinges(0.3), [0.4, 0.02]),
        ] {
            let m =
                find_meeting(holds, &RigidMotion::IDENTITY, &j).unwrap_or_else(|e| panic!("{e}"));
            let found = misfit(&m);
            for k in 0..2 {
                assert!((found[k] - wanted[k]).abs() < 1e-9, "{holds:?} {found:?}");
            }
            assert_eq!(m.kind.freedoms().len(), 6 - holds.rows(), "{holds:?}");
        }
    }

    #[test]
    fn an_angle_between_parallel_axes_holds_nothing() {
        let i = RigidMotion::IDENTITY;
        assert!(find_meeting(Holds::Angle(0.9), &i, &i).is_err());
        let j = RigidMotion::from_turn(Y, 0.5);
        let m = find_meeting(Holds::Angle(0.3_f64.cos()), &i, &j).unwrap_or_else(|e| panic!("{e}"));
        assert!((misfit(&m)[1] - 0.2).abs() < 1e-12);
    }
}
