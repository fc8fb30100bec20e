//! Diagrams built in the space dual to the self-stresses of the present joints.
//!
//! A node is what the choices so far add there, within what the rest can still reach: the rest must reach all that is missing, or
//! the node is dead. That space is smaller than the motions of all live links, and nodes that differ in what a present joint to
//! come allows anyway are one in it. It holds for the free state, whose joints all have their present motion in every variant.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::adding::{Adding, adding};
use crate::search::diagram::minimize::minimal;
use crate::search::diagram::redundancy_so_far::{Limits, Spent};
use crate::search::diagram::transition::{Children, Worker};
use crate::search::diagram::{self, Carries, DEAD, Diagram, Layer, Progress};
use crate::search::question::Question;
use crate::search::reduce::plane_split::Model;
use crate::search::reduce::self_stress_space::SelfStressSpace;

/// A stage, within limits.
struct Added<'a> {
    field: Field,
    stage: &'a Adding,
    limits: &'a Limits,
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
        worker.children_added(self.stage, matrix, spent, self.limits, out);
    }
}

/// The space dual to self-stresses for the variables of a question in an order; none where a choice lacks a motion of its present joint.
pub(in crate::search) fn space(
    question: &Question,
    model: &Model,
    order: &[usize],
    keep_output: bool,
) -> Option<SelfStressSpace> {
    let kept = if keep_output {
        &question.kept.0[..]
    } else {
        &[]
    };
    let field = question.exact.field();
    SelfStressSpace::new(field, &question.mechanism, &model.space, order, kept)
}

/// The diagram of a question without a searched state, for the variables in an order: the smallest there is, or what fits the limits;
/// none where a choice lacks a motion of its present joint.
///
/// # Complexity
/// O(nodes · choices · s²) field operations for s present self-stresses.
pub(in crate::search) fn in_self_stress_space(
    question: &Question,
    model: &Model,
    order: &[usize],
    limits: &Limits,
    keep_output: bool,
    cancelled: &(dyn Fn() -> bool + Sync),
    progress: &mut (dyn FnMut(Progress) + Send),
) -> Option<Diagram> {
    let field = question.exact.field();
    let added = space(question, model, order, keep_output)?;
    let already = limits.already.saturating_add(added.lasting);
    if already > limits.internal {
        return Some(nothing(model, order));
    }
    let stages = adding(field, order, &added);
    let over = |stage| Added {
        field,
        stage,
        limits,
    };
    let stages: Vec<Added<'_>> = stages.iter().map(over).collect();
    let within = (limits, already, None);
    let built = diagram::build(&model.space, &stages, within, cancelled, progress);
    let stop = built.stop;
    let smallest = minimal(built.layers, built.terminals);
    Some(Diagram { stop, ..smallest })
}

/// The diagram of no variant, for variables in an order.
pub(in crate::search) fn nothing(model: &Model, order: &[usize]) -> Diagram {
    let layer = |(t, &variable): (usize, &usize)| {
        let choices = model.space.variables[variable].choices.len();
        Layer {
            variable,
            nodes: 1,
            choices,
            edges: vec![DEAD; choices * usize::from(t == 0)],
        }
    };
    minimal(order.iter().enumerate().map(layer).collect(), Vec::new())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin;
    use crate::file::text::mechanism_from_str;
    use crate::redundancy::analysis::exact_field;
    use crate::search::build::one_end;
    use crate::search::build::orders::orders;
    use crate::search::build::staging::laid;
    use crate::search::diagram::Stop;
    use crate::search::question::conditions::Conditions;

    /// Compares both diagrams of a question with the smallest of those made of motions of live links; how many were compared.
    fn compared(question: &Question) -> usize {
        let model = &question.least.whole;
        let laid = laid(question, &orders(question), model);
        let keep_output = question.conditions.keep_output;
        let both = [
            Some((&laid.determinate, false)),
            laid.admissible.as_ref().map(|s| (s, keep_output)),
        ];
        let mut count = 0;
        for (staged, keep_output) in both.into_iter().flatten() {
            let (stages, limits) = (staged.stages(), &staged.limits);
            let one = one_end(
                question,
                model,
                stages,
                limits,
                None,
                &|| false,
                &mut |_| {},
            );
            if one.stop != Stop::Exhausted {
                continue;
            }
            let other = in_self_stress_space(
                question,
                model,
                &staged.order,
                limits,
                keep_output,
                &|| false,
                &mut |_| {},
            );
            let [one, other] = [
                minimal(one.layers, one.terminals),
                other.expect("it is contained"),
            ];
            let edges = |d: &Diagram| {
                d.layers
                    .iter()
                    .map(|l| (l.variable, l.edges.clone()))
                    .collect::<Vec<_>>()
            };
            assert_eq!(edges(&one), edges(&other), "{}", question.mechanism.name);
            assert_eq!(
                one.terminals, other.terminals,
                "{}",
                question.mechanism.name
            );
            count += 1;
        }
        count
    }

    #[test]
    fn self_stresses_give_the_smallest_diagram_of_the_motions_of_links() {
        let mut count = 0;
        for (i, name) in builtin::names().into_iter().enumerate() {
            let text = builtin::text(name).expect("it is built in");
            let m = mechanism_from_str(name, text).expect("it is valid");
            let exact = exact_field(&m, 0).expect("it is exact");
            for keep_output in [false, true] {
                let conditions = Conditions {
                    max_redundant: [0, 1, 4][(i + usize::from(keep_output)) % 3],
                    keep_output,
                    nodes: 2_000,
                    ..Conditions::default()
                };
                let question = Question::new(exact.clone(), m.clone(), conditions);
                count += question.map_or(0, |q| compared(&q));
            }
        }
        assert!(count > 250, "{count}");
    }
}
