//! Places of the joints of a gripper. Points are whole millimetres, directions have whole lengths (3, 4 and 5), and radii are whole, so
//! that layouts are exact.

use crate::geom::vector::{add_scaled, quarter_turn, sub};
use crate::synthesis::direction::WholeDirection;
use crate::synthesis::place::Point;
use std::f64::consts::TAU;

/// Where all joints are, by their places in the chain's list.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// A point of each joint, in millimetres, and the tips after them: the pin of a hinge or a slot, a point of a guide, the point
    /// where pitch circles touch.
    pub points: Vec<Point>,
    /// The direction of each slide, and of each slot.
    pub along: Vec<WholeDirection>,
    /// The link that has the pin of each slot.
    pub pinned: Vec<usize>,
    /// The teeth of each gear pair.
    pub teeth: Vec<Teeth>,
}

impl Places {
    /// Returns the places of hinges, and of a slide along the x axis.
    #[must_use]
    pub fn of_hinges(points: Vec<Point>) -> Places {
        let all = points.len();
        Places {
            points,
            along: vec![WholeDirection::AHEAD; all],
            pinned: vec![0; all],
            teeth: vec![Teeth::Gears([1, 1]); all],
        }
    }
}

/// How fast teeth go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Teeth {
    /// Of two gears outside each other: pitch radii in this ratio.
    Gears([i32; 2]),
    /// Of a pinion with a rack: the pitch diameter in whole millimetres, negative where the rack is on the other side of it.
    Rack(i32),
    /// Of a screw and its nut: millimetres a turn.
    Thread(i32),
}

impl Teeth {
    /// How fast the second gear turns by the first, or the rack goes by the pinion: millimetres a radian.
    #[must_use]
    pub fn gear_ratio(self) -> f64 {
        match self {
            Teeth::Gears([a, b]) => -f64::from(a) / f64::from(b),
            Teeth::Rack(diameter) => f64::from(diameter) / 2.0,
            Teeth::Thread(lead) => f64::from(lead) / TAU,
        }
    }

    /// Where pitch circles about these centres touch; of a rack, whose guide goes that way, about the first; of a nut the screw's axis.
    pub(crate) fn pitch_point(self, [a, b]: [Point; 2], along: Point) -> Point {
        match self {
            Teeth::Gears([r, s]) => add_scaled(a, f64::from(r) / f64::from(r + s), sub(b, a)),
            Teeth::Rack(_) => add_scaled(a, -self.gear_ratio(), quarter_turn(along)),
            Teeth::Thread(_) => a,
        }
    }
}
