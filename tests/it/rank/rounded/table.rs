//! Every mechanism of known mobility, turned three times at random and rounded to 4 to 16 decimals.

use super::cases::{Case, cases};
use crate::common::*;
use crate::documents::figures::{between, says};
use ozols::rank::rounded::verdict::rank_verdict;
use rayon::prelude::*;

/// What an answer is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Worth {
    Right,
    Undecided,
    Wrong,
}

impl Worth {
    /// Of a range that the truth must be in.
    fn of(range: (usize, usize), truth: i64) -> Worth {
        let (from, to) = (
            i64::try_from(range.0).unwrap(),
            i64::try_from(range.1).unwrap(),
        );
        match (from <= truth && truth <= to, from == to) {
            (false, _) => Worth::Wrong,
            (true, true) => Worth::Right,
            (true, false) => Worth::Undecided,
        }
    }
}

const GUIDE: &str = "src/guide/mobility.md";

/// The turns that the tables of the guide are of.
const OF_THE_GUIDE: u64 = 100;

/// What is said of the cases turned and rounded, one of every `part` of them unless all are asked for: how often it is worth
/// what, by decimals, and what is wrong.
#[allow(clippy::print_stdout, reason = "the table is what it is run for")]
fn judged(
    what: &str,
    part: usize,
    say: impl Fn(&Mechanism, &Case) -> (Worth, String) + Sync,
) -> BTreeMap<usize, BTreeMap<Worth, usize>> {
    // Turns never looked at before: any other number in place of `all`.
    let (part, first) = match std::env::var("OZOLS_ROUNDED") {
        Ok(turn) => (1, turn.parse().unwrap_or(0)),
        Err(_) => (part, 0),
    };
    let cases = cases();
    let of =
        |d| (0..cases.len()).flat_map(move |c| (first..first + 3).map(move |turn| (d, c, turn)));
    let all: Vec<(usize, usize, u64)> =
        (4..=16).flat_map(of).skip(part / 2).step_by(part).collect();
    let found: Vec<(usize, Worth, String)> = all
        .into_par_iter()
        .map(|(decimals, c, turn)| {
            let case = &cases[c];
            let m = turned_and_rounded(&case.mechanism, decimals, &mut Noise::new(turn, c));
            let (worth, what) = say(&m, case);
            let line = format!("{} at {decimals} decimals, turn {turn}: {what}", case.name);
            (decimals, worth, line)
        })
        .collect();
    let mut table = BTreeMap::<usize, BTreeMap<Worth, usize>>::new();
    for (decimals, worth, line) in &found {
        *table
            .entry(*decimals)
            .or_default()
            .entry(*worth)
            .or_default() += 1;
        if *worth != Worth::Right {
            println!("{worth:?}: {line}");
        }
    }
    println!("| decimals | right | undecided | wrong and sure |");
    let row = |(decimals, of): (&usize, &BTreeMap<Worth, usize>)| {
        let n = |w| of.get(&w).copied().unwrap_or(0);
        let (right, open, wrong) = (n(Worth::Right), n(Worth::Undecided), n(Worth::Wrong));
        format!("| {decimals} | {right} | {open} | {wrong} |")
    };
    let rows: Vec<String> = table.iter().map(row).collect();
    rows.iter().for_each(|row| println!("{row}"));
    says(GUIDE, &format!("For {} cases each", 3 * cases.len()));
    let stated = between(GUIDE, &format!("rounded: {what}"));
    let stated = stated
        .lines()
        .filter(|l| l.starts_with("| ") && !l.contains("decimals"));
    for row in stated.filter(|_| first == OF_THE_GUIDE) {
        assert!(
            rows.iter().any(|r| r == row),
            "{GUIDE} has {row}: {rows:#?}"
        );
    }
    let wrong: Vec<&String> = found
        .iter()
        .filter(|f| f.1 == Worth::Wrong)
        .map(|f| &f.2)
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    table
}

#[test]
fn no_verdict_on_rounded_coordinates_is_wrong_and_sure() {
    let table = judged("W", 41, |m, case| {
        let v = rank_verdict(m, case.state).unwrap();
        let [w, most] = [v.rank(), v.at_least()].map(|rank| v.figures_at(rank).0);
        // Undecided is no answer, even where its range leaves the truth out.
        let worth = if v.is_decided() {
            Worth::of((w, most), case.mobility)
        } else {
            Worth::Undecided
        };
        let what = format!(
            "W = {w} to {most} for {}, {}: {:?}",
            case.mobility,
            v.as_word(),
            v.numeric
        );
        (worth, what)
    });
    let of_six = &table[&6];
    let right = of_six.get(&Worth::Right).copied().unwrap_or(0);
    assert!(
        right * 20 >= of_six.values().sum::<usize>() * 19,
        "{of_six:?}"
    );
}

#[test]
fn no_finite_mobility_of_rounded_coordinates_is_wrong_and_sure() {
    judged("finite mobility", 61, |m, case| {
        let found = decide_state(m, case.state).unwrap();
        let finite = found.finite;
        let what = format!(
            "finite {} for {}: {}",
            finite.format_figure(),
            case.finite,
            found.line
        );
        let undecided = !found.verdict.is_decided();
        let worth = if undecided {
            Worth::Undecided
        } else {
            Worth::of((finite.mobility, finite.at_most()), case.finite)
        };
        (worth, what)
    });
}
