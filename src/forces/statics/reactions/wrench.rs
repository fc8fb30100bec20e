//! Twists and wrenches about one point, and the freedoms of joints in a pose.

use crate::geom::rigid::split_twist;
use crate::geom::vector::{add, add_scaled, cross, dot, sub};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::JointId;

/// A twist or a wrench.
pub type Six = [f64; 6];

/// Returns the twist or wrench of two halves.
#[must_use]
pub(crate) fn join_halves([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> Six {
    [a, b, c, d, e, f]
}

/// Returns the power of a wrench on a twist.
#[must_use]
pub fn wrench_power(a: &Six, b: &Six) -> f64 {
    dot(*a, *b)
}

/// Returns the wrench (m; f) of a force at a point, with an additional moment.
#[must_use]
pub fn force_wrench(point: [f64; 3], force: [f64; 3], moment: [f64; 3]) -> Six {
    join_halves(add(cross(point, force), moment), force)
}

/// Converts a wrench about the middle to one about another point.
#[must_use]
pub fn shift_wrench(w: &Six, point: [f64; 3]) -> Six {
    let (moment, force) = split_twist(w);
    join_halves(sub(moment, cross(point, force)), force)
}

/// Returns the part of a wrench that a model can carry: all of it, or the part in the plane spanned by three wrenches.
pub(crate) fn carried_part(basis: &[Six], w: &Six) -> Six {
    if basis.len() == 6 {
        return *w;
    }
    let part = |sum, b: &Six| add_scaled(sum, wrench_power(b, w), *b);
    basis.iter().fold([0.0; 6], part)
}

/// A freedom of a joint.
#[derive(Debug, Clone, Copy)]
pub struct FreedomColumn {
    /// The joint.
    pub joint: JointId,
    /// The freedom in the joint's frame.
    pub freedom: Freedom,
    /// Unit rotation or translation of the joint's second link relative to its first.
    pub twist: Six,
}

/// The freedoms of a pose and their positions, with lengths in a size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PosedFreedoms<'g> {
    /// The freedoms, grouped by joint.
    pub(crate) columns: &'g [FreedomColumn],
    /// For each joint, its point.
    pub(crate) points: &'g [[f64; 3]],
    /// Orthonormal wrenches: six, or the three of a plane.
    pub(crate) basis: &'g [Six],
    /// The size, in the file's unit.
    pub(crate) size: f64,
}
