//! Trials of an order: its layers, measured on a space of two choices a variable.
//!
//! A layer's nodes depend on the set of variables chosen so far and not on their order, so a trial is grown variable by
//! variable and never repeated. The number of nodes with the present joint and the freest one alone says well how many
//! there are with all choices: two or three in the one for tens and thousands in the other.

use crate::geom::exact::ExactField;
use crate::linalg::modp::Field;
use crate::model::mechanism::{LinkId, Mechanism};
use crate::search::diagram::Stop;
use crate::search::diagram::choice_inclusion::grown;
use crate::search::diagram::frontier::{At, Planner};
use crate::search::diagram::layer::{Merge, Nodes};
use crate::search::diagram::redundancy_so_far::Limits;
use crate::search::diagram::stage::Stage;
use crate::search::diagram::state_copies::Move;
use crate::search::diagram::transition::{Children, GrownStage, Worker};
use crate::search::question::space::{Choice, Space};
use std::rc::Rc;

/// Nodes of a layer that are looked at.
const WIDEST: usize = 256;

/// What trials of one search have in common.
pub(in crate::search) struct Trials<'m> {
    mechanism: &'m Mechanism,
    pub(in crate::search) space: Space,
    field: Field,
    limits: Limits,
    worker: Worker,
}

/// An order, as far as it has come.
#[derive(Clone)]
pub(in crate::search) struct Trial<'m> {
    /// The variables so far.
    pub(in crate::search) order: Vec<usize>,
    /// The work so far: the squares of the layers' widths.
    pub(in crate::search) work: u64,
    /// What is joined so far.
    pub(in crate::search) planner: Planner<'m>,
    nodes: Rc<Nodes>,
}

impl<'m> Trials<'m> {
    /// Trials of orders of these variables; links in `pinned` stay live to the end.
    pub(in crate::search) fn new(
        exact: &ExactField,
        mechanism: &'m Mechanism,
        space: &Space,
        variables: &[usize],
        pinned: &[LinkId],
        internal: u32,
    ) -> (Self, Trial<'m>) {
        let mut space = space.clone();
        for v in &mut space.variables {
            let freest = (v.choices.iter().enumerate())
                .max_by_key(|(i, c)| (c.freedoms, std::cmp::Reverse(*i)));
            let kept: Vec<Choice> = match freest {
                Some((i, freest)) if i > 0 => vec![v.choices[0].clone(), freest.clone()],
                _ => v.choices.drain(..).take(1).collect(),
            };
            v.choices = kept;
        }
        let joints = variables.iter().flat_map(|&v| &space.variables[v].joints);
        let at: Vec<At> = joints.map(|&joint| At { joint, lane: 0 }).collect();
        let trial = Trial {
            order: Vec::new(),
            work: 0,
            planner: Planner::new(mechanism, &at, pinned, &[]),
            nodes: Rc::new(Nodes::root(0)),
        };
        let limits = Limits {
            layer: usize::MAX,
            already: 0,
            internal,
            external: None,
            harmful: None,
            nodes: WIDEST,
            bytes: usize::MAX,
        };
        let worker = Worker::new(exact.field(), space.dim);
        (
            Trials {
                mechanism,
                space,
                field: exact.field(),
                limits,
                worker,
            },
            trial,
        )
    }

    /// Adds a variable to an order.
    pub(in crate::search) fn add(&mut self, trial: &mut Trial<'m>, variable: usize) {
        let of = &self.space.variables[variable];
        let joints = of.joints.iter().enumerate();
        let moves =
            joints.map(|(i, &joint)| Move::common(i, trial.planner.add(At { joint, lane: 0 })));
        let stage = Stage::plain(variable, moves.collect());
        let mut children = Children::new(of.choices.len());
        let growth = &grown(self.field, &self.space, &stage);
        let over = GrownStage {
            stage: &stage,
            growth,
        };
        for i in 0..trial.nodes.len() {
            self.worker.children(
                &self.space,
                over,
                trial.nodes.matrix(i),
                &trial.nodes.spent[i],
                &self.limits,
                &mut children,
            );
        }
        let mut merge = Merge::new(WIDEST, usize::MAX, Stop::Exhausted, children.found.len());
        merge.take(&children, &trial.nodes, |_| 0, |_, _, _| false);
        let width = merge.next.len() as u64;
        trial.work += width * width;
        trial.order.push(variable);
        trial.nodes = Rc::new(merge.next);
    }

    /// The links a joint of a variable is between, for each of its joints.
    pub(in crate::search) fn joined(
        &self,
        variable: usize,
    ) -> impl Iterator<Item = [LinkId; 2]> + '_ {
        let joints = self.space.variables[variable].joints.iter();
        joints.map(|&j| self.mechanism.joints[j].links)
    }
}
