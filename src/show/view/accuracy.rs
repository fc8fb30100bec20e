//! How right and how fast methods and ways of searching are, for people and as data.

use crate::accuracy::AnswerVerdict;
use crate::accuracy::pictures::repeated;
use crate::accuracy::searching::pictures::{USE_WHEN, ranking, wrong};
use crate::accuracy::searching::record::{Record, Share, Trial, rows};
use crate::accuracy::stability::Study;
use crate::accuracy::survey::{Case, Survey};
use crate::accuracy::timing::{Machine, Timing};
use crate::format::{duration, signed};
use crate::rank::method::{MobilityMethod, registry};
use crate::view::prelude::*;
use std::cmp::Reverse;

/// Returns everything for programs: the keys are a stable contract, in this order. Counts are strings, since they outgrow 2^53.
pub fn bench_json(trials: &[Trial], machine: &Machine) -> Value {
    let trial = |t: &Trial| {
        let found = |i: usize| t.found.as_ref().map(|f| f[i].to_string());
        json!({
            "mechanism": t.mechanism,
            "space": t.space.to_string(),
            "determinate": found(0),
            "admissible": found(1),
            "looked_at": t.looked,
            "all_looked_at": t.whole,
            "top": t.top,
            "ranked_by_pool": t.ranked.map(|r| r.0),
            "ranking_proven": t.ranked.map(|r| r.1),
        })
    };
    json!({
        "machine": {
            "processor": machine.processor,
            "threads": machine.threads,
            "cores": machine.cores,
            "memory_bytes": machine.memory,
            "system": machine.system,
            "version": Machine::VERSION,
            "optimised": machine.optimised,
            "clock": machine.time(),
        },
        "mechanisms": trials.iter().map(trial).collect::<Value>(),
        "ways": rows(trials),
    })
}

/// A table for each mechanism, and on what machine they were made.
pub fn bench_text(trials: &[Trial], machine: &Machine, width: Option<u16>) -> String {
    let mut out = String::new();
    for t in trials {
        out += &fit(&trial_head(t), width);
        let heads = format!(
            "way | right counts | counting | of the best {} | naming them | right variants",
            t.top
        );
        out += &format!("\n{}\n\n", table(&heads, t.records.iter().map(row), width));
        out += &fit(&format!("{}\n\n", notes(t)), width);
    }
    let mut records = trials.iter().flat_map(|t| &t.records);
    let times = if records.any(|r| r.counting.is_some_and(|t| t.repeats > 1)) {
        "the median and the farthest from it"
    } else {
        "once"
    };
    let clock = machine.time();
    let when = USE_WHEN.join("\n");
    out + &fit(
        &format!("{when}\n\nTimes are {clock}, {times}; on {machine}.\n"),
        width,
    )
}

fn trial_head(t: &Trial) -> String {
    let space = grouped(&t.space);
    match &t.found {
        Some([determinate, admissible]) => format!(
            "{}: {space} variants, {} determinate, {} admissible\n",
            t.mechanism,
            grouped(determinate),
            grouped(admissible)
        ),
        None => format!(
            "{}: {space} variants; the truth needs more {}, so that no counts are compared\n",
            t.mechanism,
            flag("nodes", "")
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

/// Returns the median and the largest deviation from it.
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
            "Brute force examined {} variants, half drawn from all and half from the admissible ones, and what prunes at branches \
             drawn at random: they give no counts, and their time is in proportion to all.",
            grouped(t.looked)
        ));
    }
    notes.extend(ranking(t));
    notes.join(" ")
}

/// Returns a table of the methods on built-in mechanisms and on those from the seed, the machine it was made on, and a paragraph
/// for each study.
pub fn summary(
    [survey, generated]: [&Survey; 2],
    studies: &[Study],
    machine: &Machine,
    width: Option<u16>,
) -> String {
    let cases = survey.cases.len();
    let heads = format!(
        "method | right of {cases} | at the pose only | wrong | n/a | right of {} from the seed | median time | middle half | \
         what fails, and why",
        generated.cases.len()
    );
    let standing = |name: &str| {
        let m = registry::ALL.iter().position(|x| x.name() == name)?;
        Some(survey.standing(m).right)
    };
    let mut out = format!("{cases} cases of known mobility");
    if let (Some(auto), Some(count)) = (standing("auto"), standing("count")) {
        out +=
            &format!(": the automatic choice is right on {auto}, the counting formula on {count}");
    }
    let table = table(&heads, method_rows(survey, generated), width);
    out += &format!("\n\n{table}\n\n{}. On {machine}.\n", repeated(survey));
    for study in studies {
        out += &format!("\n{}: {}\n", study.title, study.conclusion());
    }
    fit(&out, width)
}

/// Returns a row for each method.
fn method_rows(survey: &Survey, generated: &Survey) -> Vec<Vec<String>> {
    let cases = survey.cases.len();
    let count = |n: usize| if n == 0 { String::new() } else { n.to_string() };
    let row = |(m, method): (usize, &&dyn MobilityMethod)| {
        let s = survey.standing(m);
        let [from, to] = s.middle_half.map(duration);
        vec![
            method.name().to_owned(),
            s.right.to_string(),
            count(s.pose),
            count(s.wrong()),
            count(cases - s.applies),
            generated.standing(m).right.to_string(),
            duration(s.seconds),
            format!("{from} to {to}"),
            failures(survey, m),
        ]
    };
    registry::ALL.iter().enumerate().map(row).collect()
}

/// The worst failures of a method, and what it needs to be right.
fn failures(survey: &Survey, m: usize) -> String {
    let mut wrong: Vec<(u64, &Case, String)> = survey
        .of_method(m)
        .filter_map(|(case, reply)| match reply.verdict {
            AnswerVerdict::Wrong(by) => Some((by.unsigned_abs(), case, signed(by))),
            AnswerVerdict::Failed => Some((u64::MAX, case, "fails".to_owned())),
            _ => None,
        })
        .collect();
    wrong.sort_by_key(|(size, case, _)| (Reverse(*size), case.name()));
    let pose = survey.standing(m).pose > 0;
    let Some((_, worst, by)) = wrong.first() else {
        return if pose {
            "speaks of the pose: singular and shaky poses look mobile".to_owned()
        } else {
            String::new()
        };
    };
    format!(
        "{by} on {}; {}",
        worst.name(),
        registry::ALL[m].about().guarantee
    )
}
