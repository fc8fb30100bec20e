//! What bounds leave of the variants outside of a pool is the best of all scored one by one, whichever term is ranked by.

use super::loaded;
use ozols::model::mechanism::Mechanism;
use ozols::model::ranking::{ClearanceSum, Order, Ranking, Term};
use ozols::score::evaluation::elimination::Scratch;
use ozols::score::evaluation::evaluate::Evaluator;
use ozols::score::request::{Check, List, Request};

const TOP: usize = 5;

fn request(options: &[&str]) -> Request {
    Request {
        options: options.iter().map(|o| (*o).to_owned()).collect(),
        list: List::Top(TOP),
        check: Check::None,
        ..Request::default()
    }
}

/// Places by cost and sums of the best, every variant scored.
fn best(m: &Mechanism, options: &[&str], rankings: &[Ranking]) -> Vec<Vec<(usize, f64)>> {
    let asked = Request {
        rank: vec![(Term::Cost, 1.0)],
        ..request(options)
    };
    let outcome = ozols::search(m, &asked).unwrap();
    let evaluator = Evaluator::new(&outcome.search, ClearanceSum::Worst).unwrap();
    let diagrams = outcome.diagrams.as_ref().unwrap();
    let mut scratch = Scratch::default();
    let all: Vec<_> = outcome.search.cheapest(diagrams, usize::MAX).collect();
    let scores: Vec<_> = all
        .iter()
        .map(|v| evaluator.scores(v, &mut scratch).ok())
        .collect();
    assert!(scores.iter().flatten().count() > TOP, "{}", scores.len());
    let of = |ranking: &Ranking| {
        let sums = scores.iter().enumerate();
        let sums = sums.filter_map(|(at, s)| Some((at + 1, s.as_ref()?.weighted(ranking))));
        let mut sums: Vec<(usize, f64)> = sums.collect();
        sums.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        sums.truncate(TOP);
        sums
    };
    rankings.iter().map(of).collect()
}

/// Rankings by one term with so little of cost that it parts equals alone, and by several.
fn rankings() -> Vec<Ranking> {
    let terms = [
        vec![(Term::PeakForce, 1.0), (Term::Cost, 1e-6)],
        vec![(Term::PeakMoment, 1.0), (Term::Cost, 1e-6)],
        vec![(Term::OutputError, 1.0), (Term::Cost, 1e-6)],
        vec![
            (Term::PeakForce, 10.0),
            (Term::PeakMoment, 1.0),
            (Term::OutputError, 5.0),
            (Term::Cost, 0.05),
        ],
    ];
    let one = |terms: Vec<(Term, f64)>| Ranking {
        order: Order::Weighted,
        terms,
        ..Ranking::default()
    };
    terms.map(one).to_vec()
}

fn as_all_scored(m: &Mechanism, options: &[&str]) -> usize {
    let rankings = rankings();
    let mut proven = 0;
    for (ranking, wanted) in rankings.iter().zip(best(m, options, &rankings)) {
        let own = Mechanism {
            ranking: Some(ranking.clone()),
            ..m.clone()
        };
        let found = ozols::search(&own, &request(options)).unwrap();
        let found = found.ranking.unwrap();
        let list: Vec<(usize, f64)> = found
            .list
            .iter()
            .map(|r| (r.by_cost, r.total.unwrap()))
            .collect();
        if found.proven {
            proven += 1;
            assert_eq!(list, wanted, "{} {:?}", m.name, ranking.terms);
        }
    }
    proven
}

#[test]
fn bounds_leave_the_best_whatever_is_ranked_by() {
    let options = ["revolute", "spherical", "cylindrical", "sphere-in-cylinder"];
    assert!(as_all_scored(&loaded(), &options) > 1);
}
