//! Ways of searching compared: how right and how fast each is.
//!
//! `cargo bench --bench ways -- [--quick] [--looked N] [--repeat N] [--request JSON] [-o DIR] [FILE]...` prints a row for each
//! mechanism and way as CSV. FILE is a mechanism file or the name of a built-in mechanism; by default these are six built-in
//! ones and, with budgets of nodes alone, a planar ladder of ten contours, a spatial one of six, and a scissor lift of 40
//! stages. `--request '{"max_mobility": 1}'` gives the conditions of the searches. With `-o DIR`, the table, charts and a page
//! are written to a folder.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_precision_loss,
    clippy::expect_used,
    clippy::panic,
    clippy::print_stdout,
    missing_docs,
    reason = "a bench reports what it measures"
)]

#[path = "searching.rs"]
mod searching;

use ozols::accuracy::change::Noise;
use ozols::accuracy::lattice::{Scene, make_ladder, make_lift};
use ozols::accuracy::study::page_files;
use ozols::accuracy::timing::Stopwatch;
use ozols::{Mechanism, Request};
use searching::{MECHANISMS, TrialEffort, pictures, record, run_trial};
use std::path::PathBuf;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Advice for each chart: which way of searching to use.
const ADVICE: [&str; 3] = [
    "If the diagram fits into the budget of nodes, take it whole: its counts are exact, and a second prime proves them.",
    "If it does not, a search that is stopped gives certain bounds and an interval of 95 %: ten times the nodes narrow them.",
    "For a ranking leave the pool to its default: the cheapest 20,000 are scored, and then all that could still win.",
];

/// Returns the time since the first call.
fn elapsed_time() -> Duration {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGUN.elapsed()
}

fn main() {
    let (mut quick, mut looked, mut repeat, mut folder) = (false, None, None, None);
    let (mut request, mut files) = (Request::default(), Vec::new());
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || {
            let next = words.next();
            next.unwrap_or_else(|| panic!("{word} needs a value"))
        };
        match word.as_str() {
            "--quick" => quick = true,
            "--looked" => looked = Some(value().parse().expect("a number")),
            "--repeat" => repeat = Some(value().parse().expect("a number")),
            "--request" => request = serde_json::from_str(&value()).expect("a request"),
            "-o" => folder = Some(PathBuf::from(value())),
            // What cargo adds.
            "--bench" => {}
            _ => files.push(word),
        }
    }
    let effort = TrialEffort {
        looked: looked.unwrap_or(if quick { 1_000 } else { 20_000 }),
        pool: request.pool.or(quick.then_some(2_000)),
        patience: if quick { 1.0 } else { 10.0 },
    };
    let watch = Stopwatch {
        clock: elapsed_time,
        repeat: repeat.unwrap_or(if quick { 1 } else { 15 }),
    };
    let read = |name: &str| match ozols::built_in(name) {
        Ok(built_in) => built_in,
        Err(_) => ozols::open(name).expect("a mechanism"),
    };
    let mut runs: Vec<(Mechanism, TrialEffort)> = Vec::new();
    if files.is_empty() {
        runs.extend(MECHANISMS.map(|name| (read(name), effort)));
        let noise = || Noise::new(1, 0);
        let hard = [
            make_ladder(Scene::Plane, 10, &mut noise()),
            make_ladder(Scene::Space, 6, &mut noise()),
            make_lift(40),
        ];
        let counted = TrialEffort {
            looked: 0,
            ..effort
        };
        runs.extend(hard.map(|m| (m, counted)));
    }
    runs.extend(files.iter().map(|file| (read(file), effort)));
    let trials: Vec<_> = runs
        .iter()
        .map(|(m, effort)| run_trial(m, &request, *effort, watch).expect("it is searched"))
        .collect();
    let table = record::trials_csv(&trials);
    print!("{table}");
    if let Some(folder) = folder {
        std::fs::create_dir_all(&folder).expect("the folder");
        let studies = pictures::make_studies(&trials, ADVICE);
        let title = "Ways of searching: accuracy against speed";
        let tables = vec![("searches.csv".to_owned(), table)];
        for (name, text) in page_files(title, "Made by cargo bench --bench ways.", &studies, tables)
        {
            std::fs::write(folder.join(name), text).expect("the file");
        }
    }
}
