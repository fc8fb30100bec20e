//! The search against a slow twin in rational arithmetic that shares no code with it, on random mechanisms.

use crate::common::*;
pub(crate) mod less;
mod random;

pub(crate) use self::random::random;
use self::random::random_coupled;
use crate::fuzz::readers::differential::assert_as_the_twins;
pub(crate) use crate::fuzz::readers::slow_search::{
    Choice, Twin, all_variants, look_at_variant, suits_state,
};
use ozols::redundancy::stress::{SelfStress, StressVerdict};

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

/// The analysis and the search of a mechanism, against every variant looked at in rational arithmetic.
fn agrees(
    text: &str,
    allowed: u32,
    keep: bool,
    hold: bool,
    drives: &[[prop::sample::Index; 2]],
) -> Result<(), TestCaseError> {
    let mut m = read(text);
    let undriven = look_at_variant(&m, false, &vec![(0, None); m.joints.len()]).motion;
    drive(&mut m, drives);
    let clamped = m.states.len() > 1;
    let all = all_variants(&m, clamped);
    // The clamped state asks for more eliminations of each.
    prop_assume!(all.len() <= if clamped { 24 } else { 64 });
    let look = |c: &Vec<Choice>| look_at_variant(&m, clamped, c);
    let seen: Vec<Twin> = all.iter().map(look).collect();
    let present = &seen[0];
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
    let diagrams = assert_as_the_twins(&m, &search, &all, &seen, text);
    // A shorter list is a prefix of a longer one.
    let list: Vec<_> = search
        .cheapest_variants(&diagrams, usize::MAX / 4)
        .collect();
    let three: Vec<_> = search.cheapest_variants(&diagrams, 3).collect();
    prop_assert_eq!(&three[..], &list[..list.len().min(3)]);
    // The same under a ceiling of cost, with nothing counted.
    let best = Conditions {
        counted: false,
        cheapest: 3,
        ..search.conditions.clone()
    };
    let (best, bounded) = searched(&m, best);
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
        let m = read(&text);
        let before = &analysed(&m);
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
        let after = &analysed(&moved);
        prop_assert_eq!((before.redundant, before.mobility), (after.redundant, after.mobility));
        prop_assert_eq!(before.working_mobility, after.working_mobility);
        for j in m.joint_ids() {
            for option in m.joints[j].options.clone() {
                let mut freed = m.clone();
                (freed.edit().joints[j].joint_type, freed.edit().joints[j].frame) = (option.joint_type, option.frame);
                let s = &analysed(&freed);
                prop_assert!(s.redundant <= before.redundant);
            }
        }
    }
}
