//! What is wrong with a mechanism file is said with its line, the item and the remedy.

use super::{assert_refused, four_bar};
use crate::common::*;

/// Asserts that a file is refused at the line where `line_with` first stands, with these words.
pub(super) fn bad_file(name: &str, content: &str, line_with: &str, parts: &[&str]) {
    let (_folder, path) = write_temporary(name, content);
    let place = place_of(name, content, line_with);
    for command in ["check", "analyze", "search"] {
        has(&assert_refused(&[command, path], parts), &place);
    }
}

/// The four-bar with one text replaced, which must be there.
pub(super) fn with(from: &str, to: &str) -> String {
    replace_once(&four_bar(), from, to)
}

// What can be wrong with a file.

/// What is replaced, with what, where the line is that is told, and what is said of it, two parts with `&` between them.
#[test]
fn what_is_wrong_in_a_file_is_told_with_its_line() {
    for [from, to, line, said] in read_cases::<4>(
        r#"
        ["2", "3"] | ["2", "zz"] | zz | unknown link "zz" & known links: 0, 1, 2, 3
        id = "2-3" | id = "1-2"  # again | # again | joint id "1-2" is used twice
        id = "3" | id = "2"  # again | # again | link id "2" is used twice
        id = "2-3" | id = "" | id = "" | 1 to 64 characters
        ["2", "3"] | ["2", "2"] | ["2", "2"] | "2-3" connects link "2" to itself
        [[contour]] | [[link]]\nid = "p"\n[[link]]\nid = "q"\n[[joint]]\nid = "p-q"\nlinks = ["p", "q"]\ntype = "revolute"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n[[contour]] | id = "p" | link "p" is not connected to the frame & "q"
        [[joint]] | [[link]]\nid = "lone"\n\n[[joint]] | lone | link "lone" has no joint
        axis = [0, 0, 1] | axis = [0, 0, 0.0] | 0, 0.0] | axis of joint "0-1" is zero
        axis = [0, 0, 1] | axis = [0, 0, 1]\nreference = [0, 0, -2] | reference = | reference of joint "0-1" is parallel
        type = "revolute" | type = "hing" | hing" | unknown joint type "hing" & did you mean hinge? & revolute, prismatic, helical, cylindrical, universal & spherical & custom
        "mm" | "furlong" | furlong | unknown length unit "furlong" & m, mm, cm, um, in
        role = "output" | role = "tool" | "tool" | unknown role "tool" & frame, output, object
        length_unit | mode = "flat"\nlength_unit | "flat" | unknown mode "flat" & spatial, planar
        drive = true | options = ["revolute", "prismatic"] | "prismatic" | option "prismatic" of joint "0-1" & original revolute
        role = "frame" | | [[link]] | no link has the role "frame"
        role = "output" | role = "frame" # 2 | # 2 | link "3" is a second frame after "0"
        "0-1", "1-2", "2-3", "3-0" | "0-1", "1-2", "2-3" | joints = [ | closed loop
        "2-3", "3-0" | "2-3", "9-9" | 9-9 | unknown joint "9-9" & 0-1, 1-2, 2-3, 3-0
        id = "2-3" | id = = "2-3" | = = |
        drive = true | driven = true | driven | driven
        drive = true | drive = 7 | drive = 7 | true, false or the freedom that is driven
        [80, 90, 0] | [80, 90] | [80, 90] | point of joint "2-3" has 2 values & write 3 values
        [80, 90, 0] | [80, true, 0] | [80, true, 0] | expected a number
        [80, 90, 0] | [80, nan, 0] | [80, | finite
        [80, 90, 0] | [80, inf, 0] | [80, | finite
        [80, 90, 0] | [80, 1e308, 0] | [80, | out of range & choose another length_unit
        [80, 90, 0] | [80, 1e400, 0] | [80, | overflowed & choose another length_unit
        [80, 90, 0] | [80, 1e-100, 0] | [80, | out of range
        [80, 90, 0] | [80, "1e-9^60", 0] | [80, | out of range
        [80, 90, 0] | [80, "sqrt(-1)", 0] | [80, | square root of a negative number
        [80, 90, 0] | [80, "1/0", 0] | [80, | division by zero
        [80, 90, 0] | [80, "tan(90deg)", 0] | [80, |
        [80, 90, 0] | [80, "sqr(2)", 0] | [80, | unknown word `sqr`
        [80, 90, 0] | [80, "", 0] | [80, | empty
        [80, 90, 0] | [80, 99999999999999999999, 0] | [80, | number
        "#,
    ) {
        let said: Vec<&str> = said.split(" & ").collect();
        bad_file("bad.toml", &with(from, to), line, &said);
    }
    // Several at once.
    let text = with("[\"2\", \"3\"]", "[\"2\", \"zz\"]");
    let text = text.replacen("type = \"revolute\"", "type = \"hing\"", 1);
    let parts = ["unknown link \"zz\"", "unknown joint type \"hing\""];
    bad_file("bad.toml", &text, "hing\"", &parts);
}

#[test]
fn error_missing_fields() {
    bad_file(
        "bad.toml",
        "name = \"x\"\n[[link]]\nid = \"0\"\n[[link]] # nameless\nrole = \"frame\"\n",
        "# nameless",
        &["missing field `id`", "give it a unique name"],
    );
    bad_file(
        "bad.json",
        "{\"name\": \"x\",\n\"link\": [{\"role\": \"frame\"}]}",
        "link",
        &["missing field `id`", "give it a unique name"],
    );
}

#[test]
fn error_more_than_one_image() {
    for way in ["mirror", "turn"] {
        let twice = format!("{way} = [[\"0-1\", \"1-2\"], [\"1-2\", \"2-3\"]] # twice");
        let text = with("[search]", &format!("[search]\n{twice}"));
        let said = format!("joint \"1-2\" has more than one image under {way}");
        let parts = [said.as_str(), "name each joint once"];
        bad_file("bad.toml", &text, "# twice", &parts);
    }
}

#[test]
fn error_parameters() {
    let text = with("[80, 90, 0]", "[\"width\", 90, 0]");
    let number = "expected a number, or an expression in quotes";
    for (parameters, line_with, part) in [
        ("width = 80\npi = 3", "pi = 3", "cannot be named \"pi\""),
        ("width = 80\n\"2a\" = 3", "2a", "cannot be named \"2a\""),
        ("width = 80\nidle = 3", "idle = 3", "is never used"),
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

/// What a file cannot hold is told in short.
#[test]
fn error_numbers_beyond_all_bounds() {
    let (_folder, path) = write_temporary("huge.toml", with("[80, 90, 0]", "[1e300, 0, 0]"));
    let said = assert_refused(&["check", path], &["coordinate 1e300 is out of range"]);
    assert!(said.lines().all(|l| l.len() < 200), "{said}");
}

#[test]
fn outputs_that_have_no_place_are_refused_by_their_names() {
    let folder = tempdir().unwrap();
    let place = folder.path().to_str().unwrap();
    for command in ["analyze", "search", "check"] {
        assert_refused(&[command, place], &["is a folder; name a file in it"]);
    }
    for command in ["analyze", "search"] {
        let whole = ["this is a folder; name a file in it"];
        let said = assert_refused(&[command, "four-bar", "-o", place], &whole);
        lacks(&said, ".tmp/");
        let nowhere = format!("{place}/none/x.txt");
        let parts = ["cannot write", "none/x.txt", "no folder", "create it first"];
        let said = assert_refused(&[command, "four-bar", "-o", &nowhere], &parts);
        lacks(&said, "os error");
    }
    assert_eq!(fs::read_dir(place).unwrap().count(), 0);
}
