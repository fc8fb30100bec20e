//! Task of a gripper: the parts it takes and how, the motion of its jaws, and the available room. Also the limits for layouts, and the
//! drawn places of the tips of two or three jaws, which do not depend on the links behind them.

use crate::chains::Symmetry;
use crate::synthesis::place::Place;
use serde::de::{Deserializer, Error};
use serde::{Deserialize, Serialize};

/// Returns a list of exactly N numbers: the deserializer of TOML ignores the values after those that it needs.
///
/// # Errors
/// Returns an error if the list has more or fewer.
pub(super) fn exact_list<'de, const N: usize, D: Deserializer<'de>>(
    from: D,
) -> Result<[f64; N], D::Error> {
    let all = Vec::<f64>::deserialize(from)?;
    let count = all.len();
    let wrong = |_| D::Error::custom(format!("{count} values; write {N}, no more and no fewer"));
    all.try_into().map_err(wrong)
}

/// From which side the jaws hold a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HeldFrom {
    /// Around it: the jaws hold as they close.
    Outside,
    /// In a hole of it: the jaws hold as they open.
    Inside,
}

impl HeldFrom {
    /// Every side with its word.
    pub const ALL: [(HeldFrom, &'static str); 2] =
        [(HeldFrom::Outside, "outside"), (HeldFrom::Inside, "inside")];

    /// Returns 1 if the jaws hold as they close, -1 if they hold as they open.
    #[must_use]
    pub fn grip_sign(self) -> f64 {
        match self {
            HeldFrom::Outside => 1.0,
            HeldFrom::Inside => -1.0,
        }
    }
}

/// Motion of the jaws that is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AskedMotion {
    /// Any motion.
    Any,
    /// Without turning.
    Parallel,
    /// About hinges in the frame.
    Swinging,
}

impl AskedMotion {
    /// Every motion with its word.
    pub const ALL: [(AskedMotion, &'static str); 3] = [
        (AskedMotion::Any, "any"),
        (AskedMotion::Parallel, "parallel"),
        (AskedMotion::Swinging, "swinging"),
    ];
}

/// Aim of the choice among layouts that fulfil their task.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Aim {
    /// A balance: few crossings, links neither long nor short, good transmission angles of rods, even forces.
    Balanced,
    /// The greatest possible least force of a jaw over the stroke, within the limits.
    Force,
}

impl Aim {
    /// Every aim with its word.
    pub const ALL: [(Aim, &'static str); 2] = [(Aim::Balanced, "balanced"), (Aim::Force, "force")];
}

/// Task of every gripper of a catalogue.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Task {
    /// The width of the narrowest part, in mm: the smallest distance of the tips.
    pub narrowest: f64,
    /// The width of the widest part, in mm.
    pub widest: f64,
    /// From which side parts are held.
    pub grip: HeldFrom,
    /// Motion of the jaws that is asked for.
    pub motion: AskedMotion,
    /// Minimum of the least force of a jaw over the stroke: N for 1 N of a sliding drive, or for 1 Nm of a turning one; 0 for no limit.
    pub least_force: f64,
    /// Maximum ratio of the greatest to the least force of a jaw over the stroke.
    pub force_ratio: f64,
    /// Minimum transmission angle over the stroke, of rods and by joint forces at driver and jaws, in degrees.
    pub transmission: f64,
    /// Maximum joint force over the stroke, in N for 1 N of each jaw; 0 for no limit.
    pub pin_force: f64,
    /// Minimum efficiency over the stroke; 0 for no limit.
    pub efficiency: f64,
    /// Maximum width and height of the box around pins, tips and pitch circles over the stroke, in mm; 0 for no limit.
    #[serde(deserialize_with = "exact_list")]
    pub room: [f64; 2],
    /// Minimum distance of pins over the stroke, in mm, from centre to centre; 0 for only the usual wish of 14 as drawn.
    pub pin_distance: f64,
    /// Minimum distance of the drawn tips ahead of all pins, in mm, if the part is ahead of the gripper; 0 for only the usual wish of 25.
    pub reach: f64,
    /// Whether pins and pitch circles of each jaw's half must keep to its side of the middle, by half of the distance of pins, if the part
    /// is ahead.
    pub own_sides: bool,
    /// Maximum ratio of the longest to the shortest length of a cylinder between two links, from pin to pin; 0 for no limit.
    pub pulled_out: f64,
    /// Aim of the choice among layouts.
    pub aim: Aim,
    /// Friction for efficiencies.
    pub friction: Friction,
}

/// Dry friction in the joints.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Friction {
    /// Force of friction over the normal force.
    pub coefficient: f64,
    /// Radius of the pins, in mm.
    pub pin_radius: f64,
    /// Length of the guide of a sliding driver, in mm.
    pub guide: f64,
}

impl Default for Friction {
    /// Returns the values of greased steel: a coefficient of 0.1, pins of 8 mm, and a guide of 40 mm.
    fn default() -> Friction {
        Friction {
            coefficient: 0.1,
            pin_radius: 4.0,
            guide: 40.0,
        }
    }
}

impl Default for Task {
    /// Returns the usual task: parts of up to 50 mm, held from outside. The force of a jaw is at most three times the least, and the
    /// transmission angle at least 25°. Joint forces are at most 10 N for 1 N of each jaw, and the efficiency is at least a half.
    fn default() -> Task {
        Task {
            narrowest: 0.0,
            widest: 50.0,
            grip: HeldFrom::Outside,
            motion: AskedMotion::Any,
            least_force: 0.0,
            force_ratio: 3.0,
            transmission: 25.0,
            pin_force: 10.0,
            efficiency: 0.5,
            room: [0.0; 2],
            pin_distance: 0.0,
            reach: 0.0,
            own_sides: false,
            pulled_out: 1.6,
            aim: Aim::Balanced,
            friction: Friction::default(),
        }
    }
}

/// Half the drawn opening if the task has room for it, in millimetres.
const HALF_OPENING: i32 = 15;
/// Joints nearer to each other than this collide, in mm.
const NEAR: f64 = 14.0;
/// Joints nearer to the tips than this are in the region of the part, in mm.
const BEHIND: f64 = 25.0;
/// Maximum turn of a parallel jaw over the stroke, in degrees.
pub(super) const PARALLEL: f64 = 1.0;

impl Task {
    /// Returns half the distance of the tips in the drawn pose, in whole millimetres: within the stroke, and not 0.
    #[must_use]
    pub fn half_opening(&self) -> i32 {
        let drawn = f64::from(2 * HALF_OPENING);
        if self.narrowest < drawn && drawn < self.widest {
            return HALF_OPENING;
        }
        #[allow(clippy::cast_possible_truncation, reason = "some millimetres")]
        let half = ((self.narrowest + self.widest) / 4.0).round() as i32;
        half.max(1)
    }

    /// Returns the desired minimum distance between joints, and from the joints to the tips: as asked, or as usual. In mm.
    pub(super) fn wished_distances(&self) -> [f64; 2] {
        let asked = [(self.pin_distance, NEAR), (self.reach, BEHIND)];
        asked.map(|(asked, usual)| if asked > 0.0 { asked } else { usual })
    }

    /// Returns the change of the distance between the tips over the stroke, in millimetres.
    ///
    /// # Examples
    /// ```
    /// use ozols::synthesis::task::Task;
    /// let task = Task { narrowest: 10.0, widest: 60.0, ..Task::default() };
    /// assert_eq!(task.opening_span(), 50.0); // mm
    /// assert_eq!(task.half_opening(), 15); // Drawn open by 30 mm.
    /// ```
    #[must_use]
    pub fn opening_span(&self) -> f64 {
        self.widest - self.narrowest
    }
}

/// Limits for layouts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Maximum ratio of the longest link to the shortest, without the frame.
    pub ratio: f64,
    /// Maximum number of crossings of links, and of pins on foreign links, if no layers are known in which links pass each other.
    pub crossings: usize,
    /// The task.
    pub task: Task,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            ratio: 8.0,
            crossings: 6,
            task: Task::default(),
        }
    }
}

/// Returns the excess over a limit, squared, in units of a width.
pub(crate) fn beyond_limit(over: f64, width: f64) -> f64 {
    // Most are within their limits, and a division takes long.
    if over > 0.0 {
        (over / width).powi(2)
    } else {
        0.0
    }
}

/// How far ahead the tips are drawn if the jaws are in front, in millimetres.
const REACH: i32 = 120;
/// A pin nearer than this to the middle of the held part is in its way, in mm.
const PART: f64 = 25.0;

/// Names of the jaws, in order.
pub(crate) const JAW_NAMES: [&str; 3] = ["jaw-a", "jaw-b", "jaw-c"];

/// Returns the vector of this length from the part to each jaw: opposite directions for two, at 120° for three.
#[must_use]
pub(crate) fn outward_vectors(jaws: usize, length: i32) -> Vec<Place> {
    match jaws {
        2 => [[0, length], [0, -length]].map(Place::from).into(),
        _ => (0..3)
            .map(|thirds| Place {
                whole: [0, length],
                thirds,
                ..Place::default()
            })
            .collect(),
    }
}

/// Returns the minimum distance of pins from the middle, in millimetres, for jaws that close on a part over the centre, with the gripper
/// around it. `None` if the jaws are in front.
#[must_use]
pub(crate) fn room_round_part(jaws: usize, symmetry: Symmetry) -> Option<f64> {
    let is_round = symmetry == Symmetry::HalfTurn || jaws > 2;
    // Pins in the region of the part are in its way, except for those of a drive behind it.
    let near = match symmetry {
        Symmetry::Generic => PART,
        _ => 0.0,
    };
    is_round.then_some(near)
}

/// Returns the drawn places of the tips for a task, in millimetres: ahead, or around the middle.
#[must_use]
pub(crate) fn draw_tips(jaws: usize, symmetry: Symmetry, task: &Task) -> Vec<Place> {
    let is_round = room_round_part(jaws, symmetry).is_some();
    let ahead = if is_round { 0 } else { REACH };
    let mut tips = outward_vectors(jaws, task.half_opening());
    // Turned tips are around the middle.
    tips.iter_mut().for_each(|tip| tip.whole[0] += ahead);
    tips
}
