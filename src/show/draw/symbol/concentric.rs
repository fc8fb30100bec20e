//! Joints in one place on paper, drawn within each other: a multiple joint as concentric circles, a pin on its block.

use crate::draw::place::projection::ONE_PLACE;
use crate::model::joint_type::JointType;
use crate::model::mechanism::Joint;
use crate::svg::plane::{Point, norm, sub};

/// How much larger the next joint outwards is, so that the outline of each is seen.
const STEP: f64 = 0.6;

/// How many times its usual size each joint is drawn.
pub(in crate::draw) fn sizes(at: &[Point], joints: &[&Joint]) -> Vec<f64> {
    let mut out = vec![1.0; at.len()];
    let mut done = vec![false; at.len()];
    for i in 0..at.len() {
        if done[i] {
            continue;
        }
        let mut here: Vec<usize> = (i..at.len())
            .filter(|&k| !done[k] && one_place(at[k], at[i]))
            .collect();
        here.sort_by_key(|&k| (outward(&joints[k].joint_type), joints[k].drive, k));
        for (level, k) in here.into_iter().enumerate() {
            done[k] = true;
            out[k] = 1.0 + STEP * level as f64;
        }
    }
    out
}

/// Whether two points of the paper are one to the eye.
pub(in crate::draw) fn one_place(a: Point, b: Point) -> bool {
    norm(sub(a, b)) <= ONE_PLACE
}

/// Which of several joints is nearer to the outside: pins and balls stand on blocks and plates.
fn outward(of: &JointType) -> u8 {
    match of {
        JointType::Revolute | JointType::Spherical => 0,
        JointType::Cylindrical | JointType::CylindricalUniversal => 2,
        JointType::Fixed | JointType::Slotted | JointType::Prismatic => 3,
        JointType::SphereInCylinder => 4,
        JointType::Planar | JointType::CylinderOnPlane | JointType::SphereOnPlane => 5,
        _ => 1,
    }
}
