//! Which halves together span the space dual to self-stresses.
//!
//! What the variables of the front half add is known within what those of the back half reach. Variants have no redundant constraint
//! where it spans, with what choices of the back half add, all coordinates of contours that are reached there, and keep the motion of
//! kept links where nothing of both together is in the coordinates of these alone. Nodes of the back half need no space for that: what
//! the choices on one way to each add will do, and ways that begin alike are looked at together.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::build::completing_sets::{Set, completed};
use crate::search::build::path_tree::{PathTree, Vectors, numbered, shortest};
use crate::search::build::self_stress::{Added, space};
use crate::search::build::spanning_paths::{Annihilator, completing};
use crate::search::diagram::Layer;
use crate::search::diagram::adding::{Adding, adding};
use crate::search::diagram::layer::Nodes;
use crate::search::diagram::reduced_rows::Rows;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::question::Question;
use crate::search::reduce::plane_split::Model;
use crate::search::reduce::self_stress_space::SelfStressSpace;

/// Motions of kept links are told by one sum of their coordinates, each times a power of this: for one that is not nothing it is
/// nothing as seldom as a number that is not nothing has the residue of nothing.
const WEIGHT: i64 = 0x1e37_79b9_7f4a_7c15;

/// A question in the space dual to self-stresses, from both ends.
pub(in crate::search) struct Halves<'a> {
    field: Field,
    pub(in crate::search) limits: &'a Limits,
    /// Redundant constraints that every variant has.
    pub(in crate::search) already: u32,
    /// Coordinates of contours before each variable, and none after the last; then those of kept links.
    contours: Vec<usize>,
    kept: usize,
    /// Where each part starts, and the number of variables at the end.
    starts: Vec<usize>,
    /// The stages of each part, between which nothing is carried on, from the front and from the back.
    pub(in crate::search) parts: Vec<[Vec<Added<'a>>; 2]>,
}

impl<'a> Halves<'a> {
    /// Of the variables in an order; none where a choice lacks a motion of its present joint, or where it is not the case that
    /// just the redundant constraints are allowed which all variants have.
    pub(in crate::search) fn new(
        question: &Question,
        model: &Model,
        order: &[usize],
        limits: &'a Limits,
        keep_output: bool,
    ) -> Option<Self> {
        let field = question.exact.field();
        let front = space(question, model, order, keep_output)?;
        let already = limits.already.saturating_add(front.lasting);
        if already != limits.internal {
            return None;
        }
        let reversed: Vec<usize> = order.iter().rev().copied().collect();
        let orders = [order, &reversed];
        let spaces = [front, space(question, model, &reversed, keep_output)?];
        let all = order.len();
        let shared = |t: &usize| shared(&spaces, *t, all - t);
        let mut starts: Vec<usize> = (0..all).filter(|t| shared(t) == 0).collect();
        starts.push(all);
        let stages = [0, 1].map(|end| adding(field, orders[end], &spaces[end]));
        let parts = starts.windows(2).map(|at| {
            let ranges = [at[0]..at[1], all - at[1]..all - at[0]];
            [0, 1].map(|end| {
                let part = stages[end][ranges[end].clone()].iter().cloned();
                // Halves meet in what the kept links do, however wrong.
                let added = part.map(|stage| {
                    let collapse = None;
                    Added::new(field, Adding { collapse, ..stage }, limits)
                });
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
            kept: front.kept,
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
        let at = MeetingPlace {
            first: self.contours[self.starts[part]],
            reached: self.contours[self.starts[part + 1] - back.len()],
            later: self.contours[self.starts[part + 1]],
        };
        let [stages, _] = &self.parts[part];
        let (before, behind) = stages.split_at(stages.len() - back.len());
        let both = Annihilator::new(f, at.both(f, before), at.reached - at.later);
        let dimension = both.pivots.len();
        let weights: Vec<Residue> = (0..self.kept)
            .map(|i| f.pow(f.from_i64(WEIGHT), i as u64))
            .collect();
        let shared = |row: &[Residue]| -> Vec<Residue> {
            let kept = &row[at.reached - at.later..];
            let contours = both.pivots.iter().map(|&p| row[p]);
            contours.chain([f.dot(&weights, kept)]).collect()
        };
        let mut vectors = Vectors {
            field: f,
            beyond: both.open.len(),
            all: Vec::new(),
        };
        let behind = behind.iter().rev().map(|stage| {
            numbered(stage.growth(), |row| {
                let row = at.within(stage.contours(), row);
                let mut vector = both.images(std::iter::once(&row[..]));
                vector.extend(shared(&row));
                vectors.all.push(vector);
                vectors.all.len() - 1
            })
        });
        let behind: Vec<_> = behind.collect();
        let tree = PathTree::new(&vectors, &shortest(back, &behind));
        let bases = tree.of_bases(f);
        let tree = if bases.size() < tree.size() {
            bases
        } else {
            tree
        };
        let of_node = |node: usize| {
            let mut rows = Rows::default();
            rows.unpack(f, at.reached + self.kept, nodes.matrix(node));
            let rows = rows.rows().map(|row| shared(&at.within(at.reached, row)));
            let left = Annihilator::new(f, rows, dimension + 1);
            completing(&tree, &left, self.kept > 0)
        };
        completed(nodes.len(), of_node, cancelled, told)
    }
}

/// Coordinates of contours that are reached from the start of a part on, from where its halves meet, and from its end.
struct MeetingPlace {
    first: usize,
    reached: usize,
    later: usize,
}

impl MeetingPlace {
    /// A vector with so many coordinates of contours, of which some may come after the part, in those that are reached where halves meet.
    fn within(&self, contours: usize, row: &[Residue]) -> Vec<Residue> {
        let (own, kept) = row.split_at(contours);
        let mut out = vec![0; self.reached - contours];
        out.extend_from_slice(&own[..contours - self.later]);
        out.extend_from_slice(kept);
        out
    }

    /// Vectors that span what both halves reach of contours.
    fn both(&self, field: Field, front: &[Added<'_>]) -> Vec<Vec<Residue>> {
        let mut span = Echelon::new(field);
        for stage in front {
            let contours = stage.contours();
            for row in stage.growth().iter().flat_map(|g| &g.more) {
                let mut whole = vec![0; self.first - contours];
                whole.extend_from_slice(&row[..contours - self.later]);
                span.insert(&whole);
            }
        }
        let ahead = self.first - self.reached;
        let rows = span.reduced().into_iter().zip(span.pivots());
        let reached = rows.filter(|(_, pivot)| *pivot >= ahead);
        reached.map(|(mut row, _)| row.split_off(ahead)).collect()
    }
}

/// Dimension of the space of contours that both the first variables and the others reach, after so many of the front and of the back.
fn shared([front, back]: &[SelfStressSpace; 2], taken: usize, of_back: usize) -> usize {
    front.contours[taken] + back.contours[of_back] - front.contours[0]
}
