//! Properties of variants as keys that are added up along a diagram.

use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::question::cost::CostTable;
use crate::search::question::space::{Choice, Space};

/// Which properties of variants a tally tells apart.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Kinds {
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
    ///
    /// # Examples
    /// ```
    /// use ozols::search::answer::keys::Key;
    /// let key = Key::new(5, 7, 2);
    /// assert_eq!((key.cost(), key.freedoms(), key.changes()), (5, 7, 2));
    /// assert!(Key::new(4, 9, 9) < key); // Cost decides first.
    /// ```
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

    /// Returns the cost in steps.
    #[must_use]
    pub fn cost(self) -> u64 {
        (self.0 >> 80) as u64
    }
    fn part_at(self, at: u32) -> u16 {
        (self.0 >> at) as u16
    }
    /// Returns the number of freedoms.
    #[must_use]
    pub fn freedoms(self) -> u32 {
        u32::from(self.part_at(64))
    }
    /// Returns the number of changes.
    #[must_use]
    pub fn changes(self) -> u32 {
        u32::from(self.part_at(48))
    }
    /// Returns the number of redundant constraints within the mechanism.
    #[must_use]
    pub fn internal(self) -> u32 {
        u32::from(self.part_at(32))
    }
    /// Returns the number of redundant constraints that the state adds. Negative if it removes joints.
    #[must_use]
    pub fn external(self) -> i32 {
        i32::from(self.part_at(16).cast_signed())
    }
    /// Returns the number of harmful ones among them.
    #[must_use]
    pub fn harmful(self) -> u32 {
        u32::from(self.part_at(0))
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
    /// Returns the steps of a space: the unit is the greatest common divisor of all cost differences.
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
            let key = |c: &Choice| {
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

    /// Returns steps of one thousandth, for keys without a space.
    #[cfg(test)]
    pub(in crate::search) fn of_keys(keys: Vec<Vec<Key>>) -> Steps {
        Steps {
            unit_milli: 1,
            base_milli: 0,
            keys,
            harmful: 0,
        }
    }

    /// Returns the key of a variant's redundancy, with its cost.
    #[must_use]
    pub fn redundancy_key(&self, r: Redundancy) -> Key {
        let cost = self.harmful * u64::from(r.harmful);
        Key(Key::of_redundancy(r).0 | Key::new(cost, 0, 0).0)
    }

    /// Returns the properties of a variant, from its choices and its redundant constraints.
    #[must_use]
    pub fn variant_key(&self, choices: &[usize], redundancy: Redundancy) -> Key {
        let keys = self.keys.iter().zip(choices);
        let sum: u128 = keys.map(|(keys, &c)| keys[c].0).sum();
        Key(sum + self.redundancy_key(redundancy).0)
    }

    /// Returns these steps with only the wanted kinds kept.
    #[must_use]
    pub(crate) fn keep_kinds(&self, kinds: Kinds) -> Steps {
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

    /// Returns steps with the weights of changed variables after the cost: among equal costs, less weight is cheaper. Costs then have their
    /// own unit.
    #[must_use]
    pub(in crate::search) fn with_weights(&self, weights: &[u64]) -> Steps {
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

    /// Returns the largest cost part of a key that is no more than a cost in thousandths.
    #[must_use]
    pub fn steps_above(&self, milli: i64) -> u64 {
        let steps = milli.saturating_sub(self.base_milli) / self.unit_milli;
        u64::try_from(steps).unwrap_or(0)
    }

    /// Returns a cost in thousandths from the cost part of a key.
    #[must_use]
    pub fn cost_in_milli(&self, cost: u64) -> i64 {
        self.base_milli + i64::try_from(cost).unwrap_or(i64::MAX / 2) * self.unit_milli
    }
}
