//! The cheapest symmetric redesigns, against lists of all symmetric variants.

use crate::common::*;
/// Returns what a search of the gripper says with more flags.
fn found(more: &[&str]) -> Value {
    let args = ["search", "gripper-10", "--format", "json"];
    run_json(&[&args[..], more].concat())
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
    let text = run_quiet(&["search", "gripper-10"]);
    let said = "that takes 11 more freedoms, and joints that are images of each other gain them 2 at a time";
    assert!(text.contains(said), "{text}");
    let flags = ["--symmetric", "--max-mobility", "1", "--count"];
    let none = ozols(&[&["search", "gripper-10"][..], &flags].concat()).output();
    assert_eq!(none.unwrap().status.code(), Some(1));
}

/// Of equal cost ideas that are their own images come first.
#[test]
fn ideas_of_a_symmetric_mechanism_say_whether_they_are_symmetric() {
    let own = |name: &str| -> Vec<(u64, Value)> {
        let args = format!("search {name} --distinct --top 60 --format json -q");
        let list = run_json(&args)["variants"].take();
        let row = |v: &Value| (milli(&v["cost"]), v["idea"]["symmetric"].clone());
        list.list().iter().map(row).collect()
    };
    let gripper = own("gripper-slider-two-fingers");
    let order = |(cost, symmetric): &(u64, Value)| (*cost, !symmetric.as_bool().unwrap());
    assert!(gripper.iter().map(order).is_sorted());
    assert!(gripper.iter().any(|(_, s)| *s == true) && gripper.iter().any(|(_, s)| *s == false));
    assert!(own("watt-six-bar").iter().all(|(_, s)| s.is_null()));
}

fn milli(cost: &Value) -> u64 {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small cost"
    )]
    let milli = (1000.0 * cost.real()) as u64;
    milli
}

/// A robot with three legs alike is turned into itself by a third of a turn, and its symmetric redesigns change all three alike.
#[test]
fn thirds_of_a_turn_are_found() {
    for name in ["delta", "3-upu", "3-rps", "y-star"] {
        let v = run_json(&format!("search {name} --format json -q --check none"));
        let best = v["symmetric"].list();
        for one in best.iter().filter(|v| v["by"] == "third of a turn") {
            let mut alike: BTreeMap<&str, usize> = BTreeMap::new();
            let changes = one["changes"].list();
            changes
                .iter()
                .for_each(|c| *alike.entry(c["to"].word()).or_default() += 1);
            assert!(alike.values().all(|n| n % 3 == 0), "{name}: {one}");
        }
        let args = format!("search {name} --symmetric --count --format json -q");
        let found: Value = serde_json::from_slice(&run(&args).stdout).unwrap();
        let space: f64 = found["space"].word().parse().unwrap();
        let all: f64 = v["space"].word().parse().unwrap();
        assert!(
            (space.powi(3) - all).abs() <= 1e-9 * all,
            "{name}: {space} {all}"
        );
    }
}

#[test]
fn mechanisms_without_symmetry_have_no_symmetric_redesigns() {
    for more in [
        &["search", "watt-six-bar"][..],
        &["search", "gripper-10", "--count"],
    ] {
        let v = run_json(&[more, &["--format", "json"]].concat());
        assert!(v["symmetric"].is_null(), "{more:?}");
    }
}
