//! Variants one by one: in order of cost, or drawn at random with equal chances.
//!
//! Both walk down the diagram guided by the tally, so no step is ever taken back: a step is possible exactly when the
//! node it leads to has a completion with the key that is left.

use crate::search::answer::completions::{Span, Ways};
use crate::search::answer::count::Count;
use crate::search::answer::count_tables::Tally;
use crate::search::answer::keys::{Key, Steps};
use crate::search::diagram::{DEAD, Diagram};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_bigint::BigUint;
use num_traits::Zero;
use std::fmt;

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
/// Some passes over the part of the diagram that variants of that cost use, then O(variables) a variant, and less where many
/// begin alike: what leads on from a node with some of a key left is looked up in the tables once. Memory is the tables and as
/// much again, however many are asked for.
pub(crate) struct Cheapest<'d, C> {
    diagram: &'d Diagram,
    steps: &'d Steps,
    tally: Tally<C>,
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
    pub(in crate::search) ways: Ways,
    enter: Enter<'d>,
}

/// How far a list goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// To so many variants.
    Variants(usize),
    /// To all that cost no more than so many steps above the cheapest.
    Above(u64),
}

/// What a list is of, before anything is known of the variants.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ListLimits {
    /// How far it goes.
    pub reach: Reach,
    /// The cost above which no variant is wanted.
    pub ceiling: u64,
}

/// Given layer, node, the remaining key and the choices so far; says whether to look at what follows.
pub(crate) type Enter<'d> = Box<dyn FnMut(usize, usize, Key, &[usize]) -> bool + 'd>;

/// A node on the way down, what is left of the key there, its steps, and which of them is the next.
#[derive(Debug, Clone, Copy)]
struct Place {
    node: u32,
    rest: Key,
    steps: Span,
    next: u32,
}

impl<C: Count> fmt::Debug for Cheapest<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Cheapest")
            .field("key", &self.key)
            .field("path", &self.path)
            .field("left", &self.left)
            .finish_non_exhaustive()
    }
}

impl<'d, C: Count> Cheapest<'d, C> {
    /// The first variants whose key passes `wanted`, as it does for no cost above the ceiling, in the order of `rank`, which is by
    /// cost first. Of those that begin alike none is given where `enter` refuses the beginning.
    pub(crate) fn new<R: Ord>(
        diagram: &'d Diagram,
        steps: &'d Steps,
        limits: ListLimits,
        wanted: impl Fn(Key) -> bool,
        rank: impl Fn(Key) -> R,
        bytes: usize,
        enter: Enter<'d>,
    ) -> Self {
        let (tally, mut keys, is_all) = enough(diagram, steps, limits, wanted, bytes);
        keys.sort_by_key(|&k| rank(k));
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
            ways: Ways::within(bytes),
            enter,
        }
    }

    /// Whether there are none beyond those given: none that cost more, or none that there is memory for.
    pub(in crate::search) fn is_all(&self) -> bool {
        self.is_all
    }

    fn steps_from(&mut self, layer: usize, node: u32, rest: Key) -> Span {
        let (diagram, tally) = (self.diagram, &self.tally);
        self.ways
            .from(diagram, self.steps, tally, layer, node, rest)
    }

    /// Forgets steps where they are too many, but for those on the way.
    fn make_room(&mut self) {
        if !self.ways.is_full() {
            return;
        }
        self.ways.clear();
        for layer in 0..self.path.len() {
            let Place {
                node, rest, steps, ..
            } = self.path[layer];
            let anew = self.steps_from(layer, node, rest);
            let place = &mut self.path[layer];
            (place.steps, place.next) = (anew, anew.0 + (place.next - steps.0));
        }
    }
}

impl<C: Count> Iterator for Cheapest<'_, C> {
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
                    return self.found();
                }
                let (node, rest) = (0, self.key);
                let steps = self.steps_from(0, node, rest);
                self.path.push(Place {
                    node,
                    rest,
                    steps,
                    next: steps.0,
                });
                continue;
            };
            if place.next == place.steps.1 {
                self.path.pop();
                continue;
            }
            let at = place.next as usize;
            place.next += 1;
            let step = self.ways.steps[at];
            self.choices[self.diagram.layers[depth - 1].variable] = step.choice as usize;
            if !(self.enter)(depth, step.node as usize, step.rest, &self.choices) {
                continue;
            }
            if depth == last {
                return self.found();
            }
            let steps = step.then.unwrap_or_else(|| {
                let then = self.steps_from(depth, step.node, step.rest);
                self.ways.steps[at].then = Some(then);
                then
            });
            self.path.push(Place {
                node: step.node,
                rest: step.rest,
                steps,
                next: steps.0,
            });
            self.make_room();
        }
    }
}

impl<C> Cheapest<'_, C> {
    fn found(&mut self) -> Option<Assignment> {
        self.left -= 1;
        Some(Assignment {
            choices: self.choices.clone(),
            key: self.key,
        })
    }
}

/// A tally of the cheapest variants as far as is asked for, with their keys, and whether there are none beyond; fewer where
/// their tables would take more than some bytes.
fn enough<C: Count>(
    diagram: &Diagram,
    steps: &Steps,
    limits: ListLimits,
    wanted: impl Fn(Key) -> bool,
    bytes: usize,
) -> (Tally<C>, Vec<Key>, bool) {
    let mut found = (Tally { tables: Vec::new() }, Vec::new(), true);
    let Some(floor) = least_from(diagram, steps)[0][0] else {
        return found;
    };
    let least = least_to(diagram, steps);
    let chosen = steps.keys.iter().flatten().map(|k| k.cost()).max();
    let ends = diagram.terminals.iter();
    let end = ends.map(|&r| steps.redundancy(r).cost()).max();
    let ceiling = limits.ceiling;
    let ceiling = ceiling.min(chosen.unwrap_or(0) * steps.keys.len() as u64 + end.unwrap_or(0));
    let (top, mut slack) = match limits.reach {
        Reach::Variants(top) => (BigUint::from(top), 0),
        Reach::Above(slack) => (BigUint::zero(), slack),
    };
    loop {
        let limit = floor.saturating_add(slack).min(ceiling);
        let within = |p: &Option<u64>| p.map_or(0, |p| limit.saturating_sub(p));
        let bound = least.iter().map(|l| l.iter().map(within).collect());
        let bound: Vec<Vec<u64>> = bound.collect();
        let Some(tally) = Tally::<C>::new(diagram, steps, Some(&bound), bytes) else {
            found.2 = true;
            return found;
        };
        let whole = tally.totals().iter().filter(|(k, _)| wanted(*k));
        let count: BigUint = whole.clone().map(|(_, c)| c.big()).sum();
        let keys = whole.map(|(k, _)| *k).collect();
        found = (tally, keys, limit >= ceiling);
        if count >= top || found.2 {
            return found;
        }
        slack = if slack == 0 { 1 } else { slack * 2 };
    }
}

/// Least cost by layer and node; `None` where there is no way.
type LeastCosts = Vec<Vec<Option<u64>>>;

/// Least costs of the ways to each node.
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

/// Least costs of the ways from each node on, with those of where they end.
pub fn least_from(diagram: &Diagram, steps: &Steps) -> LeastCosts {
    let ends = diagram.terminals.iter();
    let mut below: Vec<Option<u64>> = ends.map(|&r| Some(steps.redundancy(r).cost())).collect();
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

/// Variants whose key passes a test, drawn without end, independently, each with the same chance.
#[derive(Debug)]
pub(crate) struct Sample<'d, C> {
    diagram: &'d Diagram,
    steps: &'d Steps,
    /// The steps the tally was made with; the variants' own keys are made from `steps`.
    told: Steps,
    tally: Tally<C>,
    /// What there is to draw from, by key, and how much in all.
    totals: Vec<(Key, BigUint)>,
    all: BigUint,
    random: ChaCha8Rng,
}

impl<'d, C: Count> Sample<'d, C> {
    /// Makes ready to draw; `told` must be the steps that the table of counts was made with.
    pub(crate) fn new(
        diagram: &'d Diagram,
        steps: &'d Steps,
        told: Steps,
        tally: Tally<C>,
        seed: u64,
        wanted: impl Fn(Key) -> bool,
    ) -> Self {
        let counts = tally.totals().iter().filter(|(k, _)| wanted(*k));
        let totals: Vec<(Key, BigUint)> = counts.map(|(k, c)| (*k, c.big())).collect();
        let all = totals.iter().map(|(_, c)| c).sum();
        let random = ChaCha8Rng::seed_from_u64(seed);
        Sample {
            diagram,
            steps,
            told,
            tally,
            totals,
            all,
            random,
        }
    }
}

impl<C: Count> Iterator for Sample<'_, C> {
    type Item = Assignment;

    fn next(&mut self) -> Option<Assignment> {
        if self.all.is_zero() {
            return None;
        }
        let (diagram, steps) = (self.diagram, self.steps);
        let mut ticket = below(&mut self.random, &self.all);
        let mut key = self.totals[0].0;
        for (k, c) in &self.totals {
            if ticket < *c {
                key = *k;
                break;
            }
            ticket -= c;
        }
        let mut choices = vec![0; steps.keys.len()];
        let (mut node, mut whole) = (0usize, 0u128);
        for (l, layer) in diagram.layers.iter().enumerate() {
            for (choice, edge) in self.told.keys[layer.variable].iter().enumerate() {
                let to = layer.edges[node * layer.choices + choice];
                let Some(rest) = key.0.checked_sub(edge.0).map(Key) else {
                    continue;
                };
                if to == DEAD {
                    continue;
                }
                let table = &self.tally.tables[l + 1][to as usize];
                let Ok(i) = table.binary_search_by_key(&rest, |(k, _)| *k) else {
                    continue;
                };
                let size = table[i].1.big();
                if ticket < size {
                    choices[layer.variable] = choice;
                    whole += steps.keys[layer.variable][choice].0;
                    (node, key) = (to as usize, rest);
                    break;
                }
                ticket -= size;
            }
        }
        whole += steps.redundancy(diagram.terminals[node]).0;
        Some(Assignment {
            choices,
            key: Key(whole),
        })
    }
}

/// A number below `n`, each with the same chance.
fn below(random: &mut ChaCha8Rng, n: &BigUint) -> BigUint {
    let bits = n.bits();
    let mut bytes = vec![0u8; usize::try_from(bits.div_ceil(8)).unwrap_or(0)];
    loop {
        random.fill_bytes(&mut bytes);
        let x = BigUint::from_bytes_le(&bytes) >> (bytes.len() as u64 * 8 - bits);
        if x < *n {
            return x;
        }
    }
}
