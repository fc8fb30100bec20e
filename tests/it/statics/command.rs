//! `ozols statics` as its users meet it.

use super::{joints_of, planar_file_with};
use crate::common::*;

#[test]
fn bad_loads_are_refused_at_their_line() {
    for [from, to, line, parts] in read_cases::<4>(
        r#"
        mass = 1500 | mass = -1500 | -1500 | mass -1500 & from 0 to 1e12
        mass = 1500 | mass = nan | = nan | mass NaN
        inertia = 900 | inertia = -9 | = -9 | inertia -9
        inertia = 900 | inertia = [1, 2] | [1, 2] | write 3 to 6 values
        mass = 1500\n | # no mass\n | [[link]]  # coupler | link "2" & add mass, in kg
        link = "10"\npoint | link = "12"\npoint | link = "12" | unknown link "12" & known links: 0, 1
        from = "165deg" | from = "16x" | 16x | "16x" & 90deg
        to = "200deg" | to = "20deg" | "20deg" | end of the range
        drive_speed = "30rpm" | drive_speed = "fast" | fast | fast & 60rpm
        drive_speed = "30rpm" | drive_speed = [1, 2] | [1, 2] | 2 drive speeds & 1 allowed
        steps = 72 | steps = 0 | steps = 0 | number of steps 0
        steps = 72 | steps = 72.5 | steps = 72.5 |
        gravity = [0, -9.81, 0] | gravity = [0, -9.81] | -9.81] |
        force = [0, 500000, 0] | force = [0, "5e5 N", 0] | 5e5 N |
        "#,
    ) {
        let text = replace_once(super::shears_text(), from, to);
        let (code, _, said) = run_on("statics", "bad.toml", &text, "");
        assert_eq!(code, Some(2), "{to}: {said}");
        has(&said, &place_of("bad.toml", &text, line));
        parts.split(" & ").for_each(|part| has(&said, part));
    }
}

#[test]
fn mechanisms_without_statics_are_refused_with_a_remedy() {
    assert_all_fail(
        "
        statics bennett --method delta | out of the plane & mode = \"planar\"
        statics parallelogram-3-rods --method delta | 1 more constraints than freedoms & ozols search
        statics four-bar --method delta | no four-link group & --method equilibrium
        statics parallel-shears --stroke 0:90 | FROM:TO:STEPS
        statics parallel-shears --stroke 0:1:0 | FROM:TO:STEPS
        statics parallel-shears --state held | no state held & free
        statics | FILE
        ",
    );
}

#[test]
fn structure_under_every_drive() {
    let v = run_json("statics parallel-shears --groups --format json");
    let drives = v["drives"].list();
    assert_eq!(drives.len(), 16);
    assert!(drives.iter().all(|d| d["class"] == 4));
}

/// A double-rocker driven towards its dead point: the cycle ends there, and says so.
#[test]
fn a_dead_point_ends_the_cycle_with_exit_code_1() {
    let joints = joints_of("0-1 0 0, 1-2 0 2, 2-3 2 2.5, 3-0 3 0");
    let mass = |l: &str| (l == "2").then_some((1.0, [1.0, 2.25], 0.1));
    let text = planar_file_with(&joints, &mass, "[workload]\ngravity = [0, -9.81, 0]\n");
    let (code, v) = answer_on("statics", "rocker.toml", &text, "--stroke 0:180deg:90");
    assert_eq!(code, Some(1));
    // Coupler and rocker in line when the crank's end is as far from the rocker's pivot as both are long.
    let (crank, ground) = (2.0f64, 3.0f64);
    let both = (4.0f64 + 0.25).sqrt() + (1.0f64 + 6.25).sqrt();
    let cosine = (crank * crank + ground * ground - both * both) / (2.0 * crank * ground);
    let expected = cosine.acos() - std::f64::consts::FRAC_PI_2;
    let stopped = &v["stopped"];
    near(stopped["drive"].real(), expected, 1e-6);
    assert_eq!(stopped["group"], 0);
    assert!(stopped["condition"].real() > 1e3);
    assert_eq!(stopped["pose"].list().len(), 4);
}

/// The charts of a group show the forces of the table, in thousands of newtons.
#[test]
fn charts_show_the_forces_of_the_table() {
    let folder = Folder::new();
    let line = "statics parallel-shears --stroke 0:360deg:36 --method equilibrium";
    folder.succeed(&*format!("{line} --svg charts --format csv -o all.csv"));
    let cells = |line: &str| line.split(',').map(str::to_owned).collect_vec();
    let number = |text: &String| text.parse::<f64>().unwrap();
    let chart = folder.text("charts/group-4-6-7-10.csv");
    let drawn = chart.lines().skip(1).map(cells);
    let drawn: Vec<f64> = drawn
        .filter(|c| c[0] == "4-6")
        .map(|c| number(&c[2]))
        .collect();
    let table = folder.text("all.csv");
    let forces = table.lines().skip(1).map(cells).filter(|c| c[2] == "4-6");
    let forces = forces.map(|c| number(&c[7]).hypot(number(&c[8])));
    let forces: Vec<f64> = forces.collect();
    assert_eq!((drawn.len(), forces.len()), (37, 37));
    for (drawn, force) in drawn.into_iter().zip(forces) {
        near(1e3 * drawn, force, 1e-9 * force);
    }
    for file in ["accelerations", "inertia-forces", "drive"] {
        folder.bytes(&format!("charts/{file}.svg"));
    }
}
