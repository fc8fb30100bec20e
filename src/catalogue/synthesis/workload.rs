//! What a gripper of a catalogue carries, whatever its structure: the part between its jaws, and its own links.

use crate::file::schema::{Coordinate, ForceEntry};
use crate::geom::vector::{Vector, add_scaled, length, sub};
use crate::synthesis::place::{Pivot, Place, middle_of, number_words};
use crate::synthesis::task::exact_list;
use serde::{Deserialize, Serialize};

/// Forces and masses that every structure has alike.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Workload {
    /// The force between the part and each jaw, in N.
    pub closing: f64,
    /// Mass of the part, in kg: the jaws share its weight.
    pub part: f64,
    /// Acceleration of gravity in m/s²; z is square to the plane, of jaw a where each has its own, x is ahead.
    #[serde(deserialize_with = "exact_list")]
    pub gravity: [f64; 3],
    /// Mass of a metre of link, in kg.
    pub link_mass: f64,
}

impl Default for Workload {
    /// A part of 1 kg held by 100 N, its weight, in round figures, across the plane: the hardest attitude. Links weigh nothing.
    fn default() -> Workload {
        Workload {
            closing: 100.0,
            part: 1.0,
            gravity: [0.0, 0.0, -10.0],
            link_mass: 0.0,
        }
    }
}

/// Where and how a part is held.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeldPart<'a> {
    pub(super) tips: &'a [Place],
    /// Away from the part, at each jaw.
    pub(super) outward: &'a [Place],
    /// 1 where jaws hold as they close, -1 where they do as they open.
    pub(super) grip: f64,
    /// What turned places are turned about.
    pub(super) pivot: Pivot,
}

/// A rod from the middle of a link's points to each of them, in millimetres: their length, and where their mass is.
fn link_rods(points: &[Vector]) -> (f64, Vector) {
    let centre = middle_of(points);
    let (mut whole, mut moment) = (0.0, [0.0; 3]);
    for p in points {
        let rod = length(sub(*p, centre));
        whole += rod;
        moment = add_scaled(moment, rod, middle_of(&[centre, *p]));
    }
    if whole > 0.0 {
        (whole, moment.map(|m| m / whole))
    } else {
        (0.0, centre)
    }
}

impl Workload {
    /// Whether links have weights.
    #[must_use]
    pub(crate) fn weighs_links(&self) -> bool {
        self.link_mass > 0.0 && self.gravity != [0.0; 3]
    }

    /// Mass in kg and mass centre in millimetres of a link with these points.
    #[must_use]
    pub fn link_mass(&self, points: &[Vector]) -> (f64, Vector) {
        let (length, centre) = link_rods(points);
        (self.link_mass * length / 1000.0, centre)
    }

    /// The forces on jaws of these names: of each the part's push, then its share of the weight.
    pub(super) fn jaw_forces(&self, jaws: &[String], held: &HeldPart<'_>) -> Vec<ForceEntry> {
        let entry = |n: usize, force| ForceEntry {
            link: jaws[n].clone(),
            point: held.pivot.point(held.tips[n]),
            force,
            from: None,
            to: None,
            state: None,
        };
        let mut out = Vec::new();
        if self.closing > 0.0 {
            // In a hole the part pushes inward.
            let holds = held.grip * self.closing;
            for (n, away) in held.outward.iter().enumerate() {
                let [x, y] = away.whole.map(|x| f64::from(x) * holds);
                out.push(entry(n, held.pivot.turned([x, y, 0.0], away.thirds)));
            }
        }
        let weight = self.gravity.map(|g| g * self.part);
        if weight != [0.0; 3] {
            let share = |w: f64| match jaws.len() {
                _ if w == 0.0 => Coordinate::Integer(0),
                2 => number_words(w / 2.0),
                n => Coordinate::Expression(format!("{w}/{n}")),
            };
            out.extend((0..jaws.len()).map(|n| entry(n, weight.map(share))));
        }
        out
    }
}
