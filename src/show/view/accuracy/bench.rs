//! Ways of searching for people, and as data.

use crate::accuracy::searching::pictures::{ranking, wrong};
use crate::accuracy::searching::record::{Record, Share, Trial};
use crate::accuracy::searching::table::{TrialRow, rows};
use crate::accuracy::timing::{Machine, Timing};
use crate::format::{duration, grouped};
use crate::view::terminal::layout::{fit, table};
use serde::Serialize;
use std::fmt::Write;

/// Everything, for programs: the keys are a stable contract, in this order. Counts are strings, since they outgrow 2^53.
#[derive(Debug, Serialize)]
pub struct BenchData<'a> {
    machine: MachineData<'a>,
    mechanisms: Vec<TrialData<'a>>,
    ways: Vec<TrialRow<'a>>,
}

#[derive(Debug, Serialize)]
struct MachineData<'a> {
    processor: &'a str,
    threads: usize,
    cores: usize,
    memory_bytes: Option<u64>,
    system: &'a str,
    version: &'static str,
    optimised: bool,
    clock: &'static str,
}

#[derive(Debug, Serialize)]
struct TrialData<'a> {
    mechanism: &'a str,
    space: String,
    determinate: Option<String>,
    admissible: Option<String>,
    looked_at: usize,
    all_looked_at: bool,
    top: usize,
    ranked_by_pool: Option<usize>,
    ranking_proven: Option<bool>,
}

impl<'a> BenchData<'a> {
    /// Of some trials.
    #[must_use]
    pub fn new(trials: &'a [Trial], machine: &'a Machine) -> BenchData<'a> {
        let trial = |t: &'a Trial| {
            let found = |i: usize| t.found.as_ref().map(|f| f[i].to_string());
            TrialData {
                mechanism: &t.mechanism,
                space: t.space.to_string(),
                determinate: found(0),
                admissible: found(1),
                looked_at: t.looked,
                all_looked_at: t.whole,
                top: t.top,
                ranked_by_pool: t.ranked.map(|r| r.0),
                ranking_proven: t.ranked.map(|r| r.1),
            }
        };
        BenchData {
            machine: MachineData {
                processor: &machine.processor,
                threads: machine.threads,
                cores: machine.cores,
                memory_bytes: machine.memory,
                system: &machine.system,
                version: Machine::VERSION,
                optimised: machine.optimised,
                clock: machine.time(),
            },
            mechanisms: trials.iter().map(trial).collect(),
            ways: rows(trials),
        }
    }
}

/// A table for each mechanism, and on what machine they were made.
#[must_use]
pub fn text(trials: &[Trial], machine: &Machine, width: Option<u16>) -> String {
    let mut out = String::new();
    for t in trials {
        out += &fit(&head(t), width);
        let best = format!("of the best {}", t.top);
        let heads = [
            "way",
            "right counts",
            "counting",
            &best,
            "naming them",
            "right variants",
        ];
        let rows = t.records.iter().map(row).collect();
        // Writing to a string cannot fail.
        let _ = write!(out, "\n{}\n\n", table(&heads, rows, width));
        out += &fit(&format!("{}\n\n", notes(t)), width);
    }
    let times = if trials
        .iter()
        .flat_map(|t| &t.records)
        .any(|r| r.counting.is_some_and(|t| t.repeats > 1))
    {
        "the median and the farthest from it"
    } else {
        "once"
    };
    let clock = machine.time();
    out + &fit(
        &format!("Times are {clock}, {times}; on {machine}.\n"),
        width,
    )
}

fn head(t: &Trial) -> String {
    let space = grouped(&t.space);
    match &t.found {
        Some([determinate, admissible]) => format!(
            "{}: {space} variants, {} determinate, {} admissible\n",
            t.mechanism,
            grouped(determinate),
            grouped(admissible)
        ),
        None => format!(
            "{}: {space} variants; the truth needs more --nodes, so that no counts are compared\n",
            t.mechanism
        ),
    }
}

fn share(s: Share) -> String {
    let of = |n: usize| grouped(n);
    format!("{} of {}", of(s.right), of(s.of))
}

fn row(r: &Record) -> Vec<String> {
    let or_none = |s: Option<Share>| s.map_or_else(String::new, share);
    let about = if r.by_proportion { "about " } else { "" };
    let time = |t: Option<Timing>| t.map_or_else(String::new, |t| format!("{about}{}", spread(t)));
    vec![
        r.way.to_string(),
        or_none(r.counts),
        time(r.counting),
        or_none(r.best),
        time(r.naming),
        share(r.variants),
    ]
}

/// The median, and how far the times are from it at most.
fn spread(t: Timing) -> String {
    let off = (t.most - t.median).max(t.median - t.least);
    match t.repeats {
        1 => duration(t.median),
        _ => format!("{} ±{}", duration(t.median), duration(off)),
    }
}

fn notes(t: &Trial) -> String {
    let mut notes = vec![wrong(t)];
    if !t.whole {
        notes.push(format!(
            "Brute force looked at {} variants, half drawn from all and half from the admissible ones, and what prunes at branches \
             drawn at random: they give no counts, and their time is in proportion to all.",
            grouped(t.looked)
        ));
    }
    notes.extend(ranking(t));
    notes.join(" ")
}
