//! Ranking of variants under a workload.

use crate::common::*;
mod command;
mod floor;
mod geared;
mod proof;
mod reasons;

use ozols::model::ranking::Ranking;
use ozols::score::joint_types::JointTypes;
use ozols::score::outcome::ranking::{RankedPool, Ranker, compare_ranked};

fn loaded() -> Mechanism {
    built_in("gripper-10-loaded")
}

fn search(m: &Mechanism, redundant: u32) -> Search {
    let request = default_with(|c: &mut Conditions| c.max_redundant = redundant);
    Search::new(exact_field(m, 0).unwrap(), m, request).unwrap()
}

fn cheapest(s: &Search, n: usize) -> Vec<Assignment> {
    let d = s.build_diagrams(Control::NONE);
    let out: Vec<_> = s.cheapest_variants(&d, n).collect();
    out
}

fn sampled(s: &Search, n: usize) -> Vec<Assignment> {
    let diagrams = s.build_diagrams(Control::NONE);
    s.sample_variants(&diagrams, 7).take(n).collect()
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs()).max(1e-12)
}

fn both_ways(m: &Mechanism, redundant: u32, clearance: ClearanceSum, n: usize) -> (usize, usize) {
    let s = search(m, redundant);
    let e = Evaluator::new(&s, clearance).unwrap();
    let mut scratch = Scratch::default();
    let mut variants = cheapest(&s, n / 2);
    variants.extend(sampled(&s, n / 2));
    let (mut solved, mut refused) = (0, 0);
    for v in &variants {
        match (e.score_variant(v, &mut scratch), e.reference_scores(v)) {
            (Ok(fast), Ok(slow)) => {
                solved += 1;
                for t in Term::ALL {
                    // Small singular values are good to eight digits of the greatest.
                    let tolerance = 1e-8 / slow.conditioning.clamp(1e-7, 1.0);
                    assert!(
                        near(fast.term_value(t), slow.term_value(t), tolerance),
                        "{} {:?}: {fast:?} {slow:?}",
                        t.name(),
                        v.choices
                    );
                }
                assert!(near(fast.force.value, slow.force.value, 1e-6));
            }
            (Err(_), Err(_)) => refused += 1,
            (fast, slow) => panic!("{:?}: {fast:?} {slow:?}", v.choices),
        }
    }
    (solved, refused)
}

/// Nothing is shared but the options' frames: the fast way precomputes and eliminates, the slow way builds the variant as a
/// mechanism and takes singular values.
#[test]
fn the_fast_scores_are_those_of_the_variant_built_and_solved() {
    let m = loaded();
    let (solved, refused) = both_ways(&m, 0, ClearanceSum::Worst, 120);
    assert!(solved > 50, "{solved} {refused}");
    both_ways(&m, 0, ClearanceSum::Rms, 20);
    // With redundant constraints left.
    both_ways(&m, 3, ClearanceSum::Worst, 20);
}

#[test]
fn over_a_stroke_the_scores_are_the_worst_of_its_poses() {
    let mut m = loaded();
    m.edit().loads.stroke = Some(ozols::model::loads::Stroke {
        from: -0.3,
        to: 0.3,
        steps: 2,
    });
    let s = search(&m, 0);
    let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
    assert_eq!(e.cases.list.len(), 3);
    assert!(e.cases.stopped.is_none());
    let still = loaded();
    let t = search(&still, 0);
    let at_rest = Evaluator::new(&t, ClearanceSum::Worst).unwrap();
    let mut scratch = Scratch::default();
    let mut compared = 0;
    for v in cheapest(&s, 20) {
        let (Ok(fast), Ok(slow)) = (e.score_variant(&v, &mut scratch), e.reference_scores(&v))
        else {
            continue;
        };
        compared += 1;
        let one = at_rest.score_variant(&v, &mut scratch).unwrap();
        assert!(fast.force.utilisation >= one.force.utilisation * (1.0 - 1e-9));
        assert!(fast.conditioning <= one.conditioning * (1.0 + 1e-9));
        for t in Term::ALL {
            assert!(
                near(fast.term_value(t), slow.term_value(t), 1e-6),
                "{}: {fast:?} {slow:?}",
                t.name()
            );
        }
    }
    assert!(compared > 5);
}

fn ranking(terms: &[(Term, f64)]) -> Ranking {
    default_with(|r: &mut Ranking| r.terms = terms.to_vec())
}

const TERMS: [(Term, f64); 3] = [
    (Term::PeakMoment, 10.0),
    (Term::PeakForce, 3.0),
    (Term::Cost, 0.5),
];

fn ranked(m: &Mechanism, r: &Ranking, n: usize, top: usize) -> RankedPool {
    let s = search(m, 0);
    let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
    let mut ranker = Ranker::new(&e, r, n, top);
    for v in cheapest(&s, n) {
        if ranker.take_variant(v).is_break() {
            break;
        }
    }
    ranker.finish_pool(false)
}

#[test]
fn the_order_is_that_of_the_sums() {
    let m = loaded();
    let n = 400;
    let weight = ranked(&m, &ranking(&TERMS), n, n);
    assert_eq!(weight.scored, n);
    for pair in weight.list.windows(2) {
        assert!(pair[0].total <= pair[1].total);
        assert_eq!(pair[0].total, pair[0].scores.weighted_sum(&weight.ranking));
        assert!(compare_ranked(&pair[0], &pair[1]).is_lt());
    }
    // By cost alone, the order is that of cost, and proven as soon as a dearer one follows.
    let cost = ranked(&m, &ranking(&[(Term::Cost, 1.0)]), n, 5);
    let places: Vec<usize> = cost.list.iter().map(|r| r.by_cost).collect();
    assert!(places.is_sorted());
    assert!((1..=5).all(|i| cost.place_reason(&m, i).is_none()));
}

/// With the least that force and error can be, a pool is proven that cost alone does not prove; ten times as many variants
/// change nothing.
#[test]
fn the_floor_proves_what_cost_alone_does_not() {
    let m = loaded();
    let terms = [
        (Term::PeakForce, 10.0),
        (Term::OutputError, 10.0),
        (Term::Cost, 1.0),
    ];
    let r = ranking(&terms);
    let small = ranked(&m, &r, 5000, 10);
    assert!(small.proven && small.scored < 5000, "{}", small.scored);
    let last = small.list.last().unwrap().total;
    let s = search(&m, 0);
    let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
    let mut scratch = Scratch::default();
    let variants = cheapest(&s, 40_000);
    let dearest = variants.last().unwrap();
    #[allow(clippy::cast_precision_loss, reason = "costs are small")]
    let cost = s.steps.cost_in_milli(dearest.key.cost()) as f64 / 1000.0;
    assert!(cost < last, "cost alone would do: {cost} {last}");
    for v in &variants[small.scored..] {
        if let Ok(scores) = e.score_variant(v, &mut scratch) {
            assert!(scores.weighted_sum(&r) >= last);
        }
    }
}

/// Asserts that no variant is better in any term than the bounds say, and that the bounds say something.
fn assert_above_floor(m: &Mechanism, redundant: u32, clearance: ClearanceSum, n: usize) {
    let s = search(m, redundant);
    let e = Evaluator::new(&s, clearance).unwrap();
    let floor = e.least_terms();
    assert!(floor.force > 0.0 && floor.output_error > 0.0, "{floor:?}");
    let mut scratch = Scratch::default();
    let mut tried = 0;
    for v in [cheapest(&s, n), sampled(&s, n)].concat() {
        let Ok(scores) = e.score_variant(&v, &mut scratch) else {
            continue;
        };
        tried += 1;
        assert!(
            floor.force <= scores.force.utilisation,
            "{floor:?} {scores:?}"
        );
        assert!(
            floor.moment <= scores.moment.utilisation,
            "{floor:?} {scores:?}"
        );
        assert!(
            floor.output_error <= scores.output_error,
            "{floor:?} {scores:?}"
        );
    }
    assert!(tried > 40, "{tried}");
}

#[test]
fn no_variant_is_below_the_floor() {
    assert_above_floor(&loaded(), 0, ClearanceSum::Worst, 2000);
    assert_above_floor(&loaded(), 0, ClearanceSum::Rms, 2000);
    assert_above_floor(&loaded(), 3, ClearanceSum::Worst, 60);
}

#[test]
fn limits_filter() {
    let m = loaded();
    let free = ranked(&m, &ranking(&TERMS), 300, 300);
    let mut forces: Vec<f64> = free
        .list
        .iter()
        .map(|r| r.scores.force.utilisation)
        .collect();
    forces.sort_by(f64::total_cmp);
    let middle = forces[forces.len() / 2];
    let mut r = ranking(&TERMS);
    r.limits = vec![Limit {
        term: Term::PeakForce,
        min: None,
        max: Some(middle),
    }];
    let kept = ranked(&m, &r, 300, 300);
    assert!(kept.limited > 0 && !kept.list.is_empty());
    assert_eq!(kept.list.len() + kept.limited, free.list.len());
    assert!(
        kept.list
            .iter()
            .all(|x| x.scores.force.utilisation <= middle)
    );
}

#[test]
fn the_catalogue_of_joint_types_is_whole() {
    let types = JointTypes::built_in();
    for t in JointType::NAMED {
        let found = types
            .get(t.name())
            .unwrap_or_else(|| panic!("{}", t.name()));
        assert!(found.capacity_force > 0.0 && found.clearance >= 0.0);
        assert!(found.capacity_moment.is_none_or(|m| m > 0.0));
    }
    assert!(types.get("custom").is_some());
}

/// A pool of a thousand makes another variant the first of gripper-10-loaded than one of twenty thousand does: what is missing to
/// a proof is said.
#[test]
fn a_pool_says_how_far_it_is_from_proven() {
    let m = loaded();
    let asked = |pool| {
        default_with(|r: &mut Request| {
            (r.pool, r.list) = (Some(pool), ozols::score::request::List::Top(1))
        })
    };
    let first = |request: &Request| {
        let found = ozols::search(&m, request).unwrap();
        let ranking = found.ranking.unwrap();
        let best = ranking.list[0].clone();
        (best, ranking)
    };
    let (narrow, _) = first(&asked(1000));
    let (best, ranking) = first(&asked(20_000));
    // Places among variants of one cost are the diagram's; which places they are does not matter.
    assert!(
        narrow.by_cost <= 1000 && best.by_cost > 1000,
        "{}",
        best.by_cost
    );
    assert!(best.total < narrow.total);
    // What is missing: nothing elsewhere is below the least sum, and nothing from the stated cost on can come before.
    assert!(!ranking.proven);
    let missing = ranking.missing.unwrap();
    assert_eq!(missing.last, best.total);
    assert!(missing.least < missing.last, "{missing:?}");
    let cheaper: u64 = missing.cheaper.as_ref().unwrap().try_into().unwrap();
    assert!(cheaper > 20_000 && cheaper < 6_352_317_325, "{cheaper}");
    // Where cost weighs enough the list is proven, and nothing is missing.
    let mut heavy = asked(20_000);
    heavy.rank = vec![(Term::PeakMoment, 10.0), (Term::Cost, 50.0)];
    let (_, ranking) = first(&heavy);
    assert!(ranking.proven && ranking.missing.is_none() && ranking.scored < 20_000);
}
