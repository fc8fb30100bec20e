//! The command: what it writes, says and refuses.

use super::closures::four_bar;
use crate::robots::fix::{gripper, run};
use crate::robots::folder;
use serde_json::Value;
use std::fs;
use std::path::Path;

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).display().to_string()
}

#[test]
fn reports_in_text_and_json() {
    let dir = tempfile::tempdir().unwrap();
    let out = path(dir.path(), "gripper.urdf");
    let (code, text, told) = run(&["convert", &gripper(), "-o", &out]);
    assert_eq!(code, Some(0), "{told}");
    for part in [
        "(urdf): W = 1, σ = 2, the same read again",
        "armature of a joint",
        "left_crank_joint",
        "no word for it there",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let (code, text, _) = run(&["convert", &gripper(), "-o", &out, "--format", "json"]);
    let v: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        (code, v["mobility"].as_u64(), v["redundant"].as_u64()),
        (Some(0), Some(1), Some(2))
    );
    let lost = v["lost"].as_array().unwrap();
    let armature = lost
        .iter()
        .find(|l| l["kind"] == "armature of a joint")
        .unwrap();
    assert_eq!(
        (armature["count"].as_u64(), armature["example"].as_str()),
        (Some(6), Some("left_crank_joint"))
    );
    assert!(v["written"].as_bool().unwrap());
}

#[test]
fn loops_go_into_a_file_beside() {
    let dir = tempfile::tempdir().unwrap();
    let out = path(dir.path(), "five.urdf");
    let (file, side) = ["five_bar.urdf", "five_bar.yaml"]
        .map(|n| path(&folder(), n))
        .into();
    let (code, text, told) = run(&[
        "convert",
        &file,
        "--loops",
        &side,
        "--to",
        "urdf-yaml",
        "-o",
        &out,
    ]);
    assert_eq!(code, Some(0), "{told}");
    let beside = path(dir.path(), "five.yaml");
    assert!(text.contains(&beside), "{text}");
    let yaml = fs::read_to_string(&beside).unwrap();
    assert!(
        yaml.contains("type: [\"6d\"]")
            && yaml.contains("name_mot: [\"drive_left\", \"drive_right\"]"),
        "{yaml}"
    );
    let (code, text, _) = run(&["lint", &out, "--loops", &beside, "--format", "json"]);
    let v: Value = serde_json::from_str(&text).unwrap();
    let f = &v["files"][0];
    assert_eq!(
        (code, f["mobility"].as_u64(), f["redundant"].as_u64()),
        (Some(1), Some(3), Some(3))
    );
}

#[test]
fn auto_tells_what_each_closure_does() {
    let dir = tempfile::tempdir().unwrap();
    let file = path(dir.path(), "four.xml");
    let out = path(dir.path(), "out.xml");
    fs::write(
        &file,
        four_bar("<connect name='pin' body1='rod' body2='rocker' anchor='2 0.5 0'/>"),
    )
    .unwrap();
    let (code, text, told) = run(&["convert", &file, "--closure", "auto", "-o", &out]);
    assert_eq!(code, Some(0), "{told}");
    assert!(
        text.contains("pin closes as line z") && text.contains("σ = 0"),
        "{text}"
    );
    assert!(
        text.contains("two-points") && text.contains("taken"),
        "{text}"
    );
    // Four bars beside one another on the same pins: no closure of the one loop helps the other.
    let rigid = four_bar(
        "<connect name='pin' body1='rod' body2='rocker' anchor='2 0.5 0'/><connect name='again' body1='rod' body2='rocker' anchor='2 0.7 0'/>",
    );
    fs::write(&file, rigid).unwrap();
    fs::remove_file(&out).unwrap();
    let (code, text, _) = run(&["convert", &file, "--closure", "auto", "-o", &out]);
    assert!(!Path::new(&out).exists() || code == Some(0), "{text}");
    // The report for programs says the same.
    let (_, text, _) = run(&[
        "convert",
        &file,
        "--closure",
        "auto",
        "-o",
        &out,
        "--format",
        "json",
    ]);
    let v: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(v["written"].as_bool(), Some(Path::new(&out).exists()));
    assert_eq!(v["closures"].as_array().map(Vec::len), Some(2));
}

#[test]
fn what_cannot_be_done_is_told() {
    let dir = tempfile::tempdir().unwrap();
    let file = path(dir.path(), "g.xml");
    fs::copy(gripper(), &file).unwrap();
    let out = path(dir.path(), "out.urdf");
    let bad = path(dir.path(), "bad.xml");
    fs::write(&bad, "<mujoco><worldbody><body name='a'><joint name='j'/><geom size='x'/><inertial mass='1' pos='0 0'/></body></worldbody></mujoco>").unwrap();
    let none = path(dir.path(), "no/where.urdf");
    for (words, part) in [
        (vec![file.as_str(), "-o", file.as_str()], "is what is read"),
        (vec![&file, "-o", "-"], "name a file"),
        (
            vec![&file, "-o", "out.step"],
            "--to mjcf, sdf, urdf, urdf-yaml, drake",
        ),
        (
            vec![&file, "-o", &out, "--closure", "glue"],
            "--closure glue",
        ),
        (
            vec![&file, "-o", &out, "--closure", "nowhere=hinge"],
            "loop closure \"nowhere\"",
        ),
        (vec![&file, "-o", &none], "there is no folder"),
        (vec![&bad, "-o", &out], "bad.xml:1"),
        (vec!["nothing.xml", "-o", &out], "is not a file"),
    ] {
        let (code, _, told) = run(&[&["convert"], &words[..]].concat());
        assert_eq!(code, Some(2), "{words:?}: {told}");
        assert!(told.contains(part), "{part}: {told}");
        assert!(!Path::new(&out).exists());
    }
    // A YAML file that is read is not written over.
    let (urdf, yaml) = (path(dir.path(), "five.urdf"), path(dir.path(), "out.yaml"));
    fs::copy(folder().join("five_bar.urdf"), &urdf).unwrap();
    fs::copy(folder().join("five_bar.yaml"), &yaml).unwrap();
    let (code, _, told) = run(&[
        "convert",
        &urdf,
        "--loops",
        &yaml,
        "--to",
        "urdf-yaml",
        "-o",
        &out,
    ]);
    assert!(
        code == Some(2) && told.contains("is what is read"),
        "{told}"
    );
}
