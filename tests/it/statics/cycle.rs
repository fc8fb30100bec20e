//! Positions, velocities and accelerations over a cycle.

use super::{file, four_bar_file, mechanism, p, r, shears};
use ozols::model::mechanism::StateId;
use ozols::statics::assur::{Decomposition, decompose};
use ozols::statics::planar::PlanarMechanism;
use ozols::statics::planar_motion::{Instant, Motion};
use ozols::statics::pose::Linkage;

fn linkage(text: &str) -> (Linkage, Decomposition) {
    let planar = PlanarMechanism::new(&mechanism(text), StateId::FREE).unwrap();
    let d = decompose(&planar, &planar.drives()).unwrap();
    (Linkage::new(planar), d)
}

fn turns(n: usize) -> Vec<f64> {
    (0..=n)
        .map(|i| std::f64::consts::TAU * i as f64 / n as f64)
        .collect()
}

/// Greatest gap of any pair's equations, lengths in units of the size.
fn gap(l: &Linkage, d: &Decomposition, now: &Instant) -> f64 {
    let of = |p: usize| {
        let drive = d.drives.iter().position(|&x| x == p).map(|i| now.drives[i]);
        l.gaps(&now.pose, p, drive)
            .into_iter()
            .fold(0.0, |m: f64, g| m.max(g.abs()))
    };
    (0..l.mechanism.pairs.len()).map(of).fold(0.0, f64::max)
}

#[test]
fn shears_go_round_and_their_knives_meet() {
    let (l, d) = linkage(shears());
    let motion = Motion::new(&l, &d, &[std::f64::consts::PI]);
    let (found, dead) = motion.follow(&turns(72));
    assert!(dead.is_none(), "{dead:?}");
    for now in &found {
        assert!(gap(&l, &d, now) < 1e-12);
    }
    // After a whole turn everything is where it was, the crank turned by 2π.
    let (first, last) = (&found[0].pose, &found[72].pose);
    let crank = l
        .mechanism
        .bodies
        .iter()
        .position(|b| b.name == "1")
        .unwrap();
    for b in 0..first.len() {
        let turn = if b == crank {
            std::f64::consts::TAU
        } else {
            0.0
        };
        for (c, extra) in [0.0, 0.0, turn].into_iter().enumerate() {
            assert!((first[b][c] + extra - last[b][c]).abs() < 1e-10);
        }
    }
    let height = |now: &Instant, name: &str| {
        let b = l
            .mechanism
            .bodies
            .iter()
            .position(|b| b.name == name)
            .unwrap();
        now.pose[b][1] - first[b][1]
    };
    let opening: Vec<f64> = found
        .iter()
        .map(|now| height(now, "11") - height(now, "10"))
        .collect();
    let closed = (0..72)
        .min_by(|&a, &b| opening[a].total_cmp(&opening[b]))
        .unwrap();
    assert!((42..=46).contains(&closed), "{closed}");
}

#[test]
fn velocities_and_accelerations_are_the_derivatives() {
    for text in [shears().to_owned(), four_bar_file()] {
        let (l, d) = linkage(&text);
        let speed = 2.0;
        let motion = Motion::new(&l, &d, &[speed]);
        let h = 1e-4;
        for k in 0..12 {
            let s = 0.3 + 0.5 * f64::from(k);
            let (found, dead) = motion.follow(&[s - h, s, s + h]);
            assert!(dead.is_none());
            for b in 0..l.mechanism.bodies.len() {
                for c in 0..3 {
                    let at = |i: usize| found[i].pose[b][c];
                    let dt = h / speed;
                    let (v, a) = (
                        (at(2) - at(0)) / (2.0 * dt),
                        (at(2) - 2.0 * at(1) + at(0)) / (dt * dt),
                    );
                    assert!(
                        (v - found[1].velocity[b][c]).abs() < 1e-6,
                        "{v} {:?}",
                        found[1].velocity[b]
                    );
                    assert!(
                        (a - found[1].acceleration[b][c]).abs() < 1e-4,
                        "{a} {:?}",
                        found[1].acceleration[b]
                    );
                }
            }
        }
    }
}

/// Greatest difference of velocities and accelerations from central differences of the positions, at speed 1.
fn off_by(l: &Linkage, d: &Decomposition, speeds: &[f64], s: f64, h: f64) -> [f64; 2] {
    let motion = Motion::new(l, d, speeds);
    let (found, dead) = motion.follow(&[s - h, s, s + h]);
    assert!(dead.is_none(), "{dead:?}");
    let dt = h / speeds[0];
    let mut worst = [0.0f64; 2];
    for b in 0..l.mechanism.bodies.len() {
        for c in 0..3 {
            let at = |i: usize| found[i].pose[b][c];
            let v = (at(2) - at(0)) / (2.0 * dt) - found[1].velocity[b][c];
            let a = (at(2) - 2.0 * at(1) + at(0)) / (dt * dt) - found[1].acceleration[b][c];
            worst = [worst[0].max(v.abs()), worst[1].max(a.abs())];
        }
    }
    worst
}

/// Sliding drives, drives between moving bodies, pins in slots, two drives at once.
#[test]
fn drives_of_every_kind_move_as_they_should() {
    let boom = [
        p("2", "3", 1.0, 1.0, [1.0, 1.0]),
        r("0", "1", 0.0, 1.0),
        r("0", "2", 0.5, 0.5),
        r("3", "1", 3.0, 2.7),
    ];
    let slider = [
        p("0", "1", 0.0, 0.0, [1.0, 0.5]),
        r("1", "2", 0.0, 1.0),
        r("2", "3", 2.0, 2.5),
        r("3", "0", 3.0, 0.0),
    ];
    let two_slides = [
        r("0", "1", 0.0, 0.0),
        p("1", "2", 1.0, 0.5, [1.0, 0.3]),
        p("2", "3", 2.0, 1.0, [0.2, 1.0]),
        r("3", "0", 3.0, 0.0),
    ];
    for joints in [&boom, &slider, &two_slides] {
        let (l, d) = linkage(&file(joints, ""));
        let [v, a] = off_by(&l, &d, &[1.0], 0.1, 1e-4);
        assert!(v < 1e-6 && a < 1e-5, "{joints:?} {v} {a}");
    }
    let (l, d) = linkage(ozols::builtin::text("lever-slot-gripper").unwrap());
    let [v, a] = off_by(&l, &d, &[0.02], 0.002, 1e-6);
    assert!(v < 1e-6 && a < 1e-3, "{v} {a}");
    let five = file(
        &[
            r("0", "1", 0.0, 0.0),
            r("1", "2", 0.0, 1.0),
            r("2", "3", 2.0, 3.0),
            r("3", "4", 4.0, 1.0),
            r("4", "0", 4.0, 0.0),
        ],
        "",
    );
    let at = five.rfind("drive = false").unwrap();
    let five = five[..at].to_owned() + "drive = true" + &five[at + 13..];
    let (l, d) = linkage(&five);
    assert_eq!(d.drives.len(), 2);
    let [v, a] = off_by(&l, &d, &[1.0, -0.5], 0.3, 1e-4);
    assert!(v < 1e-6 && a < 1e-5, "{v} {a}");
    let (found, _) = Motion::new(&l, &d, &[1.0, -0.5]).follow(&[0.3]);
    assert_eq!(found[0].drives, [0.3, -0.15]);
    assert!((l.drive_position(&found[0].pose, 4) + 0.15).abs() < 1e-12);
}
