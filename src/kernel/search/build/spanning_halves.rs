//! Which halves together span the space dual to self-stresses.
//!
//! What the variables of the front half add is known within what those of the back half reach. Variants have no redundant constraint
//! where it spans, with what choices of the back half add, all coordinates of contours that are reached there, and keep the motion of
//! kept links where nothing of both together is in the coordinates of these alone. Nodes of the back half need no space for that: what
//! the choices on one way to each add will do, and ways that begin alike are looked at together.

use crate::linalg::modp::{Field, Residue};
use crate::search::build::completing_sets::{Set, completed};
use crate::search::build::path_tree::{PathTree, Vectors, numbered, shortest};
use crate::search::build::self_stress::{Added, Wanted, adding, space};
use crate::search::build::spanning_paths::{Annihilator, completing};
use crate::search::diagram::Layer;
use crate::search::diagram::layer::Nodes;
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::question::Question;
use crate::search::reduce::lifetimes::Lifetime;
use std::collections::BTreeSet;

/// Motions of kept links are told by one sum of their coordinates, each times a power of this: for one that is not nothing it is
/// nothing as seldom as a number that is not nothing has the residue of nothing.
const WEIGHT: i64 = 0x1e37_79b9_7f4a_7c15;

/// A question in the space dual to self-stresses, from both ends.
pub(in crate::search) struct Halves<'a> {
    pub(in crate::search) field: Field,
    pub(in crate::search) limits: &'a Limits,
    /// Redundant constraints that every variant has.
    pub(in crate::search) already: u32,
    /// When the coordinates of contours are in use, and how many there are of kept links.
    contours: Vec<Lifetime>,
    kept: usize,
    /// Where each part starts, and the number of variables at the end.
    starts: Vec<usize>,
    /// The stages of each part, between which nothing is carried on, from the front and from the back.
    pub(in crate::search) parts: Vec<[Vec<Added>; 2]>,
}

impl<'a> Halves<'a> {
    /// Returns the halves for the variables in an order; `None` if more redundant constraints are allowed than every variant has.
    pub(in crate::search) fn new(
        question: &Question,
        order: &[usize],
        limits: &'a Limits,
        wanted: Wanted,
    ) -> Option<Self> {
        let field = question.exact.field();
        let front = space(question, order, wanted);
        let already = limits.already.saturating_add(front.lasting);
        if already != limits.internal {
            return None;
        }
        let reversed: Vec<usize> = order.iter().rev().copied().collect();
        let orders = [order, &reversed];
        let spaces = [front, space(question, &reversed, wanted)];
        let all = order.len();
        let carried = |t: usize| spaces[0].contours.iter().any(|c| c.is_live_before(t));
        let mut starts: Vec<usize> = (0..all).filter(|&t| !carried(t)).collect();
        starts.push(all);
        let stages = [0, 1].map(|end| adding(field, orders[end], &spaces[end]));
        let parts = starts.windows(2).map(|at| {
            let ranges = [at[0]..at[1], all - at[1]..all - at[0]];
            [0, 1].map(|end| {
                let part = stages[end][ranges[end].clone()].iter().cloned();
                let added = part.map(|stage| Added::new(field, stage));
                added.collect()
            })
        });
        let parts = parts.collect();
        let [front, _] = spaces;
        Some(Halves {
            field,
            limits,
            already,
            contours: front.contours,
            kept: front.kept.len(),
            starts,
            parts,
        })
    }

    /// For each node of the front half of a part, which nodes of the back half, that layers from the back lead to, complete it; none
    /// where it is cancelled. `told` hears of how many that is known.
    ///
    /// # Complexity
    /// O(n·e·s²) field operations for n nodes of the front, e edges of the tree of paths to those of the back, and s self-stresses that
    /// both reach; O(n·e·s) if most edges are the last of a path.
    pub(in crate::search) fn join(
        &self,
        part: usize,
        nodes: &Nodes,
        back: &[Layer],
        cancelled: &(dyn Fn() -> bool + Sync),
        told: &mut dyn FnMut(usize),
    ) -> Option<Vec<Set>> {
        let f = self.field;
        let behind = self.behind(part, back.len());
        let tree = PathTree::new(&behind.vectors, &shortest(back, &behind.added));
        let bases = tree.of_bases(f);
        let tree = if bases.size() < tree.size() {
            bases
        } else {
            tree
        };
        let of_node = |node: usize| {
            let left = behind.left(nodes.matrix(node));
            completing(&tree, &left, self.kept > 0)
        };
        completed(nodes.len(), of_node, cancelled, told)
    }

    /// What the last stages of a part add, so many of them.
    pub(in crate::search) fn behind(&self, part: usize, stages: usize) -> Behind {
        let f = self.field;
        let [all, _] = &self.parts[part];
        let behind = &all[all.len() - stages..];
        // Coordinates that the stages before reach, and those that only these do.
        let meeting = self.starts[part + 1] - stages;
        let is_live = |&c: &usize| self.contours[c].is_live_before(meeting);
        let live: Vec<usize> = (0..self.contours.len()).filter(is_live).collect();
        let reached = behind.iter().flat_map(Added::contours).copied();
        let beyond: BTreeSet<usize> = reached.filter(|c| !is_live(c)).collect();
        let weights: Vec<Residue> = (0..self.kept)
            .map(|i| f.pow(f.from_i64(WEIGHT), i as u64))
            .collect();
        let mut vectors = Vectors {
            field: f,
            beyond: beyond.len(),
            all: Vec::new(),
        };
        let added = behind.iter().rev().map(|stage| {
            numbered(stage.growth(), |row| {
                let (own, kept) = row.split_at(stage.contours().len());
                let number = |c| stage.contours().binary_search(c).map_or(0, |at| own[at]);
                let all = beyond.iter().chain(&live).map(number);
                vectors
                    .all
                    .push(all.chain([f.dot(&weights, kept)]).collect());
                vectors.all.len() - 1
            })
        });
        Behind {
            added: added.collect(),
            vectors,
            live: live.len(),
            weights,
        }
    }
}

/// What the last stages of a part add, in the coordinates of contours that the stages before them do not reach, then in those that they
/// reach, and in one of kept links.
pub(in crate::search) struct Behind {
    vectors: Vectors,
    /// What the choices of each stage add, as the numbers of vectors, from the last stage on.
    added: Vec<Vec<Vec<usize>>>,
    /// Coordinates of contours that the stages before reach, too.
    pub(in crate::search) live: usize,
    /// Those of kept links are told by the sum of their coordinates times these.
    weights: Vec<Residue>,
}

impl Behind {
    /// What choices of the stages, from the last on, add where the stages before reach it, too, as rows with a number of kept links
    /// behind; `false` where they do not span the rest.
    pub(in crate::search) fn left_of(
        &self,
        choices: &[usize],
        arithmetic: &mut Arithmetic,
        rows: &mut Rows,
    ) -> bool {
        let Vectors { beyond, all, .. } = &self.vectors;
        rows.clear(beyond + self.live + 1);
        let added = self.added.iter().zip(choices);
        for &number in added.flat_map(|(added, &choice)| &added[choice]) {
            rows.insert(arithmetic, &mut all[number].clone());
        }
        let spans = rows.rank_before(*beyond) == *beyond;
        rows.drop_first(*beyond);
        spans
    }

    /// The rows of the matrix of a node before these stages: in the coordinates that both reach, then in those of kept links.
    pub(in crate::search) fn unpacked(
        &self,
        arithmetic: &mut Arithmetic,
        matrix: &[Residue],
        rows: &mut Rows,
    ) {
        let width = self.live + self.weights.len();
        rows.unpack(arithmetic, width, matrix);
    }

    /// What the matrix of a node before these stages leaves to be spanned.
    fn left(&self, matrix: &[Residue]) -> Annihilator {
        let f = self.vectors.field;
        let mut rows = Rows::default();
        self.unpacked(&mut Arithmetic::new(f), matrix, &mut rows);
        let rows = rows.rows().map(|row| {
            let (contours, kept) = row.split_at(self.live);
            [contours, &[f.dot(&self.weights, kept)]].concat()
        });
        Annihilator::new(f, rows, self.live + 1)
    }
}
