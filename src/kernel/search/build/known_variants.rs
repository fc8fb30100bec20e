//! Whether a question has the variants of a known diagram.
//!
//! A diagram that is built knows nothing of what comes later, and many of its nodes lead nowhere. Where one of the variants is known,
//! only its ways are followed: half of the variables from the front, half from the back, and where they meet, what is added there is
//! put together only at one and the same node of what is known.

use crate::linalg::exterior::{Exterior, Product};
use crate::linalg::modp::Field;
use crate::search::build::known_spaces::Spaces;
use crate::search::build::self_stress::{Added, Wanted, limits};
use crate::search::build::spanning_halves::{Behind, Halves};
use crate::search::diagram::reduced_rows::{Arithmetic, Rows};
use crate::search::diagram::redundancy_so_far::Spent;
use crate::search::diagram::transition::Children;
use crate::search::diagram::{Carries, DEAD, Diagram, Layer};
use crate::search::question::Question;
use std::cmp::Ordering;

/// Coordinates of contours that both halves reach, at most: of more there are thousands of minors.
const WIDEST: usize = 12;

/// Returns whether every variant of a diagram is determinate in a question without a searched state. No variant of the diagram may have
/// more freedoms than another one that it contains. `None` if redundant constraints are allowed that not all variants have, or if it takes
/// too many nodes or minors.
///
/// # Complexity
/// O(nodes · choices · s²) field operations for s present self-stresses, of as many nodes as half of the variables add different spaces;
/// where n and m of them meet at a node O(n·m) sums of products.
pub(in crate::search) fn has_all(question: &Question, known: &Diagram) -> Option<bool> {
    if question.conditions.state.is_some() {
        return None;
    }
    let order: Vec<usize> = known.layers.iter().map(|l| l.variable).collect();
    let limits = limits(question);
    let halves = Halves::new(question, &order, &limits, Wanted::Determinate)?;
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
        if !are_whole(halves.field, &behind, &front.spaces, &back.spaces)? {
            return Some(false);
        }
        layers = others;
    }
    Some(true)
}

/// Whether all ways from the front are completed by all from the back that lead to the same node; none where these have more than is
/// missing.
fn are_whole(field: Field, behind: &Behind, front: &Spaces, back: &Spaces) -> Option<bool> {
    let exterior = Exterior::new(field, behind.live);
    let mut arithmetic = Arithmetic::new(field);
    let (mut rows, mut product) = (Rows::default(), Product::default());
    // Of those from the front the products, and which lead to each node.
    let mut minors = Vec::new();
    let mut products = Vec::with_capacity(front.len());
    let mut at_node = vec![Vec::new(); front.node_count()];
    for space in 0..front.len() {
        behind.unpacked(&mut arithmetic, front.packed(space), &mut rows);
        exterior.product(rows.rows(), &mut product);
        let start = minors.len();
        minors.extend_from_slice(product.minors());
        products.push((rows.rank(), start..minors.len()));
        front
            .nodes(space)
            .for_each(|node| at_node[node].push(space));
    }
    let mut complement = Vec::new();
    for space in 0..back.len() {
        if !behind.left_of(back.way(space), &mut arithmetic, &mut rows) {
            return Some(false);
        }
        let missing = behind.live.saturating_sub(rows.rank());
        exterior.product(rows.rows(), &mut product);
        complement.clear();
        complement.extend(exterior.complement(&product, rows.rank()));
        for &other in back.nodes(space).flat_map(|node| &at_node[node]) {
            let (rank, of) = &products[other];
            match rank.cmp(&missing) {
                Ordering::Greater => return None,
                Ordering::Equal if exterior.whole(&minors[of.clone()], &complement) => {}
                _ => return Some(false),
            }
        }
    }
    Some(true)
}

/// How far known ways were followed from one end.
struct FollowedHalf<'a> {
    stages: &'a [Added],
    done: usize,
    spaces: Spaces,
}

impl FollowedHalf<'_> {
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
        let mut next = Spaces::new(self.done + 1, to);
        let mut children = Children::new(choices);
        let mut known = Vec::new();
        for space in 0..self.spaces.len() {
            children.clear();
            let packed = self.spaces.packed(space);
            stage.children(&mut worker, packed, spent, &mut children);
            known.clear();
            known.resize(choices, None);
            for &(choice, to) in self.spaces.nodes(space).flat_map(|node| &ways[node]) {
                let child = match known[choice] {
                    Some(child) => child,
                    None => {
                        let Some((hash, _, start, end)) = children.found[choice] else {
                            return false;
                        };
                        let packed = &children.data[start..end];
                        next.find(hash, packed, self.spaces.way(space), choice)
                    }
                };
                known[choice] = Some(child);
                next.put(child, to);
            }
        }
        (self.spaces, self.done) = (next, self.done + 1);
        true
    }
}

/// Both halves of the ways through the layers of a part, where they meet; nothing where one of them does not go on, and none where they
/// come to more than so many spaces.
fn followed_halves<'a>(
    ends: &'a [Vec<Added>; 2],
    layers: &[Layer],
    most: usize,
    spent: &Spent,
) -> Option<Option<[FollowedHalf<'a>; 2]>> {
    let [mut front, mut back] = ends.each_ref().map(|stages| FollowedHalf {
        stages,
        done: 0,
        spaces: Spaces::root(),
    });
    while front.done + back.done < layers.len() {
        let from_front = front.spaces.len() <= back.spaces.len();
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
        if front.spaces.len() + back.spaces.len() > most {
            return None;
        }
    }
    Some(Some([front, back]))
}
