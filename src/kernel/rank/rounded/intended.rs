//! One mechanism for several states: what a search, which is exact, takes for the one that is meant.

use crate::model::mechanism::{Mechanism, StateId};
use crate::model::rounded::looks_rounded;
use crate::rank::method::NoAnswer;
use crate::rank::rounded::moves::{moves, understood};
use crate::rank::rounded::snap::relation::{Moved, Reach};
use crate::rank::rounded::snap::{size, snap};
use crate::rank::rounded::verdict::{RankVerdict, rank_of, resolved, verdict_on};

/// The mechanism that is meant, for exact arithmetic.
#[derive(Debug, Clone, Default)]
pub struct Settled {
    /// The snapped mechanism, where that is meant or asked for; `None` where the file is taken as written.
    pub snapped: Option<Mechanism>,
    /// The same as other scenes have it that the digits do not rule out.
    pub others: Vec<Mechanism>,
    /// What was moved.
    pub moved: Vec<Moved>,
    /// What was understood, where digits say what is meant.
    pub understood: Option<String>,
    /// What would have had to move further than is asked for, and was not.
    pub refused: Vec<Moved>,
    /// The verdicts on the states; none where every digit is exact and no tolerance is asked for, so that there is nothing to
    /// decide.
    pub verdicts: Vec<RankVerdict>,
    /// The first of them that the mechanism does not have the rank of, with the rank it has.
    pub open: Option<(usize, usize)>,
}

/// Settles which mechanism is meant in some states; `tolerance` is that of `--snap`.
///
/// # Errors
/// As [`verdict`](crate::rank::rounded::verdict::verdict).
///
/// # Guarantee
/// Where nothing is open, the exact rank of J in each state is that of the verdict on it.
pub fn settle(
    mechanism: &Mechanism,
    states: &[StateId],
    tolerance: Option<f64>,
) -> Result<Settled, NoAnswer> {
    let mut out = Settled::default();
    if tolerance.is_none() && looks_rounded(mechanism).is_none() {
        return Ok(out);
    }
    let scene = resolved(mechanism, tolerance);
    let each = |&s: &StateId| verdict_on(mechanism, s, tolerance, scene.as_ref());
    out.verdicts = states.iter().map(each).collect::<Result<_, _>>()?;
    let (found, moved, refused) = match (tolerance, &scene) {
        (Some(t), _) => {
            let snapped = snap(mechanism, Reach::relative(t, size(mechanism)));
            (snapped.mechanism, snapped.moved, snapped.refused)
        }
        (None, Some(s)) if s.scene.moved > 0.0 => (s.mechanism.clone(), moves(s), Vec::new()),
        (None, _) => (mechanism.clone(), Vec::new(), Vec::new()),
    };
    for (i, (v, &state)) in out.verdicts.iter().zip(states).enumerate() {
        let rank = rank_of(&found, state)?;
        if !v.is_decided() || rank != v.rank() {
            out.open = Some((
                i,
                if tolerance.is_some() {
                    rank
                } else {
                    v.as_written
                },
            ));
            break;
        }
    }
    // What was asked for is done; what the digits say, only where it is right.
    let right = tolerance.is_some() || out.open.is_none();
    if right {
        out.understood = scene.as_ref().filter(|_| !moved.is_empty()).map(understood);
        out.others = scene.map(|s| s.others).unwrap_or_default();
    }
    if right && (tolerance.is_some() || !moved.is_empty()) {
        out.snapped = Some(found);
        out.moved = moved;
        out.refused = refused;
    }
    Ok(out)
}
