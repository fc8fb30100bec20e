//! From the orders of variables to the stages of both diagrams, and what is tested after each.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId};
use crate::search::build::orders::Orders;
use crate::search::build::orders::one_diagram;
use crate::search::diagram::frontier::{At, plan};
use crate::search::diagram::output_motion::{NodeParts, lookahead};
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::{self, Collapse, Stage};
use crate::search::diagram::state_copies::{Lane, Move, ways};
use crate::search::question::Question;
use crate::search::reduce::biconnected::Block;
use crate::search::reduce::plane_split::Model;
use std::cell::LazyCell;
use std::collections::BTreeMap;

/// Both diagrams; one where both are the same.
pub(in crate::search) struct Laid<'a> {
    pub(in crate::search) determinate: Staged<'a>,
    pub(in crate::search) admissible: Option<Staged<'a>>,
    /// The variables in the order of the admissible diagram.
    pub(in crate::search) order: Vec<usize>,
}

/// A diagram before it is built.
pub(in crate::search) struct Staged<'a> {
    /// The variables of the free state in its order.
    pub(in crate::search) order: Vec<usize>,
    pub(in crate::search) limits: Limits,
    /// Laid out where motions of links are followed: the space dual to self-stresses needs none of it.
    stages: LazyCell<Vec<Stage>, Box<dyn FnOnce() -> Vec<Stage> + 'a>>,
}

impl Staged<'_> {
    /// What happens in each of its layers.
    pub(in crate::search) fn stages(&self) -> &[Stage] {
        &self.stages
    }
}

/// Whether a joint comes after the common ones.
fn is_way(joined: &Move) -> bool {
    joined.lane != Lane::Common
}

/// What is allowed of the diagram of determinate variants.
pub(in crate::search) fn limits(question: &Question, model: &Model) -> Limits {
    Limits {
        layer: usize::MAX,
        already: model.already,
        internal: question.conditions.max_redundant,
        external: None,
        harmful: None,
        nodes: question.conditions.nodes,
        // Two primes with two diagrams each take half, and what is counted on them the rest.
        bytes: question.conditions.memory / 8,
    }
}

/// Lays out both diagrams of some rows.
pub(in crate::search) fn laid<'a>(
    question: &'a Question,
    orders: &Orders,
    model: &'a Model,
) -> Laid<'a> {
    let order = orders.determinate.clone();
    let [blocks, _] = &question.blocks;
    let whole = plan(
        &question.mechanism,
        &joined(question, &order, blocks),
        &[],
        &[],
    );
    let limits = limits(question, model);
    let all = 0..question.space.variables.len();
    let (free, added): (Vec<usize>, Vec<usize>) =
        all.partition(|&v| !question.space.variables[v].external);
    let stages = {
        let (order, added) = (order.clone(), added.clone());
        move || {
            let idle = added.into_iter().map(|v| Stage::plain(v, Vec::new()));
            let mut stages = stage::stages(&model.space, &order, &whole);
            stages.extend(idle);
            stages
        }
    };
    let determinate = Staged {
        order: order.clone(),
        limits: limits.clone(),
        stages: LazyCell::new(Box::new(stages)),
    };
    if one_diagram(question) {
        return Laid {
            determinate,
            admissible: None,
            order,
        };
    }
    let mut limits = limits;
    if let Some(state) = &question.conditions.state {
        (limits.external, limits.harmful) = (state.max_external, state.max_harmful);
    }
    let is_alone = |v: &usize| question.space.variables[*v].alone;
    let alone: Vec<usize> = free.iter().copied().filter(is_alone).collect();
    let common = orders.common.clone();
    let order = [&common[..], &alone, &added].concat();
    let stages = {
        let common = common.clone();
        move || admissible(question, model, &common, free.len(), &alone, &added)
    };
    Laid {
        determinate,
        admissible: Some(Staged {
            order: common,
            limits,
            stages: LazyCell::new(Box::new(stages)),
        }),
        order,
    }
}

/// The stages of the admissible diagram: common variables in an order, then what the searched state leaves out and what it adds.
fn admissible(
    question: &Question,
    model: &Model,
    order: &[usize],
    free: usize,
    alone: &[usize],
    added: &[usize],
) -> Vec<Stage> {
    let [_, blocks] = &question.blocks;
    let joined = joined(question, order, blocks);
    let first = plan(&question.mechanism, &joined, &question.pinned, &[]);
    let mut stages = stage::stages(&model.space, order, &first);
    let keep_output = question.conditions.keep_output;
    if question.conditions.state.is_some() {
        let live = first.steps.last().map_or(&[][..], |s| &s.live);
        let kept = keep_output.then(|| question.kept.bodies(&question.mechanism));
        let kept: Vec<LinkId> = std::iter::once(question.mechanism.frame())
            .chain(kept.into_iter().flatten())
            .collect();
        let ways = ways(
            &question.mechanism,
            &model.space,
            alone,
            added,
            live,
            &kept,
            &question.grasps,
        );
        let copies = std::iter::once(ways.copies).chain(std::iter::repeat(1));
        for ((variable, moves), copies) in ways.stages.into_iter().zip(copies) {
            stages.push(Stage {
                copies,
                ..Stage::plain(variable, moves)
            });
        }
        if let Some(last) = stages.last_mut().filter(|s| s.moves.iter().all(is_way)) {
            last.ending = Some(ways.held);
        }
    }
    if keep_output {
        // What comes first has no say in how the kept links move.
        let silent = blocks.iter().filter(|b| b.lane > 0);
        let silent: usize = silent.map(|b| b.variables.len()).sum();
        let seen = &mut stages[silent..free];
        look_ahead(question, model, seen, alone.is_empty());
    }
    stages
}

/// The joints of some variables, each in the copy of the links that its block has.
fn joined(question: &Question, order: &[usize], blocks: &[Block]) -> Vec<At> {
    let of = |b: &Block| b.variables.iter().map(|&v| (v, b.lane)).collect::<Vec<_>>();
    let lanes: BTreeMap<usize, usize> = blocks.iter().flat_map(of).collect();
    let joints = |&v: &usize| {
        let (joints, lane) = (&question.space.variables[v].joints, lanes[&v]);
        joints.iter().map(move |&joint| At { joint, lane })
    };
    order.iter().flat_map(joints).collect()
}

/// Gives each stage of the free state the test that its nodes must pass. `same_joints` says that all of them are in the
/// searched state, too: then a node that passes the last test has kept links that move as they do now, and the
/// searched state needs no more of them.
fn look_ahead(question: &Question, model: &Model, stages: &mut [Stage], same_joints: bool) {
    let present = |v: usize| {
        let variable = &model.space.variables[v];
        variable
            .joints
            .iter()
            .copied()
            .zip(variable.choices[0].spans.iter().cloned())
    };
    for i in 0..stages.len() {
        let left: Vec<_> = stages[i + 1..]
            .iter()
            .flat_map(|s| present(s.variable))
            .collect();
        let Some(last) = stages[i].moves.last() else {
            continue;
        };
        // The free state's lane comes first; what other lanes hold is of no concern.
        let (links, couplings) = (
            question.mechanism.bodies(),
            question.mechanism.couplings.len(),
        );
        let step = &last.step;
        let mine = step.live.iter().filter(|(_, l)| l.index() < links);
        let live: Vec<_> = mine.copied().collect();
        let mine = step.pending.iter().filter(|&&q| q < couplings);
        let pending: Vec<_> = mine.copied().collect();
        let others = step.live.len() + step.pending.len() - live.len() - pending.len();
        let of_node = NodeParts {
            live: &live,
            pending: &pending,
        };
        let (kept, allowed) = (&question.kept.bodies(&question.mechanism), model.kept.len());
        let mut test = lookahead(
            &question.exact,
            &question.mechanism,
            model.space.dim,
            of_node,
            &left,
            kept,
            allowed,
        );
        let nothing = vec![0; test.map.first().map_or(0, Vec::len)];
        let size = test.map.len() + others * model.space.dim;
        test.map.resize(size, nothing);
        stages[i].lookahead = Some(test);
        if last.lane == Lane::Common {
            stages[i].collapse = collapse(question, model, &live, &left, same_joints);
        }
    }
}

/// The kept links in the frame's component that no joint to come touches.
fn collapse(
    question: &Question,
    model: &Model,
    live: &[(LinkId, LinkId)],
    left: &[(JointId, Vec<Vec<Residue>>)],
    same_joints: bool,
) -> Option<Collapse> {
    let (frame, dim) = (question.mechanism.frame(), model.space.dim);
    let contact = |l: LinkId| {
        let external = question
            .space
            .variables
            .iter()
            .filter(|v| v.external && !same_joints)
            .flat_map(|v| &v.joints);
        left.iter()
            .map(|(j, _)| j)
            .chain(external)
            .any(|&j| question.mechanism.joints[j].links.contains(&l))
    };
    let finished = |&(i, l): &(usize, &LinkId)| {
        let here = live.iter().position(|x| *x == (frame, *l));
        here.filter(|_| !contact(*l)).map(|block| (i, block))
    };
    let bodies = question.kept.bodies(&question.mechanism);
    let (places, blocks): (Vec<usize>, Vec<usize>) = bodies
        .iter()
        .enumerate()
        .filter_map(|x| finished(&x))
        .unzip();
    let mut present = Echelon::new(question.exact.field());
    for row in &model.kept {
        let (links, rates) = row.split_at(question.kept.links.len() * dim);
        let of_body = |&p: &usize| -> Vec<Residue> {
            let mut twist = match p.checked_sub(question.kept.links.len()) {
                None => links[p * dim..(p + 1) * dim].to_vec(),
                Some(drive) => vec![rates[drive]],
            };
            twist.resize(dim, 0);
            twist
        };
        let part: Vec<Residue> = places.iter().flat_map(of_body).collect();
        present.insert(&part);
    }
    (!blocks.is_empty()).then(|| Collapse::new(&blocks, dim, present.reduced()))
}
