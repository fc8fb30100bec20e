//! What can move: the kernel of the closure matrix, and the motions of links it gives.

use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{self, Echelon};
use crate::linalg::modp::Residue;
use crate::model::mechanism::{LinkId, Mechanism, StateId};

/// A motion of the whole mechanism: a speed for each column of J.
pub type Speeds = Vec<Residue>;

/// The motions a mechanism has in its reference pose: a basis of the kernel of J, reduced.
#[must_use]
pub fn motions(exact: &ExactField, closure: &Closure<Residue>) -> Vec<Speeds> {
    let mut columns = closure.dense(exact);
    // Without contours J has no rows; one row of zeros gives every column its own motion.
    columns
        .iter_mut()
        .filter(|c| c.is_empty())
        .for_each(|c| c.push(0));
    echelon::relations(exact.field(), &columns)
}

/// The twist of a link under a motion.
#[must_use]
pub(crate) fn twist(
    exact: &ExactField,
    link_motion: &[Vec<Residue>],
    speeds: &[Residue],
) -> Vec<Residue> {
    echelon::combination(exact.field(), link_motion, speeds)
}

/// The joint motion of some links in a state: the span of their twists, one after the other, reduced.
///
/// # Errors
/// Where a coordinate has no value in the field.
pub(crate) fn joint_motion(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
    links: &[LinkId],
) -> Result<Vec<Vec<Residue>>, ExactError> {
    let closure = Closure::new(exact, mechanism, state)?;
    let kernel = motions(exact, &closure);
    let of_links = closure.link_motions(exact, mechanism, links);
    let mut span = Echelon::new(exact.field());
    for speeds in &kernel {
        let whole: Vec<Residue> = of_links
            .iter()
            .flat_map(|m| twist(exact, m, speeds))
            .collect();
        span.insert(&whole);
    }
    Ok(span.reduced())
}
