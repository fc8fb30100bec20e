//! What of a catalogue is next to a mechanism's structure, and what it does better.

use crate::catalog::neighbours::{FIGURES, Figures, Nearness, Neighbour, Neighbours};
use crate::format::significant;
use itertools::Itertools;
use serde::Serialize;

/// Neighbours that the text names; JSON has all.
const NAMED: usize = 8;

/// A structure next to the one asked for.
#[derive(Debug, Clone, Serialize)]
pub(super) struct NeighbourData {
    id: String,
    form: String,
    /// `other-roles`, `fewer-links` or `more-links`.
    relation: &'static str,
    /// How many links less or more.
    links: usize,
    /// Each figure in which it is better than every layout of the structure itself; all its figures where the catalogue has none.
    better: Vec<BetterData>,
}

#[derive(Debug, Clone, Serialize)]
struct BetterData {
    figure: &'static str,
    value: f64,
    /// The best of the structure's own layouts.
    own: Option<f64>,
}

impl NeighbourData {
    /// Of each neighbour, in order.
    #[must_use]
    pub(super) fn all(neighbours: &Neighbours) -> Vec<NeighbourData> {
        let own = neighbours.own.as_ref();
        let near = neighbours.near.iter();
        near.map(|n| NeighbourData::new(n, own)).collect()
    }

    fn new(n: &Neighbour, own: Option<&Figures>) -> NeighbourData {
        let (relation, links) = match n.relation {
            Nearness::OtherRoles => ("other-roles", 0),
            Nearness::Fewer(links) => ("fewer-links", links),
            Nearness::More(links) => ("more-links", links),
        };
        let places = match own {
            Some(own) => n.better(own).collect_vec(),
            None => (0..FIGURES.len()).collect(),
        };
        let better = places.into_iter().filter_map(|i| {
            Some(BetterData {
                figure: FIGURES[i].column,
                value: n.figures[i]?,
                own: own.and_then(|own| own[i]),
            })
        });
        NeighbourData {
            id: n.entry.id.clone(),
            form: n.entry.form.clone(),
            relation,
            links,
            better: better.collect(),
        }
    }
}

/// A line for each of the first; nothing where there are none.
pub(super) fn neighbours_text(all: &[NeighbourData]) -> String {
    let useful = all.iter().filter(|n| !n.better.is_empty()).collect_vec();
    if useful.is_empty() {
        return String::new();
    }
    let mut out = String::from(
        "Next to it in the catalogue, and what that does better than each of its own layouts:\n",
    );
    for n in useful.iter().take(NAMED) {
        let relation = match n.relation {
            "other-roles" => "other roles".to_owned(),
            "fewer-links" => format!("{} links less", n.links),
            _ => format!("{} links more", n.links),
        };
        let better = n.better.iter().map(BetterData::said).join("; ");
        out += &format!("  {}, {}, {relation}: {better}\n", n.id, n.form);
    }
    if useful.len() > NAMED {
        out += &format!("  and {} more, which --json has\n", useful.len() - NAMED);
    }
    out
}

impl BetterData {
    fn said(&self) -> String {
        let known = FIGURES.iter().find(|f| f.column == self.figure);
        let (name, unit) = known.map_or((self.figure, ""), |f| (f.name, f.unit));
        let space = if unit.is_empty() || unit == "°" {
            ""
        } else {
            " "
        };
        let value = format!("{}{space}{unit}", significant(self.value));
        match self.own {
            Some(own) => format!("{name} {value}, here {} at best", significant(own)),
            None => format!("{name} {value}"),
        }
    }
}
