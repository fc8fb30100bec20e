//! The diagram of two parts that no choice ties together, from those of the parts.
//!
//! What a choice does in one part does not depend on the other, so a node of the whole is a node of each, and what is redundant
//! adds up.

use crate::search::diagram::minimize::minimal;
use crate::search::diagram::redundancy_so_far::{Limits, Redundancy};
use crate::search::diagram::{DEAD, Diagram, Layer};
use hashbrown::HashMap;
use hashbrown::hash_map::Entry;

/// The product of two whole diagrams over the same variables in the same order, the smallest there is; none where it takes more
/// nodes than allowed before it is made that.
///
/// # Complexity
/// O(edges of the product).
pub(in crate::search) fn product(parts: [&Diagram; 2], limits: &Limits) -> Option<Diagram> {
    let [a, b] = parts;
    let mut nodes: Vec<[u32; 2]> = vec![[0, 0]];
    let mut total = 1;
    let mut layers = Vec::with_capacity(a.layers.len());
    for (one, two) in a.layers.iter().zip(&b.layers) {
        debug_assert_eq!((one.variable, one.choices), (two.variable, two.choices));
        let choices = one.choices;
        let mut known: HashMap<[u32; 2], u32> = HashMap::new();
        let mut next = Vec::new();
        let mut edges = Vec::with_capacity(nodes.len() * choices);
        for [x, y] in &nodes {
            let row = |layer: &Layer, node: u32| {
                let start = node as usize * choices;
                start..(start + choices).min(layer.edges.len())
            };
            let ways = one.edges[row(one, *x)].iter().zip(&two.edges[row(two, *y)]);
            for (&x, &y) in ways {
                if x == DEAD || y == DEAD {
                    edges.push(DEAD);
                    continue;
                }
                let number = u32::try_from(next.len()).ok().filter(|n| *n != DEAD)?;
                edges.push(match known.entry([x, y]) {
                    Entry::Occupied(o) => *o.get(),
                    Entry::Vacant(v) => {
                        next.push([x, y]);
                        *v.insert(number)
                    }
                });
            }
        }
        total += next.len();
        if total > limits.nodes || size_of::<u32>() * total * choices > limits.bytes {
            return None;
        }
        layers.push(Layer {
            variable: one.variable,
            nodes: nodes.len(),
            choices,
            edges,
        });
        nodes = next;
    }
    let together = |[x, y]: &[u32; 2]| together(a.terminals[*x as usize], b.terminals[*y as usize]);
    let terminals: Vec<Redundancy> = nodes.iter().map(together).collect();
    // Each part keeps to the limit by itself; together they may not.
    if let Some(last) = layers.last_mut() {
        let within = |e: u32| e != DEAD && terminals[e as usize].internal <= limits.internal;
        last.edges
            .iter_mut()
            .filter(|e| !within(**e))
            .for_each(|e| *e = DEAD);
    }
    Some(minimal(layers, terminals))
}

/// What is redundant in two parts.
fn together(x: Redundancy, y: Redundancy) -> Redundancy {
    Redundancy {
        internal: x.internal + y.internal,
        external: x.external + y.external,
        harmful: x.harmful + y.harmful,
    }
}
