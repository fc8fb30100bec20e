//! How searches grow with the mechanism: nodes and time of both diagrams against the number of contours, family by family,
//! with the rows that choices differ in and with all rows. What takes more than 200,000 nodes from one end is built from both,
//! and then the smallest there is.
//!
//! `cargo bench --bench growth -- [FOLDER]` writes growth.svg and growth.md there, by default into target/growth. A family ends
//! with the first member that does not fit the budget.
//!
//! `cargo bench --bench growth -- --files FOLDER` only writes mechanism files there: what engines are held to, of which
//! `benches/growth/table` makes its table.

#![allow(
    clippy::print_stdout,
    missing_docs,
    reason = "a bench reports what it measures"
)]

mod families;

use families::{fingers, grid, hand, ladder, parallel_robot, ring, row, scissor_lift, walker};
use ozols::chart::{Axis, Chart, Scale, Series, Style};
use ozols::closure::contour::contour_basis;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::{Mechanism, StateId};
use ozols::redundancy::analysis::exact_field;
use ozols::search::Search;
use ozols::search::diagram::{Control, Stop};
use ozols::search::question::conditions::Conditions;
use std::path::PathBuf;
use std::time::Instant;

/// A name, and its members from small to large.
type Family = (&'static str, Vec<Mechanism>);

fn all() -> Vec<Family> {
    let of = |sizes: &[usize], make: &dyn Fn(usize) -> String| {
        let member = |&n| mechanism_from_str("generated.toml", &make(n)).expect("valid");
        sizes.iter().map(member).collect()
    };
    let several = [1, 2, 3, 4, 5, 6, 7, 8];
    vec![
        (
            "fingers of one slide",
            of(&[1, 2, 4, 8, 12, 20, 40, 80], &fingers),
        ),
        ("four-bars one on another", of(&[1, 2, 4, 8, 16, 32], &row)),
        ("planar ladder", of(&several, &|n| ladder(n, false))),
        ("spatial ladder", of(&several, &|n| ladder(n, true))),
        (
            "planar grid of two rows",
            of(&[2, 3, 4, 5, 6, 7], &|n| grid(2, n, false)),
        ),
        (
            "planar legs of three hinges",
            of(&[2, 3, 4, 5, 6, 7, 8], &|n| parallel_robot(n, 3, false)),
        ),
        (
            "spatial legs of six hinges",
            of(&[2, 3, 4, 5, 6], &|n| parallel_robot(n, 6, true)),
        ),
    ]
}

/// Mechanisms that repeat themselves, are generic, or are met with in machines: names, and their files.
fn named() -> Vec<(String, String)> {
    let mut out = Vec::new();
    let mut of = |name: &str, sizes: &[usize], make: &dyn Fn(usize) -> String| {
        out.extend(sizes.iter().map(|&n| (format!("{name} {n}"), make(n))));
    };
    of("planar ladder", &[6, 8, 10], &|n| ladder(n, false));
    of("spatial ladder", &[3, 4, 5, 6], &|n| ladder(n, true));
    for (space, spatial) in [("planar", false), ("spatial", true)] {
        of(&format!("{space} mesh 2 x"), &[2, 3], &|n| {
            grid(3, n + 1, spatial)
        });
        of(&format!("{space} mesh 3 x"), &[3], &|n| {
            grid(4, n + 1, spatial)
        });
    }
    of("ring of pairs", &[6, 8, 12], &ring);
    of("scissor lift", &[3, 6, 10, 12, 40], &scissor_lift);
    of("walker on legs", &[3, 4, 6], &walker);
    of("hand of fingers", &[5], &|_| hand());
    of("three generic legs of", &[5], &|n| {
        parallel_robot(3, n, true)
    });
    of("fingers", &[10, 20, 40, 80], &fingers);
    out
}

/// Of both diagrams: nodes, milliseconds (the best of three where it is short), and whether they are whole.
fn built(m: &Mechanism) -> (usize, f64, bool) {
    let mut best = f64::INFINITY;
    loop {
        let conditions = Conditions {
            nodes: 200_000,
            memory: 4 << 30,
            ..Conditions::default()
        };
        let start = Instant::now();
        let search = Search::new(exact_field(m, 0).expect("exact"), m, conditions).expect("valid");
        let d = search.build_diagrams(Control::NONE);
        let took = start.elapsed().as_secs_f64() * 1000.0;
        let nodes = d.determinate.nodes + d.admissible.nodes;
        if took > 300.0 || best < f64::INFINITY {
            return (nodes, best.min(took), d.stop_reason() == Stop::Exhausted);
        }
        best = took;
    }
}

fn main() {
    let files = std::env::args().any(|a| a == "--files");
    let mut args = std::env::args().skip(1).filter(|a| !a.starts_with("--"));
    let folder = args
        .next()
        .map_or(PathBuf::from("target/growth"), PathBuf::from);
    std::fs::create_dir_all(&folder).expect("a folder to write to");
    if files {
        for (name, text) in named() {
            std::fs::write(folder.join(format!("{name}.toml")), text).expect("written");
        }
        return;
    }
    let mut table =
        String::from("| family | contours | variants | nodes | time |\n|---|---|---|---|---|\n");
    let mut series = Vec::new();
    for (name, members) in all() {
        let mut points = Vec::new();
        for m in members {
            let contours = contour_basis(&m, StateId::FREE).len();
            let variants: f64 = m
                .joints
                .iter()
                .map(|j| (j.options.len() as f64).log10())
                .sum();
            let (nodes, ms, whole) = built(&m);
            let time = if whole {
                format!("{ms:.1} ms")
            } else {
                "over 200,000 nodes".to_owned()
            };
            let line = format!("| {name} | {contours} | 10^{variants:.0} | {nodes} | {time} |\n");
            print!("{line}");
            table.push_str(&line);
            if !whole {
                break;
            }
            points.push((contours as f64, ms));
        }
        series.push(Series {
            name: name.to_owned(),
            points,
            style: Style::Line,
        });
    }
    let axis = |label: &str| Axis {
        label: label.to_owned(),
        scale: Scale::Log,
    };
    let chart = Chart {
        title: "How searches grow".to_owned(),
        subtitle:
            "Time for both diagrams, four options a joint; each line ends where 200,000 nodes are too few"
                .to_owned(),
        x: axis("independent contours"),
        y: axis("milliseconds"),
        series,
    };
    std::fs::write(folder.join("growth.svg"), chart.svg()).expect("written");
    std::fs::write(folder.join("growth.md"), table).expect("written");
}
