//! Ways of searching as pictures, and what they show in words.

use super::record;
use super::record::{Record, Share, Trial};
use crate::accuracy::timing::Machine;
use crate::chart::{Axis, Chart, Scale, Series, Style, page};
use crate::format::{duration, grouped, list};
use crate::score::outcome::pareto::front;

/// A way with its median time in seconds and how often it is right.
type Point<'a> = (&'a Record, f64, Share);

/// What a chart shows: its title, the axes' labels, and a sentence.
struct ChartWords {
    title: String,
    time: String,
    wrong: String,
    why: String,
}

fn chart(words: ChartWords, points: &[Point<'_>], machine: &Machine) -> Chart {
    let places: Vec<_> = points
        .iter()
        .map(|(_, t, s)| (*t, -s.percent_wrong()))
        .collect();
    let front: Vec<_> = front(&places).into_iter().map(|i| points[i]).collect();
    // Nothing is right before the fastest.
    let first = front.first().map(|(_, t, _)| (*t, 100.0));
    let rest = front.iter().map(|(_, t, s)| (*t, s.percent_wrong()));
    let mut steps: Vec<(f64, f64)> = first.into_iter().chain(rest).collect();
    let slowest = points.iter().map(|p| p.1).fold(0.0, f64::max);
    if let Some(&(_, share)) = steps.last() {
        steps.push((slowest, share));
    }
    let name = |(r, t, s): &Point<'_>| {
        if s.right == s.of {
            format!("{} (none wrong, {})", r.way, duration(*t))
        } else {
            format!(
                "{} ({:.1} % wrong, {})",
                r.way,
                s.percent_wrong(),
                duration(*t)
            )
        }
    };
    let names: Vec<String> = front.iter().map(name).collect();
    let mut series = vec![Series {
        name: "Pareto front".to_owned(),
        points: steps,
        style: Style::Steps,
    }];
    series.extend(points.iter().map(|(r, t, s)| Series {
        name: r.way.to_string(),
        points: vec![(*t, s.percent_wrong())],
        style: Style::Points,
    }));
    // A decade below one of all, so that nothing wrong stands apart from a little.
    let most = points.iter().map(|p| p.2.of).max().unwrap_or(1);
    let decade = i32::try_from(most.max(1).ilog10()).unwrap_or(0);
    Chart {
        title: words.title,
        subtitle: format!(
            "No way is both faster and less often wrong than {}. {} On {machine}.",
            list(&names),
            words.why
        ),
        x: Axis {
            label: words.time,
            scale: Scale::Log,
        },
        y: Axis {
            label: words.wrong,
            scale: Scale::LogAndZero(1 - decade),
        },
        series,
    }
}

/// The share of wrong counts against the time of counting; of ways that give counts.
#[must_use]
pub fn counts(trial: &Trial, machine: &Machine) -> Option<Chart> {
    let given = trial.records.iter();
    let points: Vec<_> = given
        .filter_map(|r| Some((r, r.counting?.median, r.counts?)))
        .collect();
    let words = ChartWords {
        title: format!("{}: wrong counts against time", trial.mechanism),
        time: format!("{} of counting, s", machine.time()),
        wrong: "wrong counts, %".to_owned(),
        why: "Counts of determinate and of admissible variants, by W and number of changes."
            .to_owned(),
    };
    (!points.is_empty()).then(|| chart(words, &points, machine))
}

/// The share of variants that are judged wrongly against the time for all, where brute force cannot look at all; elsewhere
/// the counts say as much.
#[must_use]
pub fn variants(trial: &Trial, machine: &Machine) -> Option<Chart> {
    let given = trial.records.iter();
    let points: Vec<_> = given
        .filter_map(|r| Some((r, r.counting?.median, r.variants)))
        .collect();
    let words = ChartWords {
        title: format!("{}: variants judged wrongly against time", trial.mechanism),
        time: format!("{} for all variants, s", machine.time()),
        wrong: format!("of {} variants judged wrongly, %", grouped(trial.looked)),
        why: "What looks at variants one by one looked at some; its time is in proportion to all."
            .to_owned(),
    };
    (!trial.whole).then(|| chart(words, &points, machine))
}

/// The share of wrong ones among the best against the time of naming them; none where no way names any.
#[must_use]
pub fn best(trial: &Trial, machine: &Machine) -> Option<Chart> {
    let named = trial.records.iter();
    let points: Vec<_> = named
        .filter_map(|r| Some((r, r.naming?.median, r.best?)))
        .collect();
    let words = ChartWords {
        title: format!(
            "{}: wrong among the best {} against time",
            trial.mechanism, trial.top
        ),
        time: format!("{} of counting and naming the best, s", machine.time()),
        wrong: "wrong among the best, %".to_owned(),
        why: ranking(trial).unwrap_or_else(|| "The order is that of cost.".to_owned()),
    };
    (!points.is_empty()).then(|| chart(words, &points, machine))
}

/// What a ranking is judged by.
#[must_use]
pub fn ranking(trial: &Trial) -> Option<String> {
    let (pool, proven) = trial.ranked?;
    let pool = grouped(pool);
    Some(if proven {
        format!(
            "The best are judged by a ranking of the {pool} cheapest variants, the best of all."
        )
    } else {
        format!(
            "The best are not judged: beyond the {pool} cheapest variants there may be better ones."
        )
    })
}

/// Which ways judge variants wrongly, or give wrong counts, in words.
#[must_use]
pub fn wrong(trial: &Trial) -> String {
    let judged = trial.records.iter().filter_map(|r| {
        let Share { right, of } = r.variants;
        let [wrong, all] = [of - right, of].map(grouped);
        (r.way.looks() && right < of).then(|| format!("{} on {wrong} of {all} variants", r.way))
    });
    let counted = trial.records.iter().filter_map(|r| {
        let counts = r.counts.filter(|c| c.right < c.of)?;
        (!r.way.looks()).then(|| {
            format!(
                "{} in {} of {} counts",
                r.way,
                counts.of - counts.right,
                counts.of
            )
        })
    });
    let all: Vec<String> = counted.chain(judged).collect();
    if all.is_empty() {
        "No way is wrong about a variant or a count.".to_owned()
    } else {
        format!("Wrong: {}.", list(&all))
    }
}

/// Names and texts of every file, `index.html` last, so that it is there only once all that it shows is.
#[must_use]
pub fn files(trials: &[Trial], machine: &Machine) -> Vec<(String, String)> {
    let mut files = vec![("searches.csv".to_owned(), record::csv(trials))];
    let mut parts = Vec::new();
    for (n, trial) in trials.iter().enumerate() {
        let plain = |c: char| if c.is_alphanumeric() { c } else { '-' };
        let name: String = trial.mechanism.chars().map(plain).collect();
        let charts = [
            ("counts", counts(trial, machine), wrong(trial)),
            ("variants", variants(trial, machine), String::new()),
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
