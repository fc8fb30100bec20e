//! The contract of the formats, design.md section 4: keys, columns, counts.

use super::{small_out, small_search};
use crate::common::*;

// The contract of the formats, design.md section 4.

#[test]
fn keys_of_analyze() {
    let v = run_json("analyze gripper-10 --format json");
    assert_eq!(v["mechanism"], "gripper-10");
    let states = v["states"].list();
    assert_eq!(
        states.iter().map(|s| s["state"].word()).collect_vec(),
        ["free", "clamped"]
    );
    for s in states {
        for k in split_words(
            "links joints contours freedoms rank mobility working_mobility local_mobility redundant",
        ) {
            assert!(s[k].is_i64() || s[k].is_u64(), "{k}");
        }
        for k in ["method", "certainty"] {
            assert!(s[k].is_string(), "{k}");
        }
        for c in s["per_contour"].list() {
            assert!(c["joints"][0].is_string() && c["redundant"].is_number());
        }
        assert!(s.as_object().unwrap().contains_key("external"));
    }
    for k in split_words("constraints actual_mobility working_mobility lost_mobility redundant") {
        assert!(states[1]["external"][k].is_number(), "{k}");
    }
}

#[test]
fn keys_of_search() {
    let v: Value = serde_json::from_str(&small_out("--format json --top 3")).unwrap();
    for k in ["space", "determinate", "admissible"] {
        assert!(parse_count(&v[k]) > 0, "{k}");
    }
    for k in ["by_mobility", "admissible_by_mobility"] {
        let by = v[k].as_object().unwrap();
        assert!(
            by.iter()
                .all(|(w, n)| w.parse::<i64>().is_ok() && parse_count(n) > 0),
            "{k}"
        );
    }
    assert!(v["largest_layer"].is_u64() && v["nodes"].is_u64() && v["stop"].is_string());
    let variants = v["variants"].list();
    assert_eq!(variants.len(), 3);
    for (i, x) in variants.iter().enumerate() {
        assert_eq!(x["position"], i + 1);
        assert!(x["cost"].is_number() && x["scores"].is_object());
        assert!(x["mobility"].is_i64() && x["redundant"] == 0);
        for c in x["changes"].list() {
            assert!(c["joint"].is_string() && c["from"] == "revolute" && c["to"] == "spherical");
        }
    }
    let costs: Vec<f64> = variants.iter().map(|x| x["cost"].real()).collect();
    assert!(costs.is_sorted());
}

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

// Orbits under the mirror image: (all + symmetric) / 2, by Burnside's lemma.
#[test]
fn symmetry_counts() {
    let counts = |more: &str| {
        let (code, told, _) = run_full(&small_search(&format!("--count --format json {more}")));
        assert_ne!(code, Some(2));
        let v: Value = serde_json::from_str(&told).unwrap();
        (
            parse_count(&v["determinate"]),
            parse_count(&v["admissible"]),
        )
    };
    for more in ["", "--allow-output-change"] {
        let with = |flag| counts(&format!("{more} {flag}"));
        let (all, symmetric, orbits) = (counts(more), with("--symmetric"), with("--one-per-orbit"));
        assert_eq!(
            orbits,
            ((all.0 + symmetric.0) / 2, (all.1 + symmetric.1) / 2)
        );
        let listed = small_out(&format!("--all --one-per-orbit --format csv {more}"));
        assert_eq!(listed.lines().count() as u64 - 1, orbits.1);
    }
}

#[test]
fn schema_is_json() {
    let v = run_json("schema");
    assert!(v["properties"]["joint"].is_object() && v["properties"]["link"].is_object());
}
