//! How many variants there are of each kind.

use crate::search::answer::count::Count;
use crate::search::answer::count_tables::totals_by_key;
use crate::search::answer::keys::{Key, Kinds};
use crate::search::diagram::Diagram;
use crate::search::question::Question;
use num_bigint::BigUint;
use num_traits::Zero;
use std::collections::BTreeMap;
use std::fmt;

/// Exact counts of some variants, by their properties; shown as the total.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Counts {
    /// All of them.
    pub total: BigUint,
    /// By W.
    pub by_mobility: BTreeMap<i64, BigUint>,
    /// By number of changes.
    pub by_changes: BTreeMap<u32, BigUint>,
    /// By W and number of changes.
    pub by_mobility_and_changes: BTreeMap<(i64, u32), BigUint>,
    /// By redundant constraints within the mechanism.
    pub by_redundant: BTreeMap<u32, BigUint>,
    /// By freedoms f.
    pub by_freedoms: BTreeMap<u32, BigUint>,
    /// True if only the total is known, because the rest would take more than the available memory.
    pub only_total: bool,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.total.fmt(f)
    }
}

/// Returns the number of orbits of a symmetry of the given `order`, 2 or 3. It follows from the number of all variants and
/// the number of those that the symmetry keeps, by Burnside's lemma: every operation except the identity keeps exactly
/// these.
///
/// # Examples
/// ```
/// use ozols::search::answer::counts::count_orbits;
/// // Of 10 variants 4 are their own mirror image; the other 6 form 3 pairs.
/// assert_eq!(count_orbits(&10u32.into(), &4u32.into(), 2), 7u32.into());
/// ```
#[must_use]
pub fn count_orbits(all: &BigUint, kept: &BigUint, order: usize) -> BigUint {
    (all + kept * (order - 1)) / order
}

impl Counts {
    /// Replaces each number `n` by `of(n, m)`, where `m` is the number of the same kind in `others`.
    pub(in crate::search) fn combine_with(
        &mut self,
        others: &Counts,
        of: &dyn Fn(&BigUint, &BigUint) -> BigUint,
    ) {
        fn each<K: Ord + Copy>(
            own: &mut BTreeMap<K, BigUint>,
            others: &BTreeMap<K, BigUint>,
            of: &dyn Fn(&BigUint, &BigUint) -> BigUint,
        ) {
            for &key in others.keys() {
                own.entry(key).or_default();
            }
            for (key, n) in own.iter_mut() {
                *n = of(n, others.get(key).unwrap_or(&BigUint::ZERO));
            }
        }
        self.total = of(&self.total, &others.total);
        each(&mut self.by_mobility, &others.by_mobility, of);
        each(&mut self.by_changes, &others.by_changes, of);
        each(
            &mut self.by_mobility_and_changes,
            &others.by_mobility_and_changes,
            of,
        );
        each(&mut self.by_redundant, &others.by_redundant, of);
        each(&mut self.by_freedoms, &others.by_freedoms, of);
    }

    /// Raises lower bounds to those of variants that are among these.
    pub fn raise_bounds(&mut self, some: &Counts) {
        self.combine_with(some, &|a, b| a.max(b).clone());
        let together = self.by_mobility.values().sum();
        self.total = std::mem::take(&mut self.total).max(together);
    }

    pub(in crate::search) fn add_variants(&mut self, mobility: i64, key: Key, count: &BigUint) {
        self.total += count;
        *self.by_mobility.entry(mobility).or_default() += count;
        *self.by_changes.entry(key.changes()).or_default() += count;
        *self
            .by_mobility_and_changes
            .entry((mobility, key.changes()))
            .or_default() += count;
        *self.by_redundant.entry(key.internal()).or_default() += count;
        *self.by_freedoms.entry(key.freedoms()).or_default() += count;
    }
}

impl Question {
    /// Returns the counts of the variants of a diagram; `filter` also applies the conditions on mobility and changes.
    #[must_use]
    pub fn count_variants(&self, diagram: &Diagram, filter: bool) -> Counts {
        self.count_by_kind(diagram, filter, true)
    }

    /// Returns the same, without the counts by W and changes together unless `both` is true: with hundreds of joints there are thousands of
    /// each, and millions of pairs.
    pub(in crate::search) fn count_by_kind(
        &self,
        diagram: &Diagram,
        filter: bool,
        both: bool,
    ) -> Counts {
        let of = |freedoms, changes| {
            let kinds = Kinds {
                freedoms,
                changes,
                cost: false,
            };
            wanted_by(self, diagram, filter, kinds)
        };
        let by_changes = if both {
            Some(Vec::new())
        } else {
            of(false, true)
        };
        let Some((by_freedoms, by_changes)) = of(true, both).zip(by_changes) else {
            return Counts {
                only_total: true,
                total: count_total(self, diagram, filter),
                ..Counts::default()
            };
        };
        let mut counts = Counts::default();
        for (key, count) in &by_freedoms {
            counts.add_variants(self.mobility(*key), *key, count);
        }
        if !both {
            counts.by_mobility_and_changes.clear();
            counts.by_changes.clear();
        }
        for (key, count) in &by_changes {
            *counts.by_changes.entry(key.changes()).or_default() += count;
        }
        counts
    }
}

/// Returns the number of variants of each kind; with `filter` only those that meet the conditions on mobility and changes, and by these
/// kinds too. Returns `None` as [`totals_by`] does.
fn wanted_by(
    question: &Question,
    diagram: &Diagram,
    filter: bool,
    kinds: Kinds,
) -> Option<Vec<(Key, BigUint)>> {
    let limited = limited_kinds(question, filter);
    let kinds = Kinds {
        freedoms: kinds.freedoms || limited.freedoms,
        changes: kinds.changes || limited.changes,
        cost: kinds.cost,
    };
    let mut totals = totals_by(question, diagram, kinds)?;
    totals.retain(|(key, _)| !filter || question.is_wanted(*key));
    Some(totals)
}

/// Returns true if every count fits 128 bits.
pub(in crate::search) fn fits_u128(question: &Question) -> bool {
    question.space.size().bits() <= 127
}

/// Returns the number of variants of each kind in a diagram. `None` if this would take more than a quarter of the memory.
fn totals_by(question: &Question, diagram: &Diagram, kinds: Kinds) -> Option<Vec<(Key, BigUint)>> {
    fn with<C: Count>(
        s: &Question,
        diagram: &Diagram,
        kinds: Kinds,
    ) -> Option<Vec<(Key, BigUint)>> {
        let totals =
            totals_by_key::<C>(diagram, &s.steps.keep_kinds(kinds), s.conditions.memory / 4)?;
        Some(totals.iter().map(|(k, n)| (*k, n.to_big_uint())).collect())
    }
    let count = if fits_u128(question) {
        with::<u128>
    } else {
        with::<BigUint>
    };
    count(question, diagram, kinds)
}

/// Returns the properties that decide whether a variant meets the conditions on mobility and changes; none without `filter`.
pub(in crate::search) fn limited_kinds(question: &Question, filter: bool) -> Kinds {
    Kinds {
        freedoms: filter && question.conditions.max_mobility.is_some(),
        changes: filter && question.conditions.max_changes.is_some(),
        cost: false,
    }
}

/// Returns the number of variants in a diagram. With `filter`, applies the conditions on mobility and changes too. Returns 0
/// if the memory is not enough to count them.
pub(in crate::search) fn count_total(
    question: &Question,
    diagram: &Diagram,
    filter: bool,
) -> BigUint {
    let totals = wanted_by(question, diagram, filter, Kinds::default());
    totals.into_iter().flatten().map(|(_, n)| n).sum()
}

/// Returns the number of variants that meet every condition, by cost in thousandths. `None` if they would take more than the
/// available memory.
///
/// # Examples
/// ```
/// use ozols::{rank::exact::field::exact_field, search::{Search, diagram::Control, question::conditions::Conditions}};
/// use ozols::search::answer::counts::counts_by_cost;
/// let four_bar = ozols::built_in("four-bar")?;
/// let search = Search::new(exact_field(&four_bar, 0)?, &four_bar, Conditions::default())?;
/// let diagrams = search.build_diagrams(Control::NONE);
/// let by_cost = counts_by_cost(&search, &diagrams.admissible).expect("it is small");
/// assert_eq!(by_cost.into_values().sum::<num_bigint::BigUint>().to_string(), "14");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn counts_by_cost(question: &Question, diagram: &Diagram) -> Option<BTreeMap<i64, BigUint>> {
    let kinds = Kinds {
        cost: true,
        ..Kinds::default()
    };
    let mut out = BTreeMap::new();
    for (key, count) in wanted_by(question, diagram, true, kinds)? {
        *out.entry(question.steps.cost_in_milli(key.cost()))
            .or_insert_with(BigUint::zero) += count;
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::Counts;
    use num_bigint::BigUint;

    /// Bounds from diagrams that were cut down each by itself: of those with W = 0 only 1,807 of the 2,306 admissible ones were met.
    #[test]
    fn bounds_are_at_least_those_of_some_among_them() {
        let of = |rows: &[(i64, u32)]| Counts {
            total: rows.iter().map(|r| r.1).sum::<u32>().into(),
            by_mobility: rows.iter().map(|&(w, n)| (w, BigUint::from(n))).collect(),
            ..Counts::default()
        };
        let mut all = of(&[(0, 1807), (1, 5000)]);
        all.raise_bounds(&of(&[(0, 2306), (2, 3)]));
        assert_eq!(all, of(&[(0, 2306), (1, 5000), (2, 3)]));
        // What is known already is left as it is.
        let before = all.clone();
        all.raise_bounds(&of(&[(0, 5), (1, 5000)]));
        assert_eq!(all, before);
    }
}
