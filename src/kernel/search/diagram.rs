//! The span diagram: variants folded into the motion spaces their parts leave.
//!
//! Nodes are kept as reduced row echelon forms over a prime field, which are canonical, so equal spaces meet in one
//! hash table.

pub(in crate::search) mod allowance;
pub(in crate::search) mod between;
pub(in crate::search) mod completion;
pub(in crate::search) mod layer;
pub(in crate::search) mod minimize;
pub(in crate::search) mod node_sets;
pub(in crate::search) mod reduced_rows;
pub(crate) mod redundancy_so_far;
pub(in crate::search) mod stage;
pub(in crate::search) mod subspaces;
pub(in crate::search) mod transition;
pub(in crate::search) mod within;

use crate::search::diagram::allowance::{Allowance, carry_ways, cut_down};
use crate::search::diagram::completion::Ceiling;
use crate::search::diagram::layer::{CUT, Merge, Nodes};
pub use crate::search::diagram::layer::{Control, DEAD, Layer, Progress, ShouldCancel, Stop};
use crate::search::diagram::redundancy_so_far::{Limits, Redundancy, Role, Spent};
use crate::search::diagram::stage::Stage;
use crate::search::diagram::subspaces::NONE;
use crate::search::diagram::transition::{Step, Steps};
use crate::search::diagram::within::Within;
use crate::search::question::space::{Choice, Space};
use std::ops::Range;

/// A finished diagram.
#[derive(Debug, Clone)]
pub struct Diagram {
    /// The layers in order; layer 0 has the root alone.
    pub layers: Vec<Layer>,
    /// The redundant constraints of each terminal node.
    pub terminals: Vec<Redundancy>,
    /// Why building ended.
    pub stop: Stop,
    /// Nodes in all, root and terminals included.
    pub nodes: usize,
    /// Nodes of the largest layer.
    pub largest_layer: usize,
}

impl Diagram {
    /// Returns a diagram of complete layers.
    pub(in crate::search) fn from_layers(
        layers: Vec<Layer>,
        terminals: Vec<Redundancy>,
    ) -> Diagram {
        let sizes = || layers.iter().map(|l| l.nodes).chain([terminals.len()]);
        Diagram {
            nodes: sizes().sum(),
            largest_layer: sizes().max().unwrap_or(0),
            stop: Stop::Exhausted,
            layers,
            terminals,
        }
    }

    /// Returns the redundant constraints of a variant; `None` if the diagram does not have it.
    #[must_use]
    pub fn end_of(&self, choices: &[usize]) -> Option<Redundancy> {
        let mut node = 0;
        for layer in &self.layers {
            let to = layer.edges[node * layer.choices + choices[layer.variable]];
            node = (to != DEAD).then_some(to as usize)?;
        }
        self.terminals.get(node).copied()
    }
}

/// Edges that a diagram omits.
pub(super) enum Omitted<'a, 'm> {
    /// Nothing.
    Nothing,
    /// Whatever no variant within a cost needs.
    Above(&'a mut Ceiling<'m>),
    /// Whatever is not in a known diagram that has all wanted variants.
    Outside(Within<'a>),
}

/// Builds the diagram of a space along given stages, of variants that spend `root` before any choice.
///
/// `control` is asked between batches of nodes. Once the search is cancelled, the remaining layers are cut to a few nodes, so
/// that the paths found so far can still be completed. The result does not depend on the number of threads. Children are
/// computed in parallel and merged in order.
///
/// # Complexity
/// O(nodes · choices · d²w) field operations for matrices of d rows and w columns. Memory is the edges of all layers and the
/// matrices of two, both bounded by `limits.nodes` and `limits.bytes`.
pub(super) fn build_layers(
    space: &Space,
    stages: &[Stage<'_>],
    limits: &Limits,
    root: Spent,
    mut omitted: Omitted<'_, '_>,
    control: Control<'_>,
) -> Diagram {
    let kinds = stages.first().map_or(0, |s| s.kinds().count());
    let mut nodes = Nodes::root_node(root, kinds);
    let mut ways = vec![1.0];
    let mut layers = Vec::with_capacity(stages.len());
    let (mut stop, mut allowance) = (Stop::Exhausted, Allowance::new(limits));
    for (done, stage) in stages.iter().enumerate() {
        let choices = &space.variables[stage.variable].choices;
        let total = allowance.nodes;
        let (known, mut ceiling) = match &mut omitted {
            Omitted::Nothing => (None, None),
            Omitted::Above(ceiling) => (None, Some(ceiling)),
            Omitted::Outside(known) => (Some(&*known), None),
        };
        let from = Expanded {
            nodes: &nodes,
            choices,
            wanted: &|edge| known.is_none_or(|known| known.has_edge(edge)),
            bytes: allowance.bytes,
        };
        let progress = |now: Progress| (control.progress)(now.after(done, stages.len(), total));
        let merge = next_layer(
            stage,
            &from,
            allowance.begin_layer(&nodes, nodes.len() * choices.len(), stop),
            |spent, dimension, least| {
                let ceiling = ceiling.as_mut();
                ceiling.is_some_and(|c| c.is_above(done + 1, spent, dimension, least))
            },
            control.with_progress(&progress),
        );
        stop = merge.stop;
        let (refused, mut next, mut edges) = (merge.refused, merge.next, merge.edges);
        if refused {
            allowance.lower_bytes(&nodes, &next, edges.len());
        }
        let keep = allowance.kept_nodes(&next, choices.len(), stop, stages.len() - done);
        ways = carry_ways(&ways, &edges, choices.len(), next.len());
        ways = cut_down(&mut next, &mut edges, ways, keep);
        if let Omitted::Outside(known) = &mut omitted {
            known.advance(&edges, next.len());
        }
        allowance.take_layer(next.len(), edges.len());
        layers.push(Layer {
            variable: stage.variable,
            nodes: nodes.len(),
            choices: choices.len(),
            edges,
        });
        nodes = next;
    }
    let terminals = nodes.spent.iter().map(Spent::redundancy).collect();
    Diagram {
        stop,
        ..Diagram::from_layers(layers, terminals)
    }
}

/// The nodes of a layer that get children.
pub(super) struct Expanded<'a> {
    pub(super) nodes: &'a Nodes,
    pub(super) choices: &'a [Choice],
    /// Whether the child over an edge is wanted.
    pub(super) wanted: &'a dyn Fn(usize) -> bool,
    /// Bytes of which children that are not merged yet may take an eighth.
    pub(super) bytes: usize,
}

/// Returns the merged children of a layer's nodes, without those for which `out` returns true. `out` receives the redundancy spent, the
/// dimension that the choices add in the open contours, and the least cost of a path to the child. The progress is that of
/// this layer alone.
pub(super) fn next_layer(
    stage: &Stage<'_>,
    from: &Expanded<'_>,
    mut merge: Merge,
    mut out: impl FnMut(&Spent, usize, i64) -> bool,
    control: Control<'_>,
) -> Merge {
    let (nodes, choices) = (from.nodes, from.choices);
    let kinds = stage.kinds().zip(&nodes.spaces);
    let mut steps: Vec<Steps<'_>> = kinds
        .map(|((_, columns), spaces)| Steps::new(stage.field, columns, spaces))
        .collect();
    // A child is about as large as its parent. No more of them are made at a time than stay in use from batch to batch.
    let each = nodes.held_bytes() / nodes.len().max(1);
    let size = (CHILDREN.min(from.bytes / 8) / (each * choices.len()).max(1))
        .min(BATCH / (stage.child_effort(each) * choices.len()).max(1))
        .clamp(CUT, MOST);
    let mut numbers = Vec::with_capacity(steps.len());
    let edges = nodes.len() * choices.len();
    for batch in (0..edges).step_by(size * choices.len().max(1)) {
        let batch = batch..(batch + size * choices.len()).min(edges);
        for child in from.expand_nodes(stage, &mut steps, &mut merge, batch.clone()) {
            let (node, choice) = (child.node, child.choice);
            let least = nodes.least[node] + choices[choice].cost_milli;
            let own = nodes.numbers(node);
            let dimension = steps[0].step(own[0], choice).map_or(0, Step::dimension);
            if out(&child.spent, dimension, least) {
                continue;
            }
            numbers.clear();
            for (kind, (lane, _)) in stage.kinds().enumerate() {
                let step = steps[kind].step(own[kind], choice);
                let step = step.filter(|_| !child.spent.is_ruled_out(lane));
                numbers.push(step.map_or(NONE, |step| step.to));
            }
            merge.edges.resize(node * choices.len() + choice, DEAD);
            merge.push_edge(child.spent, &numbers, least);
        }
        merge.edges.resize(batch.end, DEAD);
        if (control.cancelled)() {
            merge.interrupt_merge(edges);
        }
        (control.progress)(Progress {
            done: 0,
            of: 1,
            nodes: merge.next.len(),
            layer: merge.next.len(),
        });
        if merge.edges.len() == edges {
            break;
        }
    }
    merge.finish()
}

/// Bytes of children that are not merged yet: of more the system takes back the memory, and clears it again for the next batch.
const CHILDREN: usize = 1 << 23;
/// Nodes expanded at most before their children are merged.
const MOST: usize = 1 << 14;
/// Maximum number of field operations between two checks for cancellation: less than a tenth of a second.
const BATCH: usize = 1 << 25;

/// The child of a node by a choice, before equal children are merged.
struct Child {
    node: usize,
    choice: usize,
    spent: Spent,
}

impl Expanded<'_> {
    /// Returns the children over some edges, without those that no variant needs. Takes the steps that they need.
    fn expand_nodes(
        &self,
        stage: &Stage<'_>,
        steps: &mut [Steps<'_>],
        merge: &mut Merge,
        edges: Range<usize>,
    ) -> Vec<Child> {
        let choices = self.choices.len();
        let mut children = Vec::with_capacity(edges.len());
        children.extend(edges.filter(|&edge| (self.wanted)(edge)).map(|edge| Child {
            node: edge / choices,
            choice: edge % choices,
            spent: self.nodes.spent[edge / choices].clone(),
        }));
        let mut kind = 0;
        for (number, lane) in stage.lanes.iter().enumerate() {
            for child in children
                .iter_mut()
                .filter(|c| !c.spent.is_ruled_out(number))
            {
                if lane.applies.get(child.choice) == Some(&false) {
                    child.spent.rule_out(number);
                } else {
                    steps[kind].want_step(self.nodes.numbers(child.node)[kind], child.choice);
                }
            }
            merge.take_steps(kind, &mut steps[kind]);
            let keeps = lane.harmless.is_some();
            children.retain_mut(|child| {
                if child.spent.is_ruled_out(number) {
                    return true;
                }
                let from = self.nodes.numbers(child.node);
                let Some(step) = steps[kind].step(from[kind], child.choice) else {
                    return false;
                };
                // A row that starts in the gap is a motion that the contours forbid; directions of the gap that no row has are redundant.
                let missed = lane.all.closing - step.closed();
                child
                    .spent
                    .add_redundant(number, u32::try_from(missed).unwrap_or(u32::MAX));
                let alive = child.spent.is_within(stage.limits);
                if alive && keeps {
                    steps[kind + 1].want_step(from[kind + 1], child.choice);
                }
                alive
            });
            kind += 1;
            if !keeps {
                continue;
            }
            merge.take_steps(kind, &mut steps[kind]);
            children.retain_mut(|child| {
                if child.spent.is_ruled_out(number) {
                    return true;
                }
                let from = self.nodes.numbers(child.node);
                let gained = |kind: usize| steps[kind].gained_dimensions(from[kind], child.choice);
                if gained(kind).is_some_and(|harmless| Some(harmless) <= gained(kind - 1)) {
                    return true;
                }
                let held = matches!(lane.role, Role::Held(_));
                if held {
                    child.spent.rule_out(number);
                }
                held
            });
            kind += 1;
        }
        if let Some(roles) = &stage.ending {
            children.retain_mut(|Child { spent, .. }| {
                let holds = spent.holds_all(roles);
                spent.settle_counts(roles, stage.limits);
                holds && spent.state_within(stage.limits)
            });
        }
        children
    }
}
