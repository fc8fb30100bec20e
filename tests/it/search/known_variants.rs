//! Whether one mechanism has the variants of another, followed through the diagram of the one, against both diagrams variant by variant.

use crate::common::*;
use crate::search::beyond_budget::{ladder, search};
use std::fmt::Write;

/// A mechanism's hinges at whole places from 0 to below a limit: some of them on one line, some at one place.
fn crowded(text: &str, below: i64) -> String {
    text.lines().fold(String::new(), |mut out, line| {
        match line.strip_prefix("point = [") {
            Some(place) => {
                let numbers = place.trim_end_matches(']').split(", ");
                let numbers = numbers.map(|n| n.parse::<i64>().unwrap() % below);
                writeln!(out, "point = {:?}", numbers.collect_vec()).unwrap();
            }
            None => writeln!(out, "{line}").unwrap(),
        }
        out
    })
}

/// All choices for so many joints of four options each.
fn choices(joints: u32) -> impl Iterator<Item = Vec<usize>> {
    (0..4usize.pow(joints)).map(move |n| (0..joints).map(|j| n >> (2 * j) & 3).collect())
}

#[test]
fn what_is_followed_from_known_variants_is_what_both_diagrams_have() {
    let first = fresh_seed();
    let mut told = [0; 2];
    for (contours, spatial, runs) in [(1, false, 20), (2, false, 30), (3, false, 6), (2, true, 8)] {
        let joints = 1 + 3 * contours;
        for seed in (first..).take(runs) {
            let text = ladder(contours as usize, seed, spatial);
            let (general, known) = search(&text, Conditions::default());
            let minimal = general.minimal_variants(&known).unwrap();
            let other = ladder(contours as usize, seed + 1, spatial);
            let places = [&text, &other, &crowded(&other, 3), &crowded(&other, 8)];
            for text in places {
                let (own, found) = search(text, Conditions::default());
                let mut all = choices(joints);
                let has = |c: &Vec<usize>| found.determinate.end_of(c).is_some();
                let expected = all.all(|c| minimal.end_of(&c).is_none() || has(&c));
                let has = own.has_all(&minimal);
                assert_eq!(has, expected, "seed {seed}: {text}");
                told[usize::from(has)] += 1;
            }
        }
    }
    assert!(told.iter().all(|&n| n > 20), "{told:?}");
}
