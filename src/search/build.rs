//! The diagrams that answer a question: of the determinate variants, and of the admissible ones.

pub(in crate::search) mod budget;
pub(in crate::search) mod complements;
pub(in crate::search) mod staging;
pub(in crate::search) mod two_sided;

use crate::search::answer::estimate::Estimate;
use crate::search::answer::proven_cheapest::UpTo;
use crate::search::diagram::completion::{Ceiling, Missing};
use crate::search::diagram::product::product;
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::Stage;
use crate::search::diagram::{self, Diagram, Progress, Stop};
use crate::search::order::variable_order;
use crate::search::question::conditions::Search;
use crate::search::reduce::biconnected::Block;
use crate::search::reduce::plane_split::Model;
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
    /// Rows of the closure equations for each contour that they are built of: fewer than a twist has numbers where the rest is
    /// the same whatever is chosen; of each part, where the equations fall apart into two that choices change.
    pub rows_per_contour: Vec<usize>,
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
/// Builds a diagram under a ceiling.
type Build<'a> = &'a mut dyn FnMut(Question<'_>, &mut Ceiling<'_>) -> Diagram;

/// Nodes from one end before a diagram is tried from both.
const AT_ONCE: usize = 200_000;

/// Whether a diagram is cut down to its limits.
fn is_cut(stop: Stop) -> bool {
    matches!(stop, Stop::NodeBudget | Stop::Memory)
}

impl Search {
    /// Finds the orders of both diagrams; they do not depend on the prime, and a twin over another may be given them.
    #[must_use]
    pub fn orders(&self) -> Orders {
        let order = |blocks: &[Block]| {
            variable_order(
                &self.exact,
                &self.mechanism,
                &self.least.whole.space,
                blocks,
                self.conditions.max_redundant,
            )
        };
        let [determinate, common] = &self.blocks;
        let determinate = order(determinate);
        let common = match self.one_diagram() {
            true => determinate.clone(),
            false => order(common),
        };
        Orders {
            determinate,
            common,
        }
    }

    /// Whether nothing is asked of variants but what makes them determinate.
    pub(super) fn one_diagram(&self) -> bool {
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
        if let Some(out) = self.build_parts(orders, cancelled, progress) {
            return out;
        }
        let model = &self.least.whole;
        let laid = self.laid(orders, model);
        let first = (&laid.determinate.0[..], &laid.determinate.1);
        let mut whole = |question: Question<'_>, admissible: bool| {
            if !self.conditions.counted {
                return self.uncounted(question, cancelled, progress);
            }
            let built = self.built(model, question, admissible, cancelled, progress);
            if !is_cut(built.stop) {
                return built;
            }
            let (stages, limits) = question;
            let build = &mut |limits: &Limits| {
                self.one_end(model, (stages, limits), None, cancelled, progress)
            };
            budget::best(limits, built, build, &|d| self.total(d, admissible))
        };
        let determinate = whole(first, false);
        let second = laid.admissible.as_ref().map(|(s, l)| (&s[..], l));
        let admissible = match second {
            Some(second) => whole(second, true),
            None => determinate.clone(),
        };
        let mut out = Diagrams {
            determinate,
            admissible,
            cheapest: None,
            estimates: [None; 2],
            order: laid.order,
            rows_per_contour: vec![model.space.dim],
        };
        let second = second.unwrap_or(first);
        let kept = if self.conditions.keep_output {
            self.least.whole.kept.len()
        } else {
            0
        };
        let build = &mut |question: Question<'_>, ceiling: &mut Ceiling<'_>| {
            self.one_end(model, question, Some(ceiling), cancelled, progress)
        };
        self.prove(&mut out, second, kept, build);
        let estimate = |(stages, limits): Question<'_>, end, stop, filter| {
            let seed = self.conditions.estimate.filter(|_| is_cut(stop))?;
            let missing = Missing::new(&self.least.whole.space, stages, limits, end);
            self.estimate((stages, limits), &missing, (seed, filter), cancelled)
        };
        out.estimates = [
            estimate(first, 0, out.determinate.stop, false),
            estimate(second, kept, out.admissible.stop, true),
        ];
        out
    }

    /// Builds both diagrams from those of the two parts that the closure equations fall apart into; none where they do not, or
    /// where a diagram does not fit the limits.
    fn build_parts(
        &self,
        orders: &Orders,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Option<Diagrams> {
        let parts = self
            .least
            .parts
            .as_ref()
            .filter(|_| self.conditions.counted)?;
        let laid = parts.each_ref().map(|part| self.laid(orders, part));
        let mut both = |questions: [&(Vec<Stage>, Limits); 2], admissible: bool| {
            let mut built = |part: usize| {
                let (stages, limits) = questions[part];
                let question = (&stages[..], limits);
                let d = self.built(&parts[part], question, admissible, cancelled, progress);
                (d.stop == Stop::Exhausted).then_some(d)
            };
            product([&built(0)?, &built(1)?], &questions[0].1)
        };
        let [one, two] = &laid;
        let determinate = both([&one.determinate, &two.determinate], false)?;
        let admissible = match (&one.admissible, &two.admissible) {
            (Some(one), Some(two)) => both([one, two], true)?,
            _ => determinate.clone(),
        };
        Some(Diagrams {
            determinate,
            admissible,
            cheapest: None,
            estimates: [None; 2],
            order: one.order.clone(),
            rows_per_contour: parts.iter().map(|p| p.space.dim).collect(),
        })
    }

    /// The diagram of a question from one end, cut down to its limits where it does not fit them; under a ceiling or not.
    fn one_end(
        &self,
        model: &Model,
        (stages, limits): Question<'_>,
        ceiling: Option<&mut Ceiling<'_>>,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagram {
        let (exact, space, within) = (&self.exact, &model.space, (limits, ceiling));
        diagram::build(exact, space, stages, within, cancelled, progress)
    }

    /// The diagram of a question: from one end; where that takes many nodes, from both; cut down to the limits where neither
    /// fits.
    fn built(
        &self,
        model: &Model,
        (stages, limits): Question<'_>,
        admissible: bool,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagram {
        let has_halves = self.conditions.state.is_none() && limits.already >= limits.internal;
        let at_once = if has_halves { AT_ONCE } else { usize::MAX };
        let few = Limits {
            nodes: limits.nodes.min(at_once),
            ..limits.clone()
        };
        let built = self.one_end(model, (stages, &few), None, cancelled, progress);
        if !has_halves || !is_cut(built.stop) {
            return built;
        }
        let keep_output = admissible && self.conditions.keep_output;
        let parts = self.both_ends(model, stages, keep_output);
        let halves = self.two_sided(model, &parts, (limits, keep_output), cancelled, progress);
        match halves {
            Some(whole) => whole,
            None if few.nodes < limits.nodes => {
                self.one_end(model, (stages, limits), None, cancelled, progress)
            }
            None => built,
        }
    }

    /// The diagram of a question that is not to be counted.
    fn uncounted(
        &self,
        (stages, limits): Question<'_>,
        cancelled: &(dyn Fn() -> bool + Sync),
        progress: &mut (dyn FnMut(Progress) + Send),
    ) -> Diagram {
        let few = &Limits {
            nodes: 1,
            ..limits.clone()
        };
        let model = &self.least.whole;
        let mut few = self.one_end(model, (stages, few), None, cancelled, progress);
        if few.stop != Stop::Interrupted {
            few.stop = Stop::NotCounted;
        }
        few
    }

    /// Finds the cheapest admissible variants where they are wanted and not all are known; `end` is the least dimension of
    /// the last nodes.
    fn prove(&self, out: &mut Diagrams, question: Question<'_>, end: usize, build: Build<'_>) {
        let most = BigUint::from(self.conditions.cheapest);
        let known = matches!(out.admissible.stop, Stop::Exhausted | Stop::Interrupted);
        if known || most.is_zero() {
            return;
        }
        let missing = Missing::new(&self.least.whole.space, question.0, question.1, end);
        if missing.root().is_none() {
            // There is none, by dimensions alone.
            out.admissible.stop = Stop::Exhausted;
            return;
        }
        let known = self.cost_of(&out.admissible, &most).flatten();
        let build = &mut |ceiling: &mut Ceiling<'_>| build(question, ceiling);
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
}
