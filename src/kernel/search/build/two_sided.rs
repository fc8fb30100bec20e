//! Diagrams built from both ends, where equal motion spaces are too many.
//!
//! Nodes with the same futures may have different motion spaces, and in coupled contours most do. Here one half of the
//! variables is taken from the front and the other from the back, until they meet; which nodes of the one complete which of the
//! other is tested for every pair. What a node of the front is completed by says all of its future, so those with the same set
//! are one, and the sets lead on: a variable's choice turns the set of completions by what is left, read off the edges of the
//! half that came from the back. The outcome is the smallest diagram there is, and exact.
//!
//! # Sources
//! An automaton reversed, made deterministic, and that once more, is minimal: Brzozowski, "Canonical regular expressions and
//! minimal state graphs for definite events" (1962).

use crate::search::build::complements::{Half, Kept, Set, has, join, set};
use crate::search::diagram::layer::{Merge, Nodes};
use crate::search::diagram::minimize::minimal;
use crate::search::diagram::redundancy_so_far::{Limits, Spent};
use crate::search::diagram::stage::Stage;
use crate::search::diagram::{DEAD, Diagram, Layer, Over, Progress, Stop, next, passing, retain};
use crate::search::question::Question;
use crate::search::reduce::plane_split::Model;
use rayon::prelude::*;
use std::collections::HashMap;

/// Pairs of nodes tried at most, for each node of the budget.
const PAIRS: usize = 100;

/// Layers from one end, as far as they have come.
struct Side<'a> {
    stages: &'a [Stage],
    layers: Vec<Layer>,
    nodes: Nodes,
}

impl<'a> Side<'a> {
    fn new(stages: &'a [Stage], already: u32) -> Self {
        Side {
            stages,
            layers: Vec::new(),
            nodes: Nodes::root(already),
        }
    }

    /// The stage that comes next.
    fn ahead(&self) -> &'a Stage {
        &self.stages[self.layers.len()]
    }

    fn half(&self) -> Half<'_> {
        let step = self.layers.len().checked_sub(1);
        let step = step
            .and_then(|i| self.stages[i].moves.last())
            .map(|m| &m.step);
        Half {
            nodes: &self.nodes,
            live: step.map_or(&[], |s| &s.live),
            pending: step.map_or(&[], |s| &s.pending),
        }
    }

    fn bytes(&self) -> usize {
        let edges: usize = self.layers.iter().map(|l| l.edges.len()).sum();
        self.nodes.bytes() + size_of::<u32>() * edges
    }
}

/// The whole diagram of a question whose variants have no redundant constraints but those that all have, from the stages
/// of both directions, part by part; none where it does not fit the limits either, or where it is cancelled.
///
/// # Complexity
/// O(n·m) joins for n and m nodes where the halves meet, which are about as many as half of the joints need.
pub(in crate::search) fn two_sided(
    question: &Question,
    model: &Model,
    parts: &[[Vec<Stage>; 2]],
    (limits, keep_output): (&Limits, bool),
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Option<Diagram> {
    let kept = Kept {
        links: &question.kept.0,
        dimension: model.kept.len(),
    };
    let of = parts.iter().map(|[front, _]| front.len()).sum();
    let mut layers: Vec<Layer> = Vec::new();
    let mut total = 1;
    for (i, part) in parts.iter().enumerate() {
        let kept = Some(&kept).filter(|_| keep_output && i + 1 == parts.len());
        let done = layers.len();
        let mut told = |more: usize, layer: usize| {
            progress(Progress {
                done: done + more,
                of,
                nodes: total + layer,
                layer,
            });
        };
        let found = halves(question, model, part, (limits, kept), cancelled, &mut told)?;
        total += found.iter().map(|l| l.nodes).sum::<usize>();
        if total > limits.nodes {
            return None;
        }
        layers.extend(found);
    }
    let end = Spent::within_mechanism(limits.already).redundancy();
    let last = layers.last().into_iter().flat_map(|l| &l.edges);
    let terminals = usize::from(last.into_iter().any(|&e| e != DEAD));
    Some(minimal(layers, vec![end; terminals]))
}

/// The layers of a part, to one node at the end; `told` hears how many are done and how large the present one is.
fn halves(
    question: &Question,
    model: &Model,
    directions: &[Vec<Stage>; 2],
    (limits, kept): (&Limits, Option<&Kept<'_>>),
    cancelled: &(dyn Fn() -> bool + Sync),
    told: &mut dyn FnMut(usize, usize),
) -> Option<Vec<Layer>> {
    let sides = directions.each_ref();
    let [mut front, mut back] = sides.map(|stages| Side::new(stages, limits.already));
    let mut total = 2;
    for done in 0..directions[0].len() {
        let effort = |side: &Side<'_>| {
            let choices = &model.space.variables[side.ahead().variable].choices;
            side.nodes.len() * choices.len()
        };
        let (side, other) = if effort(&front) <= effort(&back) {
            (&mut front, &back)
        } else {
            (&mut back, &front)
        };
        let room = limits.nodes.checked_sub(total)?;
        let bytes = limits.bytes.checked_sub(side.bytes() + other.bytes())?;
        let told = &mut |layer: usize| told(done, layer);
        advance(
            question,
            model,
            side,
            (limits, room, bytes),
            cancelled,
            told,
        )?;
        total += side.nodes.len();
    }
    let pairs = front.nodes.len().checked_mul(back.nodes.len())?;
    let left = limits.bytes.checked_sub(front.bytes() + back.bytes())?;
    if pairs / PAIRS > limits.nodes || pairs / 8 > left / 4 {
        return None;
    }
    let sets = join(
        (question.exact.field(), model.space.dim),
        [&front.half(), &back.half()],
        question.mechanism.frame(),
        kept,
        cancelled,
    )?;
    put_together(front.layers, &back.layers, sets, limits.nodes)
}

/// Carries a side over its next stage.
fn advance(
    question: &Question,
    model: &Model,
    side: &mut Side<'_>,
    (limits, room, bytes): (&Limits, usize, usize),
    cancelled: &(dyn Fn() -> bool + Sync),
    told: &mut dyn FnMut(usize),
) -> Option<()> {
    let stage = side.ahead();
    let choices = &model.space.variables[stage.variable].choices;
    let edges = side.nodes.len() * choices.len();
    let merge = next(
        &Over::new(question.exact.field(), &model.space, stage, limits),
        choices,
        bytes,
        &side.nodes,
        Merge::new((room, bytes), Stop::Exhausted, edges),
        |_, _, _| false,
        cancelled,
        told,
    );
    if merge.stop != Stop::Exhausted {
        return None;
    }
    let (mut nodes, mut edges) = (merge.next, merge.edges);
    if let Some(test) = &stage.lookahead {
        let passed = passing(question.exact.field(), model.space.dim, test, &nodes);
        retain(&mut nodes, &passed, &mut edges);
    }
    side.layers.push(Layer {
        variable: stage.variable,
        nodes: side.nodes.len(),
        choices: choices.len(),
        edges,
    });
    side.nodes = nodes;
    Some(())
}

/// The front's layers, and from there on layers of the sets of nodes of the back that complete what was chosen; none where they
/// are more than so many nodes.
fn put_together(
    mut layers: Vec<Layer>,
    back: &[Layer],
    sets: Vec<Set>,
    most: usize,
) -> Option<Vec<Layer>> {
    let (mut known, mut nodes) = (HashMap::new(), Vec::new());
    let of_front = sets.into_iter().map(|s| number(s, &mut known, &mut nodes));
    let of_front: Vec<u32> = of_front.collect();
    let met = layers.last_mut()?.edges.iter_mut().filter(|e| **e != DEAD);
    met.for_each(|e| *e = of_front[*e as usize]);
    for layer in back.iter().rev() {
        let completed = |by: &Set, choice: usize| {
            let to = |node: usize| layer.edges[node * layer.choices + choice];
            set(layer.nodes, |node| {
                to(node) != DEAD && has(by, to(node) as usize)
            })
        };
        let ways = |by: &Set| (0..layer.choices).map(|c| completed(by, c)).collect();
        let ways: Vec<Vec<Set>> = nodes.par_iter().map(ways).collect();
        let (mut known, mut below) = (HashMap::new(), Vec::new());
        let edges = ways.into_iter().flatten();
        let edges = edges.map(|s| number(s, &mut known, &mut below));
        layers.push(Layer {
            variable: layer.variable,
            nodes: nodes.len(),
            choices: layer.choices,
            edges: edges.collect(),
        });
        if below.len() > most {
            return None;
        }
        nodes = below;
    }
    Some(layers)
}

/// The number of a set among different ones; none of what nothing completes.
fn number(set: Set, known: &mut HashMap<Set, u32>, all: &mut Vec<Set>) -> u32 {
    if set.iter().all(|&w| w == 0) {
        return DEAD;
    }
    *known.entry(set).or_insert_with_key(|set| {
        all.push(set.clone());
        u32::try_from(all.len() - 1).expect("fewer than nodes")
    })
}
