//! The search against a slow twin in rational arithmetic that shares no code with it, on random mechanisms.

use crate::common::*;
pub(crate) mod less;
mod random;

pub(crate) use self::random::random;
use self::random::random_coupled;
pub(crate) use crate::fuzz::readers::slow_search::{Twin, all_variants, look_at_variant};
use ozols::model::mechanism::Frame;
use ozols::redundancy::stress::{SelfStress, StressVerdict};
use ozols::search::check::brute::every_variant;
use ozols::search::question::conditions::{InState, Symmetry};
use proptest::prelude::*;

proptest! {
    #![proptest_config(crate::fuzz::runs(64))]
    #[test]
    fn the_search_agrees_with_its_twins_on_coupled_joints(
        text in random_coupled(), allowed in 0u32..3, keep in any::<bool>(), hold in any::<bool>(),
        drives in drives(),
    ) {
        prop_assume!(text.is_some());
        agrees(&text.unwrap(), allowed, keep, hold, &drives)?;
    }

    #[test]
    fn the_search_agrees_with_its_twins(
        text in random(), allowed in 0u32..3, keep in any::<bool>(), hold in any::<bool>(),
        drives in drives(),
    ) {
        agrees(&text, allowed, keep, hold, &drives)?;
    }
}

/// Up to two drives, each at a joint and at a freedom of it.
fn drives() -> impl Strategy<Value = Vec<[prop::sample::Index; 2]>> {
    prop::collection::vec(any::<[prop::sample::Index; 2]>(), 0..3)
}

/// Drives a mechanism at joints of its free state.
fn drive(m: &mut Mechanism, drives: &[[prop::sample::Index; 2]]) {
    let free: Vec<JointId> = m.joints_in(StateId::FREE).collect();
    for [joint, freedom] in drives {
        let joint = &mut m.edit().joints[free[joint.index(free.len())]];
        let freedoms = joint.joint_type.freedoms();
        if !freedoms.is_empty() {
            joint.drive = true;
            joint.drive_freedom = Some(freedoms[freedom.index(freedoms.len())]);
        }
    }
}

/// Whether a variant is what it must be in the searched state.
pub(crate) fn suits_state(state: Option<InState>, t: &Twin) -> bool {
    state.is_none_or(|s| {
        s.max_external.is_none_or(|most| t.external <= most as i32)
            && s.max_harmful.is_none_or(|most| t.harmful <= most)
            && (t.held || !s.hold_objects)
    })
}

/// The analysis and the search of a mechanism, against every variant looked at in rational arithmetic.
fn agrees(
    text: &str,
    allowed: u32,
    keep: bool,
    hold: bool,
    drives: &[[prop::sample::Index; 2]],
) -> Result<(), TestCaseError> {
    let mut m = mechanism_from_str("random.toml", text).unwrap();
    let undriven = look_at_variant(&m, false, &vec![(0, None); m.joints.len()]).motion;
    drive(&mut m, drives);
    let clamped = m.states.len() > 1;
    let all = all_variants(&m, clamped);
    // The clamped state asks for more eliminations of each.
    prop_assume!(all.len() <= if clamped { 24 } else { 64 });
    let present = look_at_variant(&m, clamped, &vec![(0, None); m.joints.len()]);
    let states: Vec<StateId> = m.state_ids().collect();
    let found = analyse_states(&m, &states, Method::Modular).unwrap();
    prop_assert_eq!(found[0].redundant, present.internal as usize);
    prop_assert_eq!(found[0].mobility as i64, present.mobility);
    prop_assert_eq!(found[0].working_mobility, undriven);
    if clamped {
        let e = found[1].external.unwrap();
        prop_assert_eq!(e.redundant, i64::from(present.external));
        let harmful = |s: &&SelfStress| s.external && s.verdict == StressVerdict::Harmful;
        let found = found[1].self_stresses.iter().filter(harmful).count();
        prop_assert_eq!(found, present.harmful as usize);
        prop_assert_eq!(e.by_rank, i64::from(present.external));
    }
    // Every variant.
    let state = clamped.then_some(InState {
        state: StateId::new(1),
        max_external: (allowed != 1).then_some(allowed * 2),
        max_harmful: (allowed != 2).then_some(allowed),
        hold_objects: hold,
    });
    let request = Conditions {
        max_redundant: allowed,
        state,
        keep_output: keep,
        symmetry: Symmetry::All,
        ..Conditions::default()
    };
    let search = Search::new(exact_field(&m, 0).unwrap(), &m, request).unwrap();
    let diagrams = search.build_diagrams(&|| false, &mut |_| {});
    let determinate = search.count_variants(&diagrams.determinate, false);
    let admissible = search.count_variants(&diagrams.admissible, true);
    prop_assert_eq!(search.size(), all.len().into());
    let seen: Vec<Twin> = all
        .iter()
        .map(|c| look_at_variant(&m, clamped, c))
        .collect();
    let good = |t: &&Twin| t.internal <= allowed;
    let better =
        |t: &&Twin| good(t) && suits_state(state, t) && (!keep || t.motion == present.motion);
    let tally = |list: Vec<&Twin>| {
        let mut out: BTreeMap<(i64, u32), BigUint> = BTreeMap::new();
        for t in list {
            *out.entry((t.mobility, t.changes)).or_default() += 1u8;
        }
        out
    };
    prop_assert_eq!(
        &determinate.by_mobility_and_changes,
        &tally(seen.iter().filter(good).collect())
    );
    prop_assert_eq!(
        &admissible.by_mobility_and_changes,
        &tally(seen.iter().filter(better).collect())
    );
    let every = every_variant(&search).unwrap();
    prop_assert!(determinate == every.determinate && admissible == every.admissible);
    // The k best: all of them, each once, cheapest first; a shorter list is a prefix of a longer one.
    let list: Vec<_> = search
        .cheapest_variants(&diagrams, usize::MAX / 4)
        .collect();
    prop_assert_eq!(admissible.total, list.len().into());
    let mut distinct: Vec<_> = list.iter().map(|v| v.choices.clone()).collect();
    distinct.sort();
    distinct.dedup();
    prop_assert_eq!(distinct.len(), list.len());
    prop_assert!(list.windows(2).all(|w| w[0].key.cost() <= w[1].key.cost()));
    for v in &list {
        let chosen = search.space.variables.iter().zip(&v.choices);
        let mut choice = vec![(0, None); m.joints.len()];
        for (variable, &c) in chosen {
            let c = &variable.choices[c];
            choice[variable.joints[0].index()] = (c.option, c.unloading);
        }
        let t = look_at_variant(&m, clamped, &choice);
        prop_assert_eq!(
            (v.key.internal(), v.key.external()),
            (t.internal, t.external)
        );
        prop_assert_eq!(v.key.harmful(), t.harmful);
    }
    let three: Vec<_> = search.cheapest_variants(&diagrams, 3).collect();
    prop_assert_eq!(&three[..], &list[..list.len().min(3)]);
    // The same under a ceiling of cost, with nothing counted.
    let best = Conditions {
        counted: false,
        cheapest: 3,
        ..search.conditions.clone()
    };
    let best = Search::new(exact_field(&m, 0).unwrap(), &m, best).unwrap();
    let bounded = best.build_diagrams(&|| false, &mut |_| {});
    let found: Vec<_> = best.cheapest_variants(&bounded, 3).collect();
    prop_assert_eq!(&found, &three);
    let known = bounded.known_up_to().unwrap_or(i64::MAX);
    prop_assert!(
        found
            .iter()
            .all(|v| best.steps.cost_in_milli(v.key.cost()) <= known)
    );
    for v in search.sample_variants(&diagrams, 7).take(5) {
        prop_assert!(list.contains(&v));
    }
    Ok(())
}

proptest! {
    #![proptest_config(crate::fuzz::runs(48))]
    #[test]
    fn adding_freedoms_never_raises_redundancy_and_the_frame_does_not_matter(text in random(), move_by in -5i32..6) {
        let m = mechanism_from_str("random.toml", &text).unwrap();
        let before = &analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap()[0];
        // Turn the whole about z by a right angle and shift it.
        let mut moved = m.clone();
        let shift = Expr::from(i64::from(move_by));
        for j in &mut moved.edit().joints {
            let turn = |v: &[Expr; 3]| [-&v[1], v[0].clone(), v[2].clone()];
            let f = &j.frame;
            let point = turn(&f.point);
            let frame = Frame {
                point: [&point[0] + &shift, &point[1] - &shift, point[2].clone()],
                axis: turn(&f.axis),
                reference: turn(&f.reference),
                pitch: f.pitch.clone(),
            };
            j.frame = frame;
        }
        moved.edit().joints.reverse();
        for j in &mut moved.edit().joints {
            j.links.reverse();
        }
        let after = &analyse_states(&moved, &[StateId::FREE], Method::Modular).unwrap()[0];
        prop_assert_eq!((before.redundant, before.mobility), (after.redundant, after.mobility));
        prop_assert_eq!(before.working_mobility, after.working_mobility);
        for j in m.joint_ids() {
            for option in m.joints[j].options.clone() {
                let mut freed = m.clone();
                (freed.edit().joints[j].joint_type, freed.edit().joints[j].frame) = (option.joint_type, option.frame);
                let s = &analyse_states(&freed, &[StateId::FREE], Method::Modular).unwrap()[0];
                prop_assert!(s.redundant <= before.redundant);
            }
        }
    }
}
