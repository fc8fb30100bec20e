//! What `ozols analyze` says of the drives: which are locked, which work against each other, where the outputs stand still.

use crate::common::*;
use ozols::redundancy::motion::DriveFault;

/// Returns a loop of hinges about z between as many links as there are points, the first of which is the frame.
fn ring(points: &[[i64; 2]], driven: &[usize], output: usize) -> String {
    let n = points.len();
    let links = (0..n).map(|l| format!("{l}{}", if l == output { "*" } else { "" }));
    let line = |(j, [x, y]): (usize, &[i64; 2])| {
        let (next, drive) = ((j + 1) % n, driven.contains(&j));
        format!("j{j} | {j} {next} | revolute | {x}, {y}, 0 | 0, 0, 1 | drive = {drive}")
    };
    let joints = points.iter().enumerate().map(line).join("\n");
    write_mechanism("name = \"ring\"", &links.collect_vec().join(" "), &joints)
}

fn faults(text: &str) -> Vec<DriveFault> {
    let mut all = analyse_states(&read(text), &[StateId::FREE], Method::Auto).unwrap();
    all.remove(0).drives
}

/// Of a crank and a coupler in line, the rocker stands still: a drive there is locked, and with a drive at the crank it is an output at
/// its dead point.
#[test]
fn faults_of_drives_are_found() {
    let open = [[0, 0], [1, 2], [4, 3], [3, 0]];
    let in_line = [[0, 0], [1, 0], [3, 0], [3, 2]];
    let five = [[0, 0], [1, 4], [5, 7], [9, 5], [8, 1]];
    let triangle = [[0, 0], [4, 0], [1, 3]];
    let locked = |text: &str| match faults(text)[..] {
        [DriveFault::Locked(j)] => j.index(),
        ref other => panic!("{other:?}"),
    };
    assert_eq!(faults(&ring(&open, &[0], 3)), []);
    assert_eq!(faults(&ring(&open, &[], 3)), []);
    let surplus = DriveFault::Surplus {
        drives: 2,
        mobility: 1,
    };
    assert_eq!(faults(&ring(&open, &[0, 3], 3)), [surplus]);
    assert_eq!(locked(&ring(&in_line, &[3], 2)), 3);
    assert_eq!(faults(&ring(&in_line, &[0], 3)), [DriveFault::DeadPoint]);
    assert_eq!(faults(&ring(&five, &[0, 4], 2)), []);
    assert_eq!(faults(&ring(&triangle, &[0], 2)), [DriveFault::Immobile]);
    // The other two links in line hold one of the two directions in which the drives move the pin.
    let stretched = [[0, 0], [1, 3], [4, 4], [6, 2], [8, 0]];
    let dependent = DriveFault::Dependent {
        drives: 2,
        independent: 1,
    };
    assert_eq!(faults(&ring(&stretched, &[0, 1], 2)), [dependent]);
}

/// The report says of the drives what the analysis says.
#[test]
fn faults_of_drives_are_in_the_report() {
    let in_line = ring(&[[0, 0], [1, 0], [3, 0], [3, 2]], &[0], 3);
    let (_folder, file) = write_temporary("dead.toml", in_line);
    has(
        &run_quiet(&["report", file]),
        "Dead point: the outputs stand still",
    );
}

/// A drive of a clamped gripper is meant to be locked, and a dead point is no idle motion.
#[test]
fn what_is_meant_is_no_fault() {
    let clamped = run_json("analyze gripper-10 --format json");
    for state in clamped["states"].list() {
        assert_eq!(state["drives"].list().len(), 0, "{}", state["state"]);
    }
    let dead = ring(&[[0, 0], [1, 0], [3, 0], [3, 2]], &[0], 3);
    let found = Folder::with("dead.toml", dead).json("analyze dead.toml");
    let state = &found["states"][0];
    assert_eq!(state["drives"][0]["kind"], "dead-point");
    assert_eq!(state["idle"].list().len(), 0);
}

/// `check` warns of what `analyze` finds, after a verdict that the file is valid.
#[test]
fn check_names_faults_of_drives() {
    let open = [[0, 0], [1, 2], [4, 3], [3, 0]];
    let (code, said, warned) = run_on("check", "ring.toml", &ring(&open, &[0, 3], 3), "");
    assert_eq!(code, Some(0));
    assert!(said.starts_with("ring: valid, "), "{said}");
    has(&warned, "2 drives for 1 degree of freedom");
    let (_, _, warned) = run_on("check", "ring.toml", &ring(&open, &[0], 3), "");
    lacks(&warned, "degree of freedom");
}
