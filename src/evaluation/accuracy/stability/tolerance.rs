//! The tolerance of the floating-point methods, 1e-15 to 1e-3, with and without noise; the default follows from it.

use super::change::{Noise, shaken};
use super::study::{Effort, Picture, Progress, Study};
use super::sweep::{RightTally, TallySweep};
use crate::accuracy::survey::Case;
use crate::accuracy::tuned::tolerances;
use crate::closure::Closure;
use crate::format::{list, scientific};
use crate::geom::Reals;
use crate::rank::method::MobilityMethod;
use crate::rank::numeric::{DEFAULT_TOLERANCE, Elimination};
use rayon::prelude::*;

/// Levels of noise; 0 is the catalogue as it stands.
const LEVELS: [f64; 4] = [0.0, 1e-12, 1e-9, 1e-6];

fn name(method: Elimination, level: f64) -> String {
    if level == 0.0 {
        method.name().to_owned()
    } else {
        format!("{}, noise {}", method.name(), scientific(level))
    }
}

/// Tallies over the tolerances for each method, at a level of noise.
fn tally(cases: &[Case], effort: Effort, level: f64, tolerances: &[f64]) -> Vec<Vec<RightTally>> {
    let seeds = if level == 0.0 || effort.quick { 1 } else { 3 };
    let right: Vec<Vec<Vec<bool>>> = (0..cases.len() * seeds)
        .into_par_iter()
        .map(|i| {
            let (n, seed) = (i / seeds, (i % seeds) as u64);
            let (case, mut noise) = (&cases[n], Noise::new(effort.seed.wrapping_add(seed), n));
            let closure = if level == 0.0 {
                Closure::new(&Reals, &case.mechanism, case.state)
            } else {
                let m = shaken(&case.mechanism, level, &mut noise);
                Closure::new(&Reals, &m, case.state)
            };
            let truth = Some(case.truth.instantaneous);
            Elimination::ALL
                .iter()
                .map(|method| match &closure {
                    Ok(c) => {
                        let found = method.mobilities(c, tolerances);
                        found.into_iter().map(|w| w == truth).collect()
                    }
                    Err(_) => vec![false; tolerances.len()],
                })
                .collect()
        })
        .collect();
    let mut tallies = vec![vec![RightTally::default(); tolerances.len()]; Elimination::ALL.len()];
    for (at, one) in right.iter().enumerate() {
        for (row, found) in tallies.iter_mut().zip(one) {
            for (t, ok) in row.iter_mut().zip(found) {
                t.add(at / seeds, *ok);
            }
        }
    }
    tallies
}

/// Runs the study.
pub(super) fn study(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let tolerances = tolerances(if effort.quick { 2 } else { 1 });
    let mut found: Vec<Vec<Vec<RightTally>>> = Vec::new();
    for (n, &level) in LEVELS.iter().enumerate() {
        progress("tolerance", n, LEVELS.len());
        found.push(tally(cases, effort, level, &tolerances));
    }
    let mut rows = Vec::new();
    for (m, method) in Elimination::ALL.into_iter().enumerate() {
        for (n, &level) in LEVELS.iter().enumerate() {
            rows.push((name(method, level), found[n][m].clone()));
        }
    }
    let all = TallySweep {
        title: "Tolerance of the floating-point methods".to_owned(),
        x: "tolerance, relative to the largest pivot or singular value".to_owned(),
        column: "tolerance",
        values: tolerances,
        cases: cases.iter().map(Case::name).collect(),
        rows,
    };
    let part = |names: Vec<String>| {
        let rows = all.rows.iter().filter(|r| names.contains(&r.0));
        TallySweep {
            rows: rows.cloned().collect(),
            ..all.clone()
        }
    };
    let methods = part(Elimination::ALL.map(|m| name(m, 0.0)).to_vec());
    let levels = part(LEVELS.map(|l| name(Elimination::Svd, l)).to_vec());
    let sentence = sentence(&all);
    Study {
        name: "stability-tolerance",
        title: all.title.clone(),
        pictures: vec![
            Picture::of_bands("stability-tolerance", &all.bands()),
            Picture::of_chart(
                "stability-tolerance-methods",
                &methods.chart(
                    "Share right against tolerance, by method",
                    "Coordinates as in the catalogue; cases in which the mobility at the pose is found.",
                ),
            ),
            Picture::of_chart(
                "stability-tolerance-noise",
                &levels.chart(
                    "Share right against tolerance, by noise",
                    "Singular values; cases in which the mobility at the pose of the mechanism without noise is found.",
                ),
            ),
        ],
        sentence,
        csv: all.csv(),
    }
}

/// The tolerances at which a row does best, in words, and their middle on a log scale.
fn best(sweep: &TallySweep, row: &str) -> Option<(String, f64)> {
    let region = sweep.region(sweep.row(row)?, 0)?;
    let (from, to) = (sweep.values[region.first], sweep.values[region.last]);
    let least = if region.first == 0 {
        " (the least tried)"
    } else {
        ""
    };
    let range = if from < to {
        format!("{}{least} to {}", scientific(from), scientific(to))
    } else {
        format!("{} alone", scientific(from))
    };
    let words = format!("{range} {}", sweep.but(&region.missed));
    Some((words, (from * to).sqrt()))
}

fn sentence(sweep: &TallySweep) -> String {
    let levels = LEVELS.iter().filter_map(|&level| {
        let noise = match level {
            0.0 => "without noise".to_owned(),
            l => format!("with noise {}", scientific(l)),
        };
        let (words, middle) = best(sweep, &name(Elimination::Svd, level))?;
        Some(format!("{noise} {words} (middle {})", scientific(middle)))
    });
    let others = Elimination::ALL
        .into_iter()
        .filter(|m| *m != Elimination::Svd)
        .filter_map(|m| Some(format!("{} {}", m.name(), best(sweep, m.name())?.0)));
    let default = best(sweep, Elimination::Svd.name()).map_or_else(String::new, |(_, middle)| {
        format!(
            " Recommended default tolerance: {}, the middle without noise; the present default is {}.",
            scientific(middle),
            scientific(DEFAULT_TOLERANCE)
        )
    });
    format!(
        "Tolerances at which singular values are right: {}. The others, without noise: {}.{default}",
        list(&levels.collect::<Vec<_>>()),
        list(&others.collect::<Vec<_>>())
    )
}
