//! What a gripper is to do: which parts it takes and how, how its jaws may move, and the room there is; what a layout must be like to be
//! taken; and where the tips of two or three jaws are drawn, whatever joins the links behind them.

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
    /// Round it: the jaws hold as they close.
    Outside,
    /// In a hole of it: the jaws hold as they open.
    Inside,
}

impl HeldFrom {
    /// Every side with its word.
    pub const ALL: [(HeldFrom, &'static str); 2] =
        [(HeldFrom::Outside, "outside"), (HeldFrom::Inside, "inside")];

    /// 1 where the jaws hold as they close, -1 where they do as they open.
    #[must_use]
    pub fn grip_sign(self) -> f64 {
        match self {
            HeldFrom::Outside => 1.0,
            HeldFrom::Inside => -1.0,
        }
    }
}

/// How the jaws are to move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AskedMotion {
    /// As they like.
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

/// What layouts that do their task are chosen for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Aim {
    /// A little of all: few crossings, links neither long nor short, rods that pull well, even forces.
    Balanced,
    /// The least force of a jaw over the stroke, as great as the limits let it be.
    Force,
}

impl Aim {
    /// Every aim with its word.
    pub const ALL: [(Aim, &'static str); 2] = [(Aim::Balanced, "balanced"), (Aim::Force, "force")];
}

/// What every gripper of a catalogue is to do, alike.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Task {
    /// The width of the narrowest part, in mm: so near the tips come to each other.
    pub narrowest: f64,
    /// The width of the widest part, in mm.
    pub widest: f64,
    /// From which side parts are held.
    pub grip: HeldFrom,
    /// How the jaws are to move.
    pub motion: AskedMotion,
    /// The least force of a jaw over the stroke, at least: N for 1 N of a sliding drive, or for 1 Nm of a turning one; 0 where any
    /// will do.
    pub least_force: f64,
    /// The greatest force of a jaw over the least, over the stroke, at most.
    pub force_ratio: f64,
    /// The transmission angle over the stroke at least, of rods and by joint forces at driver and jaws, in degrees.
    pub transmission: f64,
    /// The greatest joint force over the stroke at most, in N for 1 N of each jaw; 0 where any will do.
    pub pin_force: f64,
    /// The efficiency over the stroke at least; 0 where any will do.
    pub efficiency: f64,
    /// Width and height of the box round pins, tips and pitch circles over the stroke at most, in mm; 0 where it may be of any size.
    #[serde(deserialize_with = "exact_list")]
    pub room: [f64; 2],
    /// How far pins are apart over the stroke at least, in mm, from middle to middle; 0 where no more than 14 as drawn is wished.
    pub pin_distance: f64,
    /// How far the tips are drawn ahead of all pins at least, in mm, of a gripper that has the part ahead; 0 where no more than 25 is
    /// wished.
    pub reach: f64,
    /// Whether pins and pitch circles of each jaw's half are to keep on its side of the middle, by half of the pins' distance, where
    /// the part is ahead.
    pub own_sides: bool,
    /// How long a cylinder between two links is pulled out, from pin to pin, over pushed in, at most; 0 where any will do.
    pub pulled_out: f64,
    /// What layouts are chosen for.
    pub aim: Aim,
    /// What efficiencies are reckoned with.
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
    /// Greased steel: 0.1; pins of 8 mm, a guide of 40 mm.
    fn default() -> Friction {
        Friction {
            coefficient: 0.1,
            pin_radius: 4.0,
            guide: 40.0,
        }
    }
}

impl Default for Task {
    /// Parts of up to 50 mm, from outside, with a force that is at most three times the least, a transmission angle of 25° at least,
    /// joint forces of 10 N for 1 N of each jaw at most, and an efficiency of a half at least.
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

/// Half of what a gripper is drawn open by where the task has room for it, in millimetres.
const HALF_OPENING: i32 = 15;
/// Joints nearer to each other than this run into each other, in mm.
const NEAR: f64 = 14.0;
/// Joints nearer to the tips than this are where the part is, in mm.
const BEHIND: f64 = 25.0;
/// A jaw that is to be parallel turns by this at most over the stroke, in degrees.
pub(super) const PARALLEL: f64 = 1.0;

impl Task {
    /// Half the distance of the tips as a gripper is drawn, in whole millimetres: within the stroke, and not nothing.
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

    /// How far apart joints are wished at least, and how far behind the tips: as asked, or as is usual. In mm.
    pub(super) fn wished_distances(&self) -> [f64; 2] {
        let asked = [(self.pin_distance, NEAR), (self.reach, BEHIND)];
        asked.map(|(asked, usual)| if asked > 0.0 { asked } else { usual })
    }

    /// By how much the tips go apart over the stroke, in millimetres.
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

/// What a layout must be like to be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The longest link over the shortest, the frame left out.
    pub ratio: f64,
    /// Crossings of links, and pins that lie on links that they are no part of, where no planes are known in which links pass each
    /// other.
    pub crossings: usize,
    /// What it is to do.
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

/// How far a number is beyond a limit, squared, in units of a width.
pub(crate) fn beyond_limit(over: f64, width: f64) -> f64 {
    (over.max(0.0) / width).powi(2)
}

/// How far ahead the tips of jaws in front are, in millimetres.
const REACH: i32 = 120;
/// A pin nearer than this to the middle of the part that is held is in its way.
const PART: f64 = 25.0;

/// What each jaw is called, the first first.
pub(crate) const JAW_NAMES: [&str; 3] = ["jaw-a", "jaw-b", "jaw-c"];

/// What is so long and points from the part to each of so many jaws: opposite ways for two, at 120° for three.
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

/// Of jaws that close on a part over the centre, all of the gripper round it, how near to the middle pins may be, in millimetres; `None`
/// where the jaws are in front.
#[must_use]
pub(crate) fn room_round_part(jaws: usize, symmetry: Symmetry) -> Option<f64> {
    let is_round = symmetry == Symmetry::HalfTurn || jaws > 2;
    // Pins where the part is are in its way, but for those of a drive behind it.
    let near = match symmetry {
        Symmetry::Generic => PART,
        _ => 0.0,
    };
    is_round.then_some(near)
}

/// Where the tips of so many jaws are drawn for a task, in millimetres: ahead, or round the middle.
#[must_use]
pub(crate) fn draw_tips(jaws: usize, symmetry: Symmetry, task: &Task) -> Vec<Place> {
    let is_round = room_round_part(jaws, symmetry).is_some();
    let ahead = if is_round { 0 } else { REACH };
    let mut tips = outward_vectors(jaws, task.half_opening());
    // Tips that are turned are round the middle.
    tips.iter_mut().for_each(|tip| tip.whole[0] += ahead);
    tips
}
