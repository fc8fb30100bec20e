//! Singular poses near the ends of a stroke.

use crate::common::json;

/// A singular pose is found wherever the stroke ends: the parallelogram is flat at 90° to either side of the pose of the file.
#[test]
fn singular_poses_near_an_end_are_found() {
    let mut text = "name = \"parallelogram\"\n".to_owned();
    for (id, role) in [
        ("0", "role = \"frame\""),
        ("1", ""),
        ("2", "role = \"output\""),
        ("3", ""),
    ] {
        text += &format!("[[link]]\nid = \"{id}\"\n{role}\n");
    }
    for (id, links, point) in [
        ("0-1", "[\"0\", \"1\"]", "[0, 0, 0]"),
        ("1-2", "[\"1\", \"2\"]", "[0, 30, 0]"),
        ("2-3", "[\"2\", \"3\"]", "[100, 30, 0]"),
        ("3-0", "[\"3\", \"0\"]", "[100, 0, 0]"),
    ] {
        text += &format!(
            "[[joint]]\nid = \"{id}\"\nlinks = {links}\ntype = \"revolute\"\npoint = {point}\naxis = [0, 0, 1]\ndrive = {}\n",
            id == "0-1"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("parallelogram.toml");
    std::fs::write(&path, text).unwrap();
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
        let found = json(&[
            "analyze",
            path.to_str().unwrap(),
            &stroke,
            "--format",
            "json",
        ]);
        let changes = found["stroke"]["changes"].as_array().unwrap();
        assert_eq!(changes.len(), times, "{stroke}: {changes:?}");
    }
}
