//! Positions, velocities and accelerations over a cycle.

use super::{four_bar_file, mechanism, shears};
use ozols::workload::assur::{Decomposition, decompose};
use ozols::workload::planar::PlanarMechanism;
use ozols::workload::planar_motion::{Instant, Motion};
use ozols::workload::pose::Linkage;

fn linkage(text: &str) -> (Linkage, Decomposition) {
    let planar = PlanarMechanism::new(&mechanism(text), 0).unwrap();
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
