//! Ways of searching: which answers of theirs are right.

use crate::common::*;
use ozols::Mechanism;
use ozols::accuracy::lattice::make_lift;
use ozols::accuracy::timing::Stopwatch;
use ozols::search::check::brute::{Matrices, Seen};
use ozols::search::check::brute_float::Approximate;
use searching::pruned::Pruned;
use searching::record::{Bracket, Record, Share, Trial, Way};
use searching::{TrialEffort, look_in_floats, run_trial};

#[allow(dead_code, reason = "the bench draws charts, which are not tested")]
#[path = "../../benches/ways/searching.rs"]
mod searching;

const EFFORT: TrialEffort = TrialEffort {
    looked: 400,
    pool: Some(2_000),
    patience: f64::INFINITY,
};

/// A trial by a clock that stands still: verdicts do not depend on it.
fn tried(mechanism: &Mechanism, request: &Request, effort: TrialEffort) -> Trial {
    let watch = Stopwatch {
        clock: || Duration::ZERO,
        repeat: 1,
    };
    run_trial(mechanism, request, effort, watch).unwrap()
}

fn trial_of(name: &str) -> Trial {
    let m = built_in(name);
    tried(&m, &Request::default(), EFFORT)
}

fn of(trial: &Trial, way: Way) -> &Record {
    trial.records.iter().find(|r| r.way == way).unwrap()
}

fn is_right(share: Share) -> bool {
    share.right == share.of
}

/// The records of budgets that were too small.
fn stopped(trial: &Trial) -> impl Iterator<Item = &Record> {
    let wide = |r: &&Record| {
        r.bracket
            .is_some_and(|b| Bracket::width_in_decades(b.certain) > 0.0)
    };
    trial.records.iter().filter(wide)
}

const CHECKS: [Check; 3] = [Check::None, Check::Prime, Check::Full];

#[test]
fn exact_ways_are_right_and_cut_ones_are_not() {
    for name in ["four-bar", "3-rrr-planar", "geared-gripper", "gripper-10"] {
        let t = trial_of(name);
        let looking = [Way::Pruned, Way::Brute];
        for way in CHECKS.map(Way::Diagram).into_iter().chain(looking) {
            let r = of(&t, way);
            assert!(is_right(r.variants.unwrap()), "{name}, {way}");
            // Looking at a sample gives no counts and names no best.
            let gives = matches!(way, Way::Diagram(_)) || t.all_looked_at;
            let counts = gives && way != Way::Diagram(Check::Full);
            assert_eq!(
                r.counts.map(is_right),
                counts.then_some(true),
                "{name}, {way}"
            );
            // Without a ranking no best are judged.
            assert_eq!(r.best, None, "{name}, {way}");
            assert_eq!(
                r.naming.is_some(),
                matches!(way, Way::Diagram(_)),
                "{name}, {way}"
            );
            assert_eq!(r.by_proportion, looking.contains(&way) && !t.all_looked_at);
        }
        for r in stopped(&t) {
            assert!(!is_right(r.counts.unwrap()), "{}", r.way);
            assert!(r.variants.is_some(), "{}", r.way);
            let Bracket {
                certain,
                likely,
                holds,
            } = r.bracket.unwrap();
            let truth: f64 = t.admissible.as_ref().unwrap().parse().unwrap();
            assert!(certain[0] <= truth && truth <= certain[1], "{}", r.way);
            assert_eq!(holds, Some(likely[0] <= truth && truth <= likely[1]));
        }
    }
}

/// The whole of gripper-10 is known: [Pogrebnyak 2018] and a brute force run once.
#[test]
fn the_truth_is_what_is_known() {
    let t = trial_of("gripper-10");
    let found = |t: &Trial| {
        [
            t.determinate.clone().unwrap(),
            t.admissible.clone().unwrap(),
        ]
    };
    assert_eq!(found(&t), ["6340592477", "25761436"]);
    assert!(!t.all_looked_at && t.looked_at == 400 && t.ranked_by_pool.is_none());
    let t = trial_of("goldberg-5r");
    let counts = run_json("search goldberg-5r --method brute --format json");
    let known = ["determinate", "admissible"].map(|k| parse_count(&counts[k]).to_string());
    assert_eq!((t.all_looked_at, found(&t)), (true, known));
}

/// Coupled joints, the plane, and contacts with unloading joints: double precision finds what each variant, built as a
/// mechanism of its own, has.
#[test]
fn floating_point_looks_at_the_same_matrices() {
    let clamped = default_with(|r: &mut Request| r.max_external = Some(2));
    for (name, request) in [
        ("geared-gripper", Request::default()),
        ("3-rrr-planar", Request::default()),
        ("gripper-10-unloaded", clamped),
    ] {
        let m = built_in(name);
        let outcome = ozols::search(&m, &request).unwrap();
        let search = &outcome.search;
        let drawn = search.sample_variants(outcome.diagrams.as_ref().unwrap(), 7);
        let drawn: Vec<_> = drawn.take(40).collect();
        for e in [Elimination::Lu, Elimination::Qr, Elimination::Svd] {
            let scaled = e == Elimination::Svd;
            let all = Approximate::new(search, &search.mechanism, scaled).unwrap();
            for c in singular_values::certify_variants(search, drawn.clone(), true, None, &|| false)
            {
                let seen = look_in_floats(&all, e, &c.variant.choices).unwrap();
                let opinion = c.second.opinion().unwrap();
                let by_itself = (i64::from(seen.internal), seen.motion);
                assert_eq!(by_itself, (opinion.redundant, opinion.output.unwrap()));
                let external = opinion.external.unwrap_or(0);
                assert_eq!(i64::from(seen.external), external, "{name}, {e:?}");
            }
        }
    }
}

/// A mechanism with one coordinate a hair off: exact ranks see it, ranks in floating point do not, and the chart must say
/// so.
#[test]
fn floating_point_is_wrong_about_a_hair() {
    let hair = "point = [\"20 + 1e-20\", 40, -20]";
    let text = replace_once(&run_quiet("show bennett"), "point = [20, 40, -20]", hair);
    let off = read(&text);
    let request = default_with(|r: &mut Request| r.as_written = true);
    let t = tried(&off, &request, EFFORT);
    assert!(is_right(
        of(&t, Way::Diagram(Check::None)).variants.unwrap()
    ));
    assert!(is_right(of(&t, Way::Brute).variants.unwrap()));
    for e in Elimination::ALL {
        let r = of(&t, Way::Float(e));
        assert!(!is_right(r.variants.unwrap()), "{e:?}");
        assert!(!is_right(r.counts.unwrap()), "{e:?}");
    }
}

/// A pool is no judge of itself: where no pool is proven to hold the best, nobody is said to be right about them.
#[test]
fn the_best_are_judged_by_a_proven_pool_alone() {
    let t = trial_of("gripper-10-loaded");
    assert_eq!(
        (t.ranked_by_pool, t.ranking_proven),
        (Some(2_000), Some(false))
    );
    assert!(t.records.iter().all(|r| r.best.is_none()));
    // Ranking takes time of its own, and counting none of it.
    let pool = of(&t, Way::Pool(Some(1000)));
    assert!(pool.naming.is_some() && pool.counting.is_none() && pool.counts.is_none());
    let small = trial_of("lever-gripper");
    assert_eq!(
        (small.ranked_by_pool, small.ranking_proven),
        (Some(305), Some(true)),
        "all were scored"
    );
    let shares = [10, 100].map(|n| of(&small, Way::Pool(Some(n))).best.unwrap().right);
    assert!(shares.is_sorted(), "{shares:?}");
    assert_eq!(of(&small, Way::Diagram(Check::Full)).best.unwrap().of, 10);
    // Looking at variants ranks nothing.
    assert!(of(&small, Way::Brute).best.is_none());
}

/// Every determinate variant that is looked at, by brute force over the same prime, which shares no elimination with it: found
/// once each, in any order of the variables.
#[test]
fn what_prunes_loses_nothing() {
    for name in ["four-bar", "geared-gripper", "3-rrr-planar", "two-bennetts"] {
        let m = built_in(name);
        let search = ozols::search(&m, &Request::default()).unwrap().search;
        let all = Matrices::new(&search);
        let radix: Vec<usize> = search
            .space
            .variables
            .iter()
            .map(|v| v.choices.len())
            .collect();
        let few = radix.iter().product::<usize>() <= 5_000;
        let mut order = search.variable_orders().determinate;
        let first = Pruned::new(&search, &order);
        order.reverse();
        for pruned in [first, Pruned::new(&search, &order)] {
            // Of a large space what begins with the last choices.
            let begun = if few { 0 } else { order.len() - 6 };
            let beginning: Vec<usize> = pruned.order[..begun]
                .iter()
                .map(|&v| radix[v] - 1)
                .collect();
            // Pruning asks about the drawn pose alone.
            let look = |choices: &[usize]| Seen {
                lasts: None,
                ..all.look_at(choices)
            };
            let mut found = Vec::new();
            pruned.visit_determinate(&beginning, &mut |choices, seen| {
                assert_eq!(seen, look(choices), "{name}: {choices:?}");
                found.push(choices.to_vec());
            });
            found.sort();
            let mut truth = Vec::new();
            let rest = &pruned.order[begun..];
            for last in rest.iter().map(|&v| 0..radix[v]).multi_cartesian_product() {
                let mut choices: Vec<usize> = radix.iter().map(|n| n - 1).collect();
                rest.iter().zip(last).for_each(|(&v, c)| choices[v] = c);
                let seen = look(&choices);
                let determinate = seen.internal == 0;
                assert_eq!(pruned.look_at(&choices), determinate.then_some(seen));
                if determinate {
                    truth.push(choices);
                }
            }
            truth.sort();
            assert_eq!(found, truth, "{name}");
            assert!(!few || !truth.is_empty(), "{name}");
        }
    }
}

/// A mechanism that is too large for the whole diagram is searched with budgets alone.
#[test]
fn large_mechanisms_are_counted_with_budgets_alone() {
    let effort = TrialEffort {
        looked: 0,
        patience: -1.0,
        ..EFFORT
    };
    let t = tried(&make_lift(12), &Request::default(), effort);
    assert_eq!((t.looked_at, t.records.len()), (0, 1));
    assert!(t.records[0].variants.is_none() && stopped(&t).count() == 1);
    assert!(t.determinate.is_none() && t.space.len() > 20, "{}", t.space);
}

#[test]
fn conditions_are_those_of_a_search() {
    let m = built_in("four-bar");
    let request =
        default_with(|r: &mut Request| (r.max_mobility, r.max_changes) = (Some(1), Some(3)));
    let counted = ozols::search(&m, &request).unwrap().admissible.to_string();
    assert_eq!(tried(&m, &request, EFFORT).admissible, Some(counted));
    let request = default_with(|r: &mut Request| r.list = List::Top(3));
    let top = tried(&built_in("lever-gripper"), &request, EFFORT);
    assert_eq!(of(&top, Way::Pool(Some(1000))).best.unwrap().of, 3);
}
