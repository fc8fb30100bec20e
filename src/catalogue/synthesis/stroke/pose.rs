//! Pose of a link on a stroke.

use crate::geom::vector::add;
use crate::synthesis::equations::velocities::Velocity;
use crate::synthesis::place::Point;

/// Pose of a link on a stroke, and its velocity for a millimetre of the width.
#[derive(Debug, Clone, Copy)]
pub struct LinkPose {
    /// Turn since the drawn pose, in rad.
    pub angle: f64,
    /// Cosine and sine of the turn.
    turn: [f64; 2],
    /// Current place of the point that was drawn at the origin.
    pub shift: Point,
    /// Its velocity at the pose, over the width.
    pub velocity: Velocity,
}

/// Greatest angle for the short series of sine and cosine, in rad. The omitted terms, by^7 / 5040 of a sine and by^6 / 720 of a cosine, are
/// negligible compared with 1.
const LITTLE: f64 = 2e-3;

impl LinkPose {
    /// The drawn pose, at rest.
    pub const AT_REST: LinkPose = LinkPose {
        angle: 0.0,
        turn: [1.0, 0.0],
        shift: [0.0; 2],
        velocity: Velocity {
            turning: 0.0,
            shift: [0.0; 2],
        },
    };

    /// Returns the pose turned by an angle in rad.
    #[must_use]
    pub fn turn_by(angle: f64) -> LinkPose {
        let (sine, cosine) = angle.sin_cos();
        LinkPose {
            angle,
            turn: [cosine, sine],
            ..LinkPose::AT_REST
        }
    }

    /// Returns the pose turned to an angle. For a small difference, as in the last correction of a pose, short series replace sine and
    /// cosine.
    #[must_use]
    pub fn turned_to(&self, angle: f64) -> LinkPose {
        let by = angle - self.angle;
        if by.abs() > LITTLE {
            return LinkPose::turn_by(angle);
        }
        let square = by * by;
        let sine = by * (1.0 - square / 6.0 * (1.0 - square / 20.0));
        let cosine = 1.0 - square / 2.0 * (1.0 - square / 12.0);
        LinkPose {
            angle,
            turn: LinkPose {
                turn: [cosine, sine],
                ..*self
            }
            .turned_direction(self.turn),
            ..LinkPose::AT_REST
        }
    }

    /// Returns a drawn direction of the link in its current pose.
    #[must_use]
    pub fn turned_direction(&self, [x, y]: Point) -> Point {
        let [c, s] = self.turn;
        [c * x - s * y, s * x + c * y]
    }

    /// Returns the current place of a point of the link that was drawn at `at`.
    #[must_use]
    pub fn moved_point(&self, at: Point) -> Point {
        add(self.turned_direction(at), self.shift)
    }
}

#[cfg(test)]
mod tests {
    use super::{LITTLE, LinkPose};

    /// By the sine of the whole, to the last digits.
    #[test]
    fn turned_a_little_farther_is_turned_so_far() {
        for step in -40..=40 {
            let angle = 0.37 * f64::from(step);
            for by in [
                0.0,
                1e-9,
                1e-4,
                0.999 * LITTLE,
                -0.999 * LITTLE,
                1.001 * LITTLE,
                0.3,
            ] {
                let [is, should] = [
                    LinkPose::turn_by(angle).turned_to(angle + by),
                    LinkPose::turn_by(angle + by),
                ];
                assert_eq!(is.angle, should.angle);
                for (a, b) in is.turn.into_iter().zip(should.turn) {
                    assert!((a - b).abs() < 4e-16, "{angle} {by}: {a} {b}");
                }
            }
        }
    }
}
