//! Poses of closed mechanisms, mechanisms moved to another pose, and mechanisms followed along a drive.

pub mod close;
pub(crate) mod displacement_series;
pub mod drive_range;
pub mod follow;
pub mod jaws;
pub mod pose;

use crate::geom::expr::Expr;
use crate::geom::vector::{Vector, add, length, scale, sub, to_vector};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::motion::pose::Pose;

/// Returns the mechanism with every joint at its position in the pose, or `None` if a number is too large.
///
/// # Complexity
/// One pass over the joints.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, motion::{follow, move_mechanism, pose::Pose}};
/// let bennett = ozols::built_in("bennett")?;
/// let mut follower = follow::Follower::new(Pose::of_file(&bennett, StateId::FREE)?, 0, &[]);
/// follower.advance_to(0.5, |_| {}).expect("it turns");
/// // The linkage moves on in the new pose.
/// let moved = move_mechanism(&bennett, &follower.current_pose()).expect("numbers are small");
/// assert_eq!(moved.joints.len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn move_mechanism(m: &Mechanism, pose: &Pose) -> Option<Mechanism> {
    let mut out = m.clone();
    let written = |v: Vector| -> Option<[Expr; 3]> {
        let [x, y, z] = v.map(|x| Expr::from_f64(x).ok());
        Some([x?, y?, z?])
    };
    for (j, joint) in m.joints_with_ids() {
        let freedoms = joint.joint_type.freedoms();
        // As in poses, a slot belongs to the second link and its pin to the first. Otherwise a guide belongs to the
        // first.
        let has = |f| freedoms.contains(&f);
        let slot = has(Freedom::Tx) && !has(Freedom::Ty);
        let carrier = joint.links[usize::from(!slot)];
        let at = sub(to_vector(&joint.frame.point), pose.middle);
        let at = pose.links[carrier.index()].map_point(scale(at, 1.0 / pose.length));
        let frame = &mut out.parts_mut().joints[j].frame;
        frame.point = written(add(scale(at, pose.length), pose.middle))?;
        let of = |wanted: &[Freedom]| column_direction(pose, j, wanted);
        let carried =
            |d: &[Expr; 3]| pose.links[joint.links[0].index()].map_direction(to_vector(d));
        let z = of(&[Freedom::Rz, Freedom::Tz, Freedom::Screw]);
        let x = of(&[Freedom::Rx, Freedom::Tx]);
        frame.axis = written(z.unwrap_or_else(|| carried(&joint.frame.axis)))?;
        frame.reference = written(x.unwrap_or_else(|| carried(&joint.frame.reference)))?;
    }
    Some(out)
}

/// Returns a direction of a link in another pose, converted to the pose of the file.
#[must_use]
pub(crate) fn turned_back(pose: &Pose, link: LinkId, d: Vector) -> Vector {
    pose.links[link.index()].inverse().map_direction(d)
}

/// Returns the line of the first of some freedoms that a joint has.
fn column_direction(pose: &Pose, joint: JointId, wanted: &[Freedom]) -> Option<Vector> {
    let mut columns = pose.columns.iter();
    let found = columns.find(|c| c.joint == joint && wanted.contains(&c.freedom))?;
    let [a, b, c, d, e, f] = found.twist;
    let (turn, shift) = ([a, b, c], [d, e, f]);
    Some(if length(turn) > 0.0 { turn } else { shift })
}
