//! Mechanism files in TOML and JSON, and the workloads in them.

use crate::common::*;
use ozols::file::lint::check_file;
use ozols::file::problem::ImportError;
use ozols::file::read::workload::{drive_from_bytes, grip_from_bytes, tables_alone};
use ozols::file::text::mechanism_from_bytes;
use ozols::file::write::mechanism_file;

pub(crate) const WORDS: [&str; 20] = [
    "1e308",
    "-0.0",
    "nan",
    "inf",
    "99999999999999999999",
    "\"sqrt(-1)\"",
    "\"1/0\"",
    "\"tan(90deg)\"",
    "\"2^(2^9)\"",
    "[]",
    "{}",
    "\"\"",
    "\"",
    "\"\"\"",
    "\\u0000",
    "null",
    "spherical",
    "frame",
    "[[joint]]\n",
    "\n",
];

/// What is read can be checked and analysed, and written so that it reads as the same. Returns what was said.
pub(crate) fn read(name: &str, bytes: &[u8]) -> String {
    match mechanism_from_bytes(name, bytes) {
        Ok(m) => {
            let doubtful = check_file(name, bytes).unwrap().warnings;
            let _ = doubtful.render(true);
            let written = serde_json::to_vec(&mechanism_file(&m)).unwrap();
            let again = mechanism_from_bytes("written.json", &written).unwrap();
            assert_eq!(
                serde_json::to_vec(&mechanism_file(&again)).unwrap(),
                written
            );
            if m.joints.len() >= 20 {
                return "large".to_owned();
            }
            match analyse_states(&m, &[StateId::FREE], Method::Auto) {
                Ok(_) => "analysed".to_owned(),
                Err(e) => e.to_string(),
            }
        }
        Err(e) => told(&e),
    }
}

/// What is wrong with a file, in words.
pub(crate) fn told(e: &ImportError) -> String {
    assert!(!e.problems.is_empty());
    let _ = e.render(true);
    let said = e.problems.iter().map(|p| p.kind.to_string());
    said.collect_vec().join("\n")
}

/// Reads the tables of a workload, with the mechanism around them and alone. Returns what was said.
pub(crate) fn workload(bytes: &[u8]) -> String {
    let of = "x.toml";
    let all = [
        tables_alone(of, bytes).map(|tables| format!("{tables:?}")),
        grip_from_bytes(of, bytes).map(|file| file.name),
        drive_from_bytes(of, bytes).map(|file| file.name),
    ];
    let said = all.map(|read| read.unwrap_or_else(|e| told(&e)));
    said.join("\n")
}

/// The built-in mechanisms with such tables.
pub(crate) fn workloads() -> Vec<Vec<u8>> {
    let all = builtin::all().into_iter().map(|(_, text)| text);
    let tables = ["[workload.grip", "[workload.drive"];
    all.filter(|text| tables.iter().any(|t| text.contains(t)))
        .map(|text| text.as_bytes().to_vec())
        .collect()
}

/// Some built-in mechanisms.
pub(crate) fn toml() -> Vec<Vec<u8>> {
    let some = builtin::names().into_iter().step_by(7);
    some.map(|n| builtin::text(n).unwrap().as_bytes().to_vec())
        .collect()
}

pub(crate) fn json() -> Vec<Vec<u8>> {
    let some = toml().into_iter().map(|text| {
        let text = String::from_utf8(text).unwrap();
        let value: toml::Value = toml::from_str(&text).unwrap();
        serde_json::to_vec_pretty(&value).unwrap()
    });
    some.collect()
}
