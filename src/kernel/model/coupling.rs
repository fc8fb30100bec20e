//! Couplings: joints that move in a fixed ratio, as gears, belts, racks and mimic joints make them.

use crate::geom::expr::Expr;
use crate::model::id::JointId;
use crate::model::joint_type::Freedom;

/// One of the two freedoms that a coupling ties together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CoupledFreedom {
    /// The joint.
    pub joint: JointId,
    /// Its freedom, in the joint's frame.
    pub freedom: Freedom,
}

/// Two freedoms of two joints that move in a fixed ratio: rate of the second = ratio · rate of the first.
///
/// Rates are in radians and in the file's length unit, whatever the length of the axis in the file, so that the ratio of
/// a rack and its pinion is a length per radian. The ratio holds for positions too: it does not change along the motion.
#[derive(Debug, Clone)]
pub struct Coupling {
    /// The two freedoms, of different joints that are present in the same states.
    pub ends: [CoupledFreedom; 2],
    /// The ratio; not zero.
    pub ratio: Expr,
    /// Whether gears make it, or a rack and its pinion, so that it can be drawn as their pitch circles.
    pub gear: bool,
}

impl Coupling {
    /// The end at a joint, if it has one there.
    #[must_use]
    pub fn end_at(&self, joint: JointId) -> Option<usize> {
        self.ends.iter().position(|e| e.joint == joint)
    }
}
