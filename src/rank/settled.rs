//! One mechanism for several states: what a search, which is exact, takes for the one that is meant.

use crate::model::mechanism::{Mechanism, StateId};
use crate::model::rounded::looks_rounded;
use crate::rank::method::NoAnswer;
use crate::rank::snap::relation::{Moved, Reach};
use crate::rank::snap::{size, snap};
use crate::rank::verdict::{Verdict, rank_of, reach, verdict};

/// The mechanism that is meant, for exact arithmetic.
#[derive(Debug, Clone, Default)]
pub struct Settled {
    /// It, where it was snapped because that is what is meant or asked for; none where it is as written.
    pub snapped: Option<Mechanism>,
    /// What was moved.
    pub moved: Vec<Moved>,
    /// What would have had to move further than is asked for, and was not.
    pub refused: Vec<Moved>,
    /// The verdicts on the states; none where every digit is exact and no tolerance is asked for, so that there is nothing to
    /// decide.
    pub verdicts: Vec<Verdict>,
    /// The first of them that the mechanism does not have the rank of, with the rank it has.
    pub open: Option<(usize, usize)>,
}

/// Settles which mechanism is meant in some states; `tolerance` is that of `--snap`.
///
/// # Errors
/// As [`verdict`].
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
    let each = |&s: &StateId| verdict(mechanism, s, tolerance);
    out.verdicts = states.iter().map(each).collect::<Result<_, _>>()?;
    let within = match (tolerance, out.verdicts.iter().all(Verdict::is_as_written)) {
        (Some(t), _) => Some(Reach::relative(t, size(mechanism))),
        (None, true) => None,
        (None, false) => reach(mechanism),
    };
    let Some(within) = within else {
        return Ok(out);
    };
    let snapped = snap(mechanism, within);
    for (i, (v, &state)) in out.verdicts.iter().zip(states).enumerate() {
        let rank = rank_of(&snapped.mechanism, state)?;
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
    if tolerance.is_some() || out.open.is_none() {
        out.snapped = Some(snapped.mechanism);
        out.moved = snapped.moved;
        out.refused = snapped.refused;
    }
    Ok(out)
}
