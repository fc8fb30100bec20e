//! The survey as pictures, and the files of a run.

use super::stability::Study;
use super::survey::{MethodRecord, Survey};
use super::timing::{Machine, quantile};
use crate::chart::{Axis, Chart, Scale, Series, Style, page};
use crate::format::{duration, list};
use crate::rank::method::registry;
use crate::score::outcome::pareto::front;

/// A method: its median time of an answer in seconds, and the share of all cases that it is right about.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodPlace {
    /// Its name.
    pub name: &'static str,
    /// Seconds.
    pub seconds: f64,
    /// From 0 to 1.
    pub share: f64,
}

/// Returns the place of every method that applies to some case.
#[must_use]
pub fn places(survey: &Survey) -> Vec<MethodPlace> {
    let standings = registry::ALL.iter().enumerate();
    let standings = standings.map(|(m, method)| (method.name(), survey.standing(m)));
    let places = standings.filter(|(_, s)| s.applies > 0);
    let place = |(name, s): (_, MethodRecord)| MethodPlace {
        name,
        seconds: s.seconds,
        share: s.share,
    };
    places.map(place).collect()
}

/// The places that no other one beats in both share and time, the fastest first.
#[must_use]
pub fn pareto(places: &[MethodPlace]) -> Vec<&MethodPlace> {
    let points: Vec<_> = places.iter().map(|p| (p.seconds, p.share)).collect();
    front(&points).into_iter().map(|i| &places[i]).collect()
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

/// Returns a chart of the share of right answers against the median time of an answer; floating-point methods have their default
/// tolerance.
#[must_use]
pub(crate) fn share_time(survey: &Survey, of: &str, machine: &Machine) -> Chart {
    let places = places(survey);
    let front = pareto(&places);
    let at = |p: &MethodPlace| (p.seconds, 100.0 * p.share);
    let mut steps: Vec<(f64, f64)> = front.iter().map(|p| at(p)).collect();
    let slowest = places.iter().map(|p| p.seconds).fold(0.0, f64::max);
    if let Some(&(_, share)) = steps.last() {
        steps.push((slowest, share));
    }
    let mut series = vec![Series {
        name: "Pareto front".to_owned(),
        points: steps,
        style: Style::Steps,
    }];
    series.extend(places.iter().map(|p| Series {
        name: p.name.to_owned(),
        points: vec![at(p)],
        style: Style::Points,
    }));
    Chart {
        title: format!("Accuracy against speed: {of}"),
        subtitle: format!("{}. On {machine}.", repeated(survey)),
        x: Axis {
            label: format!("median {} of an answer, s", machine.time()),
            scale: Scale::Log,
        },
        y: Axis {
            label: format!(
                "share of all {} cases with the right finite mobility, %",
                survey.cases.len()
            ),
            scale: Scale::Linear,
        },
        series,
    }
}

/// How often answers were timed, and how far their times spread.
#[must_use]
pub fn repeated(survey: &Survey) -> String {
    let times = || survey.replies.iter().flatten().map(|r| r.time);
    let most = times().map(|t| t.repeats).max().unwrap_or(0);
    let spread: Vec<f64> = times()
        .filter(|t| t.repeats > 1 && t.median > 0.0)
        .map(|t| (t.most - t.least) / t.median)
        .collect();
    match most {
        0 | 1 => "Each answer was timed once".to_owned(),
        n => format!(
            "Answers were timed {n} times, slow ones fewer; the longest time of an answer is typically {} above the \
             shortest",
            percent(quantile(&spread, 0.5))
        ),
    }
}

/// Returns sentences with the methods that are right on all cases, and those on the Pareto front of share and time.
#[must_use]
pub(crate) fn front_sentence(survey: &Survey) -> String {
    let places = places(survey);
    let cases = survey.cases.len();
    let standings = (0..registry::ALL.len()).map(|m| survey.standing(m));
    let all: Vec<String> = registry::ALL
        .iter()
        .zip(standings)
        .filter(|(_, s)| s.right == cases)
        .map(|(m, s)| format!("{} ({})", m.name(), duration(s.seconds)))
        .collect();
    let all = match all.len() {
        0 => "No method is right everywhere".to_owned(),
        1 => format!("Only {} is right on all {cases} cases", all[0]),
        _ => format!("{} are right on all {cases} cases", list(&all)),
    };
    let front: Vec<String> = pareto(&places)
        .iter()
        .map(|p| format!("{} ({}, {})", p.name, percent(p.share), duration(p.seconds)))
        .collect();
    format!(
        "{all}. No method is both faster and more often right than {}. Cases that a method does not apply to count as \
         not right.",
        list(&front)
    )
}

/// Returns the names and texts of all files. `index.html` is the last, so that it exists only after the files that it shows. `made` is
/// the paragraph on how they were made.
#[must_use]
pub fn files(
    [built_in, generated]: [&Survey; 2],
    studies: &[Study],
    machine: &Machine,
    made: &str,
) -> Vec<(String, String)> {
    let mut shown = Vec::new();
    for (name, of, survey) in [
        ("share-time", "built-in mechanisms", built_in),
        (
            "share-time-generated",
            "mechanisms from the seed",
            generated,
        ),
    ] {
        let chart = share_time(survey, of, machine);
        let sentence = front_sentence(survey);
        shown.push((
            name,
            chart.title.clone(),
            sentence,
            chart.svg(),
            chart.csv(),
        ));
    }
    for study in studies {
        let sentence = format!("{} What to do: {}", study.conclusion(), study.advice);
        let title = study.title.to_owned();
        shown.push((study.name, title, sentence, study.svg(), study.csv()));
    }
    let mut files = vec![
        ("survey.csv".to_owned(), built_in.csv()),
        ("generated.csv".to_owned(), generated.csv()),
    ];
    let how = "How this was made".to_owned();
    let mut parts = vec![(how, made.to_owned(), String::new())];
    for (name, title, sentence, svg, csv) in shown {
        let link = format!("<p><a href=\"{name}.csv\">{name}.csv</a></p>");
        parts.push((title, sentence, svg.clone() + &link));
        files.push((format!("{name}.csv"), csv));
        files.push((format!("{name}.svg"), svg));
    }
    let title = "Mobility methods: accuracy, speed, stability";
    files.push(("index.html".to_owned(), page(title, &parts)));
    files
}
