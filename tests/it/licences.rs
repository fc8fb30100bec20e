//! What the program is built from may be handed out with it, and comes from where packages are kept for good.

use crate::common::*;
use std::process::Command;

/// Licences that ask for no more than that they are passed on.
const ALLOWED: &str = "0BSD|Apache-2.0|Apache-2.0 WITH LLVM-exception|BSD-2-Clause|BSD-3-Clause|BSL-1.0|CC0-1.0\
    |ISC|MIT|Unicode-3.0|Unlicense|Zlib";

/// Whether a licence expression (SPDX) can be met by allowed ones.
fn allowed(expression: &str) -> bool {
    let text = expression.replace('/', " OR ");
    let text = text.trim();
    // The last operator outside of parentheses that binds least divides the expression.
    for operator in [" OR ", " AND "] {
        let mut depth = 0;
        for (i, c) in text.char_indices() {
            depth += i32::from(c == '(') - i32::from(c == ')');
            if depth == 0 && text[i..].starts_with(operator) {
                let (a, b) = (allowed(&text[..i]), allowed(&text[i + operator.len()..]));
                return if operator == " OR " { a || b } else { a && b };
            }
        }
    }
    match text.strip_prefix('(').and_then(|t| t.strip_suffix(')')) {
        Some(inner) => allowed(inner),
        None => ALLOWED.split('|').any(|a| a == text),
    }
}

#[test]
fn licence_expressions_are_read() {
    for yes in "MIT|GPL-3.0 OR MIT|(MIT OR GPL-3.0) AND Zlib|MIT/GPL-2.0".split('|') {
        assert!(allowed(yes), "{yes}");
    }
    for no in "GPL-3.0|MIT AND GPL-3.0|(GPL-3.0 OR LGPL-3.0) AND MIT|".split('|') {
        assert!(!allowed(no), "{no}");
    }
}

#[test]
fn every_dependency_may_be_handed_out() {
    // Those of other machines need not be here.
    let told = Command::new("rustc").arg("-vV").output().unwrap();
    let told = String::from_utf8(told.stdout).unwrap();
    let host = told.lines().find_map(|l| l.strip_prefix("host: ")).unwrap();
    let o = Command::new(env!("CARGO"))
        // What only the Python package needs is perhaps not here yet, and is fetched.
        .args(["metadata", "--format-version", "1", "--locked"])
        .args(["--filter-platform", host])
        .args([
            "--manifest-path",
            concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"),
        ])
        .output()
        .unwrap();
    let v: Value = serde_json::from_slice(&o.stdout).unwrap();
    let packages = v["packages"].list();
    assert!(packages.len() > 50);
    for p in packages {
        let licence = p["license"].as_str().unwrap_or_default();
        assert!(allowed(licence), "{}: licence {licence:?}", p["name"]);
        // Not from a branch of somebody's, which may go or change.
        let kept = p["source"]
            .as_str()
            .is_none_or(|s| s.starts_with("registry+"));
        assert!(kept, "{}: {}", p["name"], p["source"]);
    }
}
