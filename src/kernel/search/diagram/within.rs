//! A diagram that is built within a known one, which has all of its variants and others.
//!
//! Each node has a path that leads to it. The nodes of the known diagram at the end of the same path are stored with it. A choice that
//! leads nowhere from there has no completion, whatever other paths lead to the node.

use crate::search::diagram::layer::{DEAD, Layer};
use crate::search::diagram::node_sets::{Set, add_node, collect_set, empty_set, nodes_in};

/// The nodes of a known diagram that correspond to the nodes of a layer. It is followed from its first layer or from its last.
pub(in crate::search) struct Within<'a> {
    layers: &'a [Layer],
    ends: usize,
    forward: bool,
    /// The nodes of the known diagram for each node of the layer.
    pub(in crate::search) at: Vec<Set>,
    /// For each node of the known diagram and each choice, the nodes that it leads to.
    steps: Vec<Vec<usize>>,
    choices: usize,
}

impl<'a> Within<'a> {
    /// Follows layers of a known diagram that begin at one node and end at one of `ends` nodes. From the end there must be one of these.
    pub(in crate::search) fn new(layers: &'a [Layer], ends: usize, forward: bool) -> Self {
        let mut out = Within {
            layers,
            ends,
            forward,
            at: vec![collect_set(1, |_| true)],
            steps: Vec::new(),
            choices: 1,
        };
        out.collect_steps();
        out
    }

    /// Collects the steps over the layer that comes next.
    fn collect_steps(&mut self) {
        let next = if self.forward {
            self.layers.first()
        } else {
            self.layers.last()
        };
        let Some(layer) = next else { return };
        self.choices = layer.choices;
        self.steps = layer.list_steps(self.ends, self.forward);
    }

    /// Returns the nodes of the known diagram that an edge of the layer leads to.
    fn follow_edge(&self, edge: usize) -> impl Iterator<Item = usize> {
        let choice = edge % self.choices;
        let from = nodes_in(&self.at[edge / self.choices]);
        from.flat_map(move |node| &self.steps[node * self.choices + choice])
            .copied()
    }

    /// Returns true if an edge of the layer may have a completion.
    pub(in crate::search) fn has_edge(&self, edge: usize) -> bool {
        self.follow_edge(edge).next().is_some()
    }

    /// Advances to the next layer along the edges to its nodes.
    pub(in crate::search) fn advance(&mut self, edges: &[u32], nodes: usize) {
        let (layers, ends) = match (self.forward, self.layers) {
            (true, [_, rest @ ..]) => (rest, self.ends),
            (false, [rest @ .., last]) => (rest, last.nodes),
            (_, []) => return,
        };
        let width = if self.forward {
            layers.first().map_or(ends, |l| l.nodes)
        } else {
            ends
        };
        let mut at = vec![empty_set(0); nodes];
        for (edge, &to) in edges.iter().enumerate().filter(|(_, to)| **to != DEAD) {
            let reached = &mut at[to as usize];
            if reached.is_empty() {
                *reached = empty_set(width);
                self.follow_edge(edge)
                    .for_each(|node| add_node(reached, node));
            }
        }
        (self.layers, self.ends, self.at) = (layers, ends, at);
        self.collect_steps();
    }
}
