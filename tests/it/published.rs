//! The reference figures, by the program itself.

use crate::common::*;

fn run_on_data<L: Line + ?Sized>(args: &L) -> Value {
    let (code, said, told) = run_full(&[&args.words()[..], &["--format", "json"]].concat());
    // 1 says that there is nothing to be found, which some counts are about; no progress where standard error is no terminal.
    assert!(code.is_some_and(|c| c < 2) && told.is_empty(), "{told}");
    serde_json::from_str(&said).unwrap()
}

fn row(options: &str) -> Value {
    run_on_data(&["search", "gripper-10", "--count", "--options", options])
}

#[test]
fn the_first_row_of_the_reference_table() {
    let row = row("revolute,spherical");
    assert_eq!(row["space"], "4096");
    let by_mobility = json!({
        "2": "125", "4": "390", "6": "396", "8": "210", "10": "66", "12": "12", "14": "1"
    });
    assert_eq!(row["by_mobility"], by_mobility);
    assert!(row["largest_layer"].whole() <= 80);
    is_as_brute_force_counts("revolute,spherical");
}

/// Compares the counts with those of brute force.
fn is_as_brute_force_counts(options: &str) {
    let brute = run_on_data(&format!(
        "search gripper-10 --count --options {options} --method brute"
    ));
    let row = row(options);
    for key in split_words(
        "determinate by_mobility_and_changes admissible admissible_by_mobility_and_changes",
    ) {
        assert_eq!(row[key], brute[key], "{key}");
    }
}

#[test]
fn the_second_row_of_the_reference_table() {
    let row = row("revolute,cylindrical,universal,spherical");
    assert_eq!(row["space"], "16777216");
    assert_eq!(row["determinate"], "2309229");
    let least = json!({ "1": "32256", "2": "139040", "3": "317732" });
    assert_includes(&row["by_mobility"], &least);
    assert_eq!(
        row["by_mobility_and_changes"]["1"],
        json!({ "6": "720", "7": "31536" })
    );
    assert!(row["largest_layer"].whole() <= 840);
}

#[test]
#[ignore = "a minute in release: cargo test --release -- --ignored brute_force"]
fn brute_force_agrees_on_the_second_row() {
    is_as_brute_force_counts("revolute,cylindrical,universal,spherical");
}

#[test]
fn the_third_row_of_the_reference_table() {
    let row = run_on_data("search gripper-10 --count");
    assert_eq!(row["space"], "13841287201");
    assert_eq!(row["determinate"], "6340592477");
    let least = json!({ "1": "7150020", "2": "37484794", "3": "112727256" });
    assert_includes(&row["by_mobility"], &least);
    // 313 in the table; the order found here has fewer nodes in all and a wider layer among them.
    assert!(row["largest_layer"].whole() <= 365);
    assert_eq!(row["stop"], "exhausted");
}

#[test]
fn the_figures_of_the_ten_link_gripper() {
    let states = |name: &str| run_on_data(&format!("analyze {name}"))["states"].take();
    let built = states("gripper-10");
    let free = json!({
        "links": 10, "joints": 13, "contours": 4, "freedoms": 14, "mobility": 1, "redundant": 11
    });
    assert_includes(&built[0], &free);
    let shares = built[0]["per_contour"].list().iter();
    assert_eq!(
        shares.map(|c| c["redundant"].whole()).collect_vec(),
        [2, 3, 3, 3]
    );
    let clamped = json!({
        "constraints": 12, "actual_mobility": 1, "working_mobility": 0, "lost_mobility": 6, "redundant": 5
    });
    assert_includes(&built[1]["external"], &clamped);
    assert_eq!(states("gripper-10 --planar --state free")[0]["mobility"], 1);
    let redesign = states("gripper-10-redesign");
    let wanted = json!({ "freedoms": 26, "mobility": 3, "local_mobility": 2, "redundant": 1 });
    assert_includes(&redesign[0], &wanted);
    let idle = redesign[0]["idle"].list().iter();
    assert_eq!(idle.map(|i| i["links"][0].word()).collect_vec(), ["5", "9"]);
    assert_eq!(
        redesign[0]["self_stresses"][0]["contours"],
        json!(["0-1-2-3", "0-1-6-7"])
    );
    let pad = json!({ "external": { "actual_mobility": 4, "redundant": 2 } });
    assert_includes(&states("gripper-10-unloaded")[1], &pad);
    let all = json!({
        "contours": 5, "freedoms": 29, "mobility": 2, "redundant": 3, "external": { "redundant": 2 }
    });
    assert_includes(&states("gripper-10-redesign-unloaded")[1], &all);
}

/// The same for any number of threads, but for the time it takes.
#[test]
fn threads_do_not_matter() {
    for format in ["text", "json", "csv", "jsonl"] {
        let line = format!("search gripper-10 --top 200 --format {format} --threads");
        let [one, two, eight] = [1, 2, 8].map(|n| run_quiet(&format!("{line} {n}")));
        assert!(!one.is_empty());
        assert!(one == two && one == eight, "{format}");
    }
}
