//! Whether a question has the variants of a known diagram.
//!
//! Only choices of known variants are followed: half of the variables from the front, the other half from the back. At their
//! meeting, spaces are compared that variants lead to through the same node of the known diagram.

use crate::search::diagram::layer::{Merge, Nodes};
use crate::search::diagram::redundancy_so_far::{Limits, Spent};
use crate::search::diagram::stage::Stage;
use crate::search::diagram::{Control, DEAD, Diagram, Expanded, Layer, Stop, next_layer};
use crate::search::question::Question;
use crate::search::question::space::{Choice, Space};
use crate::search::solve::self_stress::{Wanted, diagram_limits};
use crate::search::solve::spanning_halves::Halves;
use crate::search::solve::spanning_pairs::{Bases, WalkMemory, ZeroForms};
use itertools::Itertools;

/// Returns true if every variant of a diagram is determinate in a question. Returns false if not, if the diagram or the question allows
/// redundant constraints that not every variant has, or if it takes more nodes than the budget allows.
///
/// # Complexity
/// O(n·choices·s²) field operations for s self-stresses and n spaces that half of the choices of the variants add, and O(a·b) sums of
/// products for a and b spaces that meet at a node.
pub(in crate::search) fn has_all(question: &Question, known: &Diagram) -> bool {
    let order: Vec<usize> = known.layers.iter().map(|l| l.variable).collect();
    let limits = diagram_limits(question);
    let Some(halves) = Halves::new(question, &order, &limits, Wanted::Determinate) else {
        return false;
    };
    let end = Spent::within_mechanism(halves.already).redundancy();
    let mut layers = &known.layers[..];
    known.terminals.iter().all(|t| *t == end)
        && (0..halves.parts.len()).all(|part| {
            let (own, others) = layers.split_at(halves.parts[part][0].len());
            layers = others;
            let ends = others.first().map_or(known.terminals.len(), |l| l.nodes);
            part_has_all(&halves, &question.space, (part, own), ends).is_some()
        })
}

/// The spaces that known variants lead to from one end, and their pairs with the nodes of the known diagram, each once.
struct End {
    spaces: Nodes,
    reached: Vec<(usize, usize)>,
}

/// Follows the variants of some layers, which end at `ends` nodes, through a part. Returns `None` if one of them is not determinate.
fn part_has_all(
    halves: &Halves<'_>,
    space: &Space,
    (part, layers): (usize, &[Layer]),
    ends: usize,
) -> Option<()> {
    let nodes_at = |at: usize| layers.get(at).map_or(ends, |l| l.nodes);
    let [mut front, mut back] = [nodes_at(0), ends].map(|nodes| End {
        spaces: Nodes::root_node(Spent::within_mechanism(halves.already), 1),
        reached: (0..nodes).map(|node| (0, node)).collect(),
    });
    let [from_front, from_back] = &halves.parts[part];
    let (mut at, mut to) = (0, layers.len());
    while at < to {
        let forward = front.spaces.len() <= back.spaces.len();
        let layer = if forward { at } else { to - 1 };
        let choices = &space.variables[layers[layer].variable].choices;
        let steps = layers[layer].list_steps(nodes_at(layer + 1), forward);
        if forward {
            front = front.follow_steps(&from_front[at], choices, &steps, halves.limits)?;
            at += 1;
        } else {
            to -= 1;
            back = back.follow_steps(
                &from_back[layers.len() - 1 - to],
                choices,
                &steps,
                halves.limits,
            )?;
        }
    }
    let rows = halves.meeting_rows(part, layers.len() - to);
    // A space is at several nodes.
    let zero_forms = rows.all_rows(0, &front.spaces);
    let zero_forms = zero_forms.map(|own| ZeroForms::new(halves.field, &own, rows.width()));
    let zero_forms = zero_forms.collect_vec();
    let back_rows = rows.all_rows(1, &back.spaces).collect_vec();
    let mut memory = WalkMemory::default();
    let [of_front, of_back] = [&front, &back].map(|end| end.spaces_at(nodes_at(to)));
    for (front_spaces, back_spaces) in of_front.iter().zip(of_back) {
        let own = back_spaces.iter().map(|&space| &back_rows[space][..]);
        let bases = Bases::new(halves.field, own, false, false);
        for &space in front_spaces {
            let found = bases.completing_nodes(&zero_forms[space], &mut memory);
            let count: u32 = found.iter().map(|word| word.count_ones()).sum();
            if (count as usize) < back_spaces.len() {
                return None;
            }
        }
    }
    Some(())
}

impl End {
    /// Follows the steps from each node of the known diagram, and each choice. Returns `None` if one has a redundant constraint, or if there
    /// are too many spaces.
    fn follow_steps(
        &self,
        stage: &Stage<'_>,
        choices: &[Choice],
        steps: &[Vec<usize>],
        limits: &Limits,
    ) -> Option<End> {
        let n = choices.len();
        let from_pair = |&(space, node): &(usize, usize)| {
            let of_choice = steps[node * n..][..n].iter().enumerate();
            of_choice
                .flat_map(move |(choice, to)| to.iter().map(move |&to| (space * n + choice, to)))
        };
        let taken = self.reached.iter().flat_map(from_pair).collect_vec();
        let mut wanted = vec![false; self.spaces.len() * n];
        taken.iter().for_each(|(edge, _)| wanted[*edge] = true);
        let from = Expanded {
            nodes: &self.spaces,
            choices,
            wanted: &|edge| wanted[edge],
            bytes: limits.bytes,
        };
        let room = (limits.nodes, limits.bytes);
        let merge = next_layer(
            stage,
            &from,
            Merge::new(room, Stop::Exhausted, wanted.len(), 1),
            |_, _, _| false,
            Control::NONE,
        );
        let step = |(edge, node): (usize, usize)| {
            let to = merge.edges[edge];
            (to != DEAD).then_some((to as usize, node))
        };
        let mut reached = taken.into_iter().map(step).collect::<Option<Vec<_>>>()?;
        reached.sort_unstable();
        reached.dedup();
        (merge.stop == Stop::Exhausted).then_some(End {
            spaces: merge.next,
            reached,
        })
    }

    /// Returns the spaces at each of some nodes of the known diagram.
    fn spaces_at(&self, nodes: usize) -> Vec<Vec<usize>> {
        let mut at = vec![Vec::new(); nodes];
        self.reached
            .iter()
            .for_each(|&(space, node)| at[node].push(space));
        at
    }
}
