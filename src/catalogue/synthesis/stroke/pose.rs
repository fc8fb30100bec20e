//! Where a link is on the way of a stroke.

use crate::geom::vector::add;
use crate::synthesis::point::Point;
use crate::synthesis::velocities::Velocity;

/// Where a link is on the way, and how it moves for a millimetre of the width.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LinkPose {
    /// Cosine and sine of its turn.
    pub(super) turn: [f64; 2],
    /// Where its point is that was drawn at the origin.
    pub(super) shift: Point,
    /// Its velocity, at the pose, by the width.
    pub(super) velocity: Velocity,
}

impl LinkPose {
    /// Where a point of it is that was drawn there.
    pub(super) fn point(&self, [x, y]: Point) -> Point {
        let [c, s] = self.turn;
        add([c * x - s * y, s * x + c * y], self.shift)
    }
}
