//! Mechanisms in other units: every length times 10^-6 to 10^6.

use super::change::resized;
use super::study::{Effort, Picture, Progress, Study};
use super::sweep::{RightTally, TallySweep};
use crate::accuracy::AnswerVerdict;
use crate::accuracy::survey::Case;
use crate::format::{list, scientific};
use crate::rank::method::MobilityMethod;
use crate::rank::method::registry;
use crate::rank::numeric::Elimination;
use rayon::prelude::*;

/// Runs the study.
pub(super) fn study(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Study {
    let step = if effort.quick { 3 } else { 1 };
    let exponents: Vec<i32> = (-6..=6).step_by(step).collect();
    let names = Elimination::ALL.map(|e| e.name());
    let methods: Vec<&dyn MobilityMethod> = names
        .into_iter()
        .chain(["modular", "auto"])
        .filter_map(registry::by_name)
        .collect();
    let mut rows: Vec<(String, Vec<RightTally>)> = methods
        .iter()
        .map(|m| (m.name().to_owned(), Vec::new()))
        .collect();
    for (n, &e) in exponents.iter().enumerate() {
        progress("scale", n, exponents.len());
        let kept: Vec<Vec<bool>> = cases
            .par_iter()
            .map(|c| {
                let m = resized(&c.mechanism, e);
                let ask = |x: &&dyn MobilityMethod| {
                    AnswerVerdict::keeps_promise(&x.answer(&m, c.state), c.truth)
                };
                methods.iter().map(ask).collect()
            })
            .collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let mut tally = RightTally::default();
            kept.iter()
                .enumerate()
                .for_each(|(c, k)| tally.add(c, k[i]));
            row.1.push(tally);
        }
    }
    let sweep = TallySweep {
        title: "Scale of the coordinates".to_owned(),
        x: "all lengths multiplied by".to_owned(),
        column: "factor",
        values: exponents.iter().map(|&e| 10f64.powi(e)).collect(),
        cases: cases.iter().map(Case::name).collect(),
        rows,
    };
    let sentence = sentence(&sweep);
    Study {
        name: "stability-scale",
        title: sweep.title.clone(),
        pictures: vec![
            Picture::of_bands("stability-scale", &sweep.bands()),
            Picture::of_chart(
                "stability-scale-share",
                &sweep.chart(
                    "Share right against scale",
                    "Cases in which a method keeps its promise: the mobility at the pose, and for auto the finite one.",
                ),
            ),
        ],
        sentence,
        csv: sweep.csv(),
    }
}

fn sentence(sweep: &TallySweep) -> String {
    let (mut always, mut rest) = (Vec::new(), Vec::new());
    for (n, (name, tallies)) in sweep.rows.iter().enumerate() {
        let Some(region) = sweep.region(n, 0) else {
            continue;
        };
        if sweep.is_whole(&region) && region.missed.is_empty() {
            always.push(name.clone());
            continue;
        }
        let least = tallies.iter().map(|t| 100.0 * t.share());
        let at = |n: usize| scientific(sweep.values[n]);
        rest.push(format!(
            "{name} is right {} from {} to {}, elsewhere in as few as {:.0} %",
            sweep.but(&region.missed),
            at(region.first),
            at(region.last),
            least.fold(f64::MAX, f64::min).floor()
        ));
    }
    let mut out = match always.as_slice() {
        [] => "No method is right in all cases at every scale".to_owned(),
        [one] => format!("{one} alone is right in all cases at every scale"),
        more => format!("{} are right in all cases at every scale", list(more)),
    };
    if !rest.is_empty() {
        out += &format!(
            "; those that take J as it stands depend on the unit of length: {}",
            list(&rest)
        );
    }
    out + "."
}
