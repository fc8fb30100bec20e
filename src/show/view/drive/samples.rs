//! What became of drives out of true: one value from which text and JSON are made.

use crate::drive::RunShares;
use crate::drive::programme::PATIENCE;
use crate::format::{plural, significant};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;

/// First failures told before the rest is left out.
const SHOWN: usize = 6;

/// Of drives out of true.
#[derive(Debug, Serialize)]
pub struct Samples {
    /// How many.
    pub samples: usize,
    /// By how much each quantity is out at most, as a share of itself.
    pub tolerance: f64,
    /// Swings of the programme run once, of all samples.
    pub swings: usize,
    /// How many of them ended in a latch; none does after a failure.
    pub latched: usize,
    /// Their share; nothing where the programme has no swing.
    pub latched_share: Option<f64>,
    /// How many samples end the programme run once.
    pub complete: usize,
    /// Their share.
    pub complete_share: f64,
    /// How many repeat it without end.
    pub lasting: usize,
    /// Their share.
    pub lasting_share: f64,
    /// How many still drift when counting stops.
    pub drifting: usize,
    /// How many fail, soon or late.
    pub failing: usize,
    /// Where they do, the earliest first.
    pub first_failures: Vec<FirstFailure>,
}

/// A swing that is the first to miss its latch.
#[derive(Debug, Serialize)]
pub struct FirstFailure {
    /// Counted from 1 over the rounds of the programme.
    pub swing: usize,
    /// 1 or 2.
    pub disc: usize,
    /// In how many samples.
    pub samples: usize,
}

impl Samples {
    /// What became of samples.
    #[must_use]
    pub fn new(s: &RunShares) -> Self {
        #[allow(clippy::cast_precision_loss, reason = "counts of samples")]
        let share = |n: usize, of: usize| n as f64 / of as f64;
        let (samples, once) = (s.long_runs.len(), s.discs.len());
        let mut at: BTreeMap<usize, usize> = BTreeMap::new();
        for after in s.failures() {
            *at.entry(after).or_default() += 1;
        }
        let failing = at.values().sum();
        Samples {
            samples,
            tolerance: s.tolerance,
            swings: samples * once,
            latched: s.latched(),
            latched_share: (once > 0).then(|| share(s.latched(), samples * once)),
            complete: s.complete(),
            complete_share: share(s.complete(), samples),
            lasting: s.lasting(),
            lasting_share: share(s.lasting(), samples),
            drifting: samples - s.lasting() - failing,
            failing,
            first_failures: at
                .into_iter()
                .map(|(after, samples)| FirstFailure {
                    swing: after + 1,
                    disc: s.discs[after % once] + 1,
                    samples,
                })
                .collect(),
        }
    }

    /// As lines of the report.
    pub(super) fn write(&self, out: &mut String) -> std::fmt::Result {
        let percent = |share: f64| format!("{:.1} %", 100.0 * share);
        write!(
            out,
            "  of {} with stiffness, inertias, losses, cam and latches out by up to {} %: ",
            plural(self.samples, "drive"),
            significant(100.0 * self.tolerance)
        )?;
        if let Some(latched) = self.latched_share {
            write!(
                out,
                "{} of {} latched ({}), ",
                self.latched,
                plural(self.swings, "swing"),
                percent(latched)
            )?;
        }
        write!(
            out,
            "{} end the programme ({}), {} repeat it without end ({})",
            self.complete,
            percent(self.complete_share),
            self.lasting,
            percent(self.lasting_share)
        )?;
        if self.drifting > 0 {
            let drifting = self.drifting;
            write!(out, ", {drifting} still drift after {PATIENCE} swings")?;
        }
        writeln!(out)?;
        let told: Vec<String> = self.first_failures.iter().take(SHOWN).map(told).collect();
        let Some(last) = self.first_failures.last() else {
            return Ok(());
        };
        write!(out, "    first to miss its latch: {}", told.join(", "))?;
        let rest = self.first_failures.iter().skip(SHOWN);
        match rest.map(|f| f.samples).sum::<usize>() {
            0 => writeln!(out),
            later => writeln!(out, ", a later one in {later}, up to swing {}", last.swing),
        }
    }
}

/// A first failure in words.
fn told(f: &FirstFailure) -> String {
    let FirstFailure {
        swing,
        disc,
        samples,
    } = f;
    format!("swing {swing} (disc {disc}) in {samples}")
}
