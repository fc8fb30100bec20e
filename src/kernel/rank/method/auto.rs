//! The automatic choice: the cheapest method that is certain for this mechanism. One line states the choice, the
//! reason, and what was omitted.

use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::closure_of;
use crate::rank::exact::modular;
use crate::rank::finite::second_order::Roundings;
use crate::rank::finite::{
    Finite, How, finite_known, finite_mobility, followed_mobility, mobility_within,
};
use crate::rank::method::{Answer, Certainty, MobilityMethod, NoAnswer, Quantity, RankOfJ, to_i64};
use crate::rank::numeric::Elimination;
use crate::rank::rounded::verdict::{Meant, RankVerdict, allowed_uncertainty, rank_verdict};

/// A decision for one state.
#[derive(Debug, Clone)]
pub struct Decision {
    /// The rank, and the mechanism it belongs to.
    pub verdict: RankVerdict,
    /// The finite mobility.
    pub finite: Finite,
    /// The choice, the reason, and what was omitted.
    pub line: String,
}

/// Decides for a state.
///
/// # Errors
/// Returns an error if the geometry has no image in a prime field, or if the singular values do not converge.
///
/// # Complexity
/// That of [`rank_verdict`], and of the finite mobility.
///
/// # Examples
/// ```
/// use ozols::{model::mechanism::StateId, rank::method::auto::decide_state};
/// let decision = decide_state(&ozols::built_in("bennett")?, StateId::FREE)?;
/// assert_eq!((decision.verdict.rank(), decision.finite.mobility), (3, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn decide_state(mechanism: &Mechanism, state: StateId) -> Result<Decision, NoAnswer> {
    let verdict = rank_verdict(mechanism, state)?;
    Ok(Decision {
        finite: finite_of(mechanism, state, &verdict)?,
        line: describe_choice(&verdict),
        verdict,
    })
}

/// Returns the finite mobility of the intended geometry.
fn finite_of(m: &Mechanism, state: StateId, found: &RankVerdict) -> Result<Finite, NoAnswer> {
    let half = allowed_uncertainty(m, found.rounded.as_ref());
    // The moved coordinates are off by at most half a unit. The moved and the true coordinates may lie on either side
    // of the written ones.
    let times = if found.is_as_written() { 1.0 } else { 2.0 };
    let known = half.map(|half| Roundings::new(m, half, times));
    let exactly = |m: &Mechanism, rank: usize| {
        let (exact, closure) = closure_of(m, state, 0)?;
        finite_known(&exact, m, &closure, rank, known.as_ref())
    };
    Ok(match &found.meant {
        Meant::AsWritten => exactly(m, found.as_written)?,
        Meant::Snapped {
            mechanism, rank, ..
        } => exactly(mechanism, *rank)?,
        Meant::Near {
            mechanism, rank, ..
        } => {
            let motions = found.figures_at(*rank).0;
            match &known {
                Some(known) => mobility_within(mechanism, state, motions, known)?,
                None => followed_mobility(mechanism, state, motions, 0.0)?,
            }
        }
        Meant::Undecided { near } => Finite::between(0, found.figures_at(*near).0, How::Rounded),
    })
}

/// Describes the choice and the reason.
fn describe_choice(found: &RankVerdict) -> String {
    let needed = &found.needed;
    let Some(n) = found.numeric else {
        return format!("exact geometry, so ranks over prime fields{needed}");
    };
    let measured = found.rounded.as_ref().is_some_and(|r| r.digits.is_some());
    let why = match &found.rounded {
        Some(r) if r.pi => format!("pi is not an exact number ({r}); "),
        Some(r) if measured => format!("coordinates look measured ({r}); "),
        Some(r) if !found.is_as_written() => format!("coordinates look rounded ({r}); "),
        _ => String::new(),
    };
    let gap = format!(
        "singular values at tolerance {:.0e} (smallest kept {:.1e}, largest dropped {:.1e})",
        found.tolerance, n.kept, n.dropped
    );
    let both = if found.as_written == found.at_least() {
        "with every digit exactly as written, the rank is the same".to_owned()
    } else {
        format!(
            "with every digit exactly as written, the rank would be {} (mobility {}) instead of {} (mobility {})",
            found.as_written,
            found.figures_at(found.as_written).0,
            found.at_least(),
            found.figures_at(found.at_least()).0
        )
    };
    match &found.meant {
        Meant::AsWritten if measured => {
            format!("{why}exact rank as written and {gap} agree{needed}")
        }
        Meant::AsWritten => format!(
            "exact geometry, so ranks over prime fields; no rounding of the last digits changes them{needed}"
        ),
        Meant::Snapped { moved, .. } => format!(
            "{why}snapped within the digits ({moved} joints), then exact rank; {gap} agree; {both}"
        ),
        Meant::Near { moved: units, .. } => format!(
            "{why}a geometry with that rank is within {units:.2} units of the last digits; {gap}; {both}"
        ),
        Meant::Undecided { .. } => format!("{why}{}", found.explain_undecided()),
    }
}

/// Returns the answer of a finite mobility that is decided.
fn finite_answer(found: &Finite) -> Answer {
    Answer {
        mobility: to_i64(found.mobility),
        quantity: Quantity::Finite,
        certainty: if found.is_proven() {
            Certainty::Exact
        } else {
            Certainty::Traced
        },
    }
}

/// The automatic choice as a method; finite mobility.
pub(crate) const AUTO: MobilityMethod = MobilityMethod {
    name: "auto",
    title: "automatic choice",
    help: "The cheapest certain method: exact if the geometry is exact, idealised within the digits if it is rounded",
    guarantee: "as the chosen method, which is reported; finite mobility, or undecided",
    complexity: "one modular rank, and singular values only if coordinates are decimals",
    source: "this program",
    rank: RankOfJ::Chosen,
    answer: answer_auto,
};

fn answer_auto(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    let Decision {
        verdict, finite, ..
    } = decide_state(mechanism, state)?;
    if let Meant::Undecided { .. } = verdict.meant {
        return Err(NoAnswer::Failed(verdict.explain_undecided()));
    }
    if finite.is_undecided() {
        return Err(NoAnswer::Failed(finite.describe()));
    }
    let numeric = verdict
        .numeric
        .filter(|_| matches!(verdict.meant, Meant::Near { .. }));
    let answer = finite_answer(&finite);
    Ok(match numeric {
        Some(n) => Answer {
            certainty: Elimination::Svd.certainty_of(n, verdict.tolerance),
            ..answer
        },
        None => answer,
    })
}

/// Exact rank at the pose, then [`finite`], as a method.
pub(crate) const FINITE: MobilityMethod = MobilityMethod {
    name: "finite",
    title: "finite mobility, exact geometry",
    help: "Exact rank, and the finite mobility",
    guarantee: "proven if groups or higher orders decide; otherwise followed numerically, or undecided",
    complexity: "one modular rank; otherwise about ten to a few hundred closings of O((6k)² f)",
    source: "Hervé 1978 (groups); Connelly & Whiteley 1996, Müller 2016 (second and higher order); Bates et al. 2009, Wampler, Hauenstein & Sommese 2011 (local dimension)",
    rank: RankOfJ::Exact,
    answer: answer_finite,
};

fn answer_finite(mechanism: &Mechanism, state: StateId) -> Result<Answer, NoAnswer> {
    let (exact, closure) = closure_of(mechanism, state, 0)?;
    let found = finite_mobility(
        &exact,
        mechanism,
        &closure,
        modular::rank_modulo(&exact, &closure),
    )?;
    if found.is_undecided() {
        return Err(NoAnswer::Failed(found.describe()));
    }
    Ok(finite_answer(&found))
}
