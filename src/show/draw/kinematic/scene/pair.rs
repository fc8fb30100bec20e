//! What the joints of a scene leave free, and what couples them, for a program that moves its links.

use crate::draw::kinematic::Kinematic;
use crate::model::joint_type::{Coupling, Freedom, JointType};
use crate::model::mechanism::JointId;
use serde::Serialize;

/// The joint between two links of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::draw::kinematic) struct Pair {
    /// Its freedoms in order: slides go along axes of the second link where turns come before them.
    free: Vec<&'static str>,
    /// Whether the first of the scene's two links is the joint's second.
    swapped: bool,
    /// Pixels along z for each radian about it, of a screw.
    pitch: f64,
}

/// Two freedoms of joints of a scene, in radians and pixels: factor by factor, their changes add up to 0.
#[derive(Debug, Clone, Serialize)]
pub(in crate::draw::kinematic) struct Tie {
    /// The joints, by their numbers among those of the scene.
    joints: [usize; 2],
    freedoms: [&'static str; 2],
    factors: [f64; 2],
}

impl Kinematic<'_> {
    /// What a type leaves free at a joint.
    pub(in crate::draw::kinematic) fn pair(&self, i: usize, of: &JointType) -> Pair {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let free = of.freedoms();
        let screws = free.contains(&Freedom::Screw);
        let pitch = if screws {
            joint.frame.pitch.to_f64()
        } else {
            0.0
        };
        Pair {
            free: free.iter().map(|f| f.name()).collect(),
            swapped: self.carriers(i).0 != joint.links[0],
            pitch: pitch * self.projection.scale,
        }
    }

    /// A coupling between joints of a scene; none where one of them is not drawn.
    pub(in crate::draw::kinematic) fn tie(
        &self,
        coupling: &Coupling,
        row: impl Fn(JointId) -> Option<usize>,
    ) -> Option<Tie> {
        let [a, b] = coupling.ends;
        let unit = |f: Freedom| {
            if f.slides() {
                self.projection.scale
            } else {
                1.0
            }
        };
        // the rate of the second is the ratio times the rate of the first
        Some(Tie {
            joints: [row(a.joint)?, row(b.joint)?],
            freedoms: [a.freedom, b.freedom].map(Freedom::name),
            factors: [
                coupling.ratio.to_f64() / unit(a.freedom),
                -1.0 / unit(b.freedom),
            ],
        })
    }
}
