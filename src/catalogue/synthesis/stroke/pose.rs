//! Where a link is on the way of a stroke.

use crate::geom::vector::add;
use crate::synthesis::place::Point;
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

/// So little that what the series leave out of a sine, by^7 / 5040, and of a cosine, by^6 / 720, is nothing beside one. In rad.
const LITTLE: f64 = 2e-3;

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
    pub fn turn_by(angle: f64) -> LinkPose {
        let (sine, cosine) = angle.sin_cos();
        LinkPose {
            angle,
            turn: [cosine, sine],
            ..LinkPose::AT_REST
        }
    }

    /// Turned a little farther, as the last correction of a pose does: without another sine where it is that little.
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

    /// What has become of a direction of it.
    #[must_use]
    pub fn turned_direction(&self, [x, y]: Point) -> Point {
        let [c, s] = self.turn;
        [c * x - s * y, s * x + c * y]
    }

    /// Where a point of it is that was drawn there.
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
