//! The reference figures, by the program itself.

use crate::common::*;

fn json<L: Line + ?Sized>(args: &L) -> Value {
    let (code, said, told) = run_full(&[&args.words()[..], &["--format", "json"]].concat());
    // 1 says that there is nothing to be found, which some counts are about; no progress where standard error is no terminal.
    assert!(code.is_some_and(|c| c < 2) && told.is_empty(), "{told}");
    serde_json::from_str(&said).unwrap()
}

fn row(options: &str) -> Value {
    json(&["search", "gripper-10", "--count", "--options", options])
}

/// Options R S: determinate variants by W, a brute force of the reference agreeing.
#[test]
fn the_first_row_of_the_reference_table() {
    let row = row("revolute,spherical");
    assert_eq!(row["space"], "4096");
    let want = [
        ("2", "125"),
        ("4", "390"),
        ("6", "396"),
        ("8", "210"),
        ("10", "66"),
        ("12", "12"),
        ("14", "1"),
    ];
    for (w, n) in want {
        assert_eq!(row["by_mobility"][w], n, "W = {w}");
    }
    assert_eq!(row["by_mobility"].as_object().unwrap().len(), want.len());
    assert!(row["largest_layer"].whole() <= 80);
    let brute = "search gripper-10 --count --options revolute,spherical --method brute";
    let brute = json(&split_words(brute));
    for key in split_words(
        "determinate by_mobility_and_changes admissible admissible_by_mobility_and_changes",
    ) {
        assert_eq!(row[key], brute[key], "{key}");
    }
}

/// Options R C U S.
#[test]
fn the_second_row_of_the_reference_table() {
    let row = row("revolute,cylindrical,universal,spherical");
    assert_eq!(
        (&row["space"], &row["determinate"]),
        (&"16777216".into(), &"2309229".into())
    );
    for (w, n) in [("1", "32256"), ("2", "139040"), ("3", "317732")] {
        assert_eq!(row["by_mobility"][w], n, "W = {w}");
    }
    assert_eq!(
        row["by_mobility_and_changes"]["1"],
        serde_json::json!({"6": "720", "7": "31536"})
    );
    assert!(row["largest_layer"].whole() <= 840);
}

/// Brute force over the second row, 16,777,216 eliminations.
#[test]
#[ignore = "a minute in release: cargo test --release -- --ignored brute_force"]
fn brute_force_agrees_on_the_second_row() {
    let names = "revolute,cylindrical,universal,spherical";
    let (row, brute) = (
        row(names),
        json(&format!(
            "search gripper-10 --count --options {names} --method brute"
        )),
    );
    for key in split_words(
        "determinate by_mobility_and_changes admissible admissible_by_mobility_and_changes",
    ) {
        assert_eq!(row[key], brute[key], "{key}");
    }
}

/// Options R C U V S H N.
#[test]
fn the_third_row_of_the_reference_table() {
    let row = json(&["search", "gripper-10", "--count"]);
    assert_eq!(
        (&row["space"], &row["determinate"]),
        (&"13841287201".into(), &"6340592477".into())
    );
    for (w, n) in [("1", "7150020"), ("2", "37484794"), ("3", "112727256")] {
        assert_eq!(row["by_mobility"][w], n, "W = {w}");
    }
    // 313 in the table; the order found here has fewer nodes in all and a wider layer among them.
    assert!(row["largest_layer"].whole() <= 365);
    assert_eq!(row["stop"], "exhausted");
}

/// [Pogrebnyak 2018]: every figure of the ten-link gripper, before clamping and clamped, as built and redesigned.
#[test]
fn the_figures_of_the_ten_link_gripper() {
    let state = |v: &Value, i: usize| v["states"][i].clone();
    let built = json(&["analyze", "gripper-10"]);
    let free = state(&built, 0);
    let want = [
        ("links", 10),
        ("joints", 13),
        ("contours", 4),
        ("freedoms", 14),
        ("mobility", 1),
        ("redundant", 11),
    ];
    for (key, n) in want {
        assert_eq!(free[key], n, "{key}");
    }
    let shares: Vec<i64> = free["per_contour"]
        .list()
        .iter()
        .map(|c| c["redundant"].as_i64().unwrap())
        .collect();
    assert_eq!(shares, [2, 3, 3, 3]);
    let external = &state(&built, 1)["external"];
    let want = [
        ("constraints", 12),
        ("actual_mobility", 1),
        ("working_mobility", 0),
        ("lost_mobility", 6),
        ("redundant", 5),
    ];
    for (key, n) in want {
        assert_eq!(external[key], n, "{key}");
    }
    assert_eq!(
        state(
            &json(&["analyze", "gripper-10", "--planar", "--state", "free"]),
            0
        )["mobility"],
        1
    );
    let redesign = state(&json(&["analyze", "gripper-10-redesign"]), 0);
    let want = [
        ("freedoms", 26),
        ("mobility", 3),
        ("local_mobility", 2),
        ("redundant", 1),
    ];
    for (key, n) in want {
        assert_eq!(redesign[key], n, "{key}");
    }
    let idle: Vec<&str> = redesign["idle"]
        .list()
        .iter()
        .map(|i| i["links"][0].word())
        .collect();
    assert_eq!(idle, ["5", "9"]);
    let pad = &state(&json(&["analyze", "gripper-10-unloaded"]), 1)["external"];
    assert_eq!(
        (&pad["actual_mobility"], &pad["redundant"]),
        (&4.into(), &2.into())
    );
    let all = state(&json(&["analyze", "gripper-10-redesign-unloaded"]), 1);
    let want = [
        ("contours", 5),
        ("freedoms", 29),
        ("mobility", 2),
        ("redundant", 3),
    ];
    for (key, n) in want {
        assert_eq!(all[key], n, "{key}");
    }
    assert_eq!(all["external"]["redundant"], 2);
}

/// The same for any number of threads, but for the time it takes.
#[test]
fn threads_do_not_matter() {
    let run = |threads: &str, format: &str| {
        let args = [
            "search",
            "gripper-10",
            "--top",
            "200",
            "--threads",
            threads,
            "--format",
            format,
        ];
        run_quiet(&args)
    };
    for format in ["text", "json", "csv", "jsonl"] {
        let one = run("1", format);
        assert!(!one.is_empty());
        assert!(
            one == run("2", format) && one == run("8", format),
            "{format}"
        );
    }
}
