//! Where a link is on the way of a stroke.

use crate::geom::vector::add;
use crate::synthesis::point::Point;
use crate::synthesis::velocities::Velocity;

/// Where a link is on the way, and how it moves for a millimetre of the width.
#[derive(Debug, Clone, Copy)]
pub struct LinkPose {
    /// How far it has turned since it was drawn, in rad.
    pub angle: f64,
    /// Cosine and sine of that.
    turn: [f64; 2],
    /// Where its point is that was drawn at the origin.
    pub shift: Point,
    /// Its velocity, at the pose, by the width.
    pub velocity: Velocity,
}

impl LinkPose {
    /// As drawn, at rest.
    pub const AT_REST: LinkPose = LinkPose {
        angle: 0.0,
        turn: [1.0, 0.0],
        shift: [0.0; 2],
        velocity: Velocity {
            turning: 0.0,
            shift: [0.0; 2],
        },
    };

    /// Turned by an angle in rad.
    #[must_use]
    pub fn turned(angle: f64) -> LinkPose {
        let (sine, cosine) = angle.sin_cos();
        LinkPose {
            angle,
            turn: [cosine, sine],
            ..LinkPose::AT_REST
        }
    }

    /// What has become of a direction of it.
    #[must_use]
    pub fn direction(&self, [x, y]: Point) -> Point {
        let [c, s] = self.turn;
        [c * x - s * y, s * x + c * y]
    }

    /// Where a point of it is that was drawn there.
    #[must_use]
    pub fn point(&self, at: Point) -> Point {
        add(self.direction(at), self.shift)
    }
}
