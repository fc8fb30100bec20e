//! What an idea says of itself: what it lets go, of which parts, what was redundant there, what stays, and what joints bear.

use crate::common::{json, near, out};
use crate::search::ideas::toggle::gripper;
use serde_json::{Value, json as value};
use std::fs;

fn why(args: &[&str], idea: usize) -> Value {
    let more = ["--distinct", "--format", "json"];
    let found = json(&[&["search"], args, &more].concat());
    found["variants"][idea]["idea"]["why"].clone()
}

/// A rod that floats on one pin and tilts on the other bears no side load, so that all of it, and its moment about the middle of
/// the jaw, is the jaw pivot's.
#[test]
fn a_side_load_on_a_jaw_is_borne_by_its_pivot() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("toggle.toml");
    let options = "\"revolute\", \"cylindrical\", \"spherical\"";
    fs::write(&path, gripper("prismatic", false, options)).unwrap();
    let w = why(&[path.to_str().unwrap()], 0);
    assert_eq!(w["under"], "10 N on each output, along its hinge");
    assert_eq!(w["stays"], value!(["P", "C1", "C2"]));
    near(w["peak_force"]["value"].as_f64().unwrap(), 10.0, 1e-9);
    let arm = 1e-3 * f64::hypot(30.0 - 6.0, 25.0 - 30.0) / 2.0;
    near(
        w["peak_moment"]["value"].as_f64().unwrap(),
        10.0 * arm,
        1e-9,
    );
    assert!(w["peak_moment"]["joint"].as_str().unwrap().starts_with('C'));
}

#[test]
fn each_change_says_what_it_lets_go_and_what_was_redundant_there() {
    let w = why(&["four-bar"], 0);
    let [bush, ball] = [&w["lets"][0], &w["lets"][1]];
    assert_eq!(
        (&bush["joint"], &bush["part"]),
        (&value!("1-2"), &value!("rod 2"))
    );
    assert_eq!(bush["lets"], "float along its axis");
    assert_eq!(bush["hardware"], "plain bush on a shaft without shoulders");
    assert_eq!(
        (&bush["holds_forces"], &bush["holds_moments"]),
        (&value!(2), &value!(2))
    );
    assert_eq!(ball["lets"], "tilt both ways");
    assert_eq!(ball["hardware"], "rod end (spherical plain bearing)");
    assert_eq!(
        (&ball["holds_forces"], &ball["holds_moments"]),
        (&value!(3), &value!(0))
    );
    let was = value!([{ "contour": ["0-1", "1-2", "2-3", "3-0"], "redundant": 3 }]);
    assert_eq!((&bush["was"], &ball["was"]), (&was, &was));
    assert_eq!(w["stays"], value!(["0-1", "3-0"]));
}

#[test]
fn loads_of_the_file_are_taken_where_it_has_some() {
    let w = why(&["gripper-10-loaded", "--top", "1", "--pool", "50"], 0);
    assert_eq!(w["under"], "the loads of the file");
}

#[test]
fn the_text_says_why_of_the_first_three_ideas() {
    let text = out(&["search", "gripper-10"]);
    for k in 1..=3 {
        assert!(
            text.contains(&format!("\n  idea {k} lets parts tilt both ways: ")),
            "{text}"
        );
    }
    assert!(!text.contains("idea 4 lets"));
    assert!(
        text.contains("hardware: rod end (spherical plain bearing) at "),
        "{text}"
    );
    assert!(
        text.contains("takes what was out of true: σ = 2 of 0-1, 1-2, 2-3, 3-0;"),
        "{text}"
    );
    assert!(text.contains("as they are: 0-1, 3-0, 7-0\n"), "{text}");
    // What changes nothing lets nothing go.
    assert!(!out(&["search", "gripper-10-planar"]).contains(" lets parts"));
}
