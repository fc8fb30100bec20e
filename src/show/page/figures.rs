//! The figures of a variant in every state.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::model::mechanism::{LinkId, Mechanism, Role, StateId};
use crate::rank::exact::modular;
use crate::redundancy::contour_shares::shares;
use crate::redundancy::local_mobility::idle_motions;
use crate::redundancy::motion::motions;
use crate::view::analysis::idle;

/// W and σ of a state of a mechanism.
pub(super) fn figures(
    exact: &ExactField,
    m: &Mechanism,
    state: StateId,
) -> Result<(usize, usize), ExactError> {
    let closure = Closure::new(exact, m, state)?;
    let rank = modular::rank(exact, &closure);
    Ok((closure.columns.len() - rank, closure.rows() - rank))
}

/// Its idle motions in the free state, in words.
pub(super) fn idle(exact: &ExactField, m: &Mechanism) -> Result<String, ExactError> {
    let closure = Closure::new(exact, m, StateId::FREE)?;
    let kernel = motions(exact, &closure);
    let outputs: Vec<LinkId> = m
        .link_ids()
        .filter(|&l| m.links[l].role == Role::Output)
        .collect();
    let found = idle_motions(exact, m, &closure, &kernel, &outputs);
    Ok(idle::told_once(found.iter().map(|i| idle::words(m, i))).join("; "))
}

/// σ of each of its contours in the free state.
pub(super) fn redundant_by_contour(
    exact: &ExactField,
    m: &Mechanism,
) -> Result<Vec<usize>, ExactError> {
    let closure = Closure::new(exact, m, StateId::FREE)?;
    Ok(shares(exact, &closure)
        .iter()
        .map(|s| s.redundant)
        .collect())
}
