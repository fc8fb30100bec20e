//! Why a variant is not where its cost would put it, by hand; and limits either way.

use super::{TERMS, loaded, ranked, ranking};
use crate::common::*;
use ozols::score::outcome::ranking::RankedPool;

fn pool() -> RankedPool {
    let all = ranking(&TERMS);
    ranked(&loaded(), &all, 400, 400)
}

/// The term that takes most off the cheapest's sum is told; nothing of a variant that is where its cost puts it, of the cheapest
/// itself, and of one that is worse in every term.
#[test]
fn the_reason_is_the_term_that_speaks_most_for_a_variant() {
    let (pool, m) = (pool(), loaded());
    let cheapest = pool.cheapest.as_ref().unwrap();
    let (mut told, mut none) = (0, 0);
    for (i, here) in pool.list.iter().enumerate() {
        let gain =
            |(t, w): (Term, f64)| w * (cheapest.scores.term_loss(t) - here.scores.term_loss(t));
        let gains = TERMS.map(gain);
        let most = gains.into_iter().fold(0.0, f64::max);
        let moved = here.by_cost != i + 1 && here.by_cost != cheapest.by_cost;
        let reason = pool.place_reason(&m, i + 1);
        if !moved || most <= 0.0 {
            assert_eq!(reason, None, "rank {}: {gains:?}", i + 1);
            none += 1;
            continue;
        }
        let best = gains.iter().position(|g| *g == most).unwrap();
        let words = ["peak moment ", "peak force ", "cost "][best];
        let reason = reason.unwrap();
        has(&reason, &format!("by cost: {words}"));
        told += 1;
    }
    assert!(told > 50 && none > 0, "{told} {none}");
}

/// What is second in both orders has not moved, however much better than the first it is.
#[test]
fn what_is_where_its_cost_puts_it_has_no_reason() {
    let (mut pool, m) = (pool(), loaded());
    let at = (1..pool.list.len()).find(|at| pool.place_reason(&m, at + 1).is_some());
    let at = at.unwrap();
    assert_ne!(pool.list[at].by_cost, at + 1);
    pool.list[at].by_cost = at + 1;
    assert_eq!(pool.place_reason(&m, at + 1), None);
}

#[test]
fn limits_are_at_least_and_at_most() {
    let scores = pool().list[0].scores;
    let force = scores.force.utilisation;
    let within = |min: Option<f64>, max: Option<f64>| {
        let mut r = ranking(&TERMS);
        let term = Term::PeakForce;
        r.limits = vec![Limit { term, min, max }];
        scores.within_limits(&r)
    };
    assert!(within(None, None) && within(Some(force), Some(force)));
    assert!(!within(Some(force * 1.01), None) && within(Some(force * 0.99), None));
    assert!(within(None, Some(force * 1.01)) && !within(None, Some(force * 0.99)));
}
