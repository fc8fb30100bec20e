//! The clamping force along a motion.

use crate::common::*;
fn along(table: &str) -> Value {
    Folder::with("lift.csv", table).json("grip lever-gripper --motion lift.csv")
}

/// Each step takes what the gripper takes in a case of that acceleration alone.
#[test]
fn every_step_has_its_own_least_force() {
    let table = "time,ax,ay,az,diameter\n0,0,0,0,40\n0.5,5,0,-2,40\n1.0,0,-9,0,50\n1.5,0,0,0,30\n";
    let value = along(table);
    let steps = value["motion"]["steps"].list();
    assert_eq!(steps.len(), 4);
    // The hardest case of the file is harder than any of these at its diameter.
    for step in steps {
        let rows = value["diameters"].list();
        let same = |r: &&Value| (r["diameter"].real() - step["diameter"].real()).abs() < 1e-9;
        let load = &rows.iter().find(same).unwrap()["load"];
        assert_eq!(step["verdict"], "can hold");
        assert!(step["drive_moment_per_lever"].real() < load["drive_moment_per_lever"].real());
        assert!(step["lower_bound"].real() <= step["drive_moment_per_lever"].real());
        // One drive of both levers: force over moment is that of the diameter, whatever the case.
        assert!(step["drive_effort"].real() > 0.0);
    }
    // Falling at nearly g takes nearly nothing; rest of a larger part takes more than of a smaller one.
    let moment = |i: usize| steps[i]["drive_moment_per_lever"].real();
    assert!(moment(2) < 0.2 * moment(0) && moment(3) < moment(0));
    // The step alone, as the one case of a file.
    let file = run_json("grip lever-gripper --format json");
    assert!(file.get("motion").is_some_and(Value::is_null));
    let shown = run_quiet("show lever-gripper");
    let alone = shown.replace("any_acceleration = 5", "accelerations = [[5, 0, -2]]");
    assert_ne!(shown, alone);
    let alone = json_on("grip", "alone.toml", &alone, "");
    let rows = alone["diameters"].list();
    let row = rows
        .iter()
        .find(|r| (r["diameter"].real() - 0.04).abs() < 1e-9)
        .unwrap();
    near(
        row["load"]["drive_moment_per_lever"].real(),
        moment(1),
        1e-9,
    );
    near(
        row["load"]["drive_effort"].real(),
        steps[1]["drive_effort"].real(),
        1e-7,
    );
}

/// The gripper turned over: gravity comes with the step, and the text tells the range of forces.
#[test]
fn attitudes_come_with_the_motion() {
    let table = "ax,ay,az,gx,gy,gz\n0,0,0,0,-9.81,0\n0,0,0,0,0,-9.81\n";
    let (code, said, errors) =
        Folder::with("lift.csv", table).run("grip lever-gripper --motion lift.csv");
    assert_eq!(code, Some(0), "{errors}");
    has(
        &said,
        "Along the motion, 2 steps: can hold at every step, with",
    );
    let value = along(table);
    let moment = |i: usize| value["motion"]["steps"][i]["drive_moment_per_lever"].real();
    // Along the part friction alone holds: harder by much.
    assert!(moment(1) > 1.5 * moment(0), "{} {}", moment(1), moment(0));
}

#[test]
fn tables_that_are_no_motion_are_refused_by_line() {
    for (table, part) in [
        ("ax,ay\n0,0\n", "lift.csv:1: ax, ay and az are needed"),
        ("ax,ay,az,speed\n0,0,0,1\n", "unknown column \"speed\""),
        ("ax,ay,az,gx\n0,0,0,1\n", "gx, gy and gz go together"),
        ("ax,ay,az\n0,0,0\n0,fast,0\n", "lift.csv:3: ay is \"fast\""),
        ("ax,ay,az\n", "0 steps"),
        ("ax,ay,az,diameter\n0,0,0,-3\n", "diameter is \"-3\""),
    ] {
        let folder = Folder::with("lift.csv", table);
        folder.assert_fails("grip lever-gripper --motion lift.csv", part);
    }
}
