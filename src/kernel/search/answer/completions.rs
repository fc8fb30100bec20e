//! The edges that lead from a node of a diagram to variants with a given key, looked up once and kept.

use crate::search::answer::count::Count;
use crate::search::answer::count_tables::Tally;
use crate::search::answer::keys::{Key, Steps};
use crate::search::diagram::{DEAD, Diagram};
use hashbrown::HashMap;

/// Where the steps from a node lie: the first, and one past the last.
pub(in crate::search) type Span = (u32, u32);

/// A choice that variants take, and where it leads.
#[derive(Debug, Clone, Copy)]
pub(in crate::search) struct Step {
    pub(in crate::search) choice: u32,
    pub(in crate::search) node: u32,
    /// What is left of the key there.
    pub(in crate::search) rest: Key,
    /// The steps that follow, once they are known.
    pub(in crate::search) then: Option<Span>,
}

/// The steps from nodes that were come to.
#[derive(Debug)]
pub(in crate::search) struct Ways {
    pub(in crate::search) steps: Vec<Step>,
    /// Where those of a node lie, by layer, node and what is left of the key.
    at: HashMap<(u32, u32, Key), Span>,
    /// Steps that are too many.
    pub(in crate::search) room: usize,
}

/// Steps that there is always room for: those of the longest way down, and a few megabytes.
const LEAST: usize = 1 << 17;

impl Ways {
    /// None yet, and no more than about some bytes of them.
    pub(in crate::search) fn within(bytes: usize) -> Ways {
        let one = size_of::<Step>() + 2 * size_of::<((u32, u32, Key), Span)>();
        Ways {
            steps: Vec::new(),
            at: HashMap::new(),
            room: (bytes / one).clamp(LEAST, u32::MAX as usize / 2),
        }
    }

    pub(in crate::search) fn is_full(&self) -> bool {
        self.steps.len() >= self.room
    }

    pub(in crate::search) fn clear(&mut self) {
        self.steps.clear();
        self.at.clear();
    }

    /// The steps from a node of a layer that variants with the rest of the key take; none from a terminal.
    ///
    /// # Complexity
    /// A look-up; the first time one in the tally for each choice.
    pub(in crate::search) fn from<C: Count>(
        &mut self,
        diagram: &Diagram,
        steps: &Steps,
        tally: &Tally<C>,
        layer: usize,
        node: u32,
        rest: Key,
    ) -> Span {
        let name = (index(layer), node, rest);
        if let Some(&known) = self.at.get(&name) {
            return known;
        }
        let Some(here) = diagram.layers.get(layer) else {
            return (0, 0);
        };
        let first = index(self.steps.len());
        let edges = &here.edges[node as usize * here.choices..][..here.choices];
        for (choice, &to) in edges.iter().enumerate().filter(|(_, to)| **to != DEAD) {
            let key = steps.keys[here.variable][choice];
            let Some(rest) = rest.0.checked_sub(key.0).map(Key) else {
                continue;
            };
            let table = &tally.tables[layer + 1][to as usize];
            if table.binary_search_by_key(&rest, |(k, _)| *k).is_ok() {
                self.steps.push(Step {
                    choice: index(choice),
                    node: to,
                    rest,
                    then: None,
                });
            }
        }
        let found = (first, index(self.steps.len()));
        self.at.insert(name, found);
        found
    }
}

/// Layers, nodes and steps are fewer than 2^32.
fn index(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
