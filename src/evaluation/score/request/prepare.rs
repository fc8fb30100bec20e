//! Preparation of a mechanism for a search: the geometry that is meant, and notes about rounded coordinates.

use crate::file::problem::ImportError;
use crate::file::read::resolve::contains_option;
use crate::file::read::search::costs_from_str;
use crate::model::mechanism::{Joint, JointOption, Mechanism};
use crate::model::rounded::Rounded;
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::rank::rounded::verdict::Settled;
use crate::rank::rounded::verdict::{Meant, RankVerdict};
use crate::search::question::conditions::Written;
use crate::search::question::rounded_rank::Digits;
use std::sync::Arc;

/// The remedies for rounded coordinates.
pub(in crate::score) const CURE: &str = "write roots or expressions such as sqrt(3)/2, give more digits, or say how far they may be off in a [tolerance] table";

/// Why a geometry looks rounded, with the verdicts on its states.
pub type LooksRounded = (Rounded, Vec<RankVerdict>);

/// A mechanism made ready for a search.
#[derive(Debug)]
pub struct Prepared {
    /// The one that is searched: as meant, and with the options that the request leaves.
    pub mechanism: Mechanism,
    pub(in crate::score) settled: Settled,
    /// Where exact arithmetic does not have the mechanism that is meant: what its digits tell of ranks.
    pub(in crate::score) numeric: Option<Digits>,
    /// Where coordinates look rounded and exact arithmetic searches all the same: the mechanism as the file writes it.
    pub(in crate::score) written: Option<Written>,
}

/// Returns a mechanism prepared for a search, with its joints and options at the places they have in `file`.
pub(in crate::score) fn as_in_file(
    ready: &Mechanism,
    file: &Mechanism,
    settled: &Settled,
) -> Written {
    let adds = |j: &Joint| {
        let present = j.options.first();
        let wider = |p: &JointOption| {
            j.options
                .iter()
                .all(|o| contains_option(o, p) == Some(true))
        };
        present.is_none_or(wider)
    };
    Written {
        only_adds: ready.joints.iter().all(adds),
        mechanism: Arc::new(in_places(ready, file)),
        digits: digits_of(&settled.verdicts),
    }
}

/// Returns a mechanism prepared for a search, with its joints and options at the places of another.
fn in_places(ready: &Mechanism, file: &Mechanism) -> Mechanism {
    let mut out = ready.clone();
    for (joint, there) in out.edit().joints.iter_mut().zip(&file.joints) {
        joint.frame = there.frame.clone();
        let offered = |options: &mut [JointOption], named: &[JointOption]| {
            for option in options {
                let own = named.iter().find(|o| o.name == option.name);
                let pitch = option.frame.pitch.clone();
                // What the file does not list is offered in the joint's own frame.
                option.frame = own.map_or(&there.frame, |o| &o.frame).clone();
                if own.is_none() {
                    option.frame.pitch = pitch;
                }
            }
        };
        offered(&mut joint.options, &there.options);
        offered(&mut joint.unloading, &there.unloading);
    }
    out
}

/// Tells what was understood, where something was moved.
pub(in crate::score) fn tell_moved(settled: &Settled, tell: &mut dyn FnMut(String)) {
    if let Some(all) = &settled.understood {
        tell(format!("snapped: {all}"));
    }
}

/// Returns how far the digits of a mechanism determine ranks, by the verdicts on it.
pub(in crate::score) fn digits_of(verdicts: &[RankVerdict]) -> Digits {
    let tolerance = |a: f64, v: &RankVerdict| a.max(v.tolerance);
    Digits {
        tolerance: verdicts.iter().fold(DEFAULT_TOLERANCE, tolerance),
        undecided: verdicts.iter().any(|v| !v.is_decided()),
    }
}

/// Returns the mechanism nearest to the written one that has the intended rank, if a verdict found one. Options that shared
/// a joint's frame still share it.
pub(in crate::score) fn nearest_exact(
    m: &Mechanism,
    verdicts: &[RankVerdict],
) -> Option<Mechanism> {
    let near = |v: &RankVerdict| match &v.meant {
        Meant::Near { mechanism, .. } => Some(mechanism.as_ref().clone()),
        _ => None,
    };
    let mut out = verdicts.iter().find_map(near)?;
    for (joint, before) in out.edit().joints.iter_mut().zip(&m.joints) {
        let offered = joint.options.iter_mut().chain(&mut joint.unloading);
        for option in offered.filter(|o| o.frame.is_same(&before.frame)) {
            let pitch = option.frame.pitch.clone();
            option.frame = joint.frame.clone();
            option.frame.pitch = pitch;
        }
    }
    Some(out)
}

impl Prepared {
    /// Returns the reason why the geometry looks rounded, if that may matter. `as_written` requests the geometry exactly as
    /// in the file.
    pub(in crate::score) fn looks_rounded(
        &self,
        as_written: bool,
        tell: &mut dyn FnMut(String),
    ) -> Option<LooksRounded> {
        let Prepared {
            mechanism, settled, ..
        } = self;
        let why = settled.verdicts.iter().find_map(|v| v.rounded.clone());
        let told = |why: Option<Rounded>| why.map(|w| (w, settled.verdicts.clone()));
        let Some(v) = settled.open.map(|i| &settled.verdicts[i]) else {
            let measured = |w: &Rounded| w.digits.is_some();
            let meant = settled.verdicts.iter().all(RankVerdict::is_as_written);
            if let (Some(w), true) = (why.as_ref().filter(|w| measured(w)), meant) {
                tell(looks_measured(&mechanism.name, w));
            }
            return told(why.filter(|w| measured(w) || !meant));
        };
        let differ = describe_difference(&mechanism.name, why.as_ref(), v);
        if as_written {
            tell(format!("warning: {differ}; {CURE}"));
        } else {
            tell(format!(
                "warning: {differ}. Exact arithmetic cannot represent the intended geometry, so variants are judged by singular values, \
                 and no figure is exact; {CURE}"
            ));
        }
        told(why)
    }
}

/// Returns the note about measured coordinates that change no figure.
fn looks_measured(name: &str, w: &Rounded) -> String {
    if w.pi {
        format!(
            "note: pi is not an exact number ({w}); its digits are used as written, and rounding them changes no figure"
        )
    } else {
        format!(
            "warning: the coordinates of {name} look measured ({w}). Exact and tolerant ranks agree for the original \
             mechanism, but the search uses the coordinates as written; {CURE}"
        )
    }
}

/// Describes how the rank as written differs from a verdict on the mechanism of this name.
fn describe_difference(name: &str, why: Option<&Rounded>, v: &RankVerdict) -> String {
    let looks = why.map_or_else(
        || {
            format!(
                "the mechanism {name} is not the same to within {:.0e}",
                v.tolerance
            )
        },
        |w| format!("the coordinates of {name} look rounded ({w}), and that matters"),
    );
    let [of, near] = [v.as_written, v.at_least()].map(|rank| v.figures_at(rank));
    let n = v.numeric.unwrap_or_default();
    let likely = if v.is_decided() {
        "is meant to have"
    } else {
        "may be meant to have"
    };
    format!(
        "{looks}: as written, state {} has W = {}, σ = {}; to within {:.0e} it {likely} W = {}, σ = {} (smallest singular \
         value kept {:.1e}, largest dropped {:.1e}). Exact ranks take rounding errors for real misalignments",
        v.state, of.0, of.1, v.tolerance, near.0, near.1, n.kept, n.dropped
    )
}

/// Puts the costs of a file in place of those of the mechanism.
pub(super) fn read_costs(
    mechanism: &mut Mechanism,
    file: &str,
    text: &str,
) -> Result<(), ImportError> {
    let mut stated = costs_from_str(file, text, mechanism)?;
    let costs = &mut mechanism.edit().search.costs;
    let named = |name: &String| stated.by_type_milli.iter().any(|(n, _)| n == name);
    costs.by_type_milli.retain(|(n, _)| !named(n));
    costs.by_type_milli.append(&mut stated.by_type_milli);
    costs.by_type_milli.sort();
    for ((_, old), (_, new)) in costs.other_costs().into_iter().zip(stated.other_costs()) {
        *old = new.or(*old);
    }
    Ok(())
}
