//! How many variants are minimal, against every pair of variants looked at in rational arithmetic.

use crate::common::*;
use crate::fuzz::runs;
use crate::search::twin::less::does_with_less;
use crate::search::twin::{all_variants, look_at_variant, random, suits_state};

/// What the search counts, and what a look at each pair does.
fn both(m: &Mechanism, conditions: Conditions) -> (Option<BigUint>, usize) {
    let state = conditions.state;
    let clamped = state.is_some();
    let all = all_variants(m, clamped);
    let present = look_at_variant(m, clamped, &vec![(0, None); m.joints.len()]);
    let (most, keep, w) = (
        conditions.max_redundant,
        conditions.keep_output,
        conditions.max_mobility,
    );
    let admissible: Vec<_> = all
        .iter()
        .filter(|c| {
            let t = look_at_variant(m, clamped, c);
            let moves = !keep || t.motion == present.motion;
            t.internal <= most
                && suits_state(state, &t)
                && moves
                && w.is_none_or(|w| t.mobility <= w)
        })
        .collect();
    let beyond = |v| admissible.iter().any(|less| does_with_less(m, less, v));
    let minimal = admissible.iter().filter(|v| !beyond(v)).count();
    let (search, diagrams) = searched(m, conditions);
    (search.count_minimal(&diagrams), minimal)
}

proptest! {
    #![proptest_config(runs(64))]
    #[test]
    fn minimal_variants_are_counted_as_by_a_look_at_each_pair(
        text in random(), most in 0u32..3, keep in any::<bool>(), w in 0i64..5,
    ) {
        let m = read(&text);
        let clamped = m.states.len() > 1;
        prop_assume!(all_variants(&m, clamped).len() <= if clamped { 24 } else { 64 });
        let conditions = Conditions {
            max_redundant: most,
            keep_output: keep,
            max_mobility: (w > 1).then_some(w),
            state: clamped.then_some(InState {
                state: StateId::new(1),
                max_external: (most != 1).then_some(most * 2),
                max_harmful: (most != 2).then_some(most),
                hold_objects: keep,
            }),
            ..Conditions::default()
        };
        let (counted, seen) = both(&m, conditions);
        prop_assert_eq!(counted, Some(seen.into()));
    }
}

#[test]
fn minimal_variants_of_built_in_mechanisms() {
    for (name, options, most, w) in [
        ("four-bar", &[][..], 0, None),
        ("four-bar", &[], 1, None),
        ("four-bar", &[], 0, Some(1)),
        ("slider-crank-spatial", &[], 0, None),
        ("door-two-hinges", &[], 0, None),
        ("oldham", &[], 1, None),
        ("watt-six-bar", &["spherical"], 0, None),
    ] {
        let mut m = built_in(name);
        if !options.is_empty() {
            for joint in &mut m.edit().joints {
                let offered = |n: &str| n == "revolute" || options.contains(&n);
                joint.options.retain(|o| offered(&o.name));
            }
        }
        let conditions =
            default_with(|c: &mut Conditions| (c.max_redundant, c.max_mobility) = (most, w));
        let (counted, seen) = both(&m, conditions);
        assert_eq!(counted, Some(seen.into()), "{name}");
    }
}

/// Options that have the same freedoms under two names have none less than each other: both stay.
#[test]
fn equal_options_do_not_rule_each_other_out() {
    let with_names = |sleeves: &[&str]| {
        let mut m = built_in("four-bar");
        for joint in &mut m.edit().joints {
            joint
                .options
                .retain(|o| ["revolute", "cylindrical", "spherical"].contains(&o.name.as_str()));
            let sleeve = joint
                .options
                .iter()
                .find(|o| o.name == "cylindrical")
                .cloned();
            let more = sleeve.into_iter().flat_map(|sleeve| {
                sleeves.iter().map(move |&name| JointOption {
                    name: name.to_owned(),
                    ..sleeve.clone()
                })
            });
            let more: Vec<JointOption> = more.collect();
            joint.options.extend(more);
        }
        let (counted, seen) = both(&m, Conditions::default());
        assert_eq!(counted, Some(seen.into()), "{sleeves:?}");
        seen
    };
    let (one, two) = (with_names(&[]), with_names(&["sleeve"]));
    assert!(one > 0 && two > one, "{one} {two}");
}

/// Without a redundant constraint a freedom more is a motion more, so that what moves as the present mechanism does, in one way,
/// is minimal; that some of the rest are, too, is seen where a ball has nothing smaller in its place.
#[test]
fn what_moves_in_one_way_without_redundancy_is_minimal() {
    let whole = run_json("search gripper-10 --format json");
    assert_eq!(whole["admissible_by_mobility"]["1"], whole["minimal"]);
    assert_eq!(parse_count(&whole["minimal"]), 7_150_020);
    let balls = ["--options", "spherical", "--format", "json"];
    let balls = run_json(&[&["search", "gripper-10"][..], &balls].concat());
    assert!(balls["admissible_by_mobility"]["1"].is_null());
    assert!(parse_count(&balls["minimal"]) > 0);
    // Of what is cut short nothing is minimal for certain, and orbits are not counted so.
    for more in [&["--nodes", "60"][..], &["--one-per-orbit"]] {
        let args = [&["search", "gripper-10", "--format", "json"][..], more].concat();
        assert!(run_json(&args)["minimal"].is_null(), "{more:?}");
    }
}
