//! Shortfalls: the first requirement of a task that a stroke does not meet, in words.

use super::judge::StrokeFigures;
use crate::synthesis::task::{AskedMotion, Limits, PARALLEL};
use std::fmt;

/// A requirement that is not met.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shortfall {
    /// Whether the jaws do not close or open as far as the task asks.
    pub is_of_reach: bool,
    words: String,
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

/// Smaller differences are rounding errors, in mm.
pub(super) const NOISE: f64 = 1e-6;

impl Limits {
    /// Returns the first requirement of the task that a stroke does not meet. `swings` is true if every jaw turns about a hinge in the
    /// frame.
    #[must_use]
    pub fn find_shortfall(&self, f: &StrokeFigures, swings: bool) -> Option<Shortfall> {
        let task = &self.task;
        let far = [("closes", task.narrowest), ("opens", task.widest)];
        for (n, (goes, asked)) in far.into_iter().enumerate() {
            if let Some(why) = f.ends[n] {
                let (reached, why) = (f.reached[n], why.words());
                let words = format!("{goes} to {reached:.1} mm; {asked} mm required: {why}");
                return Some(Shortfall {
                    is_of_reach: true,
                    words,
                });
            }
        }
        let words = self.broken(f, swings)?;
        Some(Shortfall {
            is_of_reach: false,
            words,
        })
    }

    fn broken(&self, f: &StrokeFigures, swings: bool) -> Option<String> {
        let task = &self.task;
        let (ratio, turn, [width, height]) = (f.force_ratio(), f.turn, f.size);
        let room = task.room;
        let side = 0.5 * task.wished_distances()[0];
        Some(if f.straightness <= 0.0 {
            "a jaw opens on a part of the stroke on which the jaws close".to_owned()
        } else if f.force < task.least_force {
            format!(
                "a jaw has {:.3} N for 1 N of the drive, or for 1 Nm of one that turns, where {} N are asked",
                f.force, task.least_force
            )
        } else if ratio > task.force_ratio {
            let most = task.force_ratio;
            format!(
                "the greatest force of a jaw is {ratio:.1} times the least where {most} are allowed"
            )
        } else if task.motion == AskedMotion::Parallel && turn > PARALLEL {
            format!("a jaw rotates by {turn:.1}°; it must stay parallel")
        } else if task.motion == AskedMotion::Swinging && !swings {
            "a jaw that is to swing has no hinge in the frame".to_owned()
        } else if (0..2).any(|k| room[k] > 0.0 && f.size[k] > room[k] + NOISE) {
            let [wide, high] = room;
            format!("takes {width:.0} mm by {height:.0} mm where there are {wide} by {high}")
        } else if f.pin_distance < task.pin_distance - NOISE {
            let (apart, least) = (f.pin_distance, task.pin_distance);
            format!("pins come within {apart:.1} mm of each other where {least} mm are asked")
        } else if f.reach < task.reach - NOISE {
            format!(
                "the tips are drawn {:.0} mm ahead of the foremost pin where {} mm are asked",
                f.reach, task.reach
            )
        } else if task.own_sides && f.on_side < side - NOISE {
            format!(
                "pins or pitch circles of a jaw's half are {:.1} mm on its side of the middle where {side} mm are asked",
                f.on_side
            )
        } else if task.pulled_out > 0.0 && f.pulled_out > task.pulled_out {
            format!(
                "the cylinder is {:.2} times as long pulled out as pushed in where {} are allowed",
                f.pulled_out, task.pulled_out
            )
        } else if f.transmission < task.transmission {
            format!(
                "the transmission angle falls to {:.1}° over the stroke where {}° are asked",
                f.transmission, task.transmission
            )
        } else if task.pin_force > 0.0 && f.forces.peak > task.pin_force {
            format!(
                "a joint bears {:.1} N for 1 N of each jaw where {} N are allowed",
                f.forces.peak, task.pin_force
            )
        } else if f.forces.efficiency < task.efficiency {
            format!(
                "the efficiency falls to {:.2} over the stroke where {} is asked",
                f.forces.efficiency, task.efficiency
            )
        } else {
            return None;
        })
    }
}
