//! How right and how fast methods and ways of searching are, for people and as data.

use crate::accuracy::searching::record::{Bracket, Record, Share, Trial};
use crate::accuracy::study::Study;
use crate::accuracy::survey::Survey;
use crate::accuracy::timing::{Machine, Timing};
use crate::format::{format_duration, three_digits};
use crate::rank::method::{MobilityMethod, registry};
use crate::view::prelude::*;

/// Returns a table for each mechanism, advice, and the machine that they were made on.
pub fn bench_text(
    trials: &[Trial],
    advice: &[&str],
    machine: &Machine,
    width: Option<u16>,
) -> String {
    let mut out = String::new();
    for t in trials {
        let known = match t.determinate.as_ref().zip(t.admissible.as_ref()) {
            Some((determinate, admissible)) => format!(
                "{} determinate, {} admissible",
                group_thousands(determinate),
                group_thousands(admissible)
            ),
            None => "the true counts are not known".to_owned(),
        };
        let heads = format!(
            "way | right counts | counting | decades, 95 % | of the best {} | naming them | right variants",
            t.top
        );
        let space = group_thousands(&t.space);
        let head = format!("{}: {space} variants, {known}\n", t.mechanism);
        out += &fit_lines(&head, width);
        out += &format!(
            "\n{}\n\n",
            text_table(&heads, t.records.iter().map(record_row), width)
        );
        let notes = trial_notes(t);
        if !notes.is_empty() {
            out += &fit_lines(&format!("{notes}\n\n"), width);
        }
    }
    let mut counted = trials
        .iter()
        .flat_map(|t| &t.records)
        .filter_map(|r| r.counting);
    let times = if counted.any(|t| t.repeats > 1) {
        "the median and the farthest from it"
    } else {
        "once"
    };
    let (when, clock) = (advice.join("\n"), machine.clock);
    out + &fit_lines(
        &format!("{when}\n\nTimes are {clock}, {times}; on {machine}.\n"),
        width,
    )
}

fn format_share(s: Share) -> String {
    format!("{} of {}", group_thousands(s.right), group_thousands(s.of))
}

fn record_row(r: &Record) -> Vec<String> {
    let or_none = |s: Option<Share>| s.map_or_else(String::new, format_share);
    let about = if r.by_proportion { "about " } else { "" };
    let time =
        |t: Option<Timing>| t.map_or_else(String::new, |t| format!("{about}{}", format_spread(t)));
    vec![
        r.way.to_string(),
        or_none(r.counts),
        time(r.counting),
        r.bracket.map_or_else(String::new, |b| {
            three_digits(Bracket::width_in_decades(b.likely))
        }),
        or_none(r.best),
        time(r.naming),
        or_none(r.variants),
    ]
}

/// Returns the median and the largest deviation from it.
fn format_spread(t: Timing) -> String {
    let off = (t.most - t.median).max(t.median - t.least);
    match t.repeats {
        1 => format_duration(t.median),
        _ => format!("{} ±{}", format_duration(t.median), format_duration(off)),
    }
}

fn trial_notes(t: &Trial) -> String {
    let mut notes = Vec::new();
    if t.looked_at > 0 && !t.all_looked_at {
        notes.push(format!(
            "Brute force examined {} variants, half drawn from all and half from the admissible ones: it gives no counts, \
             and its time is in proportion to all.",
            group_thousands(t.looked_at)
        ));
    }
    notes.extend(t.ranking_proven.map(|proven| {
        let scored = group_thousands(t.ranked_by_pool.unwrap_or_default());
        if proven {
            format!("The best are judged by a ranking of the {scored} cheapest variants, the best of all.")
        } else {
            format!("The best are not judged: beyond the {scored} cheapest variants there may be better ones.")
        }
    }));
    notes.join(" ")
}

/// Returns a table of the methods on built-in mechanisms and on those from the seed, the machine it was made on, and a paragraph
/// for each study.
pub fn accuracy_text(
    [survey, generated]: [&Survey; 2],
    studies: &[Study],
    machine: &Machine,
    width: Option<u16>,
) -> String {
    let cases = survey.cases.len();
    let heads = format!(
        "method | right of {cases} | at the pose only | wrong | n/a | right of {} from the seed | median time | what it promises",
        generated.cases.len()
    );
    let standing = |name: &str| {
        let m = registry::ALL.iter().position(|x| x.name() == name)?;
        Some(survey.record_of(m).right)
    };
    let mut out = format!("{cases} cases of known mobility");
    if let (Some(auto), Some(count)) = (standing("auto"), standing("count")) {
        out +=
            &format!(": the automatic choice is right on {auto}, the counting formula on {count}");
    }
    let table = text_table(&heads, method_rows(survey, generated), width);
    out += &format!(
        "\n\n{table}\n\n{}. On {machine}.\n",
        survey.describe_repeats()
    );
    for study in studies {
        out += &format!("\n{}: {}\n", study.texts.title, study.conclusion());
    }
    fit_lines(&out, width)
}

/// Returns a row for each method.
fn method_rows(survey: &Survey, generated: &Survey) -> Vec<Vec<String>> {
    let cases = survey.cases.len();
    let count = |n: usize| if n == 0 { String::new() } else { n.to_string() };
    let row = |(m, method): (usize, &&MobilityMethod)| {
        let s = survey.record_of(m);
        vec![
            method.name().to_owned(),
            s.right.to_string(),
            count(s.pose),
            count(s.count_wrong()),
            count(cases - s.applies),
            generated.record_of(m).right.to_string(),
            format_duration(s.seconds),
            method.guarantee.to_owned(),
        ]
    };
    registry::ALL.iter().enumerate().map(row).collect()
}
