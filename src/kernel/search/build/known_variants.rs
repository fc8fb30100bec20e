//! Whether a question has the variants of a known diagram.
//!
//! A diagram that is built knows nothing of what comes later, and many of its nodes lead nowhere. Where one of the variants is known,
//! only its ways are followed: half of the variables from the front, half from the back, and where they meet, what is added there is
//! put together only at one and the same node of what is known.

use crate::linalg::exterior::Exterior;
use crate::linalg::modp::Residue;
use crate::search::build::self_stress::Added;
use crate::search::build::spanning_halves::{Behind, Halves};
use crate::search::build::staging::limits;
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::Spent;
use crate::search::diagram::transition::Children;
use crate::search::diagram::{Carries, DEAD, Diagram, Layer};
use crate::search::question::Question;
use hashbrown::HashMap;
use std::cmp::Ordering;

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
    let mut arithmetic = Arithmetic::new(halves.field);
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
        let exterior = Exterior::new(halves.field, behind.live);
        for (front, back) in front.nodes.iter().zip(&back.nodes) {
            if !complete(&exterior, &behind, &mut arithmetic, front, back)? {
                return Some(false);
            }
        }
        layers = others;
    }
    Some(true)
}

/// Whether all ways to a node from the front are completed by all from the back; none where these have more than is missing.
fn complete(
    exterior: &Exterior,
    behind: &Behind,
    arithmetic: &mut Arithmetic,
    front: &Reached,
    back: &Reached,
) -> Option<bool> {
    let of_front = |packed: &Vec<Residue>| {
        let rows = behind.unpacked(packed);
        (rows.rank(), exterior.product(rows.rows()))
    };
    let from_front: Vec<(usize, Vec<Residue>)> = front.keys().map(of_front).collect();
    let mut left = Rows::default();
    for path in back.values() {
        if !behind.left_of(path, arithmetic, &mut left) {
            return Some(false);
        }
        let product = exterior.product(left.rows());
        let missing = behind.live.saturating_sub(left.rank());
        let product = exterior.complement(&product, left.rank());
        for (rank, front) in &from_front {
            match rank.cmp(&missing) {
                Ordering::Greater => return None,
                Ordering::Equal if exterior.whole(front, &product) => {}
                _ => return Some(false),
            }
        }
    }
    Some(true)
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
