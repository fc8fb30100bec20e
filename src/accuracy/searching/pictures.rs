//! Ways of searching as pictures, and what they show in words.

use super::record::{Record, Share, Trial};
use super::table;
use super::way::Way;
use crate::accuracy::pareto::front;
use crate::accuracy::timing::Machine;
use crate::chart::{Axis, Chart, Scale, Series, Style, page};
use crate::format::number::{duration, grouped};
use crate::format::phrase::list;

fn chart(
    title: String,
    (label, why): (&str, &str),
    records: &[(&Record, Share)],
    machine: &Machine,
) -> Chart {
    let points: Vec<_> = records
        .iter()
        .map(|(r, s)| (r.time.median, s.percent()))
        .collect();
    let front: Vec<_> = front(&points).into_iter().map(|i| records[i]).collect();
    // Nothing is right before the fastest.
    let first = front.first().map(|(r, _)| (r.time.median, 0.0));
    let rest = front.iter().map(|(r, s)| (r.time.median, s.percent()));
    let mut steps: Vec<(f64, f64)> = first.into_iter().chain(rest).collect();
    let slowest = records
        .iter()
        .map(|(r, _)| r.time.median)
        .fold(0.0, f64::max);
    if let Some(&(_, share)) = steps.last() {
        steps.push((slowest, share));
    }
    let names: Vec<String> = front
        .iter()
        .map(|(r, s)| {
            format!(
                "{} ({:.0} %, {})",
                r.way,
                s.percent(),
                duration(r.time.median)
            )
        })
        .collect();
    let mut series = vec![Series {
        name: "Pareto front".to_owned(),
        points: steps,
        style: Style::Steps,
    }];
    series.extend(records.iter().map(|(r, s)| Series {
        name: r.way.to_string(),
        points: vec![(r.time.median, s.percent())],
        style: Style::Points,
    }));
    Chart {
        title,
        subtitle: format!(
            "No way is both faster and more often right than {}. {why} On {machine}.",
            list(&names)
        ),
        x: Axis {
            label: "time, s".to_owned(),
            scale: Scale::Log,
        },
        y: Axis {
            label: label.to_owned(),
            scale: Scale::Linear,
        },
        series,
    }
}

/// The share of right counts against time.
#[must_use]
pub fn counts(trial: &Trial, machine: &Machine) -> Chart {
    let records: Vec<_> = trial.records.iter().map(|r| (r, r.answers())).collect();
    let why = match trial.whole {
        true => "Counts of determinate and of admissible variants, by W and number of changes.",
        false => {
            "Counts of determinate and of admissible variants, by W and number of changes; for brute force, whose \
             time is in proportion to all, the share of right ones among the variants it looked at."
        }
    };
    chart(
        format!("{}: right counts against time", trial.mechanism),
        ("right counts, %", why),
        &records,
        machine,
    )
}

/// The share of right ones among the best against time; none where no way names any.
#[must_use]
pub fn best(trial: &Trial, machine: &Machine) -> Option<Chart> {
    let named = trial.records.iter().filter_map(|r| Some((r, r.best?)));
    let records: Vec<_> = named.collect();
    let why = ranking(trial).unwrap_or_else(|| "The order is that of cost.".to_owned());
    (!records.is_empty()).then(|| {
        chart(
            format!(
                "{}: right among the best {} against time",
                trial.mechanism, trial.top
            ),
            ("right among the best, %", &why),
            &records,
            machine,
        )
    })
}

/// What a ranking is judged by.
#[must_use]
pub fn ranking(trial: &Trial) -> Option<String> {
    let (pool, proven) = trial.ranked?;
    let pool = grouped(&pool.to_string());
    let sure = match proven {
        true => "the best of all",
        false => "and a larger pool may have better ones",
    };
    Some(format!(
        "The best are judged by a ranking of the {pool} cheapest variants, {sure}."
    ))
}

/// Which ways judge variants wrongly, or give wrong counts, in words.
#[must_use]
pub fn wrong(trial: &Trial) -> String {
    let judged = trial.records.iter().filter_map(|r| {
        let Share { right, of } = r.variants;
        let by_itself = matches!(r.way, Way::Brute | Way::Float(_));
        let [wrong, all] = [of - right, of].map(|n| grouped(&n.to_string()));
        (by_itself && right < of).then(|| format!("{} on {wrong} of {all} variants", r.way))
    });
    let counted = trial.records.iter().filter_map(|r| {
        let counts = r.counts.filter(|c| c.right < c.of)?;
        let diagram = !matches!(r.way, Way::Brute | Way::Float(_));
        diagram.then(|| {
            format!(
                "{} in {} of {} counts",
                r.way,
                counts.of - counts.right,
                counts.of
            )
        })
    });
    let all: Vec<String> = counted.chain(judged).collect();
    match all.is_empty() {
        true => "No way is wrong about a variant or a count.".to_owned(),
        false => format!("Wrong: {}.", list(&all)),
    }
}

/// Names and texts of every file, `index.html` last, so that it is there only once all that it shows is.
#[must_use]
pub fn files(trials: &[Trial], machine: &Machine) -> Vec<(String, String)> {
    let mut files = vec![("searches.csv".to_owned(), table::csv(trials))];
    let mut parts = Vec::new();
    for (n, trial) in trials.iter().enumerate() {
        let plain = |c: char| if c.is_alphanumeric() { c } else { '-' };
        let name: String = trial.mechanism.chars().map(plain).collect();
        let charts = [
            ("counts", Some(counts(trial, machine)), wrong(trial)),
            ("best", best(trial, machine), String::new()),
        ];
        for (what, chart, sentence) in charts {
            let Some(chart) = chart else { continue };
            files.push((format!("{}-{name}-{what}.svg", n + 1), chart.svg()));
            parts.push((chart.title.clone(), sentence, chart.svg()));
        }
    }
    files.push((
        "index.html".to_owned(),
        page("Ways of searching: accuracy against speed", &parts),
    ));
    files
}
