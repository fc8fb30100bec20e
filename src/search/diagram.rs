//! The span diagram: variants folded into the motion spaces their parts leave.
//!
//! Nodes are kept as reduced row echelon forms over a prime field, which are canonical, so equal spaces meet in one
//! hash table. One transition costs a few hundred multiplications.

use crate::geom::exact::ExactField;
use crate::linalg::modp::{Field, Residue};
use crate::search::lookahead::Lookahead;
use crate::search::space::Space;
use crate::search::spent::{Limits, Redundancy, Spent};
use crate::search::stage::Stage;
use crate::search::transition::{Children, Worker};
use hashbrown::HashTable;
use rayon::prelude::*;

/// A missing edge: the choice leads nowhere admissible.
pub const DEAD: u32 = u32::MAX;

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

/// Why building ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Everything was looked at: counts are exact.
    Exhausted,
    /// The node budget cut layers down to their cheapest nodes: counts are lower bounds.
    NodeBudget,
    /// What may be held of memory did, in the same way.
    Memory,
    /// The caller asked to end: layers were cut down, counts are lower bounds.
    Interrupted,
}

impl Stop {
    /// The first of two reasons that is one.
    #[must_use]
    pub fn or(self, other: Stop) -> Stop {
        if self == Stop::Exhausted { other } else { self }
    }

    /// The word for programs.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Stop::Exhausted => "exhausted",
            Stop::NodeBudget => "node-budget",
            Stop::Memory => "memory",
            Stop::Interrupted => "interrupted",
        }
    }
}

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

/// A finished diagram.
#[derive(Debug, Clone)]
pub struct Diagram {
    /// The layers in order; layer 0 has the root alone.
    pub layers: Vec<Layer>,
    /// Of each terminal node, the redundant constraints.
    pub terminals: Vec<Redundancy>,
    /// Why building ended.
    pub stop: Stop,
    /// Nodes in all, root and terminals included.
    pub nodes: usize,
    /// Nodes of the largest layer.
    pub largest_layer: usize,
}

impl Diagram {
    /// Where the choices for the variables lead: the redundant constraints of a variant that the diagram has,
    /// `None` for one that it has not.
    #[must_use]
    pub fn end(&self, choices: &[usize]) -> Option<Redundancy> {
        let mut node = 0;
        for layer in &self.layers {
            let to = layer.edges[node * layer.choices + choices[layer.variable]];
            node = (to != DEAD).then_some(to as usize)?;
        }
        self.terminals.get(node).copied()
    }
}

/// The nodes of a layer while it is being built.
struct Nodes {
    /// Redundancy so far.
    spent: Vec<Spent>,
    /// Start of each node's matrix in `data`; one more at the end.
    start: Vec<usize>,
    data: Vec<Residue>,
    /// Least cost of a way to the node.
    least: Vec<i64>,
}

impl Nodes {
    fn root() -> Self {
        Nodes {
            spent: vec![Spent::default()],
            start: vec![0, 0],
            data: Vec::new(),
            least: vec![0],
        }
    }

    fn empty() -> Self {
        Nodes {
            spent: Vec::new(),
            start: vec![0],
            data: Vec::new(),
            least: Vec::new(),
        }
    }

    fn len(&self) -> usize {
        self.spent.len()
    }

    /// Bytes of the nodes, with the table that finds them while they are gathered.
    fn bytes(&self) -> usize {
        size_of::<Residue>() * self.data.len() + NODE * self.len()
    }

    fn matrix(&self, i: usize) -> &[Residue] {
        &self.data[self.start[i]..self.start[i + 1]]
    }

    fn push(&mut self, spent: Spent, matrix: &[Residue], least: i64) {
        self.spent.push(spent);
        self.data.extend_from_slice(matrix);
        self.start.push(self.data.len());
        self.least.push(least);
    }
}

/// Builds the diagram of a space along given stages.
///
/// `cancelled` is asked between batches of nodes; once it says yes the remaining layers are cut to a few nodes, so that
/// what was found can still be completed. The result does not depend on the number of threads: children are computed in
/// parallel and merged in order.
///
/// # Complexity
/// O(nodes · choices · d²w) field operations for matrices of d rows and w columns; memory is the edges of all layers
/// and the matrices of two, both bounded by `limits.nodes` and `limits.bytes`.
pub fn build(
    exact: &ExactField,
    space: &Space,
    stages: &[Stage],
    limits: &Limits,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Diagram {
    let mut nodes = Nodes::root();
    let mut layers = Vec::with_capacity(stages.len());
    let (mut total, mut largest, mut stop, mut held) = (1, 1, Stop::Exhausted, 0);
    for (done, stage) in stages.iter().enumerate() {
        let choices = &space.variables[stage.variable].choices;
        let mut merge = Merge {
            room: limits.nodes.saturating_sub(total).max(CUT),
            bytes: limits.bytes.saturating_sub(held + nodes.bytes()),
            stop,
            table: HashTable::new(),
            next: Nodes::empty(),
            edges: Vec::with_capacity(nodes.len() * choices.len()),
        };
        // Children that are not merged yet may take an eighth of the memory; one is about as large as its parent.
        let each = nodes.bytes() / nodes.len().max(1) * choices.len();
        let size = (limits.bytes / 8 / each.max(1)).clamp(CUT, BATCH);
        for batch in (0..nodes.len()).step_by(size) {
            let batch = batch..(batch + size).min(nodes.len());
            for part in expand(exact.field(), space, stage, limits, &nodes, batch) {
                merge.take(&part, &nodes, |choice| choices[choice].cost_milli);
            }
            if cancelled() && merge.stop != Stop::Interrupted {
                merge.stop = Stop::Interrupted;
                merge.room = merge.room.min(CUT);
            }
            progress(Progress {
                done,
                of: stages.len(),
                nodes: total + merge.next.len(),
                layer: merge.next.len(),
            });
        }
        let Merge {
            stop: now,
            mut next,
            mut edges,
            ..
        } = merge;
        stop = now;
        if let Some(test) = &stage.lookahead {
            let passed = passing(exact.field(), space.dim, test, &next);
            next = retain(&next, &passed, &mut edges);
        }
        let keep = match stop {
            Stop::Exhausted => usize::MAX,
            // Share what is left of the budget among the layers to come.
            Stop::NodeBudget => {
                (limits.nodes.saturating_sub(total) / (stages.len() - done)).max(CUT)
            }
            Stop::Memory => {
                let each = next.bytes() / next.len().max(1) + size_of::<u32>() * choices.len();
                let left = limits.bytes.saturating_sub(held) / (stages.len() - done);
                (left / each).max(CUT)
            }
            Stop::Interrupted => CUT,
        };
        if next.len() > keep {
            next = cut(&next, keep, &mut edges);
        }
        total += next.len();
        largest = largest.max(next.len());
        held += size_of::<u32>() * edges.len();
        layers.push(Layer {
            variable: stage.variable,
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
        nodes: total,
        largest_layer: largest,
    }
}

/// Nodes a layer keeps at least, however small the budget, so that a search always reaches the end.
const CUT: usize = 256;
/// Nodes expanded at most before their children are merged.
const BATCH: usize = 1 << 14;
/// Bytes of a node besides its matrix: what was spent, where the matrix starts, the least cost, and its place in the table.
const NODE: usize = size_of::<Spent>() + 3 * size_of::<u64>() + 2 * size_of::<(u64, u32)>();
/// Fewer children than this are not worth waking threads for.
const PARALLEL: usize = 1024;

/// The children of some nodes, in parallel, in order.
fn expand(
    field: Field,
    space: &Space,
    stage: &Stage,
    limits: &Limits,
    nodes: &Nodes,
    range: std::ops::Range<usize>,
) -> Vec<Children> {
    let choices = space.variables[stage.variable].choices.len();
    let some = |range: std::ops::Range<usize>| {
        let mut worker = Worker::new(field, space.dim);
        let mut out = Children {
            choices,
            found: Vec::with_capacity(range.len() * choices),
            data: Vec::new(),
        };
        for i in range {
            worker.children(
                space,
                stage,
                nodes.matrix(i),
                &nodes.spent[i],
                limits,
                &mut out,
            );
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

/// A layer being put together.
struct Merge {
    /// New nodes allowed.
    room: usize,
    /// Bytes that they and the edges may take.
    bytes: usize,
    stop: Stop,
    table: HashTable<(u64, u32)>,
    next: Nodes,
    edges: Vec<u32>,
}

impl Merge {
    fn take(&mut self, part: &Children, parents: &Nodes, cost: impl Fn(usize) -> i64) {
        let choices = part.choices;
        for child in &part.found {
            let Some((hash, ref spent, start, end)) = *child else {
                self.edges.push(DEAD);
                continue;
            };
            let matrix = &part.data[start..end];
            let at = self.edges.len();
            let least = parents.least[at / choices] + cost(at % choices);
            let next = &mut self.next;
            let same = |&(h, i): &(u64, u32)| {
                h == hash && next.spent[i as usize] == *spent && next.matrix(i as usize) == matrix
            };
            let index = match self.table.entry(hash, same, |&(h, _)| h) {
                hashbrown::hash_table::Entry::Occupied(o) => o.get().1,
                hashbrown::hash_table::Entry::Vacant(v) => {
                    let taken = next.bytes() + size_of::<u32>() * self.edges.len();
                    let full = taken >= self.bytes && next.len() >= CUT;
                    if full || next.len() >= self.room {
                        let why = if full { Stop::Memory } else { Stop::NodeBudget };
                        self.stop = self.stop.or(why);
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

/// The nodes of a layer that pass a test, ascending.
fn passing(field: Field, dim: usize, test: &Lookahead, nodes: &Nodes) -> Vec<usize> {
    let chunk = if nodes.len() < PARALLEL {
        nodes.len().max(1)
    } else {
        PARALLEL / 4
    };
    let starts: Vec<usize> = (0..nodes.len()).step_by(chunk).collect();
    let some = |start: usize| {
        let mut worker = Worker::new(field, dim);
        (start..(start + chunk).min(nodes.len()))
            .filter(|&i| worker.passes(test, nodes.matrix(i)))
            .collect::<Vec<_>>()
    };
    if starts.len() <= 1 {
        return starts.into_iter().flat_map(some).collect();
    }
    starts
        .into_par_iter()
        .map(some)
        .collect::<Vec<_>>()
        .concat()
}

/// Keeps the cheapest nodes of a layer, first come first kept among equals.
fn cut(nodes: &Nodes, keep: usize, edges: &mut [u32]) -> Nodes {
    let mut by_cost: Vec<usize> = (0..nodes.len()).collect();
    by_cost.sort_by_key(|&i| (nodes.least[i], i));
    by_cost.truncate(keep);
    by_cost.sort_unstable();
    retain(nodes, &by_cost, edges)
}

/// Keeps the nodes listed, ascending, and renames the edges that lead to them.
fn retain(nodes: &Nodes, kept: &[usize], edges: &mut [u32]) -> Nodes {
    let mut renamed = vec![DEAD; nodes.len()];
    let mut out = Nodes::empty();
    for &i in kept {
        renamed[i] = u32::try_from(out.len()).expect("fewer than before");
        out.push(nodes.spent[i].clone(), nodes.matrix(i), nodes.least[i]);
    }
    edges
        .iter_mut()
        .filter(|e| **e != DEAD)
        .for_each(|e| *e = renamed[*e as usize]);
    out
}
