//! A layer of the diagram. While it is built, equal children become one node.

use crate::linalg::modp::Residue;
use crate::search::diagram::redundancy_so_far::Spent;
use crate::search::diagram::transition::Children;
use hashbrown::HashTable;
use std::collections::TryReserveError;

/// A missing edge: the choice leads nowhere admissible.
pub const DEAD: u32 = u32::MAX;

/// Edges of one layer: `edges[node * choices + choice]`, an index into the next layer or [`DEAD`].
#[derive(Debug, Clone)]
pub struct Layer {
    /// Index of the variable in the space.
    pub variable: usize,
    /// Number of nodes.
    pub nodes: usize,
    /// Number of choices.
    pub choices: usize,
    /// The edges.
    pub edges: Vec<u32>,
}

impl Layer {
    /// Returns for each node, and each choice, the next nodes; from the `next` next nodes back if not `forward`.
    pub(in crate::search) fn list_steps(&self, next: usize, forward: bool) -> Vec<Vec<usize>> {
        let from = if forward { self.nodes } else { next };
        let mut steps = vec![Vec::new(); from * self.choices];
        for (edge, &to) in self.edges.iter().enumerate().filter(|(_, to)| **to != DEAD) {
            let (mut ends, choice) = ([edge / self.choices, to as usize], edge % self.choices);
            if !forward {
                ends.reverse();
            }
            steps[ends[0] * self.choices + choice].push(ends[1]);
        }
        steps
    }
}

/// Nodes a layer keeps at least where the budget is no smaller, so that a search reaches the end.
pub(in crate::search) const CUT: usize = 256;

/// Bytes of a node besides its matrix: what was spent, where the matrix starts, the least cost, and its place in the table.
const NODE: usize = size_of::<Spent>() + 3 * size_of::<u64>() + 2 * size_of::<(u64, u32)>();

/// The nodes of a layer while it is being built.
pub(in crate::search) struct Nodes {
    /// Redundancy so far.
    pub(in crate::search) spent: Vec<Spent>,
    /// Start of each node's matrix in `data`; one more at the end.
    start: Vec<usize>,
    data: Vec<Residue>,
    /// Least cost of a way to the node.
    pub(in crate::search) least: Vec<i64>,
}

impl Nodes {
    /// Returns the one node before any choice.
    pub(in crate::search) fn root_node(spent: Spent) -> Self {
        Nodes {
            spent: vec![spent],
            start: vec![0, 0],
            data: Vec::new(),
            least: vec![0],
        }
    }

    pub(in crate::search) fn empty() -> Self {
        Nodes {
            spent: Vec::new(),
            start: vec![0],
            data: Vec::new(),
            least: Vec::new(),
        }
    }

    pub(in crate::search) fn len(&self) -> usize {
        self.spent.len()
    }

    /// Returns the bytes of the nodes, with the table that finds them during construction.
    pub(in crate::search) fn held_bytes(&self) -> usize {
        size_of::<Residue>() * self.data.len() + NODE * self.len()
    }

    pub(in crate::search) fn matrix(&self, i: usize) -> &[Residue] {
        &self.data[self.start[i]..self.start[i + 1]]
    }

    /// Makes room for a node whose matrix has so many numbers.
    fn reserve_node(&mut self, numbers: usize) -> Result<(), TryReserveError> {
        self.spent.try_reserve(1)?;
        self.start.try_reserve(1)?;
        self.least.try_reserve(1)?;
        self.data.try_reserve(numbers)
    }

    /// Keeps the nodes listed, ascending, within the memory that they have.
    pub(in crate::search) fn retain(&mut self, kept: &[usize]) {
        let mut end = 0;
        for (to, &from) in kept.iter().enumerate() {
            let matrix = self.start[from]..self.start[from + 1];
            self.spent.swap(to, from);
            self.least[to] = self.least[from];
            self.start[to] = end;
            end += matrix.len();
            self.data.copy_within(matrix.clone(), end - matrix.len());
        }
        self.spent.truncate(kept.len());
        self.least.truncate(kept.len());
        self.start.truncate(kept.len());
        self.start.push(end);
        self.data.truncate(end);
    }

    pub(in crate::search) fn push(&mut self, spent: Spent, matrix: &[Residue], least: i64) {
        self.spent.push(spent);
        self.data.extend_from_slice(matrix);
        self.start.push(self.data.len());
        self.least.push(least);
    }
}

/// A layer while it is built.
pub(in crate::search) struct Merge {
    /// New nodes allowed.
    room: usize,
    /// Bytes that they and the edges may take.
    bytes: usize,
    pub(in crate::search) stop: Stop,
    /// Whether the system had no more memory, however much is allowed.
    pub(in crate::search) refused: bool,
    table: HashTable<(u64, u32)>,
    pub(in crate::search) next: Nodes,
    pub(in crate::search) edges: Vec<u32>,
}

impl Merge {
    /// Returns an empty layer with limits on nodes and bytes, for about `edges` edges.
    pub(in crate::search) fn new(room: usize, bytes: usize, stop: Stop, edges: usize) -> Self {
        Merge {
            room,
            bytes,
            stop,
            refused: false,
            table: HashTable::new(),
            next: Nodes::empty(),
            edges: Vec::with_capacity(edges),
        }
    }

    /// Restricts the layer to few nodes. If it already has that many, all other edges lead nowhere.
    pub(in crate::search) fn interrupt_merge(&mut self, edges: usize) {
        self.stop = Stop::Interrupted;
        self.room = self.room.min(CUT);
        if self.next.len() >= CUT {
            self.edges.resize(edges, DEAD);
        }
    }

    /// Adds the children of some nodes, after those of the nodes before them. Skips children that are excluded by a test of
    /// three values: the redundancy spent, the child's matrix, and the least cost of this path to it.
    pub(in crate::search) fn take_children(
        &mut self,
        part: &Children,
        parents: &Nodes,
        cost: impl Fn(usize) -> i64,
        mut out: impl FnMut(&Spent, &[Residue], i64) -> bool,
    ) {
        let choices = part.choices;
        if part.short {
            self.refused = true;
            self.stop = self.stop.combine_with(Stop::Memory);
        }
        for child in &part.found {
            let Some((hash, ref spent, start, end)) = *child else {
                self.edges.push(DEAD);
                continue;
            };
            let matrix = &part.data[start..end];
            let at = self.edges.len();
            let parent = at / choices;
            let least = parents.least[parent] + cost(at % choices);
            if out(spent, matrix, least) {
                self.edges.push(DEAD);
                continue;
            }
            let next = &mut self.next;
            let refused = next.reserve_node(matrix.len()).is_err()
                || self.table.try_reserve(1, |&(h, _)| h).is_err();
            self.refused |= refused;
            let same = |&(h, i): &(u64, u32)| {
                h == hash && next.spent[i as usize] == *spent && next.matrix(i as usize) == matrix
            };
            let index = match self.table.entry(hash, same, |&(h, _)| h) {
                hashbrown::hash_table::Entry::Occupied(o) => o.get().1,
                hashbrown::hash_table::Entry::Vacant(v) => {
                    let taken = next.held_bytes() + size_of::<u32>() * self.edges.len();
                    let full = refused || taken >= self.bytes && next.len() >= CUT;
                    if full || next.len() >= self.room {
                        let why = if full { Stop::Memory } else { Stop::NodeBudget };
                        self.stop = self.stop.combine_with(why);
                        self.edges.push(DEAD);
                        continue;
                    }
                    let index = u32::try_from(next.len()).expect("the node budget is below 2^32");
                    v.insert((hash, index));
                    next.push(spent.clone(), matrix, least);
                    index
                }
            };
            let known = &mut self.next.least[index as usize];
            *known = (*known).min(least);
            self.edges.push(index);
        }
    }
}

/// Why building ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The search is complete: counts are exact.
    Exhausted,
    /// The node budget cut layers down to a part of their nodes: counts are lower bounds.
    NodeBudget,
    /// Only the cheapest variants were asked for: counts are lower bounds.
    NotCounted,
    /// The memory limit cut layers down in the same way.
    Memory,
    /// The caller asked to end: layers were cut down, counts are lower bounds.
    Interrupted,
}

impl Stop {
    /// Returns the reason for two parts of one search: an interruption, otherwise the first that is not [`Stop::Exhausted`].
    #[must_use]
    pub fn combine_with(self, other: Stop) -> Stop {
        match (self, other) {
            (Stop::Exhausted, _) | (_, Stop::Interrupted) => other,
            _ => self,
        }
    }

    /// Returns true if a diagram is cut down to its limits.
    pub(in crate::search) fn is_cut(self) -> bool {
        matches!(self, Stop::NodeBudget | Stop::Memory)
    }

    /// Returns the word used in machine-readable output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Stop::Exhausted => "exhausted",
            Stop::NodeBudget => "node-budget",
            Stop::NotCounted => "not-counted",
            Stop::Memory => "memory",
            Stop::Interrupted => "interrupted",
        }
    }
}
