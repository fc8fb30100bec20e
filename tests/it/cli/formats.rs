//! The contract of the formats, design.md section 4: keys, columns, counts.

use super::small_out;
use crate::common::*;

// The contract of the formats, design.md section 4.

#[test]
fn top_0() {
    let v: Value = serde_json::from_str(&small_out("--format json --top 0")).unwrap();
    assert_eq!(v["variants"], serde_json::json!([]));
    assert_eq!(v["admissible"], "56");
    assert_eq!(small_out("--format csv --top 0").lines().count(), 1);
    assert_eq!(small_out("--top 0"), small_out("--count"));
}

#[test]
fn all_gives_the_admissible_ones() {
    let csv = small_out("--all --format csv");
    let mut rows: Vec<&str> = csv
        .lines()
        .skip(1)
        .map(|l| l.split_once(',').unwrap().1)
        .collect();
    assert_eq!(rows.len(), 56);
    rows.sort_unstable();
    rows.dedup();
    assert_eq!(rows.len(), 56, "no variant twice");
    assert_eq!(small_out("--all --format jsonl").lines().count(), 56);
    let v: Value = serde_json::from_str(&small_out("--all --format json")).unwrap();
    assert_eq!(v["variants"].list().len(), 56);
}

#[test]
fn csv_columns() {
    let csv = small_out("--format csv");
    let lines: Vec<Vec<&str>> = csv.lines().map(|l| l.split(',').collect()).collect();
    let joints = [
        "1-2", "2-3", "3-0", "2-4", "4-5", "5-1", "1-6", "6-7", "7-0", "6-8", "8-9", "9-1",
    ];
    assert_eq!(
        lines[0][..6],
        [
            "position",
            "cost",
            "mobility",
            "redundant",
            "external_redundant",
            "changes"
        ]
    );
    assert_eq!(lines[0][6..18], joints);
    assert_eq!(
        lines[0][18..],
        [
            "conditioning",
            "agree",
            "lucky",
            "external_harmful",
            "redundant_by_contour"
        ]
    );
    assert_eq!(lines.len(), 11);
    for l in &lines[1..] {
        assert_eq!((l.len(), l[19]), (23, "true"));
        let changed = l[6..18].iter().filter(|t| **t != "revolute").count();
        assert_eq!(l[5], changed.to_string());
    }
}

#[test]
fn schema_is_json() {
    let v = run_json("schema");
    assert!(v["properties"]["joint"].is_object() && v["properties"]["link"].is_object());
}
