//! Couplings among the constraints that formulas count.

use super::{SLIDE, coupled, exact, mechanism, pair};
use crate::common::built_in;
use ozols::model::mechanism::StateId;
use ozols::redundancy::analysis::{Method, analyse};

/// A coupling is a constraint: Malyshev's formula counts it, and is W less σ with couplings as without, in every state.
#[test]
fn the_formula_counts_couplings() {
    // Five links, five hinges, a gear between two of them: 6·4 - 5·5 - 1.
    assert_eq!(exact(&built_in("geared-five-bar")).formula_mobility, -2);
    for name in ozols::builtin::names() {
        let m = built_in(name);
        let states: Vec<StateId> = m.state_ids().collect();
        for s in analyse(&m, &states, Method::Modular).unwrap() {
            let wanted = s.mobility as i64 - s.redundant as i64;
            assert_eq!(s.formula_mobility, wanted, "{name}");
        }
    }
}

/// A part clamped between two slides that a rack gears to each other: the state adds the two contacts and the gear.
#[test]
fn a_state_may_add_couplings() {
    let contact = |id: &str, links: &str, x: u8| {
        format!(
            "[[joint]]\nid = \"{id}\"\nlinks = {links}\ntype = \"revolute\"\npoint = [{x}, 0, 0]\naxis = [0, 0, 1]\nstate = \"clamped\"\n"
        )
    };
    let text = |coupling: &str| {
        pair(SLIDE, SLIDE, "")
            + "[[link]]\nid = \"part\"\nrole = \"object\"\n"
            + &contact("c", "[\"1\", \"part\"]", 10)
            + &contact("d", "[\"2\", \"part\"]", 90)
            + coupling
    };
    let external = |text: &str| {
        let m = mechanism(text);
        let found = analyse(&m, &[StateId::new(1)], Method::Modular).unwrap();
        found[0].external.unwrap()
    };
    // Two hinges: 5 + 5. The slides move alike then, and the part goes along: 10 - (2 - 1) - 6 = 3 of them are redundant.
    let without = external(&text(""));
    assert_eq!(
        (without.constraints, without.redundant, without.by_rank),
        (10, 3, 3)
    );
    // The hinges turn alike already where the part cannot turn: a gear between them repeats that.
    let geared = external(&text(&coupled("c", "d", "2")));
    assert_eq!(
        (geared.constraints, geared.redundant, geared.by_rank),
        (11, 4, 4)
    );
}
