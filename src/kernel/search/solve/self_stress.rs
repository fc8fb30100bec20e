//! Diagrams in the space dual to the self-stresses of the original joints.
//!
//! A node is the space that the choices so far add there, within what the rest can still reach. If the rest cannot reach all
//! that is missing, the node is dead. That space is smaller than the motions of all links. Nodes that differ only in motions
//! that a later original joint allows anyway are one node in it.

use crate::linalg::modp::Field;
use crate::model::mechanism::JointId;
use crate::search::diagram::minimize::minimize_diagram;
use crate::search::diagram::redundancy_so_far::{Limits, Role};
use crate::search::diagram::stage::{Columns, LaneStage, Stage};
use crate::search::diagram::{DEAD, Diagram, Layer};
use crate::search::question::Question;
use crate::search::question::throughout::{ColumnSeries, FreedomsAlong, ORDER, Throughout};
use crate::search::reduce::lifetimes::Lifetime;
use crate::search::reduce::lifetimes::Offered;
use crate::search::reduce::self_stress_space::{ClosingRows, SelfStressSpace};

/// Which variants a diagram has.
#[derive(Debug, Clone, Copy)]
pub(in crate::search) enum Wanted<'a> {
    /// Those that are determinate in the free state, whatever becomes of the motion of outputs and drives.
    Determinate,
    /// Those of them that keep this motion in the drawn pose, where it is to be kept, and do what is asked of the searched state.
    Admissible,
    /// Those of them that keep it throughout the motion of the mechanism as built; within the diagram of the admissible ones, if that is
    /// given.
    Lasting(Option<&'a Diagram>),
}

/// Maximum number of nodes in a layer of a known diagram. Following a wider one takes longer than it saves.
const FOLLOWED: usize = 1_024;

impl<'a> Wanted<'a> {
    /// Returns a diagram in the same order that has all wanted variants, if there is one that is worth following.
    pub(in crate::search) fn known(self) -> Option<&'a Diagram> {
        match self {
            Wanted::Lasting(known) => known.filter(|d| d.largest_layer <= FOLLOWED),
            _ => None,
        }
    }
}

/// Returns the limits of the diagrams of a question.
pub(in crate::search) fn diagram_limits(question: &Question) -> Limits {
    let state = question.conditions.state;
    Limits {
        layer: usize::MAX,
        internal: question.conditions.max_redundant,
        external: state.and_then(|s| s.max_external),
        harmful: state.and_then(|s| s.max_harmful),
        beside_free: question.state_joins_kept_links(),
        nodes: question.conditions.nodes,
        // Two primes with two diagrams each take half, and what is counted on them the rest.
        bytes: question.conditions.memory / 8,
    }
}

/// Returns the space dual to the self-stresses of the free state for the variables of a question in an order.
pub(in crate::search) fn self_stress_space(
    question: &Question,
    order: &[usize],
    wanted: Wanted<'_>,
) -> SelfStressSpace {
    if let (Wanted::Lasting(_), Ok(along)) = (wanted, &question.throughout) {
        return space_along_motion(question, along, order, ORDER);
    }
    let keeps = !matches!(wanted, Wanted::Determinate) && question.conditions.keep_output;
    let kept = keeps.then_some(&question.kept);
    let field = question.exact.field();
    let (mechanism, space) = (&question.mechanism, &question.space);
    let rows = ClosingRows::for_free_state(mechanism, space.dim, &question.contours, kept);
    let of_choice = |v: usize, c: usize| {
        let variable = &space.variables[v];
        if variable.external {
            return Vec::new();
        }
        rows.choice_columns(field, variable, c)
    };
    let present = order.iter().flat_map(|&v| of_choice(v, 0));
    let offered = order.iter().map(|&v| {
        let choices = 0..space.variables[v].choices.len();
        Offered::from_choices(choices.map(|c| of_choice(v, c)))
    });
    SelfStressSpace::new(field, &rows, 1, present, offered)
}

/// Returns the same space along the motion, modulo a power of t.
pub(in crate::search) fn space_along_motion(
    question: &Question,
    along: &Throughout,
    order: &[usize],
    powers: usize,
) -> SelfStressSpace {
    let kept = question.conditions.keep_output.then_some(&question.kept);
    let field = question.exact.field();
    let (mechanism, space) = (&question.mechanism, &question.space);
    let rows = ClosingRows::for_free_state(mechanism, space.dim, &question.contours, kept);
    let multiples = |(joint, series): &(JointId, ColumnSeries)| {
        rows.series_multiples(field, *joint, &series[..powers])
    };
    let present = order.iter().flat_map(|&v| along.of_choice(v, 0));
    let present = present.flat_map(multiples);
    let offered = order.iter().map(|&v| {
        let FreedomsAlong { columns, choices } = along.of_variable(v);
        let numbers = |of: &usize| of * powers..(of + 1) * powers;
        let choices = choices
            .iter()
            .map(|own| own.iter().flat_map(numbers).collect());
        Offered {
            vectors: columns.iter().flat_map(multiples).collect(),
            choices: choices.collect(),
        }
    });
    SelfStressSpace::new(field, &rows, powers, present, offered)
}

/// Returns the stages of a space for the variables in its order, in one lane in which no motion of kept links is forgotten. The diagram is
/// of variants without redundant constraints beyond those that all have.
pub(in crate::search) fn flat_stages<'a>(
    field: Field,
    order: &[usize],
    space: &SelfStressSpace,
    limits: &'a Limits,
) -> Vec<Stage<'a>> {
    let always = Lifetime {
        from: 0,
        to: usize::MAX,
    };
    let kept = space.kept.iter().map(|_| always);
    let lifetimes: Vec<Lifetime> = space.contours.iter().copied().chain(kept).collect();
    let stage = |(t, &variable): (usize, &usize)| {
        let all = 0..lifetimes.len();
        let coordinates: Vec<usize> = all.filter(|&c| lifetimes[c].is_live_at(t)).collect();
        let closing = coordinates.iter().filter(|&&c| lifetimes[c].to == t);
        let closing = closing.count();
        let added = &space.added[t];
        let columns = Columns::new(field, &lifetimes, t, &coordinates, closing, added);
        let lane = LaneStage {
            role: Role::Free,
            all: Columns {
                contours: coordinates.len() - space.kept.len(),
                ..columns
            },
            harmless: None,
            applies: Vec::new(),
        };
        Stage {
            field,
            variable,
            choices: added.len(),
            lanes: vec![lane],
            ending: None,
            limits,
        }
    };
    order.iter().enumerate().map(stage).collect()
}

/// Returns the diagram without variants, for variables in an order.
pub(in crate::search) fn empty_diagram(question: &Question, order: &[usize]) -> Diagram {
    let layer = |(t, &variable): (usize, &usize)| {
        let choices = question.space.variables[variable].choices.len();
        Layer {
            variable,
            nodes: 1,
            choices,
            edges: vec![DEAD; choices * usize::from(t == 0)],
        }
    };
    minimize_diagram(order.iter().enumerate().map(layer).collect(), Vec::new())
}
