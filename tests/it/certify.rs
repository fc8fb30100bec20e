//! The checks of the search: a second prime, and singular values.

use crate::cli::{json, out, ozols};
use ozols::import::text::mechanism_from_str;
use ozols::redundancy::analysis::exact_field;
use ozols::search::primes::{Verdict, build_both, compare, compare_counts, primes};
use ozols::search::request::{Request, Search};
use serde_json::Value;
use std::fs;

/// The four-bar with one axis tilted out of parallel by a number that the first prime divides: modulo that prime it is
/// parallel.
fn trap() -> String {
    let text = out(&["show", "four-bar"]);
    let at = text.find("id = \"2-3\"").unwrap();
    let axis = "axis = [\"2305843009213693973/10000000\", 0, 1]";
    format!(
        "{}{}",
        &text[..at],
        text[at..].replacen("axis = [0, 0, 1]", axis, 1)
    )
}

fn both(text: &str) -> Result<(Verdict, [u64; 2]), String> {
    let m = mechanism_from_str("it.toml", text).unwrap();
    let over = |nth| Search::new(exact_field(&m, nth).unwrap(), &m, Request::default()).unwrap();
    let (first, second) = (over(0), over(1));
    let searches = [&first, &second];
    let (a, b) = build_both(searches, &|| false, &mut |_| {});
    let counts = |s: &Search<'_>, d: &ozols::search::building::Diagrams| {
        (
            s.counts(&d.determinate, false),
            s.counts(&d.admissible, true),
        )
    };
    let by_counts = compare_counts(searches, [&counts(&first, &a), &counts(&second, &b)]);
    let whole = compare(searches, [&a, &b], 10);
    assert_eq!(by_counts.is_ok(), whole.is_ok());
    match whole {
        Ok(v) => Ok((v, primes(searches))),
        Err(e) => Err(e.to_string()),
    }
}

#[test]
fn two_primes_agree_on_every_built_in_mechanism() {
    for name in ozols::builtin::names() {
        let (verdict, [p, q]) = both(ozols::builtin::text(name).unwrap()).unwrap();
        assert!(verdict == Verdict::Agree && p != q, "{name}");
    }
}

#[test]
fn a_prime_that_divides_a_coordinate_is_found_out() {
    let said = both(&trap()).unwrap_err();
    for part in [
        "primes disagree",
        "34 determinate",
        "36 determinate",
        "W = 0",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trap.toml");
    fs::write(&path, trap()).unwrap();
    let path = path.to_str().unwrap();
    for check in ["prime", "full"] {
        let o = ozols(&["search", path, "--check", check]).output().unwrap();
        let text = String::from_utf8(o.stderr).unwrap();
        assert_eq!((o.status.code(), o.stdout.len()), (Some(2), 0));
        assert!(text.contains("primes disagree"), "{text}");
    }
}

#[test]
fn the_check_is_reported() {
    let v = json(&["search", "four-bar", "--format", "json"]);
    assert_eq!(v["check"]["agree"], true);
    assert_eq!(v["check"]["primes"].as_array().unwrap().len(), 2);
    let v = json(&["search", "four-bar", "--format", "json", "--check", "none"]);
    assert_eq!(v["check"], Value::Null);
    let says = |check| out(&["search", "four-bar", "--check", check]).contains("Checked: modulo");
    assert!(says("prime") && says("full") && !says("none"));
    let mirror = ["search", "gripper-10", "--one-per-orbit", "--count"];
    assert!(out(&mirror).contains("Checked: modulo"));
}
