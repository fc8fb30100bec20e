//! Twists and wrenches about one point, and the freedoms of joints in a pose.

use crate::geom::vector::cross;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::JointId;

/// A twist or a wrench.
pub type Six = [f64; 6];

/// Returns the power of a wrench on a twist.
#[must_use]
pub fn power(a: &Six, b: &Six) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Returns the wrench (m; f) of a force at a point, with an additional moment.
#[must_use]
pub fn wrench(point: [f64; 3], force: [f64; 3], moment: [f64; 3]) -> Six {
    let m = cross(point, force);
    [
        m[0] + moment[0],
        m[1] + moment[1],
        m[2] + moment[2],
        force[0],
        force[1],
        force[2],
    ]
}

/// Converts a wrench about the middle to one about another point.
#[must_use]
pub fn about(w: &Six, point: [f64; 3]) -> Six {
    let f = [w[3], w[4], w[5]];
    let m = cross(point, f);
    [w[0] - m[0], w[1] - m[1], w[2] - m[2], f[0], f[1], f[2]]
}

/// Returns the part of a wrench that a model can carry: all of it, or the part in the plane spanned by three wrenches.
pub(crate) fn within(basis: &[Six], w: &Six) -> Six {
    if basis.len() == 6 {
        return *w;
    }
    let mut out = [0.0; 6];
    for b in basis {
        let share = power(b, w);
        for (o, x) in out.iter_mut().zip(b) {
            *o += share * x;
        }
    }
    out
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
