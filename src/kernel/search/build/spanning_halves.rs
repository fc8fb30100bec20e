//! Which halves together span the space dual to self-stresses.
//!
//! What the variables of the front half add is known within what those of the back half reach. Variants have no redundant constraint
//! where it spans, with what choices of the back half add, all coordinates of contours that are reached there, and keep the motion of
//! kept links where nothing of both together is in the coordinates of these alone. Nodes of the back half need no space for that: what
//! the choices on one way to each add will do, and ways that begin alike are looked at together.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::build::completing_sets::{Numbered, Set, completed};
use crate::search::build::matching_halves::{Grouped, lookups, matched};
use crate::search::build::path_tree::{PathTree, Vectors, numbered, shortest};
use crate::search::build::self_stress::{Added, Wanted, adding, space};
use crate::search::build::spanning_paths::{Annihilator, completing};
use crate::search::diagram::Layer;
use crate::search::diagram::layer::Nodes;
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::question::Question;
use crate::search::reduce::lifetimes::Lifetime;
use crate::search::reduce::self_stress_space::SelfStressSpace;
use std::collections::BTreeSet;

/// Lookups of nodes that take about as long as a pair of them.
const A_PAIR: usize = 5;
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
    /// Whether vectors have a number for the motion of kept links behind the coordinates of contours.
    keeps: bool,
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
        let told = |order: &[usize]| told_by_one_number(field, space(question, order, wanted));
        let front = told(order);
        let already = limits.already.saturating_add(front.lasting);
        if already != limits.internal {
            return None;
        }
        let reversed: Vec<usize> = order.iter().rev().copied().collect();
        let orders = [order, &reversed];
        let spaces = [front, told(&reversed)];
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
            keeps: !front.kept.is_empty(),
            contours: front.contours,
            starts,
            parts,
        })
    }

    /// Returns how the nodes of the front half of a part meet those of the back half, that layers from the back lead to.
    ///
    /// # Complexity
    /// O(s³) field operations for each node, for s self-stresses that both halves reach.
    pub(in crate::search) fn meeting(&self, part: usize, nodes: &Nodes, back: &[Layer]) -> Meeting {
        let f = self.field;
        let behind = self.behind(part, back.len());
        let paths = PathTree::new(&behind.vectors, &shortest(back, &behind.added));
        let bases = paths.bases(f);
        let tree = PathTree::of_bases(f, &bases);
        let pairs = nodes.len().saturating_mul(bases.len());
        let grouped = self.keeps.then(|| {
            let mut grouped = [Grouped::default(), Grouped::default()];
            (0..nodes.len()).for_each(|n| grouped[0].take(n, behind.rows(nodes.matrix(n))));
            let bases = bases.into_iter().enumerate();
            bases.for_each(|(n, rows)| grouped[1].take(n, rows));
            grouped
        });
        Meeting {
            tree: if tree.size() < paths.size() {
                tree
            } else {
                paths
            },
            grouped: grouped.filter(|[front, back]| lookups(front, back) / A_PAIR < pairs),
            behind,
            pairs,
        }
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
                let kept = kept.first().copied().unwrap_or(0);
                vectors.all.push(all.chain([kept]).collect());
                vectors.all.len() - 1
            })
        });
        Behind {
            added: added.collect(),
            vectors,
            live: live.len(),
            keeps: self.keeps,
        }
    }
}

/// Returns a space with one number for the motion of kept links in place of its coordinates.
fn told_by_one_number(field: Field, mut space: SelfStressSpace) -> SelfStressSpace {
    let (contours, kept) = (space.contours.len(), space.kept.len());
    let weight = field.from_i64(WEIGHT);
    let weights: Vec<Residue> = (0..kept).map(|i| field.pow(weight, i as u64)).collect();
    for choice in space.added.iter_mut().flatten().filter(|_| kept > 0) {
        for vector in &mut *choice {
            let number = field.dot(&weights, &vector[contours..]);
            vector.truncate(contours);
            vector.push(number);
        }
        *choice = Echelon::of(field, &*choice).reduced();
    }
    space.kept.truncate(1);
    space
}

/// What the last stages of a part add, in the coordinates of contours that the stages before them do not reach, then in those that they
/// reach, and in one of kept links.
pub(in crate::search) struct Behind {
    vectors: Vectors,
    /// What the choices of each stage add, as the numbers of vectors, from the last stage on.
    added: Vec<Vec<Vec<usize>>>,
    /// Coordinates of contours that the stages before reach, too.
    pub(in crate::search) live: usize,
    /// Whether vectors have a number for the motion of kept links.
    keeps: bool,
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
        let width = self.live + usize::from(self.keeps);
        rows.unpack(arithmetic, width, matrix);
    }

    /// Returns the same with a number for kept links, 0 if vectors have none.
    fn rows(&self, matrix: &[Residue]) -> Vec<Vec<Residue>> {
        let mut rows = Rows::default();
        self.unpacked(&mut Arithmetic::new(self.vectors.field), matrix, &mut rows);
        let widened = rows.rows().map(|row| {
            let mut row = row.to_vec();
            row.resize(self.live + 1, 0);
            row
        });
        widened.collect()
    }
}

/// How the nodes of both halves of a part meet.
pub(in crate::search) struct Meeting {
    behind: Behind,
    /// The paths from the back, for pairs of nodes.
    tree: PathTree,
    /// The nodes of both halves, if looking them up takes less time than comparing all pairs.
    grouped: Option<[Grouped; 2]>,
    pairs: usize,
}

impl Meeting {
    /// Returns the number of pairs of nodes to compare; 0 if nodes are looked up.
    pub(in crate::search) fn pairs(&self) -> usize {
        if self.grouped.is_some() {
            0
        } else {
            self.pairs
        }
    }

    /// Returns for each node of the front the number of the set of those of the back that complete it, or [`DEAD`], and the different
    /// sets; `None` where they take more than some bytes or where it is cancelled. `told` hears of how many that is known.
    ///
    /// # Complexity
    /// O(n·e·s²) field operations for n nodes of the front, e edges of the tree of paths to those of the back, and s self-stresses that
    /// both reach; O(n·e·s) if most edges are the last of a path; less where many nodes span the same space of contours.
    ///
    /// [`DEAD`]: crate::search::diagram::DEAD
    pub(in crate::search) fn join(
        &self,
        nodes: &Nodes,
        bytes: usize,
        cancelled: &(dyn Fn() -> bool + Sync),
        told: &mut dyn FnMut(usize),
    ) -> Option<(Vec<u32>, Vec<Set>)> {
        let (f, live) = (self.behind.vectors.field, self.behind.live);
        if let Some(grouped) = &self.grouped {
            return matched(f, live, grouped, bytes, cancelled, told);
        }
        if self.pairs / 8 > bytes {
            return None;
        }
        let of_node = |node: usize| {
            let rows = self.behind.rows(nodes.matrix(node));
            completing(
                &self.tree,
                &Annihilator::new(f, rows, live + 1),
                self.behind.keeps,
            )
        };
        let sets = completed(nodes.len(), of_node, cancelled, told)?;
        let mut numbered = Numbered::default();
        let of_node = sets.into_iter().map(|set| numbered.of(set)).collect();
        Some((of_node, numbered.all))
    }
}
