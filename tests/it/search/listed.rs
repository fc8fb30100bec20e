//! Lists of searches that end early or do not count: what is proven of them, and how long they are.

use super::beyond_budget::ladder;
use crate::common::*;

/// A variant is proven to be among the cheapest where its cost is one up to which all are known, and that is so of the last such cost.
#[test]
fn as_many_are_proven_as_cost_no_more_than_what_is_known() {
    let mut at_the_limit = 0;
    for (contours, nodes) in [(4, 60), (4, 120), (5, 80), (5, 200), (5, 500), (6, 1000)] {
        let m = read(&ladder(contours, 3, false));
        let request = Request {
            nodes,
            list: List::Top(60),
            check: Check::None,
            ..Request::default()
        };
        let outcome = ozols::search(&m, &request).unwrap();
        if outcome.is_exact() {
            continue;
        }
        let known = outcome.known_up_to();
        let mut list = outcome.variants();
        let costs: Vec<i64> = list.by_ref().map(|v| v.cost_milli()).collect();
        let proven = costs.iter().filter(|c| known.is_some_and(|k| **c <= k));
        assert_eq!(list.summary().proven, Some(proven.count()));
        at_the_limit += costs.iter().filter(|c| Some(**c) == known).count();
    }
    assert!(at_the_limit > 0);
}

/// Of a variant and its image one is listed, and still as many as were asked for, whether all are counted or not.
#[test]
fn lists_of_orbits_are_as_long_as_they_are_asked_to_be() {
    let m = built_in("gripper-10");
    let costs = |counted: bool, nodes: usize| -> Vec<i64> {
        let request = Request {
            counted,
            nodes,
            symmetry: Symmetry::OnePerOrbit,
            list: List::Top(30),
            check: Check::None,
            ..Request::default()
        };
        let outcome = ozols::search(&m, &request).unwrap();
        outcome.variants().map(|v| v.cost_milli()).collect()
    };
    let all = costs(true, 50_000_000);
    assert_eq!(all.len(), 30);
    assert_eq!(costs(false, 50_000_000), all);
}

/// Where the budget holds the cheapest alone, as many variants are looked for as make up the orbits that are asked for. The cheapest
/// cost has 180 orbits, and more variants than 190.
#[test]
fn as_many_orbits_are_proven_as_are_asked_for() {
    let search = |more: &[&str]| {
        let asked = "search gripper-10 --options revolute,spherical,cylindrical --one-per-orbit --no-distinct --top 190 --format json";
        let words: Vec<&str> = asked.split(' ').chain(more.iter().copied()).collect();
        run_json(&words)
    };
    let costs = |found: &Value| -> Vec<Value> {
        let all = found["variants"].list();
        all.iter().map(|v| v["cost"].clone()).collect()
    };
    let (whole, bounded) = (search(&[]), search(&["--no-count", "--nodes", "80"]));
    assert_eq!(bounded["variants_proven"], 190);
    assert_eq!(costs(&bounded), costs(&whole));
}
