//! Ways of the engine that must give the same, looked at from the inside.

use crate::common::*;
use ozols::search::solve::build_diagrams;
use ozols::search::testing::{Walked, walked_for_ideas, walked_for_variants};

/// A list ten times as long takes no more steps than k log k says.
#[test]
fn steps_of_a_list_grow_no_faster_than_its_length_and_its_logarithm() {
    type Walk = fn(&Question, &Diagrams, usize) -> Walked;
    let (mut seen, walks): (_, [Walk; 2]) = (0, [walked_for_variants, walked_for_ideas]);
    for name in split_words(
        "gripper-10 gripper-10-redesign four-bar scissor-lift-3 stewart-gough gripper-slider-two-fingers",
    ) {
        let m = built_in(name);
        let exact = exact_field(&m, 0).unwrap();
        let question = Question::new(exact, &m, Conditions::default()).unwrap();
        let found = build_diagrams(&question, Control::NONE);
        for walk in walks {
            let lists = [10, 100, 1_000, 10_000].map(|k| walk(&question, &found, k));
            for pair in lists.windows(2) {
                let (few, many) = (pair[0].listed, pair[1].listed);
                if few < 2 || many < 2 * few {
                    continue;
                }
                let [short, long] = [few, many].map(|n| n as f64);
                seen += 1;
                let most = long / short * (long.ln() / short.ln());
                let grew = pair[1].steps as f64 / pair[0].steps as f64;
                assert!(grew <= most, "{name}: {pair:?}");
            }
        }
    }
    assert!(seen > 10, "{seen}");
}
