//! One transition of the diagram: the choices at a variable extend the subspaces of a layer's nodes.
//!
//! Many nodes have a subspace in common, so each subspace is extended once by each choice that some node takes.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::stage::Columns;
use crate::search::diagram::subspaces::{NONE, Subspaces, hash_words};
use rayon::prelude::*;
use std::cell::RefCell;

/// The effect of a choice on a subspace.
#[derive(Clone, Copy)]
pub(in crate::search) struct Step {
    /// The number of what is left of it without the coordinates that close.
    pub(in crate::search) to: u32,
    /// Its dimension with them.
    rank: u16,
    /// How many dimensions it has in the coordinates that close.
    closed: u16,
}

impl Step {
    /// Returns the dimension in the coordinates that close.
    pub(in crate::search) fn closed(self) -> usize {
        self.closed.into()
    }

    /// Returns the dimension that is left.
    pub(in crate::search) fn dimension(self) -> usize {
        usize::from(self.rank - self.closed)
    }
}

/// A subspace extended by a choice: its hash and packed rows, and the numbers of its [`Step`].
#[derive(Clone, Copy)]
struct Child {
    hash: u64,
    start: usize,
    end: usize,
    rank: u16,
    closed: u16,
}

/// The steps of the subspaces of a layer at a variable, as far as they are known.
pub(in crate::search) struct Steps<'a> {
    field: Field,
    columns: &'a Columns,
    from: &'a Subspaces,
    choices: usize,
    /// A step for each subspace and choice. The outer `None` means that it is not known, the inner one that a motion goes wrong.
    known: Vec<Option<Option<Step>>>,
    /// The subspaces with steps that are wanted next.
    wanted: Vec<usize>,
}

/// Fewer children than this are not worth waking threads for.
const PARALLEL: usize = 1024;

impl<'a> Steps<'a> {
    pub(in crate::search) fn new(field: Field, columns: &'a Columns, from: &'a Subspaces) -> Self {
        let choices = columns.growth.len();
        Steps {
            field,
            columns,
            from,
            choices,
            known: vec![None; from.len() * choices],
            wanted: Vec::new(),
        }
    }

    /// Returns a step that was taken. `None` if a motion goes wrong, or of no subspace.
    pub(in crate::search) fn step(&self, from: u32, choice: usize) -> Option<Step> {
        let known = self.known.get(from as usize * self.choices + choice);
        known.copied()??
    }

    /// Returns how many dimensions a subspace gains by a step that was taken, before coordinates close. `None` if a motion goes wrong.
    pub(in crate::search) fn gained_dimensions(&self, from: u32, choice: usize) -> Option<u16> {
        let step = self.step(from, choice);
        step.map(|step| step.rank - self.from.dimension(from))
    }

    /// Says that a step is to be taken.
    pub(in crate::search) fn want_step(&mut self, from: u32, choice: usize) {
        let step = from as usize * self.choices + choice;
        if self.known[step].is_none() {
            self.known[step] = Some(None);
            self.wanted.push(step);
        }
    }

    /// Takes the steps that are wanted, to subspaces in `to`: no new ones if there is no `room`. Returns false if the system has no memory.
    pub(in crate::search) fn take_steps(&mut self, to: &mut Subspaces, room: bool) -> bool {
        let mut wanted = std::mem::take(&mut self.wanted);
        wanted.sort_unstable();
        let choices = self.choices;
        let spaces: Vec<&[usize]> = wanted.chunk_by(|a, b| a / choices == b / choices).collect();
        let some = |spaces: &[&[usize]]| {
            let mut out = Children::default();
            Worker::with_kept(self.field, |worker| {
                for steps in spaces {
                    let from = u32::try_from(steps[0] / choices).unwrap_or(NONE);
                    let wanted = steps.iter().map(|step| step % choices);
                    let from = self.from.packed_rows(from);
                    worker.append_children(self.columns, from, wanted, &mut out);
                }
            });
            out
        };
        let found = if wanted.len() < PARALLEL {
            vec![some(&spaces)]
        } else {
            let chunks = rayon::current_num_threads() * 4;
            let chunk = spaces.len().div_ceil(chunks).max(16);
            spaces.par_chunks(chunk).map(some).collect()
        };
        let mut enough = true;
        let mut steps = wanted.iter();
        for Children { found, data } in &found {
            for (child, &step) in found.iter().zip(&mut steps) {
                let Some(child) = child else { continue };
                let number = to.number_of(
                    (child.hash, &data[child.start..child.end]),
                    child.rank - child.closed,
                    room,
                );
                enough &= number.is_some();
                let step_to = |to| Step {
                    to,
                    rank: child.rank,
                    closed: child.closed,
                };
                self.known[step] = Some(number.map(step_to));
            }
        }
        enough
    }
}

/// The wanted children of some subspaces, before equal ones are merged.
#[derive(Default)]
struct Children {
    /// In order of subspaces and choices; `None` where a motion goes wrong.
    found: Vec<Option<Child>>,
    data: Vec<Residue>,
}

/// Scratch space of one thread.
pub(in crate::search) struct Worker {
    pub(in crate::search) arithmetic: Arithmetic,
    /// A subspace extended by each choice that makes it larger, and behind them the subspace itself.
    grown: Vec<Rows>,
    /// The index of each choice's subspace in `grown`.
    places: Vec<usize>,
    /// The child of each of these, as far as it is known.
    children: Vec<Option<Option<Child>>>,
    /// The choices that are wanted, and those that they are grown from.
    needed: Vec<bool>,
    vector: Vec<Residue>,
}

thread_local! {
    static WORKER: RefCell<Option<Worker>> = const { RefCell::new(None) };
}

impl Worker {
    /// Calls a function with the scratch space that the thread keeps.
    pub(in crate::search) fn with_kept<T>(field: Field, of: impl FnOnce(&mut Worker) -> T) -> T {
        let new = || Worker {
            arithmetic: Arithmetic::new(field),
            grown: Vec::new(),
            places: Vec::new(),
            children: Vec::new(),
            needed: Vec::new(),
            vector: Vec::new(),
        };
        WORKER.with_borrow_mut(|kept| {
            kept.take_if(|worker| worker.arithmetic.field != field);
            of(kept.get_or_insert_with(new))
        })
    }

    /// Extends a packed subspace by choices that are wanted, and by those that they are grown from.
    pub(in crate::search) fn grow_choices(
        &mut self,
        columns: &Columns,
        packed: &[Residue],
        wanted: impl Iterator<Item = usize>,
    ) {
        let choices = columns.growth.len();
        self.needed.clear();
        self.needed.resize(choices, false);
        wanted.for_each(|choice| self.needed[choice] = true);
        for g in columns.growth.iter().rev() {
            if let Some(from) = g.from.filter(|_| self.needed[g.choice]) {
                self.needed[from] = true;
            }
        }
        self.places.clear();
        self.places.resize(choices, choices);
        self.grown.resize(choices + 1, Rows::default());
        let Columns { width, places, .. } = columns;
        self.grown[choices].unpack_spread(&mut self.arithmetic, *width, places, packed);
        for g in columns.growth.iter().filter(|g| self.needed[g.choice]) {
            let mut place = g.from.map_or(choices, |from| self.places[from]);
            for row in &g.more {
                self.vector.clone_from(row);
                let Some(pivot) =
                    self.grown[place].reduce_vector(self.arithmetic.field, &mut self.vector)
                else {
                    continue;
                };
                if place != g.choice {
                    let mut rows = std::mem::take(&mut self.grown[g.choice]);
                    rows.clone_from(&self.grown[place]);
                    self.grown[g.choice] = rows;
                    place = g.choice;
                }
                self.grown[place].insert_reduced(
                    &mut self.arithmetic,
                    &mut self.vector,
                    pivot,
                    columns.closing,
                );
            }
            self.places[g.choice] = place;
        }
    }

    /// Returns a subspace extended by a choice that was wanted. Rows that start in the coordinates that close are not reduced.
    pub(in crate::search) fn rows_of(&self, choice: usize) -> &Rows {
        &self.grown[self.places[choice]]
    }

    /// Appends the children of a packed subspace for some choices, ascending.
    fn append_children(
        &mut self,
        columns: &Columns,
        packed: &[Residue],
        wanted: impl Iterator<Item = usize> + Clone,
        out: &mut Children,
    ) {
        self.grow_choices(columns, packed, wanted.clone());
        self.children.clear();
        self.children.resize(self.grown.len(), None);
        for choice in wanted {
            let rows = &self.grown[self.places[choice]];
            let child = self.children[self.places[choice]].get_or_insert_with(|| {
                // A motion that closes every contour and moves a kept link.
                (!rows.starts_behind(columns.contours)).then(|| {
                    let start = out.data.len();
                    rows.pack_beyond(columns.closing, &mut out.data);
                    Child {
                        hash: hash_words(out.data[start..].iter().copied()),
                        start,
                        end: out.data.len(),
                        rank: to_u16(rows.rank()),
                        closed: to_u16(rows.rank_before(columns.closing)),
                    }
                })
            });
            out.found.push(*child);
        }
    }
}

fn to_u16(dimension: usize) -> u16 {
    u16::try_from(dimension).expect("subspaces are narrow")
}
