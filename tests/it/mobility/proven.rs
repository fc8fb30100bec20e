//! Motions that are proven: which, by what, and that following them never says otherwise.

use super::built_in;
use crate::finite_traps::judged;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use ozols::builtin;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::{Mode, StateId};
use ozols::rank::exact::field::field_of;
use ozols::rank::finite::displacement_group::{Kind, whole_group};
use ozols::rank::finite::{Finite, How, Proof, followed};
use std::fmt::Write;

fn proof(name: &str) -> Option<Proof> {
    match judged(&built_in(name)).1 {
        Finite {
            how: How::Submersion { by, .. },
            numeric: false,
            ..
        } => Some(by),
        _ => None,
    }
}

/// A slider that could turn about its guide, and does not, leaves a planar mechanism.
#[test]
fn what_rests_is_locked_and_the_rest_is_a_group() {
    for name in ["gripper-10", "gripper-10-loaded", "slider-crank-spatial"] {
        assert!(
            proof(name) <= Some(Proof::Resting) && proof(name).is_some(),
            "{name}"
        );
    }
    assert_eq!(proof("gripper-10"), Some(Proof::Resting));
}

/// Legs that move in whole groups, and what those have in common [Hervé 1978].
#[test]
fn legs_are_groups_and_platforms_move_in_what_they_share() {
    for name in ["sarrus", "sarrus-three-legs", "3-crr", "tripteron"] {
        assert_eq!(proof(name), Some(Proof::Bonds), "{name}");
    }
}

/// Single contours of up to six hinges that counting gives no motion: not stopped up to the order beyond which nothing can.
#[test]
fn overconstrained_contours_are_proven_by_their_multiplicity() {
    for name in [
        "bennett",
        "goldberg-5r",
        "goldberg-6r",
        "myard-5r",
        "bricard-box",
        "bricard-line-symmetric",
        "bricard-plane-symmetric",
        "bricard-trihedral",
        "schatz-turbula",
        "altmann",
        "two-bennetts",
    ] {
        assert_eq!(proof(name), Some(Proof::Multiplicity), "{name}");
    }
    assert_eq!(proof("bennett-perturbed"), None);
}

/// Pins in a plane beyond need, whose equal lengths no group knows of.
#[test]
fn redundant_rods_in_a_plane_are_proven_by_their_multiplicity() {
    for name in [
        "parallelogram-3-rods",
        "parallelogram-3-rods-planar",
        "kempe-translator",
        "roberts-cognates",
        "dixon-k33",
    ] {
        assert_eq!(proof(name), Some(Proof::Multiplicity), "{name}");
    }
}

/// Planar and spherical built-ins whose pose is a regular one and whose contours J tells apart.
#[test]
fn most_built_ins_of_one_group_are_proven() {
    let (mut all, mut open) = (0, Vec::new());
    for name in builtin::names() {
        let m = built_in(name);
        let exact = field_of(&m, StateId::FREE, 0).unwrap();
        let kind = whole_group(&exact, &m, StateId::FREE).unwrap().kind();
        let planar = matches!(m.mode, Mode::Planar { .. }) || kind == Kind::Planar;
        if planar || kind == Kind::Spherical {
            all += 1;
            if !judged(&m).1.is_proven() {
                open.push(name);
            }
        }
    }
    open.sort_unstable();
    assert!(all > 30, "{all}");
    // Singular poses, and rings of more pins than Bézout's bound can be followed up to.
    assert_eq!(
        open,
        [
            "dixon-k44",
            "double-watt-cusp",
            "hoberman-ring-6",
            "origami-vertex-flat",
            "parallelogram-flat",
        ]
    );
}

/// A closed chain of hinges and slides with small whole coordinates: many are special by chance.
fn chain(random: &mut ChaCha8Rng) -> String {
    let mut below = |n: u32| random.next_u32() % n;
    let joints = 4 + below(3) as usize;
    let flat = below(2) == 0;
    let mut text = String::from("name = \"chain\"\n");
    for l in 0..joints {
        let role = ["role = \"frame\"\n", "role = \"output\"\n"]
            .get(l)
            .unwrap_or(&"");
        write!(text, "[[link]]\nid = \"{l}\"\n{role}").unwrap();
    }
    let directions = [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
        [0, 1, 1],
        [1, 1, 0],
        [1, 2, 2],
    ];
    for j in 0..joints {
        let kind = if below(6) == 0 {
            "prismatic"
        } else {
            "revolute"
        };
        let point = [(); 3].map(|()| below(4));
        let axis = directions[below(if flat { 2 } else { 6 }) as usize];
        write!(
            text,
            "[[joint]]\nid = \"j{j}\"\nlinks = [\"{j}\", \"{}\"]\ntype = \"{kind}\"\npoint = {point:?}\naxis = {axis:?}\n",
            (j + 1) % joints
        )
        .unwrap();
    }
    text
}

/// Proof and pursuit share nothing but the file: on chains at random they never contradict each other.
#[test]
fn proofs_of_random_chains_are_not_contradicted_by_following_them() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let (mut moving, mut stopped, mut orders) = (0, 0, 0);
    for case in 0..1500 {
        let text = chain(&mut random);
        let m = mechanism_from_str("x.toml", &text).unwrap();
        let (instantaneous, found) = judged(&m);
        if instantaneous == 0 || !found.is_proven() {
            continue;
        }
        let by_motion = followed(&m, StateId::FREE, instantaneous, 0.0).unwrap();
        assert!(
            by_motion.could_be(i64::try_from(found.mobility).unwrap()),
            "{case}: {found:?} {by_motion:?}\n{text}"
        );
        match found.how {
            How::Submersion { by, .. } => {
                moving += 1;
                orders += usize::from(by == Proof::Multiplicity);
            }
            How::Stopped { .. } => stopped += 1,
            _ => {}
        }
    }
    assert!(
        moving > 60 && stopped > 20 && orders > 3,
        "{moving} {stopped} {orders}"
    );
}
