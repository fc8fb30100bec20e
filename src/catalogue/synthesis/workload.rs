//! Load on the grippers of a catalogue: the part between the jaws, and the links. It does not depend on the structure.

use crate::file::schema::{Coordinate, ForceEntry};
use crate::geom::vector::{Vector, add_scaled, length, sub};
use crate::synthesis::place::{Pivot, Place, middle_of, number_words};
use crate::synthesis::task::exact_list;
use serde::{Deserialize, Serialize};

/// Forces and masses, the same for every structure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Workload {
    /// The force between the part and each jaw, in N.
    pub closing: f64,
    /// Mass of the part, in kg. The jaws share its weight.
    pub part: f64,
    /// Acceleration of gravity in m/s². z is normal to the plane, or to the plane of jaw a if each jaw has its own plane; x is ahead.
    #[serde(deserialize_with = "exact_list")]
    pub gravity: [f64; 3],
    /// Mass of a metre of link, in kg.
    pub link_mass: f64,
}

impl Default for Workload {
    /// Returns the usual load: a part of 1 kg held by 100 N. Its weight, in round figures, is normal to the plane, the most severe
    /// attitude. Links have no weight.
    fn default() -> Workload {
        Workload {
            closing: 100.0,
            part: 1.0,
            gravity: [0.0, 0.0, -10.0],
            link_mass: 0.0,
        }
    }
}

/// How a part is held, and at which points.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeldPart<'a> {
    pub(super) tips: &'a [Place],
    /// Direction away from the part, at each jaw.
    pub(super) outward: &'a [Place],
    /// 1 if the jaws hold as they close, -1 if they hold as they open.
    pub(super) grip: f64,
    /// Axis of turned places.
    pub(super) pivot: Pivot,
}

/// Returns the total length and the mass centre, in millimetres, of rods from the mean of a link's points to each of them.
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
    /// Returns true if the weight of links counts.
    #[must_use]
    pub(crate) fn weighs_links(&self) -> bool {
        self.link_mass > 0.0 && self.gravity != [0.0; 3]
    }

    /// Returns the mass in kg and the mass centre in millimetres of a link with these points.
    #[must_use]
    pub fn link_mass(&self, points: &[Vector]) -> (f64, Vector) {
        let (length, centre) = link_rods(points);
        (self.link_mass * length / 1000.0, centre)
    }

    /// Returns the forces on jaws with these names: for each the push of the part, then its share of the weight.
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
