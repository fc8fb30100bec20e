//! Whether what a ranking calls proven is: all variants scored, and put in order.

use super::loaded;
use crate::common::*;
use chacha20::ChaCha20Rng;
use ozols::model::ranking::Ranking;
use ozols::score::evaluation::terms::Scores;
use std::collections::HashMap;

const TOP: usize = 12;

/// A weight from 0 to 30, often 0.
fn weight(rng: &mut ChaCha20Rng) -> f64 {
    let drawn = rng.next_u32();
    if drawn.is_multiple_of(3) {
        0.0
    } else {
        f64::from(drawn % 10_000) / 333.0
    }
}

fn request() -> Request {
    let options = ["revolute", "spherical", "cylindrical", "sphere-in-cylinder"];
    Request {
        options: options.map(str::to_owned).to_vec(),
        list: List::Top(TOP),
        check: Check::None,
        ..Request::default()
    }
}

/// The best of all variants, by their sums and then by their places in the order of cost: every variant scored.
fn best(scores: &[Option<Scores>], ranking: &Ranking) -> Vec<(usize, f64)> {
    let loss = |s: &Scores| -> f64 {
        let terms = ranking.terms.iter();
        terms.map(|(t, w)| w * s.term_loss(*t)).sum()
    };
    let held = |s: &Scores| {
        let mut limits = ranking.limits.iter();
        limits.all(|l| l.min.is_none_or(|min| s.term_value(l.term) >= min))
    };
    let some = scores.iter().enumerate();
    let some = some.filter_map(|(at, s)| s.as_ref().filter(|s| held(s)).map(|s| (at + 1, loss(s))));
    let mut all: Vec<(usize, f64)> = some.collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    all.truncate(TOP);
    all
}

/// The scores of all admissible variants, in order of cost.
fn every(m: &Mechanism) -> Vec<Option<Scores>> {
    let outcome = ozols::search(
        m,
        &Request {
            rank: vec![(Term::Cost, 1.0)],
            ..request()
        },
    )
    .unwrap();
    let evaluator = Evaluator::new(&outcome.search, ClearanceSum::Worst).unwrap();
    let all: Vec<_> = outcome
        .search
        .cheapest_variants(outcome.diagrams.as_ref().unwrap(), usize::MAX)
        .collect();
    assert_eq!(outcome.admissible.total, all.len().into());
    let mut scratch = Scratch::default();
    let scored = all
        .iter()
        .map(|v| evaluator.score_variant(v, &mut scratch).ok());
    scored.collect()
}

fn ranked(m: &Mechanism, ranking: &Ranking, threads: usize) -> Outcome {
    let mut m = m.clone();
    m.edit().ranking = Some(ranking.clone());
    let pool = rayon::ThreadPoolBuilder::new();
    let pool = pool.num_threads(threads).build().unwrap();
    pool.install(|| ozols::search(&m, &request()).unwrap())
}

/// Variants are forgotten here but for their places and sums. Weights are drawn afresh, so that now the cheap ones win and now the
/// dear ones that no pool has.
#[test]
fn what_is_proven_is_the_best_of_all_scored() {
    let mut seed = [0; 32];
    getrandom::fill(&mut seed).unwrap();
    let mut rng = ChaCha20Rng::from_seed(seed);
    let m = loaded();
    let scores = every(&m);
    assert!(scores.len() > 50_000);
    let (mut proven, mut outside) = (0, 0);
    for round in 0..6 {
        let terms = [
            (Term::PeakForce, weight(&mut rng)),
            (Term::PeakMoment, weight(&mut rng)),
            (Term::OutputError, weight(&mut rng)),
            (Term::Changes, weight(&mut rng) / 50.0),
            (Term::Cost, weight(&mut rng) / 50.0),
            (Term::Conditioning, if round % 2 == 0 { 0.0 } else { 1.0 }),
        ];
        let limit = Limit {
            term: Term::Conditioning,
            min: Some(0.02),
            max: None,
        };
        let ranking = Ranking {
            terms: terms.to_vec(),
            limits: [limit].into_iter().take(round % 3).collect(),
            ..Ranking::default()
        };
        let said = format!("{terms:?}, seed {seed:?}");
        let found = ranked(&m, &ranking, 1 + round % 2);
        let found = found.ranking.unwrap();
        assert!(!found.interrupted);
        let list = found.list.iter().map(|r| (r.by_cost, r.total));
        let list: Vec<(usize, f64)> = list.collect();
        if found.proven {
            proven += 1;
            outside += usize::from(list.iter().any(|(at, _)| *at > found.scored));
            let twin = best(&scores, &ranking);
            assert_eq!(list, twin, "{said}");
        }
    }
    assert!(
        proven >= 4,
        "{proven} of 6 proven, {outside} with others than the pool's, seed {seed:?}"
    );
}

/// Where cost does not count and links weigh nothing, what bears best is dear: bounds on reactions alone must lead to it.
#[test]
fn dear_variants_that_bear_best_are_found() {
    let mut m = loaded();
    m.edit().links.iter_mut().for_each(|l| l.mass = None);
    let scores = every(&m);
    let mut outside = 0;
    for terms in [
        &[(Term::PeakForce, 1.0)][..],
        &[(Term::PeakMoment, 1.0)],
        &[(Term::OutputError, 10.0)],
        &[
            (Term::PeakForce, 1.0),
            (Term::PeakMoment, 3.0),
            (Term::OutputError, 50.0),
        ],
    ] {
        let ranking = Ranking {
            terms: terms.to_vec(),
            ..Ranking::default()
        };
        let found = ranked(&m, &ranking, 2).ranking.unwrap();
        let list = found.list.iter().map(|r| (r.by_cost, r.total));
        let list: Vec<(usize, f64)> = list.collect();
        if found.proven {
            assert_eq!(list, best(&scores, &ranking), "{terms:?}");
            outside += usize::from(list.iter().any(|(at, _)| *at > found.scored));
        }
    }
    assert!(outside > 0);
}

/// A list is the same for any number of threads, and so is what is scored.
#[test]
fn the_same_for_any_number_of_threads() {
    let m = loaded();
    let terms = [(Term::PeakForce, 10.0), (Term::OutputError, 5.0)];
    let ranking = default_with(|r: &mut Ranking| r.terms = terms.to_vec());
    let found = [1, 2, 3].map(|threads| ranked(&m, &ranking, threads).ranking.unwrap());
    assert!(found[0].proven && found[0].elsewhere.is_some());
    let places: HashMap<usize, usize> = found[0].list.iter().map(|r| (r.by_cost, 1)).collect();
    assert_eq!(places.len(), TOP, "each once");
    assert_eq!(found[0], found[1]);
    assert_eq!(found[0], found[2]);
}

/// Where nothing bounds what is ranked by, all would have to be scored: that is left, and said.
#[test]
fn what_would_take_too_long_is_left_and_said() {
    let m = loaded();
    let request = Request {
        rank: vec![(Term::Conditioning, 1.0)],
        list: List::Top(3),
        check: Check::None,
        ..Request::default()
    };
    let ranking = ozols::search(&m, &request).unwrap().ranking.unwrap();
    assert!(!ranking.proven && !ranking.interrupted);
    assert!(ranking.proof.contains("too long"), "{}", ranking.proof);
    assert_eq!(ranking.list.len(), 3);
}
