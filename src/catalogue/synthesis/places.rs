//! Places of the joints of a gripper. Points are whole millimetres, directions have whole lengths (3, 4 and 5), and radii are whole, so
//! that layouts are exact.

use crate::geom::vector::{add_scaled, quarter_turn, sub};
use crate::synthesis::place::Point;
use crate::synthesis::place::direction::WholeDirection;
use std::f64::consts::TAU;

/// Places of all joints, by their indices in the chain's list.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// A point of each joint, in millimetres, followed by the tips. The point is the pin of a hinge or a slot, a point of a guide, or the
    /// contact point of pitch circles.
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

    /// Takes the places of another layout of the same joints, without new allocations.
    pub(in crate::synthesis) fn copy_from(&mut self, other: &Places) {
        self.points.clone_from(&other.points);
        self.along.clone_from(&other.along);
        self.pinned.clone_from(&other.pinned);
        self.teeth.clone_from(&other.teeth);
    }
}

/// Transmission ratio of teeth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Teeth {
    /// Two external gears: pitch radii in this ratio.
    Gears([i32; 2]),
    /// A pinion with a rack: the pitch diameter in whole millimetres, negative if the rack is on the other side of the pinion.
    Rack(i32),
    /// A screw with its nut: millimetres per turn.
    Thread(i32),
}

impl Teeth {
    /// Returns the ratio of the second gear's speed to the first's. For a rack or nut, millimetres per radian of the pinion or screw.
    #[must_use]
    pub fn gear_ratio(self) -> f64 {
        match self {
            Teeth::Gears([a, b]) => -f64::from(a) / f64::from(b),
            Teeth::Rack(diameter) => f64::from(diameter) / 2.0,
            Teeth::Thread(lead) => f64::from(lead) / TAU,
        }
    }

    /// Returns the contact point of pitch circles with these centres. For a rack with a guide in the direction `along`, it is on the circle
    /// about the first; for a nut, on the screw's axis.
    pub(crate) fn pitch_point(self, [a, b]: [Point; 2], along: Point) -> Point {
        match self {
            Teeth::Gears([r, s]) => add_scaled(a, f64::from(r) / f64::from(r + s), sub(b, a)),
            Teeth::Rack(_) => add_scaled(a, -self.gear_ratio(), quarter_turn(along)),
            Teeth::Thread(_) => a,
        }
    }
}
