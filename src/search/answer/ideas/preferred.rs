//! Of the variants that an idea stands for the one that is shown: of those as cheap as the cheapest the one with the same change
//! at most of the joints that are each other's images, then the one with least weight of places.

use crate::search::answer::freedom_patterns::{Pattern, Patterns};
use crate::search::answer::k_best::Assignment;
use crate::search::answer::variants_in_order::key;
use crate::search::diagram::{DEAD, Diagram};
use crate::search::question::Question;
use std::collections::HashMap;

/// Variants of an idea that are compared, at most.
const COMPARED: usize = 4096;
/// Beginnings that are looked at for them, at most.
const LOOKED: usize = 1 << 16;

/// The variant that is shown for the idea of one that is among the cheapest of it, which it is where there are too many to look at.
///
/// # Complexity
/// O(nodes that the idea's variants use · ways of sharing out its freedoms), bounded.
pub(super) fn preferred(
    question: &Question,
    diagram: &Diagram,
    patterns: &Patterns,
    weights: &[u64],
    first: Assignment,
) -> Assignment {
    let mut members = Members {
        question,
        diagram,
        patterns,
        least: HashMap::new(),
        choices: vec![0; first.choices.len()],
        found: Vec::new(),
        looked: 0,
    };
    members.collect(0, 0, &patterns.of_variant(&first), first.key.cost());
    let rank = |v: &Assignment| {
        let chosen = v.choices.iter().enumerate();
        let changed = chosen.filter(|(_, c)| **c != 0);
        let weight: u64 = changed.map(|(v, _)| weights[v]).sum();
        let unlike = unlike(patterns, &v.choices);
        (unlike, weight, question.mobility(v.key), v.key.changes())
    };
    // Where several are alike in this, the first in the order of the diagram's variables.
    let found = members.found.into_iter();
    let all = found.map(|choices| Assignment {
        key: key(question, diagram, &choices),
        choices,
    });
    let best = all.filter(|v| question.wanted(v.key)).min_by_key(rank);
    match best {
        Some(best) if rank(&best) < rank(&first) => best,
        _ => first,
    }
}

/// How many variables are not chosen as their images are.
fn unlike(patterns: &Patterns, choices: &[usize]) -> usize {
    let images = patterns.images.iter().flatten();
    let each = images.zip(choices);
    each.filter(|(to, c)| choices[**to] != **c).count()
}

/// The variants of one pattern and cost, gathered.
struct Members<'a> {
    question: &'a Question,
    diagram: &'a Diagram,
    patterns: &'a Patterns,
    /// From a node with some of the pattern left, the least cost of a way to the end.
    least: HashMap<(usize, u32, Pattern), Option<u64>>,
    choices: Vec<usize>,
    found: Vec<Vec<usize>>,
    looked: usize,
}

impl Members<'_> {
    /// The choices that go on from a node, with where they lead, what is left of the pattern, and their cost.
    fn ways(&self, depth: usize, node: u32, left: &Pattern) -> Vec<(usize, u32, Pattern, u64)> {
        let layer = &self.diagram.layers[depth];
        let edges = &layer.edges[node as usize * layer.choices..][..layer.choices];
        let open = edges.iter().enumerate().filter(|(_, to)| **to != DEAD);
        let taken = open.filter_map(|(choice, &to)| {
            let takes = &self.patterns.of[layer.variable][choice];
            let rest = left.iter().zip(takes).map(|(a, b)| a.checked_sub(*b));
            let cost = self.question.steps.keys[layer.variable][choice].cost();
            Some((choice, to, rest.collect::<Option<Pattern>>()?, cost))
        });
        taken.collect()
    }

    /// The least cost of a way from a node to the end that adds just what is left of the pattern.
    fn least(&mut self, depth: usize, node: u32, left: &Pattern) -> Option<u64> {
        if depth == self.diagram.layers.len() {
            let end = *self.diagram.terminals.get(node as usize)?;
            let cost = self.question.steps.redundancy(end).cost();
            return left.iter().all(|n| *n == 0).then_some(cost);
        }
        let name = (depth, node, left.clone());
        if let Some(&known) = self.least.get(&name) {
            return known;
        }
        if self.least.len() > LOOKED {
            return None;
        }
        let mut least: Option<u64> = None;
        for (_, to, rest, cost) in self.ways(depth, node, left) {
            let here = self.least(depth + 1, to, &rest).map(|l| l + cost);
            least = least.into_iter().chain(here).min();
        }
        self.least.insert(name, least);
        least
    }

    /// Gathers the variants that end with just so much cost.
    fn collect(&mut self, depth: usize, node: u32, left: &Pattern, cost: u64) {
        self.looked += 1;
        let enough = self.found.len() >= COMPARED || self.looked > LOOKED;
        let least = self.least(depth, node, left);
        if enough || least.is_none_or(|l| l > cost) {
            return;
        }
        if depth == self.diagram.layers.len() {
            if least == Some(cost) {
                self.found.push(self.choices.clone());
            }
            return;
        }
        let variable = self.diagram.layers[depth].variable;
        for (choice, to, rest, here) in self.ways(depth, node, left) {
            if let Some(cost) = cost.checked_sub(here) {
                self.choices[variable] = choice;
                self.collect(depth + 1, to, &rest, cost);
            }
        }
    }
}
