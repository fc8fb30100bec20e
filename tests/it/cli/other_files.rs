//! Mechanism files in JSON; files that are no mechanism at all: bytes, sizes, names.

use super::bad_files::bad_file;
use super::{four_bar, refused};
use crate::common::*;

fn four_bar_json() -> String {
    let value: Value = toml::from_str(&four_bar()).unwrap();
    serde_json::to_string_pretty(&value).unwrap()
}

#[test]
fn json_is_read_like_toml() {
    let (_folder, path) = written("four-bar.json", four_bar_json());
    // What to do next names the file.
    let from = |file: &str| json(&["analyze", file, "--format", "json"])["states"].take();
    assert_eq!(from(path), from("four-bar"));
    assert_eq!(
        out(&["search", path, "--format", "json"]),
        out(&["search", "four-bar", "--format", "json"])
    );
}

#[test]
fn error_in_json() {
    let text = four_bar_json();
    bad_file(
        "bad.json",
        &text.replacen("\"revolute\"", "\"hinge\"", 1),
        "hinge",
        &["unknown joint type \"hinge\""],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"drive\": true", "\"drive\": true true", 1),
        "true true",
        &["expected"],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"drive\": true", "\"drive\": 7", 1),
        "\"drive\": 7",
        &["true, false or the freedom that is driven"],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"drive\"", "\"driven\"", 1),
        "driven",
        &["driven"],
    );
    bad_file(
        "bad.json",
        &text.replacen("\"frame\"", "\"fram\"", 1),
        "\"fram\"",
        &["unknown role \"fram\""],
    );
}

/// Asserts that the bytes are refused with these words; there is no line to name.
fn bad_bytes(bytes: &[u8], parts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    for name in ["bad.toml", "bad.json"] {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        let said = refused(&["check", path.to_str().unwrap()], parts);
        assert!(said.contains(name));
    }
}

#[test]
fn error_too_large() {
    bad_bytes(
        &vec![b'#'; (4 << 20) + 1],
        &["4194305 bytes", "4194304 allowed"],
    );
}

#[test]
fn error_not_utf8() {
    bad_bytes(b"name = \"\xff\"\n", &["not UTF-8", "byte 8"]);
}

#[test]
fn error_empty_file() {
    bad_bytes(b"", &["the file is empty"]);
    bad_bytes(b" \n\n", &["the file is empty"]);
}

#[test]
fn error_missing_file_and_unknown_name() {
    refused(
        &["check", "/no/such/file.toml"],
        &[
            "/no/such/file.toml",
            "neither a file nor a built-in mechanism",
        ],
    );
    refused(
        &["analyze", "gripper-1"],
        &["gripper-1", "did you mean", "gripper-10", "ozols list"],
    );
    refused(&["search", "zzz"], &["zzz is neither"]);
    refused(&["show", "zzz"], &["zzz is not a built-in mechanism"]);
    let folder = tempfile::tempdir().unwrap();
    refused(
        &["check", folder.path().to_str().unwrap()],
        &["is a folder; name a file in it"],
    );
    if cfg!(unix) {
        refused(
            &["check", "/dev/null"],
            &["is no regular file", "standard input"],
        );
    }
}
