//! The span diagram: variants folded into the motion spaces their parts leave.
//!
//! Nodes are kept as reduced row echelon forms over a prime field, which are canonical, so equal spaces meet in one
//! hash table. One transition costs a few hundred multiplications.

use crate::geom::exact::ExactField;
use crate::linalg::modp::{Field, Residue};
use crate::search::lookahead::Lookahead;
use crate::search::plan::{Plan, Step};
use crate::search::space::Space;
use hashbrown::HashTable;
use rayon::prelude::*;

/// A missing edge: the choice leads nowhere admissible.
pub const DEAD: u32 = u32::MAX;

/// When a partly built mechanism is given up, and when building stops.
#[derive(Debug, Clone)]
pub struct Limits {
    /// Redundant constraints allowed within the mechanism.
    pub internal: u32,
    /// Redundant constraints allowed from the state's additional joints.
    pub external: u32,
    /// Nodes in all.
    pub nodes: usize,
}

/// Folds away how exactly a finished kept link goes wrong.
///
/// Once all joints of a kept link are chosen, its twist matters only to the question whether the kept motions at the
/// end are the present ones. That question does not change under a linear map of the twist that leaves the present
/// motions fixed, so a motion either gives the link a present twist, which is kept, or it does not, and then all that
/// counts is which motions of the live links do so. Nodes that differ in nothing else become equal.
#[derive(Debug, Clone)]
pub struct Collapse {
    /// Blocks that hold the finished links' twists relative to the frame.
    pub blocks: Vec<usize>,
    /// Reduced basis of their present motions, in the coordinates of the blocks in that order.
    pub present: Vec<Vec<Residue>>,
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

/// Why building ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Everything was looked at: counts are exact.
    Exhausted,
    /// The node budget cut layers down to their cheapest nodes: counts are lower bounds.
    NodeBudget,
    /// The caller asked to end: layers were cut down, counts are lower bounds.
    Interrupted,
}

impl Stop {
    /// The word for programs.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Stop::Exhausted => "exhausted",
            Stop::NodeBudget => "node-budget",
            Stop::Interrupted => "interrupted",
        }
    }
}

/// A variable of the diagram with the steps its joints take.
#[derive(Debug, Clone)]
pub struct Stage {
    /// Index of the variable in the space.
    pub variable: usize,
    /// (Position of the joint within the variable, its step); empty where the variable does not matter to the diagram.
    pub steps: Vec<(usize, Step)>,
    /// Whether contours closed here count as external.
    pub external: bool,
    /// Simplification of finished kept links after this stage.
    pub collapse: Option<Collapse>,
    /// Test that nodes must pass after this stage.
    pub lookahead: Option<Lookahead>,
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
    /// Of each terminal node, redundant constraints (internal, external).
    pub terminals: Vec<(u32, u32)>,
    /// Why building ended.
    pub stop: Stop,
    /// Nodes in all, root and terminals included.
    pub nodes: usize,
    /// Nodes of the largest layer.
    pub largest_layer: usize,
}

/// The nodes of a layer while it is being built.
struct Nodes {
    /// Redundancy so far: internal, external.
    spent: Vec<(u32, u32)>,
    /// Start of each node's matrix in `data`; one more at the end.
    start: Vec<usize>,
    data: Vec<Residue>,
    /// Least cost of a way to the node.
    least: Vec<i64>,
}

impl Nodes {
    fn root() -> Self {
        Nodes {
            spent: vec![(0, 0)],
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

    fn matrix(&self, i: usize) -> &[Residue] {
        &self.data[self.start[i]..self.start[i + 1]]
    }

    fn push(&mut self, spent: (u32, u32), matrix: &[Residue], least: i64) {
        self.spent.push(spent);
        self.data.extend_from_slice(matrix);
        self.start.push(self.data.len());
        self.least.push(least);
    }
}

/// A child: its hash, the redundancy spent, and where its matrix starts and ends.
type Child = (u64, (u32, u32), usize, usize);

/// The children of some consecutive nodes, before equal ones are merged.
struct Children {
    /// Choices a node has.
    choices: usize,
    /// The children in order of (node, choice); `None` if dead.
    found: Vec<Option<Child>>,
    data: Vec<Residue>,
}

/// Builds the diagram of a space along given stages.
///
/// `cancelled` is asked between batches of nodes; once it says yes the remaining layers are cut to a few nodes, so that
/// what was found can still be completed. The result does not depend on the number of threads: children are computed in
/// parallel and merged in order.
///
/// # Complexity
/// O(nodes · choices · d²w) field operations for matrices of d rows and w columns; memory is the edges of all layers
/// and the matrices of two, both bounded by `limits.nodes`.
pub fn build(
    exact: &ExactField,
    space: &Space,
    stages: &[Stage],
    limits: &Limits,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut dyn FnMut(Progress),
) -> Diagram {
    let mut nodes = Nodes::root();
    let mut layers = Vec::with_capacity(stages.len());
    let (mut total, mut largest, mut stop) = (1, 1, Stop::Exhausted);
    for (done, stage) in stages.iter().enumerate() {
        let choices = &space.variables[stage.variable].choices;
        let mut merge = Merge {
            room: limits.nodes.saturating_sub(total).max(CUT),
            stop,
            table: HashTable::new(),
            next: Nodes::empty(),
            edges: Vec::with_capacity(nodes.len() * choices.len()),
        };
        for batch in (0..nodes.len()).step_by(BATCH) {
            let batch = batch..(batch + BATCH).min(nodes.len());
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
            Stop::Interrupted => CUT,
        };
        if next.len() > keep {
            next = cut(&next, keep, &mut edges);
        }
        total += next.len();
        largest = largest.max(next.len());
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
        terminals: nodes.spent,
        stop,
        nodes: total,
        largest_layer: largest,
    }
}

/// Nodes a layer keeps at least, however small the budget, so that a search always reaches the end.
const CUT: usize = 256;
/// Nodes expanded before their children are merged, which bounds the memory of unmerged children.
const BATCH: usize = 1 << 14;
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
                nodes.spent[i],
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
    stop: Stop,
    table: HashTable<(u64, u32)>,
    next: Nodes,
    edges: Vec<u32>,
}

impl Merge {
    fn take(&mut self, part: &Children, parents: &Nodes, cost: impl Fn(usize) -> i64) {
        let choices = part.choices;
        for child in &part.found {
            let Some((hash, spent, start, end)) = *child else {
                self.edges.push(DEAD);
                continue;
            };
            let matrix = &part.data[start..end];
            let at = self.edges.len();
            let least = parents.least[at / choices] + cost(at % choices);
            let next = &mut self.next;
            let same = |&(h, i): &(u64, u32)| {
                h == hash && next.spent[i as usize] == spent && next.matrix(i as usize) == matrix
            };
            let index = match self.table.entry(hash, same, |&(h, _)| h) {
                hashbrown::hash_table::Entry::Occupied(o) => o.get().1,
                hashbrown::hash_table::Entry::Vacant(v) => {
                    if next.len() >= self.room {
                        if self.stop == Stop::Exhausted {
                            self.stop = Stop::NodeBudget;
                        }
                        self.edges.push(DEAD);
                        continue;
                    }
                    let index = u32::try_from(next.len()).expect("the node budget is below 2^32");
                    v.insert((hash, index));
                    next.push(spent, matrix, least);
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
        out.push(nodes.spent[i], nodes.matrix(i), nodes.least[i]);
    }
    edges
        .iter_mut()
        .filter(|e| **e != DEAD)
        .for_each(|e| *e = renamed[*e as usize]);
    out
}

/// Rows of a matrix in reduced row echelon form: each pivot is one and alone in its column.
#[derive(Default, Clone)]
struct Rows {
    width: usize,
    pivots: Vec<usize>,
    data: Vec<Residue>,
}

impl Rows {
    fn clear(&mut self, width: usize) {
        self.width = width;
        self.pivots.clear();
        self.data.clear();
    }

    /// Adds a vector, keeping the form; `vector` is used up.
    fn insert(&mut self, arithmetic: &mut Arithmetic, vector: &mut [Residue]) {
        let (f, width) = (arithmetic.field, self.width);
        for (row, &p) in self.data.chunks_exact(width.max(1)).zip(&self.pivots) {
            f.subtract_multiple(&mut vector[p..], &row[p..]);
        }
        let Some(pivot) = vector.iter().position(|&x| x != 0) else {
            return;
        };
        if vector[pivot] != f.one() {
            let scale = arithmetic.inverse(vector[pivot]);
            vector[pivot..]
                .iter_mut()
                .filter(|x| **x != 0)
                .for_each(|x| *x = f.mul(*x, scale));
        }
        for row in self.data.chunks_exact_mut(width) {
            f.subtract_multiple(&mut row[pivot..], &vector[pivot..]);
        }
        let at = self.pivots.partition_point(|&p| p < pivot);
        self.pivots.insert(at, pivot);
        self.data
            .splice(at * width..at * width, vector.iter().copied());
    }
}

/// The field with a memory of inverses: one takes as long as a hundred products, and the same few come again and again.
struct Arithmetic {
    field: Field,
    inverses: Vec<(Residue, Residue)>,
}

impl Arithmetic {
    fn inverse(&mut self, a: Residue) -> Residue {
        let slot = (a.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 54) as usize;
        if self.inverses[slot].0 != a {
            self.inverses[slot] = (a, self.field.inv(a));
        }
        self.inverses[slot].1
    }
}

/// Scratch space of one thread.
struct Worker {
    arithmetic: Arithmetic,
    dim: usize,
    /// Images of a node's rows under the step.
    base: Rows,
    /// Those, with the joint's twists.
    work: Rows,
    /// Images of a node's rows under a lookahead.
    kept: Rows,
    vector: Vec<Residue>,
}

impl Worker {
    fn new(field: Field, dim: usize) -> Self {
        Worker {
            arithmetic: Arithmetic {
                field,
                inverses: vec![(0, 0); 1024],
            },
            dim,
            base: Rows::default(),
            work: Rows::default(),
            kept: Rows::default(),
            vector: Vec::new(),
        }
    }

    /// Starts a step: `base` becomes the image of the old rows.
    fn begin(&mut self, step: &Step, old: &[Residue]) {
        let (f, d) = (self.arithmetic.field, self.dim);
        self.base.clear(step.width * d);
        for row in old.chunks_exact((step.old_width * d).max(1)) {
            self.vector.clear();
            self.vector.resize(step.width * d, 0);
            for &(new, old, plus) in &step.blocks {
                f.accumulate(
                    &mut self.vector[new * d..(new + 1) * d],
                    &row[old * d..(old + 1) * d],
                    plus,
                );
            }
            self.base.insert(&mut self.arithmetic, &mut self.vector);
        }
    }

    /// Ends a step: adds the joint's twists and drops the gap. The result is in `work`; returns the redundancy.
    fn finish(&mut self, step: &Step, span: &[Vec<Residue>]) -> u32 {
        let (f, d) = (self.arithmetic.field, self.dim);
        self.work.clone_from(&self.base);
        for twist in span {
            self.vector.clear();
            self.vector.resize(step.width * d, 0);
            for &(new, plus) in &step.twist {
                f.accumulate(&mut self.vector[new * d..(new + 1) * d], twist, plus);
            }
            self.work.insert(&mut self.arithmetic, &mut self.vector);
        }
        if !step.closing {
            return 0;
        }
        // Rows that bridge the gap are motions the contour forbids; directions that no row bridges are redundant.
        let bridged = self.work.pivots.partition_point(|&p| p < d);
        let (width, narrow) = (self.work.width, self.work.width - d);
        for r in bridged..self.work.pivots.len() {
            self.work
                .data
                .copy_within(r * width + d..(r + 1) * width, (r - bridged) * narrow);
        }
        self.work
            .data
            .truncate((self.work.pivots.len() - bridged) * narrow);
        self.work.pivots.drain(..bridged);
        self.work.pivots.iter_mut().for_each(|p| *p -= d);
        self.work.width = narrow;
        u32::try_from(d - bridged).expect("at most six")
    }

    /// All children of a node, in order of choices.
    fn children(
        &mut self,
        space: &Space,
        stage: &Stage,
        matrix: &[Residue],
        spent: (u32, u32),
        limits: &Limits,
        out: &mut Children,
    ) {
        let choices = &space.variables[stage.variable].choices;
        let Some(((member, first), rest)) = stage.steps.split_first() else {
            // The variable does not matter here: every choice leads to the same node.
            let start = out.data.len();
            out.data.extend_from_slice(matrix);
            out.found.resize(
                out.found.len() + choices.len(),
                Some((hash(matrix, spent), spent, start, out.data.len())),
            );
            return;
        };
        self.begin(first, matrix);
        let base = (!rest.is_empty()).then(|| self.base.clone());
        for choice in choices {
            if let Some(base) = &base {
                self.base.clone_from(base);
            }
            let mut redundant = self.finish(first, &choice.spans[*member]);
            for (member, step) in rest {
                let old = std::mem::take(&mut self.work.data);
                self.begin(step, &old);
                redundant += self.finish(step, &choice.spans[*member]);
            }
            let spent = if stage.external {
                (spent.0, spent.1 + redundant)
            } else {
                (spent.0 + redundant, spent.1)
            };
            if spent.0 > limits.internal || spent.1 > limits.external {
                out.found.push(None);
                continue;
            }
            if let Some(collapse) = &stage.collapse {
                self.collapse(collapse);
            }
            let start = out.data.len();
            out.data.extend_from_slice(&self.work.data);
            out.found.push(Some((
                hash(&self.work.data, spent),
                spent,
                start,
                out.data.len(),
            )));
        }
    }

    /// Brings `work` into the form that [`Collapse`] describes.
    fn collapse(&mut self, collapse: &Collapse) {
        let (f, d, width) = (self.arithmetic.field, self.dim, self.work.width);
        let places: Vec<usize> = collapse
            .blocks
            .iter()
            .flat_map(|b| b * d..(b + 1) * d)
            .collect();
        let pivot = |row: &[Residue]| row.iter().position(|&x| x != 0);
        let fixed: Vec<usize> = collapse.present.iter().filter_map(|r| pivot(r)).collect();
        let open: Vec<usize> = (0..places.len()).filter(|i| !fixed.contains(i)).collect();
        // Rows with what is wrong about them in front.
        self.kept.clear(open.len() + width);
        let mut right = true;
        for row in self.work.data.chunks_exact(width.max(1)) {
            let mut twist: Vec<Residue> = places.iter().map(|&p| row[p]).collect();
            for (known, &p) in collapse.present.iter().zip(&fixed) {
                f.subtract_multiple(&mut twist[p..], &known[p..]);
            }
            right &= twist.iter().all(|&x| x == 0);
            self.vector.clear();
            self.vector.extend(open.iter().map(|&i| twist[i]));
            self.vector.extend_from_slice(row);
            self.kept.insert(&mut self.arithmetic, &mut self.vector);
        }
        if right {
            return;
        }
        let wrong = self.kept.pivots.partition_point(|&p| p < open.len());
        // The motions that go wrong, without their wrong twists, modulo those that do not.
        let mut rest = Rows::default();
        rest.clear(width);
        let mut number = 0;
        self.work.clear(width);
        for row in self.kept.data.chunks_exact(self.kept.width).skip(wrong) {
            self.vector.clear();
            self.vector.extend_from_slice(&row[open.len()..]);
            self.work.insert(&mut self.arithmetic, &mut self.vector);
        }
        for row in self.kept.data.chunks_exact(self.kept.width).take(wrong) {
            self.vector.clear();
            self.vector.extend_from_slice(&row[open.len()..]);
            places.iter().for_each(|&p| self.vector[p] = 0);
            rest.insert(&mut self.arithmetic, &mut self.vector);
        }
        // Each goes wrong in a way of its own; so do motions of the finished links alone.
        for i in 0..wrong {
            self.vector.clear();
            match rest.data.chunks_exact(width).nth(i) {
                Some(row) => self.vector.extend_from_slice(row),
                None => self.vector.resize(width, 0),
            }
            self.vector[places[open[number]]] = f.one();
            number += 1;
            self.work.insert(&mut self.arithmetic, &mut self.vector);
        }
    }

    /// Whether a node may still keep the motions that must be kept.
    fn passes(&mut self, test: &Lookahead, matrix: &[Residue]) -> bool {
        let f = self.arithmetic.field;
        let width = test.map.first().map_or(0, Vec::len);
        self.kept.clear(width);
        for row in matrix.chunks_exact(test.map.len().max(1)) {
            self.vector.clear();
            self.vector.resize(width, 0);
            for (&x, image) in row.iter().zip(&test.map).filter(|(x, _)| **x != 0) {
                for (v, &y) in self.vector.iter_mut().zip(image) {
                    if y != 0 {
                        *v = f.add(*v, f.mul(x, y));
                    }
                }
            }
            self.kept.insert(&mut self.arithmetic, &mut self.vector);
        }
        let loose = self
            .kept
            .pivots
            .iter()
            .filter(|&&p| p >= test.locks)
            .count();
        test.base + loose <= test.allowed
    }
}

/// A fixed hash: the same on every machine and run, so that nothing depends on a random seed.
fn hash(matrix: &[Residue], spent: (u32, u32)) -> u64 {
    let mut h = 0x517c_c1b7_2722_0a95_u64 ^ (u64::from(spent.0) << 32 | u64::from(spent.1));
    for &x in matrix {
        let wide = u128::from(h ^ x) * 0x9e37_79b9_7f4a_7c15_u128;
        h = (wide >> 64) as u64 ^ wide as u64;
    }
    h
}

/// Makes one stage per variable from a plan over the joints.
///
/// `order` lists the variables as they take part; `plan` has one step per joint in the same sequence.
#[must_use]
pub fn stages(space: &Space, order: &[usize], plan: &Plan) -> Vec<Stage> {
    let mut steps = plan.steps.iter();
    order
        .iter()
        .map(|&variable| {
            let v = &space.variables[variable];
            Stage {
                variable,
                steps: (0..v.joints.len())
                    .zip(steps.by_ref())
                    .map(|(i, s)| (i, s.clone()))
                    .collect(),
                external: v.external,
                collapse: None,
                lookahead: None,
            }
        })
        .collect()
}
