//! The search against a slow twin in rational arithmetic that shares no code with it, on random mechanisms.

use crate::common::*;
mod figures;
pub(crate) mod less;
mod random;
mod rational;

use self::figures::figures;
pub(crate) use self::random::random;
use self::random::random_coupled;
use self::rational::{Q, allowed_twists, length, twists};
use ozols::model::joint_type::CoupledFreedom;
use ozols::model::mechanism::Frame;
use ozols::redundancy::stress::{SelfStress, StressVerdict};
use ozols::search::check::brute::every_variant;
use ozols::search::question::conditions::{InState, Symmetry};
use proptest::prelude::*;

/// What the contacts of the clamped state transmit.
#[derive(Clone, Copy, PartialEq)]
enum Contacts {
    /// All they do.
    Whole,
    /// Faces: forces along them and moments; this one only a moment about its normal.
    Friction(JointId),
    /// Nothing.
    Nothing,
}

pub(crate) struct Twin {
    pub(crate) internal: u32,
    pub(crate) external: i32,
    /// Harmful redundant constraints among those that load contacts.
    pub(crate) harmful: u32,
    /// Whether the object moves with one of its jaws.
    pub(crate) held: bool,
    pub(crate) mobility: i64,
    pub(crate) motion: usize,
    pub(crate) changes: u32,
}

/// Looks at one variant: `choice[j]` is (option, unloading) of joint j.
pub(crate) fn look(m: &Mechanism, clamped: bool, choice: &[(usize, Option<usize>)]) -> Twin {
    let outputs: Vec<LinkId> = m
        .link_ids()
        .filter(|&l| m.links[l].role == Role::Output || m.search.hold.contains(&l))
        .collect();
    let rows = match m.mode {
        Mode::Spatial => 6,
        Mode::Planar { .. } => 3,
    };
    let contacts: Vec<JointId> = m
        .joints_with_ids()
        .filter(|(_, j)| {
            j.states
                .as_ref()
                .is_some_and(|s| !s.contains(&StateId::FREE))
        })
        .map(|(j, _)| j)
        .collect();
    // In these files every contact is between a jaw and the object.
    let pairs: Vec<(LinkId, LinkId)> = contacts
        .iter()
        .map(|&j| (m.joints[j].links[0], m.joints[j].links[1]))
        .collect();
    let of = |state: StateId, carried: Contacts| {
        // An unloading joint is a joint in series with an extra link at the end of the list.
        let mut links = m.links.len();
        let mut joints: Vec<([LinkId; 2], Vec<Vec<Q>>)> = Vec::new();
        // Where the columns of each joint's own option begin.
        let mut own = vec![None; m.joints.len()];
        for (j, joint) in m.joints_with_ids() {
            let present = m.joints_in(state).any(|x| x == j);
            let (option, unloading) = choice[j];
            let frame = &joint.options[option].frame;
            let kind = &joint.options[option].joint_type;
            let mut span = allowed_twists(&m.mode, frame, kind);
            let contact = contacts.contains(&j);
            let part = [Freedom::Tz, Freedom::Rx, Freedom::Ry];
            let whole = [part, [Freedom::Rz, Freedom::Tx, Freedom::Ty]].concat();
            match carried {
                Contacts::Friction(face) if contact && *kind == JointType::Fixed => {
                    let more = &part[..if face == j { 3 } else { 1 }];
                    span = twists(frame, &JointType::Custom(more.to_vec()));
                }
                Contacts::Nothing if contact => span = twists(frame, &JointType::Custom(whole)),
                _ => {}
            }
            match unloading {
                Some(u) => {
                    let pad = LinkId::new(links);
                    links += 1;
                    let pad_joint = &joint.unloading[u];
                    let extra = allowed_twists(&m.mode, &pad_joint.frame, &pad_joint.joint_type);
                    // The pad of a contact is there while nothing is held, that of another joint goes with it.
                    if present || contact {
                        joints.push(([joint.links[0], pad], extra));
                    }
                    if present {
                        own[j] = Some(joints.iter().map(|(_, t)| t.len()).sum::<usize>());
                        joints.push(([pad, joint.links[1]], span));
                    }
                }
                None if present => {
                    own[j] = Some(joints.iter().map(|(_, t)| t.len()).sum());
                    joints.push((joint.links, span));
                }
                None => {}
            }
        }
        // Rates are in units of length 1, whatever the axis.
        let entry = |e: CoupledFreedom| {
            let option = &m.joints[e.joint].options[choice[e.joint].0];
            let at = option
                .joint_type
                .freedoms()
                .iter()
                .position(|f| *f == e.freedom);
            Some((own[e.joint]? + at?, length(&option.frame, e.freedom)))
        };
        let coupled: Vec<[(usize, Q); 2]> = m
            .couplings
            .iter()
            .filter_map(|c| {
                let ((a, x), (b, y)) = (entry(c.ends[0])?, entry(c.ends[1])?);
                Some([(a, -c.ratio.as_rational()? * x), (b, y)])
            })
            .collect();
        let used: BTreeSet<LinkId> = joints.iter().flat_map(|(l, _)| *l).collect();
        let contours = joints.len() + 1 - used.len();
        let searched = if state == StateId::FREE {
            &[][..]
        } else {
            &pairs
        };
        // Options stand in the frame of the present joint, so that the driven freedom has the same name in each.
        let driven = m.joints_with_ids().filter_map(|(j, joint)| {
            let freedom = joint.driven_freedom()?;
            let kind = &joint.options[choice[j].0].joint_type;
            let at = kind.freedoms().iter().position(|f| *f == freedom)?;
            Some(own[j]? + at)
        });
        let driven: Vec<usize> = driven.filter(|_| state == StateId::FREE).collect();
        let f = figures(
            links,
            m.frame(),
            &joints,
            &coupled,
            &outputs,
            &driven,
            searched,
        );
        let sigma = f.mobility + rows * contours + coupled.len() - f.freedoms;
        (f, sigma as i32)
    };
    let whole = |state| of(state, Contacts::Whole);
    let (free, internal) = whole(StateId::FREE);
    let (mut external, mut harmful, mut held) = (0, 0, true);
    if clamped {
        let state = StateId::new(1);
        let (f, sigma) = whole(state);
        external = sigma - internal;
        held = f.together.iter().any(|t| *t);
        // Self-stresses that load contacts, and those of them that friction explains.
        let idle = of(state, Contacts::Nothing).1;
        let face = |j: &&JointId| {
            m.joints[**j].options[choice[j.index()].0].joint_type == JointType::Fixed
        };
        let faces = contacts.iter().filter(face);
        let harmless = faces
            .map(|&j| of(state, Contacts::Friction(j)).1 - idle)
            .max();
        harmful = (sigma - idle - harmless.unwrap_or(0)) as u32;
    }
    let changes = choice
        .iter()
        .map(|(o, u)| u32::from(*o != 0) + u32::from(u.is_some()))
        .sum();
    Twin {
        internal: internal as u32,
        external,
        harmful,
        held,
        mobility: free.mobility as i64,
        motion: free.motion,
        changes,
    }
}

pub(crate) fn variants(m: &Mechanism, clamped: bool) -> Vec<Vec<(usize, Option<usize>)>> {
    let mut out = vec![Vec::new()];
    for (j, joint) in m.joints_with_ids() {
        let free = m.joints_in(StateId::FREE).any(|x: JointId| x == j);
        let choices: Vec<(usize, Option<usize>)> = if free || clamped {
            std::iter::once(None)
                .chain((0..joint.unloading.len()).map(Some))
                .flat_map(|u| (0..joint.options.len()).map(move |o| (o, u)))
                .collect()
        } else {
            vec![(0, None)]
        };
        out = out
            .into_iter()
            .flat_map(|v| choices.iter().map(move |&c| [v.clone(), vec![c]].concat()))
            .collect();
    }
    out
}

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
        let joint = &mut m.joints[free[joint.index(free.len())]];
        let freedoms = joint.joint_type.freedoms();
        if !freedoms.is_empty() {
            joint.drive = true;
            joint.drive_freedom = Some(freedoms[freedom.index(freedoms.len())]);
        }
    }
}

/// Whether a variant is what it must be in the searched state.
pub(crate) fn suits(state: Option<InState>, t: &Twin) -> bool {
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
    let undriven = look(&m, false, &vec![(0, None); m.joints.len()]).motion;
    drive(&mut m, drives);
    let clamped = m.states.len() > 1;
    let all = variants(&m, clamped);
    // The clamped state asks for more eliminations of each.
    prop_assume!(all.len() <= if clamped { 24 } else { 64 });
    let present = look(&m, clamped, &vec![(0, None); m.joints.len()]);
    let states: Vec<StateId> = m.state_ids().collect();
    let found = analyse(&m, &states, Method::Modular).unwrap();
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
    let diagrams = search.build(&|| false, &mut |_| {});
    let determinate = search.counts(&diagrams.determinate, false);
    let admissible = search.counts(&diagrams.admissible, true);
    prop_assert_eq!(search.size(), all.len().into());
    let seen: Vec<Twin> = all.iter().map(|c| look(&m, clamped, c)).collect();
    let good = |t: &&Twin| t.internal <= allowed;
    let better = |t: &&Twin| good(t) && suits(state, t) && (!keep || t.motion == present.motion);
    let tally = |list: Vec<&Twin>| {
        let mut out: BTreeMap<(i64, u32), num_bigint::BigUint> = BTreeMap::new();
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
    let list: Vec<_> = search.cheapest(&diagrams, usize::MAX / 4).collect();
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
        let t = look(&m, clamped, &choice);
        prop_assert_eq!(
            (v.key.internal(), v.key.external()),
            (t.internal, t.external)
        );
        prop_assert_eq!(v.key.harmful(), t.harmful);
    }
    let three: Vec<_> = search.cheapest(&diagrams, 3).collect();
    prop_assert_eq!(&three[..], &list[..list.len().min(3)]);
    // The same under a ceiling of cost, with nothing counted.
    let best = Conditions {
        counted: false,
        cheapest: 3,
        ..search.conditions.clone()
    };
    let best = Search::new(exact_field(&m, 0).unwrap(), &m, best).unwrap();
    let bounded = best.build(&|| false, &mut |_| {});
    let found: Vec<_> = best.cheapest(&bounded, 3).collect();
    prop_assert_eq!(&found, &three);
    let known = bounded.known_up_to().unwrap_or(i64::MAX);
    prop_assert!(
        found
            .iter()
            .all(|v| best.steps.milli(v.key.cost()) <= known)
    );
    for v in search.sample(&diagrams, 7).take(5) {
        prop_assert!(list.contains(&v));
    }
    Ok(())
}

proptest! {
    #![proptest_config(crate::fuzz::runs(48))]
    #[test]
    fn adding_freedoms_never_raises_redundancy_and_the_frame_does_not_matter(text in random(), move_by in -5i32..6) {
        let m = mechanism_from_str("random.toml", &text).unwrap();
        let before = &analyse(&m, &[StateId::FREE], Method::Modular).unwrap()[0];
        // Turn the whole about z by a right angle and shift it.
        let mut moved = m.clone();
        let shift = ozols::geom::expr::Expr::from(i64::from(move_by));
        for j in &mut moved.joints {
            let turn = |v: &[ozols::geom::expr::Expr; 3]| [-&v[1], v[0].clone(), v[2].clone()];
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
        moved.joints.reverse();
        for j in &mut moved.joints {
            j.links.reverse();
        }
        let after = &analyse(&moved, &[StateId::FREE], Method::Modular).unwrap()[0];
        prop_assert_eq!((before.redundant, before.mobility), (after.redundant, after.mobility));
        prop_assert_eq!(before.working_mobility, after.working_mobility);
        for j in m.joint_ids() {
            for option in m.joints[j].options.clone() {
                let mut freed = m.clone();
                (freed.joints[j].joint_type, freed.joints[j].frame) = (option.joint_type, option.frame);
                let s = &analyse(&freed, &[StateId::FREE], Method::Modular).unwrap()[0];
                prop_assert!(s.redundant <= before.redundant);
            }
        }
    }
}
