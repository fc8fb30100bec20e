//! Diagrams built from both ends, where equal motion spaces are too many.
//!
//! Nodes with the same completions may add different vectors to the original joints. In coupled contours most do. Here one
//! half of the variables is taken from the front and the other half from the back, until they meet. The pairs of nodes that
//! complete each other are [looked up](super::matching_halves) or tested. Nodes of the front with the same set of completing
//! nodes are one node, and so are nodes of the back that complete the same nodes. From there on, each choice maps such a set
//! to a set of the next layer, read from the edges of the back half. The result is the smallest diagram, and exact.
//!
//! # Sources
//! An automaton reversed, made deterministic, and that once more, is minimal: Brzozowski, "Canonical regular expressions and
//! minimal state graphs for definite events" (1962).

use crate::search::diagram::layer::{Merge, Nodes};
use crate::search::diagram::minimize::minimize_diagram;
use crate::search::diagram::node_sets::{
    Numbered, Set, add_node, collect_set, contains_node, empty_set, nodes_in,
};
use crate::search::diagram::redundancy_so_far::{Redundancy, Spent};
use crate::search::diagram::stage::Stage;
use crate::search::diagram::within::Within;
use crate::search::diagram::{Control, DEAD, Diagram, Expanded, Layer, Progress, Stop, next_layer};
use crate::search::question::space::Space;
use crate::search::solve::spanning_halves::{Halves, JoinedSides};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Layers from one end, as far as they have come.
struct Side<'a> {
    stages: &'a [Stage<'a>],
    layers: Vec<Layer>,
    nodes: Nodes,
    /// The nodes of a known diagram that correspond to the nodes.
    known: Option<Within<'a>>,
}

impl<'a> Side<'a> {
    fn new(stages: &'a [Stage<'a>], already: u32, known: Option<Within<'a>>) -> Self {
        Side {
            stages,
            known,
            layers: Vec::new(),
            nodes: Nodes::root_node(Spent::within_mechanism(already), 1),
        }
    }

    /// Returns the stage that comes next.
    fn next_stage(&self) -> &'a Stage<'a> {
        &self.stages[self.layers.len()]
    }

    /// Returns the number of children that the next stage makes.
    fn next_children(&self, space: &Space) -> usize {
        self.nodes.len() * space.variables[self.next_stage().variable].choices.len()
    }

    fn held_bytes(&self) -> usize {
        let edges: usize = self.layers.iter().map(|l| l.edges.len()).sum();
        self.nodes.held_bytes() + size_of::<u32>() * edges
    }
}

/// Returns nodes of the front that are at the same node of a known diagram, with the nodes of the back that it leads to; `None` if no
/// diagram is known.
fn group_nodes(front: &Side<'_>, back: &Side<'_>) -> Option<Vec<[Vec<usize>; 2]>> {
    let (from, to) = (front.known.as_ref()?, back.known.as_ref()?);
    let mut groups: BTreeMap<usize, [Vec<usize>; 2]> = BTreeMap::new();
    for (end, known) in [from, to].into_iter().enumerate() {
        for (node, at) in known.at.iter().enumerate() {
            nodes_in(at).for_each(|at| groups.entry(at).or_default()[end].push(node));
        }
    }
    Some(groups.into_values().collect())
}

/// Returns the whole diagram of a question whose variants have no redundant constraints except those that all have, part by part. Returns
/// `None` if it does not fit the limits, or if cancelled.
///
/// # Complexity
/// O(n·m) joins for n and m nodes where the halves meet, which are about as many as half of the joints need.
pub(in crate::search) fn two_sided(
    question: &Halves<'_>,
    space: &Space,
    control: Control<'_>,
) -> Option<Diagram> {
    let of = question.parts.iter().map(|[front, _]| front.len()).sum();
    let (mut parts, mut done, mut total) = (Vec::new(), 0, 1);
    for ends in &question.parts {
        let progress = |now: Progress| (control.progress)(now.after(done, of, total));
        let own = control.with_progress(&progress);
        let halves = build_halves(question, space, (parts.len(), ends), own)?;
        done += ends[0].len();
        total += halves.iter().map(|side| side.nodes.len()).sum::<usize>();
        parts.push(halves);
    }
    let held: usize = parts.iter().flatten().map(Side::held_bytes).sum();
    let left = question.limits.bytes.checked_sub(held)?;
    let most = question.limits.nodes;
    let mut layers: Vec<Layer> = Vec::new();
    let mut total = 1;
    for (part, [front, back]) in parts.into_iter().enumerate() {
        let groups = group_nodes(&front, &back);
        let sides = JoinedSides {
            front: &front.nodes,
            back: &back.nodes,
            stages: back.layers.len(),
            spanned: groups.is_some(),
            groups: groups.unwrap_or_else(|| {
                vec![[&front, &back].map(|side| (0..side.nodes.len()).collect())]
            }),
            bytes: left / 4,
        };
        let (of_front, sets) = question.join_halves(part, &sides, control.cancelled)?;
        let (back, sets) = without_twins(back.layers, sets);
        let found = put_together(front.layers, &of_front, &back, sets, most)?;
        total += found.iter().map(|l| l.nodes).sum::<usize>();
        if total > most {
            return None;
        }
        layers.extend(found);
    }
    let end = Spent::within_mechanism(question.already).redundancy();
    let last = layers.last().into_iter().flat_map(|l| &l.edges);
    let terminals = usize::from(last.into_iter().any(|&e| e != DEAD));
    Some(minimize_diagram(layers, vec![end; terminals]))
}

/// Builds the halves of a part.
fn build_halves<'a>(
    question: &'a Halves<'_>,
    space: &Space,
    (part, ends): (usize, &'a [Vec<Stage<'a>>; 2]),
    control: Control<'_>,
) -> Option<[Side<'a>; 2]> {
    let limits = question.limits;
    let known = question.within_known(part);
    let [from, to] = known.map_or([None, None], |ends| ends.map(Some));
    let mut front = Side::new(&ends[0], question.already, from);
    let mut back = Side::new(&ends[1], question.already, to);
    let mut total = 2;
    let of = ends[0].len();
    for done in 0..of {
        let (side, other) = if front.next_children(space) <= back.next_children(space) {
            (&mut front, &back)
        } else {
            (&mut back, &front)
        };
        let room = limits.nodes.checked_sub(total)?;
        let bytes = limits
            .bytes
            .checked_sub(side.held_bytes() + other.held_bytes())?;
        let progress = |now: Progress| (control.progress)(now.after(done, of, total));
        let own = control.with_progress(&progress);
        advance_side(space, side, (room, bytes), own)?;
        total += side.nodes.len();
    }
    Some([front, back])
}

/// Carries a side over its next stage, to no more than `room` nodes within so many bytes.
fn advance_side(
    space: &Space,
    side: &mut Side<'_>,
    (room, bytes): (usize, usize),
    control: Control<'_>,
) -> Option<()> {
    let stage = side.next_stage();
    let choices = &space.variables[stage.variable].choices;
    let edges = side.nodes.len() * choices.len();
    let known = side.known.as_ref();
    let from = Expanded {
        nodes: &side.nodes,
        choices,
        wanted: &|edge| known.is_none_or(|known| known.has_edge(edge)),
        bytes,
    };
    let merge = next_layer(
        stage,
        &from,
        Merge::new((room, bytes), Stop::Exhausted, edges, 1),
        |_, _, _| false,
        control,
    );
    if merge.stop != Stop::Exhausted {
        return None;
    }
    if let Some(known) = &mut side.known {
        known.advance(&merge.edges, merge.next.len());
    }
    side.layers.push(Layer {
        variable: stage.variable,
        nodes: side.nodes.len(),
        choices: choices.len(),
        edges: merge.edges,
    });
    side.nodes = merge.next;
    Some(())
}

/// Merges nodes of the back that complete the same nodes of the front. Returns the layers, and the completing sets in the
/// new node numbers.
fn without_twins(mut back: Vec<Layer>, sets: Vec<Set>) -> (Vec<Layer>, Vec<Set>) {
    let Some(last) = back.last_mut() else {
        return (back, sets);
    };
    let alive = || last.edges.iter().filter(|e| **e != DEAD);
    let most = alive().max().map_or(0, |&e| e as usize + 1);
    let mut completes = vec![empty_set(sets.len()); most];
    for (number, set) in sets.iter().enumerate() {
        nodes_in(set).for_each(|node| add_node(&mut completes[node], number));
    }
    let mut numbered = Numbered::default();
    let kinds: Vec<u32> = completes
        .into_iter()
        .map(|set| numbered.number_of(set))
        .collect();
    let alive = last.edges.iter_mut().filter(|e| **e != DEAD);
    alive.for_each(|e| *e = kinds[*e as usize]);
    let mut example = vec![0; numbered.all.len()];
    for (node, &kind) in kinds.iter().enumerate().filter(|(_, k)| **k != DEAD) {
        example[kind as usize] = node;
    }
    // Ends that differ are not put together.
    let kind = |internal| Redundancy {
        internal,
        ..Redundancy::default()
    };
    let smallest = minimize_diagram(back, (0..).map(kind).take(example.len()).collect());
    let ends = smallest.terminals.iter();
    let examples: Vec<usize> = ends.map(|kind| example[kind.internal as usize]).collect();
    let anew = |old: &Set| collect_set(examples.len(), |end| contains_node(old, examples[end]));
    (smallest.layers, sets.iter().map(anew).collect())
}

/// Joins the front's layers to layers of sets of nodes of the back that complete what was chosen. `of_front` has the numbers
/// of these sets. Returns `None` if there are more than `most` nodes.
fn put_together(
    mut layers: Vec<Layer>,
    of_front: &[u32],
    back: &[Layer],
    mut sets: Vec<Set>,
    most: usize,
) -> Option<Vec<Layer>> {
    let met = layers.last_mut()?.edges.iter_mut().filter(|e| **e != DEAD);
    met.for_each(|e| *e = of_front[*e as usize]);
    for layer in back.iter().rev() {
        let completed = |by: &Set, choice: usize| {
            let to = |node: usize| layer.edges[node * layer.choices + choice];
            collect_set(layer.nodes, |node| {
                to(node) != DEAD && contains_node(by, to(node) as usize)
            })
        };
        let ways = |by: &Set| (0..layer.choices).map(|c| completed(by, c)).collect();
        let ways: Vec<Vec<Set>> = sets.par_iter().map(ways).collect();
        let mut below = Numbered::default();
        let edges = ways.into_iter().flatten().map(|set| below.number_of(set));
        layers.push(Layer {
            variable: layer.variable,
            nodes: sets.len(),
            choices: layer.choices,
            edges: edges.collect(),
        });
        if below.all.len() > most {
            return None;
        }
        sets = below.all;
    }
    Some(layers)
}
