//! The grip's contact forces as loads of the mechanism: statics of the clamped state, and ranking under them.

use crate::common::*;
use crate::reactions::{effort, greatest_force};
mod ranked;
mod refused;

use ozols::grip::clamping::DiameterRow;
use ozols::grip::jaw_loads::Gripping;
use ozols::model::loads::Loads;

use ozols::statics::reactions::geometry::{cross, dot};

fn text() -> &'static str {
    builtin::text("lever-gripper").unwrap()
}

fn clamped(m: &Mechanism) -> Gripping {
    Gripping::new(m, StateId::new(1)).unwrap().unwrap()
}

fn solve(g: &Gripping, row: &DiameterRow) -> Solution {
    let (fit, loads) = (g.fit_part(row).unwrap(), g.jaw_loads(row).unwrap());
    let drives = driven_freedoms(&g.mechanism, StateId::new(1));
    Reactions::solve_at(
        &g.mechanism,
        StateId::new(1),
        &loads,
        &fit.pose,
        fit.drive,
        &drives,
    )
    .unwrap()
}

/// `ozols grip` adds up lever moments and rates of the levers; statics solve for every joint.
#[test]
fn the_drive_bears_what_the_grip_asks() {
    let grip = run_json("grip lever-gripper --format json");
    for row in grip["diameters"].list() {
        let asked = row["load"]["drive_effort"].real();
        let diameter = (row["diameter"].real() * 1e3).round().to_string();
        let run = |more: &str| {
            let clamped = "statics lever-gripper --state clamped --format json";
            run_json(&format!("{clamped} --diameter {diameter} {more}"))
        };
        let planar = run("");
        let found = planar["positions"][0]["reactions"].list();
        let force = found.iter().find_map(|r| r["effort"].as_f64()).unwrap();
        assert!(
            (force - asked).abs() < 1e-9 * asked,
            "{diameter}: {force} {asked}"
        );
        assert_eq!(planar["grip"]["drive_effort"].real(), asked);
        let spatial = run("--spatial");
        let found = spatial["reactions"].list();
        let force = found
            .iter()
            .find_map(|r| r["drive"]["effort"].as_f64())
            .unwrap();
        assert!(
            (force - asked).abs() < 1e-9 * asked,
            "{diameter}: {force} {asked}"
        );
        assert!(spatial["residual"].real() < 1e-10);
    }
}

/// By virtual work, without moments and arms: the jaws' points are moved with the drive and the forces' work is added up.
#[test]
fn the_contact_forces_do_the_work_of_the_drive_and_no_other() {
    let m = built_in("lever-gripper");
    let g = clamped(&m);
    let metres = m.length_unit.metres;
    for row in &g.study.rows {
        let (fit, loads) = (g.fit_part(row).unwrap(), g.jaw_loads(row).unwrap());
        let drives = driven_freedoms(&g.mechanism, StateId::new(1));
        let h = 1e-3;
        let steps = [-2.0, -1.0, 1.0, 2.0].map(|k| fit.drive + k * h);
        let poses = follow_to(&g.mechanism, StateId::new(1), &drives, &steps)
            .unwrap()
            .poses;
        assert_eq!(poses.len(), 4);
        let work = |pose: &Pose| -> f64 {
            let each = loads.forces.iter().map(|f| {
                let p = to_vector(&f.point);
                let to = pose.carry_point(&pose.links, f.link, p).map(|x| x * metres);
                dot(to_vector(&f.force), to)
            });
            each.sum()
        };
        let w: Vec<f64> = poses.iter().map(|(_, p)| work(p)).collect();
        let slope = (8.0 * (w[2] - w[1]) - (w[3] - w[0])) / (12.0 * h * metres);
        let s = solve(&g, row);
        let force = effort(&s.reactions);
        assert!(
            (force + slope).abs() < 1e-7 * force.abs(),
            "{force} {slope}"
        );
    }
}

/// What the part puts on the jaws is its weight and inertia, about any point.
#[test]
fn jaws_bear_the_part() {
    let m = built_in("lever-gripper");
    let g = clamped(&m);
    for row in &g.study.rows {
        let (loads, hardest) = (g.jaw_loads(row).unwrap(), row.hardest.as_ref().unwrap());
        let fit = g.fit_part(row).unwrap();
        let mut sum = [0.0; 3];
        let mut turn = [0.0; 3];
        // The gripper's axes are the file's here, from midway between the pivots.
        let centre = row.pose.as_ref().unwrap().centre;
        for f in &loads.forces {
            let force = to_vector(&f.force);
            let p = to_vector(&f.point);
            let pose = &fit.pose;
            let to = pose.carry_point(&pose.links, f.link, p).map(|x| x * 1e-3);
            let arm = [to[0] - centre[0], to[1] - centre[1], to[2]];
            let moment = cross(arm, force);
            for i in 0..3 {
                sum[i] += force[i];
                turn[i] += moment[i];
            }
        }
        let size = dot(hardest.load.force, hardest.load.force).sqrt();
        for i in 0..3 {
            assert!(
                (sum[i] - hardest.load.force[i]).abs() < 1e-6 * size,
                "{sum:?}"
            );
            assert!(
                (turn[i] - hardest.load.moment[i]).abs() < 1e-6 * size * 0.1,
                "{turn:?}"
            );
        }
        let mass = row.mass * 1.5;
        assert!((size - mass * dot(hardest.pull, hardest.pull).sqrt()).abs() < 1e-9 * size);
    }
}

/// Turned and shifted in the file, the gripper's own axes turn along: the same reactions in the joints' frames.
#[test]
fn loads_follow_the_gripper_in_the_files_axes() {
    // A link that weighs, too: it feels the case in the file's axes.
    let before = mechanism_from_str("heavy", &weighed()).unwrap();
    let m = turned_and_moved(&before, [30.0, -70.0, 20.0]);
    let (a, b) = (clamped(&before), clamped(&m));
    for (x, y) in a.study.rows.iter().zip(&b.study.rows) {
        let (p, q) = (solve(&a, x), solve(&b, y));
        let greatest = greatest_force(&p.reactions);
        for (r, s) in p.reactions.iter().zip(&q.reactions) {
            for k in 0..3 {
                assert!(
                    (r.force[k] - s.force[k]).abs() < 1e-8 * greatest,
                    "{r:?} {s:?}"
                );
                assert!((r.moment[k] - s.moment[k]).abs() < 1e-8 * greatest * p.size);
            }
        }
    }
}

/// A hinge is the same whichever of its links is named first.
#[test]
fn levers_turn_the_same_way_whichever_link_is_named_first() {
    let before = built_in("lever-gripper");
    let a = clamped(&before);
    let hinges = |m: &Mechanism| -> Vec<_> {
        let all = m.joint_ids();
        all.filter(|&j| m.joints[j].joint_type.name() == "revolute")
            .collect()
    };
    for joint in hinges(&before) {
        let mut m = before.clone();
        m.edit().joints[joint].links.reverse();
        let b = clamped(&m);
        for (x, y) in a.study.rows.iter().zip(&b.study.rows) {
            let (one, other) = (
                effort(&solve(&a, x).reactions),
                effort(&solve(&b, y).reactions),
            );
            assert!((one - other).abs() < 1e-7 * one.abs(), "{one} {other}");
        }
    }
}

/// The slider with a mass, under gravity.
fn weighed() -> String {
    let heavy = "id = \"3\"\nmass = 2\ncentre = [-60, 0, 0]\n";
    let pulled = "[workload]\ngravity = [0, -9.81, 0]\n[workload.grip]\n";
    text()
        .replace("id = \"3\"\n", heavy)
        .replace("[workload.grip]\n", pulled)
}

/// Links with masses are pulled as the part is, in the case's direction, without its safety factor.
#[test]
fn links_feel_the_case() {
    let weightless = weighed().replace("gravity = [0, -9.81, 0]", "");
    let weightless = mechanism_from_str("x", &weightless).unwrap();
    let heavy = mechanism_from_str("x", &weighed()).unwrap();
    let (a, b) = (clamped(&weightless), clamped(&heavy));
    let (row, other) = (&a.study.rows[0], &b.study.rows[0]);
    let pull = row.hardest.as_ref().unwrap().pull;
    let gain = effort(&solve(&b, other).reactions) - effort(&solve(&a, row).reactions);
    // The slider moves along x, and the drive holds it against its weight.
    assert!((gain + 2.0 * pull[0]).abs() < 1e-9, "{gain} {pull:?}");
}

#[test]
fn a_grip_without_load_has_no_forces() {
    let mut m = built_in("lever-gripper");
    m.edit().loads = default_with(|l: &mut Loads| l.grip = m.loads.grip.clone());
    let g = clamped(&m);
    assert!(matches!(
        g.study.rows[0].hardest.as_ref().unwrap().verdict,
        Ok(HoldingOutcome::Held(_))
    ));
    m.edit().loads.grip.as_mut().unwrap().load = None;
    let g = clamped(&m);
    assert!(g.study.rows.iter().all(|r| g.jaw_loads(r).is_none()));
}
