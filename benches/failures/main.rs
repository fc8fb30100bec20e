//! Loss of accuracy of the three methods for the four-link group near each configuration in which the δ-point method fails.
//!
//! `cargo bench --bench failures -- [-o DIR]` prints the relative errors against exact arithmetic by distance from each
//! failure, for the parallel shears. With `-o DIR`, charts and a page are written to a folder.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    missing_docs,
    reason = "a bench reports what it measures"
)]

#[path = "exact.rs"]
mod exact;
#[path = "study.rs"]
mod study;

use ozols::chart::{Axis, Chart, Scale, Series, Style, page};
use ozols::model::mechanism::StateId;
use ozols::statics::contour_group::solutions::GroupMethod;
use ozols::statics::cycle::planar_statics;
use std::path::PathBuf;
use study::{DistanceErrors, Failure, GROUPS, heaviest_group, study_failures};

fn log_axis(label: &str) -> Axis {
    Axis {
        scale: Scale::Log,
        ..Axis::linear(label)
    }
}

/// Returns title, subtitle and axis of a stability chart.
fn stability_labels(failure: Failure) -> (&'static str, &'static str, &'static str) {
    match failure {
        Failure::ParallelRods => (
            "Rods 6 and 7 nearly parallel",
            "δ goes to infinity; the group itself is sound",
            "angle between the rods, rad",
        ),
        Failure::AcrossGuide => (
            "D nearly on the line through δ across the guide",
            "The group nears a dead point: reactions grow without bound",
            "angle between Dδ and the guide's normal, rad",
        ),
        Failure::AtDelta => (
            "D nearly at δ",
            "The group nears a dead point: reactions grow without bound",
            "l_Dδ over its length in the machine",
        ),
        Failure::NoGuideReaction => (
            "Guide reaction nearly zero: error of its arm h",
            "The forces stay right; h = moment over force loses its figures whatever the method",
            "R_0/10 over its value in the machine",
        ),
    }
}

/// Returns the errors of the methods against the distance from a failure.
fn stability_chart(failure: Failure, samples: &[DistanceErrors]) -> Chart {
    // What is exact to the last bit is shown at the foot.
    let shown = |x: f64| {
        if x.is_finite() {
            x.clamp(1e-17, 1e3)
        } else {
            1e3
        }
    };
    let arms = failure == Failure::NoGuideReaction;
    let line = |name: &str, style, f: &dyn Fn(&DistanceErrors) -> f64| Series {
        name: name.to_owned(),
        points: samples.iter().map(|s| (s.distance, shown(f(s)))).collect(),
        style,
    };
    let of = |k: usize| move |s: &DistanceErrors| if arms { s.arm[k] } else { s.forces[k] };
    let mut series = vec![
        line("δ-point", Style::Line, &of(0)),
        line("projective", Style::Line, &of(1)),
        line("equilibrium, LU", Style::Line, &of(2)),
    ];
    if arms {
        let worst = |s: &DistanceErrors| s.forces.into_iter().fold(0.0, f64::max);
        series.push(line("forces, worst of the three", Style::Dashed, &worst));
    } else {
        series.push(line(
            "condition of LU × rounding unit",
            Style::Dashed,
            &|s| s.condition * f64::EPSILON / 2.0,
        ));
    }
    let (title, subtitle, x) = stability_labels(failure);
    Chart {
        title: title.to_owned(),
        subtitle: subtitle.to_owned(),
        x: log_axis(x),
        y: log_axis("relative error against exact arithmetic"),
        series,
    }
}

/// Returns the rows of a table: failure, figure, method, and the errors at distances 1, 1e-3, ... 1e-15.
fn stability_rows(failure: Failure, samples: &[DistanceErrors]) -> Vec<Vec<String>> {
    let at = |decade: i32| {
        let wanted = 10f64.powi(-decade);
        let near = |s: &&DistanceErrors| (s.distance.log10() - wanted.log10()).abs();
        samples.iter().min_by(|a, b| near(a).total_cmp(&near(b)))
    };
    let figures: &[(&str, bool)] = match failure {
        Failure::NoGuideReaction => &[("h", true), ("forces", false)],
        _ => &[("forces", false)],
    };
    let mut rows = Vec::new();
    for (figure, arms) in figures {
        for (k, method) in GroupMethod::ALL.iter().enumerate() {
            let mut row = vec![
                failure.name().to_owned(),
                (*figure).to_owned(),
                method.name().to_owned(),
            ];
            row.extend([0, 3, 6, 9, 12, 15].map(|d| {
                let error = at(d).map(|s| if *arms { s.arm[k] } else { s.forces[k] });
                error
                    .filter(|e| e.is_finite())
                    .map_or_else(|| "-".to_owned(), |e| format!("{e:.0e}"))
            }));
            rows.push(row);
        }
    }
    rows
}

fn main() {
    let mut folder = None;
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "-o" => folder = Some(PathBuf::from(words.next().expect("a folder"))),
            // What cargo adds.
            "--bench" => {}
            other => panic!("{other}: -o DIR"),
        }
    }
    let shears = ozols::built_in("parallel-shears").expect("it is built in");
    let found = planar_statics(&shears, StateId::FREE, shears.loads.stroke).expect("it is planar");
    let base = heaviest_group(&found).expect("it has such a group");
    let found = study_failures(base, 1);
    println!(
        "Relative error against exact arithmetic by distance from each failure, median of {GROUPS} groups"
    );
    println!("| failure | figure | method | 1 | 1e-3 | 1e-6 | 1e-9 | 1e-12 | 1e-15 |");
    for (failure, samples) in &found {
        for row in stability_rows(*failure, samples) {
            println!("| {} |", row.join(" | "));
        }
    }
    let Some(folder) = folder else { return };
    std::fs::create_dir_all(&folder).expect("the folder");
    let write = |name: String, text: String| {
        std::fs::write(folder.join(name), text).expect("the file");
    };
    let mut parts = Vec::new();
    for (failure, samples) in &found {
        let chart = stability_chart(*failure, samples);
        write(format!("stability-{}.csv", failure.name()), chart.csv());
        write(format!("stability-{}.svg", failure.name()), chart.svg());
        parts.push((chart.title.clone(), chart.subtitle.clone(), chart.svg()));
    }
    write(
        "index.html".to_owned(),
        page("Stability of the δ-point method", &parts),
    );
}
