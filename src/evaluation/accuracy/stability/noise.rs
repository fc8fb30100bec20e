//! Noise in the coordinates, 1e-15 to 1e-3 of the mechanism's size, judged by the mechanism without noise.

use super::change::{Noise, shaken};
use super::study::{Effort, Picture, Progress, Study};
use super::sweep::{RightTally, TallySweep};
use crate::accuracy::AnswerVerdict;
use crate::accuracy::survey::Case;
use crate::closure::Closure;
use crate::format::{list, scientific};
use crate::geom::Reals;
use crate::rank::method::MobilityMethod;
use crate::rank::method::registry;
use crate::rank::numeric::Elimination;
use rayon::prelude::*;

/// What is asked: the floating-point methods at these tolerances,
const ASKED: [(Elimination, &[f64]); 4] = [
    (Elimination::Lu32, &[1e-4]),
    (Elimination::Lu, &[1e-9, 1e-6]),
    (Elimination::Qr, &[1e-9, 1e-6]),
    (Elimination::Svd, &[1e-12, 1e-9, 1e-6, 1e-3]),
];
/// and these methods as they are, for the first seed only, since following a motion takes its time.
const WHOLE: [&str; 2] = ["modular", "auto"];

fn names() -> Vec<String> {
    let numeric = ASKED.iter().flat_map(|(m, tolerances)| {
        let at = |t: &f64| format!("{} at {}", m.name(), scientific(*t));
        tolerances.iter().map(at).collect::<Vec<_>>()
    });
    numeric.chain(WHOLE.map(str::to_owned)).collect()
}

/// Whether each of [`names`] is right on a shaken case; without those of [`WHOLE`] where `whole` is not set.
fn ask(case: &Case, level: f64, noise: &mut Noise, whole: bool) -> Vec<bool> {
    let m = shaken(&case.mechanism, level, noise);
    let closure = Closure::new(&Reals, &m, case.state).ok();
    let mut out = Vec::new();
    for (method, tolerances) in ASKED {
        match &closure {
            Some(c) => out.extend(
                method
                    .mobilities(c, tolerances)
                    .into_iter()
                    .map(|w| w == Some(case.truth.instantaneous)),
            ),
            None => out.extend(tolerances.iter().map(|_| false)),
        }
    }
    for name in WHOLE.iter().filter(|_| whole) {
        let answer = registry::by_name(name).map(|x| x.answer(&m, case.state));
        out.push(answer.is_some_and(|a| AnswerVerdict::keeps_promise(&a, case.truth)));
    }
    out
}

/// Runs the study.
pub(super) fn study(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let (step, seeds) = if effort.quick { (3, 1) } else { (1, 3) };
    let exponents: Vec<i32> = (-15..=-3).step_by(step).collect();
    let mut rows: Vec<(String, Vec<RightTally>)> =
        names().into_iter().map(|n| (n, Vec::new())).collect();
    for (n, &e) in exponents.iter().enumerate() {
        progress("noise", n, exponents.len());
        let right: Vec<Vec<bool>> = (0..cases.len() * seeds)
            .into_par_iter()
            .map(|i| {
                let (c, seed) = (i / seeds, (i % seeds) as u64);
                let mut noise = Noise::new(effort.seed.wrapping_add(seed), c);
                ask(&cases[c], 10f64.powi(e), &mut noise, seed == 0)
            })
            .collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let mut tally = RightTally::default();
            for (at, found) in right.iter().enumerate() {
                if let Some(&ok) = found.get(i) {
                    tally.add(at / seeds, ok);
                }
            }
            row.1.push(tally);
        }
    }
    let sweep = TallySweep {
        title: "Noise in the coordinates".to_owned(),
        x: "uniform noise, relative to the size of the mechanism and the length of axes".to_owned(),
        column: "noise",
        values: exponents.iter().map(|&e| 10f64.powi(e)).collect(),
        cases: cases.iter().map(Case::name).collect(),
        rows,
    };
    let sentence = sentence(&sweep);
    Study {
        name: "stability-noise",
        title: sweep.title.clone(),
        pictures: vec![
            Picture::of_bands("stability-noise", &sweep.bands()),
            Picture::of_chart(
                "stability-noise-share",
                &sweep.chart(
                    "Share right against noise",
                    &format!(
                        "{} noisy mechanisms ({} for modular and auto) whose mobility without noise is found: at the pose, and for auto the finite one.",
                        cases.len() * seeds,
                        cases.len()
                    ),
                ),
            ),
        ],
        sentence,
        csv: sweep.csv(),
    }
}

fn sentence(sweep: &TallySweep) -> String {
    let part = |name: &str| {
        let region = sweep.region(sweep.row(name)?, 1)?;
        Some(format!(
            "{name} up to noise of {} {}",
            scientific(sweep.values[region.last]),
            sweep.but(&region.missed)
        ))
    };
    let svd = ASKED[3].1.iter();
    let svd = svd.map(|t| format!("{} at {}", Elimination::Svd.name(), scientific(*t)));
    let told: Vec<String> = svd
        .chain(["auto".to_owned()])
        .filter_map(|name| part(&name))
        .collect();
    let exact = sweep.row("modular").and_then(|row| sweep.region(row, 0));
    let exact = exact.map_or_else(String::new, |r| {
        format!(
            " Exact ranks take every digit at its word: with any noise modular finds it {} only.",
            sweep.but(&r.missed)
        )
    });
    format!(
        "The mobility without noise is found by {}.{exact}",
        list(&told)
    )
}
