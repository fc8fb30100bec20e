//! A survey of the methods for people.

use crate::accuracy::AnswerVerdict;
use crate::accuracy::pictures::{repeated, tolerances, tuned_name};
use crate::accuracy::survey::{Case, Survey};
use crate::accuracy::timing::Machine;
use crate::format::{duration, signed};
use crate::rank::method::registry;
use crate::view::terminal::layout::{fit, table};
use std::cmp::Reverse;
use std::fmt::Write;

/// A table of the methods, on what machine it was made, then a paragraph for each chart.
#[must_use]
pub fn summary<'a>(
    survey: &Survey,
    sentences: impl IntoIterator<Item = (&'a str, &'a str)>,
    machine: &Machine,
    width: Option<u16>,
) -> String {
    let cases = survey.cases.len();
    let heads = [
        "method",
        &format!("right of {cases}"),
        "at the pose only",
        "wrong",
        "n/a",
        "median time",
        "middle half",
        "what fails, and why",
    ];
    let standing = |name: &str| {
        let m = registry::ALL.iter().position(|x| x.name() == name)?;
        Some(survey.standing(m).right)
    };
    let mut out = format!("{cases} cases of known mobility");
    if let (Some(auto), Some(count)) = (standing("auto"), standing("count")) {
        // Writing to a string cannot fail.
        let _ = write!(
            out,
            ": the automatic choice is right on {auto}, the counting formula on {count}"
        );
    }
    let _ = write!(out, "\n\n{}\n", table(&heads, method_rows(survey), width));
    let _ = write!(
        out,
        "\n{} {}. On {machine}.\n",
        tolerances(survey),
        repeated(survey)
    );
    for (title, sentence) in sentences {
        // Writing to a string cannot fail.
        let _ = write!(out, "\n{title}: {sentence}\n");
    }
    fit(&out, width)
}

/// Each method as it is, and with its best tolerance where it has one.
fn method_rows(survey: &Survey) -> Vec<Vec<String>> {
    let cases = survey.cases.len();
    let count = |n: usize| if n == 0 { String::new() } else { n.to_string() };
    let mut rows = Vec::new();
    for (m, method) in registry::ALL.iter().enumerate() {
        let s = survey.standing(m);
        let row = |name: String, right: usize, pose: usize, why: String| {
            let [from, to] = s.middle_half.map(duration);
            vec![
                name,
                right.to_string(),
                count(pose),
                count(s.applies - right - pose),
                count(cases - s.applies),
                duration(s.seconds),
                format!("{from} to {to}"),
                why,
            ]
        };
        rows.push(row(
            method.name().to_owned(),
            s.right,
            s.pose,
            failures(survey, m),
        ));
        let tuned = survey.tuned.iter().find(|t| t.method == m);
        if let Some((t, name)) = tuned.and_then(|t| Some((t, tuned_name(t)?))) {
            rows.push(row(name, t.right, t.pose, "its best tolerance".to_owned()));
        }
    }
    rows
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
