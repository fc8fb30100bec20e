//! Fast evaluation of the whole stroke while places are tried, from the narrowest part of the task to the widest.
//!
//! The parameter is the width of the part, so that every pose is one that the task asks for. The rate of the drive over the width is the
//! force of the jaws: work in is work out.

pub mod closure;
pub mod forces;
mod gathered;
pub mod judge;
pub mod motion;
pub mod planes;
pub mod pose;
pub mod shortfall;
pub mod walk;

use crate::synthesis::sketch::layout_quality::DEAR;
use crate::synthesis::stroke::judge::StrokeFigures;
use crate::synthesis::stroke::shortfall::NOISE;
use crate::synthesis::task::{AskedMotion, Limits, PARALLEL, Task, beyond_limit};

impl Task {
    /// Returns the minimum distances that are asked for, each with that of a stroke, in millimetres.
    fn least_distances(&self, f: &StrokeFigures) -> impl Iterator<Item = (f64, f64)> {
        let side = if self.own_sides {
            0.5 * self.wished_distances()[0]
        } else {
            0.0
        };
        let all = [
            (self.pin_distance, f.pin_distance),
            (self.reach, f.reach),
            (side, f.on_side),
        ];
        all.into_iter().filter(|(least, _)| *least > 0.0)
    }
}

/// Cost of a stroke on which a jaw opens while the others close. It exceeds the cost of the smallest transmission angle, since a gripper
/// with a small angle is of more use than one that does not close.
const OPENS: f64 = 60.0;

impl Limits {
    /// Returns the cost of a stroke, 0 at best. Its largest part is for ends that are not reached; the rest is for the task and the limits.
    #[must_use]
    pub fn stroke_cost(&self, f: &StrokeFigures) -> f64 {
        let task = &self.task;
        let missing = [f.reached[0] - task.narrowest, task.widest - f.reached[1]];
        let mut cost = 0.0;
        for m in missing.into_iter().filter(|m| *m > 0.0) {
            cost += 6.0 + 40.0 * m / task.opening_span();
        }
        let ratio = f.force_ratio().ln();
        let asked = (0.9 * task.force_ratio).max(1.0).ln();
        cost += 3.0 * beyond_limit(ratio - asked, 0.2).min(10.0);
        if task.least_force > 0.0 {
            let lacks = (1.1 * task.least_force / f.force.max(1e-12)).ln();
            cost += 3.0 * beyond_limit(lacks, 0.2).min(10.0);
        }
        cost += 2.0 * beyond_limit(0.6 - f.straightness, 0.5);
        if f.straightness <= 0.0 {
            cost += OPENS;
        }
        cost += 4.0 * beyond_limit(task.transmission + 4.0 - f.transmission, 8.0);
        let most = if task.pin_force > 0.0 {
            task.pin_force
        } else {
            10.0
        };
        cost += 2.0 * beyond_limit((f.forces.peak / (0.6 * most)).max(1e-12).ln(), 0.5).min(10.0);
        cost += beyond_limit(task.efficiency.max(0.7) + 0.1 - f.forces.efficiency, 0.2);
        let turn = f.turn;
        cost += match task.motion {
            AskedMotion::Parallel => 2.0 * beyond_limit(turn - 0.5 * PARALLEL, 0.5).min(10.0),
            AskedMotion::Any | AskedMotion::Swinging => beyond_limit(turn - 40.0, 20.0).min(20.0),
        };
        for (size, most) in f.size.into_iter().zip(task.room) {
            if most > 0.0 {
                cost += beyond_limit(size - most + 2.0, 4.0).min(10.0);
            }
        }
        for (least, is) in task.least_distances(f) {
            cost += beyond_limit(least - is + 1.0, 3.0).min(10.0);
        }
        if task.pulled_out > 0.0 {
            cost += beyond_limit((f.pulled_out / (0.95 * task.pulled_out)).ln(), 0.1).min(10.0);
        }
        cost
    }

    /// Returns the cost of a stroke if only the force counts. A great force has a negative cost. Each broken limit has a high cost, with
    /// `slack` times the usual width.
    #[must_use]
    pub fn force_cost(&self, f: &StrokeFigures, slack: f64) -> f64 {
        let task = &self.task;
        let missing = [f.reached[0] - task.narrowest, task.widest - f.reached[1]];
        let missing = missing.into_iter().filter(|m| *m > 0.0);
        let unreached: f64 = missing.map(|m| 1.0 + 10.0 * m / task.opening_span()).sum();
        let over = |value: f64, most: f64| (value / most).max(1e-12).ln();
        let mut broken = 0.0;
        // Even a tiny breach of a limit has a cost.
        let mut limit = |over: f64, width: f64| {
            if over > NOISE {
                broken += 0.02 + beyond_limit(over, slack * width);
            }
        };
        limit(over(f.force_ratio(), task.force_ratio), 0.1);
        limit(task.transmission - f.transmission, 2.0);
        limit(task.efficiency - f.forces.efficiency, 0.05);
        limit(0.05 - f.straightness, 0.05);
        if task.pin_force > 0.0 {
            limit(over(f.forces.peak, task.pin_force), 0.1);
        }
        if task.motion == AskedMotion::Parallel {
            limit(f.turn - PARALLEL, 0.2);
        }
        for (size, most) in f.size.into_iter().zip(task.room) {
            if most > 0.0 {
                limit(size - most, 1.0);
            }
        }
        for (least, is) in task.least_distances(f) {
            limit(least - is, 1.0);
        }
        if task.pulled_out > 0.0 {
            limit(over(f.pulled_out, task.pulled_out), 0.02);
        }
        DEAR * (unreached + broken) - 20.0 * f.force.max(1e-12).ln()
    }
}
