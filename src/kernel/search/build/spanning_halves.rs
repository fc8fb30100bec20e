//! Pairs of half-diagrams that together span the dual of the self-stress space.
//!
//! Each half adds vectors in the coordinates that both halves reach. A variant has no redundant constraint if both halves
//! together span all coordinates of contours. It keeps the motion of kept links if no combination of both lies only in the
//! coordinates of kept links.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::build::completing_sets::{Numbered, Set, completing_sets};
use crate::search::build::matching_halves::{Grouped, count_lookups, match_halves};
use crate::search::build::self_stress::{Wanted, flat_stages, self_stress_space};
use crate::search::build::spanning_pairs::{Bases, ZeroForms};
use crate::search::diagram::layer::Nodes;
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::Adding;
use crate::search::question::Question;
use crate::search::reduce::lifetimes::Lifetime;
use crate::search::reduce::self_stress_space::SelfStressSpace;

/// Lookups of nodes that take about as long as a pair of them.
const A_PAIR: usize = 5;
/// Base of the checksum of the motions of kept links: the sum of their coordinates, each times a power of this. A nonzero
/// motion has the sum zero as rarely as a nonzero number has the residue zero.
const WEIGHT: i64 = 0x1e37_79b9_7f4a_7c15;

/// A question in the space dual to self-stresses, from both ends.
pub(in crate::search) struct Halves<'a> {
    pub(in crate::search) field: Field,
    pub(in crate::search) limits: &'a Limits,
    /// Redundant constraints that every variant has.
    pub(in crate::search) already: u32,
    /// The lifetimes of the coordinates of contours from the front, and their order from the back.
    contours: Vec<Lifetime>,
    turned: Vec<usize>,
    /// Whether vectors have a number for the motion of kept links behind the coordinates of contours.
    keeps: bool,
    /// The start of each part, and at the end the number of variables.
    starts: Vec<usize>,
    /// The stages of each part, between which nothing is carried on, from the front and from the back.
    pub(in crate::search) parts: Vec<[Vec<Adding>; 2]>,
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
        let front = known_by_one_number(field, self_stress_space(question, order, wanted));
        let already = front.lasting;
        if already != limits.internal {
            return None;
        }
        let all = order.len();
        let carried = |t: usize| front.contours.iter().any(|c| c.is_live_before(t));
        let mut starts: Vec<usize> = (0..all).filter(|&t| !carried(t)).collect();
        starts.push(all);
        let reversed: Vec<usize> = order.iter().rev().copied().collect();
        let (back, turned) = turn_space(&front);
        let stages = [
            flat_stages(field, order, &front),
            flat_stages(field, &reversed, &back),
        ];
        let parts = starts.windows(2).map(|at| {
            let ranges = [at[0]..at[1], all - at[1]..all - at[0]];
            [0, 1].map(|end| stages[end][ranges[end].clone()].to_vec())
        });
        Some(Halves {
            field,
            limits,
            already,
            keeps: !front.kept.is_empty(),
            turned,
            parts: parts.collect(),
            starts,
            contours: front.contours,
        })
    }

    /// Returns how the nodes of the front half of a part meet those of the back half, which consists of the last `stages` stages.
    ///
    /// # Complexity
    /// O(s³) field operations for each node, for s self-stresses that both halves reach.
    pub(in crate::search) fn meet_halves(
        &self,
        part: usize,
        [front, back]: [&Nodes; 2],
        stages: usize,
    ) -> Meeting {
        let packed = self.meeting_rows(part, stages);
        let back: Vec<_> = (0..back.len())
            .map(|node| packed.back_rows(back, node))
            .collect();
        let pairs = front.len().saturating_mul(back.len());
        let grouped = self.keeps.then(|| {
            let front = (0..front.len()).map(|node| packed.front_rows(front, node));
            [
                Grouped::group_nodes(front),
                Grouped::group_nodes(back.iter().cloned()),
            ]
        });
        let fewer = |[front, back]: &[Grouped; 2]| count_lookups(front, back) / A_PAIR < pairs;
        let nodes = match grouped.filter(fewer) {
            Some(grouped) => Compared::Grouped(grouped),
            None => Compared::Pairs(Bases::new(
                self.field,
                back.iter().map(Vec::as_slice),
                self.keeps,
            )),
        };
        Meeting {
            packed,
            pairs,
            nodes,
        }
    }

    /// Returns how the rows of nodes are read where the halves of a part meet, with the last `stages` stages in the back half.
    pub(in crate::search) fn meeting_rows(&self, part: usize, stages: usize) -> PackedRows {
        let meeting = self.starts[part + 1] - stages;
        let is_live = |c: &usize| self.contours[*c].is_live_before(meeting);
        let live: Vec<usize> = (0..self.contours.len()).filter(is_live).collect();
        let turned: Vec<usize> = self.turned.iter().copied().filter(is_live).collect();
        let place = |c: &usize| turned.iter().position(|x| x == c);
        PackedRows {
            field: self.field,
            keeps: self.keeps,
            places: live.iter().filter_map(place).collect(),
        }
    }
}

/// Returns a space with one number for the motion of kept links in place of its coordinates.
fn known_by_one_number(field: Field, mut space: SelfStressSpace) -> SelfStressSpace {
    let (contours, kept) = (space.contours.len(), space.kept.len());
    let weight = field.from_i64(WEIGHT);
    let weights: Vec<Residue> = (0..kept).map(|i| field.pow(weight, i as u64)).collect();
    for choice in space.added.iter_mut().flatten().filter(|_| kept > 0) {
        for vector in &mut *choice {
            let number = field.dot(&weights, &vector[contours..]);
            vector.truncate(contours);
            vector.push(number);
        }
        *choice = Echelon::from_vectors(field, &*choice).reduced_rows();
    }
    space.kept.truncate(1);
    space
}

/// Returns the same space for the variables from the last to the first, and which coordinate of contours stands at each place: the first
/// variable that reaches a coordinate is then its last one.
fn turn_space(space: &SelfStressSpace) -> (SelfStressSpace, Vec<usize>) {
    let last = space.added.len().saturating_sub(1);
    let turn = |c: &Lifetime| Lifetime {
        from: last - c.to,
        to: last - c.from,
    };
    let mut places: Vec<usize> = (0..space.contours.len()).collect();
    places.sort_by_key(|&c| std::cmp::Reverse(space.contours[c].from));
    let vector = |v: &Vec<Residue>| -> Vec<Residue> {
        let kept = &v[space.contours.len()..];
        places
            .iter()
            .map(|&c| v[c])
            .chain(kept.iter().copied())
            .collect()
    };
    let choice = |vectors: &Vec<Vec<Residue>>| vectors.iter().map(vector).collect();
    let added = space.added.iter().rev();
    let turned = SelfStressSpace {
        added: added
            .map(|choices| choices.iter().map(choice).collect())
            .collect(),
        contours: places.iter().map(|&c| turn(&space.contours[c])).collect(),
        kept: space.kept.iter().map(turn).collect(),
        ..*space
    };
    (turned, places)
}

/// The rows of nodes where both halves of a part meet.
pub(in crate::search) struct PackedRows {
    field: Field,
    /// Whether vectors have a number for the motion of kept links.
    keeps: bool,
    /// The place of each coordinate of contours that both halves reach, in the rows of the back.
    places: Vec<usize>,
}

impl PackedRows {
    /// Returns the number of coordinates of contours that both halves reach, and one of kept links.
    pub(in crate::search) fn width(&self) -> usize {
        self.places.len() + 1
    }

    /// Returns the rows of a node of the front, with a number of kept links behind the coordinates of contours: 0 if vectors have none.
    pub(in crate::search) fn front_rows(&self, nodes: &Nodes, node: usize) -> Vec<Vec<Residue>> {
        let packed = self.width() - usize::from(!self.keeps);
        let mut rows = Rows::default();
        rows.unpack_rows(&mut Arithmetic::new(self.field), packed, nodes.matrix(node));
        let widened = rows.rows().map(|row| {
            let mut row = row.to_vec();
            row.resize(self.width(), 0);
            row
        });
        widened.collect()
    }

    /// Returns the rows of a node of the back in the same coordinates, as a reduced basis.
    pub(in crate::search) fn back_rows(&self, nodes: &Nodes, node: usize) -> Vec<Vec<Residue>> {
        let from_back = |row: Vec<Residue>| -> Vec<Residue> {
            let own = self.places.iter().map(|&at| row[at]);
            own.chain([row[self.places.len()]]).collect()
        };
        let rows = self.front_rows(nodes, node).into_iter().map(from_back);
        Echelon::from_vectors(self.field, rows).reduced_rows()
    }
}

/// How the nodes of both halves of a part meet.
pub(in crate::search) struct Meeting {
    packed: PackedRows,
    pairs: usize,
    nodes: Compared,
}

/// The nodes of both halves if they are looked up, which takes less time if many of them span the same; otherwise those of the back half.
enum Compared {
    Grouped([Grouped; 2]),
    Pairs(Bases),
}

impl Meeting {
    /// Returns the number of pairs of nodes to compare; 0 if nodes are looked up.
    pub(in crate::search) fn count_pairs(&self) -> usize {
        match self.nodes {
            Compared::Grouped(_) => 0,
            Compared::Pairs(_) => self.pairs,
        }
    }

    /// Returns for each node of the front the number of the set of nodes of the back that complete it, or [`DEAD`]. Also
    /// returns the different sets. `None` if they take more than the given bytes, or if cancelled.
    ///
    /// # Complexity
    /// That of [`matched`] or that of [`Bases::completing`] for each node of the front.
    ///
    /// [`DEAD`]: crate::search::diagram::DEAD
    pub(in crate::search) fn join_nodes(
        &self,
        front: &Nodes,
        bytes: usize,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Option<(Vec<u32>, Vec<Set>)> {
        let (field, width) = (self.packed.field, self.packed.width());
        let back = match &self.nodes {
            Compared::Grouped(nodes) => {
                return match_halves(field, width - 1, nodes, bytes, cancelled);
            }
            Compared::Pairs(back) => back,
        };
        if self.pairs / 8 > bytes {
            return None;
        }
        let of_node = |node: usize| {
            let rows = self.packed.front_rows(front, node);
            back.completing_nodes(&ZeroForms::new(field, &rows, width))
        };
        let sets = completing_sets(front.len(), of_node, cancelled)?;
        let mut numbered = Numbered::default();
        let of_node = sets
            .into_iter()
            .map(|set| numbered.number_of(set))
            .collect();
        Some((of_node, numbered.all))
    }
}
