//! Finite mobility where it is hard to tell: right or undecided, never wrong and sure.

use crate::common::*;
#[path = "traps/all.rs"]
pub(crate) mod all;
#[path = "traps/beyond_doubles.rs"]
mod beyond_doubles;

use ozols::rank::finite::{Finite, finite_mobility};

pub(crate) fn judged(m: &Mechanism) -> (usize, Finite) {
    judged_in(m, StateId::FREE)
}

pub(crate) fn judged_in(m: &Mechanism, state: StateId) -> (usize, Finite) {
    let exact = field_of(m, state, 0).unwrap();
    let closure = Closure::new(&exact, m, state).unwrap();
    let rank = modular::rank_modulo(&exact, &closure);
    let found = finite_mobility(&exact, m, &closure, rank).unwrap();
    (closure.columns.len() - rank, found)
}

fn judge(text: &str) -> (usize, Finite) {
    judged(&read(text))
}

/// The traps that stay open; all others must be decided.
const UNDECIDED: &[&str] = &[];

#[test]
fn no_trap_is_answered_wrong_and_sure() {
    let traps = all::all();
    assert!(traps.len() >= 30, "{}", traps.len());
    let mut wrong = Vec::new();
    for t in &traps {
        assert!(!t.source.is_empty(), "{}", t.name);
        let (instantaneous, found) = judge(&t.text);
        let inside = (found.mobility..=found.at_most()).contains(&t.truth);
        let decided = found.mobility == found.at_most();
        if !inside
            || found.at_most() > instantaneous
            || (!decided && !UNDECIDED.contains(&t.name.as_str()))
        {
            wrong.push(format!(
                "{}: truth {}, W {instantaneous}, found {}: {}",
                t.name,
                t.truth,
                found.format_figure(),
                found.describe()
            ));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Shakiness of any order up to 64 is proven, in space and in the plane, whatever hangs on it.
#[test]
fn shakiness_of_higher_order_is_proven() {
    for t in all::all() {
        let order = match t.name.as_str() {
            n if n.starts_with("cascade-order-") => n.split('-').nth(2).unwrap().parse().unwrap(),
            n if n.starts_with("watt-guided") => 5,
            _ => continue,
        };
        let (_, found) = judge(&t.text);
        assert!(found.is_proven(), "{}: {found:?}", t.name);
        assert!(
            matches!(found.how, How::Stopped { order: o, .. } if o == order),
            "{}: {found:?}",
            t.name
        );
    }
}

/// Rods between two balls spin whatever the rest does: the finite mobility is never less than there are idle spins. Once it
/// was found to be 0 after 24 seconds, beside six of them.
#[test]
fn idle_spins_stay_beside_what_else_moves() {
    let text = builtin::text("wren-platform").unwrap();
    for (point, flipped) in [
        ("[150, 0, 180]", "[150, 0, -180]"),
        ("[90, 120, 180]", "[90, 120, -180]"),
        ("[90, 120, 0]", "[90, -120, 0]"),
        ("[120, -90, 180]", "[-120, -90, 180]"),
    ] {
        let m = read(&text.replacen(point, flipped, 1));
        let state = &ozols::analyze(&m).unwrap()[0];
        assert_eq!(state.idle.len(), 6, "{flipped}");
        assert!(
            state.finite.mobility >= 6,
            "{flipped}: {}",
            state.finite.format_figure()
        );
    }
}

/// A triangle of bars stands with one more across it, and a pendulum hangs beside it.
#[test]
fn what_swings_beside_a_rigid_part_does_not_make_it_say_that_nothing_moves() {
    let text = write_mechanism(
        "name = \"beside\"",
        "f a b* c p*",
        "
        fa | f a | revolute | 0, 0, 0 | 0, 0, 1
        ab | a b | revolute | 1, 2, 0 | 0, 0, 1
        bf | b f | revolute | 3, 0, 0 | 0, 0, 1
        ac | a c | revolute | 1, 1, 0 | 0, 0, 1
        cb | c b | revolute | 2, -1, 0 | 0, 0, 1
        hang | f p | revolute | 7, 0, 0 | 0, 0, 1
        ",
    );
    let (code, said, _) = run_on("analyze", "beside.toml", &text, "--verbose");
    assert_eq!(code, Some(0));
    has(&said, "finite mobility 1: joints outside loops");
    lacks(&said, "1: nothing moves");
}
