//! Where the tips of two or three jaws are drawn, whatever joins the links behind them.

use crate::chains::layout_symmetry::Symmetry;
use crate::synthesis::place::Place;
use crate::synthesis::task::Task;

/// How far ahead the tips of jaws in front are, in millimetres.
const REACH: i32 = 120;
/// A pin nearer than this to the middle of the part that is held is in its way.
const PART: f64 = 25.0;

/// What each jaw is called, the first first.
pub(super) const NAMES: [&str; 3] = ["jaw-a", "jaw-b", "jaw-c"];

/// What is so long and points from the part to each of so many jaws: opposite ways for two, at 120° for three.
#[must_use]
pub(super) fn outward(jaws: usize, length: i32) -> Vec<Place> {
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
pub(super) fn round(jaws: usize, symmetry: Symmetry) -> Option<f64> {
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
pub(super) fn tips(jaws: usize, symmetry: Symmetry, task: &Task) -> Vec<Place> {
    let is_round = round(jaws, symmetry).is_some();
    let ahead = if is_round { 0 } else { REACH };
    let mut tips = outward(jaws, task.half_opening());
    // Tips that are turned are round the middle.
    tips.iter_mut().for_each(|tip| tip.whole[0] += ahead);
    tips
}
