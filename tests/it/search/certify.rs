//! The checks of the search: a second prime, and singular values.

use crate::common::*;
use ozols::search::check::second_prime::{
    Verdict, build_both, compare_counts, compare_primes, primes,
};
use ozols::search::check::singular_values;

/// The four-bar with one axis tilted out of parallel by a number that a prime near 2^61 divides.
fn tilted() -> String {
    let text = run_quiet("show four-bar");
    let at = text.find("id = \"2-3\"").unwrap();
    let axis = "axis = [\"2305843009213693973/30000000\", 0, 1]";
    format!(
        "{}{}",
        &text[..at],
        text[at..].replacen("axis = [0, 0, 1]", axis, 1)
    )
}

/// The four-bar with one axis tilted by next to nothing: not parallel exactly, parallel to double precision.
fn shaky() -> String {
    tilted().replace("\"2305843009213693973/30000000\"", "1e-11")
}

/// The searches of two files, as if they were one over two primes.
fn compared([one, other]: [&str; 2]) -> Result<(Verdict, [u64; 2]), String> {
    let over = |text: &str, nth| {
        let m = read(text);
        Search::new(exact_field(&m, nth).unwrap(), &m, Conditions::default()).unwrap()
    };
    let (first, second) = (over(one, 0), over(other, 1));
    let searches: [&Question; 2] = [&first, &second];
    let (a, b) = build_both(searches, &|| false, &mut |_| {});
    let counts = [(&first, &a), (&second, &b)].map(|(s, d)| SearchCounts::of_diagrams(s, d));
    let by_counts = compare_counts(searches, counts.each_ref());
    let whole = compare_primes(searches, [&a, &b], 10);
    assert_eq!(by_counts.is_ok(), whole.is_ok());
    match whole {
        Ok(v) => Ok((v, primes(searches))),
        Err(e) => Err(e.to_string()),
    }
}

fn both(text: &str) -> Result<(Verdict, [u64; 2]), String> {
    compared([text, text])
}

#[test]
fn two_primes_agree_on_every_built_in_mechanism() {
    for name in ozols::builtin::names() {
        let (verdict, [p, q]) = both(ozols::builtin::text(name).unwrap()).unwrap();
        assert!(verdict == Verdict::Agree && p != q, "{name}");
    }
}

#[test]
fn primes_that_disagree_are_told_apart() {
    let four_bar = run_quiet("show four-bar");
    let said = compared([&four_bar, &tilted()]).unwrap_err();
    has_all(
        &said,
        &["primes disagree", "34 determinate", "36 determinate"],
    );
    assert_eq!(both(&tilted()).unwrap().0, Verdict::Agree);
}

#[test]
fn the_check_is_reported() {
    let v = run_json("search four-bar --format json");
    assert_eq!(v["check"]["agree"], true);
    assert_eq!(v["check"]["primes"].list().len(), 2);
    let v = run_json("search four-bar --format json --check none");
    assert_eq!(v["check"], Value::Null);
    let says =
        |check| run_quiet(&["search", "four-bar", "--check", check]).contains("Checked: two runs");
    assert!(says("prime") && says("full") && !says("none"));
    let mirror = ["search", "gripper-10", "--one-per-orbit", "--count"];
    assert!(run_quiet(&mirror).contains("Checked: two runs"));
}

#[test]
fn singular_values_agree_on_the_best_of_every_built_in_mechanism() {
    for name in ozols::builtin::names() {
        let m = built_in(name);
        let clamped = m.states.len() > 1;
        for (keep_output, max_redundant) in [(true, 0), (false, 100)] {
            let request = Conditions {
                keep_output,
                max_redundant,
                state: clamped.then_some(InState {
                    hold_objects: false,
                    ..InState::holding(StateId::new(1))
                }),
                ..Conditions::default()
            };
            let search = Search::new(exact_field(&m, 0).unwrap(), &m, request).unwrap();
            if max_redundant > 0 && search.size() > 1500u32.into() {
                continue;
            }
            let diagrams = search.build_diagrams(&|| false, &mut |_| {});
            let mut list: Vec<_> = search.sample_variants(&diagrams, 1).take(10).collect();
            list.extend(search.cheapest_variants(&diagrams, 10));
            for c in singular_values::certify_variants(&search, list, true, None, &|| false) {
                let o = *c.second.opinion().unwrap();
                assert!(o.agree, "{name}: {c:?}");
                assert!(o.dropped < 1e-12 && o.conditioning > 1e-6, "{name}: {o:?}");
            }
        }
    }
}

#[test]
fn a_variant_that_two_methods_see_differently_is_marked() {
    let (_folder, path) = write_temporary("shaky.toml", shaky());
    let said = |more: &[&str]| {
        let (_, told, warned) = run_full(&[&["search", path][..], more].concat());
        has(&warned, "nearly singular");
        told
    };
    let v: Value = serde_json::from_str(&said(&["--format", "json", "--all"])).unwrap();
    assert_eq!(v["check"]["agree"], true, "the primes see the same");
    let variants = v["variants"].list();
    let wrong: Vec<&Value> = variants.iter().filter(|x| x["agree"] == false).collect();
    assert!(!wrong.is_empty() && v["variants_disagreeing"] == wrong.len());
    for x in wrong {
        let gap = (&x["svd"]["smallest_kept"], &x["svd"]["largest_dropped"]);
        assert!(gap.0.real() > 1e-9 && gap.1.real() < 1e-9);
        assert!(x["svd"]["redundant"] != x["redundant"] || x["svd"]["mobility"] != x["mobility"]);
    }
    let text = said(&[]);
    has_all(
        &text,
        &[
            "Singular values disagree",
            " *  ",
            "  * 1: by singular values W = ",
        ],
    );
    let csv = said(&["--format", "csv"]);
    let column = |name: &str| {
        csv.lines()
            .next()
            .unwrap()
            .split(',')
            .position(|h| h == name)
    };
    let first: Vec<&str> = csv.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(first[column("agree").unwrap()], "false");
}

#[test]
fn nearly_singular_variants_are_marked() {
    let (_folder, path) = write_temporary("near.toml", shaky().replace("1e-11", "1e-6"));
    let text = run_quiet(&["search", path]);
    has(&text, "nearly singular");
    has(&text, "Singular values agree");
}

#[test]
fn a_long_list_says_where_the_checking_ends() {
    let options = ["search", "gripper-10", "--options", "revolute,spherical"];
    let wide = ["--allow-output-change", "--top", "1034"];
    let text = run_quiet(&[&options[..], &wide].concat());
    assert!(text.contains("agree on the first 1,000; the rest was not asked"));
    let v = run_json(&[&options[..], &wide, &["--format", "json"]].concat());
    let variants = v["variants"].list();
    assert_eq!(variants.len(), 1034);
    assert_eq!(v["variants_checked"], 1000);
    assert!(variants[999]["agree"] == true && variants[1000]["agree"].is_null());
}

/// The four-bar turned by 30 degrees about x, in floating point.
fn turned(axis: &str) -> String {
    let (c, s) = (3f64.sqrt() / 2.0, 0.5);
    let mut text = run_quiet("show four-bar");
    for (x, y) in [(0, 0), (0, 30), (80, 90), (120, 0)] {
        let (u, v) = (f64::from(y) * c, f64::from(y) * s);
        text = text.replace(
            &format!("point = [{x}, {y}, 0]"),
            &format!("point = [{x}, {u:?}, {v:?}]"),
        );
    }
    text.replace("axis = [0, 0, 1]", axis)
}

#[test]
fn measured_coordinates_that_do_no_harm_are_warned_about() {
    // One axis for all: parallel whatever its digits are.
    let (code, stdout, stderr) = run_on(
        "search",
        "it.toml",
        &turned("axis = [0, -0.5, 0.8660254037844386]"),
        "--format json",
    );
    assert_eq!(code, Some(0), "{stderr}");
    has(&stderr, "snapped: 4 axes parallel");
    let v: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(v["measured"]["agree"], true);
    assert_eq!(v["measured"]["states"][0]["exact"]["redundant"], 3);
    assert_eq!(v["determinate"], "34");
    let exact = run_json("search four-bar --format json");
    assert_eq!(exact["measured"], Value::Null);
    assert_eq!(exact["determinate"], v["determinate"]);
}

#[test]
fn measured_coordinates_that_change_the_figures_are_searched_as_meant() {
    let mut text = turned("axis = [0, -0.5, 0.8660254037844386]");
    let at = text.find("id = \"2-3\"").unwrap();
    let last = text[at..].replacen("0.8660254037844386", "0.8660254037844387", 1);
    text.replace_range(at.., &last);
    let (code, stdout, stderr) = run_on("search", "it.toml", &text, "--format json");
    assert_eq!(code, Some(0), "{stderr}");
    has(&stderr, "snapped: 4 axes parallel");
    let v: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(v["determinate"], "34");
    assert_eq!(v["measured"]["states"][0]["exact"]["redundant"], 2);
    assert_eq!(v["measured"]["states"][0]["svd"]["redundant"], 3);
    assert_eq!(v["variants"][0]["agree"], true);
    let (code, stdout, stderr) = run_on("search", "it.toml", &text, "--as-written --format json");
    assert!(
        code == Some(0) && stderr.starts_with("warning: "),
        "{stderr}"
    );
    has_all(&stderr, &["W = 0, σ = 2", "W = 1, σ = 3", "[tolerance]"]);
    let v: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(v["measured"]["agree"], false);
    assert_eq!(v["measured"]["states"][0]["svd"]["redundant"], 3);
    assert_eq!(v["variants"][0]["agree"], false);
    // Nine digits, measured to nine digits: the tolerance follows.
    let nine = text.replace("0.8660254037844386", "0.866025404");
    let nine = nine.replace("0.8660254037844387", "0.866025403");
    let (code, _, stderr) = run_on("search", "it.toml", &nine, "--as-written");
    assert_eq!(code, Some(0));
    has(&stderr, "to within 2e-9 it is meant to have W = 1, σ = 3");
}

#[test]
fn singular_values_see_a_tilted_plane_as_the_exact_ranks_do() {
    let mut text = run_quiet("show four-bar-planar");
    // Any plane will do, as long as all points are in it: here z = x + 2 y - 3 y = x - y with decimals that round.
    text = text.replace("axis = [0, 0, 1]", "axis = [\"1/7\", \"-1/7\", \"-1/7\"]");
    for (i, p) in [
        "[0.1, 0.3, -0.2]",
        "[0.7, 0.2, 0.5]",
        "[1.9, 0.6, 1.3]",
        "[2.3, 0.1, 2.2]",
    ]
    .iter()
    .enumerate()
    {
        let at = text.match_indices("point = ").nth(i).unwrap().0;
        let end = at + text[at..].find('\n').unwrap();
        text.replace_range(at..end, &format!("point = {p}"));
    }
    let normal = "plane_normal = [\"1/7\", \"-1/7\", \"-1/7\"]";
    text = text.replace("plane_normal = [0, 0, 1]", normal);
    let m = read(&text);
    let (search, diagrams) = searched(&m, Conditions::default());
    let list: Vec<_> = search.sample_variants(&diagrams, 1).take(20).collect();
    assert!(!list.is_empty());
    for c in singular_values::certify_variants(&search, list, true, None, &|| false) {
        assert!(c.second.opinion().unwrap().agree, "{c:?}");
    }
}
