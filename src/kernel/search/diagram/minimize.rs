//! The smallest diagram with the same variants: nodes that lead on in the same way are one.
//!
//! # Sources
//! Bryant, "Graph-based algorithms for Boolean function manipulation", IEEE Trans. Comput. C-35 (1986), section 4.2.

use crate::search::diagram::redundancy_so_far::Redundancy;
use crate::search::diagram::{DEAD, Diagram, Layer};
use hashbrown::HashMap;
use hashbrown::hash_map::Entry;

/// Creates the minimal whole diagram from such layers and terminals. Numbers its nodes breadth first from the root.
///
/// # Complexity
/// O(edges).
pub(in crate::search) fn minimize_diagram(
    mut layers: Vec<Layer>,
    mut terminals: Vec<Redundancy>,
) -> Diagram {
    // From the end: what each node of the layer below is there now.
    let mut known: HashMap<Redundancy, u32> = HashMap::new();
    let mut different = Vec::new();
    let mut named: Vec<u32> = Vec::new();
    for r in terminals {
        let number = node_index(different.len());
        named.push(*known.entry(r).or_insert_with(|| {
            different.push(r);
            number
        }));
    }
    terminals = different;
    for (i, layer) in layers.iter_mut().enumerate().rev() {
        let edges = layer.edges.iter_mut().filter(|e| **e != DEAD);
        edges.for_each(|e| *e = named[*e as usize]);
        let rows = std::mem::take(&mut layer.edges);
        let mut known: HashMap<&[u32], u32> = HashMap::new();
        named = Vec::with_capacity(layer.nodes);
        for row in rows.chunks_exact(layer.choices) {
            if i > 0 && row.iter().all(|&e| e == DEAD) {
                named.push(DEAD);
                continue;
            }
            named.push(match known.entry(row) {
                Entry::Occupied(o) => *o.get(),
                Entry::Vacant(v) => {
                    layer.edges.extend_from_slice(row);
                    *v.insert(node_index(layer.edges.len() / layer.choices - 1))
                }
            });
        }
        layer.nodes = layer.edges.len() / layer.choices;
    }
    number_from_the_root(&mut layers, &mut terminals);
    Diagram::from_layers(layers, terminals)
}

/// Renumbers the nodes in the order in which they are reached, and removes the unreachable ones.
fn number_from_the_root(layers: &mut [Layer], terminals: &mut Vec<Redundancy>) {
    let mut met: Vec<u32> = vec![0];
    for layer in layers {
        let mut names: HashMap<u32, u32> = HashMap::new();
        let mut below = Vec::new();
        let mut edges = Vec::with_capacity(met.len() * layer.choices);
        for &node in &met {
            let start = node as usize * layer.choices;
            for &e in &layer.edges[start..start + layer.choices] {
                edges.push(match e {
                    DEAD => DEAD,
                    e => *names.entry(e).or_insert_with(|| {
                        below.push(e);
                        node_index(below.len() - 1)
                    }),
                });
            }
        }
        (layer.nodes, layer.edges) = (met.len(), edges);
        met = below;
    }
    *terminals = met.iter().map(|&i| terminals[i as usize]).collect();
}

fn node_index(i: usize) -> u32 {
    u32::try_from(i).expect("no more nodes than edges can name")
}
