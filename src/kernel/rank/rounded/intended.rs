//! One mechanism for several states: what a search, which is exact, takes for the one that is meant.

use crate::model::mechanism::{Mechanism, StateId};
use crate::model::rounded::looks_rounded;
use crate::rank::method::NoAnswer;
use crate::rank::rounded::moves::{moved_joints, understood};
use crate::rank::rounded::verdict::{RankVerdict, rank_of, resolved, verdict_on};

/// The mechanism that is meant, for exact arithmetic.
#[derive(Debug, Clone, Default)]
pub struct Settled {
    /// The snapped mechanism, where that is meant; `None` where the file is taken as written.
    pub snapped: Option<Mechanism>,
    /// The same as other scenes have it that the digits do not rule out.
    pub others: Vec<Mechanism>,
    /// What was understood, where the mechanism was snapped.
    pub understood: Option<String>,
    /// The verdicts on the states; none where every digit is exact, so that there is nothing to decide.
    pub verdicts: Vec<RankVerdict>,
    /// The first of them that the mechanism does not have the rank of.
    pub open: Option<usize>,
}

/// Settles which mechanism is meant in some states.
///
/// # Errors
/// As [`verdict`](crate::rank::rounded::verdict::verdict).
///
/// # Guarantee
/// Where nothing is open, the exact rank of J in each state is that of the verdict on it.
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
