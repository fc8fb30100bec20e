//! The structures of a catalogue that are next to a given one, and the figures in which their layouts are better.

use crate::catalog::find::{Entry, read_structure};
use crate::catalog::store::{Store, StoreError};
use crate::chains::PairKind;
use crate::chains::canonical::Weighted;
use crate::chains::chain::Chain;
use crate::chains::structure::PairStructure;
use itertools::Itertools;
use serde::Serialize;
use std::collections::HashSet;

/// A figure of a layout, and which of two values is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Figure {
    /// Its column in the view `grippers`.
    pub column: &'static str,
    /// Its name in words.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    is_more_better: bool,
}

/// The figures by which layouts are compared.
pub const FIGURES: [Figure; 6] = [
    figure("least_force", "least force", "N", true),
    figure("force_ratio", "greatest over least force", "", false),
    figure("turn", "jaws turn", "°", false),
    figure("pin_force", "pin force", "N", false),
    figure("area", "box", "mm²", false),
    figure("price", "price", "", false),
];

/// Index of the least force, the only figure that depends on how the input moves.
const LEAST_FORCE: usize = 0;

const fn figure(
    column: &'static str,
    name: &'static str,
    unit: &'static str,
    is_more_better: bool,
) -> Figure {
    Figure {
        column,
        name,
        unit,
        is_more_better,
    }
}

/// The values of the figures of a layout. `None` for a figure that it lacks.
type Figures = [Option<f64>; FIGURES.len()];

/// The relations of structures that are next to each other, the nearest first.
const RELATIONS: [&str; 3] = ["other-roles", "fewer-links", "more-links"];

/// A structure next to a given one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Neighbour {
    /// Its id.
    pub id: String,
    /// Its layout.
    pub form: String,
    /// Its relation to the given one: other roles of the same chain, or the structure left if one of both loses links.
    pub relation: &'static str,
    /// Difference of their numbers of links.
    pub links: usize,
    /// The figures in which its layout is better than each layout of the given one. If that one has no layout, all figures.
    pub better: Vec<BetterFigure>,
}

/// A figure that is better.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BetterFigure {
    /// Its column.
    pub figure: &'static str,
    /// Its value.
    pub value: f64,
    /// The best of the given structure.
    pub own: Option<f64>,
}

/// Query for each layout with its form: the columns that `read` needs, then the figures.
const LAYOUTS: &str = "SELECT s.id, concat_ws(' ', s.input, s.symmetry, iif(s.parallel, 'parallel', NULL)), s.chain, s.input, s.frame, s.driver, \
     s.jaw_a, s.jaw_b, s.jaw_c, p.code, p.driven_from, g.least_force, g.force_ratio, g.turn, g.pin_force, g.width * g.height, g.price \
     FROM structures s JOIN grippers g ON g.id = s.id LEFT JOIN pairs p ON p.structure = s.id \
     WHERE g.reached = 1 AND s.links BETWEEN ?1 - 4 AND ?1 + 4";
/// Index of the first figure in a row.
const FIRST_FIGURE: usize = 11;

/// Returns the structures of a catalogue that are next to a structure and have the same number of jaws.
///
/// Structures of the same chain with other roles are next to it. So are structures with two or four links more or less. One of both is left
/// when the other loses pairs of links in a row (`without_two_links`). Four links count only for symmetric layouts, in which each half
/// loses two links.
///
/// # Errors
/// Returns an error if the database cannot be read.
///
/// # Complexity
/// A few canonical numberings for each layout of up to four links more or less; some fifty for symmetric ones of four more.
pub fn find_neighbours(
    store: &Store,
    structure: &PairStructure,
) -> Result<Vec<Neighbour>, StoreError> {
    let (mut best, mut near) = (None, Vec::new());
    let links = structure.chain.links();
    let (_, rows) = store.query_rows(LAYOUTS, Some(&links.to_string()))?;
    let own = Own::new(structure);
    for row in rows {
        let jaws = |s: &PairStructure| s.roles.jaws.len();
        let Some(other) = read_structure(&row).filter(|other| jaws(other) == jaws(structure))
        else {
            continue;
        };
        let mut figures: Figures = std::array::from_fn(|i| row[FIRST_FIGURE + i].as_f64());
        if other.input_slides() != structure.input_slides() {
            figures[LEAST_FORCE] = None;
        }
        let entry = Entry::new(&row);
        let key = other.canonical_key();
        if key == own.key {
            let best = best.get_or_insert(figures);
            *best = std::array::from_fn(|i| FIGURES[i].better_of(best[i], figures[i]));
        } else if let Some(relation) = own.relation_to(&other, &key, entry.is_symmetric()) {
            near.push((relation, entry, figures));
        }
    }
    let better = |here: &Figures| {
        let all = (0..FIGURES.len()).filter_map(|i| {
            let (value, own) = (here[i]?, best.map(|b| b[i]));
            let is_better =
                own.is_none_or(|own| own.is_some_and(|own| FIGURES[i].is_better(value, own)));
            is_better.then(|| BetterFigure {
                figure: FIGURES[i].column,
                own: own.flatten(),
                value,
            })
        });
        all.collect_vec()
    };
    let mut out = near
        .into_iter()
        .map(|(relation, entry, figures)| (relation, entry, better(&figures)))
        .collect_vec();
    out.sort_by_cached_key(|(relation, entry, better)| {
        let count = if best.is_some() { better.len() } else { 0 };
        (usize::MAX - count, *relation, entry.id.clone())
    });
    let neighbour = |((relation, links), entry, better): ((usize, usize), Entry, _)| Neighbour {
        id: entry.id,
        form: entry.form,
        relation: RELATIONS[relation],
        links,
        better,
    };
    Ok(out.into_iter().map(neighbour).collect())
}

impl Figure {
    fn better_of(&self, a: Option<f64>, b: Option<f64>) -> Option<f64> {
        let of_two = if self.is_more_better {
            f64::max
        } else {
            f64::min
        };
        [a, b].into_iter().flatten().reduce(of_two)
    }

    fn is_better(&self, a: f64, than: f64) -> bool {
        let gain = if self.is_more_better {
            a - than
        } else {
            than - a
        };
        gain > 0.01 * than.abs().max(f64::MIN_POSITIVE)
    }
}

/// A structure, and the keys of the structures that remain without two links and without four.
struct Own {
    links: usize,
    chain: Chain,
    key: Weighted,
    less: [HashSet<Weighted>; 2],
}

impl Own {
    fn new(structure: &PairStructure) -> Own {
        Own {
            links: structure.chain.links(),
            chain: hinged_chain(structure),
            key: structure.canonical_key(),
            less: [2, 4].map(|by| keys_without(structure, by)),
        }
    }

    /// Returns the relation of another structure, with its key, to this one: its index in the list, and the difference in links.
    fn relation_to(
        &self,
        other: &PairStructure,
        key: &Weighted,
        is_symmetric: bool,
    ) -> Option<(usize, usize)> {
        let links = other.chain.links();
        match links.abs_diff(self.links) {
            0 => (hinged_chain(other) == self.chain).then_some((0, 0)),
            4 if !is_symmetric => None,
            by @ (2 | 4) if links < self.links => {
                let is_left = self.less[by / 2 - 1].contains(key);
                is_left.then_some((1, by))
            }
            by @ (2 | 4) => {
                let is_left = keys_without(other, by).contains(&self.key);
                is_left.then_some((2, by))
            }
            _ => None,
        }
    }
}

/// Returns the chain in canonical numbering with a hinge as its input: forms differ in the motion of the input.
fn hinged_chain(structure: &PairStructure) -> Chain {
    let chain = structure.chain.clone();
    chain
        .with_pair(structure.roles.input, PairKind::Hinge)
        .canonical_form()
        .0
}

/// Returns the keys of the structures that remain without two links, or without four.
fn keys_without(structure: &PairStructure, links: usize) -> HashSet<Weighted> {
    let mut left = structure.without_two_links();
    if links == 4 {
        left = (left.iter().flat_map(PairStructure::without_two_links)).collect();
    }
    left.iter().map(PairStructure::canonical_key).collect()
}
