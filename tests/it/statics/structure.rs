//! Decomposition into Assur groups: published classifications, laws, and brute force.

use crate::common::*;
mod grown;

use super::{J, joints_of, pair_named, planar_mechanism};
use ozols::statics::assur::{AssurError, Decomposition, decompose_alternatives};
use ozols::statics::assur_class::Kind;
use ozols::statics::planar::BodyId;

const FOUR_BAR: &str = "0-1 0 0, 1-2 0 1, 2-3 3 3, 3-0 4 0";

/// Stephenson III: a four-bar 0-1-2-3 whose coupler carries the dyad 4-5.
fn stephenson() -> Vec<J> {
    joints_of(&format!("{FOUR_BAR}, 2-4 2 4, 4-5 6 5, 5-0 7 0"))
}

/// Watt I: four-bar 0-1-2-3, dyad 4-5 on coupler and rocker.
fn watt() -> Vec<J> {
    joints_of(&format!("{FOUR_BAR}, 2-4 2 4, 4-5 6 5, 5-3 5 2"))
}

/// Theo Jansen's leg: crank 1, and dyads (2, 3), (4, 5), (6, 7).
const JANSEN: &str = "0-1 0 0, 1-2 15 0, 2-3 -30 41, 3-0 -38 -8, 1-4 15 0, 4-5 -20 -45, 5-0 -38 -8, 3-6 -78 -5, \
    6-7 -62 -42, 7-5 -20 -45";

/// The four-link group with a closed contour: 4 (D; F, K), rods 6 and 7, slider 10 (M, L; guide), on a crank 3.
const CLOSED_CONTOUR: &str =
    "0-3 -2 5, 3-4 0 5, 4-6 -1 3, 4-7 1 3, 6-9 -0.6 1, 7-9 0.5 1, 0-9 0 0 0 1";

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
    const DYAD: &str = "class II, order 2, dyad RRR";
    let groups = |joints: &[J], wanted: &[&str]| {
        let (m, d) = decomposed(joints);
        assert_eq!(words(&m, &d), wanted);
        laws(&m, &d);
    };
    let dyads = |all: &[&str]| all.iter().map(|d| format!("{d}: {DYAD}")).collect_vec();
    let as_dyads = |joints: &[J], all: &[&str]| {
        let all = dyads(all);
        groups(joints, &all.iter().map(String::as_str).collect_vec());
    };
    as_dyads(&joints_of(FOUR_BAR), &["2+3"]);
    // Norton, Design of Machinery; Artobolevsky: with the crank of the four-bar driving, Stephenson's
    // chain is of class II, driven from the dyad's side of class III.
    as_dyads(&stephenson(), &["2+3", "4+5"]);
    let m = planar_mechanism(&stephenson());
    let d = decompose_groups(&m, &[pair_named(&m, "5-0")]).unwrap();
    assert_eq!(words(&m, &d), ["1+2+3+4: class III, order 3, triad"]);
    laws(&m, &d);
    as_dyads(&watt(), &["2+3", "4+5"]);
    as_dyads(&joints_of(JANSEN), &["2+3", "4+5", "6+7"]);
    // [Bychkov, Dvornikov & Zhukov 2018] and the paper of 2004 they cite: four links in a closed contour, class IV.
    let closed = "4+6+7+9: class IV, order 2, four links in a closed contour";
    groups(&joints_of(CLOSED_CONTOUR), &[closed]);
}

#[test]
fn dyads_have_their_species() {
    for (pairs, species) in [
        ("RRR", 1),
        ("RRP", 2),
        ("PRR", 2),
        ("RPR", 3),
        ("PRP", 4),
        ("PPR", 5),
        ("RPP", 5),
    ] {
        let along = |i: usize, d: &'static str| if &pairs[i..=i] == "P" { d } else { "" };
        let [a, b, c] = [along(0, "1 0"), along(1, "1 2"), along(2, "0 1")];
        let dyad = format!("0-1 0 0, 1-2 0 1 {a}, 2-3 3 3 {b}, 3-0 4 0 {c}");
        let (_, d) = decomposed(&joints_of(&dyad));
        assert_eq!(d.groups[0].class.kind, Kind::Dyad(species), "{pairs}");
    }
}

#[test]
fn the_drive_decides_the_groups() {
    let m = planar_mechanism(&stephenson());
    let found = decompose_alternatives(&m, &m.driven_pairs());
    assert_eq!(found.len(), m.pairs.len());
    let class = |d: &Result<Decomposition, _>| d.as_ref().unwrap().highest_class();
    let classes = found
        .iter()
        .map(|(q, d)| format!("{} {}", m.pairs[*q].name, class(d)));
    // Those at the frame first.
    assert_eq!(
        classes.collect_vec().join(", "),
        "0-1 2, 3-0 2, 5-0 3, 1-2 2, 2-3 2, 2-4 3, 4-5 3"
    );
    for (_, d) in found {
        laws(&m, &d.unwrap());
    }
}

#[test]
fn drives_that_do_not_fit_are_refused_with_names() {
    let m = planar_mechanism(&joints_of(FOUR_BAR));
    let none = decompose_groups(&m, &[]).unwrap_err();
    let (bodies, freedoms) = ("1, 2, 3".into(), 1);
    assert_eq!(none, AssurError::Underconstrained { bodies, freedoms });
    let two = decompose_groups(&m, &[0, 3]).unwrap_err();
    let AssurError::Overconstrained { excess: 1, bodies } = two else {
        panic!("{two}")
    };
    assert_eq!(bodies, "2");
    // A third rod on a parallelogram is redundant in the plane too.
    let m = PlanarMechanism::new(&built_in("parallelogram-3-rods-planar"), StateId::FREE).unwrap();
    assert!(matches!(
        decompose_groups(&m, &m.driven_pairs()),
        Err(AssurError::Overconstrained { excess: 1, .. })
    ));
}

#[test]
fn several_drives_and_drives_between_moving_bodies() {
    // Five-bar with two cranks.
    let mut five = planar_mechanism(&joints_of("0-1 0 0, 1-2 0 1, 2-3 2 3, 3-4 4 1, 4-0 4 0"));
    five.pairs[4].drive = true;
    let d = decompose_groups(&five, &five.driven_pairs()).unwrap();
    assert_eq!(d.driven.len(), 2);
    assert_eq!(words(&five, &d), ["2+3: class II, order 2, dyad RRR"]);
    laws(&five, &d);
    // A boom raised by a cylinder: the cylinder and its rod are one block of the dyad.
    let boom = planar_mechanism(&joints_of("2-3 1 1 1 1, 0-1 0 1, 0-2 0.5 0.5, 3-1 3 3"));
    let d = decompose_groups(&boom, &boom.driven_pairs()).unwrap();
    let group = &d.groups[0];
    assert_eq!(group.class.to_string(), "class II, order 2, dyad RRR");
    let counts = [group.blocks.len(), group.bodies.len(), group.locked.len()];
    assert_eq!(counts, [2, 3, 1]);
    laws(&boom, &d);
}

#[test]
fn a_pin_in_a_slot_is_a_turning_and_a_sliding_pair() {
    let m = PlanarMechanism::new(&built_in("lever-slot-gripper"), StateId::FREE).unwrap();
    assert_eq!(m.bodies.iter().filter(|b| b.link.is_none()).count(), 2);
    let d = decompose_groups(&m, &m.driven_pairs()).unwrap();
    laws(&m, &d);
    assert_eq!(
        d.groups.iter().map(|g| g.class.kind).collect_vec(),
        [Kind::Dyad(3); 2]
    );
}
