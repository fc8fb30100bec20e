//! Errors of the three methods for the four-link group near each of their failures, against the distance from it.
//!
//! `cargo bench --bench failures -- [-o DIR]` prints the median errors at distances 1 to 1e-15 and writes a chart and a table of
//! each failure to a folder, by default `target/failures`.

#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    missing_docs,
    reason = "a bench reports what it measures"
)]

#[path = "study.rs"]
mod study;

use ozols::chart::{Axis, Chart, Scale, Series, Style, page};
use ozols::model::mechanism::StateId;
use ozols::statics::cycle::planar_statics;
use std::path::Path;
use study::{DistanceErrors, Failure, sample_errors};

/// Of each of [`Failure::ALL`] the stem of the file, and title, subtitle and horizontal axis of the chart.
const WORDS: [[&str; 4]; 4] = [
    [
        "parallel-rods",
        "Rods 6 and 7 nearly parallel",
        "δ goes to infinity; the group itself is sound",
        "angle between the rods, rad",
    ],
    [
        "across-guide",
        "D nearly on the line through δ across the guide",
        "The group nears a dead point: reactions grow without bound",
        "angle between Dδ and the guide's normal, rad",
    ],
    [
        "at-delta",
        "D nearly at δ",
        "The group nears a dead point: reactions grow without bound",
        "l_Dδ over its length in the machine",
    ],
    [
        "no-guide-reaction",
        "Guide reaction nearly zero: error of its arm h",
        "The forces stay right; h = moment over force loses its figures whatever the method",
        "R_0/10 over its value in the machine",
    ],
];

fn log_axis(label: &str) -> Axis {
    let scale = Scale::Log;
    Axis {
        scale,
        ..Axis::linear(label)
    }
}

/// Returns the chart of the errors near a failure; what is exact to the last bit is shown at the foot.
fn draw_chart(failure: Failure, words: [&str; 4], samples: &[DistanceErrors]) -> Chart {
    let arms = failure == Failure::NoGuideReaction;
    let series = |name: &str, style, of: &dyn Fn(&DistanceErrors) -> f64| Series {
        name: name.to_owned(),
        points: samples
            .iter()
            .map(|s| (s.distance, of(s).clamp(1e-17, 1e3)))
            .collect(),
        style,
    };
    let of = |k: usize| move |s: &DistanceErrors| if arms { s.arm[k] } else { s.forces[k] };
    let worst = |s: &DistanceErrors| s.forces.into_iter().fold(0.0, f64::max);
    let rounding = |s: &DistanceErrors| s.condition * f64::EPSILON / 2.0;
    let last = if arms {
        series("forces, worst of the three", Style::Dashed, &worst)
    } else {
        series("condition of LU × rounding unit", Style::Dashed, &rounding)
    };
    Chart {
        title: words[1].to_owned(),
        subtitle: words[2].to_owned(),
        x: log_axis(words[3]),
        y: log_axis("relative error against exact arithmetic"),
        series: vec![
            series("δ-point", Style::Line, &of(0)),
            series("projective", Style::Line, &of(1)),
            series("equilibrium, LU", Style::Line, &of(2)),
            last,
        ],
    }
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let folder = words.iter().position(|w| w == "-o");
    let folder = folder.map_or("target/failures", |i| words[i + 1].as_str());
    std::fs::create_dir_all(folder).expect("the folder");
    let write = |name: &str, text: String| {
        std::fs::write(Path::new(folder).join(name), text).expect("the file");
    };
    let shears = ozols::built_in("parallel-shears").expect("it is built in");
    let cycle = planar_statics(&shears, StateId::FREE, shears.loads.stroke).expect("it is planar");
    let base = cycle.heaviest_contour_group().expect("it has a group");
    let distances: Vec<f64> = (0..=60).map(|i| 10f64.powf(-f64::from(i) / 4.0)).collect();
    let mut parts = Vec::new();
    for (failure, words) in Failure::ALL.into_iter().zip(WORDS) {
        let samples = sample_errors(base, failure, &distances, 9, 1);
        for s in samples.iter().step_by(12) {
            let digits = |errors: [f64; 3]| errors.map(|x| format!("{x:.0e}")).join(", ");
            let (forces, arms) = (digits(s.forces), digits(s.arm));
            println!(
                "{} at {:.0e}: forces {forces}; h {arms}",
                words[0], s.distance
            );
        }
        let chart = draw_chart(failure, words, &samples);
        write(&format!("{}.svg", words[0]), chart.svg());
        write(&format!("{}.csv", words[0]), chart.csv());
        parts.push((chart.title.clone(), String::new(), chart.svg()));
    }
    write(
        "index.html",
        page("Stability of the δ-point method", &parts),
    );
}
