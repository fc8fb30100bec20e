//! Poses that are regular ones of their motion, proven by ranks and groups without following the motion.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::modp::Residue;
use crate::model::mechanism::Mechanism;
use crate::rank::exact::modular;
use crate::rank::finite::at_rest::lock_resting;
use crate::rank::finite::mobility::{Finite, How, Proof};
use crate::rank::finite::{bonds, displacement_group};

/// Returns what ranks alone prove: that nothing moves, or that all instantaneous motions are finite.
pub(super) fn by_ranks(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
) -> Result<Option<Finite>, ExactError> {
    let instantaneous = closure.columns.len() - rank;
    if instantaneous == 0 {
        return Ok(Some(Finite::new(0, How::Rigid)));
    }
    let dimension = dimension(exact, mechanism, closure)?;
    let by = Proof::Groups;
    Ok((rank == dimension).then_some(Finite::new(
        instantaneous,
        How::Submersion { dimension, by },
    )))
}

/// Returns the dimension of the groups that all contours move in, and of the couplings.
pub(super) fn dimension(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Result<usize, ExactError> {
    // Couplings are linear in the joints' coordinates, so dependent ones stay dependent all along the motion.
    let mut dimension = displacement_group::coupling_rank(exact, closure);
    for contour in &closure.contours {
        dimension += displacement_group::group_dimension(exact, mechanism, contour)?;
    }
    Ok(dimension)
}

/// Works as [`by_ranks`], also with the freedoms locked that are at rest to first order, and with chains and legs
/// reduced to single joints.
pub(super) fn regular(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    rank: usize,
) -> Result<Option<Finite>, ExactError> {
    if let Some(known) = by_ranks(exact, mechanism, closure, rank)? {
        return Ok(Some(known));
    }
    let instantaneous = closure.columns.len() - rank;
    let moving = match lock_resting(exact, mechanism, closure) {
        Some(locked) => {
            let own = Closure::new(exact, &locked, closure.state)?;
            let rank = modular::rank(exact, &own);
            if let Some(Finite {
                how: How::Submersion { dimension, .. },
                mobility,
                ..
            }) = by_ranks(exact, &locked, &own, rank)?
                && mobility == instantaneous
            {
                let by = Proof::Resting;
                return Ok(Some(Finite::new(
                    mobility,
                    How::Submersion { dimension, by },
                )));
            }
            bonds::mobility(exact, &locked, &own)?
        }
        None => bonds::mobility(exact, mechanism, closure)?,
    };
    // The motion with freedoms locked is a lower bound, and the instantaneous motion an upper one.
    let (dimension, by) = (rank, Proof::Bonds);
    Ok(moving
        .filter(|&m| m == instantaneous)
        .map(|m| Finite::new(m, How::Submersion { dimension, by })))
}
