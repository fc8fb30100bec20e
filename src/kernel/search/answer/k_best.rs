//! Variants one by one in order of cost.
//!
//! They are found on ways down the diagram that the tally guides, so that no step is ever taken back: a step is possible exactly if the
//! node it leads to has a completion with the key that is left.

use crate::search::answer::count_tables::Tally;
use crate::search::answer::keys::{Key, Steps};
use crate::search::diagram::{DEAD, Diagram};
use crate::search::question::Question;
use num_bigint::BigUint;

/// A variant found on a diagram.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assignment {
    /// For each variable of the space, the choice.
    pub choices: Vec<usize>,
    /// Its properties.
    pub key: Key,
}

/// The variants whose key passes a test, cheapest first, then in an order of keys, then by choices in diagram order.
///
/// # Complexity
/// Some passes over the part of the diagram that variants of that cost use. Then O(variables · choices) look-ups per
/// variant, or fewer if many variants have the same beginning. Memory is that of the tables, for any length of the list.
pub(crate) struct Cheapest<'d> {
    diagram: &'d Diagram,
    steps: &'d Steps,
    tally: Tally<u128>,
    /// Keys to come.
    keys: std::vec::IntoIter<Key>,
    /// The key whose variants are being given.
    key: Key,
    /// The way down the diagram, a place a layer.
    path: Vec<Place>,
    choices: Vec<usize>,
    /// How many may still be given.
    left: usize,
    /// Whether there are none that cost more.
    is_all: bool,
    enter: Enter<'d>,
}

/// How far a list goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// Up to a number of variants.
    Variants(usize),
    /// Up to a cost, in steps above the cheapest.
    Above(u64),
}

/// The extent of a list, given before variants are known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ListLimits {
    /// How far it goes.
    pub reach: Reach,
    /// The cost above which no variant is wanted.
    pub ceiling: u64,
}

/// Given layer, node, the remaining key and the choices so far; says whether to look at what follows.
pub(crate) type Enter<'d> = Box<dyn FnMut(usize, usize, Key, &[usize]) -> bool + 'd>;

/// A node on the way down, what is left of the key there, and the choice to be tried next.
#[derive(Debug, Clone, Copy)]
struct Place {
    node: u32,
    rest: Key,
    next: usize,
}

impl<'d> Cheapest<'d> {
    /// Returns the first variants whose key passes `wanted`, in the order of the question. If `enter` refuses a partial variant, its
    /// completions are skipped. The tables take no more than a quarter of the memory.
    pub(crate) fn new(
        question: &Question,
        diagram: &'d Diagram,
        steps: &'d Steps,
        limits: ListLimits,
        wanted: &dyn Fn(Key) -> bool,
        enter: Enter<'d>,
    ) -> Self {
        let bytes = question.conditions.memory / 4;
        let (tally, mut keys, is_all) = tally_enough(diagram, steps, limits, wanted, bytes);
        keys.sort_by_key(|&k| question.sort_rank(k));
        Cheapest {
            diagram,
            steps,
            tally,
            keys: keys.into_iter(),
            key: Key::default(),
            path: Vec::new(),
            choices: vec![0; steps.keys.len()],
            left: match limits.reach {
                Reach::Variants(top) => top,
                Reach::Above(_) => usize::MAX,
            },
            is_all,
            enter,
        }
    }

    /// Returns true if there are no others: none that cost more, or none that the memory allows.
    pub(in crate::search) fn is_all(&self) -> bool {
        self.is_all
    }
}

impl Iterator for Cheapest<'_> {
    type Item = Assignment;

    fn next(&mut self) -> Option<Assignment> {
        if self.left == 0 {
            return None;
        }
        let last = self.diagram.layers.len();
        loop {
            let depth = self.path.len();
            let Some(place) = self.path.last_mut() else {
                self.key = self.keys.next()?;
                if last == 0 {
                    return self.current_variant();
                }
                self.path.push(Place {
                    node: 0,
                    rest: self.key,
                    next: 0,
                });
                continue;
            };
            let layer = &self.diagram.layers[depth - 1];
            let choice = place.next;
            if choice == layer.choices {
                self.path.pop();
                continue;
            }
            place.next += 1;
            let from = (depth - 1, place.node);
            let (diagram, steps) = (self.diagram, self.steps);
            let followed = self
                .tally
                .follow_choice(diagram, steps, from, choice, place.rest);
            let Some((node, rest, _)) = followed else {
                continue;
            };
            self.choices[layer.variable] = choice;
            if !(self.enter)(depth, node as usize, rest, &self.choices) {
                continue;
            }
            if depth == last {
                return self.current_variant();
            }
            self.path.push(Place {
                node,
                rest,
                next: 0,
            });
        }
    }
}

impl Cheapest<'_> {
    fn current_variant(&mut self) -> Option<Assignment> {
        self.left -= 1;
        Some(Assignment {
            choices: self.choices.clone(),
            key: self.key,
        })
    }
}

/// Finds the cheapest variants up to the requested number. Returns the tally, the keys, and true if there are no others.
/// Tallies fewer if their tables would take more than `bytes`.
fn tally_enough(
    diagram: &Diagram,
    steps: &Steps,
    limits: ListLimits,
    wanted: &dyn Fn(Key) -> bool,
    bytes: usize,
) -> (Tally<u128>, Vec<Key>, bool) {
    let mut found = (Tally { tables: Vec::new() }, Vec::new(), true);
    let Some(floor) = least_from(diagram, steps)[0][0] else {
        return found;
    };
    let least = least_to(diagram, steps);
    let chosen = steps.keys.iter().flatten().map(|k| k.cost()).max();
    let ends = diagram.terminals.iter();
    let end = ends.map(|&r| steps.redundancy_key(r).cost()).max();
    let ceiling = limits.ceiling;
    let ceiling = ceiling.min(chosen.unwrap_or(0) * steps.keys.len() as u64 + end.unwrap_or(0));
    let (top, mut slack) = match limits.reach {
        Reach::Variants(top) => (BigUint::from(top), 0),
        Reach::Above(slack) => (BigUint::ZERO, slack),
    };
    loop {
        let limit = floor.saturating_add(slack).min(ceiling);
        let within = |p: &Option<u64>| p.map_or(0, |p| limit.saturating_sub(p));
        let bound = least.iter().map(|l| l.iter().map(within).collect());
        let bound: Vec<Vec<u64>> = bound.collect();
        let Some(tally) = Tally::new(diagram, steps, Some(&bound), bytes) else {
            found.2 = true;
            return found;
        };
        let whole = tally.total_counts().iter().filter(|(k, _)| wanted(*k));
        let count: BigUint = whole.clone().map(|(_, c)| *c).sum();
        let keys = whole.map(|(k, _)| *k).collect();
        found = (tally, keys, limit >= ceiling);
        if count >= top || found.2 {
            return found;
        }
        slack = if slack == 0 { 1 } else { slack * 2 };
    }
}

/// Least cost by layer and node; `None` if there is no path.
type LeastCosts = Vec<Vec<Option<u64>>>;

/// Returns the least costs of the paths to each node.
fn least_to(diagram: &Diagram, steps: &Steps) -> LeastCosts {
    let mut out = vec![vec![Some(0)]];
    for (l, layer) in diagram.layers.iter().enumerate() {
        let (keys, here) = (&steps.keys[layer.variable], &out[l]);
        let next = diagram.layers.get(l + 1).map(|l| l.nodes);
        let mut next = vec![None; next.unwrap_or(diagram.terminals.len())];
        for (edges, least) in layer.edges.chunks(layer.choices).zip(here) {
            let Some(least) = least else { continue };
            for (&to, key) in edges.iter().zip(keys).filter(|(to, _)| **to != DEAD) {
                let (slot, cost): (&mut Option<u64>, u64) =
                    (&mut next[to as usize], least + key.cost());
                *slot = Some(slot.map_or(cost, |s| s.min(cost)));
            }
        }
        out.push(next);
    }
    out
}

/// Returns the least costs of the paths from each node on, by the terminals where they end.
pub fn least_from(diagram: &Diagram, steps: &Steps) -> LeastCosts {
    let ends = diagram.terminals.iter();
    let mut below: Vec<Option<u64>> = ends
        .map(|&r| Some(steps.redundancy_key(r).cost()))
        .collect();
    let mut out = Vec::with_capacity(diagram.layers.len() + 1);
    for layer in diagram.layers.iter().rev() {
        let keys = &steps.keys[layer.variable];
        let of_node = |edges: &[u32]| {
            let alive = edges.iter().zip(keys).filter(|(to, _)| **to != DEAD);
            let costs = alive.filter_map(|(&to, key)| Some(below[to as usize]? + key.cost()));
            costs.min()
        };
        let here = layer.edges.chunks(layer.choices).map(of_node).collect();
        out.push(std::mem::replace(&mut below, here));
    }
    out.push(below);
    out.reverse();
    out
}
