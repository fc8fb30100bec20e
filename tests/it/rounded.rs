//! Coordinates that were turned and rounded: right or undecided, never wrong and sure.

mod cases;
mod program;

use cases::{Case, cases};
use ozols::accuracy::stability::change::{Noise, turned_and_rounded};
use ozols::rank::auto::decide;
use ozols::rank::verdict::{Verdict, verdict};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

const DECIMALS: RangeInclusive<usize> = 4..=16;
const TURNS: u64 = 3;

/// What a verdict is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Worth {
    Right,
    Undecided,
    Wrong,
}

fn worth(found: &Verdict, case: &Case) -> Worth {
    if !found.is_decided() {
        return Worth::Undecided;
    }
    let (w, _) = found.figures(found.rank());
    if i64::try_from(w).unwrap() == case.mobility {
        Worth::Right
    } else {
        Worth::Wrong
    }
}

/// Cases turned and rounded: so many of each worth for each number of decimals, and those that are wrong.
fn table(
    part: impl Fn(usize) -> bool + Sync,
) -> (BTreeMap<usize, BTreeMap<Worth, usize>>, Vec<String>) {
    let cases = cases();
    let all: Vec<(usize, usize, u64)> = DECIMALS
        .flat_map(|d| (0..cases.len()).flat_map(move |c| (0..TURNS).map(move |t| (d, c, t))))
        .enumerate()
        .filter(|(n, _)| part(*n))
        .map(|(_, x)| x)
        .collect();
    let found: Vec<(usize, Worth, String)> = all
        .into_par_iter()
        .map(|(decimals, c, seed)| {
            let case = &cases[c];
            let m = turned_and_rounded(&case.mechanism, decimals, &mut Noise::new(seed, c));
            let found = verdict(&m, case.state, None).unwrap();
            let worth = worth(&found, case);
            let line = format!(
                "{} at {decimals} decimals, turn {seed}: W = {} for {}, {} ({:?})",
                case.name,
                found.figures(found.rank()).0,
                case.mobility,
                found.word(),
                found.numeric
            );
            (decimals, worth, line)
        })
        .collect();
    let (mut table, mut wrong) = (BTreeMap::<usize, BTreeMap<Worth, usize>>::new(), Vec::new());
    for (decimals, worth, line) in found {
        *table.entry(decimals).or_default().entry(worth).or_default() += 1;
        if worth == Worth::Wrong || std::env::var("OZOLS_TELL").is_ok_and(|t| line.contains(&t)) {
            wrong.push(line);
        }
    }
    (table, wrong)
}

fn print(table: &BTreeMap<usize, BTreeMap<Worth, usize>>) {
    for (decimals, of) in table {
        let n = |w| of.get(&w).copied().unwrap_or(0);
        let (right, undecided, wrong) = (n(Worth::Right), n(Worth::Undecided), n(Worth::Wrong));
        println!("| {decimals} | {right} | {undecided} | {wrong} |");
    }
}

#[test]
#[ignore = "the whole table: cargo test --test integration rounded::whole -- --ignored --nocapture"]
fn whole_table() {
    let (table, wrong) = table(|_| true);
    print(&table);
    for w in &wrong {
        println!("{w}");
    }
    assert!(wrong.is_empty());
}

#[test]
fn no_verdict_on_rounded_coordinates_is_wrong_and_sure() {
    let (table, wrong) = table(|n| n % 20 == 7);
    print(&table);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
#[ignore = "dbg"]
fn finite_too() {
    let cases = cases();
    let bad: Vec<String> = cases
        .par_iter()
        .enumerate()
        .flat_map(|(c, case)| {
            let mut out = Vec::new();
            for decimals in [4, 6, 8, 12] {
                let m = turned_and_rounded(&case.mechanism, decimals, &mut Noise::new(1, c));
                let found = decide(&m, case.state, None).unwrap();
                if !found.finite.could_be(case.finite) {
                    out.push(format!(
                        "{} {decimals}: {} for {}: {}",
                        case.name,
                        found.finite.figure(),
                        case.finite,
                        found.line
                    ));
                }
            }
            out
        })
        .collect();
    assert!(bad.is_empty(), "{bad:#?}");
}
