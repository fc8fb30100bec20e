//! Costs in a file of their own: printed, changed, taken, and refused where they are none.

use crate::common::{changed, json, out, run, text};
use std::fs;

/// A folder with the table of costs, changed, and the path to it.
fn table(from: &str, to: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("costs.toml");
    fs::write(&path, changed(&out(&["show", "costs"]), from, to)).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

#[test]
fn the_table_that_is_printed_changes_nothing() {
    let (_folder, path) = table("change = 1\n", "change = 1.0\n");
    let with = out(&["search", "gripper-10", "--format", "csv", "--costs", &path]);
    assert_eq!(with, out(&["search", "gripper-10", "--format", "csv"]));
    assert!(!out(&["list"]).contains("\n costs "));
}

#[test]
fn a_type_that_is_dear_is_chosen_no_more() {
    let first = |more: &[&str]| {
        let args = ["search", "gripper-10", "--top", "1", "--format", "json"];
        json(&[&args, more].concat())["variants"][0].clone()
    };
    let has = |v: &serde_json::Value, t: &str| v["changes"].to_string().contains(t);
    let before = first(&[]);
    let (_folder, path) = table("sphere-in-cylinder = 2.5", "sphere-in-cylinder = 90");
    let after = first(&["--costs", &path]);
    assert!(has(&before, "sphere-in-cylinder") && !has(&after, "sphere-in-cylinder"));
    assert_ne!(before["cost"], after["cost"]);
    // the page says how it was made
    let page = out(&["report", "four-bar", "--costs", &path]);
    assert!(page.contains(&format!("--costs {path}")));
}

#[test]
fn the_costs_of_a_file_stand_where_the_table_says_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let own = out(&["show", "gripper-10"]) + "\n[search.costs]\nlink = 7\nspherical = 3\n";
    fs::write(at("own.toml"), own).unwrap();
    fs::write(at("costs.toml"), "spherical = 2\n").unwrap();
    let cost = |more: &[&str]| {
        let allow = ["--options", "spherical", "--top", "1", "--format", "json"];
        let file = at("own.toml");
        json(&[&["search", file.as_str()], &allow[..], more].concat())["variants"][0]["cost"]
            .clone()
    };
    let costs = at("costs.toml");
    let (with, without) = (cost(&["--costs", &costs]), cost(&[]));
    assert!(
        with.as_f64().unwrap() < without.as_f64().unwrap(),
        "{with} {without}"
    );
}

#[test]
fn what_is_no_cost_is_refused_with_its_line_and_a_remedy() {
    for (from, to, said) in [
        (
            "spherical = 2\n",
            "sphericle = 2\n",
            "unknown cost \"sphericle\"",
        ),
        (
            "spherical = 2\n",
            "spherical = -2\n",
            "cost -2 must be a finite number from 0 to 1e6",
        ),
        ("spherical = 2\n", "spherical = nan\n", "cost NaN must be"),
        (
            "spherical = 2\n",
            "spherical = \"2\"\n",
            "each line is a name and a number",
        ),
        (
            "spherical = 2\n",
            "spherical 2\n",
            "each line is a name and a number",
        ),
    ] {
        let (_folder, path) = table(from, to);
        let o = run(&["search", "gripper-10", "--costs", &path]);
        let err = text(&o.stderr);
        assert_eq!(o.status.code(), Some(2), "{to}");
        let words = err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(said), "{to}: {err}");
        let printed = fs::read_to_string(&path).unwrap();
        let line = printed
            .lines()
            .position(|l| l.starts_with(to.trim_end()))
            .unwrap()
            + 1;
        assert!(err.contains(&format!("costs.toml:{line}:")), "{to}: {err}");
    }
    let o = run(&["search", "gripper-10", "--costs", "no/such.toml"]);
    assert_eq!(o.status.code(), Some(2));
    assert!(text(&o.stderr).contains("`ozols show costs > no/such.toml` writes one"));
}
