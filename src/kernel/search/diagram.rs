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
pub(in crate::search) mod transition;
pub(in crate::search) mod within;

use crate::linalg::modp::Residue;
use crate::search::diagram::allowance::Allowance;
use crate::search::diagram::completion::Ceiling;
use crate::search::diagram::layer::{CUT, Merge, Nodes};
pub use crate::search::diagram::layer::{DEAD, Layer, Stop};
use crate::search::diagram::redundancy_so_far::{Limits, Redundancy, Spent};
use crate::search::diagram::transition::{Children, Worker};
use crate::search::diagram::within::Within;
use crate::search::question::space::{Choice, Space};
use rayon::prelude::*;

/// Building progress, for whoever shows it.
#[derive(Debug, Clone, Copy)]
pub struct Progress {
    /// Variables done.
    pub done: usize,
    /// Variables in all.
    pub of: usize,
    /// Nodes so far.
    pub nodes: usize,
    /// Nodes of the present layer.
    pub layer: usize,
}

impl Progress {
    /// Creates the progress in a layer after `done` of `of` variables, with `before` nodes before it and `layer` nodes in
    /// it.
    pub(in crate::search) fn in_layer(
        done: usize,
        of: usize,
        before: usize,
        layer: usize,
    ) -> Progress {
        Progress {
            done,
            of,
            nodes: before + layer,
            layer,
        }
    }
}

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
/// `cancelled` is called between batches of nodes. Once it returns true, the remaining layers are cut to a few nodes, so
/// that the paths found so far can still be completed. The result does not depend on the number of threads. Children are
/// computed in parallel and merged in order.
///
/// # Complexity
/// O(nodes · choices · d²w) field operations for matrices of d rows and w columns. Memory is the edges of all layers and the
/// matrices of two, both bounded by `limits.nodes` and `limits.bytes`.
pub(super) fn build_layers(
    space: &Space,
    stages: &[impl Carries],
    limits: &Limits,
    root: Spent,
    mut omitted: Omitted<'_, '_>,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let mut nodes = Nodes::root_node(root);
    let mut ways = vec![1.0];
    let mut layers = Vec::with_capacity(stages.len());
    let (mut largest, mut stop) = (1, Stop::Exhausted);
    let mut allowance = Allowance::new(limits);
    for (done, stage) in stages.iter().enumerate() {
        let choices = &space.variables[stage.variable()].choices;
        let total = allowance.nodes;
        let (known, mut ceiling) = match &mut omitted {
            Omitted::Nothing => (None, None),
            Omitted::Above(ceiling) => (None, Some(ceiling)),
            Omitted::Outside(known) => (Some(&*known), None),
        };
        let from = Expanded {
            nodes: &nodes,
            choices,
            known,
            bytes: allowance.bytes,
        };
        let merge = next_layer(
            stage,
            &from,
            allowance.begin_layer(&nodes, nodes.len() * choices.len(), stop),
            |spent, matrix, least| {
                let ceiling = ceiling.as_mut();
                ceiling.is_some_and(|c| c.is_above(done + 1, spent, matrix, least))
            },
            cancelled,
            &mut |layer| progress(Progress::in_layer(done, stages.len(), total, layer)),
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
        largest = largest.max(next.len());
        allowance.take_layer(next.len(), edges.len());
        layers.push(Layer {
            variable: stage.variable(),
            nodes: nodes.len(),
            choices: choices.len(),
            edges,
        });
        nodes = next;
    }
    Diagram {
        layers,
        terminals: nodes.spent.iter().map(Spent::redundancy).collect(),
        stop,
        nodes: allowance.nodes,
        largest_layer: largest,
    }
}

/// Returns the number of paths to each of the next nodes, from the number to each of these nodes.
fn carry_ways(ways: &[f64], edges: &[u32], choices: usize, next: usize) -> Vec<f64> {
    let mut out = vec![0.0; next];
    for (edges, n) in edges.chunks(choices.max(1)).zip(ways) {
        for &to in edges.iter().filter(|to| **to != DEAD) {
            out[to as usize] += n;
        }
    }
    out
}

/// Reduces a layer to `keep` nodes. Returns the number of paths to each kept node.
fn cut_down(next: &mut Nodes, edges: &mut [u32], ways: Vec<f64>, keep: usize) -> Vec<f64> {
    if next.len() <= keep {
        return ways;
    }
    let kept = worth_keeping(next, &ways, keep);
    retain_nodes(next, &kept, edges);
    kept.iter().map(|&i| ways[i]).collect()
}

/// A stage: it computes the children of nodes at a variable.
pub(super) trait Carries: Sync {
    /// Returns the index of the variable in the space.
    fn variable(&self) -> usize;
    /// Returns scratch space for a thread.
    fn make_worker(&self) -> Worker;
    /// Estimates the field operations for a child of a node of `bytes` bytes.
    fn child_effort(&self, bytes: usize) -> usize;
    /// Takes all children of a node, in order of choices.
    fn push_children(
        &self,
        worker: &mut Worker,
        matrix: &[Residue],
        spent: &Spent,
        out: &mut Children,
    );
}

/// The nodes of a layer that get children.
pub(super) struct Expanded<'a> {
    pub(super) nodes: &'a Nodes,
    pub(super) choices: &'a [Choice],
    /// A diagram outside of which no children are wanted.
    pub(super) known: Option<&'a Within<'a>>,
    /// Bytes of which children that are not merged yet may take an eighth.
    pub(super) bytes: usize,
}

/// Returns the merged children of a layer's nodes, without those that are `out` of the question. `told` receives the number of children so
/// far.
pub(super) fn next_layer(
    carries: &impl Carries,
    from: &Expanded<'_>,
    mut merge: Merge,
    mut out: impl FnMut(&Spent, &[Residue], i64) -> bool,
    cancelled: &(dyn Fn() -> bool + Sync),
    told: &mut dyn FnMut(usize),
) -> Merge {
    let (nodes, choices) = (from.nodes, from.choices);
    // A child is about as large as its parent. No more of them are made at a time than stay in use from batch to batch.
    let each = nodes.held_bytes() / nodes.len().max(1);
    let size = (CHILDREN.min(from.bytes / 8) / (each * choices.len()).max(1))
        .min(BATCH / (carries.child_effort(each) * choices.len()).max(1))
        .clamp(CUT, MOST);
    for batch in (0..nodes.len()).step_by(size) {
        let batch = batch..(batch + size).min(nodes.len());
        for part in from.expand_nodes(carries, batch) {
            merge.take_children(&part, nodes, |choice| choices[choice].cost_milli, &mut out);
        }
        if cancelled() {
            merge.interrupt_merge(nodes.len() * choices.len());
        }
        told(merge.next.len());
        if merge.edges.len() == nodes.len() * choices.len() {
            break;
        }
    }
    merge
}

/// Bytes of children that are not merged yet: of more the system takes back the memory, and clears it again for the next batch.
const CHILDREN: usize = 1 << 23;
/// Nodes expanded at most before their children are merged.
const MOST: usize = 1 << 14;
/// Maximum number of field operations between two checks for cancellation: less than a tenth of a second.
const BATCH: usize = 1 << 25;

/// Fewer children than this are not worth waking threads for.
const PARALLEL: usize = 1024;

impl Expanded<'_> {
    /// Returns the children of some nodes, in parallel, in order.
    fn expand_nodes(&self, carries: &impl Carries, range: std::ops::Range<usize>) -> Vec<Children> {
        let choices = self.choices.len();
        let some = |range: std::ops::Range<usize>| {
            let mut worker = carries.make_worker();
            let mut out = Children::new(choices);
            for i in range {
                if let Some(known) = self.known {
                    let edges = i * choices..(i + 1) * choices;
                    worker.restrict_choices(edges.map(|edge| known.has_edge(edge)));
                }
                let (matrix, spent) = (self.nodes.matrix(i), &self.nodes.spent[i]);
                carries.push_children(&mut worker, matrix, spent, &mut out);
            }
            out
        };
        if range.len() * choices < PARALLEL {
            return vec![some(range)];
        }
        let chunk = range
            .len()
            .div_ceil(rayon::current_num_threads() * 4)
            .max(16);
        let starts: Vec<usize> = range.clone().step_by(chunk).collect();
        starts
            .into_par_iter()
            .map(|s| some(s..(s + chunk).min(range.end)))
            .collect()
    }
}

/// Returns the nodes to keep in a layer that exceeds its limit, ascending. Half of them are reached by most paths, for the
/// counts. The others are the cheapest, for the list. The first one found wins among equals.
fn worth_keeping(nodes: &Nodes, ways: &[f64], keep: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_by(|&a, &b| ways[b].total_cmp(&ways[a]).then(a.cmp(&b)));
    let (kept, others) = order.split_at_mut(keep / 2);
    others.sort_by_key(|&i| (nodes.least[i], i));
    let cheapest = others.iter().take(keep - kept.len());
    let mut out: Vec<usize> = kept.iter().chain(cheapest).copied().collect();
    out.sort_unstable();
    out
}

/// Keeps the nodes listed, ascending, and renames the edges that lead to them.
pub(super) fn retain_nodes(nodes: &mut Nodes, kept: &[usize], edges: &mut [u32]) {
    let mut renamed = vec![DEAD; nodes.len()];
    for (to, &from) in kept.iter().enumerate() {
        renamed[from] = u32::try_from(to).expect("fewer than before");
    }
    nodes.retain(kept);
    edges
        .iter_mut()
        .filter(|e| **e != DEAD)
        .for_each(|e| *e = renamed[*e as usize]);
}
