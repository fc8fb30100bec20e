//! Counts on rounded coordinates, and what singular values of the file say of them: no false count is called exact.

use super::search_numeric::{plain, request, turned};
use crate::common::run_on;
use ozols::accuracy::stability::change::Noise;
use ozols::score::request::Request;
use serde_json::Value;

/// A turned gripper as it is written: planes and parallels are gone with the last digit.
#[test]
fn a_false_count_of_a_turned_gripper_is_not_called_exact() {
    let m = turned(&plain("gripper-10"), 9, &mut Noise::new(3, 0));
    let truth = ozols::search(&plain("gripper-10"), &request()).unwrap();
    let found = ozols::search(
        &m,
        &Request {
            as_written: true,
            ..request()
        },
    )
    .unwrap();
    assert_ne!(found.admissible.total, truth.admissible.total);
    assert!(found.is_counted() && !found.is_exact() && !found.is_determinate_exact());
    let said = found.second.unwrap();
    assert!(!said.agrees() && said.contradiction.is_some());
    // The mechanism as it is, to begin with.
    assert!(said.listed.contradicted > 0);
}

#[test]
fn the_program_says_where_singular_values_contradict() {
    let m = turned(&plain("bennett"), 9, &mut Noise::new(5, 0));
    let file = ozols::export(&m, "toml").unwrap();
    let options = [
        "--options",
        "revolute,cylindrical,spherical",
        "--as-written",
    ];
    let on = |format: &str| {
        let (code, stdout, stderr) = run_on(
            "search",
            "it.toml",
            &file,
            &[&options[..], &["--format", format]].concat(),
        );
        assert_eq!(code, Some(0), "{stderr}");
        stdout
    };
    let text = on("text");
    for part in ["not exact: ", "singular values contradict at variant ("] {
        assert!(text.contains(part), "no {part:?} in {text}");
    }
    for word in ["Checked", "Proven"] {
        assert!(!text.contains(word), "{word} in {text}");
    }
    let comment = [&options[..], &["--format", "csv", "--comment"]].concat();
    let (_, csv, _) = run_on("search", "it.toml", &file, &comment);
    assert!(csv.lines().last().unwrap().starts_with("# not exact: "));
    assert!(on("jsonl").contains("\"certainty\":\"contradicted\""));
    let v: Value = serde_json::from_str(&on("json")).unwrap();
    assert_eq!(
        (&v["exact"], &v["determinate_exact"], &v["certainty"]),
        (&false.into(), &false.into(), &"contradicted".into())
    );
    assert!(
        v["second_opinion"]["contradiction"]["largest_dropped"]
            .as_f64()
            .unwrap()
            < 1e-6
    );
    assert_eq!(v["check"]["agree"], Value::Null);
}

#[test]
fn exact_files_are_not_asked_about() {
    for name in ["four-bar", "bennett", "gripper-10"] {
        let found = ozols::search(&plain(name), &request()).unwrap();
        assert!(found.second.is_none() && found.numeric.is_none() && found.is_exact());
    }
}
