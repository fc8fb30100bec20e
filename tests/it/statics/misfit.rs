//! Assembly forces of inaccurate joints, against a twin by displacements: each joint is a spring in its constrained directions, and the
//! links move to where the energy is least. The program uses self-stresses, so the two share no equations.

use crate::catalogue::solve_square;
use crate::common::*;
use ozols::model::loads::{Accuracy, Tolerances};
use ozols::statics::reactions::misfit::{Misfit, misfit, misfit_force};

const TOLERANCES: Tolerances = Tolerances {
    position: 1e-4,
    angle: 1e-3,
};
const LINEAR: f64 = 1e7;
const ANGULAR: f64 = 1e4;

/// The mean and the mean square of the force at each joint of a mechanism of hinges and tubes about z and balls, by displacements of the
/// links.
fn forces_by_displacements(m: &Mechanism, samples: usize) -> Vec<[f64; 2]> {
    let metres = m.length_unit.metres;
    let points: Vec<[f64; 3]> = m
        .joints
        .iter()
        .map(|j| to_vector(&j.frame.point).map(|x| x * metres))
        .collect();
    let (frame, free) = (m.frame_link(), 6 * m.links.len());
    let is_held = |of: &JointType, k: usize| match of {
        JointType::Revolute => k != 2,
        JointType::Cylindrical => k % 3 != 2,
        JointType::Spherical => k > 2,
        other => panic!("{other:?}"),
    };
    // The rows of each joint: how links displace it, turns first.
    let rows: Vec<Vec<(f64, Vec<f64>)>> = m
        .joints
        .iter()
        .zip(&points)
        .map(|(j, p)| {
            (0..6)
                .filter(|k| is_held(&j.joint_type, *k))
                .map(|k| {
                    let mut row = vec![0.0; free];
                    for (link, sign) in [(j.links[0], -1.0), (j.links[1], 1.0)] {
                        let at = 6 * link.index();
                        row[at + k] += sign;
                        // A turn w about the origin moves the point by w × p.
                        let [x, y, z] = *p;
                        let by_turns = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
                        if let Some(axis) = k.checked_sub(3) {
                            for (turn, factor) in by_turns[axis].iter().enumerate() {
                                row[at + turn] += sign * factor;
                            }
                        }
                    }
                    (if k < 3 { ANGULAR } else { LINEAR }, row)
                })
                .collect()
        })
        .collect();
    let mut stiff = vec![vec![0.0; free]; free];
    for (k, row) in rows.iter().flatten() {
        for (a, x) in row.iter().enumerate().filter(|(_, x)| **x != 0.0) {
            for (b, y) in row.iter().enumerate() {
                stiff[a][b] += k * x * y;
            }
        }
    }
    // The frame is held, and motions of the mechanism meet a spring that is too soft to count.
    for (n, row) in stiff.iter_mut().enumerate() {
        row[n] += if n / 6 == frame.index() { 1e12 } else { 1e-3 };
    }
    // By columns as by rows, for it is symmetric.
    let unit = |n: usize| (0..free).map(|k| f64::from(u8::from(k == n))).collect_vec();
    let inverse = (0..free)
        .map(|n| solve_square(&stiff, &unit(n)))
        .collect_vec();
    // The sum of twelve uniform numbers is nearly normal.
    let mut noise = Noise::new(7, 0);
    let mut normal = || (0..12).map(|_| noise.draw_uniform() / 2.0).sum::<f64>();
    let mut sums = vec![[0.0; 2]; points.len()];
    for _ in 0..samples {
        let errors: Vec<Vec<f64>> = rows
            .iter()
            .map(|rows| {
                rows.iter()
                    .map(|(k, _)| {
                        let tolerance = if *k == ANGULAR {
                            TOLERANCES.angle
                        } else {
                            TOLERANCES.position
                        };
                        tolerance / 3.0 * normal()
                    })
                    .collect()
            })
            .collect();
        let mut right = vec![0.0; free];
        for ((k, row), e) in rows.iter().flatten().zip(errors.iter().flatten()) {
            for (b, x) in right.iter_mut().zip(row) {
                *b += k * x * e;
            }
        }
        let moved = inverse
            .iter()
            .map(|row| row.iter().zip(&right).map(|(a, b)| a * b).sum());
        let moved: Vec<f64> = moved.collect();
        for ((sum, rows), errors) in sums.iter_mut().zip(&rows).zip(&errors) {
            let force = rows
                .iter()
                .zip(errors)
                .filter(|((k, _), _)| *k == LINEAR)
                .map(|((k, row), e)| {
                    let strain = row.iter().zip(&moved).map(|(a, b)| a * b).sum::<f64>() - e;
                    (k * strain).powi(2)
                });
            let square = force.sum::<f64>();
            sum[0] += square.sqrt();
            sum[1] += square;
        }
    }
    let average = |s: &[f64; 2]| s.map(|s| s / samples as f64);
    sums.iter().map(average).collect()
}

fn misfit_of(m: &Mechanism) -> Misfit {
    misfit(m, StateId::FREE, &Accuracy::uniform(TOLERANCES), 1).unwrap()
}

#[test]
fn assembly_forces_are_those_of_displacements() {
    for name in ["four-bar", "parallelogram-3-rods"] {
        let m = built_in(name);
        let found = misfit_of(&m);
        let twin = forces_by_displacements(&m, 2_000);
        for (joint, [mean, square]) in found.joints.iter().zip(twin) {
            let near = |x: f64, y: f64| (x - y).abs() < 0.05 * y;
            assert!(
                near(joint.force.mean, mean) && near(joint.force.rms, square.sqrt()),
                "{name}: {joint:?}, {mean}, {square}"
            );
            assert!(joint.force.most > joint.force.mean);
        }
    }
}

/// Every redesign of a four-bar of hinges, tubes and balls that leaves a redundant constraint, against the twin; the others have 0.
#[test]
fn redesigns_are_ranked_by_what_their_assembly_takes() {
    let mut m = built_in("four-bar");
    m.edit().loads.accuracy = Some(Accuracy::uniform(TOLERANCES));
    let request = ozols::Request {
        options: ["revolute", "cylindrical", "spherical"]
            .map(str::to_owned)
            .into(),
        max_redundant: 3,
        rank: vec![(Term::Misfit, 1.0), (Term::Cost, 1e-6)],
        list: ozols::score::request::List::Top(100),
        pose_only: true,
        ..ozols::Request::default()
    };
    let found = ozols::search(&m, &request).unwrap();
    let mut before = 0.0;
    let mut redundant = 0;
    for v in found.variants() {
        let misfit = v.scores().unwrap().term_value(Term::Misfit);
        let built = v.as_mechanism();
        let twin = forces_by_displacements(&built, 600);
        let most = twin.iter().map(|[_, square]| square.sqrt());
        let most = most.fold(0.0, f64::max);
        // A moment may count for more. Soft springs hold the motions of the twin.
        assert!(misfit > 0.88 * most - 1e-3, "{misfit} {most}");
        let mut joints = misfit_of(&built).joints.into_iter();
        if joints.all(|j| j.moment.rms < 1e-3 * most) {
            assert!(misfit < 1.12 * most + 1e-3, "{misfit} {most}");
        }
        assert!(misfit >= before - 1e-4);
        before = misfit;
        redundant += usize::from(v.redundant() > 0);
        assert_eq!(v.redundant() > 0, misfit > 1e-6);
    }
    assert!(redundant > 5, "{redundant}");
}

#[test]
fn the_file_states_how_accurate_its_joints_are() {
    let plain = ozols::builtin::text("gripper-10").unwrap();
    let table = "\n[tolerances]\nfit = \"coarse\"\nangle = \"0.1deg\"\nhand_force = 200\n\n[[tolerances.joint]]\njoint = \"1-2\"\nposition = 0.02\n";
    let (_folder, path) = write_temporary("gripper.toml", plain.to_owned() + table);
    let v = run_json(&["statics", path, "--misfit", "--format", "json"]);
    near(v["tolerances"]["position"].real(), 0.8e-3, 1e-12);
    near(v["tolerances"]["angle"].real(), 0.1_f64.to_radians(), 1e-12);
    near(v["hand_force"].real(), 200.0, 1e-12);
    let own = v["joints"].as_array().unwrap();
    let own = own.iter().find(|j| j["joint"] == "1-2").unwrap();
    let unit = ozols::from_toml(plain).unwrap().length_unit.metres;
    near(own["tolerances"]["position"].real(), 0.02 * unit, 1e-12);
    near(
        own["tolerances"]["angle"].real(),
        0.1_f64.to_radians(),
        1e-12,
    );
    // What is named on the command line is for all joints.
    let named = run_json(&["statics", path, "--misfit", "fine", "--format", "json"]);
    assert!(
        named["joints"]
            .as_array()
            .unwrap()
            .iter()
            .all(|j| j["tolerances"] == named["tolerances"])
    );
    near(named["hand_force"].real(), 200.0, 1e-12);
    // A file without the table has the tolerances fine, and what is written is read again.
    let usual = run_json("statics gripper-10 --misfit --format json");
    let fine = run_json("statics gripper-10 --misfit fine --format json");
    assert_eq!(usual, fine);
    let text = std::fs::read_to_string(path).unwrap();
    let m = ozols::from_toml(&text).unwrap();
    let force = misfit_force(&m, StateId::FREE, m.loads.accuracy.as_ref().unwrap()).unwrap();
    let joints = v["joints"].as_array().unwrap().iter();
    let most = joints.map(|j| j["force"]["rms"].real()).fold(0.0, f64::max);
    assert!(force > most * (1.0 - 1e-9), "{force} {most}");
    for [from, to, parts] in read_cases::<3>(
        r#"
        "coarse" | "tight" | unknown fit "tight" & fine, medium
        hand_force = 200 | hand_force = -1 | -1 & give 0 or a number above it
        joint = "1-2" | joint = "1-9" | 1-9
        position = 0.02 | position = -2 | -2
        "0.1deg" | "100deg" | from 0 to 1 radian
        "#,
    ) {
        let text = replace_once(&(plain.to_owned() + table), from, to);
        for p in parts.split(" & ") {
            assert_fails_on("statics", "bad.toml", &text, "--misfit", p);
        }
    }
}

/// The argument of [Pogrebnyak 2018] for determinate mechanisms, as a number.
#[test]
fn determinate_redesigns_assemble_without_force() {
    let m = built_in("gripper-10");
    let as_built = misfit_of(&m);
    assert!(as_built.force.mean > 10.0, "{:?}", as_built.force);
    assert!(as_built.by_hand < 1.0);
    let best = ozols::search(&m, &ozols::Request::default()).unwrap();
    let best = best.variants().next().unwrap().as_mechanism();
    let redesigned = misfit_of(&best);
    assert!(
        redesigned.force.most < 1e-6 * as_built.force.mean,
        "{:?}",
        redesigned.force
    );
    assert!((redesigned.by_hand - 1.0).abs() < 1e-12);
}
