//! The grip's contact forces as loads of the mechanism: statics of the clamped state, and ranking under them.

use crate::cli::{json, out, ozols};
use ozols::builtin;
use ozols::file::text::mechanism_from_str;
use ozols::geom::expr::Expr;
use ozols::grip::clamping::{Row, Verdict};
use ozols::grip::jaw_loads::Gripping;
use ozols::model::grip::PartMass;
use ozols::model::loads::Loads;
use ozols::model::mechanism::{Mechanism, StateId};
use ozols::model::ranking::{ClearanceSum, Term};
use ozols::motion::pose::Pose;
use ozols::redundancy::analysis::exact_field;
use ozols::score::elimination::Scratch;
use ozols::score::evaluate::Evaluator;
use ozols::search::request::{Request, Search};
use ozols::statics::reactions::drives::driven;
use ozols::statics::reactions::follow::follow_to;
use ozols::statics::reactions::geometry::{Geometry, cross, dot};
use ozols::statics::reactions::{JointReaction, Reactions, Solution};
use serde_json::Value;
use std::ops::ControlFlow;

fn text() -> &'static str {
    builtin::text("lever-gripper").unwrap()
}

fn built_in() -> Mechanism {
    mechanism_from_str("lever-gripper", text()).unwrap()
}

fn clamped(m: &Mechanism) -> Gripping {
    Gripping::new(m, StateId::new(1)).unwrap().unwrap()
}

fn real(v: &[Expr; 3]) -> [f64; 3] {
    [v[0].to_f64(), v[1].to_f64(), v[2].to_f64()]
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| panic!("{v}"))
}

fn solve(g: &Gripping, row: &Row) -> Solution {
    let (fit, loads) = (g.fit(row).unwrap(), g.loads(row).unwrap());
    let home = Pose::of_file(&g.mechanism, StateId::new(1)).unwrap();
    let geometry = Geometry::new(&g.mechanism, StateId::new(1), &home).unwrap();
    let drives = driven(&g.mechanism, &geometry).unwrap();
    Reactions::at(
        &g.mechanism,
        StateId::new(1),
        &loads,
        &fit.pose,
        fit.drive,
        &drives,
    )
    .unwrap()
}

fn effort(list: &[JointReaction]) -> f64 {
    list.iter().find_map(|r| r.effort).unwrap().1
}

/// `ozols grip` adds up lever moments and rates of the levers; statics solve for every joint.
#[test]
fn the_drive_bears_what_the_grip_asks() {
    let grip = json(&["grip", "lever-gripper", "--format", "json"]);
    for row in grip["diameters"].as_array().unwrap() {
        let asked = number(&row["load"]["drive_effort"]);
        let diameter = (number(&row["diameter"]) * 1e3).round().to_string();
        let run = |more: &[&str]| {
            let args = [
                "statics",
                "lever-gripper",
                "--state",
                "clamped",
                "--format",
                "json",
            ];
            let args: Vec<&str> = args
                .iter()
                .chain(&["--diameter", &diameter])
                .chain(more)
                .copied()
                .collect();
            json(&args)
        };
        let planar = run(&[]);
        let found = planar["positions"][0]["reactions"].as_array().unwrap();
        let force = found.iter().find_map(|r| r["effort"].as_f64()).unwrap();
        assert!(
            (force - asked).abs() < 1e-9 * asked,
            "{diameter}: {force} {asked}"
        );
        assert_eq!(number(&planar["grip"]["drive_effort"]), asked);
        let spatial = run(&["--spatial"]);
        let found = spatial["reactions"].as_array().unwrap();
        let force = found
            .iter()
            .find_map(|r| r["drive"]["effort"].as_f64())
            .unwrap();
        assert!(
            (force - asked).abs() < 1e-9 * asked,
            "{diameter}: {force} {asked}"
        );
        assert!(number(&spatial["residual"]) < 1e-10);
    }
}

/// By virtual work, without moments and arms: the jaws' points are moved with the drive and the forces' work is added up.
#[test]
fn the_contact_forces_do_the_work_of_the_drive_and_no_other() {
    let m = built_in();
    let g = clamped(&m);
    let metres = m.length_unit.metres;
    for row in &g.study.rows {
        let (fit, loads) = (g.fit(row).unwrap(), g.loads(row).unwrap());
        let home = Pose::of_file(&g.mechanism, StateId::new(1)).unwrap();
        let geometry = Geometry::new(&g.mechanism, StateId::new(1), &home).unwrap();
        let drives = driven(&g.mechanism, &geometry).unwrap();
        let h = 1e-3;
        let steps = [-2.0, -1.0, 1.0, 2.0].map(|k| fit.drive + k * h);
        let poses = follow_to(&g.mechanism, StateId::new(1), &drives, &steps)
            .unwrap()
            .poses;
        assert_eq!(poses.len(), 4);
        let work = |pose: &Pose| -> f64 {
            let each = loads.forces.iter().map(|f| {
                let p = real(&f.point);
                let at = [0, 1, 2].map(|i| (p[i] - pose.middle[i]) / pose.length);
                let to = pose.links[f.link]
                    .point(at)
                    .map(|x| x * pose.length * metres);
                dot(real(&f.force), to)
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
    let m = built_in();
    let g = clamped(&m);
    for row in &g.study.rows {
        let (loads, hardest) = (g.loads(row).unwrap(), row.hardest.as_ref().unwrap());
        let fit = g.fit(row).unwrap();
        let mut sum = [0.0; 3];
        let mut turn = [0.0; 3];
        // The gripper's axes are the file's here, from midway between the pivots.
        let centre = row.pose.as_ref().unwrap().centre;
        for f in &loads.forces {
            let force = real(&f.force);
            let p = real(&f.point);
            let pose = &fit.pose;
            let at = [0, 1, 2].map(|i| (p[i] - pose.middle[i]) / pose.length);
            let to = pose.links[f.link].point(at);
            let to = [0, 1, 2].map(|i| (pose.middle[i] + pose.length * to[i]) * 1e-3);
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

fn with_mass(mass: f64) -> Gripping {
    let mut m = built_in();
    let load = m.loads.grip.as_mut().unwrap().load.as_mut().unwrap();
    load.mass = PartMass::Constant(mass);
    clamped(&m)
}

#[test]
fn reactions_are_linear_in_the_payload_and_vanish_with_it() {
    let (one, three, none) = (with_mass(0.7), with_mass(2.1), with_mass(0.0));
    for i in 0..one.study.rows.len() {
        let of = |g: &Gripping| solve(g, &g.study.rows[i]);
        let (a, b, zero) = (of(&one), of(&three), of(&none));
        let greatest = b
            .reactions
            .iter()
            .map(JointReaction::force_size)
            .fold(0.0, f64::max);
        assert!(greatest > 1.0);
        for ((x, y), z) in a.reactions.iter().zip(&b.reactions).zip(&zero.reactions) {
            // The direction of the worst case is searched for, to some digits.
            for k in 0..3 {
                assert!((3.0 * x.force[k] - y.force[k]).abs() < 1e-4 * greatest);
            }
            assert_eq!((z.force, z.moment), ([0.0; 3], [0.0; 3]));
        }
        assert_eq!(effort(&zero.reactions), 0.0);
    }
}

/// Turned and shifted in the file, the gripper's own axes turn along: the same reactions in the joints' frames.
#[test]
fn loads_follow_the_gripper_in_the_files_axes() {
    let before = built_in();
    let mut m = before.clone();
    let turn = [[2.0, -2.0, 1.0], [1.0, 2.0, 2.0], [-2.0, -1.0, 2.0]];
    let turn = turn.map(|r: [f64; 3]| r.map(|x| x / 3.0));
    let by = |v: &[Expr; 3], shift: [f64; 3]| -> [Expr; 3] {
        let v = real(v);
        [0, 1, 2].map(|i| Expr::from_f64(dot(turn[i], v) + shift[i]).unwrap())
    };
    for j in &mut m.joints {
        j.frame.point = by(&j.frame.point, [30.0, -70.0, 20.0]);
        j.frame.axis = by(&j.frame.axis, [0.0; 3]);
        j.frame.reference = by(&j.frame.reference, [0.0; 3]);
    }
    let (a, b) = (clamped(&before), clamped(&m));
    for (x, y) in a.study.rows.iter().zip(&b.study.rows) {
        let (p, q) = (solve(&a, x), solve(&b, y));
        let greatest = p
            .reactions
            .iter()
            .map(JointReaction::force_size)
            .fold(0.0, f64::max);
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

/// Links with masses are pulled as the part is, in the case's direction, without its safety factor.
#[test]
fn links_feel_the_case() {
    let text = text().replace(
        "id = \"3\"\n",
        "id = \"3\"\nmass = 2\ncentre = [-60, 0, 0]\n",
    );
    let pulled = text.replace(
        "[workload.grip]\n",
        "[workload]\ngravity = [0, -9.81, 0]\n[workload.grip]\n",
    );
    let weightless = mechanism_from_str("x", &text).unwrap();
    let heavy = mechanism_from_str("x", &pulled).unwrap();
    let (a, b) = (clamped(&weightless), clamped(&heavy));
    let (row, other) = (&a.study.rows[0], &b.study.rows[0]);
    let pull = row.hardest.as_ref().unwrap().pull;
    let gain = effort(&solve(&b, other).reactions) - effort(&solve(&a, row).reactions);
    // The slider moves along x, and the drive holds it against its weight.
    assert!((gain + 2.0 * pull[0]).abs() < 1e-9, "{gain} {pull:?}");
}

/// Writes a file, runs commands on it, and gives exit code, output and errors.
fn run(text: &str, args: &[&str]) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gripper.toml");
    std::fs::write(&path, text).unwrap();
    let args: Vec<&str> = args
        .iter()
        .map(|a| {
            if *a == "FILE" {
                path.to_str().unwrap()
            } else {
                a
            }
        })
        .collect();
    let o = ozols(&args).output().unwrap();
    let said = |b: Vec<u8>| String::from_utf8(b).unwrap();
    (o.status.code(), said(o.stdout), said(o.stderr))
}

const STATICS: [&str; 4] = ["statics", "FILE", "--state", "clamped"];

/// Files as users write them: what is wrong is refused at its line by every command, what cannot be held is said.
#[test]
fn impossible_grips_are_refused_or_told() {
    let with = |from: &str, to: &str| {
        assert!(text().contains(from), "{from}");
        text().replacen(from, to, 1)
    };
    // Wrong in itself: exit code 2 from all, with the line and what to give.
    for (from, to, line, part) in [
        (
            "density = 7850",
            "density = -7850",
            "density",
            "a number above 0",
        ),
        (
            "density = 7850\npart_length = 120",
            "mass = -1",
            "mass = -1",
            "a number above 0",
        ),
        (
            "id = \"3\"",
            "id = \"3\"\nmass = -2\ncentre = [0, 0, 0]",
            "mass = -2",
            "a number from 0",
        ),
        (
            "prism_angle = 120",
            "prism_angle = 180",
            "prism_angle",
            "at 180 the faces form no V",
        ),
        (
            "prism_angle = 120",
            "prism_angle = \"pi\"",
            "prism_angle",
            "at 180 the faces form no V",
        ),
        (
            "friction = 0.2",
            "friction = -0.2",
            "friction",
            "a coefficient from 0 to 10",
        ),
        ("friction = 0.2", "", "density", "needs friction"),
        (
            "diameter = 40",
            "diameter = -40",
            "diameter = -40",
            "a number above 0",
        ),
        (
            "lever_joints = [\"0-1\", \"0-2\"]\n",
            "",
            "contacts",
            "contacts needs lever_joints",
        ),
        (
            "contacts = [\"1-a far\"",
            "contacts = [\"1-a fat\"",
            "contacts",
            "unknown joint \"1-a fat\"",
        ),
        (
            "contacts = [\"1-a far\", \"1-a near\"",
            "contacts = [\"2-a far\", \"1-a near\"",
            "contacts",
            "turns in the first of lever_joints",
        ),
        (
            "friction = 0.2",
            "friction = 0.2\nlevers = \"independent\"",
            "contacts",
            "one drive for both",
        ),
        (
            "friction = 0.2",
            "friction = 0.2\npivots = \"nominal\"",
            "contacts",
            "pivots = \"fixed\"",
        ),
    ] {
        let text = with(from, to);
        let number = text.lines().position(|l| l.contains(line)).unwrap() + 1;
        for args in [&["grip", "FILE"][..], &STATICS, &["check", "FILE"]] {
            let (code, said, errors) = run(&text, args);
            assert_eq!(
                (code, said.as_str()),
                (Some(2), ""),
                "{to} {args:?}: {errors}"
            );
            assert!(errors.contains(part), "{to} {args:?}: {errors}");
            assert!(errors.contains("gripper.toml:"), "{errors}");
            if line != "contacts" && line != "density" {
                assert!(
                    errors.contains(&format!("gripper.toml:{number}:")),
                    "{to}: {errors}"
                );
            }
        }
    }
    // Cannot be held: a valid file, exit code 1 with the reason.
    for (from, to, part) in [
        (
            "friction = 0.2",
            "friction = 0",
            "slides along its axis (z); faces without friction cannot stop that",
        ),
        (
            "diameters = { from = 30, to = 50, count = 5 }",
            "diameters = [90, 100]",
            "larger than the jaws",
        ),
    ] {
        let text = with(from, to);
        for args in [&["grip", "FILE"][..], &STATICS] {
            let (code, said, errors) = run(&text, args);
            assert_eq!((code, errors.as_str()), (Some(1), ""), "{to} {args:?}");
            assert!(said.contains(part) && said.contains("cannot"), "{said}");
        }
        assert_eq!(run(&text, &["check", "FILE"]).0, Some(0));
        let (code, said, _) = run(
            &text,
            &["statics", "FILE", "--state", "clamped", "--format", "json"],
        );
        assert_eq!(code, Some(1));
        let said: Value = serde_json::from_str(&said).unwrap();
        assert_eq!(said["held"], false);
        // Nothing to rank by.
        let (code, _, errors) = run(&text, &["search", "FILE", "--top", "1"]);
        assert_eq!(code, Some(2));
        assert!(errors.contains("holds none of its parts"), "{errors}");
    }
    // Friction 0 with a pull across the part alone can be held.
    let across = with("friction = 0.2", "friction = 0")
        .replace("any_acceleration = 5\n", "gravity = [-9.81, 0, 0]\n");
    assert_eq!(run(&across, &["grip", "FILE"]).0, Some(0));
    assert_eq!(run(&across, &STATICS).0, Some(0));
    // One of two: what is held is answered, what is not is said.
    let some = with(
        "diameters = { from = 30, to = 50, count = 5 }",
        "diameters = [40, 90]",
    );
    assert_eq!(run(&some, &["grip", "FILE"]).0, Some(1));
    let (code, said, _) = run(&some, &STATICS);
    assert_eq!(code, Some(0));
    assert!(
        said.contains("D = 90 mm cannot be held: larger than the jaws"),
        "{said}"
    );
    let (code, _, _) = run(
        &some,
        &["statics", "FILE", "--state", "clamped", "--diameter", "90"],
    );
    assert_eq!(code, Some(1));
    // Figures that are not those of the joints.
    let off = with("lever_length = 100", "lever_length = 99");
    for args in [&STATICS[..], &["check", "FILE"], &["grip", "FILE"]] {
        let (code, said, errors) = run(&off, args);
        assert_eq!((code, said.as_str()), (Some(2), ""), "{errors}");
        assert!(
            errors.contains("make the joints' points and the figures agree"),
            "{errors}"
        );
    }
    for flag in [
        &["--stroke", "0:1:2"][..],
        &["--diameter", "33"],
        &["--method", "delta"],
        &["--svg", "x"],
    ] {
        let args: Vec<&str> = STATICS.iter().chain(flag).copied().collect();
        assert_eq!(run(text(), &args).0, Some(2), "{flag:?}");
    }
    let (code, _, errors) = run(text(), &["statics", "FILE", "--diameter", "40"]);
    assert_eq!(code, Some(2));
    assert!(errors.contains("no grip loads state free"), "{errors}");
}

#[test]
fn statics_say_which_loads_came_from_the_grip() {
    let said = out(&["statics", "lever-gripper", "--state", "clamped"]);
    for part in [
        "the jaws bear the contact forces of the worst case",
        "D = 50 mm, acceleration 5 m/s² along",
        "safety factor 1.5",
        "1-a far",
        "--spatial takes them",
    ] {
        assert!(said.contains(part), "no {part:?} in: {said}");
    }
    // Empty jaws bear nothing.
    let free = out(&["statics", "lever-gripper"]);
    assert!(free.contains("states no loads"), "{free}");
    let csv = out(&[
        "statics",
        "lever-gripper",
        "--state",
        "clamped",
        "--spatial",
        "--format",
        "csv",
    ]);
    assert!(
        csv.starts_with("kind,joint,type") && !csv.contains("1-a far"),
        "{csv}"
    );
}

fn pool(s: &Search<'_>, n: usize) -> Vec<ozols::search::best::Variant> {
    let d = s.build(&|| false, &mut |_| {});
    let mut out = Vec::new();
    s.cheapest(&d, n, |v| {
        out.push(v);
        ControlFlow::Continue(())
    });
    out
}

/// The slow twin builds each variant as a mechanism, follows it to every part and takes singular values.
#[test]
fn variants_are_scored_by_the_worst_part() {
    let m = built_in();
    for redundant in [0, 1] {
        let request = Request {
            max_redundant: redundant,
            ..Request::default()
        };
        let s = Search::new(exact_field(&m, 0).unwrap(), &m, request).unwrap();
        let e = Evaluator::new(&s, ClearanceSum::Worst).unwrap();
        assert_eq!((e.cases.list.len(), e.cases.free), (5, 0));
        let mut scratch = Scratch::default();
        let mut greatest = 0.0f64;
        for v in pool(&s, 40) {
            let (fast, slow) = (e.scores(&v, &mut scratch), e.slowly(&v));
            let (Ok(fast), Ok(slow)) = (fast, slow) else {
                continue;
            };
            greatest = greatest.max(fast.force.value);
            for t in Term::ALL {
                let (a, b) = (fast.value(t), slow.value(t));
                let near = (a - b).abs() <= 1e-7 * a.abs().max(b.abs()).max(1e-12);
                assert!(near, "{}: {fast:?} {slow:?}", t.name());
            }
        }
        assert!(greatest > 100.0, "{greatest}");
        // The free state has no loads.
        let free = Evaluator::in_states(&s, ClearanceSum::Worst, &[StateId::FREE]).unwrap();
        for v in pool(&s, 3) {
            assert_eq!(free.scores(&v, &mut scratch).unwrap().force.value, 0.0);
        }
        let both = Evaluator::in_states(
            &s,
            ClearanceSum::Worst,
            &[StateId::new(1), StateId::FREE, StateId::new(1)],
        )
        .unwrap();
        assert_eq!((both.cases.list.len(), both.cases.free), (6, 1));
    }
}

#[test]
fn the_ranking_states_its_states() {
    let v = json(&["search", "lever-gripper", "--format", "json"]);
    assert_eq!(v["ranking"]["grip"][0]["state"], "clamped");
    assert_eq!(v["ranking"]["grip"][0]["held"].as_array().unwrap().len(), 5);
    assert!(v["variants"][0]["scores"]["by_cost"].as_u64().unwrap() > 1);
    let said = out(&["search", "lever-gripper"]);
    assert!(
        said.contains("Loads of state clamped from the grip: contact forces of the worst case of 5 parts, D = 30 to 50 mm"),
        "{said}"
    );
    let with = |states: &str| {
        text().replace(
            "order = \"weighted\"",
            &format!("order = \"weighted\"\nstates = {states}"),
        )
    };
    let (code, said, _) = run(&with("[\"free\"]"), &["search", "FILE", "--format", "json"]);
    assert_eq!(code, Some(0));
    let said: Value = serde_json::from_str(&said).unwrap();
    assert_eq!(said["ranking"]["grip"].as_array().unwrap().len(), 0);
    assert_eq!(said["variants"][0]["scores"]["peak-force"], 0.0);
    let (code, _, errors) = run(&with("[\"clampt\"]"), &["search", "FILE"]);
    assert_eq!(code, Some(2));
    assert!(
        errors.contains("clampt") && errors.contains("known: free, clamped"),
        "{errors}"
    );
    // Not a state of the grip.
    let loaded = builtin::text("gripper-10-loaded").unwrap();
    let loaded = loaded.replace(
        "order = \"weighted\"",
        "order = \"weighted\"\nstates = [\"clamped\"]",
    );
    let (code, _, errors) = run(&loaded, &["check", "FILE"]);
    assert_eq!(code, Some(2));
    assert!(
        errors.contains("with the contacts of [workload.grip]"),
        "{errors}"
    );
}

#[test]
fn a_grip_without_load_has_no_forces() {
    let mut m = built_in();
    m.loads = Loads {
        grip: m.loads.grip.clone(),
        ..Loads::default()
    };
    let g = clamped(&m);
    assert!(matches!(
        g.study.rows[0].hardest.as_ref().unwrap().verdict,
        Verdict::Held(_)
    ));
    m.loads.grip.as_mut().unwrap().load = None;
    let g = clamped(&m);
    assert!(g.study.rows.iter().all(|r| g.loads(r).is_none()));
}
