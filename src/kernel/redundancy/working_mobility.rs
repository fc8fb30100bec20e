//! The mobility that is at work: that of the output links.

use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{LinkId, Mechanism, Role, StateId};
use crate::redundancy::motion::{Speeds, motions, twist};

/// Dimension of the output links' joint motion, alone.
///
/// # Errors
/// Where a coordinate has no image in the field.
///
/// # Complexity
/// O(f³) field operations for f freedoms.
pub fn working_mobility(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
) -> Result<usize, ExactError> {
    let closure = Closure::new(exact, mechanism, state)?;
    let kernel = motions(exact, &closure);
    let outputs = outputs(mechanism);
    Ok(span_of_links(exact, mechanism, &closure, &kernel, &outputs))
}

/// The links whose motion is wanted.
pub(super) fn outputs(mechanism: &Mechanism) -> Vec<LinkId> {
    mechanism
        .link_ids()
        .filter(|&l| mechanism.links[l].role == Role::Output)
        .collect()
}

/// Dimension of the joint motion of some links over a basis of motions.
pub(super) fn span_of_links(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    kernel: &[Speeds],
    links: &[LinkId],
) -> usize {
    let paths = closure.link_motions(exact, mechanism, links);
    let mut span = Echelon::new(exact.field());
    for speeds in kernel {
        let all: Vec<Residue> = paths.iter().flat_map(|p| twist(exact, p, speeds)).collect();
        span.insert(&all);
    }
    span.rank()
}
