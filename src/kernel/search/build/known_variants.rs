//! Whether a question has the variants of a known diagram.
//!
//! A diagram that is built knows nothing of what comes later, and many of its nodes lead nowhere. Where one of the variants is known,
//! only its ways are followed: half of the variables from the front, half from the back, and where they meet, what is added there is
//! put together only at one and the same node of what is known.

use crate::linalg::exterior::{Exterior, Product};
use crate::linalg::modp::{Field, Residue};
use crate::search::build::self_stress::Added;
use crate::search::build::spanning_halves::{Behind, Halves, Ways};
use crate::search::build::staging::limits;
use crate::search::diagram::reduced_rows::Rows;
use crate::search::diagram::redundancy_so_far::Spent;
use crate::search::diagram::transition::Children;
use crate::search::diagram::{Carries, DEAD, Diagram, Layer};
use crate::search::question::Question;
use hashbrown::HashMap;
use itertools::Itertools;
use std::collections::BTreeSet;

/// Coordinates of contours that both halves reach, at most: of more there are thousands of minors.
const WIDEST: usize = 12;

/// Whether every variant of a diagram is determinate in a question without a searched state, where none has more freedoms than another
/// that it has; none where a choice lacks a motion of its present joint, where redundant constraints are allowed that not all variants
/// have, or where it takes too many nodes or minors.
///
/// # Complexity
/// O(nodes · choices · s²) field operations for s present self-stresses, of as many nodes as half of the variables add different spaces;
/// where n and m of them meet at a node O(n·m) sums of products.
pub(in crate::search) fn has_all(question: &Question, known: &Diagram) -> Option<bool> {
    if question.conditions.state.is_some() {
        return None;
    }
    let model = &question.least.whole;
    let order: Vec<usize> = known.layers.iter().map(|l| l.variable).collect();
    let limits = limits(question, model);
    let halves = Halves::new(question, model, &order, &limits, false)?;
    let spent = Spent::within_mechanism(halves.already);
    if known.terminals.iter().any(|t| *t != spent.redundancy()) {
        return Some(false);
    }
    let mut layers = &known.layers[..];
    for (part, ends) in halves.parts.iter().enumerate() {
        let (own, others) = layers.split_at(ends[0].len());
        // Nothing is carried on from part to part, so that there is one node between them.
        if others.first().map_or(known.terminals.len(), |l| l.nodes) != 1 {
            return None;
        }
        let Some([front, back]) = followed_halves(ends, own, limits.nodes, &spent)? else {
            return Some(false);
        };
        let behind = halves.behind(part, back.done);
        if behind.live > WIDEST {
            return None;
        }
        let mut completion = Completion::new(halves.field, &behind);
        for (front, back) in front.nodes.iter().zip(&back.nodes) {
            if !completion.is_whole(front, back)? {
                return Some(false);
            }
        }
        layers = others;
    }
    Some(true)
}

/// Whether ways from both ends complete each other, in memory that is used again.
struct Completion<'a> {
    exterior: Exterior,
    ways: Ways<'a>,
    product: Product,
    /// The products of all ways from the front, one after another, and that of a way from the back.
    front: Vec<Residue>,
    back: Vec<Residue>,
}

impl<'a> Completion<'a> {
    fn new(field: Field, behind: &'a Behind) -> Completion<'a> {
        Completion {
            exterior: Exterior::new(field, behind.live),
            ways: Ways::new(behind, field),
            product: Product::default(),
            front: Vec::new(),
            back: Vec::new(),
        }
    }

    /// Whether all ways to a node from the front are completed by all from the back; none where these have more than is missing.
    fn is_whole(&mut self, front: &Reached, back: &Reached) -> Option<bool> {
        let (mut ranks, mut rows) = (BTreeSet::new(), Rows::default());
        self.front.clear();
        for packed in front.keys() {
            self.ways.behind.unpacked(packed, &mut rows);
            self.exterior.product(rows.rows(), &mut self.product);
            self.front.extend_from_slice(self.product.minors());
            ranks.insert(rows.rank());
        }
        // Those that begin alike one after another.
        for path in back.values().sorted_unstable() {
            let Some(left) = self.ways.left_of(path) else {
                return Some(false);
            };
            let missing = self.exterior.width().saturating_sub(left.rank());
            match (ranks.first(), ranks.last()) {
                (_, Some(most)) if *most > missing => return None,
                (Some(least), _) if *least < missing => return Some(false),
                _ => {}
            }
            self.exterior.product(left.rows(), &mut self.product);
            let complement = self.exterior.complement(&self.product, left.rank());
            self.back.clear();
            self.back.extend(complement);
            let mut all = self.front.chunks_exact(self.back.len());
            if !all.all(|front| self.exterior.whole(front, &self.back)) {
                return Some(false);
            }
        }
        Some(true)
    }
}

/// The different spaces that ways to a known node add, packed, each with the choices on one of them.
type Reached = HashMap<Vec<Residue>, Vec<usize>>;

/// How far known ways were followed from one end.
struct FollowedHalf<'a> {
    stages: &'a [Added<'a>],
    done: usize,
    nodes: Vec<Reached>,
}

impl FollowedHalf<'_> {
    fn size(&self) -> usize {
        self.nodes.iter().map(HashMap::len).sum()
    }

    /// Follows the ways that start at each node, each a choice and one of so many nodes that it leads to; whether all go on.
    fn advance(
        &mut self,
        ways: &[Vec<(usize, usize)>],
        choices: usize,
        to: usize,
        spent: &Spent,
    ) -> bool {
        let stage = &self.stages[self.done];
        let mut worker = stage.worker();
        let mut next = vec![Reached::new(); to];
        let mut children = Children::new(choices);
        for (reached, ways) in self.nodes.iter().zip(ways) {
            for (space, path) in reached {
                children.clear();
                stage.children(&mut worker, space, spent, &mut children);
                for &(choice, to) in ways {
                    let Some((_, _, start, end)) = children.found[choice] else {
                        return false;
                    };
                    let path = || [&path[..], &[choice]].concat();
                    let known = next[to].entry_ref(&children.data[start..end]);
                    known.or_insert_with(path);
                }
            }
        }
        (self.nodes, self.done) = (next, self.done + 1);
        true
    }
}

/// Both halves of the ways through the layers of a part, where they meet; nothing where one of them does not go on, and none where they
/// come to more than so many nodes.
fn followed_halves<'a>(
    ends: &'a [Vec<Added<'a>>; 2],
    layers: &[Layer],
    most: usize,
    spent: &Spent,
) -> Option<Option<[FollowedHalf<'a>; 2]>> {
    let [mut front, mut back] = ends.each_ref().map(|stages| FollowedHalf {
        stages,
        done: 0,
        nodes: vec![Reached::from_iter([(Vec::new(), Vec::new())])],
    });
    while front.done + back.done < layers.len() {
        let from_front = front.size() <= back.size();
        let at = if from_front {
            front.done
        } else {
            layers.len() - 1 - back.done
        };
        let layer = &layers[at];
        let below = layers.get(at + 1).map_or(1, |l| l.nodes);
        let alive = layer
            .edges
            .iter()
            .enumerate()
            .filter(|(_, edge)| **edge != DEAD);
        let edges = alive.map(|(e, &edge)| (e / layer.choices, e % layer.choices, edge as usize));
        let goes_on = if from_front {
            let mut ways = vec![Vec::new(); layer.nodes];
            edges.for_each(|(node, choice, to)| ways[node].push((choice, to)));
            front.advance(&ways, layer.choices, below, spent)
        } else {
            let mut ways = vec![Vec::new(); below];
            edges.for_each(|(to, choice, node)| ways[node].push((choice, to)));
            back.advance(&ways, layer.choices, layer.nodes, spent)
        };
        if !goes_on {
            return Some(None);
        }
        if front.size() + back.size() > most {
            return None;
        }
    }
    Some(Some([front, back]))
}
