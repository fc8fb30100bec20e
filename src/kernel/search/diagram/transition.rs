//! One transition of the diagram: a node's matrix carried over the joints of a variable, for each of its choices.
//!
//! Everything here works on flat scratch space that a thread keeps, in a field with a memory of inverses.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::adding::Adding;
use crate::search::diagram::choice_inclusion::Grown;
use crate::search::diagram::frontier::Step;
use crate::search::diagram::output_motion::Lookahead;
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::{Limits, Spent};
use crate::search::diagram::stage::{Collapse, Stage};
use crate::search::diagram::state_copies::{Held, Lane};
use crate::search::question::space::Space;

/// A child: its hash, the redundancy spent, and where its matrix starts and ends.
pub(in crate::search) type Child = (u64, Spent, usize, usize);

/// The children of some consecutive nodes, before equal ones are merged.
pub(in crate::search) struct Children {
    /// Choices a node has.
    pub(in crate::search) choices: usize,
    /// The children in order of (node, choice); `None` if dead.
    pub(in crate::search) found: Vec<Option<Child>>,
    pub(in crate::search) data: Vec<Residue>,
    /// Whether some were left out for want of memory.
    pub(in crate::search) short: bool,
}

impl Children {
    /// None yet, of nodes with so many choices.
    pub(in crate::search) fn new(choices: usize) -> Self {
        Children {
            choices,
            found: Vec::new(),
            data: Vec::new(),
            short: false,
        }
    }

    /// None again.
    pub(in crate::search) fn clear(&mut self) {
        self.found.clear();
        self.data.clear();
    }

    /// Takes a child, `times` in a row.
    fn take(&mut self, matrix: &[Residue], spent: Spent, times: usize) {
        let start = self.data.len();
        if self.data.try_reserve(matrix.len()).is_err() {
            self.short = true;
            self.found.resize(self.found.len() + times, None);
            return;
        }
        self.data.extend_from_slice(matrix);
        let child = (hash(matrix, &spent), spent, start, self.data.len());
        self.found.resize(self.found.len() + times, Some(child));
    }
}

/// A stage, with how it carries a node on.
#[derive(Clone, Copy)]
pub(in crate::search) struct GrownStage<'a> {
    pub(in crate::search) stage: &'a Stage,
    /// See [`crate::search::diagram::choice_inclusion`].
    pub(in crate::search) growth: &'a [Grown],
}

/// Scratch space of one thread.
pub(in crate::search) struct Worker {
    arithmetic: Arithmetic,
    dim: usize,
    /// Images of a node's rows under the step.
    base: Rows,
    /// Those, with the joint's twists.
    work: Rows,
    /// Images of a node's rows under a lookahead.
    kept: Rows,
    /// Motions that go wrong, without their wrong twists.
    rest: Rows,
    /// The node carried over the stage's one joint, for each of its choices.
    grown: Vec<Rows>,
    vector: Vec<Residue>,
    twist: Vec<Residue>,
}

impl Worker {
    pub(in crate::search) fn new(field: Field, dim: usize) -> Self {
        Worker {
            arithmetic: Arithmetic::new(field),
            dim,
            base: Rows::default(),
            work: Rows::default(),
            kept: Rows::default(),
            rest: Rows::default(),
            grown: Vec::new(),
            vector: Vec::new(),
            twist: Vec::new(),
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

    /// Adds a joint's twists to the rows in `base`; the result is in `work`.
    fn join(&mut self, step: &Step, span: &[Vec<Residue>]) {
        self.work.clone_from(&self.base);
        for twist in span {
            step.image(self.arithmetic.field, self.dim, twist, &mut self.vector);
            self.work.insert(&mut self.arithmetic, &mut self.vector);
        }
    }

    /// Carries the rows in `base` over a stage's one joint, for each of its choices.
    fn grow(&mut self, growth: &[Grown]) {
        self.grown.resize(growth.len(), Rows::default());
        for g in growth {
            let mut rows = std::mem::take(&mut self.grown[g.choice]);
            rows.clone_from(g.from.map_or(&self.base, |from| &self.grown[from]));
            for row in &g.more {
                self.vector.clone_from(row);
                rows.insert(&mut self.arithmetic, &mut self.vector);
            }
            self.grown[g.choice] = rows;
        }
    }

    /// Ends a step: drops the gaps of `work`; returns the redundancy.
    fn close(&mut self, step: &Step) -> u32 {
        let (d, gaps) = (self.dim, usize::from(step.closing) + step.coupled);
        let directions = if step.closing { d } else { 0 } + step.coupled;
        self.drop_gap(gaps * d, directions)
    }

    /// Drops the first coordinates of `work`, a gap of so many directions; returns the redundancy.
    fn drop_gap(&mut self, gap: usize, directions: usize) -> u32 {
        if gap == 0 {
            return 0;
        }
        // Rows that bridge a gap are motions the contour forbids; directions that no row bridges are redundant.
        let bridged = self.work.rank_before(gap);
        self.work.drop_first(gap);
        u32::try_from(directions - bridged).expect("few directions")
    }

    /// All children of a node, in order of choices.
    pub(in crate::search) fn children(
        &mut self,
        space: &Space,
        over: GrownStage<'_>,
        matrix: &[Residue],
        spent: &Spent,
        limits: &Limits,
        out: &mut Children,
    ) {
        let GrownStage { stage, growth } = over;
        let choices = &space.variables[stage.variable].choices;
        let Some((first, rest)) = stage.moves.split_first() else {
            // The variable does not matter here: every choice leads to the same node.
            out.take(matrix, spent.clone(), choices.len());
            return;
        };
        if stage.copies > 1 {
            let width = first.step.old_width * self.dim / stage.copies;
            self.begin(&first.step, &side_by_side(matrix, width, stage.copies));
        } else {
            self.begin(&first.step, matrix);
        }
        let base = (!rest.is_empty()).then(|| self.base.clone());
        self.grow(growth);
        for (number, choice) in choices.iter().enumerate() {
            if let Some(base) = &base {
                self.base.clone_from(base);
            }
            let mut now = spent.clone();
            for (i, joined) in stage.moves.iter().enumerate() {
                if i > 0 {
                    let old = std::mem::take(&mut self.work.data);
                    self.begin(&joined.step, &old);
                }
                let span = joined.span(choice);
                match self.grown.get(number) {
                    Some(rows) if !growth.is_empty() => self.work.clone_from(rows),
                    _ => self.join(&joined.step, span.unwrap_or_default()),
                }
                let redundant = self.close(&joined.step);
                match (span, joined.lane) {
                    (None, Lane::Friction(face)) => now.rule_out(face),
                    (_, lane) => now.add(lane, redundant),
                }
            }
            if !now.within(limits) {
                out.found.push(None);
                continue;
            }
            if let Some(held) = &stage.ending {
                now.settle();
                if !self.holds(held) || !now.harms_within(limits) {
                    out.found.push(None);
                    continue;
                }
                // Nothing comes after it.
                self.work.data.clear();
            }
            if let Some(collapse) = &stage.collapse {
                self.collapse(collapse);
            }
            out.take(&self.work.data, now, 1);
        }
    }

    /// All children of a node of the space dual to self-stresses, in order of choices.
    pub(in crate::search) fn children_added(
        &mut self,
        stage: &Adding,
        matrix: &[Residue],
        spent: &Spent,
        limits: &Limits,
        out: &mut Children,
    ) {
        let (f, places) = (self.arithmetic.field, &stage.places);
        self.base.spread(f, stage.width, places, matrix);
        self.grow(&stage.growth);
        for choice in 0..stage.growth.len() {
            self.work.clone_from(&self.grown[choice]);
            // A pivot there is a motion that closes every contour and moves a kept link.
            let goes_wrong = self
                .work
                .pivots
                .last()
                .is_some_and(|&p| p >= stage.contours.len());
            let mut now = spent.clone();
            now.add(Lane::Common, self.drop_gap(stage.gap, stage.gap));
            if goes_wrong || !now.within(limits) {
                out.found.push(None);
                continue;
            }
            if let Some(folding) = &stage.folding {
                self.collapse(&folding.collapse);
                self.work.drop_empty(&folding.dropped);
            }
            self.work.packed(&mut self.vector);
            out.take(&self.vector, now, 1);
        }
    }

    /// Whether each link of a list moves with one of those that may hold it in all motions of `work`.
    fn holds(&self, held: &Held) -> bool {
        let d = self.dim;
        let together = |row: &[Residue], a: Option<usize>, b: Option<usize>| {
            let at = |place: Option<usize>, i: usize| place.map_or(0, |p| row[p * d + i]);
            (0..d).all(|i| at(a, i) == at(b, i))
        };
        let rows = self.work.data.chunks_exact(self.work.width.max(1));
        held.iter().all(|(link, by)| {
            let mut by = by.iter();
            by.any(|b| rows.clone().all(|row| together(row, *link, *b)))
        })
    }

    /// Brings `work` into the form that [`Collapse`] describes.
    fn collapse(&mut self, collapse: &Collapse) {
        let (f, width) = (self.arithmetic.field, self.work.width);
        let Collapse {
            places,
            present,
            fixed,
            open,
            silent,
        } = collapse;
        // What is wrong about each row.
        let size = places.len();
        self.twist.clear();
        for row in self.work.data.chunks_exact(width.max(1)) {
            let start = self.twist.len();
            self.twist.extend(places.iter().map(|&p| row[p]));
            let twist = &mut self.twist[start..];
            for (known, &p) in present.iter().zip(fixed) {
                f.subtract_multiple(&mut twist[p..], &known[p..]);
            }
        }
        if self.twist.iter().all(|&x| x == 0) {
            return;
        }
        // Rows with that in front.
        self.kept.clear(open.len() + width);
        let rows = self.work.data.chunks_exact(width.max(1));
        for (row, twist) in rows.zip(self.twist.chunks_exact(size)) {
            self.vector.clear();
            self.vector.extend(open.iter().map(|&i| twist[i]));
            self.vector.extend_from_slice(row);
            self.kept.insert(&mut self.arithmetic, &mut self.vector);
        }
        let wrong = self.kept.pivots.partition_point(|&p| p < open.len());
        // The motions that go wrong, without their wrong twists, modulo those that do not.
        self.rest.clear(width);
        self.work.clear(width);
        for row in self.kept.data.chunks_exact(self.kept.width).skip(wrong) {
            self.vector.clear();
            self.vector.extend_from_slice(&row[open.len()..]);
            self.work.insert(&mut self.arithmetic, &mut self.vector);
        }
        for row in self.kept.data.chunks_exact(self.kept.width).take(wrong) {
            self.vector.clear();
            self.vector.extend_from_slice(&row[open.len()..]);
            silent.iter().for_each(|&p| self.vector[p] = 0);
            self.rest.insert(&mut self.arithmetic, &mut self.vector);
        }
        // Each goes wrong in a way of its own; so do motions of the finished links alone.
        for i in 0..wrong {
            self.vector.clear();
            match self.rest.data.chunks_exact(width).nth(i) {
                Some(row) => self.vector.extend_from_slice(row),
                None => self.vector.resize(width, 0),
            }
            self.vector[places[open[i]]] = f.one();
            self.work.insert(&mut self.arithmetic, &mut self.vector);
        }
    }

    /// Whether a node may still keep the motions that must be kept.
    pub(in crate::search) fn passes(&mut self, test: &Lookahead, matrix: &[Residue]) -> bool {
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

/// Some copies of a space, each in coordinates of its own.
fn side_by_side(matrix: &[Residue], width: usize, copies: usize) -> Vec<Residue> {
    let mut out = Vec::with_capacity(matrix.len() * copies * copies);
    for copy in 0..copies {
        for row in matrix.chunks_exact(width.max(1)) {
            let at = out.len() + copy * width;
            out.resize(out.len() + copies * width, 0);
            out[at..at + width].copy_from_slice(row);
        }
    }
    out
}

/// A fixed hash: the same on every machine and run, so that nothing depends on a random seed.
fn hash(matrix: &[Residue], spent: &Spent) -> u64 {
    let mut h = 0x517c_c1b7_2722_0a95_u64;
    for x in spent.words().chain(matrix.iter().copied()) {
        let wide = u128::from(h ^ x) * 0x9e37_79b9_7f4a_7c15_u128;
        h = (wide >> 64) as u64 ^ wide as u64;
    }
    h
}
