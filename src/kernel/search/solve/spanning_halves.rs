//! Pairs of half-diagrams that together span the dual of the self-stress space.
//!
//! Each half adds vectors in the coordinates that both halves reach. A variant has no redundant constraint if both halves
//! together span all coordinates of contours. It keeps the motion of kept links if no combination of both lies only in the
//! coordinates of kept links.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::layer::Nodes;
use crate::search::diagram::node_sets::{
    Numbered, Set, add_node, completing_sets, empty_set, nodes_in,
};
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::Stage;
use crate::search::diagram::within::Within;
use crate::search::diagram::{DEAD, Diagram, ShouldCancel};
use crate::search::question::Question;
use crate::search::reduce::lifetimes::Lifetime;
use crate::search::reduce::self_stress_space::SelfStressSpace;
use crate::search::solve::matching_halves::{Grouped, count_lookups, match_halves};
use crate::search::solve::self_stress::{Wanted, flat_stages, self_stress_space};
use crate::search::solve::spanning_pairs::{Bases, WalkMemory, ZeroForms};

/// Lookups of nodes that take about as long as a pair of them.
const A_PAIR: usize = 5;
/// Base of the checksum of the motions of kept links: the sum of their coordinates, each times a power of this. A nonzero
/// motion has the sum zero as rarely as a nonzero number has the residue zero.
const WEIGHT: i64 = 0x1e37_79b9_7f4a_7c15;

/// Pairs of nodes tried at most, for each node of the budget.
const PAIRS: usize = 500;

/// The nodes of both halves of a part, where they meet.
pub(in crate::search) struct JoinedSides<'a> {
    pub(in crate::search) front: &'a Nodes,
    pub(in crate::search) back: &'a Nodes,
    /// Number of stages of the back half.
    pub(in crate::search) stages: usize,
    /// Nodes of the front, and those of the back that may complete them. Others do not.
    pub(in crate::search) groups: Vec<[Vec<usize>; 2]>,
    /// Whether both span all coordinates of contours together, as in a known diagram.
    pub(in crate::search) spanned: bool,
    /// Bytes that the sets may take.
    pub(in crate::search) bytes: usize,
}

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
    /// A diagram that has all wanted variants, in the same order.
    known: Option<&'a Diagram>,
    /// The stages of each part, between which nothing is carried on, from the front and from the back.
    pub(in crate::search) parts: Vec<[Vec<Stage<'a>>; 2]>,
}

impl<'a> Halves<'a> {
    /// Returns the halves for the variables in an order; `None` if more redundant constraints are allowed than every variant has.
    pub(in crate::search) fn new(
        question: &Question,
        order: &[usize],
        limits: &'a Limits,
        wanted: Wanted<'a>,
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
            flat_stages(field, order, &front, limits),
            flat_stages(field, &reversed, &back, limits),
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
            known: wanted.known(),
        })
    }

    /// Returns the two ends of a part in the known diagram. Returns `None` if no diagram is known, or if it does not have one node before the
    /// part and one after it.
    pub(in crate::search) fn within_known(&self, part: usize) -> Option<[Within<'a>; 2]> {
        let known = self.known?;
        let (from, to) = (self.starts[part], self.starts[part + 1]);
        let nodes_at = |at: usize| {
            known
                .layers
                .get(at)
                .map_or(known.terminals.len(), |l| l.nodes)
        };
        let layers = &known.layers[from..to];
        (nodes_at(from) == 1 && nodes_at(to) == 1)
            .then(|| [true, false].map(|forward| Within::new(layers, 1, forward)))
    }

    /// Returns for each node of the front half of a part the number of the set of nodes of the back half that complete it, or [`DEAD`].
    /// Also returns the different sets. Returns `None` if there are too many pairs, if the sets take too many bytes, or if cancelled.
    ///
    /// # Complexity
    /// O(s³) field operations for each node, for s self-stresses that both halves reach; and that of [`match_halves`], or that of
    /// [`Bases::completing_nodes`] for each node of the front.
    pub(in crate::search) fn join_halves(
        &self,
        part: usize,
        halves: &JoinedSides<'_>,
        cancelled: ShouldCancel<'_>,
    ) -> Option<(Vec<u32>, Vec<Set>)> {
        let packed = self.meeting_rows(part, halves.stages);
        let width = packed.width();
        let rows_of_front = |node| {
            let nodes = halves.front;
            packed.rows_of(0, nodes, node, &mut Arithmetic::new(self.field))
        };
        let back: Vec<_> = packed.all_rows(1, halves.back).collect();
        let pairs = halves
            .groups
            .iter()
            .map(|[f, b]| f.len().saturating_mul(b.len()));
        let pairs = pairs.fold(0, usize::saturating_add);
        let grouped = self.keeps.then(|| {
            [
                Grouped::group_nodes(packed.all_rows(0, halves.front)),
                Grouped::group_nodes(back.iter().cloned()),
            ]
        });
        let fewer = |[front, back]: &[Grouped; 2]| count_lookups(front, back) / A_PAIR < pairs;
        if let Some(grouped) = grouped.filter(fewer) {
            return match_halves(self.field, width - 1, &grouped, halves.bytes, cancelled);
        }
        // Each node of the front may have a set with a bit for each node of the back.
        let bits = halves.front.len().saturating_mul(halves.back.len());
        if pairs / PAIRS > self.limits.nodes || bits / 8 > halves.bytes {
            return None;
        }
        let mut of_node = vec![DEAD; halves.front.len()];
        let mut numbered = Numbered::default();
        for [fronts, backs] in &halves.groups {
            let rows = backs.iter().map(|&node| &back[node][..]);
            let bases = Bases::new(self.field, rows, self.keeps, halves.spanned);
            let completing = |n: usize| {
                let forms = ZeroForms::new(self.field, &rows_of_front(fronts[n]), width);
                let own = bases.completing_nodes(&forms, &mut WalkMemory::default());
                let mut set = empty_set(back.len());
                nodes_in(&own).for_each(|node| add_node(&mut set, backs[node]));
                set
            };
            let sets = completing_sets(fronts.len(), completing, cancelled)?;
            for (&node, set) in fronts.iter().zip(sets) {
                of_node[node] = numbered.number_of(set);
            }
        }
        Some((of_node, numbered.all))
    }

    /// Returns how the rows of nodes are read where the halves of a part meet, with the last `stages` stages in the back half.
    pub(in crate::search) fn meeting_rows(&self, part: usize, stages: usize) -> PackedRows {
        let meeting = self.starts[part + 1] - stages;
        let is_live = |c: &usize| self.contours[*c].is_live_before(meeting);
        let live: Vec<usize> = (0..self.contours.len()).filter(is_live).collect();
        let turned: Vec<usize> = self.turned.iter().copied().filter(is_live).collect();
        let place = |c: &usize| live.iter().position(|x| x == c);
        let mut places: Vec<usize> = turned.iter().filter_map(place).collect();
        places.extend(self.keeps.then_some(live.len()));
        PackedRows {
            field: self.field,
            width: live.len() + 1,
            places: [(0..places.len()).collect(), places],
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
    width: usize,
    /// The coordinate of each packed number of the front and of the back.
    places: [Vec<usize>; 2],
}

impl PackedRows {
    /// Returns the number of coordinates of contours that both halves reach, and one of kept links.
    pub(in crate::search) fn width(&self) -> usize {
        self.width
    }

    /// Returns the rows of a node of the front, or of the back if `end` is 1, as a reduced basis. They have a number of kept links behind the
    /// coordinates of contours: 0 if vectors have none.
    fn rows_of(
        &self,
        end: usize,
        nodes: &Nodes,
        node: usize,
        arithmetic: &mut Arithmetic,
    ) -> Vec<Vec<Residue>> {
        let (places, mut rows) = (&self.places[end], Rows::default());
        rows.unpack_spread(arithmetic, places.len(), places, nodes.packed_rows(node));
        let widened = rows.rows().map(|row| {
            let mut out = vec![0; self.width];
            out[..row.len()].copy_from_slice(row);
            out
        });
        widened.collect()
    }

    /// Returns the rows of all nodes of an end.
    pub(in crate::search) fn all_rows(
        &self,
        end: usize,
        nodes: &Nodes,
    ) -> impl Iterator<Item = Vec<Vec<Residue>>> {
        let mut arithmetic = Arithmetic::new(self.field);
        (0..nodes.len()).map(move |node| self.rows_of(end, nodes, node, &mut arithmetic))
    }
}
