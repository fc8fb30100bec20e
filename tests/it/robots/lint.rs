//! `ozols lint`: what a description holds twice, by line, where on its motion, and how sure that is.

use crate::common::*;
use crate::robots::mjcf::mjcf;
use crate::robots::{folder, legs};

/// The exit code of lint and what its JSON has of one file with this text.
pub(crate) fn linted(name: &str, text: impl AsRef<[u8]>) -> (Option<i32>, Value) {
    let (code, out, err) = Folder::with(name, text).run(&["lint", name, "--format", "json"]);
    let v: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{err}"));
    (code, v["files"][0].clone())
}

// Each connect of the gripper closes a planar loop of three hinges: its row across the plane is held twice.
#[test]
fn lint_names_each_redundant_row_with_its_line() {
    let (code, file) = linted("gripper.xml", read_data("robots/gripper.xml"));
    assert_eq!(code, Some(1));
    assert_eq!(file["file"], "gripper.xml");
    let found: Vec<(&str, &str, u64)> = file["findings"]
        .list()
        .iter()
        .map(|f| (f["constraint"].word(), f["row"].word(), f["line"].whole()))
        .collect();
    assert_eq!(found, [("connect-1", "y", 65), ("connect-2", "y", 66)]);
    let first = &file["findings"][0];
    let held = json!([
        "right_crank_joint",
        "right_rocker_joint",
        "right_finger_joint"
    ]);
    assert_eq!(first["duplicates"], held);
    assert_eq!(first["assembly"], "force along y");
    // Its coordinates are decimals: what is proven over the motion is so of the geometry that is meant.
    assert_eq!(file["over_motion_kind"], "proven");
    let remedy = first["remedies"][0].word();
    has(remedy, "slide along y: revolute -> cylindrical");
}

/// A four-bar of hinges at these places, closed by a connect at an anchor of its second link.
fn four_bar(ends: [&str; 3], anchor: &str) -> String {
    let [elbow, other, axis] = ends;
    mjcf(&format!(
        "<worldbody>
        <body name='a'><joint name='j1'/><body name='b' pos='{elbow}'><joint name='j2'/></body></body>
        <body name='c' pos='{other}'><joint name='j3' axis='{axis}'/></body></worldbody>
        <equality><connect name='e' body1='b' body2='c' anchor='{anchor}'/></equality>"
    ))
}

// Of lengths 1, 2, 1.5 and 1.5, with all pins in a line: there the row along the line is held twice, and no further on.
#[test]
fn lint_tells_a_special_pose_from_the_motion() {
    let text = four_bar(["1 0 0", "1.5 0 0", "0 0 1"], "2 0 0");
    let (code, file) = linted("m.xml", &text);
    assert_eq!(code, Some(1));
    assert_eq!(file["redundant"], 2);
    assert_eq!(file["over_motion_kind"], "pose");
    let rows = file["findings"].list().iter().map(|f| f["row"].word());
    assert_eq!(rows.collect_vec(), ["z", "x"]);
    has(file["over_motion"].word(), "elsewhere in the motion 1");
}

/// A four-bar whose axes are parallel but for their last digits.
fn nearly_parallel() -> String {
    let anchor = "1.70002 0.3 0.00001";
    four_bar(["0 1 0", "2.00003 0 0", "0 0.00002 1"], anchor)
}

// Nobody can say whether they are meant to be. No command is offered that would be refused.
#[test]
fn lint_does_not_decide_what_digits_leave_open() {
    let text = nearly_parallel();
    let (code, out, _) = run_on("lint", "m.xml", &text, "");
    assert_eq!(code, Some(1));
    has(&out, "0 to 1 redundant constraints (undecided");
    has(&out, "what is redundant is so at this pose");
    lacks(&out, "ozols fix");
    assert_fails_on("fix", "m.xml", &text, "", "undecided");
    assert_fails_on("fix", "m.xml", &text, "", "--pose");
}

// Loops that slide move: the sentence said that none does, and the kind was "rigid".
#[test]
fn loops_that_slide_move() {
    let rods = |places: &[[i32; 3]], axis: &str, scale: i32| {
        let line = |(n, at): (usize, &[i32; 3])| {
            let at = commas(at.map(|x| x * scale));
            format!("j{n} | f c | cylindrical | {at} | {axis}")
        };
        places.iter().enumerate().map(line).join("\n")
    };
    let head = "name = \"rods\"";
    let pillars = [[0, 0, 0], [3, 0, 0], [0, 4, 1], [5, 7, 2]];
    for (count, axis, scale) in [(2, "1, 2, 2", 1), (3, "0, 0, 1", 80), (4, "2, -1, 5", 1000)] {
        let text = write_mechanism(head, "f c*", &rods(&pillars[..count], axis, scale));
        let (code, file) = linted("m.toml", &text);
        assert_eq!(code, Some(1));
        let sigma = 3 + 4 * (count - 2);
        assert_eq!(file["mobility"], 1);
        assert_eq!(file["redundant_over_motion"], sigma);
        assert_eq!(file["over_motion_kind"], "proven");
        let (_, out, _) = run_on("analyze", "m.toml", &text, "");
        lacks(&out, "nothing else does even instantaneously");
    }
    // What cannot move but for a hinge beside the loop is still said to have loops at rest.
    let truss = "
        j0 | f c | revolute | 0, 0, 0 | 0, 1, 0
        j1 | f c | revolute | 3, 0, 0 | 1, 0, 0
        k | f h | revolute | 9, 9, 9 | 0, 0, 1";
    let (_, file) = linted("m.toml", write_mechanism(head, "f c* h", truss));
    assert_eq!(file["over_motion_kind"], "rigid");
}

// Four legs with a loop each, nothing redundant: lint says so, and a search of millions of variants has its answer, the
// mechanism as it is, within a few thousand nodes.
#[test]
fn nothing_redundant_is_said_at_once() {
    let dir = Folder::with("m.xml", legs(4));
    let (out, _) = dir.succeed("lint m.xml");
    has(&out, "no redundant constraints (σ = 0, W = 12)");
    let (out, _) = dir.succeed("search m.xml --nodes 20000 --top 3 --allow-output-change");
    has(&out, "none: the original mechanism");
    has(&out, "16,777,216 of 16,777,216 variants have σ = 0");
}

/// A welded pair: nothing can move, and there is no loop.
const WELDED: &str = "<robot name='w'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>";

// Once lost: one file that could not be read took the findings of all the others with it.
#[test]
fn lint_goes_on_over_files_that_cannot_be_looked_at() {
    let dir = Folder::with("bad.urdf", "<robot");
    dir.put("welded.urdf", WELDED);
    dir.put("gripper.xml", read_data("robots/gripper.xml"));
    let all = "lint bad.urdf nowhere.xml gripper.xml welded.urdf";
    let (code, out, err) = dir.run(all);
    assert_eq!(code, Some(2));
    // A colon or a gap of the line that named the file once stood alone before the reason.
    for line in [
        "bad.urdf: not examined: 1:1: syntax error",
        "nowhere.xml: not examined: neither a file nor a built-in mechanism",
        "welded.urdf: no redundant constraints: nothing can move",
        "2 redundant constraints",
    ] {
        has(&out, line);
    }
    has(&err, "bad.urdf");
    has(&err, "nowhere.xml");
    lacks(&err, "welded");
    let v = dir.json(all);
    assert_eq!(v["files"].list().len(), 1);
    assert_eq!(v["passed_over"].list().len(), 3);
}

// Once refused.
#[test]
fn what_cannot_move_has_nothing_redundant() {
    let dir = Folder::with("w.urdf", WELDED);
    let (out, err) = dir.succeed("lint w.urdf");
    assert_eq!(err, "");
    let said = "no redundant constraints: nothing can move: all 2 links";
    has(&out, said);
    assert_eq!(dir.json("lint w.urdf")["passed_over"][0]["rigid"], true);
    // Where nothing is passed over, there is no word of it.
    dir.put("gripper.xml", read_data("robots/gripper.xml"));
    let v = dir.json("lint gripper.xml");
    assert_eq!(v.get("passed_over"), None);
}

// Every command over many files reports each, and does the rest.
#[test]
fn many_files_are_each_reported() {
    let dir = Folder::new();
    dir.succeed("catalog build --links 4 --ideas 1 --quiet -o some.db");
    for [line, failed, done] in read_cases::<3>(
        "catalog merge nowhere.db some.db -o merged.db | nowhere.db | 2 structures added",
    ) {
        let (code, out, err) = dir.run(line);
        assert_eq!(code, Some(2), "{line}");
        has(&err, failed);
        has(&out, done);
    }
}

#[cfg(unix)]
#[test]
fn names_of_files_may_be_no_text() {
    use std::ffi::{OsStr, OsString};
    use std::os::unix::ffi::OsStrExt;
    let at = tempdir().unwrap();
    let name = |bytes: &[u8]| OsStr::from_bytes(bytes).to_owned();
    let (toml, urdf) = (name(b"caf\xe9.toml"), name(b"\xff.urdf"));
    let made = name(b"x\xff.toml");
    let four_bar = utf8_text(&run_bytes(&["show".into(), "four-bar".into()], at.path()).stdout);
    fs::write(at.path().join(&toml), four_bar).unwrap();
    fs::copy(folder().join("mimic_gripper.urdf"), at.path().join(&urdf)).unwrap();
    let words = |line: &str, file: &OsString| -> Vec<OsString> {
        let words = line
            .split(' ')
            .map(|w| if w == "FILE" { file.clone() } else { w.into() });
        words.collect()
    };
    for (line, file) in [
        ("new FILE", &made),
        ("check FILE", &made),
        ("check FILE", &toml),
        ("analyze FILE", &toml),
        ("search FILE --top 2", &toml),
        ("draw FILE -o x.svg", &toml),
        ("report FILE -o x.html", &toml),
        ("export FILE --to json", &toml),
        ("analyze FILE", &urdf),
        ("lint FILE", &urdf),
        ("export FILE --to toml", &urdf),
        ("fix FILE", &urdf),
        ("analyze four-bar -o FILE", &toml),
    ] {
        let o = run_bytes(&words(line, file), at.path());
        assert!(o.status.success(), "{line}: {}", utf8_text(&o.stderr));
    }
}

/// Runs the program with words of any bytes.
#[cfg(unix)]
fn run_bytes(words: &[std::ffi::OsString], at: &std::path::Path) -> std::process::Output {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_ozols"));
    command.args(words).current_dir(at).output().unwrap()
}
