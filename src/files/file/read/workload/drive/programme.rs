//! Swings and dwells in order.

use crate::file::Place;
use crate::file::read::value::quantity::Bound;
use crate::file::schema::DriveEntry;
use crate::model::drive::ProgrammeStep;

/// Most steps of a programme.
pub(in crate::file::read) const MOST: usize = 10_000;

/// Returns the given number of swings, of both discs in turn or only of the second, with a dwell after each if one is given.
#[must_use]
pub(crate) fn regular(stepwise: bool, swings: usize, dwell: Option<f64>) -> Vec<ProgrammeStep> {
    let mut steps = Vec::new();
    for i in 0..swings {
        // The second disc goes first, so that the first, which is ahead, is followed.
        steps.push(ProgrammeStep::Swing(if stepwise { (i + 1) % 2 } else { 1 }));
        steps.extend(dwell.map(ProgrammeStep::Dwell));
    }
    steps
}

/// Returns the steps of a file: those it lists, or the number of swings it asks for.
pub(crate) fn programme(t: &Place<'_>, e: &DriveEntry) -> Vec<ProgrammeStep> {
    let time = Bound::Range(0.0, 1e6, "a time from 0 to 1e6 s");
    let dwell = t.optional("dwell", &e.dwell, 1.0, time);
    let Some(list) = &e.programme else {
        return swings(t, e, dwell);
    };
    let beside = [
        ("motion", e.motion.is_some()),
        ("swings", e.swings.is_some()),
        ("dwell", e.dwell.is_some()),
    ];
    let given = beside.into_iter().filter(|(_, given)| *given);
    given.for_each(|(k, _)| t.excludes(k, "programme"));
    let at = t.key("programme");
    let mut steps = Vec::new();
    let count = at.number_of("number of steps", list.len(), MOST, "1 to 10000");
    if count.is_none() {
        return steps;
    }
    for (at, text) in at.entries(list) {
        let found = step(text);
        if found.is_none() {
            let allowed = "\"1\", \"2\" or a dwell such as \"wait 0.3\"";
            at.bad("step", format!("{text:?}"), allowed);
        }
        steps.extend(found);
    }
    steps
}

/// Returns the steps of a file that gives the number of swings and the dwell after each.
fn swings(t: &Place<'_>, e: &DriveEntry, dwell: Option<f64>) -> Vec<ProgrammeStep> {
    let ways = [("stepwise", true), ("reversing", false)];
    let stepwise = t.word("motion", &e.motion, &ways);
    let (at, allowed) = (t.key("swings"), "a whole number from 1 to 10000");
    let count = at.number_of("number of swings", e.swings.unwrap_or(8), MOST, allowed);
    count.map_or_else(Vec::new, |n| {
        regular(stepwise, n, dwell.filter(|d| *d > 0.0))
    })
}

/// Parses a step: "1" or "2" for a disc that swings, or "wait 0.3" for a dwell in s.
fn step(text: &str) -> Option<ProgrammeStep> {
    match text.trim() {
        "1" => Some(ProgrammeStep::Swing(0)),
        "2" => Some(ProgrammeStep::Swing(1)),
        other => {
            let time = other
                .strip_prefix("wait")?
                .trim()
                .trim_end_matches('s')
                .trim_end()
                .parse::<f64>()
                .ok()?;
            (0.0..=1e6)
                .contains(&time)
                .then_some(ProgrammeStep::Dwell(time))
        }
    }
}
