//! Poses over a stroke: against closed forms, and as the command shows them.

use crate::common::*;
use crate::statics::{joints_of, planar_file};
use ozols::motion::follow::{Why, stroke_positions};
use ozols::rank::stroke::analysis::{StrokeFigures, StrokeRequest};
use std::f64::consts::FRAC_PI_2;

/// Columns of the file's drives in the free state.
fn drives(m: &Mechanism, pose: &Pose) -> Vec<usize> {
    (0..pose.columns.len())
        .filter(|&c| m.joints[pose.columns[c].joint].drive)
        .collect()
}

pub(super) fn figures(m: &Mechanism, range: [f64; 2], steps: usize) -> StrokeFigures {
    let pose = Pose::of_file(m, StateId::FREE).unwrap();
    let drives = drives(m, &pose);
    let request = StrokeRequest {
        mechanism: m,
        state: StateId::FREE,
        pose,
        drive: drives[0],
        held: drives[1..].to_vec(),
        range,
        steps,
        tolerance: None,
    };
    request.follow_stroke()
}

fn followed(m: &Mechanism, range: [f64; 2], steps: usize) -> (Pose, Vec<Follower>) {
    let pose = Pose::of_file(m, StateId::FREE).unwrap();
    let drives = drives(m, &pose);
    let mut follower = Follower::new(pose.clone(), drives[0], &drives[1..]);
    let reached = stroke_positions(range, steps).map_while(|to| {
        let arrived = follower.advance_to(to, |_| {});
        arrived.is_ok().then(|| follower.clone())
    });
    (pose, reached.collect())
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    sum.sqrt()
}

/// Where rods of lengths `b` and `c` from two points meet, to the left of the way from the first to the second.
fn meet(p: [f64; 2], b: f64, q: [f64; 2], c: f64) -> [f64; 2] {
    let d = distance(&p, &q);
    let along = (b * b - c * c + d * d) / (2.0 * d);
    let across = (b * b - along * along).sqrt();
    let u = [(q[0] - p[0]) / d, (q[1] - p[1]) / d];
    [
        p[0] + along * u[0] - across * u[1],
        p[1] + along * u[1] + across * u[0],
    ]
}

#[test]
fn slider_crank_over_a_turn() {
    let found = figures(&built_in("slider-crank-spatial"), [0.0, TAU], 36);
    assert_eq!(
        (found.poses.len(), found.stop, found.undriven),
        (37, None, 0)
    );
    assert_eq!(found.changes, []);
    for (i, p) in found.poses.iter().enumerate() {
        assert!((p.at - TAU * i as f64 / 36.0).abs() < 1e-14);
        let angle = 40f64.atan2(30.0) + p.at;
        let x = 50.0 * angle.cos() + (104f64.powi(2) - (50.0 * angle.sin()).powi(2)).sqrt();
        assert!(distance(&p.outputs[0].point, &[x, 0.0, 0.0]) < 1e-10);
        assert!(p.outputs[0].turn < 1e-12 && p.gap < 1e-12);
        assert_eq!((p.rank.rank, p.mobility, p.redundant), (3, 1, 3));
    }
}

#[test]
fn four_bar_over_a_turn() {
    let found = figures(&built_in("four-bar"), [-PI, PI], 40);
    assert_eq!((found.poses.len(), found.stop), (41, None));
    let rocker = distance(&[80.0, 90.0], &[120.0, 0.0]);
    for p in &found.poses {
        let angle = FRAC_PI_2 + p.at;
        let pin = [30.0 * angle.cos(), 30.0 * angle.sin()];
        let c = meet(pin, 100.0, [120.0, 0.0], rocker);
        let middle = [(c[0] + 120.0) / 2.0, c[1] / 2.0, 0.0];
        assert!(distance(&p.outputs[0].point, &middle) < 1e-10, "{}", p.at);
        let turn = c[1].atan2(c[0] - 120.0) - 90f64.atan2(-40.0);
        assert!((p.outputs[0].turn - turn.abs()).abs() < 1e-12);
        assert_eq!(p.redundant, 3);
    }
}

/// 3 + 4 > 3 + √10: no link turns fully. The crank stops where coupler and rocker come to lie in line.
#[test]
fn a_four_bar_that_does_not_turn_stops_at_its_dead_points() {
    let m = read(&planar_file(
        &joints_of("0-1 0 0, 1-2 0 3, 2-3 3 3, 3-0 4 0"),
        "",
    ));
    let reach = 3.0 + 10f64.sqrt();
    let limit = ((16.0 + 9.0 - reach * reach) / 24.0).acos();
    for (to, at) in [(TAU, limit - FRAC_PI_2), (-TAU, -limit - FRAC_PI_2)] {
        for steps in [1, 37] {
            let found = figures(&m, [0.0, to], steps);
            let stop = found.stop.unwrap();
            assert_eq!(stop.why, Why::DeadPoint);
            assert!((stop.at - at).abs() < 1e-7, "{} {at}", stop.at);
            assert!(found.poses.len() < 38);
            let last = found.poses.last().unwrap();
            assert!(last.at.abs() <= at.abs());
        }
    }
}

/// tan(θ1/2)·tan(θ2/2) is the same in all poses [Bennett 1903].
#[test]
fn bennett_half_angles() {
    let m = built_in("bennett");
    let (pose, found) = followed(&m, [-3.0, 3.0], 30);
    assert_eq!(found.len(), 31);
    let mut products = Vec::new();
    for f in &found {
        let now = f.current_pose();
        // The pin of joint i, carried by its first link.
        let at = |i: usize| {
            let joint = &m.joints[i];
            pose.carry_point(&now.links, joint.links[0], to_vector(&joint.frame.point))
        };
        let tan = |i: usize| {
            let before = sub(at(i), at((i + 3) % 4));
            let after = sub(at((i + 1) % 4), at(i));
            let t = now.columns[i].twist;
            let sine = dot([t[0], t[1], t[2]], cross(before, after));
            (sine.atan2(dot(before, after)) / 2.0).tan()
        };
        products.push(tan(0) * tan(1));
        assert!((tan(0) * tan(1)).is_finite() && f.closure_gap() < 1e-12);
    }
    for p in &products {
        assert!((p / products[0] - 1.0).abs() < 1e-9, "{products:?}");
    }
}

/// Shafts at an angle with cosine 3/5, the first pin across their plane: tan ψ = 3/5 tan φ.
#[test]
fn hooke_joint_angles() {
    let (_, found) = followed(&built_in("hooke-joint"), [0.0, TAU], 48);
    assert_eq!(found.len(), 49);
    for f in &found {
        let (sine, cosine) = f.drive_position().sin_cos();
        let turn = -f.current_pose().columns[3].moved;
        let (s, c) = turn.sin_cos();
        let wanted = (0.6 * sine).atan2(cosine);
        assert!(distance(&[s, c], &[wanted.sin(), wanted.cos()]) < 1e-12);
    }
    // Once round, not back.
    assert!((found[48].current_pose().columns[3].moved.abs() - TAU).abs() < 1e-12);
}

/// Flat at 180° - 63.43° and 360° - 63.43°; it comes out a parallelogram each time.
#[test]
fn parallelogram_through_its_flat_poses() {
    let m = built_in("parallelogram");
    let first = PI - 2f64.atan();
    for (range, steps) in [([0.0, TAU], 24), ([0.0, TAU], 7), ([0.0, 2.0 * first], 2)] {
        let found = figures(&m, range, steps);
        assert_eq!((found.poses.len(), found.stop), (steps + 1, None));
        for p in &found.poses {
            // The coupler does not turn.
            assert!(p.outputs[0].turn < 1e-7, "{p:?}");
            let angle = 2f64.atan() + p.at;
            let pin = 4500f64.sqrt();
            let middle = [60.0 + pin * angle.cos(), pin * angle.sin(), 0.0];
            assert!(distance(&p.outputs[0].point, &middle) < 1e-5);
        }
        let flat: Vec<f64> = [first, first + PI]
            .into_iter()
            .filter(|x| *x < range[1])
            .collect();
        assert_eq!(found.changes.len(), flat.len(), "{:?}", found.changes);
        for (c, at) in found.changes.iter().zip(flat) {
            assert_eq!(c.ranks, [3, 2, 3]);
            let width = c.between[1] - c.between[0];
            assert!(c.between[0] <= at && at <= c.between[1], "{c:?} {at}");
            assert!(width < 2.1e-6 * range[1], "{c:?}");
        }
    }
    // On the flat pose itself.
    let found = figures(&m, [0.0, 2.0 * first], 2);
    assert_eq!((found.poses[1].rank.rank, found.poses[1].redundant), (2, 4));
}

/// A truss that is only shaky moves nowhere.
#[test]
fn shaky_poses_do_not_move() {
    for name in split_words("jessen-icosahedron octahedron-twisted three-parallel-bars") {
        let found = figures(&built_in(name), [0.0, 1.0], 4);
        let stop = found.stop.unwrap();
        assert_eq!(stop.why, Why::Instantaneous, "{name}");
        assert!(stop.at.abs() < 1e-5, "{name}");
    }
    let found = figures(&built_in("6r-general"), [0.0, 1.0], 4);
    assert_eq!(found.stop.unwrap().why, Why::Locked);
}

/// In the flat pose itself two branches cross, and the drive says nothing about which to take.
#[test]
fn a_flat_parallelogram_does_not_guess() {
    let found = figures(&built_in("parallelogram-flat"), [0.0, 1.0], 4);
    let stop = found.stop.unwrap();
    assert_eq!(stop.why, Why::Singular);
    assert!(stop.at < 1e-6);
    assert_eq!(found.poses.len(), 1);
}

#[test]
fn the_number_of_steps_does_not_matter() {
    for (name, to) in [
        ("four-bar", 2.0),
        ("bennett", 2.0),
        ("slider-crank-determinate", 4.0),
        ("rssr", 0.6),
        ("parallel-shears", TAU),
        ("gripper-10", 0.4),
        ("five-bar", 0.5),
    ] {
        let m = built_in(name);
        let [a, b] = [1, 50].map(|n| figures(&m, [0.0, to], n));
        assert_eq!((a.stop, b.stop), (None, None), "{name}");
        let [a, b] = [a, b].map(|f| f.poses.last().unwrap().clone());
        for (x, y) in a.outputs.iter().zip(&b.outputs) {
            assert!(distance(&x.point, &y.point) < 1e-9, "{name}: {a:?} {b:?}");
            assert!((x.turn - y.turn).abs() < 1e-9);
        }
        assert_eq!(a.rank.rank, b.rank.rank);
        assert!((a.rank.kept / b.rank.kept - 1.0).abs() < 1e-3, "{name}");
    }
}

#[test]
fn a_drive_that_is_named_is_followed() {
    let v = run_json("analyze four-bar --stroke 0:-10deg:9 --drive 3-0 --format json");
    assert_eq!(v["stroke"]["drive"], "3-0");
    assert!((v["stroke"]["to"].real() + 10f64.to_radians()).abs() < 1e-15);
}

#[test]
fn a_stroke_that_stops_is_no_success() {
    let o = run("analyze four-bar --stroke 0:180deg:9 --drive 3-0 --format json");
    assert_eq!(o.status.code(), Some(1));
    let v: Value = serde_json::from_slice(&o.stdout).unwrap();
    assert_eq!(v["stroke"]["stop"]["why"], "dead-point");
}

#[test]
fn bad_strokes_are_refused() {
    assert_all_fail(
        "
        analyze four-bar --stroke 0:1 | FROM:TO:STEPS
        analyze four-bar --stroke 0:1:0 | FROM:TO:STEPS
        analyze four-bar --stroke 0:1:20000 | 10000 steps
        analyze four-bar --stroke 0:1:2 --drive 9-9 | these can move: 0-1, 1-2
        analyze gripper-10 --stroke 0:10deg:2 | slides
        analyze door-two-hinges --stroke 0:1:2 | name the joint that moves
        analyze four-bar --stroke 0:1:2 --method count | auto or svd
        analyze four-bar --drive 0-1 | --stroke
        ",
    );
}
