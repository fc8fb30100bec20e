//! Couplings among the constraints that formulas count.

use super::{SLIDE, coupled, pair};
use crate::common::*;

/// A coupling is a constraint: Malyshev's formula counts it, and is W less σ with couplings as without, in every state.
#[test]
fn the_formula_counts_couplings() {
    // Five links, five hinges, a gear between two of them: 6·4 - 5·5 - 1.
    assert_eq!(analysed(&built_in("geared-five-bar")).formula_mobility, -2);
    for name in ozols::builtin::names() {
        let m = built_in(name);
        let states: Vec<StateId> = m.state_ids().collect();
        for s in analyse_states(&m, &states, Method::Modular).unwrap() {
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
        let m = read(text);
        let found = analyse_states(&m, &[StateId::new(1)], Method::Modular).unwrap();
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

/// A gear is no polynomial of half angles: opposite cranks of a parallelogram geared one to one move as without the gear, and the
/// order beyond which nothing stops a motion is not known of them.
#[test]
fn no_bound_on_the_order_is_taken_where_joints_are_coupled() {
    use ozols::rank::finite::Proof;
    let by_multiplicity = |m: &ozols::Mechanism| {
        let how = analysed(m).finite.how;
        matches!(
            how,
            How::Submersion {
                by: Proof::Multiplicity,
                ..
            }
        )
    };
    let text = write_mechanism(
        "name = \"parallelogram\"",
        "0 1 2* 3",
        "
        a | 0 1 | revolute | 0, 0, 0 | 0, 0, 1
        b | 1 2 | revolute | 10, 30, 0 | 0, 0, 1
        c | 3 2 | revolute | 110, 30, 0 | 0, 0, 1
        d | 0 3 | revolute | 100, 0, 0 | 0, 0, 1
        ",
    );
    let geared = analysed(&read(&(text.clone() + &coupled("a", "d", "1"))));
    assert_eq!(
        (geared.mobility, geared.redundant, geared.finite.mobility),
        (1, 4, 1)
    );
    let bent = analysed(&read(&(text.clone() + &coupled("a", "b", "-1"))));
    assert_eq!((bent.mobility, bent.redundant), (1, 4));
    for coupling in [coupled("a", "d", "1"), coupled("a", "b", "-1")] {
        assert!(!by_multiplicity(&read(&(text.clone() + &coupling))));
    }
    for name in ozols::builtin::names() {
        let m = built_in(name);
        assert!(m.couplings.is_empty() || !by_multiplicity(&m), "{name}");
    }
}

/// A rack with two pinions, and a sun with planets: a joint that several couplings tie is counted as by brute force.
#[test]
fn joints_of_several_couplings_are_counted_one_by_one() {
    for (name, ratio) in [
        ("rack-gripper", None),
        ("planetary-gear", None),
        // Wheels of other sizes than go together: their ratios at one joint are not alike.
        ("rack-gripper", Some(5)),
        ("planetary-gear", Some(5)),
    ] {
        let mut m = built_in(name);
        if let (Some(ratio), Some(last)) = (ratio, m.edit().couplings.last_mut()) {
            last.ratio = Expr::from(ratio);
        }
        let tied = |j| m.couplings_of(j).count() > 1;
        assert!(m.joint_ids().any(tied), "{name}");
        for max_redundant in 0..5 {
            for keep_output in [false, true] {
                let conditions = default_with(|c: &mut Conditions| {
                    (c.max_redundant, c.keep_output) = (max_redundant, keep_output)
                });
                let (s, d) = searched(&m, conditions);
                let every = every_variant(&s).unwrap();
                let found = (
                    s.count_variants(&d.determinate, false),
                    s.count_variants(&d.admissible, true),
                );
                assert_eq!(
                    found,
                    (every.determinate, every.admissible),
                    "{name} {ratio:?} {max_redundant}"
                );
            }
        }
    }
}
