//! Ways of searching as studies, and what they show in words.

use super::record::{Bracket, Record, Share, Trial, Way};
use crate::accuracy::said::Tally;
use crate::accuracy::study::{Figure, Study, View};
use crate::format::{group_thousands, join_and};
use crate::score::request::{Check, POOL};

/// Returns the studies that some trials make: all ways against the whole diagram, brackets of searches with budgets of nodes, and pools of
/// rankings. A study without rows is omitted. `advice` is what to do for each of the three.
pub fn make_studies(trials: &[Trial], advice: [&str; 3]) -> Vec<Study> {
    let (known, missed) = ("most over least, decades", "missed of the best, %");
    let mut studies = [
        ("overview", Figure::Wrong),
        ("brackets", Figure::Own(known, -4)),
        ("rankings", Figure::Own(missed, 0)),
    ]
    .map(|(name, figure)| Study::new(name, Vec::new(), View::Against(figure)));
    for (study, advice) in studies.iter_mut().zip(advice) {
        study.texts.advice = advice.to_owned();
    }
    for (n, trial) in trials.iter().enumerate() {
        let stopped = |r: &Record| {
            r.bracket
                .is_some_and(|b| Bracket::width_in_decades(b.certain) > 0.0)
        };
        let stopped = trial.records.iter().any(stopped);
        for record in &trial.records {
            add_to_overview(&mut studies[0], n, trial, record);
            if stopped {
                add_to_brackets(&mut studies[1], trial, record);
            }
            add_to_rankings(&mut studies[2], trial, record);
        }
    }
    studies.into_iter().filter(|s| !s.rows.is_empty()).collect()
}

/// Adds the wrong answers of a way, and its time as a multiple of that of the whole diagram.
fn add_to_overview(study: &mut Study, n: usize, trial: &Trial, record: &Record) {
    let whole = trial
        .records
        .iter()
        .find(|r| r.way == Way::Diagram(Check::None));
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
    let times = whole.and_then(time).zip(time(record));
    if let (Some(Share { right, of }), Some((whole, time))) = (share, times) {
        // By a clock that stands still all take as long.
        let times = if whole.median > 0.0 {
            time.median / whole.median
        } else {
            1.0
        };
        study.add_tally(
            record.way.kind_and_text()[0],
            n as f64,
            Tally::of_share(right, of, times),
        );
    }
}

/// Adds the widths of the bounds of a budget, certain ones and those with a confidence of 95 %.
fn add_to_brackets(study: &mut Study, trial: &Trial, record: &Record) {
    let (Way::Nodes(nodes), Some(bracket), Some(time)) =
        (record.way, record.bracket, record.counting)
    else {
        return;
    };
    // An exact count says nothing about intervals.
    let holds = bracket
        .holds
        .filter(|_| Bracket::width_in_decades(bracket.certain) > 0.0);
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
            seconds: vec![time.median],
            figure: Bracket::width_in_decades(bounds),
            ..Tally::default()
        };
        study.add_tally(&(trial.mechanism.clone() + after), nodes as f64, tally);
    }
}

/// Adds the share of the best that a pool misses. The default is a separate row.
fn add_to_rankings(study: &mut Study, trial: &Trial, record: &Record) {
    let (Way::Pool(pool), Some(best), Some(time)) = (record.way, record.best, record.naming) else {
        return;
    };
    let after = if pool.is_none() { ", default" } else { "" };
    let mut tally = Tally::of_share(best.right, best.of, time.median);
    tally.figure = tally.figure_of(Figure::Wrong);
    tally.of = [0, 1, 0, 0];
    study.add_tally(
        &format!("{}{after}", trial.mechanism),
        pool.unwrap_or(POOL) as f64,
        tally,
    );
}

/// Returns what a ranking is judged by.
pub fn describe_ranking(trial: &Trial) -> Option<String> {
    let pool = group_thousands(trial.ranked_by_pool?);
    Some(if trial.ranking_proven == Some(true) {
        format!(
            "The best are judged by a ranking of the {pool} cheapest variants, the best of all."
        )
    } else {
        format!(
            "The best are not judged: beyond the {pool} cheapest variants there may be better ones."
        )
    })
}

/// Returns which ways judge variants wrongly, or give wrong counts, in words.
pub fn describe_errors(trial: &Trial) -> String {
    let wrong = trial.records.iter().filter_map(|r| {
        let (share, on) = if r.way.examines_variants() {
            (r.variants, "variants")
        } else {
            (r.counts, "counts")
        };
        let Share { right, of } = share.filter(|s| s.right < s.of)?;
        let [wrong, all] = [of - right, of].map(group_thousands);
        Some(format!("{} on {wrong} of {all} {on}", r.way))
    });
    let all: Vec<String> = wrong.collect();
    if all.is_empty() {
        "No way is wrong about a variant or a count.".to_owned()
    } else {
        format!("Wrong: {}.", join_and(&all))
    }
}
