//! Ways of searching as pictures, and what they show in words.

use super::record::{self, Record, Share, Trial};
use super::search_method::Way;
use crate::accuracy::timing::Machine;
use crate::chart::{Axis, Chart, Scale, Series, Style, page};
use crate::format::{brief, grouped, list};

/// Which way to take, in three lines.
pub const USE_WHEN: [&str; 3] = [
    "If the diagram fits into --nodes, take it whole: its counts are exact, and --check prime proves them over a second prime.",
    "If it does not, a search that is stopped gives a bracket of the counts: raise --nodes to narrow it.",
    "For a ranking leave --pool to its default: the cheapest 20,000 are scored, and then all that could still win.",
];

/// A kind of ways with how many times the time of the whole diagram each takes, and its wrong answers in per cent.
type Kind = (&'static str, Vec<(f64, f64)>);

/// Returns the kinds of ways over some trials.
fn kinds(trials: &[Trial]) -> Vec<Kind> {
    let mut kinds: Vec<Kind> = Vec::new();
    for trial in trials {
        let whole = trial.records.iter().find(|r| r.way.is_whole());
        for record in &trial.records {
            let names = record.way.only_names();
            let time = |r: &Record| if names { r.naming } else { r.counting };
            let times = whole.and_then(time).zip(time(record));
            let share = match record.way {
                Way::Pool(_) => record.best,
                _ => Some(record.variants),
            };
            let (Some((of, time)), Some(share)) = (times, share) else {
                continue;
            };
            // By a clock that stands still all take as long.
            let times = if of.median > 0.0 {
                time.median / of.median
            } else {
                1.0
            };
            let point = (times, share.percent_wrong());
            let name = record.way.kind();
            match kinds.iter_mut().find(|k| k.0 == name) {
                Some(kind) => kind.1.push(point),
                None => kinds.push((name, vec![point])),
            }
        }
    }
    kinds
}

/// Returns a chart of every way on every mechanism: its wrong answers against its time, relative to that of the whole diagram over one
/// prime.
#[must_use]
pub fn overview(trials: &[Trial], machine: &Machine) -> Chart {
    let series = kinds(trials).into_iter().map(|(name, points)| Series {
        name: name.to_owned(),
        points,
        style: Style::Points,
    });
    Chart {
        title: "Ways of searching: wrong answers against time".to_owned(),
        subtitle: format!(
            "A point for each way and mechanism: the share of the examined variants that are judged wrongly, or of the best that a \
             pool misses. On {machine}."
        ),
        x: Axis {
            label: format!(
                "{}, the whole diagram over one prime being 1",
                machine.time()
            ),
            scale: Scale::Log,
        },
        y: Axis {
            label: "wrong, %".to_owned(),
            scale: Scale::LogAndZero(-2),
        },
        series: series.collect(),
    }
}

/// Returns a sentence with the largest share of wrong answers of each kind of ways, and with its times.
#[must_use]
pub fn conclusion(trials: &[Trial]) -> String {
    let told = kinds(trials).into_iter().map(|(name, points)| {
        let ends = |of: fn(&(f64, f64)) -> f64| {
            let values = || points.iter().map(of);
            [
                values().fold(f64::INFINITY, f64::min),
                values().fold(0.0, f64::max),
            ]
        };
        let ([least, most], [_, wrong]) = (ends(|p| p.0), ends(|p| p.1));
        let wrong = if wrong > 0.0 {
            format!("wrong in up to {wrong:.1} %")
        } else {
            "never wrong".to_owned()
        };
        let [least, most] = [least, most].map(brief);
        format!("{name} {wrong}, in {least} to {most} times the time of the whole diagram")
    });
    format!("{}.", told.collect::<Vec<_>>().join("; "))
}

/// Returns a chart of stopped searches: the width of the bracket of the determinate variants against the budget of nodes. Returns `None`
/// if no search is stopped.
#[must_use]
pub fn brackets(trials: &[Trial], machine: &Machine) -> Option<Chart> {
    let of = |trial: &Trial| {
        let stopped = trial.records.iter();
        let mut points: Vec<(f64, f64)> = stopped.filter_map(|r| r.bracket).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup();
        (!points.is_empty()).then(|| Series {
            name: trial.mechanism.clone(),
            points,
            style: Style::Line,
        })
    };
    let series: Vec<Series> = trials.iter().filter_map(of).collect();
    (!series.is_empty()).then(|| Chart {
        title: "Searches that are stopped: width of the bracket against the budget".to_owned(),
        subtitle: format!(
            "The determinate variants that are counted, or the least that the estimate does not contradict with 95 % confidence, to the \
             most. On {machine}."
        ),
        x: Axis {
            label: "nodes of the diagram".to_owned(),
            scale: Scale::Log,
        },
        y: Axis {
            label: "width of the bracket, % of the estimate".to_owned(),
            scale: Scale::LogAndZero(-3),
        },
        series,
    })
}

/// Returns a sentence with the width of the bracket of each stopped search.
fn bracket_sentence(chart: &Chart) -> String {
    let told = chart.series.iter().map(|s| {
        let each = s
            .points
            .iter()
            .map(|(nodes, width)| format!("{} % by {} nodes", brief(*width), brief(*nodes)));
        format!("{}: {}", s.name, list(&each.collect::<Vec<_>>()))
    });
    format!("{}.", told.collect::<Vec<_>>().join("; "))
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

/// Returns the names and texts of all files. `index.html` is the last, so that it exists only after the files that it shows. `made` is
/// the paragraph on how they were made.
#[must_use]
pub fn files(trials: &[Trial], machine: &Machine, made: &str) -> Vec<(String, String)> {
    let mut files = vec![("searches.csv".to_owned(), record::csv(trials))];
    let each = trials.iter().map(|t| {
        let ranked = ranking(t).map_or_else(String::new, |r| format!(" {r}"));
        format!("{}: {}{ranked}", t.mechanism, wrong(t))
    });
    let found = each.collect::<Vec<_>>().join(" ");
    let how = "How this was made".to_owned();
    let mut parts = vec![(how, made.to_owned(), String::new())];
    let told = format!("{} {}", conclusion(trials), USE_WHEN.join(" "));
    let brackets = brackets(trials, machine).map(|c| ("brackets", bracket_sentence(&c), c));
    for (name, sentence, chart) in [("overview", told, overview(trials, machine))]
        .into_iter()
        .chain(brackets)
    {
        let link = "<p><a href=\"searches.csv\">searches.csv</a></p>";
        let svg = chart.svg();
        parts.push((chart.title, sentence, svg.clone() + link));
        files.push((format!("{name}.svg"), svg));
    }
    parts.push(("Mechanism by mechanism".to_owned(), found, String::new()));
    files.push((
        "index.html".to_owned(),
        page("Ways of searching: accuracy against speed", &parts),
    ));
    files
}
