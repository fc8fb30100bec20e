//! Figures gathered over a stroke.

use super::forces::ForceFigures;
use crate::geom::vector::{dot, sub};
use crate::synthesis::place::Point;

/// Minimum and maximum of a figure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Between(pub(super) [f64; 2]);

impl Between {
    pub(super) const NOTHING: Between = Between([f64::INFINITY, f64::NEG_INFINITY]);

    pub(super) fn take(&mut self, x: f64) {
        self.0 = [self.0[0].min(x), self.0[1].max(x)];
    }

    /// Returns the maximum over the minimum; 1 if no value was taken.
    pub(super) fn force_ratio(self) -> f64 {
        let [least, most] = self.0;
        if least > most {
            1.0
        } else {
            most / least.max(1e-9)
        }
    }

    pub(super) fn span(self) -> f64 {
        (self.0[1] - self.0[0]).max(0.0)
    }
}

/// Figures gathered over a stroke.
#[derive(Debug, Clone)]
pub(super) struct Gathered {
    pub(super) sine: f64,
    pub(super) straightness: f64,
    pub(super) rates: Between,
    pub(super) turns: Vec<Between>,
    pub(super) sides: [Between; 2],
    pub(super) forces: ForceFigures,
    /// The pins at the last pose, and the smallest squared distance between two of them.
    pub(super) pins: Vec<Point>,
    pub(super) nearest: f64,
    pub(super) on_side: f64,
    pub(super) cylinder: Between,
    pub(super) reach: f64,
}

impl Gathered {
    /// Creates the figures for this number of jaws, without any pose.
    pub(super) fn new(jaws: usize) -> Gathered {
        Gathered {
            sine: 1.0,
            straightness: 1.0,
            rates: Between::NOTHING,
            turns: vec![Between::NOTHING; jaws],
            sides: [Between::NOTHING; 2],
            forces: ForceFigures::BEST,
            pins: Vec::new(),
            nearest: f64::INFINITY,
            on_side: f64::INFINITY,
            cylinder: Between::NOTHING,
            reach: f64::INFINITY,
        }
    }

    /// Clears the figures for another stroke, and keeps the allocations.
    pub(super) fn begin_stroke(&mut self) {
        let (mut turns, pins) = (
            std::mem::take(&mut self.turns),
            std::mem::take(&mut self.pins),
        );
        turns.fill(Between::NOTHING);
        *self = Gathered {
            turns,
            pins,
            ..Gathered::new(0)
        };
    }

    /// Takes the distance of a point from the middle, on the side of its half. Ignored if `half` is 0.
    pub(super) fn take_on_side(&mut self, far: f64, half: f64) {
        if half != 0.0 {
            self.on_side = self.on_side.min(far);
        }
    }

    pub(super) fn take_pin(&mut self, pin: Point) {
        for other in &self.pins {
            let apart = sub(pin, *other);
            self.nearest = self.nearest.min(dot(apart, apart));
        }
        self.pins.push(pin);
    }

    pub(super) fn take(&mut self, point: Point) {
        for (side, x) in self.sides.iter_mut().zip(point) {
            side.take(x);
        }
    }
}
