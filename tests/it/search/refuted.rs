//! Single variants refuted by one rank: those and no others that have redundant constraints, each analysed as a mechanism.

use crate::common::{built_in, fresh};
use crate::search::beyond_budget::ladder;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::{Mechanism, StateId};
use ozols::redundancy::analysis::{Method, analyse, exact_field};
use ozols::search::Search;
use ozols::search::answer::k_best::Assignment;
use ozols::search::answer::keys::Key;
use ozols::search::check::variant_mechanism::realize;
use ozols::search::question::conditions::Conditions;

/// How many of some random variants are determinate, and how many are not.
fn refuted_as_analysed(m: &Mechanism, seed: u64) -> [usize; 2] {
    let conditions = Conditions {
        keep_output: false,
        ..Conditions::default()
    };
    let search = Search::new(exact_field(m, 0).unwrap(), m, conditions).unwrap();
    let orders = search.orders();
    let mut random = seed;
    let mut below = |limit: usize| {
        random = random
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (random >> 33) as usize % limit
    };
    let mut found = [0; 2];
    for _ in 0..60 {
        let variables = search.space.variables.iter();
        let choices = variables.map(|v| below(v.choices.len())).collect();
        let variant = Assignment {
            choices,
            key: Key::default(),
        };
        let built = realize(&search, &variant.choices);
        let method = Method::Auto { tolerance: None };
        let analysis = analyse(&built, &[StateId::FREE], method).unwrap();
        let redundant = analysis[0].redundant > 0;
        let refuted = search.refutes(&orders, &[variant]);
        assert_eq!(refuted, redundant, "{} from seed {seed}", m.name);
        found[usize::from(redundant)] += 1;
    }
    found
}

#[test]
fn a_variant_is_refuted_where_it_has_redundant_constraints_and_nowhere_else() {
    let seed = fresh();
    let ladders = [(2, false), (3, false), (2, true), (3, true)];
    let ladders = ladders.map(|(contours, spatial)| {
        let text = ladder(contours, seed, spatial);
        mechanism_from_str("ladder.toml", &text).unwrap()
    });
    let built_in = ["gripper-10", "four-bar", "scissor-lift"].map(built_in);
    let mut found = [0; 2];
    for m in ladders.iter().chain(&built_in) {
        let [determinate, redundant] = refuted_as_analysed(m, seed);
        found[0] += determinate;
        found[1] += redundant;
    }
    assert!(found.iter().all(|n| *n > 30), "{found:?}");
}
