//! Diagrams built in the space dual to the self-stresses of the present joints.
//!
//! A node is what the choices so far add there, within what the rest can still reach: the rest must reach all that is missing, or
//! the node is dead. That space is smaller than the motions of all live links, and nodes that differ in what a present joint to
//! come allows anyway are one in it. It holds for the free state, whose joints all have their present motion in every variant.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::adding::{Adding, Kept, adding};
use crate::search::diagram::choice_inclusion::Grown;
use crate::search::diagram::minimize::minimal;
use crate::search::diagram::redundancy_so_far::{Limits, Spent};
use crate::search::diagram::transition::{Children, Worker};
use crate::search::diagram::{self, Carries, DEAD, Diagram, Layer, Progress};
use crate::search::question::Question;
use crate::search::question::throughout::ORDER;
use crate::search::reduce::plane_split::Model;
use crate::search::reduce::self_stress_space::{ClosingRows, SelfStressSpace, is_contained};

/// Which variants a diagram has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::search) enum Wanted {
    /// Those that are determinate, whatever becomes of the motion of outputs and drives.
    Determinate,
    /// Those of them that keep this motion in the drawn pose.
    Keeping,
    /// Those of them that keep it throughout the motion of the mechanism as built.
    Lasting,
}

impl Wanted {
    /// Returns the variants of the diagram of determinate or of admissible ones.
    pub(in crate::search) fn of(question: &Question, admissible: bool) -> Wanted {
        if admissible && question.conditions.keep_output {
            Wanted::Keeping
        } else {
            Wanted::Determinate
        }
    }

    /// Returns the rows that their diagram is built of.
    pub(in crate::search) fn model(self, question: &Question) -> &Model {
        match &question.throughout {
            Ok(along) if self == Wanted::Lasting => &along.model,
            _ => &question.model,
        }
    }
}

/// A stage, within limits.
pub(in crate::search) struct Added<'a> {
    field: Field,
    stage: Adding,
    limits: &'a Limits,
}

impl<'a> Added<'a> {
    pub(in crate::search) fn new(field: Field, stage: Adding, limits: &'a Limits) -> Self {
        Added {
            field,
            stage,
            limits,
        }
    }

    /// What its choices add, one grown from another.
    pub(in crate::search) fn growth(&self) -> &[Grown] {
        &self.stage.growth
    }

    /// The coordinates of contours in use.
    pub(in crate::search) fn contours(&self) -> &[usize] {
        &self.stage.contours
    }
}

impl Carries for Added<'_> {
    fn variable(&self) -> usize {
        self.stage.variable
    }

    fn worker(&self) -> Worker {
        Worker::new(self.field, 0)
    }

    fn effort(&self, bytes: usize) -> usize {
        bytes / size_of::<Residue>() * self.stage.width
    }

    fn children(&self, worker: &mut Worker, matrix: &[Residue], spent: &Spent, out: &mut Children) {
        worker.children_added(&self.stage, matrix, spent, self.limits, out);
    }
}

/// The space dual to self-stresses for the variables of a question in an order; none where a choice lacks a motion of its present joint,
/// or where the motion is not followed that variants are to keep.
pub(in crate::search) fn space(
    question: &Question,
    order: &[usize],
    wanted: Wanted,
) -> Option<SelfStressSpace> {
    let kept = (wanted != Wanted::Determinate).then_some(&question.kept);
    let field = question.exact.field();
    let (mechanism, space) = (&question.mechanism, &wanted.model(question).space);
    let rows = ClosingRows::new(mechanism, space.dim, &question.contours, kept);
    if !order.iter().all(|&v| is_contained(field, space, v)) {
        return None;
    }
    if wanted != Wanted::Lasting {
        let of = |v: usize, c: usize| rows.columns(field, &space.variables[v], c);
        return Some(SelfStressSpace::new(field, &rows, 1, space, order, &of));
    }
    let along = question.throughout.as_ref().ok()?;
    let of = |v: usize, c: usize| {
        let freedoms = along.of_choice(v, c).iter();
        freedoms
            .flat_map(|(joint, series)| rows.multiples(field, *joint, series))
            .collect()
    };
    Some(SelfStressSpace::new(field, &rows, ORDER, space, order, &of))
}

/// The diagram of a question without a searched state, for the variables in an order: the smallest there is, or what fits the limits;
/// none where a choice lacks a motion of its present joint.
///
/// # Complexity
/// O(nodes · choices · s²) field operations for s present self-stresses.
pub(in crate::search) fn in_self_stress_space(
    question: &Question,
    order: &[usize],
    limits: &Limits,
    wanted: Wanted,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Option<Diagram> {
    let field = question.exact.field();
    let added = space(question, order, wanted)?;
    let already = limits.already.saturating_add(added.lasting);
    if already > limits.internal {
        return Some(nothing(question, order));
    }
    let stages = adding(field, order, &added, Kept::Live);
    let over = |stage| Added::new(field, stage, limits);
    let stages: Vec<Added<'_>> = stages.into_iter().map(over).collect();
    let space = &wanted.model(question).space;
    let built = diagram::build(space, &stages, limits, already, None, cancelled, progress);
    let stop = built.stop;
    let smallest = minimal(built.layers, built.terminals);
    Some(Diagram { stop, ..smallest })
}

/// The diagram of no variant, for variables in an order.
pub(in crate::search) fn nothing(question: &Question, order: &[usize]) -> Diagram {
    let layer = |(t, &variable): (usize, &usize)| {
        let choices = question.space.variables[variable].choices.len();
        Layer {
            variable,
            nodes: 1,
            choices,
            edges: vec![DEAD; choices * usize::from(t == 0)],
        }
    };
    minimal(order.iter().enumerate().map(layer).collect(), Vec::new())
}
