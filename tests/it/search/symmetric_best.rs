//! The cheapest symmetric redesigns, against lists of all symmetric variants.

use crate::common::*;

/// Returns what a search of the gripper says with more flags.
fn found(more: &[&str]) -> Value {
    let args = ["search", "gripper-10", "--format", "json"];
    json(&[&args[..], more].concat())
}

/// The redesign that the literature of the gripper would build: mirror images alike, one redundant constraint left, cost 11, one motion.
/// Eleven freedoms make it determinate, which pairs of joints cannot add.
#[test]
fn the_gripper_has_a_symmetric_redesign_with_one_constraint_left() {
    let all = found(&[]);
    let best = all["symmetric"].list();
    let row = |v: &Value| [&v["redundant"], &v["cost"], &v["mobility"]].map(Value::to_string);
    let rows: Vec<_> = best.iter().map(row).collect();
    assert!(
        rows.contains(&["1", "11", "1"].map(str::to_owned)),
        "{rows:?}"
    );
    for (left, v) in best.iter().enumerate() {
        let most = left.to_string();
        let flags = [
            "--symmetric",
            "--max-redundant",
            &most,
            "--top",
            "5000",
            "--check",
            "none",
        ];
        let list = found(&flags);
        let variants = list["variants"].list();
        let first = variants.iter().find(|v| v["redundant"] == left);
        assert_eq!(v["changes"], first.unwrap()["changes"], "σ = {left}");
        assert_eq!(row(v), row(first.unwrap()), "σ = {left}");
    }
    let text = out(&["search", "gripper-10"]);
    let said = "that takes 11 more freedoms, and joints that are images of each other gain them 2 at a time";
    assert!(text.contains(said), "{text}");
    let flags = ["--symmetric", "--max-mobility", "1", "--count"];
    let none = ozols(&[&["search", "gripper-10"][..], &flags].concat()).output();
    assert_eq!(none.unwrap().status.code(), Some(1));
}

#[test]
fn mechanisms_without_symmetry_have_no_symmetric_redesigns() {
    for more in [
        &["search", "watt-six-bar"][..],
        &["search", "gripper-10", "--count"],
    ] {
        let v = json(&[more, &["--format", "json"]].concat());
        assert!(v["symmetric"].is_null(), "{more:?}");
    }
}
