//! One transition of the diagram: the children of a node at a variable, one for each choice.
//!
//! Everything here works on flat scratch space that a thread keeps, in a field with a memory of inverses.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::{Role, Spent};
use crate::search::diagram::stage::{Adding, Columns, Stage};

/// A child: its hash, the redundancy spent, and where its matrix starts and ends.
pub(in crate::search) type Child = (u64, Spent, usize, usize);

/// The children of some consecutive nodes, before equal ones are merged.
pub(in crate::search) struct Children {
    /// Choices a node has.
    pub(in crate::search) choices: usize,
    /// The children in order of (node, choice); `None` if dead.
    pub(in crate::search) found: Vec<Option<Child>>,
    pub(in crate::search) data: Vec<Residue>,
    /// Whether children are missing because memory did not suffice.
    pub(in crate::search) short: bool,
}

impl Children {
    /// Creates an empty list for nodes with `choices` choices.
    pub(in crate::search) fn new(choices: usize) -> Self {
        Children {
            choices,
            found: Vec::new(),
            data: Vec::new(),
            short: false,
        }
    }

    /// Takes a child.
    fn take_child(&mut self, child: &Growing) {
        if !child.alive {
            self.found.push(None);
            return;
        }
        let (matrix, start) = (&child.packed, self.data.len());
        if self.data.try_reserve(matrix.len()).is_err() {
            self.short = true;
            self.found.push(None);
            return;
        }
        self.data.extend_from_slice(matrix);
        let spent = child.spent.clone();
        let child = (hash_child(matrix, &spent), spent, start, self.data.len());
        self.found.push(Some(child));
    }
}

/// A child while lane after lane is added to it.
struct Growing {
    spent: Spent,
    /// Its subspaces so far, packed one after another.
    packed: Vec<Residue>,
    alive: bool,
}

/// Scratch space of one thread.
pub(in crate::search) struct Worker {
    arithmetic: Arithmetic,
    /// A node's rows at the variable: `all`, then `harmless`.
    bases: [Rows; 2],
    /// Those extended by each choice.
    grown: [Vec<Rows>; 2],
    vector: Vec<Residue>,
    children: Vec<Growing>,
    /// The choices whose children are wanted; all if empty.
    wanted: Vec<bool>,
    /// These and the choices that they are grown from; empty if all are wanted.
    needed: Vec<bool>,
}

impl Worker {
    pub(in crate::search) fn new(field: Field) -> Self {
        Worker {
            arithmetic: Arithmetic::new(field),
            bases: Default::default(),
            grown: Default::default(),
            vector: Vec::new(),
            children: Vec::new(),
            wanted: Vec::new(),
            needed: Vec::new(),
        }
    }

    /// Restricts the next children to some choices. Those of the others are dead.
    pub(in crate::search) fn restrict_choices(&mut self, wanted: impl IntoIterator<Item = bool>) {
        self.wanted.clear();
        self.wanted.extend(wanted);
    }

    /// Takes a subspace off a packed node and extends it by each choice; `part` says which of the two it is.
    fn grow_choices(&mut self, part: usize, columns: &Columns, packed: &mut &[Residue]) {
        let Columns { width, places, .. } = columns;
        let base = &mut self.bases[part];
        base.unpack_spread(&mut self.arithmetic, *width, places, packed);
        let grown = &mut self.grown[part];
        grown.resize(columns.growth.len(), Rows::default());
        self.needed.clone_from(&self.wanted);
        if !self.needed.is_empty() {
            for g in columns.growth.iter().rev() {
                if let Some(from) = g.from.filter(|_| self.needed[g.choice]) {
                    self.needed[from] = true;
                }
            }
        }
        for g in &columns.growth {
            if self.needed.get(g.choice) == Some(&false) {
                continue;
            }
            let mut rows = std::mem::take(&mut grown[g.choice]);
            rows.clone_from(match g.from {
                Some(from) => &grown[from],
                None => base,
            });
            for row in &g.more {
                self.vector.clone_from(row);
                rows.insert(&mut self.arithmetic, &mut self.vector);
            }
            grown[g.choice] = rows;
        }
    }

    /// Appends all children of a node, in order of choices.
    pub(in crate::search) fn append_children(
        &mut self,
        stage: &Stage<'_>,
        mut matrix: &[Residue],
        spent: &Spent,
        out: &mut Children,
    ) {
        self.begin_children(stage.choices, spent);
        for (number, lane) in stage.lanes.iter().enumerate() {
            if spent.is_ruled_out(number) {
                continue;
            }
            self.grow_choices(0, &lane.all, &mut matrix);
            if let Some(harmless) = &lane.harmless {
                self.grow_choices(1, harmless, &mut matrix);
            }
            let children = self.children.iter_mut().enumerate();
            for (choice, child) in children.filter(|(_, child)| child.alive) {
                if lane.applies.get(choice) == Some(&false) {
                    child.spent.rule_out(number);
                    continue;
                }
                let [all, harmless] = &mut self.grown;
                let all = &mut all[choice];
                let mut harmless = lane.harmless.as_ref().map(|c| (c, &mut harmless[choice]));
                if let Some((_, harmless)) = &harmless {
                    let [before, left] = [&self.bases[0], &self.bases[1]].map(Rows::rank);
                    if all.rank() + left < harmless.rank() + before {
                        match lane.role {
                            Role::Held(_) => child.spent.rule_out(number),
                            _ => child.alive = false,
                        }
                        continue;
                    }
                }
                // A row that starts in the gap is a motion that the contours forbid; directions of the gap that no row has are redundant.
                let gap = lane.all.closing;
                child
                    .spent
                    .add_redundant(number, to_u32(gap - all.rank_before(gap)));
                all.drop_first(gap);
                all.pack_into(&mut child.packed);
                if let Some((columns, rows)) = &mut harmless {
                    rows.drop_first(columns.closing);
                    rows.pack_into(&mut child.packed);
                }
                child.alive = child.spent.is_within(stage.limits);
            }
        }
        for child in &mut self.children {
            if let Some(roles) = stage.ending.as_ref().filter(|_| child.alive) {
                child.alive = child.spent.holds_all(roles);
                child.spent.settle_counts(roles, stage.limits);
                child.alive &= child.spent.state_within(stage.limits);
            }
            out.take_child(child);
        }
    }

    /// Appends the children of a node whose rows have all coordinates of kept links, in order of choices. A child with a redundant
    /// constraint is dead.
    pub(in crate::search) fn flat_children(
        &mut self,
        stage: &Adding,
        mut matrix: &[Residue],
        spent: &Spent,
        out: &mut Children,
    ) {
        self.begin_children(stage.columns.growth.len(), spent);
        self.grow_choices(0, &stage.columns, &mut matrix);
        let gap = stage.columns.closing;
        for (rows, child) in self.grown[0].iter_mut().zip(&mut self.children) {
            if !child.alive {
                out.take_child(child);
                continue;
            }
            // A pivot there is a motion that closes every contour and moves a kept link.
            let goes_wrong = rows
                .pivots
                .last()
                .is_some_and(|&p| p >= stage.contours.len());
            child.alive = !goes_wrong && rows.rank_before(gap) == gap;
            if child.alive {
                rows.drop_first(gap);
                rows.pack_into(&mut child.packed);
            }
            out.take_child(child);
        }
    }

    /// Begins the children of a node.
    fn begin_children(&mut self, choices: usize, spent: &Spent) {
        self.children.resize_with(choices, || Growing {
            spent: Spent::default(),
            packed: Vec::new(),
            alive: true,
        });
        for (choice, child) in self.children.iter_mut().enumerate() {
            child.spent.clone_from(spent);
            child.packed.clear();
            child.alive = self.wanted.get(choice).is_none_or(|w| *w);
        }
    }
}

fn to_u32(directions: usize) -> u32 {
    u32::try_from(directions).unwrap_or(u32::MAX)
}

/// Returns a fixed hash. It is the same on every machine and in every run, so nothing depends on a random seed.
fn hash_child(matrix: &[Residue], spent: &Spent) -> u64 {
    let mut h = 0x517c_c1b7_2722_0a95_u64;
    for x in spent.hash_words().chain(matrix.iter().copied()) {
        let wide = u128::from(h ^ x) * 0x9e37_79b9_7f4a_7c15_u128;
        h = (wide >> 64) as u64 ^ wide as u64;
    }
    h
}
