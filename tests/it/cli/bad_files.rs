//! What is wrong with a mechanism file is said with its line, the item and the remedy.

use super::{four_bar, refused};
use crate::common::written;
use std::fs;

/// Asserts that a file is refused at the line where `line_with` first stands, with these words.
pub(super) fn bad_file(name: &str, content: &str, line_with: &str, parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    for command in ["check", "analyze", "search"] {
        let said = refused(&[command, path.to_str().unwrap()], parts);
        assert!(said.contains(name), "{said}");
        let line = content.lines().position(|l| l.contains(line_with)).unwrap() + 1;
        assert!(
            said.contains(&format!("{name}:{line}:")),
            "no line {line} in: {said}"
        );
    }
}

/// The four-bar with one text replaced, which must be there.
pub(super) fn with(from: &str, to: &str) -> String {
    let text = four_bar();
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

// What can be wrong with a file.

#[test]
fn error_unknown_link() {
    bad_file(
        "bad.toml",
        &with("[\"2\", \"3\"]", "[\"2\", \"zz\"]"),
        "zz",
        &["unknown link \"zz\"", "known links: 0, 1, 2, 3"],
    );
}

#[test]
fn error_duplicate_ids() {
    let text = with("id = \"2-3\"", "id = \"1-2\"  # again");
    bad_file(
        "bad.toml",
        &text,
        "# again",
        &["joint has the id \"1-2\" twice"],
    );
    let text = with("id = \"3\"", "id = \"2\"  # again");
    bad_file(
        "bad.toml",
        &text,
        "# again",
        &["link has the id \"2\" twice"],
    );
}

#[test]
fn error_missing_fields() {
    bad_file(
        "bad.toml",
        "name = \"x\"\n[[link]]\nid = \"0\"\n[[link]] # nameless\nrole = \"frame\"\n",
        "# nameless",
        &["missing field `id`", "give it a name of its own"],
    );
    bad_file(
        "bad.json",
        "{\"name\": \"x\",\n\"link\": [{\"role\": \"frame\"}]}",
        "link",
        &["missing field `id`", "give it a name of its own"],
    );
}

#[test]
fn error_more_than_one_image() {
    for way in ["mirror", "turn"] {
        let twice = format!("{way} = [[\"0-1\", \"1-2\"], [\"1-2\", \"2-3\"]] # twice");
        let text = with("[search]", &format!("[search]\n{twice}"));
        let said = format!("joint \"1-2\" has more than one image under {way}");
        let parts = [said.as_str(), "name each joint once there"];
        bad_file("bad.toml", &text, "# twice", &parts);
    }
}

#[test]
fn error_empty_id() {
    bad_file(
        "bad.toml",
        &with("id = \"2-3\"", "id = \"\""),
        "id = \"\"",
        &["1 to 64 characters"],
    );
}

#[test]
fn error_self_loop() {
    bad_file(
        "bad.toml",
        &with("[\"2\", \"3\"]", "[\"2\", \"2\"]"),
        "[\"2\", \"2\"]",
        &["\"2-3\" connects link \"2\" to itself"],
    );
}

#[test]
fn error_disconnected() {
    let joint = "[[link]]\nid = \"p\"\n\n[[link]]\nid = \"q\"\n\n[[joint]]\nid = \"p-q\"\nlinks = [\"p\", \"q\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n\n[[contour]]";
    bad_file(
        "bad.toml",
        &with("[[contour]]", joint),
        "id = \"p\"",
        &["link \"p\" is not connected to the frame", "free", "\"q\""],
    );
}

#[test]
fn error_unused_link() {
    bad_file(
        "bad.toml",
        &with("[[joint]]", "[[link]]\nid = \"lone\"\n\n[[joint]]"),
        "lone",
        &["link \"lone\" has no joint"],
    );
}

#[test]
fn error_zero_axis() {
    bad_file(
        "bad.toml",
        &with("axis = [0, 0, 1]", "axis = [0, 0, 0.0]"),
        "0, 0.0]",
        &["axis of joint \"0-1\" is zero"],
    );
}

#[test]
fn error_parallel_reference() {
    let text = with(
        "axis = [0, 0, 1]",
        "axis = [0, 0, 1]\nreference = [0, 0, -2]",
    );
    bad_file(
        "bad.toml",
        &text,
        "reference =",
        &["reference of joint \"0-1\" is parallel"],
    );
}

#[test]
fn error_coordinates() {
    for (word, part) in [
        ("nan", "finite"),
        ("inf", "finite"),
        ("1e308", "out of range"),
        ("1e-100", "out of range"),
        ("\"sqrt(-1)\"", "square root of a negative number"),
        ("\"1/0\"", "division by zero"),
        ("\"tan(90deg)\"", ""),
        ("\"sqr(2)\"", "unknown word `sqr`"),
        ("\"\"", "empty"),
    ] {
        let text = with("[80, 90, 0]", &format!("[80, {word}, 0]"));
        bad_file("bad.toml", &text, "[80, ", &[part]);
    }
}

#[test]
fn error_parameters() {
    let text = with("[80, 90, 0]", "[\"width\", 90, 0]");
    let number = "expected a number, or an expression in quotes";
    for (parameters, line_with, part) in [
        ("width = 80\npi = 3", "pi = 3", "can be named \"pi\""),
        ("width = 80\n\"2a\" = 3", "2a", "can be named \"2a\""),
        ("width = 80\nidle = 3", "idle = 3", "nothing depends on"),
        ("width = true", "width = ", number),
        ("width = { range = [70, 90] }", "width = ", number),
        ("width = \"1/0\"", "width = ", "division by zero"),
        ("wide = 80", "\"width\"", "and the parameters wide"),
    ] {
        let text = format!("{text}\n[parameter]\n{parameters}\n");
        bad_file("bad.toml", &text, line_with, &[part]);
    }
}

/// A parameter is what its number is in its place.
#[test]
fn a_parameter_stands_for_its_number() {
    let text = with("[80, 90, 0]", "[\"2*width\", 90, 0]") + "\n[parameter]\nwidth = 40\n";
    let points = |text: &str| {
        let m = ozols::from_toml(text).unwrap();
        let one = |j: &ozols::model::mechanism::Joint| j.frame.point.each_ref().map(|x| x.to_f64());
        m.joints.iter().map(one).collect::<Vec<_>>()
    };
    assert_eq!(points(&text), points(&four_bar()));
}

#[test]
fn error_coordinate_overflow() {
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, 99999999999999999999, 0]"),
        "[80, ",
        &[],
    );
}

#[test]
fn error_unknown_type() {
    let text = with("type = \"revolute\"", "type = \"hinge\"");
    let parts = [
        "unknown joint type \"hinge\"",
        "revolute, prismatic, helical, cylindrical, universal",
        "spherical",
        "custom",
    ];
    bad_file("bad.toml", &text, "hinge\"", &parts);
}

#[test]
fn error_other_words() {
    bad_file(
        "bad.toml",
        &with("\"mm\"", "\"furlong\""),
        "furlong",
        &["unknown length unit \"furlong\"", "m, mm, cm, um, in"],
    );
    bad_file(
        "bad.toml",
        &with("role = \"output\"", "role = \"tool\""),
        "\"tool\"",
        &["unknown role \"tool\"", "frame, output, object"],
    );
    let text = with("length_unit", "mode = \"flat\"\nlength_unit");
    bad_file(
        "bad.toml",
        &text,
        "\"flat\"",
        &["unknown mode \"flat\"", "spatial, planar"],
    );
}

#[test]
fn error_option_loses_motion() {
    let text = with("drive = true", "options = [\"revolute\", \"prismatic\"]");
    bad_file(
        "bad.toml",
        &text,
        "\"prismatic\"",
        &["option \"prismatic\" of joint \"0-1\"", "present revolute"],
    );
}

#[test]
fn error_no_frame() {
    bad_file(
        "bad.toml",
        &with("role = \"frame\"", ""),
        "[[link]]",
        &["no link has the role \"frame\""],
    );
}

#[test]
fn error_second_frame() {
    bad_file(
        "bad.toml",
        &with("role = \"output\"", "role = \"frame\" # 2"),
        "# 2",
        &["link \"3\" is a second frame after \"0\""],
    );
}

#[test]
fn error_open_contour() {
    let text = with(
        "\"0-1\", \"1-2\", \"2-3\", \"3-0\"",
        "\"0-1\", \"1-2\", \"2-3\"",
    );
    bad_file("bad.toml", &text, "joints = [", &["closed walk"]);
}

#[test]
fn error_unknown_joint_in_contour() {
    let text = with("\"2-3\", \"3-0\"", "\"2-3\", \"9-9\"");
    bad_file(
        "bad.toml",
        &text,
        "9-9",
        &["unknown joint \"9-9\"", "0-1, 1-2, 2-3, 3-0"],
    );
}

#[test]
fn error_toml_syntax() {
    bad_file(
        "bad.toml",
        &with("id = \"2-3\"", "id = = \"2-3\""),
        "= =",
        &[],
    );
}

#[test]
fn error_unknown_key() {
    bad_file(
        "bad.toml",
        &with("drive = true", "driven = true"),
        "driven",
        &["driven"],
    );
}

#[test]
fn error_wrong_type() {
    bad_file(
        "bad.toml",
        &with("drive = true", "drive = 7"),
        "drive = 7",
        &["true, false or the freedom that is driven"],
    );
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, 90]"),
        "[80, 90]",
        &[],
    );
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, true, 0]"),
        "[80, true, 0]",
        &["expected a number"],
    );
}

#[test]
fn error_all_at_once() {
    let text = with("[\"2\", \"3\"]", "[\"2\", \"zz\"]").replacen(
        "type = \"revolute\"",
        "type = \"hinge\"",
        1,
    );
    bad_file(
        "bad.toml",
        &text,
        "hinge\"",
        &["unknown link \"zz\"", "unknown joint type \"hinge\""],
    );
}

// Once wrong: a nonzero value that underflows to 0.0 as f64 passes the range check.
#[test]
fn error_coordinate_underflow() {
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, \"1e-9^60\", 0]"),
        "[80, ",
        &["out of range"],
    );
}

// BUG (toml through the untagged Coordinate): "invalid type: integer `...` as i128, expected any value".
#[test]
fn error_coordinate_overflow_in_words() {
    bad_file(
        "bad.toml",
        &with("[80, 90, 0]", "[80, 99999999999999999999, 0]"),
        "[80, ",
        &["number"],
    );
}

/// What a file cannot hold is told in short, with what to do.
#[test]
fn error_numbers_beyond_all_bounds() {
    let place = |point: &str| {
        format!(
            "name = \"x\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n[[joint]]\nid = \"j\"\nlinks = [\"0\", \"1\"]\n\
             type = \"revolute\"\npoint = {point}\naxis = [0, 0, 1]\n"
        )
    };
    for (point, parts) in [
        (
            "[1e300, 0, 0]",
            [
                "coordinate 1e300 is out of range",
                "choose another length_unit",
            ],
        ),
        (
            "[1e-320, 0, 0]",
            ["is out of range", "choose another length_unit"],
        ),
        (
            "[1e400, 0, 0]",
            ["overflowed", "choose another length_unit"],
        ),
        (
            "[3, 0]",
            ["point of joint \"j\" has 2 values", "write 3 values"],
        ),
    ] {
        bad_file("bad.toml", &place(point), "point =", &parts);
    }
    let (_folder, path) = written("huge.toml", place("[1e300, 0, 0]"));
    let said = refused(&["check", path], &["1e300"]);
    assert!(said.lines().all(|l| l.len() < 200), "{said}");
}

#[test]
fn outputs_that_have_no_place_are_refused_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().to_str().unwrap();
    let said = refused(
        &["analyze", "four-bar", "-o", place],
        &["it is a folder; name a file in it"],
    );
    assert!(!said.contains(".tmp/"), "{said}");
    let nowhere = format!("{place}/none/x.txt");
    let said = refused(
        &["analyze", "four-bar", "-o", &nowhere],
        &["cannot write", "there is no folder", "make it first"],
    );
    assert!(!said.contains("os error"), "{said}");
}
