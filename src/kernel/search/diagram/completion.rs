//! What a partly chosen mechanism still needs, by dimensions alone.
//!
//! The motions of a node have a dimension r. A joint adds its freedoms at most, a contour that closes takes a twist's six but
//! for what may stay redundant, and no more is left than the live links can have. So dimensions carried over the stages as if
//! every freedom told are never less than the true ones, and what fails by dimensions fails. The cheapest choices that do
//! not fail so cost no more than the cheapest true completion: a lower bound, found for every stage and dimension at once.
//!
//! The redundant constraints still allowed are as good as dimensions at a closing, and are counted with them.

use crate::search::diagram::redundancy_so_far::{Limits, Spent};
use crate::search::diagram::stage::Stage;
use crate::search::diagram::state_copies::{Lane, Move};
use crate::search::question::space::Space;
use std::collections::BTreeMap;

/// The cost up to which variants are wanted.
#[derive(Debug)]
pub(in crate::search) struct Ceiling<'m> {
    missing: &'m Missing,
    /// The cost. `[thousandths]`
    pub(in crate::search) cost: i64,
    /// How often something was left out for its least cost, by that cost.
    pub(in crate::search) beyond: BTreeMap<i64, usize>,
}

impl<'m> Ceiling<'m> {
    /// A ceiling that has left out nothing yet.
    pub(in crate::search) fn new(missing: &'m Missing, cost: i64) -> Self {
        Ceiling {
            missing,
            cost,
            beyond: BTreeMap::new(),
        }
    }

    /// Whether a way of a cost to a node after so many stages leads to no variant within the ceiling.
    pub(in crate::search) fn is_above(
        &mut self,
        stages: usize,
        spent: &Spent,
        size: usize,
        cost: i64,
    ) -> bool {
        let Some(rest) = self.missing.least(stages, spent, size) else {
            return true;
        };
        let above = cost + rest > self.cost;
        if above {
            *self.beyond.entry(cost + rest).or_default() += 1;
        }
        above
    }
}

/// The least share.
const SMALLEST: f64 = 1e-9;

/// Completions by dimension.
#[derive(Debug)]
pub(in crate::search) struct Missing {
    /// Least cost in thousandths of a completion, after so many stages, by dimension; none where there is no completion. A
    /// larger dimension than the last counts as the last.
    least: Vec<Vec<Option<i64>>>,
    /// Choices for the rest that do not fail, as a share of those of the largest dimension; above 0 where there are any.
    share: Vec<Vec<f64>>,
    /// Numbers in a row of a node's matrix, after so many stages.
    width: Vec<usize>,
    already: u32,
    allowed: u32,
}

impl Missing {
    /// Of a diagram's stages, whose last nodes have a dimension of `end` at least.
    ///
    /// # Complexity
    /// O(stages · dimensions · choices).
    pub(in crate::search) fn new(
        space: &Space,
        stages: &[Stage],
        limits: &Limits,
        end: usize,
    ) -> Missing {
        let common = |s: &Stage| s.moves.iter().all(|m| m.lane == Lane::Common);
        let moves = stages.iter().flat_map(|s| &s.moves);
        let rows: usize = moves.map(|m| m.step.directions(space.dim)).sum();
        let allowed = limits.internal.min(u32::try_from(rows).unwrap_or(u32::MAX));
        let spare = allowed as usize;
        let mut width = vec![0];
        for stage in stages {
            let of = |m: &Move| m.step.kept() * space.dim;
            width.push(stage.moves.last().map_or(width[width.len() - 1], of));
        }
        // Where the searched state's ways begin, nodes are written out several times: from there on only costs count.
        let known = stages.iter().take_while(|s| common(s)).count();
        let needed = if known == stages.len() { end } else { 0 };
        let mut least: Vec<Vec<Option<i64>>> = vec![Vec::new(); stages.len() + 1];
        let mut share: Vec<Vec<f64>> = vec![Vec::new(); stages.len() + 1];
        if known < stages.len() {
            (least[stages.len()], share[stages.len()]) = (vec![Some(0)], vec![1.0]);
        }
        for (t, stage) in stages.iter().enumerate().skip(known).rev() {
            let choices = &space.variables[stage.variable].choices;
            let cheapest = choices.iter().map(|c| c.cost_milli).min().unwrap_or(0);
            let after = least[t + 1].first().copied().flatten().unwrap_or(0);
            (least[t], share[t]) = (vec![Some(after + cheapest)], vec![1.0]);
        }
        if known == stages.len() {
            let most = width[known] + spare;
            least[known] = (0..=most).map(|r| (r >= needed).then_some(0)).collect();
            share[known] = (0..=most)
                .map(|r| f64::from(u8::from(r >= needed)))
                .collect();
        }
        for (t, stage) in stages[..known].iter().enumerate().rev() {
            let dimensions = 0..=width[t] + spare;
            let all =
                dimensions.map(|r| through(space, stage, r, spare, &least[t + 1], &share[t + 1]));
            let (cheapest, passing): (Vec<_>, Vec<f64>) = all.unzip();
            // Long products underflow to 0, and a probability must stay positive.
            let most = passing.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            let scaled = passing.iter().map(|x| (x / most).max(SMALLEST));
            (least[t], share[t]) = (cheapest, scaled.collect());
        }
        Missing {
            least,
            share,
            width,
            already: limits.already,
            allowed,
        }
    }

    /// The least cost in thousandths of a variant.
    pub(in crate::search) fn root(&self) -> Option<i64> {
        self.least(0, &Spent::within_mechanism(self.already), 0)
    }

    /// Where a node after so many stages stands in the tables.
    fn at(&self, stages: usize, spent: &Spent, size: usize) -> usize {
        let rows = size.checked_div(self.width[stages]).unwrap_or(0);
        let spare = self.allowed.saturating_sub(spent.internal());
        (rows + spare as usize).min(self.least[stages].len() - 1)
    }

    /// The least cost in thousandths of completing a node with a matrix of `size` numbers after so many stages; none where
    /// it has no completion.
    pub(in crate::search) fn least(
        &self,
        stages: usize,
        spent: &Spent,
        size: usize,
    ) -> Option<i64> {
        self.least[stages][self.at(stages, spent, size)]
    }

    /// The share of choices for the rest that may complete such a node.
    pub(in crate::search) fn share(&self, stages: usize, spent: &Spent, size: usize) -> f64 {
        self.share[stages][self.at(stages, spent, size)]
    }
}

/// The least cost of a completion of nodes of a dimension before a stage, and the sum of the shares of the choices that do not fail,
/// from the least costs and the shares after it.
fn through(
    space: &Space,
    stage: &Stage,
    dimension: usize,
    spare: usize,
    least: &[Option<i64>],
    share: &[f64],
) -> (Option<i64>, f64) {
    let (mut best, mut sum) = (None::<i64>, 0.0);
    for choice in &space.variables[stage.variable].choices {
        let carried = stage.moves.iter().try_fold(dimension, |r, m| {
            let gaps = m.step.directions(space.dim);
            let r = (r + choice.spans[m.member].len()).checked_sub(gaps)?;
            Some(r.min(m.step.kept() * space.dim + spare))
        });
        let Some(r) = carried else { continue };
        let at = r.min(least.len() - 1);
        if let Some(rest) = least[at] {
            let cost = rest + choice.cost_milli;
            best = Some(best.map_or(cost, |b| b.min(cost)));
            sum += share[at];
        }
    }
    (best, sum)
}
