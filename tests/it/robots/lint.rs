//! `ozols lint`: what a description holds twice, by line, where on its motion, and how sure that is.

use crate::common::*;
use crate::robots::fix::gripper;
use crate::robots::mjcf::mjcf;
use crate::robots::{folder, legs};

// Each connect of the gripper closes a planar loop of three hinges: its row across the plane is held twice.
#[test]
fn lint_names_each_redundant_row_with_its_line() {
    let (code, out, _) = run_full(&["lint", &gripper(), "--format", "json"]);
    assert_eq!(code, Some(1));
    let v: Value = serde_json::from_str(&out).unwrap();
    let file = &v["files"][0];
    assert_eq!(file["file"], gripper());
    let found: Vec<(&str, &str, u64)> = file["findings"]
        .list()
        .iter()
        .map(|f| (f["constraint"].word(), f["row"].word(), f["line"].whole()))
        .collect();
    assert_eq!(found, [("connect-1", "y", 65), ("connect-2", "y", 66)]);
    assert_eq!(
        file["findings"][0]["duplicates"],
        serde_json::json!([
            "right_crank_joint",
            "right_rocker_joint",
            "right_finger_joint"
        ])
    );
    assert_eq!(file["findings"][0]["assembly"], "force along y");
    // Its coordinates are decimals: what is proven over the motion is so of the geometry that is meant.
    assert_eq!(file["over_motion_kind"], "proven");
    let remedies = file["findings"][0]["remedies"].list();
    assert!(
        remedies[0]
            .word()
            .contains("slide along y: revolute -> cylindrical")
    );
}

#[test]
fn exit_codes_say_what_was_found() {
    // Nothing redundant: 0, and nothing is searched. Not readable: 2.
    let urdf = folder().join("mimic_gripper.urdf");
    let (out, _) = run_successful(&["lint", urdf.to_str().unwrap()]);
    has(&out, "no redundant constraints (σ = 0, W = 1)");
    assert_eq!(run_full("lint nowhere.xml").0, Some(2));
    // Mechanism files have names, too.
    let (code, out, _) = run_full("lint gripper-10");
    assert_eq!(code, Some(1));
    has(&out, "11 redundant constraints");
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
    let (code, out, _) = run_on("lint", "m.xml", &text, "--format json");
    assert_eq!(code, Some(1));
    let v: Value = serde_json::from_str(&out).unwrap();
    let file = &v["files"][0];
    assert_eq!(file["redundant"], 2);
    assert_eq!(file["over_motion_kind"], "pose");
    let rows = file["findings"].list().iter();
    let rows: Vec<&str> = rows.map(|f| f["row"].word()).collect();
    assert_eq!(rows, ["z", "x"]);
    let (_, out, _) = run_on("lint", "m.xml", &text, "");
    has(&out, "elsewhere in the motion 1");
}

// Axes that are parallel but for their last digits: nobody can say whether they are meant to be. No command is offered that
// would be refused.
#[test]
fn lint_does_not_decide_what_digits_leave_open() {
    let text = four_bar(
        ["0 1 0", "2.00003 0 0", "0 0.00002 1"],
        "1.70002 0.3 0.00001",
    );
    let (code, out, _) = run_on("lint", "m.xml", &text, "");
    assert_eq!(code, Some(1));
    has(&out, "0 to 1 redundant constraints (undecided");
    has(&out, "what is redundant is so at this pose");
    assert!(!out.contains("ozols fix"), "{out}");
    let (code, _, told) = run_on("fix", "m.xml", &text, "");
    assert_eq!(code, Some(2));
    has(&told, "undecided");
    has(&told, "--pose");
}

// Text and JSON name one figure, also where digits leave that of the pose open.
#[test]
fn text_and_json_say_the_same_of_the_motion() {
    let texts = [
        four_bar(["1 0 0", "1.5 0 0", "0 0 1"], "2 0 0"),
        four_bar(["1 0 0", "1.500001 0.000003 0", "0 0 1"], "2 0 0"),
        four_bar(
            ["0 1 0", "2.00003 0 0", "0 0.00002 1"],
            "1.70002 0.3 0.00001",
        ),
    ];
    for text in &texts {
        let (_, out, _) = run_on("lint", "m.xml", text, "--format json");
        let v: Value = serde_json::from_str(&out).unwrap();
        let file = &v["files"][0];
        let lasting = file["redundant_over_motion"].whole();
        let over = file["over_motion"].as_str().unwrap_or_default();
        if let Some((_, rest)) = over.split_once("elsewhere in the motion ") {
            assert!(rest.starts_with(&format!("{lasting},")), "{over} {lasting}");
        }
        let (_, out, _) = run_on("lint", "m.xml", text, "");
        assert!(over.is_empty() || out.contains(over), "{out}");
        let most = file["redundant_at_most"].whole();
        let passing = format!("{} of them at this pose only", most - lasting);
        assert_eq!(
            out.contains(&passing),
            lasting > 0 && lasting < most,
            "{out}"
        );
    }
}

// Loops that slide move: the sentence said that none does, and the kind was "rigid".
#[test]
fn loops_that_slide_move() {
    let rods = |lengths: &[[i32; 3]], axis: [i32; 3], scale: i32| {
        let mut text =
            "name = \"rods\"\n[[link]]\nid = \"f\"\nrole = \"frame\"\n[[link]]\nid = \"c\"\nrole = \"output\"\n"
                .to_owned();
        for (n, at) in lengths.iter().enumerate() {
            let at = at.map(|x| x * scale);
            text += &format!(
                "[[joint]]\nid = \"j{n}\"\nlinks = [\"f\", \"c\"]\ntype = \"cylindrical\"\npoint = {at:?}\naxis = {axis:?}\n"
            );
        }
        text
    };
    let pillars = [[0, 0, 0], [3, 0, 0], [0, 4, 1], [5, 7, 2]];
    for (count, axis, scale) in [(2, [1, 2, 2], 1), (3, [0, 0, 1], 80), (4, [2, -1, 5], 1000)] {
        let text = rods(&pillars[..count], axis, scale);
        let (code, out, _) = run_on("lint", "m.toml", &text, "--format json");
        assert_eq!(code, Some(1));
        let v: Value = serde_json::from_str(&out).unwrap();
        let file = &v["files"][0];
        let sigma = 3 + 4 * (count - 2);
        assert_eq!(file["mobility"], 1);
        assert_eq!(file["redundant_over_motion"], sigma);
        assert_eq!(file["over_motion_kind"], "proven");
        let (_, out, _) = run_on("analyze", "m.toml", &text, "");
        lacks(&out, "nothing else does even instantaneously");
    }
    // What cannot move but for a hinge beside the loop is still said to have loops at rest.
    let truss = rods(&pillars[..2], [1, 0, 0], 1)
        .replacen("axis = [1, 0, 0]", "axis = [0, 1, 0]", 1)
        .replace("cylindrical", "revolute");
    let hinge = "[[link]]\nid = \"h\"\n[[joint]]\nid = \"k\"\nlinks = [\"f\", \"h\"]\ntype = \"revolute\"\npoint = [9, 9, 9]\naxis = [0, 0, 1]\n";
    let (_, out, _) = run_on("lint", "m.toml", &(truss + hinge), "--format json");
    let v: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(v["files"][0]["over_motion_kind"], "rigid", "{out}");
}

// Four legs with a loop each, nothing redundant: lint says so, and a search of millions of variants has its answer, the
// mechanism as it is, within a few thousand nodes.
#[test]
fn nothing_redundant_is_said_at_once() {
    let text = legs(4);
    let (code, out, _) = run_on("lint", "m.xml", &text, "");
    assert_eq!(code, Some(0), "{out}");
    has(&out, "no redundant constraints (σ = 0, W = 12)");
    let more = ["--nodes", "20000", "--top", "3", "--allow-output-change"];
    let (code, out, told) = run_on("search", "m.xml", &text, &more);
    assert_eq!(code, Some(0), "{told}");
    has(&out, "none: the original mechanism");
    has(&out, "16,777,216 of 16,777,216 variants have σ = 0");
}

/// A welded pair: nothing can move, and there is no loop.
const WELDED: &str = "<robot name='w'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>";

// Once lost: one file that could not be read took the findings of all the others with it.
#[test]
fn lint_goes_on_over_files_that_cannot_be_looked_at() {
    let at = tempdir().unwrap();
    let put = |name: &str, text: &str| {
        let path = at.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let (bad, welded) = (put("bad.urdf", "<robot"), put("welded.urdf", WELDED));
    let all = ["lint", &bad, "nowhere.xml", &gripper(), &welded];
    let (code, out, err) = run_full(&all);
    assert_eq!(code, Some(2));
    // A colon or a gap of the line that named the file once stood alone before the reason.
    let reason = |file: &str| {
        let before = format!("{file}: not examined: ");
        let line = out.lines().find_map(|l| l.strip_prefix(&before)).unwrap();
        line.to_owned()
    };
    assert!(reason(&bad).starts_with("1:1: syntax error"), "{out}");
    assert!(
        reason("nowhere.xml").starts_with("neither a file nor a built-in mechanism"),
        "{out}"
    );
    has(
        &out,
        &format!("{welded}: no redundant constraints: nothing can move"),
    );
    has(&out, "2 redundant constraints");
    has(&err, "bad.urdf");
    has(&err, "nowhere.xml");
    assert!(!err.contains("welded"), "{err}");
    let (_, out, _) = run_full(&[&all[..], &["--format", "json"]].concat());
    let v: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(v["files"].list().len(), 1);
    assert_eq!(v["passed_over"].list().len(), 3);
}

// Once refused.
#[test]
fn what_cannot_move_has_nothing_redundant() {
    let (code, out, err) = run_on("lint", "w.urdf", WELDED, "");
    assert_eq!((code, err.as_str()), (Some(0), ""));
    has(
        &out,
        "no redundant constraints: nothing can move: all 2 links",
    );
    let v = json_on("lint", "w.urdf", WELDED, "");
    assert_eq!(v["passed_over"][0]["rigid"], true);
    // Where nothing is passed over, there is no word of it.
    let (_, out, _) = run_full(&["lint", &gripper(), "--format", "json"]);
    assert!(!out.contains("passed_over"));
}

// Every command over many files reports each, and does the rest.
#[test]
fn many_files_are_each_reported() {
    let at = tempdir().unwrap();
    let file = at.path().join("some.db");
    let file = file.to_str().unwrap();
    let words = [
        "catalog",
        "search",
        "nosuch",
        "four-bar",
        "nowhere.toml",
        "--ideas",
        "1",
        "-o",
        file,
    ];
    let (code, out, err) = run_full(&words);
    assert_eq!(code, Some(2));
    has(&err, "nosuch is neither");
    has(&err, "nowhere.toml is neither");
    has(&out, "1 mechanisms added");
    let words = [
        "bench",
        "nosuch",
        "four-bar-planar",
        "--quick",
        "--format",
        "csv",
    ];
    let (code, out, err) = run_full(&words);
    assert_eq!(code, Some(2));
    has(&err, "nosuch is neither");
    has(&out, "four-bar-planar");
    let merged = at.path().join("merged.db");
    let words = [
        "catalog",
        "merge",
        "nowhere.db",
        file,
        "-o",
        merged.to_str().unwrap(),
    ];
    let (code, out, err) = run_full(&words);
    assert_eq!(code, Some(2));
    has(&err, "nowhere.db");
    has(&out, "1 structures added");
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
        ("catalog search FILE --ideas 1 -o x.db", &toml),
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
