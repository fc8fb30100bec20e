//! What a stroke does not do of what the task asks: the worst of it, in words.

use super::judge::StrokeFigures;
use super::walk::StrokeEnd;
use crate::synthesis::task::{AskedMotion, Limits, PARALLEL};
use thiserror::Error;

/// What is not done, from what matters most on.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum Shortfall {
    /// The jaws do not close so far.
    #[error("closes to {reached:.1} mm where {asked} mm is asked: {}", why.words())]
    Closing {
        /// The least width reached, in mm.
        reached: f64,
        /// The least asked, in mm.
        asked: f64,
        /// Why.
        why: StrokeEnd,
    },
    /// The jaws do not open so far.
    #[error("opens to {reached:.1} mm where {asked} mm is asked: {}", why.words())]
    Opening {
        /// The greatest width reached, in mm.
        reached: f64,
        /// The greatest asked, in mm.
        asked: f64,
        /// Why.
        why: StrokeEnd,
    },
    /// A jaw opens while the others close.
    #[error("a jaw opens on a part of the stroke on which the jaws close")]
    WrongWay,
    /// The force is too small somewhere.
    #[error(
        "a jaw has {force:.3} N for 1 N of the drive, or for 1 Nm of one that turns, where {least} N are asked"
    )]
    Force {
        /// The least over the stroke, in N for 1 N or 1 Nm.
        force: f64,
        /// At least.
        least: f64,
    },
    /// The force changes too much.
    #[error("the greatest force of a jaw is {ratio:.1} times the least where {most} are allowed")]
    ForceRatio {
        /// The greatest over the least.
        ratio: f64,
        /// At most.
        most: f64,
    },
    /// A jaw that is to be parallel turns.
    #[error("a jaw turns by {turn:.1}° where it is to be parallel")]
    Turn {
        /// By how much, in degrees.
        turn: f64,
    },
    /// A jaw that is to swing has no hinge in the frame.
    #[error("a jaw that is to swing has no hinge in the frame")]
    NotSwinging,
    /// It needs more room.
    #[error("takes {:.0} mm by {:.0} mm where there are {} by {}", size[0], size[1], room[0], room[1])]
    Room {
        /// The box over the stroke, in mm.
        size: [f64; 2],
        /// The room, in mm.
        room: [f64; 2],
    },
    /// Pins come too near to each other.
    #[error("pins come within {apart:.1} mm of each other where {least} mm are asked")]
    Pins {
        /// How near, in mm.
        apart: f64,
        /// At least, in mm.
        least: f64,
    },
    /// Pins are where the part is.
    #[error(
        "the tips are drawn {reach:.0} mm ahead of the foremost pin where {least} mm are asked"
    )]
    Reach {
        /// How far, in mm.
        reach: f64,
        /// At least, in mm.
        least: f64,
    },
    /// A half comes near the middle, or beyond it.
    #[error(
        "pins or pitch circles of a jaw's half are {on_side:.1} mm on its side of the middle where {least} mm are asked"
    )]
    Sides {
        /// How far they keep on their side, in mm: less than nothing beyond the middle.
        on_side: f64,
        /// At least, in mm.
        least: f64,
    },
    /// A cylinder is too short for its stroke.
    #[error(
        "the cylinder is {ratio:.2} times as long pulled out as pushed in where {most} are allowed"
    )]
    Cylinder {
        /// Pulled out over pushed in.
        ratio: f64,
        /// At most.
        most: f64,
    },
    /// Rods pull badly somewhere.
    #[error("the transmission angle falls to {worst:.0}° over the stroke where {least}° are asked")]
    Transmission {
        /// The worst, in degrees.
        worst: f64,
        /// The least allowed, in degrees.
        least: f64,
    },
}

/// Less than this is rounding, in mm.
pub(super) const NOISE: f64 = 1e-6;

impl Shortfall {
    /// Whether it is that the jaws do not come as far together or apart as is asked.
    #[must_use]
    pub fn is_of_reach(&self) -> bool {
        matches!(self, Shortfall::Closing { .. } | Shortfall::Opening { .. })
    }
}

impl Limits {
    /// The first that a stroke lacks of what the task asks, `swings` being whether every jaw turns about a hinge in the frame.
    #[must_use]
    pub fn shortfall(&self, f: &StrokeFigures, swings: bool) -> Option<Shortfall> {
        let task = &self.task;
        if let Some(why) = f.ends[0] {
            let (reached, asked) = (f.reached[0], task.narrowest);
            return Some(Shortfall::Closing {
                reached,
                asked,
                why,
            });
        }
        if let Some(why) = f.ends[1] {
            let (reached, asked) = (f.reached[1], task.widest);
            return Some(Shortfall::Opening {
                reached,
                asked,
                why,
            });
        }
        if f.straightness <= 0.0 {
            return Some(Shortfall::WrongWay);
        }
        let (force, least) = (f.force, task.least_force);
        if force < least {
            return Some(Shortfall::Force { force, least });
        }
        let (ratio, most) = (f.force_ratio(), task.force_ratio);
        if ratio > most {
            return Some(Shortfall::ForceRatio { ratio, most });
        }
        let turn = f.turn;
        match task.motion {
            AskedMotion::Parallel if turn > PARALLEL => return Some(Shortfall::Turn { turn }),
            AskedMotion::Swinging if !swings => {
                return Some(Shortfall::NotSwinging);
            }
            AskedMotion::Any | AskedMotion::Parallel | AskedMotion::Swinging => {}
        }
        let (size, room) = (f.size, task.room);
        if (0..2).any(|k| room[k] > 0.0 && size[k] > room[k] + NOISE) {
            return Some(Shortfall::Room { size, room });
        }
        let (apart, least) = (f.pin_distance, task.pin_distance);
        if apart < least - NOISE {
            return Some(Shortfall::Pins { apart, least });
        }
        let (reach, least) = (f.reach, task.reach);
        if reach < least - NOISE {
            return Some(Shortfall::Reach { reach, least });
        }
        let (on_side, least) = (f.on_side, 0.5 * task.distances()[0]);
        if task.own_sides && on_side < least - NOISE {
            return Some(Shortfall::Sides { on_side, least });
        }
        let (ratio, most) = (f.pulled_out, task.pulled_out);
        if most > 0.0 && ratio > most {
            return Some(Shortfall::Cylinder { ratio, most });
        }
        let (worst, least) = (f.transmission, self.transmission);
        (worst < least).then_some(Shortfall::Transmission { worst, least })
    }
}
