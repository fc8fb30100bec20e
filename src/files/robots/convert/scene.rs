//! What a writer is given, and what it gives back.

use crate::geom::rigid::RigidMotion;
use crate::robots::convert::lost::Lost;
use crate::robots::convert::payload::{LinkShape, Payload, Weight};
use crate::robots::convert::plan::{Branch, TreePlan};
use crate::robots::description::massless::Light;
use crate::robots::description::parts::{Part, Robot};

/// A robot to be written.
pub(crate) struct RobotScene<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) payload: &'a Payload,
    pub(crate) plan: &'a TreePlan,
    /// Places of the links in the pose that is written.
    pub(crate) places: &'a [RigidMotion],
    /// What stands between joints in series.
    pub(crate) light: Light,
    /// How well places are known, as a comment.
    pub(crate) known: &'a str,
    /// A length of the robot's size, in metres.
    pub(crate) size: f64,
}

/// A robot in a format.
#[derive(Debug, Default)]
pub(crate) struct Text {
    pub(crate) text: String,
    /// A file of loops beside it.
    pub(crate) beside: Option<String>,
    pub(crate) lost: Lost,
    /// What differs and is not lost, a sentence each.
    pub(crate) told: Vec<String>,
    /// Constraints that only repeat others, as the format has no better words.
    pub(crate) repeated: usize,
}

/// Limits of a joint of one freedom, as far as they hold.
pub(crate) fn limits(scene: &RobotScene<'_>, joint: usize) -> Option<(f64, f64)> {
    let part = &scene.robot.joints[joint];
    let free = scene.payload.of(joint, 0).unlimited;
    part.limits.filter(|_| !free && part.values.len() == 1)
}

impl RobotScene<'_> {
    pub(crate) fn part(&self, joint: usize) -> &Part {
        &self.robot.joints[joint]
    }

    pub(crate) fn weight(&self, link: usize) -> Option<&Weight> {
        self.payload.weights.get(&link).filter(|w| w.mass > 0.0)
    }

    pub(crate) fn shapes(&self, link: usize) -> &[LinkShape] {
        self.payload.shapes.get(&link).map_or(&[], Vec::as_slice)
    }

    /// Whether a link is one that the reader put between joints in series, with nothing on it.
    pub(crate) fn is_between(&self, link: usize) -> bool {
        let plan = self.plan;
        let held = plan
            .loops
            .iter()
            .any(|&j| self.robot.joints[j].links.contains(&link));
        let own = self.robot.said.values().any(|l| *l == link);
        let framed = self.payload.frames.iter().any(|f| f.1 == link);
        !own && !held && !framed && link != plan.root && plan.on(link).count() == 1
    }
}

/// The name of a joint's freedoms in series: its own, then with numbers.
pub(crate) fn name_of(id: &str, n: usize) -> String {
    match n {
        0 => id.to_owned(),
        n => format!("{id}~{}", n + 1),
    }
}

/// Whether a branch moves.
pub(crate) fn moves(b: &Branch) -> bool {
    !b.singles.is_empty()
}
