//! Exact counts on a diagram: for every node, how many completions there are of each kind.

use crate::search::cost::CostTable;
use crate::search::diagram::{DEAD, Diagram};
use crate::search::space::Space;
use crate::search::spent::Redundancy;
use num_bigint::BigUint;
use std::ops::AddAssign;

/// A number of variants.
pub trait Count: Clone + Send + Sync + for<'a> AddAssign<&'a Self> {
    /// One variant.
    fn one() -> Self;
    /// As a number of any size.
    fn big(&self) -> BigUint;
}

impl Count for u128 {
    fn one() -> Self {
        1
    }
    fn big(&self) -> BigUint {
        BigUint::from(*self)
    }
}

impl Count for BigUint {
    fn one() -> Self {
        BigUint::from(1u8)
    }
    fn big(&self) -> BigUint {
        self.clone()
    }
}

/// Which properties of variants a tally tells apart.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Kinds {
    /// Freedoms f.
    pub freedoms: bool,
    /// Number of changes.
    pub changes: bool,
    /// Cost.
    pub cost: bool,
}

/// Properties of a variant, or of the rest of one: cost (above the cheapest possible, in steps of
/// [`Steps::unit_milli`]), then freedoms, changes, and redundancy, packed so that keys add as properties do and sort by
/// cost first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Key(pub u128);

impl Key {
    /// Packs what is chosen. A mechanism has at most 4000 joints, so that each count fits sixteen bits.
    #[must_use]
    pub fn new(cost: u64, freedoms: u32, changes: u32) -> Key {
        Key(u128::from(cost) << 80 | u128::from(freedoms) << 64 | u128::from(changes) << 48)
    }

    /// Packs the redundancy of a whole variant.
    #[must_use]
    pub fn of_redundancy(r: Redundancy) -> Key {
        // Fewer than none are written as a complement: only one of the keys that are added up has any.
        let external = u128::from(r.external.cast_unsigned() & 0xffff);
        Key(u128::from(r.internal) << 32 | external << 16 | u128::from(r.harmful))
    }

    /// Cost steps.
    #[must_use]
    pub fn cost(self) -> u64 {
        (self.0 >> 80) as u64
    }
    fn part(self, at: u32) -> u16 {
        (self.0 >> at) as u16
    }
    /// Freedoms.
    #[must_use]
    pub fn freedoms(self) -> u32 {
        u32::from(self.part(64))
    }
    /// Changes.
    #[must_use]
    pub fn changes(self) -> u32 {
        u32::from(self.part(48))
    }
    /// Redundant constraints within the mechanism.
    #[must_use]
    pub fn internal(self) -> u32 {
        u32::from(self.part(32))
    }
    /// Redundant constraints that the state adds; fewer than none where it leaves joints out.
    #[must_use]
    pub fn external(self) -> i32 {
        i32::from(self.part(16).cast_signed())
    }
    /// Harmful ones among them.
    #[must_use]
    pub fn harmful(self) -> u32 {
        u32::from(self.part(0))
    }
}

/// Costs as whole steps above the cheapest choice of each variable.
#[derive(Debug, Clone)]
pub struct Steps {
    /// Thousandths of a cost unit in one step.
    pub unit_milli: i64,
    /// Cost of the cheapest conceivable variant, in thousandths.
    pub base_milli: i64,
    /// `key[variable][choice]`.
    pub keys: Vec<Vec<Key>>,
    /// Steps for each harmful redundant constraint that the state adds.
    harmful: u64,
}

impl Steps {
    /// The steps of a space: the unit is the greatest common divisor of all cost differences.
    #[must_use]
    pub fn new(space: &Space, costs: &CostTable) -> Steps {
        let least: Vec<i64> = space
            .variables
            .iter()
            .map(|v| v.choices.iter().map(|c| c.cost_milli).min().unwrap_or(0))
            .collect();
        let above = space
            .variables
            .iter()
            .zip(&least)
            .flat_map(|(v, l)| v.choices.iter().map(move |c| c.cost_milli - l));
        let harmful = space.state.map_or(0, |_| costs.harmful);
        let unit = above.fold(harmful, num_integer::gcd).max(1);
        let keys = space.variables.iter().zip(&least).map(|(v, l)| {
            let key = |c: &crate::search::space::Choice| {
                let cost = u64::try_from((c.cost_milli - l) / unit).unwrap_or(0);
                Key::new(cost, c.freedoms, c.changes)
            };
            v.choices.iter().map(key).collect()
        });
        Steps {
            unit_milli: unit,
            base_milli: least.iter().sum(),
            keys: keys.collect(),
            harmful: u64::try_from(harmful / unit).unwrap_or(0),
        }
    }

    /// The key of a variant's redundancy, with what it costs.
    #[must_use]
    pub fn redundancy(&self, r: Redundancy) -> Key {
        let cost = self.harmful * u64::from(r.harmful);
        Key(Key::of_redundancy(r).0 | Key::new(cost, 0, 0).0)
    }

    /// The same with only the wanted kinds left.
    #[must_use]
    pub fn only(&self, kinds: Kinds) -> Steps {
        let keep = |k: &Key| {
            Key::new(
                if kinds.cost { k.cost() } else { 0 },
                if kinds.freedoms { k.freedoms() } else { 0 },
                if kinds.changes { k.changes() } else { 0 },
            )
        };
        let keys = self.keys.iter();
        Steps {
            keys: keys.map(|v| v.iter().map(keep).collect()).collect(),
            harmful: if kinds.cost { self.harmful } else { 0 },
            ..*self
        }
    }

    /// A cost in thousandths from the cost part of a key.
    #[must_use]
    pub fn milli(&self, cost: u64) -> i64 {
        self.base_milli + i64::try_from(cost).unwrap_or(i64::MAX / 2) * self.unit_milli
    }
}

/// For every node, its completions by key, keys ascending.
#[derive(Debug, Clone)]
pub struct Tally<C> {
    /// `tables[layer][node]`; the last layer holds the terminals.
    pub tables: Vec<Vec<Vec<(Key, C)>>>,
}

impl<C: Count> Tally<C> {
    /// Counts backwards from the terminals. With a `bound` per node, completions whose cost exceeds it are left out:
    /// `bound(layer, node)` is the largest cost of interest.
    ///
    /// # Complexity
    /// O(edges · table size + nodes · table size · log), with table sizes given by the kinds told apart.
    #[must_use]
    pub fn new(diagram: &Diagram, steps: &Steps, bound: Option<&[Vec<u64>]>) -> Tally<C> {
        let last = diagram
            .terminals
            .iter()
            .map(|&r| vec![(steps.redundancy(r), C::one())]);
        let mut tables: Vec<Vec<Vec<(Key, C)>>> = vec![last.collect()];
        // The keys of the layer below, and of each entry of its tables the place of its key among them.
        let mut known: Vec<Key> = tables[0].iter().flatten().map(|(k, _)| *k).collect();
        known.sort_unstable();
        known.dedup();
        let place = |(k, _): &(Key, C)| known.partition_point(|x| x < k);
        let mut places: Vec<Vec<usize>> = tables[0]
            .iter()
            .map(|t| t.iter().map(place).collect())
            .collect();
        for (l, layer) in diagram.layers.iter().enumerate().rev() {
            let below = tables.last().expect("there is a last layer");
            let shifts = Shifts::new(&known, &steps.keys[layer.variable]);
            let mut sums: Vec<Option<C>> = vec![None; shifts.keys.len()];
            let mut met: Vec<usize> = Vec::new();
            let (mut here, mut at) = (Vec::new(), Vec::new());
            for node in 0..layer.nodes {
                let limit = bound.map_or(u64::MAX, |b| b[l][node]);
                let edges = &layer.edges[node * layer.choices..(node + 1) * layer.choices];
                for (shift, &to) in shifts.of_choice.iter().zip(edges) {
                    if to == DEAD {
                        continue;
                    }
                    let entries = below[to as usize].iter().zip(&places[to as usize]);
                    for ((_, count), &from) in entries {
                        let to = shifts.to[*shift][from];
                        if shifts.keys[to].cost() > limit {
                            break;
                        }
                        match &mut sums[to] {
                            Some(sum) => *sum += count,
                            none => {
                                *none = Some(count.clone());
                                met.push(to);
                            }
                        }
                    }
                }
                // Few are sorted, many found by looking through all.
                if met.len() * 8 < sums.len() {
                    met.sort_unstable();
                } else {
                    met.clear();
                    met.extend((0..sums.len()).filter(|&i| sums[i].is_some()));
                }
                let entry = |&to: &usize| Some((shifts.keys[to], sums[to].take()?));
                here.push(met.iter().filter_map(entry).collect());
                at.push(met.clone());
                met.clear();
            }
            tables.push(here);
            (known, places) = (shifts.keys, at);
        }
        tables.reverse();
        Tally { tables }
    }

    /// Counts of whole variants by key.
    #[must_use]
    pub fn totals(&self) -> &[(Key, C)] {
        self.tables
            .first()
            .and_then(|l| l.first())
            .map_or(&[], Vec::as_slice)
    }
}

/// How the keys of a layer's completions come from those of the layer below.
struct Shifts {
    /// All keys, ascending.
    keys: Vec<Key>,
    /// Of each choice, which of the different shifts is its own.
    of_choice: Vec<usize>,
    /// `to[shift][key below]`, a place in `keys`.
    to: Vec<Vec<usize>>,
}

impl Shifts {
    fn new(below: &[Key], choices: &[Key]) -> Shifts {
        let mut different = choices.to_vec();
        different.sort_unstable();
        different.dedup();
        let shifted = |by: Key| below.iter().map(move |k| Key(k.0 + by.0));
        let mut keys: Vec<Key> = different.iter().flat_map(|&by| shifted(by)).collect();
        keys.sort_unstable();
        keys.dedup();
        let place = |k: Key| keys.partition_point(|x| *x < k);
        let to = different.iter().map(|&by| shifted(by).map(place).collect());
        let of_choice = choices.iter().map(|c| different.partition_point(|x| x < c));
        Shifts {
            of_choice: of_choice.collect(),
            to: to.collect(),
            keys,
        }
    }
}
