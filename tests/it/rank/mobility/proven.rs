//! Motions that are proven: which, by what, and that following them never says otherwise.

use super::built_in;
use crate::common::*;
use crate::rank::finite_traps::{all::all as traps, judged, judged_in};
use crate::rank::rounded::cases::cases;
use ozols::rank::finite::independent_parts::lock_idle;
use ozols::rank::finite::{Finite, Proof, followed_mobility};

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

/// Legs that move in whole groups, and what those have in common [Hervé 1978]; legs that could do more than the platform asks of them
/// [Hervé 1999; Kong & Gosselin 2007]; bars of a parallelogram, which slide on a circle; contours that hold nothing twice between them;
/// contours of up to six hinges that counting gives no motion, pins in a plane beyond need and folded plates, not stopped up to the
/// order beyond which nothing can.
#[test]
fn each_kind_of_motion_has_its_proof() {
    for (names, by) in [
        ("gripper-10", Proof::Resting),
        ("slider-crank-spatial", Proof::Groups),
        ("sarrus sarrus-three-legs 3-crr tripteron", Proof::Bonds),
        ("4-upu quadrupteron", Proof::Bonds),
        ("orthoglide delta-parallelograms y-star", Proof::Bonds),
        ("exechon", Proof::Contours),
        (
            "bennett goldberg-5r goldberg-6r myard-5r bricard-box altmann bricard-line-symmetric bricard-plane-symmetric
            bricard-trihedral schatz-turbula two-bennetts miura-ori bricard-octahedron parallelogram-3-rods hoberman-ring-6
            parallelogram-3-rods-planar kempe-translator roberts-cognates dixon-k33 dixon-k44",
            Proof::Multiplicity,
        ),
    ] {
        for name in split_words(names) {
            assert_eq!(proof(name), Some(by), "{name}");
        }
    }
    assert_eq!(proof("bennett-perturbed"), None);
}

/// Where branches cross, or turn back in a cusp.
#[test]
fn motions_through_singular_poses_are_proven() {
    for (name, order) in [
        ("parallelogram-flat", 2),
        ("origami-vertex-flat", 2),
        ("3-upu-snu", 2),
        ("double-watt-cusp", 5),
    ] {
        let (instantaneous, found) = judged(&built_in(name));
        assert_eq!(found.how, How::Singular { order }, "{name}");
        assert!(
            found.is_proven() && found.mobility < instantaneous,
            "{name}"
        );
    }
}

fn between(part_has_faces: bool, edges: [(i32, [i32; 3]); 2]) -> String {
    let mut joints = "hinge | f g | revolute | 0, -30, 0 | 1, 0, 0\n".to_owned();
    for ((y, along), (jaw, z)) in edges.into_iter().zip([("f", 10), ("g", -10)]) {
        let ends = if part_has_faces {
            format!("p {jaw}")
        } else {
            format!("{jaw} p")
        };
        joints += &format!(
            "{jaw}-p | {ends} | cylinder-on-plane | 0, {y}, {z} | 0, 0, 1 | reference = {along:?}\n"
        );
    }
    write_mechanism("name = \"between\"", "f g p*", &joints)
}

/// By hand: a part with two edges along x slides along them whatever the jaws do; one with crossed edges does not, for rolling
/// about one tips the other. A plate between two edges moves in all ways of its plane.
#[test]
fn ways_of_a_part_are_split_off_where_its_faces_let_it_go() {
    let (x, y) = ([1, 0, 0], [0, 1, 0]);
    for (faces, second, idle) in [(false, x, 1), (false, y, 0), (true, x, 3), (true, y, 3)] {
        let text = between(faces, [(0, x), (7, second)]);
        let m = read(&text);
        let exact = field_of(&m, StateId::FREE, 0).unwrap();
        let mut locked = m.clone();
        let found = lock_idle(&exact, &mut locked, StateId::FREE).unwrap();
        assert_eq!(found, idle, "{text}");
        assert_eq!(judged(&locked).0 + idle, judged(&m).0, "{text}");
    }
}

/// The round part of the gripper slides along itself, and what is left with the slide split off is stopped: "the turn about z is
/// stopped by fifth order; the slide is there", as its file says.
#[test]
fn a_clamped_part_that_slides_is_proven_to_do_no_more() {
    let m = built_in("lever-gripper");
    let state = m.state_named("clamped").unwrap();
    let (instantaneous, found) = judged_in(&m, state);
    assert_eq!((instantaneous, found.mobility), (2, 1), "{found:?}");
    assert!(found.is_proven(), "{found:?}");
}

/// Of all built-ins four are followed alone: a parallelogram of screws, which no polynomial describes; two bananas, of which one
/// turns against the other as a whole; and two Wren platforms, whose motion ends in that of more freedoms.
#[test]
fn nearly_all_built_ins_are_proven() {
    let followed = builtin::names()
        .into_iter()
        .filter(|name| !judged(&built_in(name)).1.is_proven());
    assert_eq!(
        followed.sorted().collect_vec(),
        [
            "delassus-parallelogram",
            "double-banana",
            "wren-platform",
            "wren-platform-leaning",
        ]
    );
}

/// Mechanisms of known mobility that are not built in: those of mobility.json and the traps.
#[test]
fn most_further_mechanisms_are_proven() {
    let known = cases()
        .into_iter()
        .filter(|c| {
            !builtin::names()
                .iter()
                .any(|name| c.name.starts_with(&format!("{name},")))
        })
        // Those whose figures need more digits than the file has are no exact geometry.
        .filter(|c| judged(&c.mechanism).0 == usize::try_from(c.mobility).unwrap())
        .map(|c| (c.name, c.mechanism, c.finite));
    let traps = traps().into_iter().map(|t| {
        let mechanism = read(&t.text);
        (t.name, mechanism, i64::try_from(t.truth).unwrap())
    });
    let (mut all, mut open) = (0, Vec::new());
    for (name, mechanism, truth) in known.chain(traps) {
        all += 1;
        let (_, found) = judged(&mechanism);
        assert!(found.could_be(truth), "{name}: {found:?}");
        // A chain pulled taut: its self-stress is a tension, whose work is definite.
        assert!(
            found.is_proven() || !name.starts_with("taut-chain"),
            "{name}"
        );
        if !found.is_proven() {
            open.push(format!("{name}: {}", found.describe()));
        }
    }
    assert!(all >= 90, "{all}");
    assert!(
        all - open.len() >= 85,
        "{} of {all}: {open:#?}",
        all - open.len()
    );
}

/// A closed chain of hinges and slides with small whole coordinates: many are special by chance.
fn chain(random: &mut ChaCha8Rng) -> String {
    let mut below = |n: u32| random.next_u32() % n;
    let joints = 4 + below(3);
    let flat = below(2) == 0;
    let directions = [
        "1, 0, 0", "0, 1, 0", "0, 0, 1", "0, 1, 1", "1, 1, 0", "1, 2, 2",
    ];
    let joint = |_| {
        let kind = ["prismatic", "revolute"][usize::from(below(6) > 0)];
        let point = [(); 3].map(|()| below(4));
        let axis = directions[below(if flat { 2 } else { 6 }) as usize];
        format!("{kind} | {} | {axis}", commas(point))
    };
    write_ring("name = \"chain\"", &(0..joints).map(joint).collect_vec())
}

/// Proof and pursuit share nothing but the file: on mechanisms at random they never contradict each other. Returns how often each kind
/// of proof was found.
fn proofs_and_pursuit(
    cases: usize,
    seed: u64,
    text: fn(&mut ChaCha8Rng) -> String,
) -> BTreeMap<&'static str, usize> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut found_by = BTreeMap::new();
    for case in 0..cases {
        let text = text(&mut random);
        let m = read(&text);
        let (instantaneous, found) = judged(&m);
        if instantaneous == 0 {
            continue;
        }
        *found_by.entry(found.as_word()).or_insert(0) += 1;
        if found.is_proven() {
            let by_motion = followed_mobility(&m, StateId::FREE, instantaneous, 0.0).unwrap();
            let mobility = i64::try_from(found.mobility).unwrap();
            assert!(
                by_motion.could_be(mobility),
                "{case}: {found:?} {by_motion:?}\n{text}"
            );
        }
    }
    found_by
}

#[test]
fn proofs_of_random_chains_are_not_contradicted_by_following_them() {
    let found_by = proofs_and_pursuit(1500, 7, chain);
    let count = |word: &str| found_by.get(word).copied().unwrap_or(0);
    let counts = ["submersion", "multiplicity", "second-order"].map(count);
    assert!(
        counts[0] > 50 && counts[1] > 3 && counts[2] > 5,
        "{found_by:?}"
    );
}

/// Two contours of hinges and slides in a plane, about a point or along the axes, with small whole coordinates; every other leg is
/// the one before, shifted.
fn two_contours(random: &mut ChaCha8Rng) -> String {
    let mut below = |n: u32| random.next_u32() % n;
    let kind = below(3);
    let (mut links, mut lines) = ("a b*".to_owned(), String::new());
    let mut joints: Vec<(&str, [u32; 3], [u32; 3])> = Vec::new();
    for leg in 0..3 {
        if leg > 0 && below(2) == 0 {
            let shift = [below(4), below(4), below(4)];
            for (_, point, _) in &mut joints {
                (0..3).for_each(|i| point[i] += [shift[i], 0][usize::from(kind == 1)]);
            }
        } else {
            joints = (0..2 + below(2))
                .map(|_| {
                    let slides = kind != 1 && below(8) == 0;
                    let of = ["revolute", "prismatic"][usize::from(slides)];
                    let any = [(); 3].map(|()| below(4));
                    let along = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]][below(4) as usize];
                    match (kind, of) {
                        (0, "revolute") => (of, [any[0], any[1], 0], [0, 0, 1]),
                        (0, _) => (of, [0; 3], [any[0] + 1, any[1], 0]),
                        (1, _) => (of, [0; 3], [any[0] + 1, any[1], any[2]]),
                        _ => (of, any, along),
                    }
                })
                .collect();
        }
        let link = |k: usize| match k {
            0 => "a".to_owned(),
            k if k == joints.len() => "b".to_owned(),
            k => format!("{leg}-{k}"),
        };
        for (j, (of, point, axis)) in joints.iter().enumerate() {
            if j > 0 {
                links += &format!(" {}", link(j));
            }
            let (from, to, [point, axis]) =
                (link(j), link(j + 1), [point, axis].map(|v| commas(*v)));
            lines += &format!("{leg}.{j} | {from} {to} | {of} | {point} | {axis}\n");
        }
    }
    write_mechanism("name = \"two-contours\"", &links, &lines)
}

/// The same of two contours, of which most hold something twice or are at singular poses.
#[test]
fn proofs_of_random_contours_are_not_contradicted_by_following_them() {
    let cases = std::env::var("OZOLS_FUZZ").map_or(600, |n| n.parse().unwrap());
    let seed = std::env::var("OZOLS_SEED").map_or(11, |n| n.parse().unwrap());
    let found_by = proofs_and_pursuit(cases, seed, two_contours);
    for word in ["submersion", "multiplicity", "singular", "second-order"] {
        assert!(
            found_by.get(word).is_some_and(|&n| n >= 3),
            "{word}: {found_by:?}"
        );
    }
}
