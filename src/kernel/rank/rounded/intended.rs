//! One mechanism for several states: the intended geometry, which the exact search uses.

use crate::model::mechanism::{Mechanism, StateId};
use crate::model::rounded::looks_rounded;
use crate::rank::method::NoAnswer;
use crate::rank::rounded::moves::{moved_joints, understood};
use crate::rank::rounded::verdict::{RankVerdict, rank_of, resolved, verdict_on};

/// The intended mechanism, for exact arithmetic.
#[derive(Debug, Clone, Default)]
pub struct Settled {
    /// The snapped mechanism if it is the intended one; `None` if the file is used as written.
    pub snapped: Option<Mechanism>,
    /// The mechanisms of other scenes that the digits do not exclude.
    pub others: Vec<Mechanism>,
    /// Description of the recovered relations, if the mechanism was snapped.
    pub understood: Option<String>,
    /// The verdicts on the states. Empty if every digit is exact, so that there is nothing to decide.
    pub verdicts: Vec<RankVerdict>,
    /// Index of the first verdict whose rank differs from that of the mechanism.
    pub open: Option<usize>,
}

/// Determines which mechanism is intended in some states.
///
/// # Errors
/// Returns an error in the same cases as [`verdict`](crate::rank::rounded::verdict::verdict).
///
/// # Guarantee
/// If no verdict is open, the exact rank of J in each state is that of its verdict.
pub fn settle(mechanism: &Mechanism, states: &[StateId]) -> Result<Settled, NoAnswer> {
    let mut out = Settled::default();
    if looks_rounded(mechanism).is_none() {
        return Ok(out);
    }
    let scene = resolved(mechanism);
    let each = |&s: &StateId| verdict_on(mechanism, s, scene.as_ref());
    out.verdicts = states.iter().map(each).collect::<Result<_, _>>()?;
    let snapped = scene.as_ref().filter(|s| s.scene.moved > 0.0);
    let found = snapped.map_or(mechanism, |s| &s.mechanism);
    for (i, (v, &state)) in out.verdicts.iter().zip(states).enumerate() {
        if !v.is_decided() || rank_of(found, state)? != v.rank() {
            out.open = Some(i);
            return Ok(out);
        }
    }
    if let Some(s) = snapped.filter(|s| !moved_joints(s).is_empty()) {
        out.understood = Some(understood(s));
        out.snapped = Some(s.mechanism.clone());
    }
    out.others = scene.map(|s| s.others).unwrap_or_default();
    Ok(out)
}
