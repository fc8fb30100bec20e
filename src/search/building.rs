//! The diagrams that answer a question: of the determinate variants, and of the admissible ones.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId};
use crate::search::budget;
use crate::search::conditions::Search;
use crate::search::diagram::{self, Diagram, Progress, Stop};
use crate::search::estimate::Estimate;
use crate::search::lanes::{Lane, Move, ways};
use crate::search::lookahead::lookahead;
use crate::search::missing::{Ceiling, Missing};
use crate::search::order::variable_order;
use crate::search::plan::{At, plan};
use crate::search::proven::UpTo;
use crate::search::spent::Limits;
use crate::search::stage::{self, Collapse, Stage};
use num_bigint::BigUint;
use num_traits::Zero;

/// The orders in which diagrams take the variables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Orders {
    /// Those of the free state, for the determinate variants.
    pub determinate: Vec<usize>,
    /// Those that the free state and the searched one have in common, for the admissible variants.
    pub common: Vec<usize>,
}

/// Diagrams of one search.
#[derive(Debug)]
pub struct Diagrams {
    /// Of the variants that meet the redundancy condition of the free state.
    pub determinate: Diagram,
    /// Of those that meet every condition that does not depend on counts of changes and mobility.
    pub admissible: Diagram,
    /// The cheapest of the admissible ones, where they are wanted and that diagram is not whole.
    pub cheapest: Option<UpTo>,
    /// About how many determinate and admissible variants there are, where their diagrams are cut down and a seed is given.
    pub estimates: [Option<Estimate>; 2],
    /// The variables in the order the admissible diagram takes them.
    pub order: Vec<usize>,
}

impl Diagrams {
    /// The less complete of the two reasons for stopping.
    #[must_use]
    pub fn stop(&self) -> Stop {
        self.determinate.stop.or(self.admissible.stop)
    }

    /// The cost in thousandths up to which every admissible variant is known; `None` where of none it can be said.
    #[must_use]
    pub fn known_up_to(&self) -> Option<i64> {
        let whole = self.admissible.stop == Stop::Exhausted;
        let bounded = self.cheapest.as_ref().map(|c| c.cost_milli);
        if whole { Some(i64::MAX) } else { bounded }
    }
}

/// Stages of a diagram, and its limits.
type Question<'a> = (&'a [Stage], &'a Limits);
/// Builds a diagram, under a ceiling or not.
type Build<'a> = &'a mut dyn FnMut(Question<'_>, Option<&mut Ceiling<'_>>) -> Diagram;

/// The stages and limits of both diagrams; of one where both are the same.
struct Laid {
    determinate: (Vec<Stage>, Limits),
    admissible: Option<(Vec<Stage>, Limits)>,
    /// The variables in the order of the admissible diagram.
    order: Vec<usize>,
}

/// Whether a diagram is cut down to its limits.
fn is_cut(stop: Stop) -> bool {
    matches!(stop, Stop::NodeBudget | Stop::Memory)
}

/// Whether a joint comes after the common ones.
fn is_way(joined: &Move) -> bool {
    joined.lane != Lane::Common
}

impl Search {
    /// Finds the orders of both diagrams; they do not depend on the prime, and a twin over another may be given them.
    #[must_use]
    pub fn orders(&self) -> Orders {
        let order = |variables: &[usize], pinned: &[LinkId]| {
            variable_order(
                &self.exact,
                &self.mechanism,
                &self.space,
                variables,
                pinned,
                self.conditions.max_redundant,
            )
        };
        let variables = 0..self.space.variables.len();
        let free: Vec<usize> = variables
            .filter(|&v| !self.space.variables[v].external)
            .collect();
        let determinate = order(&free, &[]);
        let both: Vec<usize> = free
            .into_iter()
            .filter(|&v| !self.space.variables[v].alone)
            .collect();
        let common = match self.one_diagram() {
            true => determinate.clone(),
            false => order(&both, &[self.mechanism.frame()]),
        };
        Orders {
            determinate,
            common,
        }
    }

    /// Whether nothing is asked of variants but what makes them determinate.
    fn one_diagram(&self) -> bool {
        !self.conditions.keep_output && self.conditions.state.is_none()
    }

    /// Builds both diagrams.
    pub fn build(
        &self,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagrams {
        self.build_in(&self.orders(), cancelled, progress)
    }

    /// Builds both diagrams in given orders.
    pub fn build_in(
        &self,
        orders: &Orders,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagrams {
        let laid = self.laid(orders);
        let mut build = |(stages, limits): Question<'_>, ceiling: Option<&mut Ceiling<'_>>| {
            let (exact, space) = (&self.exact, &self.space);
            let within = (limits, ceiling);
            diagram::build(exact, space, stages, within, cancelled, progress)
        };
        let first = (&laid.determinate.0[..], &laid.determinate.1);
        let determinate = self.whole(first, false, &mut build);
        let second = laid.admissible.as_ref().map(|(s, l)| (&s[..], l));
        let admissible = match second {
            Some(second) => self.whole(second, true, &mut build),
            None => determinate.clone(),
        };
        let mut out = Diagrams {
            determinate,
            admissible,
            cheapest: None,
            estimates: [None; 2],
            order: laid.order,
        };
        let second = second.unwrap_or(first);
        let kept = if self.conditions.keep_output {
            self.kept.1.len()
        } else {
            0
        };
        self.prove(&mut out, second, kept, &mut build);
        let estimate = |(stages, limits): Question<'_>, end, stop, filter| {
            let seed = self.conditions.estimate.filter(|_| is_cut(stop))?;
            let missing = Missing::new(&self.space, stages, limits, end);
            self.estimate((stages, limits), &missing, (seed, filter), cancelled)
        };
        out.estimates = [
            estimate(first, 0, out.determinate.stop, false),
            estimate(second, kept, out.admissible.stop, true),
        ];
        out
    }

    /// The diagram of a question, or where it does not fit the limits the best of those cut down, which are worth the variants
    /// they count; `filter` applies the conditions on mobility and changes to these.
    fn whole(&self, (stages, limits): Question<'_>, filter: bool, build: Build<'_>) -> Diagram {
        let build = &mut |limits: &Limits| build((stages, limits), None);
        if self.conditions.counted {
            return budget::best(limits, build, &|d| self.total(d, filter));
        }
        let mut few = build(&Limits {
            nodes: 1,
            ..limits.clone()
        });
        if few.stop != Stop::Interrupted {
            few.stop = Stop::NotCounted;
        }
        few
    }

    /// Lays out the stages of both diagrams.
    fn laid(&self, orders: &Orders) -> Laid {
        let state = self.conditions.state.as_ref();
        let limits = Limits {
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
        let order = orders.determinate.clone();
        let at = |order: &[usize]| -> Vec<At> {
            let joints = order.iter().flat_map(|&v| &self.space.variables[v].joints);
            joints.map(|&joint| At { joint, lane: 0 }).collect()
        };
        let idle = added.iter().map(|&v| Stage::plain(v, Vec::new()));
        let whole = plan(&self.mechanism, &at(&order), &[], &[]);
        let mut stages = stage::stages(&self.space, &order, &whole);
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
        let mut pinned = vec![self.mechanism.frame()];
        pinned.extend(self.kept.0.iter().filter(|_| self.conditions.keep_output));
        let later = at(&alone).into_iter().chain(at(&added));
        pinned.extend(later.flat_map(|at| self.mechanism.joints[at.joint].links));
        pinned.sort_unstable();
        pinned.dedup();
        let frame = self.mechanism.frame();
        let mut order = orders.common.clone();
        let first = plan(&self.mechanism, &at(&order), &pinned, &[]);
        let mut stages = stage::stages(&self.space, &order, &first);
        let mut limits = limits;
        if let Some(state) = state {
            (limits.external, limits.harmful) = (state.max_external, state.max_harmful);
            let live = first.steps.last().map_or(&[][..], |s| &s.live);
            let joints = (&alone[..], &added[..]);
            let mut kept = vec![frame];
            kept.extend(self.kept.0.iter().filter(|_| self.conditions.keep_output));
            let ways = ways(
                &self.mechanism,
                &self.space,
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
            self.look_ahead(&mut stages[..free.len()], alone.is_empty());
        }
        order.extend(alone);
        order.extend(added);
        Laid {
            determinate,
            admissible: Some((stages, limits)),
            order,
        }
    }

    /// Finds the cheapest admissible variants where they are wanted and not all are known; `end` is the least dimension of
    /// the last nodes.
    fn prove(&self, out: &mut Diagrams, question: Question<'_>, end: usize, build: Build<'_>) {
        let most = BigUint::from(self.conditions.cheapest);
        let known = matches!(out.admissible.stop, Stop::Exhausted | Stop::Interrupted);
        if known || most.is_zero() {
            return;
        }
        let missing = Missing::new(&self.space, question.0, question.1, end);
        if missing.root().is_none() {
            // There is none, by dimensions alone.
            out.admissible.stop = Stop::Exhausted;
            return;
        }
        let known = self.cost_of(&out.admissible, &most).flatten();
        let build = &mut |ceiling: &mut Ceiling<'_>| build(question, Some(ceiling));
        let proof = self.up_to(&missing, (&most, known), build);
        match proof.up_to {
            // Nothing had to be left out: what has no completion by dimensions made the diagram too large.
            Some(all) if all.cost_milli == i64::MAX => out.admissible = all.diagram,
            up_to => out.cheapest = up_to,
        }
        // Where it was cancelled depends on the clock, so that there is nothing to compare with a twin.
        if proof.stop == Stop::Interrupted {
            out.admissible.stop = Stop::Interrupted;
        }
    }

    /// Gives each stage of the free state the test that its nodes must pass. `same_joints` says that all of them are in the
    /// searched state, too: then a node that passes the last test has kept links that move as they do now, and the
    /// searched state needs no more of them.
    fn look_ahead(&self, stages: &mut [Stage], same_joints: bool) {
        let present = |v: usize| {
            let variable = &self.space.variables[v];
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
            let (kept, allowed) = (&self.kept.0, self.kept.1.len());
            let mut test = lookahead(
                &self.exact,
                &self.mechanism,
                self.space.dim,
                (&live, &pending),
                &left,
                kept,
                allowed,
            );
            let nothing = vec![0; test.map.first().map_or(0, Vec::len)];
            let size = test.map.len() + others * self.space.dim;
            test.map.resize(size, nothing);
            stages[i].lookahead = Some(test);
            if last.lane == Lane::Common {
                stages[i].collapse = self.collapse(&live, &left, same_joints);
            }
        }
    }

    /// The kept links in the frame's component that no joint to come touches.
    fn collapse(
        &self,
        live: &[(LinkId, LinkId)],
        left: &[(JointId, Vec<Vec<Residue>>)],
        same_joints: bool,
    ) -> Option<Collapse> {
        let (frame, dim) = (self.mechanism.frame(), self.space.dim);
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
        for row in &self.kept.1 {
            let part: Vec<Residue> = places
                .iter()
                .flat_map(|p| row[p * dim..(p + 1) * dim].iter().copied())
                .collect();
            present.insert(&part);
        }
        (!blocks.is_empty()).then(|| Collapse::new(&blocks, dim, present.reduced()))
    }
}
