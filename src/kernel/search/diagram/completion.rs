//! The least cost of completing a partly chosen mechanism, by dimensions only.
//!
//! The choices of a node add a subspace of dimension r in the open contours. A choice raises r by at most its own dimension. Each
//! coordinate that closes lowers r by one, unless it may stay redundant. Dimensions computed as if every freedom counted are never less
//! than the true ones, so a completion that fails by dimensions fails. The cheapest choices that do not fail cost no more than the
//! cheapest true completion. This lower bound is found for every stage and dimension at once.
//!
//! Redundant constraints that are still allowed do the work of dimensions when a coordinate closes, and are counted with them.

use crate::search::diagram::redundancy_so_far::{Limits, Spent};
use crate::search::diagram::stage::Stage;
use crate::search::question::space::{Choice, Space};
use std::collections::BTreeMap;

/// The cost up to which variants are wanted.
#[derive(Debug)]
pub(in crate::search) struct Ceiling<'m> {
    missing: &'m Missing,
    /// The cost. `[thousandths]`
    pub(in crate::search) cost: i64,
    /// The number of nodes omitted, by their least cost.
    pub(in crate::search) beyond: BTreeMap<i64, usize>,
}

impl<'m> Ceiling<'m> {
    /// Returns a ceiling that has omitted no node yet.
    pub(in crate::search) fn new(missing: &'m Missing, cost: i64) -> Self {
        Ceiling {
            missing,
            cost,
            beyond: BTreeMap::new(),
        }
    }

    /// Returns whether a way of a cost to a node after so many stages leads to no variant within the ceiling. The choices of the node add a
    /// space of this dimension in the open contours.
    pub(in crate::search) fn is_above(
        &mut self,
        stages: usize,
        spent: &Spent,
        dimension: usize,
        cost: i64,
    ) -> bool {
        let Some(rest) = self.missing.least_cost(stages, spent, dimension) else {
            return true;
        };
        let above = cost + rest > self.cost;
        if above {
            *self.beyond.entry(cost + rest).or_default() += 1;
        }
        above
    }
}

/// Least costs of completions by dimension.
#[derive(Debug)]
pub(in crate::search) struct Missing {
    /// Least cost in thousandths of a completion, by number of stages and by dimension; `None` if there is no completion. The last entry
    /// also holds for larger dimensions.
    least: Vec<Vec<Option<i64>>>,
    root: Spent,
    allowed: u32,
}

impl Missing {
    /// Returns the least costs for a diagram's stages, by the lane of the free state.
    ///
    /// # Complexity
    /// O(stages · dimensions · choices).
    pub(in crate::search) fn new(
        space: &Space,
        stages: &[Stage<'_>],
        root: &Spent,
        limits: &Limits,
    ) -> Missing {
        let lanes = || stages.iter().map(|s| &s.lanes[0].all);
        let gaps: usize = lanes().map(|columns| columns.closing).sum();
        let gaps = u32::try_from(gaps).unwrap_or(u32::MAX);
        // Coordinates that no variant reaches are redundant from the start.
        let allowed = limits.internal.min(root.internal().saturating_add(gaps));
        let spare = allowed as usize;
        let widths = lanes().map(|columns| columns.width - columns.closing);
        let width: Vec<usize> = std::iter::once(0).chain(widths).collect();
        let mut least = vec![vec![Some(0); spare + 1]];
        for (t, (stage, columns)) in stages.iter().zip(lanes()).enumerate().rev() {
            let after: &[Option<i64>] = &least[least.len() - 1];
            let choices = &space.variables[stage.variable].choices;
            let dimensions = columns.added_dimensions();
            let cheapest = |r: usize| {
                let completed = |(choice, added): (&Choice, &usize)| {
                    let left = (r + added).checked_sub(columns.closing)?;
                    Some(after[left.min(after.len() - 1)]? + choice.cost_milli)
                };
                choices.iter().zip(&dimensions).filter_map(completed).min()
            };
            let before = (0..=width[t] + spare).map(cheapest).collect();
            least.push(before);
        }
        least.reverse();
        Missing {
            least,
            root: root.clone(),
            allowed,
        }
    }

    /// Returns the least cost in thousandths of a variant; `None` if there is no variant.
    pub(in crate::search) fn least_of_root(&self) -> Option<i64> {
        self.least_cost(0, &self.root, 0)
    }

    /// Returns the least cost in thousandths of completing a node after so many stages, whose choices add a space of this dimension in the
    /// open contours; `None` where it has no completion.
    fn least_cost(&self, stages: usize, spent: &Spent, dimension: usize) -> Option<i64> {
        let spare = self.allowed.saturating_sub(spent.internal());
        let of_stage = &self.least[stages];
        of_stage[(dimension + spare as usize).min(of_stage.len() - 1)]
    }
}
