//! How many nodes and bytes a diagram may still take while it is built, and which nodes it keeps where they are too many.

use crate::search::diagram::layer::{CUT, DEAD, Merge, Nodes, Stop};
use crate::search::diagram::redundancy_so_far::Limits;

/// The budget of a diagram, and what it has used.
pub(in crate::search) struct Allowance<'a> {
    limits: &'a Limits,
    /// Bytes allowed: less than the limits say where the system refused that many.
    pub(in crate::search) bytes: usize,
    /// Nodes so far.
    pub(in crate::search) nodes: usize,
    /// Bytes of the edges so far.
    edges: usize,
}

impl<'a> Allowance<'a> {
    /// Returns the budget of a diagram with its root.
    pub(in crate::search) fn new(limits: &'a Limits) -> Self {
        Allowance {
            limits,
            bytes: limits.bytes,
            nodes: 1,
            edges: 0,
        }
    }

    /// Returns the number of nodes left.
    fn left_nodes(&self) -> usize {
        self.limits.nodes.saturating_sub(self.nodes)
    }

    /// Returns the minimum number of nodes that a layer keeps.
    fn least_kept(&self) -> usize {
        CUT.min(self.limits.nodes)
    }

    /// Returns an empty layer after some nodes, for about `edges` edges.
    pub(in crate::search) fn begin_layer(&self, nodes: &Nodes, edges: usize, stop: Stop) -> Merge {
        let room = self
            .left_nodes()
            .min(self.limits.layer)
            .max(self.least_kept());
        let bytes = self.bytes.saturating_sub(self.edges + nodes.held_bytes());
        Merge::new((room, bytes), stop, edges, nodes.spaces.len())
    }

    /// Lowers the limit to half of what is in use, after the system refused memory for a layer.
    pub(in crate::search) fn lower_bytes(&mut self, nodes: &Nodes, next: &Nodes, edges: usize) {
        let now = self.edges + nodes.held_bytes() + next.held_bytes() + size_of::<u32>() * edges;
        self.bytes = self.bytes.min(now / 2);
    }

    /// Returns the number of nodes of a layer that are kept, if `layers` layers are to come, this one included.
    pub(in crate::search) fn kept_nodes(
        &self,
        next: &Nodes,
        choices: usize,
        stop: Stop,
        layers: usize,
    ) -> usize {
        match stop {
            Stop::Exhausted => usize::MAX,
            // It is wanted whole or not at all.
            Stop::NodeBudget | Stop::Memory if self.limits.layer < usize::MAX => self.least_kept(),
            // Share what is left of the budget among the layers to come.
            Stop::NodeBudget | Stop::NotCounted => {
                (self.left_nodes() / layers).max(self.least_kept())
            }
            Stop::Memory => {
                let each = next.held_bytes() / next.len().max(1) + size_of::<u32>() * choices;
                let left = self.bytes.saturating_sub(self.edges) / layers;
                (left / each).max(CUT)
            }
            Stop::Interrupted => CUT,
        }
    }

    /// Adds a layer of some nodes and edges to what was used.
    pub(in crate::search) fn take_layer(&mut self, nodes: usize, edges: usize) {
        self.nodes += nodes;
        self.edges += size_of::<u32>() * edges;
    }
}

/// Returns the number of paths to each of the next nodes, from the number to each of these nodes.
pub(in crate::search) fn carry_ways(
    ways: &[f64],
    edges: &[u32],
    choices: usize,
    next: usize,
) -> Vec<f64> {
    let mut out = vec![0.0; next];
    for (edges, n) in edges.chunks(choices.max(1)).zip(ways) {
        for &to in edges.iter().filter(|to| **to != DEAD) {
            out[to as usize] += n;
        }
    }
    out
}

/// Reduces a layer to `keep` nodes. Returns the number of paths to each kept node.
pub(in crate::search) fn cut_down(
    next: &mut Nodes,
    edges: &mut [u32],
    ways: Vec<f64>,
    keep: usize,
) -> Vec<f64> {
    if next.len() <= keep {
        return ways;
    }
    let kept = worth_keeping(next, &ways, keep);
    retain_nodes(next, &kept, edges);
    kept.iter().map(|&i| ways[i]).collect()
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
fn retain_nodes(nodes: &mut Nodes, kept: &[usize], edges: &mut [u32]) {
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
