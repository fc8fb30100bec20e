//! The survey as pictures.

use super::AnswerVerdict;
use super::survey::{Case, MethodRecord, Reply, Survey};
use super::timing::{Machine, quantile};
use super::tuned::Tuned;
use crate::chart::{Axis, Bands, Cell, Chart, Matrix, Scale, Series, Style, VerdictKind};
use crate::format::{duration, list, scientific, signed};
use crate::rank::method::MobilityMethod;
use crate::rank::method::registry;
use crate::score::outcome::pareto::front;

/// A method, at its default tolerance or at its best: its median time of an answer in seconds, and the share of all cases that
/// it is right about.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodPlace {
    /// Its name.
    pub name: String,
    /// Seconds.
    pub seconds: f64,
    /// From 0 to 1.
    pub share: f64,
}

/// Every method that applies to some case, the floating-point ones at their best tolerance too, which does not change their
/// time.
#[must_use]
pub fn places(survey: &Survey) -> Vec<MethodPlace> {
    let standings: Vec<MethodRecord> = (0..registry::ALL.len())
        .map(|m| survey.standing(m))
        .collect();
    let default = registry::ALL
        .iter()
        .zip(&standings)
        .filter(|(_, s)| s.applies > 0);
    let default = default.map(|(m, s)| MethodPlace {
        name: m.name().to_owned(),
        seconds: s.seconds,
        share: s.share,
    });
    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    let tuned = survey.tuned.iter().filter_map(|t| {
        Some(MethodPlace {
            name: tuned_name(t)?,
            seconds: standings[t.method].seconds,
            share: t.right as f64 / survey.cases.len().max(1) as f64,
        })
    });
    default.chain(tuned).collect()
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

/// The name of a method at its best tolerance; none where that is no better than its default.
#[must_use]
pub fn tuned_name(tuned: &Tuned) -> Option<String> {
    let better = tuned.right > tuned.right_by_default;
    let name = registry::ALL[tuned.method].name();
    better.then(|| format!("{name} at {}", scientific(tuned.tolerance)))
}

/// Share of right answers against median time of an answer; floating-point methods at their default tolerance, and at
/// their best where that is another. The tolerance does not change their time.
#[must_use]
pub(crate) fn share_time(survey: &Survey, machine: &Machine) -> Chart {
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
        name: p.name.clone(),
        points: vec![at(p)],
        style: Style::Points,
    }));
    let sentence = share_sentence(survey, &front);
    Chart {
        title: "Accuracy against speed".to_owned(),
        subtitle: format!("{sentence} {}. On {machine}.", repeated(survey)),
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

/// What each method answers: right, right at the pose only, wrong, or nothing since it does not apply.
#[must_use]
pub fn answers(survey: &Survey) -> Bands {
    #[allow(clippy::cast_precision_loss, reason = "counts are small")]
    let bar = |right: usize, pose: usize, wrong: usize| {
        let ends = [
            0,
            right,
            right + pose,
            right + pose + wrong,
            survey.cases.len(),
        ];
        let kinds = [
            VerdictKind::Good,
            VerdictKind::Warn,
            VerdictKind::Bad,
            VerdictKind::None,
        ];
        let bands = ends.windows(2).zip(kinds).filter(|(e, _)| e[0] < e[1]);
        bands
            .map(|(e, kind)| (e[0] as f64, e[1] as f64, kind))
            .collect()
    };
    let mut rows = Vec::new();
    for (n, method) in registry::ALL.iter().enumerate() {
        let s = survey.standing(n);
        rows.push((method.name().to_owned(), bar(s.right, s.pose, s.wrong())));
        let tuned = survey.tuned.iter().find(|t| t.method == n);
        if let Some((t, name)) = tuned.and_then(|t| Some((t, tuned_name(t)?))) {
            rows.push((name, bar(t.right, t.pose, s.applies - t.right - t.pose)));
        }
    }
    Bands {
        title: "Right, wrong, or not applicable".to_owned(),
        subtitle: format!(
            "Of {} cases each method is right about so many; in doubt: right at the pose of the file, which is not the \
             finite mobility; no verdict: the method does not apply. {}",
            survey.cases.len(),
            tolerances(survey)
        ),
        x: Axis {
            label: "cases".to_owned(),
            scale: Scale::Linear,
        },
        rows,
    }
}

/// The best and the default tolerance of each floating-point method, in words.
#[must_use]
pub fn tolerances(survey: &Survey) -> String {
    let one = |t: &Tuned| {
        let (name, right) = (registry::ALL[t.method].name(), t.right);
        let default = scientific(t.default);
        match tuned_name(t) {
            Some(best) => format!(
                "{best} ({right}; {} at {default}, its default)",
                t.right_by_default
            ),
            None => format!("{name} at its default of {default} ({right})"),
        }
    };
    let all: Vec<String> = survey.tuned.iter().map(one).collect();
    format!("Floating point is right most often with {}.", list(&all))
}

fn share_sentence(survey: &Survey, front: &[&MethodPlace]) -> String {
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
    let front: Vec<String> = front
        .iter()
        .map(|p| format!("{} ({}, {})", p.name, percent(p.share), duration(p.seconds)))
        .collect();
    format!(
        "{all}. No method is both faster and more often right than {}. Cases that a method does not apply to count as \
         not right.",
        list(&front)
    )
}

/// Mechanisms down, methods across: right, wrong by how much, or not applicable.
#[must_use]
pub(crate) fn matrix(survey: &Survey) -> Matrix {
    let columns: Vec<String> = registry::ALL.iter().map(|m| m.name().to_owned()).collect();
    let rows = survey.cases.iter().map(Case::name).collect();
    let cell = |case: &Case, (method, reply): (&&dyn MobilityMethod, &Reply)| {
        let (text, kind) = match reply.verdict {
            AnswerVerdict::Right => (String::new(), VerdictKind::Good),
            AnswerVerdict::Pose(by) => (signed(by), VerdictKind::Warn),
            AnswerVerdict::Wrong(by) => (signed(by), VerdictKind::Bad),
            AnswerVerdict::Failed => ("fails".to_owned(), VerdictKind::Bad),
            AnswerVerdict::Silent => ("n/a".to_owned(), VerdictKind::None),
        };
        Cell {
            text,
            kind,
            tooltip: tooltip(case, *method, reply),
        }
    };
    let cells = survey.cases.iter().zip(&survey.replies);
    let cells = cells
        .map(|(case, replies)| {
            let pairs = registry::ALL.iter().zip(replies);
            pairs.map(|pair| cell(case, pair)).collect()
        })
        .collect();
    Matrix {
        title: "Every method on every mechanism".to_owned(),
        subtitle: matrix_sentence(survey),
        columns,
        rows,
        cells,
    }
}

fn tooltip(case: &Case, method: &dyn MobilityMethod, reply: &Reply) -> String {
    let says = match &reply.answer {
        Ok(a) => format!("says {}", a.mobility),
        Err(e) => return e.to_string(),
    };
    let truth = case.truth;
    let is = if truth.instantaneous == truth.finite {
        format!("the mobility is {}", truth.finite)
    } else {
        format!(
            "the finite mobility is {}, at this pose {}",
            truth.finite, truth.instantaneous
        )
    };
    match reply.verdict {
        AnswerVerdict::Right => format!("{says}, right"),
        AnswerVerdict::Pose(_) => format!("{says}; {is}: the method speaks of the pose alone"),
        _ => format!("{says}; {is}: {}", method.about().guarantee),
    }
}

fn matrix_sentence(survey: &Survey) -> String {
    let total = |of: fn(&AnswerVerdict) -> bool| {
        survey
            .replies
            .iter()
            .flatten()
            .filter(|r| of(&r.verdict))
            .count()
    };
    let (wrong, pose) = (
        total(|v| matches!(v, AnswerVerdict::Wrong(_) | AnswerVerdict::Failed)),
        total(|v| matches!(v, AnswerVerdict::Pose(_))),
    );
    format!(
        "{} cases by {} methods: a tick is the true finite mobility, a number by how much an answer is off; {wrong} \
         answers are wrong, {pose} are right at the pose of the file but not for the motion, n/a is where a method does \
         not apply.",
        survey.cases.len(),
        registry::ALL.len(),
    )
}
