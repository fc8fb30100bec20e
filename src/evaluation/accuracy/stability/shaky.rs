//! Shakiness of higher and higher order: rows of toggles made from a seed, each knee pushed by the one before by the square of
//! its motion. At the pose they have one freedom, and none in truth [Connelly and Servatius 1994; Calladine and Pellegrino 1991].

use super::change::Noise;
use super::said::{self, AnswerCount, Counts, Replies};
use super::special::Sketch;
use super::study::{Effort, Picture, Progress, Study};
use super::sweep::{RightTally, TallySweep};
use crate::accuracy::Truth;
use crate::file::text::mechanism_from_str;
use crate::format::list;
use rayon::prelude::*;

/// The file of a row of toggles of order 2^levels.
#[must_use]
pub fn toggles(levels: usize, noise: &mut Noise) -> String {
    #[allow(clippy::cast_possible_truncation, reason = "130 at most")]
    let mut length = || 100 + (30.0 * noise.uniform()) as i64;
    let mut s = Sketch::default();
    let text = |[x, y]: [i64; 2]| [x.to_string(), y.to_string()];
    let mut pin = |ends: [&str; 2], at: [i64; 2]| {
        let [x, y] = text(at);
        s.pin(ends, &x, &y);
    };
    // The first knee lies between two bars along x, each further one between two bars across the last push.
    let mut knee = [0, 0];
    for k in 0..levels {
        let moved = |by: i64| {
            let mut at = knee;
            at[k % 2] += by;
            at
        };
        let (a, b) = (format!("a{k}"), format!("b{k}"));
        pin(["0", &a], moved(-length()));
        pin([&a, &b], knee);
        if k > 0 {
            pin([&format!("b{}", k - 1), &a], knee);
        }
        knee = moved(length());
        if k + 1 == levels {
            pin([&b, "0"], knee);
        }
    }
    s.text("toggles")
}

const TRUTH: Truth = Truth {
    instantaneous: 1,
    finite: 0,
};

/// Runs the study.
pub(super) fn study(effort: Effort, progress: Progress<'_>) -> Study {
    let (each, most) = if effort.quick { (1, 3) } else { (3, 6) };
    let mut rows = said::rows();
    let mut auto = Vec::new();
    for levels in 1..=most {
        progress("order of shakiness", levels - 1, most);
        let found: Vec<Replies> = (0..each)
            .into_par_iter()
            .filter_map(|i| {
                let text = toggles(levels, &mut Noise::new(effort.seed, 100 * levels + i));
                let m = mechanism_from_str("toggles.toml", &text).ok()?;
                Replies::new(&[(m, TRUTH)], text)
            })
            .collect();
        said::add(&mut rows, &found);
        auto.push(said::auto(&found));
    }
    let values: Vec<f64> = (1..=most).map(|l| f64::from(1u32 << l)).collect();
    let x = "order of shakiness".to_owned();
    let sweep = TallySweep {
        title: "Order of shakiness".to_owned(),
        x: x.clone(),
        column: "order",
        values: values.clone(),
        cases: (0..each).map(|i| format!("toggles {}", i + 1)).collect(),
        rows,
    };
    let counts = Counts {
        x,
        column: "order",
        values,
        rows: vec![("toggles".to_owned(), auto.clone())],
    };
    Study {
        name: "stability-shaky",
        title: sweep.title.clone(),
        sentence: sentence(&sweep, &auto),
        pictures: vec![
            Picture::of_bands("stability-shaky", &sweep.bands()),
            counts.picture(
                "stability-shaky-auto",
                "Order of shakiness: what auto says",
                &auto,
            ),
        ],
        csv: sweep.csv(),
    }
}

/// Who keeps what he promises at every order, and what the automatic choice says at each.
fn sentence(sweep: &TallySweep, auto: &[AnswerCount]) -> String {
    let kept = |row: &&(String, Vec<RightTally>)| row.1.iter().all(|t| t.of > 0 && t.right == t.of);
    let always: Vec<String> = sweep
        .rows
        .iter()
        .filter(kept)
        .map(|r| r.0.clone())
        .collect();
    let each: Vec<String> = sweep
        .values
        .iter()
        .zip(auto)
        .map(|(order, count)| {
            let [right, open, wrong] = count.three();
            format!("order {order} {right}, {open}, {wrong}")
        })
        .collect();
    format!(
        "Rows of toggles that have one freedom at the pose and none in truth. What it promises, at the pose or for the motion, is kept \
         at every order by {}. auto is right, undecided, and wrong but sure: {}.",
        list(&always),
        list(&each)
    )
}
