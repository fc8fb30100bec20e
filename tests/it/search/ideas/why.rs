//! What an idea says of itself: what it lets go, of which parts, what it removes, what stays, and what joints bear.

use crate::common::*;
use crate::search::ideas::toggle::gripper;
use serde_json::json as value;

fn why(args: &[&str], idea: usize) -> Value {
    let more = ["--distinct", "--format", "json"];
    let found = run_json(&[&["search"], args, &more].concat());
    found["variants"][idea]["idea"]["why"].clone()
}

/// A rod that floats on one pin and tilts on the other bears no side load, so that all of it, and its moment about the middle of
/// the jaw, is the jaw pivot's.
#[test]
fn a_side_load_on_a_jaw_is_borne_by_its_pivot() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("toggle.toml");
    let options = "\"revolute\", \"cylindrical\", \"spherical\"";
    fs::write(&path, gripper("prismatic", false, options)).unwrap();
    let w = why(&[path.to_str().unwrap()], 0);
    assert_eq!(w["under"], "10 N on each output, along its hinge");
    let unchanged = w["unchanged"].list();
    assert!(
        ["P", "C1", "C2"]
            .iter()
            .all(|j| unchanged.contains(&value!(j)))
    );
    near(w["peak_force"]["value"].real(), 10.0, 1e-9);
    let arm = 1e-3 * f64::hypot(30.0 - 6.0, 25.0 - 30.0) / 2.0;
    near(w["peak_moment"]["value"].real(), 10.0 * arm, 1e-9);
    assert!(w["peak_moment"]["joint"].word().starts_with('C'));
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
    let removes = value!([{ "contour": "0-1-2-3", "redundant": 3, "left": 0 }]);
    assert_eq!(w["removes"], removes);
    assert_eq!(w["unchanged"], value!(["0-1", "3-0"]));
}

/// A redesign that leaves a redundant constraint does not say that it removes it.
#[test]
fn what_is_left_is_not_said_to_be_removed() {
    for left in 0..3 {
        let most = left.to_string();
        let found = run_json(&format!(
            "search gripper-10 --max-redundant {most} --distinct --top 40 --format json"
        ));
        for v in found["variants"].list() {
            let removes = v["idea"]["why"]["removes"].list();
            let sum = |key: &str| -> u64 { removes.iter().map(|r| r[key].whole()).sum() };
            assert_eq!(sum("redundant"), 11);
            assert_eq!(sum("left"), v["redundant"].whole(), "{v}");
        }
    }
}

#[test]
fn loads_of_the_file_are_taken_where_it_has_some() {
    let w = why(&["gripper-10-loaded", "--top", "1", "--pool", "50"], 0);
    assert_eq!(w["under"], "the loads of the file");
}
