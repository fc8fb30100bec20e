//! How many nodes and bytes a diagram may still take while it is built.

use crate::search::diagram::layer::{CUT, Merge, Nodes, Stop};
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
        Merge::new(room, bytes, stop, edges)
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
