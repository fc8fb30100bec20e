//! Positions over a cycle.

use super::{four_bar_file, joints_of, planar_file, shears_text};
use crate::common::*;
use ozols::statics::cycle::Statics;
use ozols::statics::planar::PairKind;
use ozols::statics::pose::Pose;

/// Greatest distance of a pair's points on its two bodies, across the guide where it slides, in units of the size.
fn gap(s: &Statics, pose: &Pose) -> f64 {
    let of = |p: usize| {
        let pair = &s.linkage.mechanism.pairs[p];
        let [[ax, ay], [bx, by]] = pair.bodies.map(|b| s.linkage.point_at(pose, b, pair.point));
        let [u, v] = s.linkage.slide_direction(pose, p);
        match pair.kind {
            PairKind::Sliding => (u * (by - ay) - v * (bx - ax)).abs(),
            PairKind::Turning | PairKind::Rigid => (bx - ax).hypot(by - ay),
        }
    };
    let all = (0..s.linkage.mechanism.pairs.len()).map(of);
    all.fold(0.0, f64::max) / s.linkage.size
}

fn over(text: &str, [from, to]: [f64; 2], steps: usize, speeds: &[f64]) -> Statics {
    let mut m = read(text);
    m.edit().loads.drive_speeds = speeds.to_vec();
    let stroke = Some(Stroke { from, to, steps });
    let found = planar_statics(&m, StateId::FREE, stroke).unwrap();
    assert!(found.dead.is_none(), "{:?}", found.dead);
    for x in &found.moments {
        assert!(gap(&found, &x.pose) < 1e-12);
    }
    found
}

#[test]
fn shears_go_round_and_their_knives_meet() {
    let turn = TAU;
    let s = over(shears_text(), [0.0, turn], 72, &[PI]);
    // After a whole turn everything is where it was, the crank turned by 2π.
    let (first, last) = (&s.moments[0].pose, &s.moments[72].pose);
    let body = |name: &str| {
        let mut bodies = s.linkage.mechanism.bodies.iter();
        bodies.position(|b| b.name == name).unwrap()
    };
    for b in 0..first.len() {
        let turned = if b == body("1") { turn } else { 0.0 };
        for (c, extra) in [0.0, 0.0, turned].into_iter().enumerate() {
            assert!((first[b][c] + extra - last[b][c]).abs() < 1e-10);
        }
    }
    let height = |pose: &Pose, name: &str| pose[body(name)][1] - first[body(name)][1];
    let opening = |i: usize| {
        let pose = &s.moments[i].pose;
        height(pose, "11") - height(pose, "10")
    };
    let closed = (0..72)
        .min_by(|&a, &b| opening(a).total_cmp(&opening(b)))
        .unwrap();
    assert!((42..=46).contains(&closed), "{closed}");
}

/// Sliding drives, drives between moving bodies, pins in slots, two drives at once.
#[test]
fn drives_of_every_kind_move_as_they_should() {
    for joints in [
        "2-3 1 1 1 1, 0-1 0 1, 0-2 0.5 0.5, 3-1 3 2.7",
        "0-1 0 0 1 0.5, 1-2 0 1, 2-3 2 2.5, 3-0 3 0",
        "0-1 0 0, 1-2 1 0.5 1 0.3, 2-3 2 1 0.2 1, 3-0 3 0",
    ] {
        over(&planar_file(&joints_of(joints), ""), [0.1, 0.1], 1, &[1.0]);
    }
    over(&four_bar_file(), [0.0, 1.0], 5, &[1.0]);
    let slotted = ozols::builtin::text("lever-slot-gripper").unwrap();
    over(slotted, [2.0, 4.0], 2, &[20.0]);
    let five = planar_file(
        &joints_of("0-1 0 0, 1-2 0 1, 2-3 2 3, 3-4 4 1, 4-0 4 0"),
        "",
    );
    let at = five.rfind("drive = false").unwrap();
    let five = five[..at].to_owned() + "drive = true" + &five[at + 13..];
    let s = over(&five, [0.3, 0.3], 1, &[1.0, -0.5]);
    assert_eq!(s.decomposition.drives.len(), 2);
    for (&d, wanted) in s.decomposition.drives.iter().zip([0.3, -0.15]) {
        let [a, b] = s.linkage.mechanism.pairs[d].bodies;
        let pose = &s.moments[0].pose;
        assert!((pose[b][2] - pose[a][2] - wanted).abs() < 1e-12);
    }
}

/// A drive whose axis is against the normal of the plane goes about the normal all the same.
#[test]
fn drives_turn_about_the_normal() {
    let upright = four_bar_file();
    let against = replace_once(&upright, "axis = [0, 0, 1]", "axis = [0, 0, -1]");
    let [a, b] = [upright, against].map(|text| over(&text, [0.0, 0.5], 2, &[1.0]));
    for (x, y) in a.moments.iter().zip(&b.moments) {
        for (p, q) in x.pose.iter().flatten().zip(y.pose.iter().flatten()) {
            assert!((p - q).abs() < 1e-12);
        }
    }
}

/// With coupler and rocker in a line the crank goes no further.
#[test]
fn at_a_dead_point_there_are_no_speeds() {
    for (beside, dead) in [("1", true), ("1.00000000000001", true), ("1.5", false)] {
        let joints = joints_of(&format!("0-1 0 0, 1-2 0 1, 2-3 2 {beside}, 3-0 4 1"));
        let m = read(&planar_file(&joints, "[workload]\ndrive_speed = 1.0\n"));
        let s = planar_statics(&m, StateId::FREE, None).unwrap();
        assert_eq!((s.moments.is_empty(), s.dead.is_some()), (dead, dead));
        assert!(s.dead.is_none_or(|d| d.group == Some(0)), "{beside}");
    }
}
