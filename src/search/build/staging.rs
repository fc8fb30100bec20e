//! From the orders of variables to the stages of both diagrams, and what is tested after each.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId};
use crate::search::build::Orders;
use crate::search::diagram::frontier::{At, plan};
use crate::search::diagram::output_motion::lookahead;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::{self, Collapse, Stage};
use crate::search::diagram::state_copies::{Lane, Move, ways};
use crate::search::question::conditions::Search;
use crate::search::reduce::biconnected::Block;
use crate::search::reduce::plane_split::Model;
use std::collections::BTreeMap;

/// The stages and limits of both diagrams; of one where both are the same.
pub(in crate::search) struct Laid {
    pub(in crate::search) determinate: (Vec<Stage>, Limits),
    pub(in crate::search) admissible: Option<(Vec<Stage>, Limits)>,
    /// The variables in the order of the admissible diagram.
    pub(in crate::search) order: Vec<usize>,
}

/// Whether a joint comes after the common ones.
fn is_way(joined: &Move) -> bool {
    joined.lane != Lane::Common
}

impl Search {
    /// Lays out the stages of both diagrams of some rows.
    pub(in crate::search) fn laid(&self, orders: &Orders, model: &Model) -> Laid {
        let state = self.conditions.state.as_ref();
        let order = orders.determinate.clone();
        let [blocks, common_blocks] = &self.blocks;
        let whole = plan(&self.mechanism, &self.joined(&order, blocks), &[], &[]);
        let limits = Limits {
            already: model.already(&self.exact, &order, &whole),
            internal: self.conditions.max_redundant,
            external: None,
            harmful: None,
            nodes: self.conditions.nodes,
            // Two primes with two diagrams each take half, and what is counted on them the rest.
            bytes: self.conditions.memory / 8,
        };
        let all = 0..self.space.variables.len();
        let (free, added): (Vec<usize>, Vec<usize>) =
            all.partition(|&v| !self.space.variables[v].external);
        let idle = added.iter().map(|&v| Stage::plain(v, Vec::new()));
        let mut stages = stage::stages(&model.space, &order, &whole);
        stages.extend(idle);
        let determinate = (stages, limits.clone());
        if self.one_diagram() {
            return Laid {
                determinate,
                admissible: None,
                order,
            };
        }
        let is_alone = |v: &usize| self.space.variables[*v].alone;
        let alone: Vec<usize> = free.iter().copied().filter(is_alone).collect();
        let frame = self.mechanism.frame();
        let mut order = orders.common.clone();
        let joined = self.joined(&order, common_blocks);
        let first = plan(&self.mechanism, &joined, &self.pinned, &[]);
        let mut stages = stage::stages(&model.space, &order, &first);
        let mut limits = limits;
        if let Some(state) = state {
            (limits.external, limits.harmful) = (state.max_external, state.max_harmful);
            let live = first.steps.last().map_or(&[][..], |s| &s.live);
            let joints = (&alone[..], &added[..]);
            let mut kept = vec![frame];
            kept.extend(self.kept.0.iter().filter(|_| self.conditions.keep_output));
            let ways = ways(
                &self.mechanism,
                &model.space,
                joints,
                live,
                &kept,
                &self.grasps,
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
        if self.conditions.keep_output {
            // What comes first has no say in how the kept links move.
            let silent = common_blocks.iter().filter(|b| b.lane > 0);
            let silent: usize = silent.map(|b| b.variables.len()).sum();
            self.look_ahead(model, &mut stages[silent..free.len()], alone.is_empty());
        }
        order.extend(alone);
        order.extend(added);
        Laid {
            determinate,
            admissible: Some((stages, limits)),
            order,
        }
    }

    /// The joints of some variables, each in the copy of the links that its block has.
    fn joined(&self, order: &[usize], blocks: &[Block]) -> Vec<At> {
        let of = |b: &Block| b.variables.iter().map(|&v| (v, b.lane)).collect::<Vec<_>>();
        let lanes: BTreeMap<usize, usize> = blocks.iter().flat_map(of).collect();
        let joints = |&v: &usize| {
            let (joints, lane) = (&self.space.variables[v].joints, lanes[&v]);
            joints.iter().map(move |&joint| At { joint, lane })
        };
        order.iter().flat_map(joints).collect()
    }

    /// The stages of a diagram without a searched state, as they are and from the end, for each of the parts between which no
    /// link is live; what is kept is in the last.
    pub(in crate::search) fn both_ends(
        &self,
        model: &Model,
        stages: &[Stage],
        keep_output: bool,
    ) -> Vec<[Vec<Stage>; 2]> {
        let blocks = &self.blocks[usize::from(keep_output)];
        let is_end = |s: &Stage| s.moves.last().is_some_and(|m| m.step.is_alone());
        let parts: Vec<&[Stage]> = stages.split_inclusive(is_end).collect();
        let both = |(i, part): (usize, &&[Stage])| {
            let is_kept = keep_output && i + 1 == parts.len();
            let order: Vec<usize> = part.iter().rev().map(|s| s.variable).collect();
            let joined = self.joined(&order, blocks);
            let pinned = if is_kept { &self.pinned[..] } else { &[] };
            let back = plan(&self.mechanism, &joined, pinned, &[]);
            let mut back = stage::stages(&model.space, &order, &back);
            if is_kept && joined.iter().all(|at| at.lane == 0) {
                self.look_ahead(model, &mut back, true);
            }
            // Halves meet in what the kept links do, however wrong.
            let mut both = [part.to_vec(), back];
            both.iter_mut().flatten().for_each(|s| s.collapse = None);
            both
        };
        parts.iter().enumerate().map(both).collect()
    }

    /// Gives each stage of the free state the test that its nodes must pass. `same_joints` says that all of them are in the
    /// searched state, too: then a node that passes the last test has kept links that move as they do now, and the
    /// searched state needs no more of them.
    fn look_ahead(&self, model: &Model, stages: &mut [Stage], same_joints: bool) {
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
            let (links, couplings) = (self.mechanism.links.len(), self.mechanism.couplings.len());
            let step = &last.step;
            let mine = step.live.iter().filter(|(_, l)| l.index() < links);
            let live: Vec<_> = mine.copied().collect();
            let mine = step.pending.iter().filter(|&&q| q < couplings);
            let pending: Vec<_> = mine.copied().collect();
            let others = step.live.len() + step.pending.len() - live.len() - pending.len();
            let (kept, allowed) = (&self.kept.0, model.kept.len());
            let mut test = lookahead(
                &self.exact,
                &self.mechanism,
                model.space.dim,
                (&live, &pending),
                &left,
                kept,
                allowed,
            );
            let nothing = vec![0; test.map.first().map_or(0, Vec::len)];
            let size = test.map.len() + others * model.space.dim;
            test.map.resize(size, nothing);
            stages[i].lookahead = Some(test);
            if last.lane == Lane::Common {
                stages[i].collapse = self.collapse(model, &live, &left, same_joints);
            }
        }
    }

    /// The kept links in the frame's component that no joint to come touches.
    fn collapse(
        &self,
        model: &Model,
        live: &[(LinkId, LinkId)],
        left: &[(JointId, Vec<Vec<Residue>>)],
        same_joints: bool,
    ) -> Option<Collapse> {
        let (frame, dim) = (self.mechanism.frame(), model.space.dim);
        let contact = |l: LinkId| {
            let external = self
                .space
                .variables
                .iter()
                .filter(|v| v.external && !same_joints)
                .flat_map(|v| &v.joints);
            left.iter()
                .map(|(j, _)| j)
                .chain(external)
                .any(|&j| self.mechanism.joints[j].links.contains(&l))
        };
        let finished = |&(i, l): &(usize, &LinkId)| {
            let here = live.iter().position(|x| *x == (frame, *l));
            here.filter(|_| !contact(*l)).map(|block| (i, block))
        };
        let (places, blocks): (Vec<usize>, Vec<usize>) = self
            .kept
            .0
            .iter()
            .enumerate()
            .filter_map(|x| finished(&x))
            .unzip();
        let mut present = Echelon::new(self.exact.field());
        for row in &model.kept {
            let part: Vec<Residue> = places
                .iter()
                .flat_map(|p| row[p * dim..(p + 1) * dim].iter().copied())
                .collect();
            present.insert(&part);
        }
        (!blocks.is_empty()).then(|| Collapse::new(&blocks, dim, present.reduced()))
    }
}
