//! `ozols statics` as its users meet it.

use super::{file_with, r};
use crate::common::*;

fn refused(text: &str, line_with: &str, parts: &[&str]) {
    let folder = tempdir().unwrap();
    let path = folder.path().join("bad.toml");
    fs::write(&path, text).unwrap();
    let o = ozols(&["statics", path.to_str().unwrap()])
        .output()
        .unwrap();
    let said = String::from_utf8(o.stderr).unwrap();
    assert_eq!(o.status.code(), Some(2), "{said}");
    for p in parts {
        assert!(said.contains(p), "no {p:?} in: {said}");
    }
    let line = text.lines().position(|l| l.contains(line_with)).unwrap() + 1;
    assert!(
        said.contains(&format!("bad.toml:{line}:")),
        "no line {line} in: {said}"
    );
}

fn shears_with(from: &str, to: &str) -> String {
    let text = super::shears();
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

#[test]
fn bad_loads_are_refused_at_their_line() {
    for (from, to, line, parts) in [
        (
            "mass = 1500",
            "mass = -1500",
            "-1500",
            &["mass -1500", "from 0 to 1e12"][..],
        ),
        ("mass = 1500", "mass = nan", "= nan", &["mass NaN"]),
        ("inertia = 900", "inertia = -9", "= -9", &["inertia -9"]),
        (
            "inertia = 900",
            "inertia = [1, 2]",
            "[1, 2]",
            &["write 3 to 6 values"],
        ),
        ("mass = 1500\n", "# no mass\n", "# no mass", &[]),
        (
            "link = \"10\"\npoint",
            "link = \"12\"\npoint",
            "link = \"12\"",
            &["unknown link \"12\"", "known links: 0, 1"],
        ),
        (
            "from = \"165deg\"",
            "from = \"16x\"",
            "16x",
            &["\"16x\"", "90deg"],
        ),
        (
            "to = \"200deg\"",
            "to = \"20deg\"",
            "\"20deg\"",
            &["end of the range"],
        ),
        (
            "drive_speed = \"30rpm\"",
            "drive_speed = \"fast\"",
            "fast",
            &["fast", "60rpm"],
        ),
        (
            "drive_speed = \"30rpm\"",
            "drive_speed = [1, 2]",
            "[1, 2]",
            &["2 drive speeds", "1 allowed"],
        ),
        (
            "steps = 72",
            "steps = 0",
            "steps = 0",
            &["number of steps 0"],
        ),
        ("steps = 72", "steps = 72.5", "steps = 72.5", &[]),
        (
            "gravity = [0, -9.81, 0]",
            "gravity = [0, -9.81]",
            "-9.81]",
            &[],
        ),
        (
            "force = [0, 500000, 0]",
            "force = [0, \"5e5 N\", 0]",
            "5e5 N",
            &[],
        ),
    ] {
        let text = shears_with(from, to);
        if to.starts_with('#') {
            // The entry of the link is pointed at.
            refused(
                &text,
                "[[link]]  # coupler",
                &["link \"2\"", "add mass, in kg"],
            );
        } else {
            refused(&text, line, parts);
        }
    }
}

#[test]
fn mechanisms_without_statics_are_refused_with_a_remedy() {
    for (args, parts) in [
        (
            &["statics", "bennett", "--method", "delta"][..],
            &["out of the plane", "mode = \"planar\""][..],
        ),
        (
            &["statics", "parallelogram-3-rods", "--method", "delta"],
            &["1 more constraints than freedoms", "ozols search"],
        ),
        (
            &["statics", "four-bar", "--method", "delta"],
            &["no four-link group", "--method equilibrium"],
        ),
        (
            &["statics", "parallel-shears", "--stroke", "0:90"],
            &["FROM:TO:STEPS"],
        ),
        (
            &["statics", "parallel-shears", "--stroke", "0:1:0"],
            &["FROM:TO:STEPS"],
        ),
        (
            &["statics", "parallel-shears", "--state", "held"],
            &["no state held", "free"],
        ),
        (
            &["statics", "four-bar", "--stability", "-o", "/tmp/x"],
            &["no four-link group"],
        ),
        (&["statics"], &["FILE"]),
        (&["statics", "--stability"], &["--output"]),
    ] {
        let o = ozols(args).output().unwrap();
        let said = String::from_utf8(o.stderr).unwrap();
        assert_eq!(o.status.code(), Some(2), "{args:?}: {said}");
        assert!(o.stdout.is_empty());
        for p in parts {
            assert!(said.contains(p), "{args:?}: no {p:?} in: {said}");
        }
    }
}

#[test]
fn text_json_and_csv_tell_the_same() {
    let stroke = ["--stroke", "0:180deg:2"];
    let with =
        |more: &[&'static str]| [&["statics", "parallel-shears"], &stroke[..], more].concat();
    let text = out(&with(&[]));
    assert!(
        text.contains("3 Assur groups driven by 0-1, class IV"),
        "{text}"
    );
    assert!(text.contains("class IV, order 2, four links in a closed contour"));
    assert!(text.contains("D = 3-4, F = 4-6, K = 4-7, M = 6-10, L = 7-10, guide = 0-10"));
    let v = json(&with(&["--format", "json"]));
    assert_eq!(
        (v["class"].as_u64(), v["groups"].as_array().unwrap().len()),
        (Some(4), 3)
    );
    let last = &v["positions"][2];
    assert!((last["drive"].as_f64().unwrap() - PI).abs() < 1e-12);
    let d = |method: &str| {
        last["contour_groups"][0]["methods"][method]["D"][1]
            .as_f64()
            .unwrap()
    };
    assert!(
        (d("delta") / d("equilibrium") - 1.0).abs() < 1e-9
            && (d("projective") / d("delta") - 1.0).abs() < 1e-9
    );
    // The lower knife carries 500 kN down; D holds it up.
    assert!(d("delta") > 5e5 && d("delta") < 5.3e5);
    let csv = out(&with(&["--format", "csv"]));
    let line = csv
        .lines()
        .find(|l| l.starts_with("3.14159") && l.contains(",delta,3-4,"))
        .unwrap();
    assert!(
        (line.split(',').nth(8).unwrap().parse::<f64>().unwrap() / d("delta") - 1.0).abs() < 1e-12
    );
    assert_eq!(csv.lines().count(), 1 + 3 * (16 + 2 * 12));
    let one = out(&with(&["--format", "csv", "--method", "delta"]));
    assert_eq!(one.lines().count(), 1 + 3 * 12);
}

#[test]
fn structure_under_every_drive() {
    let text = out(&["statics", "parallel-shears", "--groups"]);
    assert!(text.contains("class III, order 3, triad"), "{text}");
    let v = json(&["statics", "parallel-shears", "--groups", "--format", "json"]);
    let drives = v["drives"].as_array().unwrap();
    assert_eq!(drives.len(), 16);
    assert!(drives.iter().all(|d| d["class"] == 4));
    // A spatial gripper, seen in its plane.
    let text = out(&["statics", "gripper-10", "--planar"]);
    assert!(
        text.contains("4 Assur groups driven by 0-1, class II") && text.contains("no loads"),
        "{text}"
    );
}

#[test]
fn charts_and_stability_go_to_folders() {
    let folder = tempdir().unwrap();
    let charts = folder.path().join("charts");
    out(&format!(
        "statics parallel-shears --stroke 0:6.28:8 --svg {}",
        charts.display()
    ));
    for name in [
        "group-4-6-7-10.svg",
        "group-5-8-9-11.csv",
        "guide-4-6-7-10.svg",
        "group-2-3.svg",
        "drive.svg",
        "methods.svg",
        "index.html",
    ] {
        assert!(charts.join(name).is_file(), "{name}");
    }
    let stability = folder.path().join("stability");
    let text = out(&["statics", "--stability", "-o", stability.to_str().unwrap()]);
    assert!(
        text.contains("parallel-rods") && text.contains("no-guide-reaction"),
        "{text}"
    );
    for name in [
        "parallel-rods",
        "across-guide",
        "at-delta",
        "no-guide-reaction",
    ] {
        assert!(
            stability.join(format!("stability-{name}.svg")).is_file(),
            "{name}"
        );
    }
}

/// A double-rocker driven towards its dead point: the cycle ends there, and says so.
#[test]
fn a_dead_point_ends_the_cycle_with_exit_code_1() {
    let joints = [
        r("0", "1", 0.0, 0.0),
        r("1", "2", 0.0, 2.0),
        r("2", "3", 2.0, 2.5),
        r("3", "0", 3.0, 0.0),
    ];
    let mass = |l: &str| (l == "2").then_some((1.0, [1.0, 2.25], 0.1));
    let text = file_with(&joints, &mass, "[workload]\ngravity = [0, -9.81, 0]\n");
    let folder = tempdir().unwrap();
    let path = folder.path().join("rocker.toml");
    fs::write(&path, text).unwrap();
    let o = ozols(&format!(
        "statics {} --stroke 0:180deg:90 --format json",
        path.display()
    ))
    .output()
    .unwrap();
    assert_eq!(o.status.code(), Some(1));
    let v: Value = serde_json::from_slice(&o.stdout).unwrap();
    // Coupler and rocker in line when the crank's end is as far from the rocker's pivot as both are long.
    let (crank, ground) = (2.0f64, 3.0f64);
    let both = (4.0f64 + 0.25).sqrt() + (1.0f64 + 6.25).sqrt();
    let cosine = (crank * crank + ground * ground - both * both) / (2.0 * crank * ground);
    let expected = cosine.acos() - std::f64::consts::FRAC_PI_2;
    let stopped = &v["stopped"];
    assert!(
        (stopped["drive"].as_f64().unwrap() - expected).abs() < 1e-6,
        "{stopped} {expected}"
    );
    assert_eq!(stopped["group"], 0);
    assert!(stopped["condition"].as_f64().unwrap() > 1e3);
    assert_eq!(stopped["pose"].as_array().unwrap().len(), 4);
    let text = ozols(&["statics", path.to_str().unwrap(), "--stroke", "0:180deg:90"])
        .output()
        .unwrap();
    assert!(
        String::from_utf8(text.stdout)
            .unwrap()
            .contains("group 2-3 is at a dead point")
    );
}
