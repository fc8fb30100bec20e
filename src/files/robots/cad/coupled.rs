//! Gears, racks and screws as couplings of the joints that bear their parts, where both hang on one part by joints of one
//! freedom; the ratio then holds over the motion.

use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{Vector, cross, dot, sub};
use crate::model::joint_type::{Freedom, JointType};
use crate::robots::cad::meet::Meeting;
use crate::robots::description::{Part, Ratio};

/// Rates below this share of the other are none.
const NONE: f64 = 1e-9;

/// Returns true for a belt on equal wheels.
fn is_belt(m: &Meeting) -> bool {
    matches!(&m.kind, JointType::Custom(list) if !list.contains(&Freedom::Screw))
}

/// Returns the constrained component of J's motion relative to I, given a velocity at the frame's origin and an angular velocity.
fn held(m: &Meeting, velocity: Vector, turn: Vector) -> f64 {
    let z = m.near.rotation.map(|row| row[2]);
    match &m.kind {
        JointType::SphereOnPlane => dot(z, velocity),
        _ if is_belt(m) => dot(z, turn),
        _ => dot(z, velocity) - m.pitch * dot(z, turn),
    }
}

/// Returns the rate of the constrained component if a joint moves its second link at rate 1.
fn rate(m: &Meeting, joint: &Part, places: &[RigidMotion]) -> Option<f64> {
    let frame = places[joint.links[0]].then(&joint.sides[0]);
    let d = frame.direction(joint.axis);
    Some(match joint.joint_type {
        JointType::Revolute => held(m, cross(d, sub(m.near.translation, frame.translation)), d),
        JointType::Prismatic => held(m, d, [0.0; 3]),
        _ => return None,
    })
}

/// Returns the coupling that a joint between two links represents, if any; `joints` are those that connect parts.
pub(crate) fn coupling(
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
                let rate = rate(m, p, places)?;
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
            // J's motion less I's is nothing in the direction held.
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
