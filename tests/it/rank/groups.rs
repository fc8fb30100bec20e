//! Groups of displacements by hand, and what does not depend on how a file is written.

use crate::common::*;
use ozols::rank::finite::bonds;

/// A ring of links with these joints: type, point and axis, and lines of more.
fn ring(joints: &[(&str, [i32; 3], [i32; 3], &str)]) -> Mechanism {
    let line = |(kind, point, axis, more): &(&str, [i32; 3], [i32; 3], &str)| {
        format!("{kind} | {} | {} | {more}", commas(point), commas(axis))
    };
    let joints = joints.iter().map(line).collect_vec();
    read(&write_ring("name = \"ring\"", &joints))
}

fn group(m: &Mechanism) -> String {
    let exact = field_of(m, StateId::FREE, 0).unwrap();
    whole_group(&exact, m, StateId::FREE).unwrap().name()
}

#[test]
fn groups_about_one_direction_have_their_names() {
    let (here, there, aside) = ([0, 0, 0], [7, 0, 0], [0, 9, 0]);
    let turn = |at| ("revolute", at, [0, 0, 1], "");
    let screw = |at| ("helical", at, [0, 0, 1], "pitch = 3");
    let slide = ("prismatic", here, [0, 0, 1], "");
    let in_series = "screws of one pitch and slides across them (3)";
    for (joints, name) in [
        (
            &[turn(here), turn([0, 0, 5])][..],
            "the turns about one axis (1)",
        ),
        (&[screw(here), screw([0, 0, 5])], "one screw (1)"),
        (&[screw(here), slide, turn(here)], "a group of dimension 2"),
        (&[turn(here), turn(there), turn(aside)], "one plane (3)"),
        (&[screw(here), screw(there), screw(aside)], in_series),
        (
            &[screw(here), turn(there), turn(aside)],
            "a Schoenflies group (4)",
        ),
    ] {
        assert_eq!(group(&ring(joints)), name, "{joints:?}");
    }
}

fn by_bonds(m: &Mechanism) -> Option<usize> {
    let exact = field_of(m, StateId::FREE, 0).unwrap();
    let closure = Closure::new(&exact, m, StateId::FREE).unwrap();
    bonds::mobility_by_bonds(&exact, m, &closure).unwrap()
}

/// By hand, hinges about one direction: of n in a ring n - 3 move; about one axis n - 1.
#[test]
fn what_moves_inside_a_group_is_counted() {
    let z = [0, 0, 1];
    for n in 3i32..8 {
        let at = |i: i32| [i * i, 3 * i + i * i * i, i];
        let joints: Vec<_> = (0..n).map(|i| ("revolute", at(i), z, "")).collect();
        let moves = usize::try_from(n - 3).unwrap();
        assert_eq!(by_bonds(&ring(&joints)), Some(moves), "{n} in a plane");
        let joints: Vec<_> = (0..n).map(|i| ("revolute", [0, 0, i], z, "")).collect();
        assert_eq!(by_bonds(&ring(&joints)), Some(moves + 2), "{n} on an axis");
    }
}

/// A joint holds the same whichever of its links is named first.
#[test]
fn the_order_of_a_joints_links_does_not_matter() {
    let mut seen = 0;
    for name in ["sarrus", "sarrus-three-legs", "3-crr", "tripteron"] {
        let m = built_in(name);
        let found = by_bonds(&m);
        assert!(found.is_some(), "{name}");
        for turned in 1u32..1 << m.joints.len().min(6) {
            let mut other = m.clone();
            for (i, joint) in other.edit().joints.iter_mut().enumerate() {
                if turned >> (i % 6) & 1 == 1 {
                    joint.links.reverse();
                }
            }
            assert_eq!(by_bonds(&other), found, "{name} {turned:b}");
            seen += 1;
        }
    }
    assert!(seen > 100);
}
