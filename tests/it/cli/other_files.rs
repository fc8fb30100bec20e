//! Mechanism files in JSON; files that are no mechanism at all: bytes, sizes, names.

use super::bad_files::bad_file;
use super::{assert_refused, four_bar};
use crate::common::*;

fn four_bar_json() -> String {
    let value: Value = toml::from_str(&four_bar()).unwrap();
    serde_json::to_string_pretty(&value).unwrap()
}

#[test]
fn json_is_read_like_toml() {
    let (_folder, path) = write_temporary("four-bar.json", four_bar_json());
    // What to do next names the file.
    let from = |file: &str| run_json(&["analyze", file, "--format", "json"])["states"].take();
    assert_eq!(from(path), from("four-bar"));
    assert_eq!(
        run_quiet(&["search", path, "--format", "json"]),
        run_quiet("search four-bar --format json")
    );
}

#[test]
fn error_in_json() {
    let text = four_bar_json();
    for [from, to, said] in read_cases::<3>(
        r#"
        "revolute" | "hing" | unknown joint type "hing"
        "drive": true | "drive": true true | expected
        "drive": true | "drive": 7 | true, false or the freedom that is driven
        "drive" | "driven" | driven
        "frame" | "fram" | unknown role "fram"
        "#,
    ) {
        bad_file("bad.json", &text.replacen(from, to, 1), to, &[said]);
    }
}

#[test]
fn files_that_are_no_text_are_refused() {
    let large = vec![b'#'; (4 << 20) + 1];
    bad_bytes(&large, &["4194305 bytes", "4194304 allowed"]);
    bad_bytes(b"name = \"\xff\"\n", &["not UTF-8", "byte 8"]);
    bad_bytes(b"", &["the file is empty"]);
    bad_bytes(b" \n\n", &["the file is empty"]);
}

/// Asserts that the bytes are refused with these words; there is no line to name.
fn bad_bytes(bytes: &[u8], parts: &[&str]) {
    for name in ["bad.toml", "bad.json"] {
        let (_folder, path) = write_temporary(name, bytes);
        has(&assert_refused(&["check", path], parts), name);
    }
}
