//! Results for inaccurate drives, as text and as data.

use crate::drive::RunShares;
use crate::drive::programme::PATIENCE;
use crate::view::prelude::*;
use std::collections::BTreeMap;

/// Maximum number of first failures in a text.
const SHOWN: usize = 6;

/// Returns the swings that are the first to miss their latch, the earliest first: the swing, counted from 1 over the rounds of the
/// programme, its disc, 1 or 2, and in how many samples.
fn first_failures(s: &RunShares) -> Vec<[usize; 3]> {
    let mut at: BTreeMap<usize, usize> = BTreeMap::new();
    for after in s.failures() {
        *at.entry(after).or_default() += 1;
    }
    let disc = |after: usize| s.discs[after % s.discs.len()] + 1;
    let each = at.into_iter();
    each.map(|(after, samples)| [after + 1, disc(after), samples])
        .collect()
}

#[allow(clippy::cast_precision_loss, reason = "counts of samples")]
fn share(n: usize, of: usize) -> f64 {
    n as f64 / of as f64
}

/// Returns how many samples still drift when counting stops.
fn drifting(s: &RunShares) -> usize {
    s.long_runs.len() - s.lasting() - s.failures().count()
}

/// Returns them as data.
pub(super) fn json(s: &RunShares) -> Value {
    let (samples, once) = (s.long_runs.len(), s.discs.len());
    let swings = samples * once;
    let failure = |[swing, disc, samples]: [usize; 3]| json!({ "swing": swing, "disc": disc, "samples": samples });
    json!({
        "samples": samples,
        "tolerance": s.tolerance,
        // Swings of the programme run once, of all samples.
        "swings": swings,
        "latched": s.latched(),
        "latched_share": (once > 0).then(|| share(s.latched(), swings)),
        "complete": s.complete(),
        "complete_share": share(s.complete(), samples),
        "lasting": s.lasting(),
        "lasting_share": share(s.lasting(), samples),
        "drifting": drifting(s),
        "failing": s.failures().count(),
        "first_failures": first_failures(s).into_iter().map(failure).collect::<Value>(),
    })
}

/// Adds them as lines of the report.
pub(super) fn write(out: &mut Report, s: &RunShares) {
    let (samples, swings) = (s.long_runs.len(), s.long_runs.len() * s.discs.len());
    let percent = |n: usize, of: usize| format!("{:.1} %", 100.0 * share(n, of));
    let (all, out_by) = (plural(samples, "drive"), significant(100.0 * s.tolerance));
    let (latched, complete, lasting) = (s.latched(), s.complete(), s.lasting());
    let first = if swings > 0 {
        let of = plural(swings, "swing");
        format!("{latched} of {of} latched ({}), ", percent(latched, swings))
    } else {
        String::new()
    };
    let drifting = match drifting(s) {
        0 => String::new(),
        n => format!(", {n} still drift after {PATIENCE} swings"),
    };
    out.line(format!(
        "  of {all} with stiffness, inertias, losses, cam and latches out by up to {out_by} %: {first}\
         {complete} end the programme ({}), {lasting} repeat it without end ({}){drifting}",
        percent(complete, samples),
        percent(lasting, samples)
    ));
    let failures = first_failures(s);
    let Some([last, ..]) = failures.last() else {
        return;
    };
    let words =
        |[swing, disc, samples]: &[usize; 3]| format!("swing {swing} (disc {disc}) in {samples}");
    let first = failures.iter().take(SHOWN).map(words).join(", ");
    let later = match failures.iter().skip(SHOWN).map(|f| f[2]).sum::<usize>() {
        0 => String::new(),
        later => format!(", a later one in {later}, up to swing {last}"),
    };
    out.line(format!("    first to miss its latch: {first}{later}"));
}
