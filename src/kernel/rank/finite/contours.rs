//! Contours analysed one by one.
//!
//! Suppose the closed poses of a single contour form a manifold with as many dimensions as move at first order. Among
//! all coordinates its codimension is then the rank of the contour. Manifolds whose ranks add up to that of J meet
//! transversally. So the poses that close all contours also form a manifold, of dimension f - rank J.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::mechanism::Mechanism;
use crate::motion::pose::Pose;
use crate::rank::exact::modular;
use crate::rank::finite::independent_parts::alone;
use crate::rank::finite::never_stopped::Expanded;
use crate::rank::finite::regular::regular;

/// Returns true if every contour on its own is at a regular pose of its motion, and no contour duplicates constraints
/// of others.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One proof per contour, if their ranks add up to that of J.
pub(super) fn are_apart(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
) -> Result<bool, ExactError> {
    if closure.contours.len() < 2 || !closure.couplings.is_empty() {
        return Ok(false);
    }
    let mut each = Vec::new();
    for contour in &closure.contours {
        let joints: Vec<_> = contour.joints.iter().map(|&(j, _)| j).collect();
        let part = alone(mechanism, &joints);
        let own = Closure::new(exact, &part, closure.state)?;
        let rank = modular::rank(exact, &own);
        each.push((part, own, rank));
    }
    if each.iter().map(|(_, _, rank)| rank).sum::<usize>() != rank {
        return Ok(false);
    }
    for (part, own, rank) in &each {
        let proven = regular(exact, part, own, *rank)?.is_some()
            || Expanded::new(exact, part, own, &Pose::of_file(part, own.state)?, *rank)?
                .is_never_stopped();
        if !proven {
            return Ok(false);
        }
    }
    Ok(true)
}
