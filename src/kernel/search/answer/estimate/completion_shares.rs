//! How the completions of nodes compare, before they are known.

use crate::search::diagram::completion::Missing;
use crate::search::diagram::redundancy_so_far::Spent;
use crate::search::diagram::{DEAD, Diagram};

/// Where a way to a node leads in a diagram that has every variant of another: to a node, if any.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::search) struct LeadsTo(u32);

impl Default for LeadsTo {
    /// To the root.
    fn default() -> Self {
        LeadsTo(0)
    }
}

/// What tells how many variants nodes lead to, in parts of the most in their layer: no less than in truth.
#[derive(Debug)]
pub(in crate::search) enum CompletionShares<'a> {
    /// The dimensions of their motions.
    ByDimension(&'a Missing),
    /// Where ways to them lead in a diagram that has every variant, and some that are none.
    Within {
        all: &'a Diagram,
        /// Of each node of each layer of it.
        shares: Vec<Vec<f64>>,
    },
}

impl<'a> CompletionShares<'a> {
    /// Those within a diagram that has every variant.
    ///
    /// # Complexity
    /// O(edges).
    pub(in crate::search) fn within(all: &'a Diagram) -> Self {
        let mut after = vec![1.0; all.terminals.len()];
        let mut shares = Vec::with_capacity(all.layers.len() + 1);
        for layer in all.layers.iter().rev() {
            let sum = |edges: &[u32]| -> f64 {
                let alive = edges.iter().filter(|to| **to != DEAD);
                alive.map(|&to| after[to as usize]).sum()
            };
            let edges = layer.edges.chunks(layer.choices.max(1));
            let mut before: Vec<f64> = edges.map(sum).collect();
            // Products of many overflow.
            let most = before.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            before.iter_mut().for_each(|share| *share /= most);
            shares.push(std::mem::replace(&mut after, before));
        }
        shares.push(after);
        shares.reverse();
        CompletionShares::Within { all, shares }
    }

    /// That of a node after so many stages, by what it spent and how many numbers its matrix has, or by where a way to it leads.
    pub(in crate::search) fn of(
        &self,
        stages: usize,
        spent: &Spent,
        size: usize,
        at: LeadsTo,
    ) -> f64 {
        match self {
            CompletionShares::ByDimension(missing) => missing.share(stages, spent, size),
            CompletionShares::Within { shares, .. } => share(&shares[stages], at),
        }
    }

    /// Whether a node after so many stages has no completion, as far as what it spent and how many numbers its matrix has tell.
    pub(in crate::search) fn fails(&self, stages: usize, spent: &Spent, size: usize) -> bool {
        match self {
            CompletionShares::ByDimension(missing) => missing.least(stages, spent, size).is_none(),
            CompletionShares::Within { .. } => false,
        }
    }

    /// Where ways lead over the `edges` of a stage to the `next` nodes: of those to one node that with the smallest share, for none has
    /// fewer completions than the node.
    pub(in crate::search) fn over(
        &self,
        stage: usize,
        at: &[LeadsTo],
        edges: &[u32],
        next: usize,
    ) -> Vec<LeadsTo> {
        let CompletionShares::Within { all, shares } = self else {
            return vec![LeadsTo::default(); next];
        };
        let (layer, shares) = (&all.layers[stage], &shares[stage + 1]);
        let mut to: Vec<Option<LeadsTo>> = vec![None; next];
        for (at, edges) in at.iter().zip(edges.chunks(layer.choices.max(1))) {
            for (choice, &node) in edges.iter().enumerate().filter(|(_, node)| **node != DEAD) {
                let led = match at.0 {
                    DEAD => LeadsTo(DEAD),
                    at => LeadsTo(layer.edges[at as usize * layer.choices + choice]),
                };
                let known = &mut to[node as usize];
                if known.is_none_or(|known| share(shares, led) < share(shares, known)) {
                    *known = Some(led);
                }
            }
        }
        to.into_iter()
            .map(|to| to.unwrap_or(LeadsTo(DEAD)))
            .collect()
    }
}

/// The share of where a way leads: none where it leads to no variant.
fn share(shares: &[f64], at: LeadsTo) -> f64 {
    shares.get(at.0 as usize).copied().unwrap_or(0.0)
}
