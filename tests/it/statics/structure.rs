//! Decomposition into Assur groups: published classifications, laws, and brute force.

use crate::common::*;
mod grown;

use super::{
    J, pair_named, planar_file, planar_mechanism, read_planar, sliding_joint, turning_joint,
};
use ozols::statics::assur::{AssurError, Decomposition, decompose_alternatives, decompose_groups};
use ozols::statics::assur_class::Kind;
use ozols::statics::planar::{BodyId, PlanarMechanism};

fn four_bar() -> Vec<J> {
    vec![
        turning_joint("0", "1", 0., 0.),
        turning_joint("1", "2", 0., 1.),
        turning_joint("2", "3", 3., 3.),
        turning_joint("3", "0", 4., 0.),
    ]
}

/// Stephenson III: a four-bar 0-1-2-3 whose coupler carries the dyad 4-5.
fn stephenson() -> Vec<J> {
    let mut all = four_bar();
    all.extend([
        turning_joint("2", "4", 2., 4.),
        turning_joint("4", "5", 6., 5.),
        turning_joint("5", "0", 7., 0.),
    ]);
    all
}

/// Watt I: four-bar 0-1-2-3, dyad 4-5 on coupler and rocker.
fn watt() -> Vec<J> {
    let mut all = four_bar();
    all.extend([
        turning_joint("2", "4", 2., 4.),
        turning_joint("4", "5", 6., 5.),
        turning_joint("5", "3", 5., 2.),
    ]);
    all
}

/// Theo Jansen's leg: crank 1, and dyads (2, 3), (4, 5), (6, 7).
fn jansen() -> Vec<J> {
    vec![
        turning_joint("0", "1", 0., 0.),
        turning_joint("1", "2", 15., 0.),
        turning_joint("2", "3", -30., 41.),
        turning_joint("3", "0", -38., -8.),
        turning_joint("1", "4", 15., 0.),
        turning_joint("4", "5", -20., -45.),
        turning_joint("5", "0", -38., -8.),
        turning_joint("3", "6", -78., -5.),
        turning_joint("6", "7", -62., -42.),
        turning_joint("7", "5", -20., -45.),
    ]
}

/// The four-link group with a closed contour: 4 (D; F, K), rods 6 and 7, slider 10 (M, L; guide), on a crank 3.
fn closed_contour() -> Vec<J> {
    vec![
        turning_joint("0", "3", -2., 5.),
        turning_joint("3", "4", 0., 5.),
        turning_joint("4", "6", -1., 3.),
        turning_joint("4", "7", 1., 3.),
        turning_joint("6", "9", -0.6, 1.),
        turning_joint("7", "9", 0.5, 1.),
        sliding_joint("0", "9", 0., 0., [0., 1.]),
    ]
}

fn decomposed(joints: &[J]) -> (PlanarMechanism, Decomposition) {
    let m = planar_mechanism(joints);
    let d = decompose_groups(&m, &m.driven_pairs()).unwrap();
    (m, d)
}

fn words(m: &PlanarMechanism, d: &Decomposition) -> Vec<String> {
    let names = |list: &[BodyId]| list.iter().map(|&b| m.bodies[b].name.as_str()).join("+");
    d.groups
        .iter()
        .map(|g| format!("{}: {}", names(&g.bodies), g.class))
        .collect()
}

/// Every law a decomposition keeps.
fn laws(m: &PlanarMechanism, d: &Decomposition) {
    let mut bodies: Vec<BodyId> = d.driven.iter().copied().chain([m.frame]).collect();
    let mut pairs = d.driven_pairs.clone();
    let mut placed = bodies.clone();
    for g in &d.groups {
        assert_eq!(g.mobility(), 0);
        assert_eq!(g.class.order, g.outer.len());
        for &q in &g.outer {
            let ends = m.pairs[q].bodies;
            assert_eq!(ends.iter().filter(|b| g.bodies.contains(b)).count(), 1);
            assert_eq!(
                ends.iter().filter(|b| placed.contains(b)).count(),
                1,
                "outer pairs hang on earlier bodies"
            );
        }
        for &q in &g.inner {
            assert!(m.pairs[q].bodies.iter().all(|b| g.bodies.contains(b)));
        }
        bodies.extend(&g.bodies);
        placed.extend(&g.bodies);
        pairs.extend(g.all_pairs());
    }
    bodies.sort_unstable();
    pairs.sort_unstable();
    assert_eq!(
        bodies,
        (0..m.bodies.len()).collect_vec(),
        "every body is in exactly one group"
    );
    assert_eq!(
        pairs,
        (0..m.pairs.len()).collect_vec(),
        "the pairs of the groups are all pairs"
    );
}

/// Groups by definition: again and again the smallest set of unused bodies with 3n = 2p, lowest numbers first.
fn by_brute_force(m: &PlanarMechanism, driven: &[BodyId]) -> Vec<Vec<BodyId>> {
    let mut used: Vec<BodyId> = driven.iter().copied().chain([m.frame]).collect();
    let mut groups = Vec::new();
    while used.len() < m.bodies.len() {
        let unused = (0..m.bodies.len())
            .filter(|b| !used.contains(b))
            .collect_vec();
        let balanced = |set: &Vec<BodyId>| {
            let inside = |b: &BodyId| set.contains(b) || used.contains(b);
            let touches = |q: &&ozols::statics::planar::Pair| {
                !q.drive && q.bodies.iter().any(|b| set.contains(b)) && q.bodies.iter().all(inside)
            };
            3 * set.len() == 2 * m.pairs.iter().filter(touches).count()
        };
        let found = unused
            .iter()
            .copied()
            .powerset()
            .skip(1)
            .find(balanced)
            .expect("a group");
        used.extend(&found);
        groups.push(found);
    }
    groups.sort();
    groups
}

#[test]
fn published_mechanisms_have_their_published_groups() {
    let (m, d) = decomposed(&four_bar());
    assert_eq!(words(&m, &d), ["2+3: class II, order 2, dyad RRR"]);
    // Norton, Design of Machinery; Artobolevsky: with the crank of the four-bar driving, Stephenson's
    // chain is of class II, driven from the dyad's side of class III.
    let (m, d) = decomposed(&stephenson());
    assert_eq!(
        words(&m, &d),
        [
            "2+3: class II, order 2, dyad RRR",
            "4+5: class II, order 2, dyad RRR"
        ]
    );
    let d = decompose_groups(&m, &[pair_named(&m, "5-0")]).unwrap();
    assert_eq!(words(&m, &d), ["1+2+3+4: class III, order 3, triad"]);
    laws(&m, &d);
    let (m, d) = decomposed(&watt());
    assert_eq!(d.highest_class(), 2);
    assert_eq!(d.groups.len(), 2);
    laws(&m, &d);
    let (m, d) = decomposed(&jansen());
    assert_eq!(
        words(&m, &d),
        [
            "2+3: class II, order 2, dyad RRR",
            "4+5: class II, order 2, dyad RRR",
            "6+7: class II, order 2, dyad RRR"
        ]
    );
    laws(&m, &d);
    // [Bychkov, Dvornikov & Zhukov 2018] and the paper of 2004 they cite: four links in a closed contour, class IV.
    let (m, d) = decomposed(&closed_contour());
    assert_eq!(
        words(&m, &d),
        ["4+6+7+9: class IV, order 2, four links in a closed contour"]
    );
    laws(&m, &d);
}

/// Artobolevsky's table of dyads.
#[test]
fn dyads_have_their_species() {
    let dyad = |a: bool, b: bool, c: bool| {
        let joint = |x: &str, y: &str, at: (f64, f64), slide: bool, along| {
            if slide {
                sliding_joint(x, y, at.0, at.1, along)
            } else {
                turning_joint(x, y, at.0, at.1)
            }
        };
        vec![
            turning_joint("0", "1", 0., 0.),
            joint("1", "2", (0., 1.), a, [1., 0.]),
            joint("2", "3", (3., 3.), b, [1., 2.]),
            joint("3", "0", (4., 0.), c, [0., 1.]),
        ]
    };
    for (pairs, species) in [
        ((false, false, false), 1),
        ((false, false, true), 2),
        ((true, false, false), 2),
        ((false, true, false), 3),
        ((true, false, true), 4),
        ((true, true, false), 5),
        ((false, true, true), 5),
    ] {
        let (_, d) = decomposed(&dyad(pairs.0, pairs.1, pairs.2));
        assert_eq!(d.groups[0].class.kind, Kind::Dyad(species), "{pairs:?}");
    }
}

#[test]
fn groups_of_six_links_are_classified() {
    // Two bodies of three pairs joined, two leashes each: class III, order 4.
    let chain = vec![
        turning_joint("0", "1", 0., 0.),
        turning_joint("1", "a", 1., 0.),
        turning_joint("a", "S", 2., 1.),
        turning_joint("0", "b", 1., 3.),
        turning_joint("b", "S", 2., 3.),
        turning_joint("S", "T", 4., 2.),
        turning_joint("T", "c", 6., 1.),
        turning_joint("c", "0", 7., 0.),
        turning_joint("T", "d", 6., 3.),
        turning_joint("d", "0", 7., 4.),
    ];
    let (_, d) = decomposed(&chain);
    assert_eq!(
        (d.groups.len(), d.highest_class(), d.groups[0].class.order),
        (1, 3, 4)
    );
    assert_eq!(
        (
            d.groups[0].class.contours,
            &d.groups[0].class.composition[..]
        ),
        (0, &[4, 2][..])
    );
    // A contour of five bodies, three of them with an outer pair and one carrying a leash ring: class V, order 3.
    let ring = vec![
        turning_joint("0", "1", 0., 0.),
        turning_joint("1", "a", 1., 0.),
        turning_joint("a", "b", 2., 2.),
        turning_joint("b", "c", 4., 3.),
        turning_joint("c", "d", 6., 2.),
        turning_joint("d", "e", 6., 0.),
        turning_joint("e", "a", 3., -1.),
        turning_joint("c", "0", 5., 5.),
        turning_joint("d", "f", 8., 1.),
        turning_joint("f", "0", 9., 0.),
    ];
    let (_, d) = decomposed(&ring);
    assert_eq!((d.groups.len(), d.highest_class()), (1, 5));
    assert_eq!(d.groups[0].class.order, 3);
}

#[test]
fn the_drive_decides_the_groups() {
    let m = planar_mechanism(&stephenson());
    let found = decompose_alternatives(&m, &m.driven_pairs());
    assert_eq!(found.len(), m.pairs.len());
    let at_frame = found
        .iter()
        .take(3)
        .map(|(q, _)| m.pairs[*q].name.as_str())
        .collect_vec();
    assert_eq!(at_frame, ["0-1", "3-0", "5-0"]);
    let classes: Vec<(&str, usize)> = found
        .iter()
        .map(|(q, d)| {
            (
                m.pairs[*q].name.as_str(),
                d.as_ref().unwrap().highest_class(),
            )
        })
        .collect();
    assert_eq!(
        classes,
        [
            ("0-1", 2),
            ("3-0", 2),
            ("5-0", 3),
            ("1-2", 2),
            ("2-3", 2),
            ("2-4", 3),
            ("4-5", 3)
        ]
    );
    for (_, d) in found {
        laws(&m, &d.unwrap());
    }
}

#[test]
fn drives_that_do_not_fit_are_refused_with_names() {
    let m = planar_mechanism(&four_bar());
    let none = decompose_groups(&m, &[]).unwrap_err();
    assert_eq!(
        none,
        AssurError::Underconstrained {
            bodies: "1, 2, 3".into(),
            freedoms: 1
        }
    );
    let two = decompose_groups(&m, &[0, 3]).unwrap_err();
    let AssurError::Overconstrained { excess: 1, bodies } = two else {
        panic!("{two}")
    };
    assert_eq!(bodies, "2");
    // A third rod on a parallelogram is redundant in the plane too.
    let text = ozols::builtin::text("parallelogram-3-rods-planar").unwrap();
    let m = PlanarMechanism::new(&read_planar(text), StateId::FREE).unwrap();
    assert!(matches!(
        decompose_groups(&m, &m.driven_pairs()),
        Err(AssurError::Overconstrained { excess: 1, .. })
    ));
}

#[test]
fn several_drives_and_drives_between_moving_bodies() {
    // Five-bar with two cranks.
    let mut five = planar_mechanism(&[
        turning_joint("0", "1", 0., 0.),
        turning_joint("1", "2", 0., 1.),
        turning_joint("2", "3", 2., 3.),
        turning_joint("3", "4", 4., 1.),
        turning_joint("4", "0", 4., 0.),
    ]);
    five.pairs[4].drive = true;
    let d = decompose_groups(&five, &five.driven_pairs()).unwrap();
    assert_eq!(
        (d.driven.len(), words(&five, &d)),
        (2, vec!["2+3: class II, order 2, dyad RRR".to_owned()])
    );
    laws(&five, &d);
    // A boom raised by a cylinder: the cylinder and its rod are one block of the dyad.
    let boom = planar_mechanism(&[
        sliding_joint("2", "3", 1., 1., [1., 1.]),
        turning_joint("0", "1", 0., 1.),
        turning_joint("0", "2", 0.5, 0.5),
        turning_joint("3", "1", 3., 3.),
    ]);
    let d = decompose_groups(&boom, &boom.driven_pairs()).unwrap();
    assert_eq!(d.groups[0].class.to_string(), "class II, order 2, dyad RRR");
    assert_eq!(
        (
            d.groups[0].blocks.len(),
            d.groups[0].bodies.len(),
            d.groups[0].locked.len()
        ),
        (2, 3, 1)
    );
    laws(&boom, &d);
}

#[test]
fn a_pin_in_a_slot_is_a_turning_and_a_sliding_pair() {
    let m = PlanarMechanism::new(
        &read_planar(ozols::builtin::text("lever-slot-gripper").unwrap()),
        StateId::FREE,
    )
    .unwrap();
    assert_eq!(m.bodies.iter().filter(|b| b.link.is_none()).count(), 2);
    let d = decompose_groups(&m, &m.driven_pairs()).unwrap();
    laws(&m, &d);
    assert_eq!(
        d.groups.iter().map(|g| g.class.kind).collect_vec(),
        [Kind::Dyad(3); 2]
    );
}
