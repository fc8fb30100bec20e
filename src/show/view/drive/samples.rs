//! What became of drives out of true, as text and as data.

use crate::drive::RunShares;
use crate::drive::programme::PATIENCE;
use crate::view::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write;

/// First failures told before the rest is left out.
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

/// Writes them as lines of the report.
pub(super) fn write(out: &mut String, s: &RunShares) -> std::fmt::Result {
    let (samples, swings) = (s.long_runs.len(), s.long_runs.len() * s.discs.len());
    let percent = |n: usize, of: usize| format!("{:.1} %", 100.0 * share(n, of));
    write!(
        out,
        "  of {} with stiffness, inertias, losses, cam and latches out by up to {} %: ",
        plural(samples, "drive"),
        significant(100.0 * s.tolerance)
    )?;
    if swings > 0 {
        let (latched, of) = (s.latched(), plural(swings, "swing"));
        write!(
            out,
            "{latched} of {of} latched ({}), ",
            percent(latched, swings)
        )?;
    }
    write!(
        out,
        "{} end the programme ({}), {} repeat it without end ({})",
        s.complete(),
        percent(s.complete(), samples),
        s.lasting(),
        percent(s.lasting(), samples)
    )?;
    if drifting(s) > 0 {
        write!(out, ", {} still drift after {PATIENCE} swings", drifting(s))?;
    }
    writeln!(out)?;
    let failures = first_failures(s);
    let Some([last, ..]) = failures.last() else {
        return Ok(());
    };
    let told =
        |[swing, disc, samples]: &[usize; 3]| format!("swing {swing} (disc {disc}) in {samples}");
    let first: Vec<String> = failures.iter().take(SHOWN).map(told).collect();
    write!(out, "    first to miss its latch: {}", first.join(", "))?;
    match failures.iter().skip(SHOWN).map(|f| f[2]).sum::<usize>() {
        0 => writeln!(out),
        later => writeln!(out, ", a later one in {later}, up to swing {last}"),
    }
}
