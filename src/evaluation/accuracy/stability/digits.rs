//! Every mechanism turned at random and rounded: W at the pose, finite mobility and search counts, each right, left open, or
//! wrong and sure, against the number of decimals.

use super::change::{Noise, turned_and_rounded};
use super::said::{AnswerCount, Counts, Said};
use super::study::{Effort, Progress, Study};
use crate::accuracy::survey::Case;
use crate::format::list;
use crate::model::mechanism::{JointOption, Mechanism, StateId};
use crate::rank::method::auto::decide;
use crate::score::outcome::Outcome;
use crate::score::request::{Check, List, Request};
use crate::score::run::run;
use rayon::prelude::*;

/// Decimals that are tried, finest first: the axis ascends.
const DECIMALS: [usize; 7] = [12, 9, 7, 6, 5, 4, 3];
/// What is asked.
const ASKED: [&str; 3] = ["W at the pose", "finite mobility", "search counts"];
/// Searches are of at most so many joints,
const JOINTS: usize = 8;
/// and so many variants; fewer in a quick run.
const VARIANTS: [u32; 2] = [1000, 81];

/// The same with its present joints as the only options of the file.
fn plain(mut m: Mechanism) -> Mechanism {
    for joint in &mut m.joints {
        joint.unloading.clear();
        joint.options = vec![JointOption::in_frame_of(joint, &joint.joint_type)];
    }
    m
}

fn search(mechanism: Mechanism) -> Option<Outcome> {
    let request = Request {
        options: ["revolute", "cylindrical", "spherical"]
            .map(str::to_owned)
            .to_vec(),
        list: List::Nothing,
        check: Check::None,
        nodes: 20_000,
        ..Request::default()
    };
    run(mechanism, &request, &|| false, &mut |_| {}).ok()
}

/// The exact counts of a mechanism that is small enough.
fn counted(case: &Case, most: u32) -> Option<Outcome> {
    let small = case.state == StateId::FREE && case.mechanism.joints.len() <= JOINTS;
    let found = small.then(|| search(plain(case.mechanism.clone())))??;
    (found.is_exact() && found.search.size() <= most.into()).then_some(found)
}

/// Admissible and determinate ones, in all and by W.
fn same(a: &Outcome, b: &Outcome) -> bool {
    [
        (&a.admissible, &b.admissible),
        (&a.determinate, &b.determinate),
    ]
    .iter()
    .all(|(a, b)| a.total == b.total && a.by_mobility == b.by_mobility)
}

/// What is said of a turned mechanism; counts where they are known.
fn ask(m: Mechanism, case: &Case, truth: Option<&Outcome>) -> [Option<Said>; 3] {
    let found = decide(&m, case.state).ok();
    let figures = (case.truth.instantaneous, case.truth.finite);
    let [w, finite] = Said::of_decision(found.as_ref(), figures);
    let counts = truth.map(|truth| {
        let found = search(plain(m));
        let exact = |o: &Outcome| o.is_exact() || o.is_determinate_exact();
        Said::of(
            found.is_some(),
            found.as_ref().is_some_and(exact),
            found.as_ref().is_some_and(|f| same(f, truth)),
        )
    });
    [Some(w), Some(finite), counts]
}

/// Runs the study.
pub(super) fn study(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (step, turns) = if effort.quick { (3, 1) } else { (1, 1) };
    let decimals: Vec<usize> = DECIMALS.into_iter().step_by(step).collect();
    let most = VARIANTS[usize::from(effort.quick)];
    let exact: Vec<Option<Outcome>> = cases.par_iter().map(|c| counted(c, most)).collect();
    let mut rows = ASKED.map(|n| (n.to_owned(), Vec::new()));
    for (n, &d) in decimals.iter().enumerate() {
        progress("digits", n, decimals.len());
        let said: Vec<[Option<Said>; 3]> = (0..cases.len() * turns)
            .into_par_iter()
            .map(|i| {
                let (c, turn) = (i / turns, (i % turns) as u64);
                let mut noise = Noise::new(effort.seed.wrapping_add(turn), c);
                let m = turned_and_rounded(&cases[c].mechanism, d, &mut noise);
                ask(m, &cases[c], exact[c].as_ref())
            })
            .collect();
        for (asked, row) in rows.iter_mut().enumerate() {
            let mut count = AnswerCount::default();
            for (at, said) in said.iter().enumerate() {
                if let Some(said) = said[asked] {
                    let (case, turn) = (&cases[at / turns], at % turns);
                    count.add(said, || format!("{}, turn {}", case.name(), turn + 1));
                }
            }
            row.1.push(count);
        }
    }
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "12 at most"
    )]
    let values = decimals.iter().map(|&d| 10f64.powi(-(d as i32))).collect();
    let counts = Counts {
        x: "unit in the last decimal of points and axes".to_owned(),
        column: "unit",
        values,
        rows: rows.into(),
    };
    let stems = ["pose", "finite", "counts"];
    let pictures = stems.into_iter().zip(&counts.rows).map(|(stem, row)| {
        let name = format!("stability-digits-{stem}");
        counts.picture(&name, &format!("Turned and rounded: {}", row.0), &row.1)
    });
    Study {
        name: "stability-digits",
        title: "Turned and rounded: right, undecided, wrong and sure".to_owned(),
        sentence: sentence(&counts, &decimals),
        pictures: pictures.collect(),
        csv: counts.csv(),
    }
}

/// The three counts of each question for each number of decimals.
fn sentence(counts: &Counts, decimals: &[usize]) -> String {
    let told: Vec<String> = counts
        .rows
        .iter()
        .map(|(name, row)| {
            let each: Vec<String> = decimals
                .iter()
                .zip(row)
                .rev()
                .map(|(d, c)| {
                    let [right, open, wrong] = c.three();
                    format!("{d} decimals {right}, {open}, {wrong}")
                })
                .collect();
            format!("{name}: {}", each.join("; "))
        })
        .collect();
    format!(
        "Answers that are right, undecided or said not to be exact, and wrong but sure, are of {}.",
        list(&told)
    )
}
