//! Ways of searching as studies.

use super::record::{Bracket, Record, Trial, Way};
use ozols::accuracy::said::{Said, Tally};
use ozols::accuracy::study::Study;
use ozols::score::request::{Check, POOL};
use ozols_kernel::format::{format_duration, group_thousands, three_digits};
use std::collections::BTreeMap;

/// Returns the studies that some trials make: all ways against the whole diagram, brackets of searches with budgets of nodes, and pools of
/// rankings. A study without rows is omitted. `advice` is what to do for each of the three.
pub(crate) fn make_studies(trials: &[Trial], advice: [&str; 3]) -> Vec<Study> {
    let names = ["overview", "brackets", "rankings"];
    let mut studies = names.map(|name| Study::new(name, Vec::new()));
    for (study, advice) in studies.iter_mut().zip(advice) {
        study.texts.advice = advice.to_owned();
    }
    let mut budgets = BTreeMap::new();
    for (n, trial) in trials.iter().enumerate() {
        let stopped = trial
            .records
            .iter()
            .any(|r| r.bracket.is_some_and(Bracket::is_open));
        for record in &trial.records {
            add_to_overview(&mut studies[0], n, trial, record);
            if let (true, Way::Nodes(nodes), Some(bracket)) = (stopped, record.way, record.bracket)
            {
                add_to_brackets(&mut studies[1], trial, record, bracket);
                let of: &mut Vec<_> = budgets.entry(nodes).or_default();
                of.push((trial.mechanism.as_str(), bracket, record));
            }
            add_to_rankings(&mut studies[2], trial, record);
        }
    }
    let budgets = budgets
        .iter()
        .map(|(nodes, of)| describe_budget(*nodes, of));
    studies[1].note = budgets.collect::<Vec<_>>().join(" ");
    studies.into_iter().filter(|s| !s.rows.is_empty()).collect()
}

/// Adds the wrong answers of a way, and its time as a multiple of that of the whole diagram.
fn add_to_overview(study: &mut Study, n: usize, trial: &Trial, record: &Record) {
    let whole = |r: &&Record| r.way == Way::Diagram(Check::None);
    let time = |r: &Record| {
        if record.way.only_names() {
            r.naming
        } else {
            r.counting
        }
    };
    let share = match record.way {
        Way::Pool(_) => record.best,
        _ => record.variants,
    };
    let times = trial
        .records
        .iter()
        .find(whole)
        .and_then(time)
        .zip(time(record));
    if let (Some(share), Some((whole, time))) = (share, times) {
        // By a clock that stands still all take as long.
        let times = if whole.median > 0.0 {
            time.median / whole.median
        } else {
            1.0
        };
        let tally = Tally::of_share(share.right, share.of, times);
        study.add_tally(record.way.kind_and_text()[0], n as f64, tally);
    }
}

/// Adds the widths of the bounds of a budget, certain ones and those with a confidence of 95 %.
fn add_to_brackets(study: &mut Study, trial: &Trial, record: &Record, bracket: Bracket) {
    // An exact count says nothing about intervals.
    let holds = bracket.holds.filter(|_| bracket.is_open());
    let bounds = [
        ("", bracket.certain, None),
        (", 95 %", bracket.likely, holds),
    ];
    for (after, bounds, holds) in bounds {
        let tally = Tally {
            of: match holds {
                None => [0, 1, 0, 0],
                Some(holds) => [usize::from(holds), 0, 0, usize::from(!holds)],
            },
            seconds: record.counting.iter().map(|t| t.median).collect(),
            figure: Some(Bracket::width_in_decades(bounds)),
            ..Tally::default()
        };
        let nodes = record.way.budget().unwrap_or_default() as f64;
        study.add_tally(&(trial.mechanism.clone() + after), nodes, tally);
    }
}

/// Returns a sentence with what a budget of nodes gives for each mechanism.
fn describe_budget(nodes: usize, of: &[(&str, Bracket, &Record)]) -> String {
    let each = of.iter().map(|(mechanism, bracket, record)| {
        let time = record.counting.map_or_else(String::new, |t| format_duration(t.median));
        if !bracket.is_open() {
            return format!("{mechanism} exact ({time})");
        }
        let [certain, likely] = [bracket.certain, bracket.likely]
            .map(|b| three_digits(10f64.powf(Bracket::width_in_decades(b))));
        let missed = if bracket.holds == Some(false) {
            ", which misses the true number"
        } else {
            ""
        };
        format!("{mechanism} certain to a factor of {certain}, the interval of 95 % to {likely}{missed} ({time})")
    });
    let each: Vec<String> = each.collect();
    format!("{} nodes: {}.", group_thousands(nodes), each.join("; "))
}

/// Adds the share of the best that a pool misses. The default is a separate row.
fn add_to_rankings(study: &mut Study, trial: &Trial, record: &Record) {
    let (Way::Pool(pool), Some(best), Some(time)) = (record.way, record.best, record.naming) else {
        return;
    };
    let after = if pool.is_none() { ", default" } else { "" };
    let mut tally = Tally::of_share(best.right, best.of, time.median);
    tally.figure = Some(tally.percent_of(Said::Wrong));
    tally.of = [0, 1, 0, 0];
    let pool = pool.unwrap_or(POOL) as f64;
    study.add_tally(&format!("{}{after}", trial.mechanism), pool, tally);
}
