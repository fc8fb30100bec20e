//! Special mechanisms with one joint off, by a hundredth to a thousand units of the last digit: below half a unit the special
//! geometry is to be found again, above one and a half the offset is to be kept.

use super::change::Noise;
use super::said::{AnswerCount, Counts, Said};
use super::special::SpecialKind;
use super::study::{Effort, Progress, Study};
use crate::file::text::mechanism_from_str;
use crate::format::list;
use crate::model::mechanism::StateId;
use crate::rank::method::auto::decide;
use rayon::prelude::*;

/// Offsets in units of the last digit. Between half a unit and one and a half the digits allow both.
const UNITS: [f64; 12] = [
    0.01, 0.1, 0.25, 0.4, 1.6, 2.0, 3.0, 5.0, 10.0, 50.0, 200.0, 1000.0,
];
/// Decimals they are written with.
const DECIMALS: std::ops::RangeInclusive<usize> = 3..=12;

/// What is said of the file of one of a kind, the worse of W and finite mobility.
fn ask(text: &str, truth: (i64, i64)) -> Said {
    let Ok(m) = mechanism_from_str("offset.toml", text) else {
        return Said::Open;
    };
    let found = decide(&m, StateId::FREE).ok();
    let [w, finite] = Said::of_decision(found.as_ref(), truth);
    w.max(finite)
}

/// Runs the study.
pub(super) fn study(effort: Effort, progress: Progress<'_>) -> Study {
    let (each, step) = if effort.quick { (1, 3) } else { (6, 1) };
    let decimals: Vec<usize> = DECIMALS.step_by(step).collect();
    let mut rows: Vec<(String, Vec<AnswerCount>)> = SpecialKind::ALL
        .iter()
        .map(|k| (k.name().to_owned(), Vec::new()))
        .collect();
    for (n, &units) in UNITS.iter().enumerate() {
        progress("offsets", n, UNITS.len());
        for (k, kind) in SpecialKind::ALL.into_iter().enumerate() {
            let said: Vec<(Said, String)> = (0..decimals.len() * each * 2)
                .into_par_iter()
                .map(|i| {
                    let (d, turned) = (decimals[i / 2 % decimals.len()], i % 2 == 1);
                    let mut noise = Noise::new(effort.seed, i * SpecialKind::ALL.len() + k);
                    let text = kind.text(units, d, turned, &mut noise);
                    (ask(&text, kind.figures(units > 1.0)), text)
                })
                .collect();
            let mut count = AnswerCount::default();
            for (said, text) in said {
                count.add(said, || text.replace('\n', " "));
            }
            rows[k].1.push(count);
        }
    }
    let counts = Counts {
        x: "offset, in units of the last digit".to_owned(),
        column: "units",
        values: UNITS.to_vec(),
        rows,
    };
    let together = counts.together();
    let all = "Special geometry with one joint off";
    let mut pictures = vec![counts.picture("stability-offsets", all, &together)];
    for (kind, row) in SpecialKind::ALL.iter().zip(&counts.rows) {
        let name = format!("stability-offsets-{}", kind.name().replace(' ', "-"));
        pictures.push(counts.picture(&name, &format!("One joint off: {}", row.0), &row.1));
    }
    Study {
        name: "stability-offsets",
        title: all.to_owned(),
        sentence: sentence(&together),
        pictures,
        csv: counts.csv(),
    }
}

/// The three counts below half a unit, and for each offset above.
fn sentence(together: &[AnswerCount]) -> String {
    let each: Vec<String> = UNITS
        .iter()
        .zip(together)
        .map(|(units, count)| {
            let [right, open, wrong] = count.three();
            format!("{units} units {right}, {open}, {wrong}")
        })
        .collect();
    format!(
        "Below half a unit the special geometry is right, above it the offset. Right, undecided or said not to be exact, and \
         wrong but sure are at {}.",
        list(&each)
    )
}
