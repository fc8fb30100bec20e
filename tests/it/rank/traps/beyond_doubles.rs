//! Shaky poses whose gaps sink below what doubles hold: undecided or still, never a motion for sure.

use super::{all, judge};
use crate::common::*;

/// At a fifth of a radian a row of five toggles gapes by 10^-23, one of nine by 10^-358.
#[test]
fn no_order_of_shakiness_is_taken_for_a_motion() {
    for levels in 5..=9 {
        for planar in [false, true] {
            let trap = all::toggles(levels, planar);
            let (instantaneous, found) = judge(&trap.text);
            assert_eq!(
                (instantaneous, found.mobility),
                (1, 0),
                "{}: {found:?}",
                trap.name
            );
            assert!(found.is_proven() || levels > 6, "{}: {found:?}", trap.name);
        }
    }
}

/// Several motions at once, each stopped by a high order alone.
#[test]
fn no_branch_is_one_that_a_high_order_stops() {
    for levels in [4, 5, 6, 7] {
        let (instantaneous, found) = judge(&all::toggles_joined(levels).text);
        assert_eq!(instantaneous, 2);
        assert_eq!(found.mobility, 0, "{levels}: {found:?}");
    }
}

fn rods(longer: &str, third: &str) -> String {
    let mut joints = String::new();
    for (rod, x, y) in [("a", "0", "100"), ("b", "100", "100"), ("c", third, longer)] {
        joints += &format!("0-{rod} | 0 {rod} | revolute | \"{x}\", \"0\", 0 | 0, 0, 1\n");
        joints += &format!("{rod}-top | {rod} top | revolute | \"{x}\", \"{y}\", 0 | 0, 0, 1\n");
    }
    write_mechanism(
        "name = \"rods\"\nlength_unit = \"mm\"",
        "0 a b c top*",
        &joints,
    )
}

/// What is longer by 0.78 µm, or by a millionth of that, stops it: written exactly, in decimals, and with digits to spare.
#[test]
fn a_rod_that_is_a_hair_longer_is_never_said_to_move() {
    for digits in 1..=12_u32 {
        let whole = format!("{}/{}", 100 * 10_u128.pow(digits) + 78, 10_u128.pow(digits));
        let decimals = format!("100.{:0>1$}", 78, digits.max(2) as usize);
        for (longer, exact) in [
            (whole, true),
            (decimals.clone(), false),
            (format!("{decimals}00"), false),
        ] {
            for third in ["250", "50", "1000/3"] {
                let text = rods(&longer, third);
                let (instantaneous, found) = judge(&text);
                assert_eq!(
                    (instantaneous, found.mobility),
                    (1, 0),
                    "{longer} {third}: {found:?}"
                );
                assert!(!exact || found.is_proven(), "{longer} {third}: {found:?}");
                let m = ozols::from_toml(&text).unwrap();
                let whole = &ozols::analyze(&m).unwrap()[0];
                assert!(
                    whole.finite.could_be(0),
                    "{longer} {third}: {:?}",
                    whole.finite
                );
            }
        }
    }
}

/// JSON gives a number where there is one, and both bounds always.
#[test]
fn both_bounds_are_told() {
    let said = |text: &str| json_on("analyze", "it.toml", text, "")["states"][0].clone();
    let keys = [
        "finite_mobility",
        "finite_mobility_at_least",
        "finite_mobility_at_most",
    ];
    let open = said(&all::toggles(9, true).text);
    assert_eq!(
        keys.map(|k| open[k].as_i64()),
        [None, Some(0), Some(1)],
        "{open:#}"
    );
    assert!(open["finite_mobility"].is_null());
    let known = said(&all::toggles(3, true).text);
    assert_eq!(keys.map(|k| known[k].as_i64()), [Some(0); 3]);
}

/// What is too large to be followed moves by anything from nothing to what moves instantaneously, and is not said to be known.
#[test]
fn what_is_too_large_is_not_decided() {
    let (instantaneous, found) = judge(&all::large_sheet(11).text);
    assert_eq!(found.as_word(), "bound");
    assert_eq!((found.mobility, found.at_most()), (0, instantaneous));
    assert!(
        found.is_undecided() && found.describe().contains("too large"),
        "{}",
        found.describe()
    );
}
