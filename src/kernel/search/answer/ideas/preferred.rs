//! Selects the variant that an idea shows. Among the cheapest variants it prefers the one with the same change at most pairs of joints that
//! are images of each other, then the one with the least weight of places:
//! the drive and the pivots in the frame stay, and the ends of rods change before other joints.
//!
//! A rod is the simplest part of a linkage: it is taken out and has its ends replaced without touching what it joins. A pivot in
//! the frame carries its link over the whole width, and its bore is in the largest casting; the driven joint holds the motor.

use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::search::answer::ideas::freedom_patterns::{Pattern, Patterns};
use crate::search::answer::k_best::Assignment;
use crate::search::answer::keys::Key;
use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::diagram::{DEAD, Diagram};
use crate::search::question::Question;
use crate::search::question::space::Space;
use hashbrown::HashMap;

/// Maximum number of variants of an idea that are compared.
const COMPARED: usize = 4096;
/// Maximum number of partial variants that are examined for them.
const LOOKED: usize = 1 << 16;

/// Returns the variant that represents the idea of one of its cheapest variants. This is the given variant if there are too
/// many to examine.
///
/// # Complexity
/// O(nodes that the idea's variants use · ways of sharing out its freedoms), bounded.
pub(super) fn preferred_variant(
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
        weights,
        takes: patterns
            .of
            .iter()
            .map(|v| v.iter().map(nonzero_entries).collect())
            .collect(),
        to_come: patterns.to_come(diagram),
        least: HashMap::new(),
        states: 0,
        left: patterns.of_variant(&first),
        choices: vec![0; first.choices.len()],
        sum: Key::default(),
        best: None,
        found: 0,
        looked: 0,
    };
    members.visit_variants(0, 0, first.key.cost());
    let own = members.preference_rank(&first.choices, first.key);
    // Where several are alike in this, the first in the order of the diagram's variables.
    match members.best {
        Some((rank, best)) if rank < own => best,
        _ => first,
    }
}

/// How many joints are unlike their images, the weight of places, W, and the number of changes.
type Rank = (usize, u64, i64, u32);

/// Returns the nonzero entries of a choice's pattern.
fn nonzero_entries(takes: &Pattern) -> Vec<(usize, u8)> {
    let all = takes.iter().copied().enumerate();
    all.filter(|(_, n)| *n > 0).collect()
}

/// The variants of one pattern and cost, each compared with the best so far.
struct Members<'a> {
    question: &'a Question,
    diagram: &'a Diagram,
    patterns: &'a Patterns,
    weights: &'a [u64],
    /// `[variable][choice]`: which numbers of a pattern it takes from, and how much.
    takes: Vec<Vec<Vec<(usize, u8)>>>,
    /// The largest pattern that the layers after each layer can add.
    to_come: Vec<Pattern>,
    /// From a node with some of the pattern left, the least cost of a way to the end.
    least: HashMap<(usize, u32), HashMap<Pattern, Option<u64>>>,
    /// How many of these there are.
    states: usize,
    /// The rest of the pattern at this point, the choices so far, and the sum of their steps.
    left: Pattern,
    choices: Vec<usize>,
    sum: Key,
    best: Option<(Rank, Assignment)>,
    found: usize,
    looked: usize,
}

impl Members<'_> {
    /// Returns the properties by which variants are compared; less is preferred.
    fn preference_rank(&self, choices: &[usize], key: Key) -> Rank {
        let changed = choices.iter().zip(self.weights).filter(|(c, _)| **c != 0);
        let weight = changed.map(|(_, weight)| weight).sum();
        (
            self.patterns.count_unlike(choices),
            weight,
            self.question.mobility(key),
            key.changes(),
        )
    }

    /// Takes a choice at a node and subtracts its freedoms from the rest of the pattern. Returns the next node and the cost, or `None` if
    /// the choice does not fit or later choices cannot add the rest.
    fn take_choice(&mut self, depth: usize, node: u32, choice: usize) -> Option<(u32, u64)> {
        let layer = &self.diagram.layers[depth];
        let to = layer.edges[node as usize * layer.choices + choice];
        let takes = &self.takes[layer.variable][choice];
        if to == DEAD || takes.iter().any(|&(i, n)| self.left[i] < n) {
            return None;
        }
        for &(i, n) in takes {
            self.left[i] -= n;
        }
        let mut left = self.left.iter().zip(&self.to_come[depth]);
        if left.any(|(left, most)| left > most) {
            self.return_choice(depth, choice);
            return None;
        }
        Some((to, self.question.steps.keys[layer.variable][choice].cost()))
    }

    /// Gives the share of a choice back.
    fn return_choice(&mut self, depth: usize, choice: usize) {
        for &(i, n) in &self.takes[self.diagram.layers[depth].variable][choice] {
            self.left[i] += n;
        }
    }

    /// Returns the least cost of a path from a node to the end that adds exactly the remaining pattern.
    fn least_cost(&mut self, depth: usize, node: u32) -> Option<u64> {
        if depth == self.diagram.layers.len() {
            let end = *self.diagram.terminals.get(node as usize)?;
            let cost = self.question.steps.redundancy_key(end).cost();
            return self.left.iter().all(|n| *n == 0).then_some(cost);
        }
        let known = self.least.get(&(depth, node));
        if let Some(&known) = known.and_then(|k| k.get(&self.left)) {
            return known;
        }
        if self.states > LOOKED {
            return None;
        }
        let mut least: Option<u64> = None;
        for choice in 0..self.diagram.layers[depth].choices {
            let Some((to, cost)) = self.take_choice(depth, node, choice) else {
                continue;
            };
            let here = self.least_cost(depth + 1, to).map(|l| l + cost);
            least = least.into_iter().chain(here).min();
            self.return_choice(depth, choice);
        }
        let of = self.least.entry((depth, node)).or_default();
        of.insert(self.left.clone(), least);
        self.states += 1;
        least
    }

    /// Looks at the variants that end with just so much cost.
    fn visit_variants(&mut self, depth: usize, node: u32, cost: u64) {
        self.looked += 1;
        let enough = self.found >= COMPARED || self.looked > LOOKED;
        let least = self.least_cost(depth, node);
        if enough || least.is_none_or(|l| l > cost) {
            return;
        }
        if depth == self.diagram.layers.len() {
            if least == Some(cost) {
                self.compare_best(self.diagram.terminals[node as usize]);
            }
            return;
        }
        let variable = self.diagram.layers[depth].variable;
        for choice in 0..self.diagram.layers[depth].choices {
            let Some((to, here)) = self.take_choice(depth, node, choice) else {
                continue;
            };
            if let Some(cost) = cost.checked_sub(here) {
                let before = self.sum;
                self.sum = Key(before.0 + self.question.steps.keys[variable][choice].0);
                self.choices[variable] = choice;
                self.visit_variants(depth + 1, to, cost);
                self.sum = before;
            }
            self.return_choice(depth, choice);
        }
    }

    /// Compares the variant that is chosen now, which ends so.
    fn compare_best(&mut self, end: Redundancy) {
        self.found += 1;
        let key = Key(self.sum.0 + self.question.steps.redundancy_key(end).0);
        if !self.question.is_wanted(key) {
            return;
        }
        let rank = self.preference_rank(&self.choices, key);
        if self.best.as_ref().is_none_or(|(best, _)| rank < *best) {
            let choices = self.choices.clone();
            self.best = Some((rank, Assignment { key, choices }));
        }
    }
}

/// Weight of a change at the driven joint.
const DRIVEN: u64 = 4;
/// Weight of a change at a pivot in the frame.
const FRAME: u64 = 2;
/// Weight of a change at any other joint that is not a rod's end.
const PIVOT: u64 = 1;

/// Returns for each variable the weight of changing its joints. Lower weights come first.
#[must_use]
pub(crate) fn change_weights(mechanism: &Mechanism, space: &Space) -> Vec<u64> {
    let of = |&j: &JointId| change_weight(mechanism, j);
    let variables = space.variables.iter();
    variables.map(|v| v.joints.iter().map(of).sum()).collect()
}

/// Returns the weight of changing a joint.
#[must_use]
pub(crate) fn change_weight(mechanism: &Mechanism, joint: JointId) -> u64 {
    let (frame, here) = (mechanism.frame_link(), &mechanism.joints[joint]);
    let driven = if here.drive { DRIVEN } else { 0 };
    let place = match here.links {
        links if links.contains(&frame) => FRAME,
        links if links.iter().any(|&l| is_rod(mechanism, l)) => 0,
        _ => PIVOT,
    };
    driven + place
}

/// Returns true if a link joins exactly two others, neither of them the frame.
#[must_use]
pub fn is_rod(mechanism: &Mechanism, link: LinkId) -> bool {
    let frame = mechanism.frame_link();
    let links = mechanism
        .joints_in(StateId::FREE)
        .map(|j| mechanism.joints[j].links);
    let own: Vec<[LinkId; 2]> = links.filter(|l| l.contains(&link)).collect();
    let inner = mechanism.links[link].role == Role::Inner;
    inner && own.len() == 2 && !own.iter().any(|l| l.contains(&frame))
}
