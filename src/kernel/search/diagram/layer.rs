//! A layer of the diagram. While it is built, equal children become one node.

use crate::linalg::modp::Residue;
use crate::search::diagram::redundancy_so_far::Spent;
use crate::search::diagram::subspaces::{Subspaces, hash_words};
use crate::search::diagram::transition::Steps;
use hashbrown::HashTable;
use std::collections::TryReserveError;
use std::fmt;

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

/// Bytes of a node: what was spent, the least cost, and its place in the table.
const NODE: usize = size_of::<Spent>() + size_of::<u64>() + 2 * size_of::<(u64, u32)>();

/// The nodes of a layer while it is being built.
pub(in crate::search) struct Nodes {
    /// Redundancy so far.
    pub(in crate::search) spent: Vec<Spent>,
    /// Least cost of a way to the node.
    pub(in crate::search) least: Vec<i64>,
    /// The subspaces of each kind.
    pub(in crate::search) spaces: Vec<Subspaces>,
    /// The numbers of each node's subspaces, one of each kind. It is [`NONE`](crate::search::diagram::subspaces::NONE) if the lane does not
    /// apply.
    numbers: Vec<u32>,
}

impl Nodes {
    /// Returns the one node before any choice.
    pub(in crate::search) fn root_node(spent: Spent, kinds: usize) -> Self {
        Nodes {
            spent: vec![spent],
            least: vec![0],
            spaces: (0..kinds).map(|_| Subspaces::zero_alone()).collect(),
            numbers: vec![0; kinds],
        }
    }

    /// Returns no nodes with so many kinds of subspaces.
    fn empty(kinds: usize) -> Self {
        Nodes {
            spent: Vec::new(),
            least: Vec::new(),
            spaces: (0..kinds).map(|_| Subspaces::default()).collect(),
            numbers: Vec::new(),
        }
    }

    pub(in crate::search) fn len(&self) -> usize {
        self.spent.len()
    }

    /// Returns the bytes of the nodes, with the tables that find them during construction.
    pub(in crate::search) fn held_bytes(&self) -> usize {
        let spaces: usize = self.spaces.iter().map(Subspaces::held_bytes).sum();
        spaces + size_of::<u32>() * self.numbers.len() + NODE * self.len()
    }

    /// Returns the numbers of a node's subspaces.
    pub(in crate::search) fn numbers(&self, node: usize) -> &[u32] {
        let kinds = self.spaces.len();
        &self.numbers[node * kinds..(node + 1) * kinds]
    }

    /// Returns the packed rows of a node's first subspace.
    pub(in crate::search) fn packed_rows(&self, node: usize) -> &[Residue] {
        self.spaces[0].packed_rows(self.numbers(node)[0])
    }

    /// Makes room for a node.
    fn reserve_node(&mut self) -> Result<(), TryReserveError> {
        self.spent.try_reserve(1)?;
        self.least.try_reserve(1)?;
        self.numbers.try_reserve(self.spaces.len())
    }

    /// Keeps the nodes listed, ascending, within the memory that they have.
    pub(in crate::search) fn retain(&mut self, kept: &[usize]) {
        let kinds = self.spaces.len();
        for (to, &from) in kept.iter().enumerate() {
            self.spent.swap(to, from);
            self.least[to] = self.least[from];
            let own = from * kinds..(from + 1) * kinds;
            self.numbers.copy_within(own, to * kinds);
        }
        self.spent.truncate(kept.len());
        self.least.truncate(kept.len());
        self.numbers.truncate(kept.len() * kinds);
        self.drop_unused_spaces();
    }

    /// Drops the subspaces that no node has.
    fn drop_unused_spaces(&mut self) {
        let kinds = self.spaces.len();
        for (kind, spaces) in self.spaces.iter_mut().enumerate() {
            let numbers = self.numbers.get_mut(kind..).unwrap_or_default();
            spaces.retain_used(numbers, kinds);
        }
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
    /// Returns an empty layer with limits on nodes and bytes, for about `edges` edges. Its nodes have so many kinds of subspaces.
    pub(in crate::search) fn new(
        (room, bytes): (usize, usize),
        stop: Stop,
        edges: usize,
        kinds: usize,
    ) -> Self {
        Merge {
            room,
            bytes,
            stop,
            refused: false,
            table: HashTable::new(),
            next: Nodes::empty(kinds),
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

    /// Returns why no node can be added; `None` if there is room.
    fn limit_reached(&self) -> Option<Stop> {
        let taken = self.next.held_bytes() + size_of::<u32>() * self.edges.len();
        if self.refused || taken >= self.bytes && self.next.len() >= CUT {
            return Some(Stop::Memory);
        }
        (self.next.len() >= self.room).then_some(Stop::NodeBudget)
    }

    /// Takes the steps that are wanted of subspaces of a kind.
    pub(in crate::search) fn take_steps(&mut self, kind: usize, steps: &mut Steps<'_>) {
        let room = self.limit_reached().is_none();
        if !steps.take_steps(&mut self.next.spaces[kind], room) {
            self.refused = true;
            self.stop = self.stop.combine_with(Stop::Memory);
        }
    }

    /// Adds the next edge: to a node with these subspaces, which the cheapest path over the edge reaches at some cost.
    pub(in crate::search) fn push_edge(&mut self, spent: Spent, numbers: &[u32], least: i64) {
        let hash = hash_words(spent.hash_words().chain(numbers.iter().map(|&n| n.into())));
        let next = &self.next;
        let same = |&(h, i): &(u64, u32)| {
            h == hash && next.spent[i as usize] == spent && next.numbers(i as usize) == numbers
        };
        if let Some(&(_, node)) = self.table.find(hash, same) {
            let known = &mut self.next.least[node as usize];
            *known = (*known).min(least);
            self.edges.push(node);
            return;
        }
        self.refused |=
            self.next.reserve_node().is_err() || self.table.try_reserve(1, |&(h, _)| h).is_err();
        if let Some(why) = self.limit_reached() {
            self.stop = self.stop.combine_with(why);
            self.edges.push(DEAD);
            return;
        }
        let node = u32::try_from(self.next.len()).expect("the node budget is below 2^32");
        self.table.insert_unique(hash, (hash, node), |&(h, _)| h);
        self.next.spent.push(spent);
        self.next.numbers.extend_from_slice(numbers);
        self.next.least.push(least);
        self.edges.push(node);
    }

    /// Returns the layer when it has all edges.
    pub(in crate::search) fn finish(mut self) -> Self {
        self.next.drop_unused_spaces();
        self
    }
}

/// A function that returns whether to end early, with what is found so far.
pub type ShouldCancel<'a> = &'a (dyn Fn() -> bool + Sync);

/// How a search is ended early, and who hears how far it has come.
#[derive(Clone, Copy)]
pub struct Control<'a> {
    /// Returns whether to end early.
    pub cancelled: ShouldCancel<'a>,
    /// Receives the progress.
    pub progress: &'a (dyn Fn(Progress) + Sync),
}

impl<'a> Control<'a> {
    /// The control of a search that runs to its end, and that nobody watches.
    pub const NONE: Control<'static> = Control::cancelled_by(&|| false);

    /// Returns the control of a search that nobody watches.
    #[must_use]
    pub const fn cancelled_by(cancelled: ShouldCancel<'a>) -> Control<'a> {
        Control {
            cancelled,
            progress: &|_| {},
        }
    }

    /// Returns the same control for a part of the search, whose progress goes to `progress`.
    pub(in crate::search) fn with_progress<'b>(
        self,
        progress: &'b (dyn Fn(Progress) + Sync),
    ) -> Control<'b>
    where
        'a: 'b,
    {
        Control { progress, ..self }
    }
}

impl fmt::Debug for Control<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Control").finish_non_exhaustive()
    }
}

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
    /// Returns the progress of a part as that of the whole, which has `done` of `of` variables and `before` nodes before the part.
    pub(in crate::search) fn after(self, done: usize, of: usize, before: usize) -> Progress {
        Progress {
            done: done + self.done,
            of,
            nodes: before + self.nodes,
            layer: self.layer,
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
