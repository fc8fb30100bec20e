//! Every mechanism turned at random and rounded to 4 to 16 decimals, the commonest failure in life, judged by the mechanism
//! as it was.

use super::change::{Noise, turned_and_rounded};
use super::study::{Effort, Picture, Progress, Study};
use super::sweep::{RightTally, TallySweep};
use crate::accuracy::survey::Case;
use crate::closure::Closure;
use crate::geom::Reals;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::numeric::Elimination;
use crate::rank::rounded::verdict::verdict;
use rayon::prelude::*;

/// Decimals that are tried.
const DECIMALS: std::ops::RangeInclusive<usize> = 4..=16;
/// Tolerances of the singular values that are asked beside.
const TOLERANCES: [f64; 2] = [1e-9, 1e-6];
/// What is counted.
const ROWS: [&str; 5] = [
    "auto",
    "auto, right or undecided",
    "every digit at its word",
    "svd at 1e-9",
    "svd at 1e-6",
];

/// Whether each of [`ROWS`] is right at the pose.
fn ask(m: &Mechanism, state: StateId, truth: i64) -> [bool; 5] {
    let is = |w: Option<usize>| w.and_then(|w| i64::try_from(w).ok()) == Some(truth);
    let found = verdict(m, state).ok();
    let of = |rank: Option<usize>| is(found.as_ref().zip(rank).map(|(v, r)| v.figures(r).0));
    let decided = found.as_ref().is_some_and(|v| v.is_decided());
    let right = of(found.as_ref().map(|v| v.rank()));
    let closure = Closure::new(&Reals, m, state).ok();
    let svd = closure.map(|c| Elimination::Svd.mobilities(&c, &TOLERANCES));
    let at = |n: usize| svd.as_ref().is_some_and(|w| w[n] == Some(truth));
    [
        decided && right,
        !decided || right,
        of(found.as_ref().map(|v| v.as_written)),
        at(0),
        at(1),
    ]
}

/// Runs the study.
pub(super) fn study(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (step, turns) = if effort.quick { (4, 1) } else { (1, 3) };
    // Finest first: the axis ascends.
    let decimals: Vec<usize> = DECIMALS.rev().step_by(step).collect();
    let mut rows: Vec<(String, Vec<RightTally>)> =
        ROWS.iter().map(|n| ((*n).to_owned(), Vec::new())).collect();
    for (n, &d) in decimals.iter().enumerate() {
        progress("rounding", n, decimals.len());
        let right: Vec<[bool; 5]> = (0..cases.len() * turns)
            .into_par_iter()
            .map(|i| {
                let (c, turn) = (i / turns, (i % turns) as u64);
                let mut noise = Noise::new(effort.seed.wrapping_add(turn), c);
                let m = turned_and_rounded(&cases[c].mechanism, d, &mut noise);
                ask(&m, cases[c].state, cases[c].truth.instantaneous)
            })
            .collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let mut tally = RightTally::default();
            for (at, found) in right.iter().enumerate() {
                tally.add(at / turns, found[i]);
            }
            row.1.push(tally);
        }
    }
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "16 at most"
    )]
    let values = decimals.iter().map(|&d| 10f64.powi(-(d as i32))).collect();
    let sweep = TallySweep {
        title: "Turned and rounded".to_owned(),
        x: "unit in the last decimal of points and axes".to_owned(),
        column: "unit",
        values,
        cases: cases.iter().map(Case::name).collect(),
        rows,
    };
    Study {
        name: "stability-rounded",
        title: sweep.title.clone(),
        sentence: sentence(&sweep, &decimals),
        pictures: vec![
            Picture::of_bands("stability-rounded", &sweep.bands()),
            Picture::of_chart(
                "stability-rounded-share",
                &sweep.chart(
                    "Share right against rounding",
                    &format!(
                        "{} mechanisms, turned at random, whose mobility at the pose before that is found.",
                        cases.len() * turns
                    ),
                ),
            ),
        ],
        csv: sweep.csv(),
    }
}

/// Right, undecided and wrong of the automatic choice for each number of decimals.
fn sentence(sweep: &TallySweep, decimals: &[usize]) -> String {
    let [right, bounded, ..] = &sweep.rows[..] else {
        return String::new();
    };
    let each = decimals.iter().zip(right.1.iter().zip(&bounded.1)).rev();
    let parts: Vec<String> = each
        .map(|(d, (r, b))| {
            let (undecided, wrong) = (b.right - r.right, b.of - b.right);
            format!("{d} decimals {}, {undecided}, {wrong}", r.right)
        })
        .collect();
    let of = right.1.first().map_or(0, |t| t.of);
    format!(
        "Of {of} cases auto is right, undecided, and wrong but sure: {}.",
        parts.join("; ")
    )
}
