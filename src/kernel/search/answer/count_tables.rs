//! Exact counts on a diagram: for every node, how many completions there are of each kind.

use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::diagram::{DEAD, Diagram};
use crate::search::question::cost::CostTable;
use crate::search::question::space::Space;
use num_bigint::BigUint;
use std::ops::AddAssign;

/// A number of variants.
pub trait Count: Clone + Send + Sync + for<'a> AddAssign<&'a Self> {
    /// One variant.
    fn one() -> Self;
    /// As a number of any size.
    fn big(&self) -> BigUint;
    /// Bytes held besides the number itself.
    fn beside(&self) -> usize {
        0
    }
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
    fn beside(&self) -> usize {
        // Digits, and what an allocation takes.
        usize::try_from(self.bits() / 8).unwrap_or(usize::MAX / 4) + 32
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
    pub(crate) fn of_redundancy(r: Redundancy) -> Key {
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
            let key = |c: &crate::search::question::space::Choice| {
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

    /// Steps of one thousandth, of keys alone.
    #[cfg(test)]
    pub(in crate::search) fn of_keys(keys: Vec<Vec<Key>>) -> Steps {
        Steps {
            unit_milli: 1,
            base_milli: 0,
            keys,
            harmful: 0,
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

    /// The same with weights of changed variables after the cost: of equal cost those with less weight are cheaper. Costs are
    /// then in a unit of their own.
    #[must_use]
    pub(in crate::search) fn then(&self, weights: &[u64]) -> Steps {
        let many = weights.iter().sum::<u64>() + 1;
        let key = |k: &Key, weight: u64| {
            let weight = if k.changes() > 0 { weight } else { 0 };
            Key::new(k.cost() * many + weight, k.freedoms(), k.changes())
        };
        let keys = self.keys.iter().zip(weights);
        Steps {
            keys: keys
                .map(|(v, &w)| v.iter().map(|k| key(k, w)).collect())
                .collect(),
            harmful: self.harmful * many,
            ..*self
        }
    }

    /// The largest cost part of a key that is no more than a cost in thousandths.
    #[must_use]
    pub fn above(&self, milli: i64) -> u64 {
        let steps = milli.saturating_sub(self.base_milli) / self.unit_milli;
        u64::try_from(steps).unwrap_or(0)
    }

    /// A cost in thousandths from the cost part of a key.
    #[must_use]
    pub fn milli(&self, cost: u64) -> i64 {
        self.base_milli + i64::try_from(cost).unwrap_or(i64::MAX / 2) * self.unit_milli
    }
}

/// Completions of a node by key, keys ascending.
type Table<C> = Vec<(Key, C)>;

/// For every node, its completions by key, keys ascending.
#[derive(Debug, Clone)]
pub struct Tally<C> {
    /// `tables[layer][node]`; the last layer holds the terminals.
    pub tables: Vec<Vec<Table<C>>>,
}

impl<C: Count> Tally<C> {
    /// Counts backwards from the terminals. With a `bound` per node, completions whose cost exceeds it are left out:
    /// `bound(layer, node)` is the largest cost of interest. `None` where the tables would take more than some bytes.
    ///
    /// # Complexity
    /// O(edges · table size + nodes · table size · log), with table sizes given by the kinds told apart.
    #[must_use]
    pub fn new(
        diagram: &Diagram,
        steps: &Steps,
        bound: Option<&[Vec<u64>]>,
        bytes: usize,
    ) -> Option<Tally<C>> {
        let mut left = bytes;
        let (mut tables, mut numbers) = terminals(diagram, steps);
        let mut out = Vec::with_capacity(diagram.layers.len() + 1);
        for l in (0..diagram.layers.len()).rev() {
            let bound = bound.map(|b| &b[l][..]);
            let below = (&tables[..], &numbers);
            let (here, named, used) = layer(diagram, steps, (l, bound), below, left)?;
            left = left.saturating_sub(used);
            out.push(std::mem::replace(&mut tables, here));
            numbers = named;
        }
        out.push(tables);
        out.reverse();
        Some(Tally { tables: out })
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

/// Counts of whole variants by key, with no more than two layers' tables held at a time; `None` where even these would take
/// more than some bytes.
///
/// # Complexity
/// As [`Tally::new`].
#[must_use]
pub fn totals<C: Count>(diagram: &Diagram, steps: &Steps, bytes: usize) -> Option<Table<C>> {
    let (mut tables, mut numbers) = terminals(diagram, steps);
    let mut held = 0;
    for l in (0..diagram.layers.len()).rev() {
        let left = bytes.saturating_sub(held);
        let below = (&tables[..], &numbers);
        (tables, numbers, held) = layer(diagram, steps, (l, None), below, left)?;
    }
    Some(tables.into_iter().next().unwrap_or_default())
}

/// The keys of a layer's tables, numbered.
struct Numbers {
    /// All keys, ascending.
    keys: Vec<Key>,
    /// Of each entry of each table, the number of its key.
    places: Vec<Vec<u32>>,
}

fn terminals<C: Count>(diagram: &Diagram, steps: &Steps) -> (Vec<Table<C>>, Numbers) {
    let ends = diagram.terminals.iter().map(|&r| steps.redundancy(r));
    let ends: Vec<Key> = ends.collect();
    let mut keys = ends.clone();
    keys.sort_unstable();
    keys.dedup();
    let place = |k: &Key| vec![number(keys.partition_point(|x| x < k))];
    let places = ends.iter().map(place).collect();
    let tables = ends.iter().map(|&k| vec![(k, C::one())]).collect();
    (tables, Numbers { keys, places })
}

fn number(place: usize) -> u32 {
    u32::try_from(place).expect("tables that fit the memory have fewer keys")
}

/// How the keys of a layer's completions come from those of the layer below.
struct Shifts {
    /// All keys, ascending.
    keys: Vec<Key>,
    /// Of each choice, which of the different shifts is its own.
    of_choice: Vec<usize>,
    /// `to[shift][key below]`, a place in `keys`.
    to: Vec<Vec<u32>>,
}

impl Shifts {
    /// Of the keys below and the choices' own, those of no more than a cost; `None` where they would take more than some bytes.
    fn new(below: &[Key], choices: &[Key], most: u64, bytes: usize) -> Option<Shifts> {
        let mut different = choices.to_vec();
        different.sort_unstable();
        different.dedup();
        if (different.len() + 1) * below.len() > bytes / size_of::<(Key, u32)>() {
            return None;
        }
        let shifted = |by: Key| below.iter().map(move |k| Key(k.0 + by.0));
        let within = |by: Key| shifted(by).take_while(|k| k.cost() <= most);
        let mut keys: Vec<Key> = different.iter().flat_map(|&by| within(by)).collect();
        // These are a few ascending lists, one after another, which this sort merges.
        keys.sort();
        keys.dedup();
        // Both ascend; what costs too much comes after all.
        let places = |by: Key| {
            let mut at = 0;
            let place = |k: Key| {
                at += keys[at..].iter().take_while(|x| **x < k).count();
                number(at)
            };
            shifted(by).map(place).collect()
        };
        let to = different.iter().map(|&by| places(by)).collect();
        let of_choice = choices.iter().map(|c| different.partition_point(|x| x < c));
        Some(Shifts {
            of_choice: of_choice.collect(),
            to,
            keys,
        })
    }
}

/// The tables of layer `l` from those of the one below, with the bytes they take; `None` where these are too many.
fn layer<C: Count>(
    diagram: &Diagram,
    steps: &Steps,
    (l, bound): (usize, Option<&[u64]>),
    (below, numbers): (&[Table<C>], &Numbers),
    bytes: usize,
) -> Option<(Vec<Table<C>>, Numbers, usize)> {
    let layer = &diagram.layers[l];
    let most = bound.and_then(|b| b.iter().copied().max());
    let choices = &steps.keys[layer.variable];
    let shifts = Shifts::new(&numbers.keys, choices, most.unwrap_or(u64::MAX), bytes)?;
    let mut sums: Vec<Option<C>> = vec![None; shifts.keys.len()];
    let mut met: Vec<u32> = Vec::new();
    let (mut here, mut places) = (Vec::with_capacity(layer.nodes), Vec::new());
    let mut used = 0;
    for node in 0..layer.nodes {
        let limit = bound.map_or(u64::MAX, |b| b[node]);
        let edges = &layer.edges[node * layer.choices..(node + 1) * layer.choices];
        for (shift, &to) in shifts.of_choice.iter().zip(edges) {
            if to == DEAD {
                continue;
            }
            let shift = &shifts.to[*shift];
            let entries = below[to as usize].iter().zip(&numbers.places[to as usize]);
            for ((_, count), &from) in entries {
                let to = shift[from as usize];
                if shifts
                    .keys
                    .get(to as usize)
                    .is_none_or(|k| k.cost() > limit)
                {
                    break;
                }
                match &mut sums[to as usize] {
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
            let all = sums.iter().enumerate().filter(|(_, s)| s.is_some());
            met.extend(all.map(|(i, _)| number(i)));
        }
        let entry = |&to: &u32| Some((shifts.keys[to as usize], sums[to as usize].take()?));
        let mut table: Table<C> = Vec::new();
        table.try_reserve_exact(met.len()).ok()?;
        table.extend(met.iter().filter_map(entry));
        used += table.capacity() * (size_of::<(Key, C)>() + size_of::<u32>());
        used += table.iter().map(|(_, c)| c.beside()).sum::<usize>();
        if used > bytes {
            return None;
        }
        here.push(table);
        places.push(std::mem::take(&mut met));
    }
    let keys = shifts.keys;
    Some((here, Numbers { keys, places }, used))
}
