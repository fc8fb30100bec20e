//! Singular poses near the ends of a stroke.

use super::stroke_poses::figures;
use crate::common::*;
use ozols::rank::stroke::analysis::StrokeRequest;

/// A singular pose is found wherever the stroke ends: the parallelogram is flat at 90° to either side of the pose of the file.
#[test]
fn singular_poses_near_an_end_are_found() {
    let text = write_mechanism(
        "name = \"parallelogram\"",
        "0 1 2* 3",
        "
        0-1 | 0 1 | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
        1-2 | 1 2 | revolute | 0, 30, 0 | 0, 0, 1
        2-3 | 2 3 | revolute | 100, 30, 0 | 0, 0, 1
        3-0 | 3 0 | revolute | 100, 0, 0 | 0, 0, 1
        ",
    );
    let (_folder, path) = write_temporary("parallelogram.toml", text);
    for (stroke, times) in [
        ("1:1.6:3", 1),
        ("0:-91deg:1", 1),
        ("0:91deg:30", 1),
        ("0:91deg:7", 1),
        ("89deg:170deg:7", 1),
        ("89.5deg:170deg:50", 1),
        ("0:89deg:7", 0),
        ("95deg:170deg:5", 0),
    ] {
        let stroke = format!("--stroke={stroke}");
        let found = run_json(&format!("analyze {} {stroke} --format json", path));
        let changes = found["stroke"]["changes"].list();
        assert_eq!(changes.len(), times, "{stroke}: {changes:?}");
    }
}

/// A slider-crank whose slider drives, in millimetres: crank 30 upright, rod 96. The slider goes from √(96² - 30²) = √8316 out to 126.
fn driven_slider() -> Mechanism {
    let text = write_mechanism(
        "name = \"pump\"\nlength_unit = \"mm\"\nmode = \"planar\"",
        "0 1 2 3*",
        "
        a | 0 1 | revolute | 0, 0, 0 | 0, 0, 1
        b | 1 2 | revolute | 0, 30, 0 | 0, 0, 1
        c | 2 3 | revolute | \"sqrt(8316)\", 0, 0 | 0, 0, 1
        d | 0 3 | prismatic | \"sqrt(8316)\", 0, 0 | 1, 0, 0 | drive = true
        ",
    );
    read(&text)
}

#[test]
fn slides_are_followed_in_the_files_unit_and_end_where_they_must() {
    let m = driven_slider();
    let short = figures(&m, [0.0, 20.0], 5);
    assert_eq!(short.stop, None);
    let at: Vec<f64> = short.poses.iter().map(|p| p.at).collect();
    for (found, wanted) in at.iter().zip([0.0, 4.0, 8.0, 12.0, 16.0, 20.0]) {
        assert!((found - wanted).abs() < 1e-9, "{at:?}");
    }
    let moved = short.poses[5].outputs[0].point[0] - short.poses[0].outputs[0].point[0];
    assert!((moved - 20.0).abs() < 1e-6, "{moved}");
    let stop = figures(&m, [0.0, 60.0], 5).stop.unwrap();
    near(stop.at, 126.0 - 8316f64.sqrt(), 0.01);
}

#[test]
fn angles_over_a_slide_are_refused() {
    use ozols::rank::stroke::request::lengths_where_it_slides;
    let m = driven_slider();
    for (text, well) in [("0:1:5", true), ("0:10deg:5", false), ("0:1rad:5", false)] {
        assert_eq!(
            lengths_where_it_slides(&m, true, text).is_ok(),
            well,
            "{text}"
        );
        assert!(lengths_where_it_slides(&m, false, text).is_ok());
    }
}

/// Crank 30 and rod 96 fold where the slider, on a line 66 from the crank's hinge, comes nearest to it: all three hinges in a line
/// square to the slide, in that pose alone.
#[test]
fn a_pose_that_falls_in_rank_is_told_in_the_files_unit() {
    let text = write_mechanism(
        "name = \"fold\"\nlength_unit = \"mm\"\nmode = \"planar\"",
        "0 1 2 3*",
        "
        a | 0 1 | revolute | 0, 0, 0 | 0, 0, 1
        b | 1 2 | revolute | -24, 18, 0 | 0, 0, 1
        c | 2 3 | revolute | 66, \"18-sqrt(1116)\", 0 | 0, 0, 1
        d | 0 3 | prismatic | 66, \"18-sqrt(1116)\", 0 | 0, 1, 0 | drive = true
        ",
    );
    let found = figures(&read(&text), [0.0, 30.0], 7);
    assert_eq!((found.changes.len(), found.undriven), (1, 0), "{found:?}");
    let change = found.changes[0];
    assert_eq!(change.ranks, [3, 2, 3]);
    let at = 1116f64.sqrt() - 18.0;
    assert!(
        change.between[0] < at && at < change.between[1],
        "{change:?}"
    );
    assert!(change.between[1] - change.between[0] < 0.1, "{change:?}");
}

/// Two drives decide all that a five-bar's output does; one leaves a motion.
#[test]
fn drives_that_are_held_decide_too() {
    let m = built_in("five-bar");
    let pose = Pose::of_file(&m, StateId::FREE).unwrap();
    let drives: Vec<usize> = (0..pose.columns.len())
        .filter(|&c| m.joints[pose.columns[c].joint].drive)
        .collect();
    assert_eq!(drives.len(), 2);
    let undriven = |held: &[usize]| {
        let request = StrokeRequest {
            mechanism: &m,
            state: StateId::FREE,
            pose: pose.clone(),
            drive: drives[0],
            held: held.to_vec(),
            range: [0.0, 0.2],
            steps: 2,
            tolerance: None,
        };
        request.follow_stroke().undriven
    };
    assert_eq!([undriven(&drives[1..]), undriven(&[])], [0, 1]);
}
