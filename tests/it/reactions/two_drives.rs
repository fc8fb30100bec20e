//! Over a stroke further drives move at the ratio of their speeds to the first drive's, slides in the file's unit.

use crate::common::*;

/// A crane: it turns, its boom tilts, and a hook runs along the boom, in millimetres.
fn crane() -> String {
    write_mechanism(
        "name = \"crane\"\nlength_unit = \"mm\"",
        "ground tower boom hook*",
        "
        turn | ground tower | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
        tilt | tower boom | revolute | 0, 0, 2000 | 0, 1, 0 | drive = true
        run | boom hook | prismatic | 3000, 0, 2000 | 1, 0, 0 | drive = true
        ",
    )
}

#[test]
fn drives_move_at_the_ratio_of_their_speeds() {
    let mut m = read(&crane());
    m.edit().loads.drive_speeds = vec![0.5, -0.25, 100.0];
    let drives = driven_freedoms(&m, StateId::FREE);
    assert_eq!(drives.len(), 3);
    let found = follow_to(&m, StateId::FREE, &drives, &[-0.3, 0.2, 0.4]).unwrap();
    assert_eq!(found.stopped, None);
    assert_eq!(found.poses.len(), 3);
    for (at, pose) in &found.poses {
        let moved = |id: &str| {
            let joint = m.joint_named(id).unwrap();
            let column = pose.columns.iter().find(|c| c.joint == joint).unwrap();
            let unit = if id == "run" { pose.length } else { 1.0 };
            column.moved * unit
        };
        // 0.4 rad of the tower at 0.5 rad/s take 0.8 s, in which the boom tilts by 0.2 rad and the hook runs 80 mm.
        for (id, ratio) in [("turn", 1.0), ("tilt", -0.5), ("run", 200.0)] {
            let wanted = ratio * at;
            assert!(
                (moved(id) - wanted).abs() < 1e-9 * (1.0 + wanted.abs()),
                "{id} at {at}: {}",
                moved(id)
            );
        }
    }
}
