//! Accuracy and speed of every rank method, and where each method's numbers fail.
//!
//! `cargo bench --bench accuracy -- [--quick] [--seed N] [--repeat N] [-o DIR]` prints a table of the methods on the built-in
//! mechanisms and on mechanisms generated from the seed. With `-o DIR`, the studies of stability run as well, and charts,
//! tables and a page are written to a folder. `--quick` takes coarser steps and times each answer once.

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

#[allow(dead_code, reason = "tests name cases")]
#[path = "lab.rs"]
mod lab;

use lab::study::Effort;
use std::path::PathBuf;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Returns the time since the first call.
fn elapsed_time() -> Duration {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGUN.elapsed()
}

fn main() {
    let (mut quick, mut seed, mut repeat, mut folder) = (false, 1, None, None);
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || {
            let next = words.next();
            next.unwrap_or_else(|| panic!("{word} needs a value"))
        };
        match word.as_str() {
            "--quick" => quick = true,
            "--seed" => seed = value().parse().expect("a number"),
            "--repeat" => repeat = Some(value().parse().expect("a number")),
            "-o" => folder = Some(PathBuf::from(value())),
            // What cargo adds.
            "--bench" => {}
            other => panic!("{other}: [--quick] [--seed N] [--repeat N] [-o DIR]"),
        }
    }
    let effort = Effort {
        quick,
        seed,
        clock: elapsed_time,
    };
    let repeat = repeat.unwrap_or(if quick { 1 } else { 5 });
    print!("{}", lab::run::run_all(effort, repeat, folder.as_deref()));
}
