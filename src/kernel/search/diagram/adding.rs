//! What happens in each layer of a diagram in the space dual to self-stresses.

use crate::linalg::modp::Field;
use crate::search::diagram::choice_inclusion::{Grown, one_from_another};
use crate::search::diagram::stage::Collapse;
use crate::search::reduce::self_stress_space::SelfStressSpace;

/// A variable of the diagram in the space dual to self-stresses.
#[derive(Debug, Clone)]
pub(in crate::search) struct Adding {
    /// Index of the variable in the space.
    pub(in crate::search) variable: usize,
    /// Its choices, one grown from another.
    pub(in crate::search) growth: Vec<Grown>,
    /// Coordinates before the stage.
    pub(in crate::search) width: usize,
    /// How many of them are of contours; those of kept links come after these.
    pub(in crate::search) contours: usize,
    /// The first of them, which no variable after this one reaches.
    pub(in crate::search) gap: usize,
    /// Simplification of motions of kept links that no variable after this one reaches.
    pub(in crate::search) collapse: Option<Collapse>,
}

/// The stages of a space for the variables in its order.
pub(in crate::search) fn adding(
    field: Field,
    order: &[usize],
    space: &SelfStressSpace,
) -> Vec<Adding> {
    let stage = |(t, &variable): (usize, &usize)| {
        let spans: Vec<_> = space.added[t].iter().map(|c| &c[..]).collect();
        let (contours, after) = (space.contours[t], space.contours[t + 1]);
        let finished = after..after + space.finished[t];
        let all = after..after + space.kept;
        Adding {
            variable,
            growth: one_from_another(field, &spans),
            width: contours + space.kept,
            contours,
            gap: contours - after,
            collapse: (!finished.is_empty()).then(|| Collapse::at_rest(finished, all)),
        }
    };
    order.iter().enumerate().map(stage).collect()
}
