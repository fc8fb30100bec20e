//! The grounds, joint freedoms and couplings of a scene.

use crate::draw::kinematic::Kinematic;
use crate::draw::sheet::Shape;
use crate::model::joint_type::{Coupling, Freedom, JointType};
use crate::model::mechanism::JointId;
use serde_json::{Value, json};

/// Returns the ground below a joint.
pub(crate) fn ground_below(reach: f64) -> Vec<Shape> {
    let strokes = (0..5).map(|i| {
        let x = 10.0 - 5.0 * f64::from(i);
        Shape::line("fine", vec![[x, reach], [x - 4.0, reach + 6.0]])
    });
    let stem = Shape::line("bone", vec![[0.0, 0.0], [0.0, reach]]);
    let line = Shape::line("bone", vec![[-11.0, reach], [11.0, reach]]);
    [stem, line].into_iter().chain(strokes).collect()
}

impl Kinematic<'_> {
    /// Returns what a type leaves free at a joint: its freedoms in order, where slides go along axes of the second link where turns come
    /// before them.
    pub(crate) fn pair_json(&self, i: usize, of: &JointType) -> Value {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let free = of.freedoms();
        let screws = free.contains(&Freedom::Screw);
        let pitch = if screws {
            joint.frame.pitch.to_f64()
        } else {
            0.0
        };
        json!({
            "free": free.iter().map(|f| f.name()).collect::<Vec<_>>(),
            // Whether the first of the scene's two links is the joint's second.
            "swapped": self.carrier_links(i).0 != joint.links[0],
            // Pixels along z for each radian about it, of a screw.
            "pitch": pitch * self.projection.scale,
        })
    }

    /// Returns a coupling between joints of a scene, in radians and pixels: the changes of the two freedoms times their
    /// factors add up to 0. Returns `None` if a joint is not drawn.
    pub(crate) fn tie_json(
        &self,
        coupling: &Coupling,
        row: impl Fn(JointId) -> Option<usize>,
    ) -> Option<Value> {
        let [a, b] = coupling.ends;
        let unit = |f: Freedom| {
            if f.is_slide() {
                self.projection.scale
            } else {
                1.0
            }
        };
        // the rate of the second is the ratio times the rate of the first
        let factors = [coupling.ratio.to_f64(), -1.0];
        Some(json!({
            "joints": [row(a.joint)?, row(b.joint)?],
            "freedoms": [a.freedom.name(), b.freedom.name()],
            "factors": [factors[0] / unit(a.freedom), factors[1] / unit(b.freedom)],
        }))
    }
}
