//! The checks of the search: a second prime, and singular values.

use crate::common::*;
use ozols::search::check::second_prime::{PrimeCheck, build_both, compare_counts, compare_primes};

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
fn compared([one, other]: [&str; 2]) -> Result<PrimeCheck, String> {
    let over = |text: &str, nth| {
        let m = read(text);
        Search::new(exact_field(&m, nth).unwrap(), &m, Conditions::default()).unwrap()
    };
    let (first, second) = (over(one, 0), over(other, 1));
    let searches: [&Question; 2] = [&first, &second];
    let (a, b) = build_both(searches, Control::NONE);
    let counts = [(&first, &a), (&second, &b)].map(|(s, d)| SearchCounts::of_diagrams(s, d));
    let by_counts = compare_counts(searches, counts.each_ref());
    let whole = compare_primes(searches, [&a, &b]);
    assert_eq!(by_counts.is_ok(), whole.is_ok());
    whole.map_err(|e| e.to_string())
}

fn both(text: &str) -> Result<PrimeCheck, String> {
    compared([text, text])
}

#[test]
fn two_primes_agree_on_every_built_in_mechanism() {
    for name in ozols::builtin::names() {
        let check = both(ozols::builtin::text(name).unwrap()).unwrap();
        let [p, q] = check.primes;
        assert!(check.agree && p != q, "{name}");
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
    assert!(both(&tilted()).unwrap().agree);
}

#[test]
fn the_check_is_reported() {
    let v = run_json("search four-bar --format json");
    assert_eq!(v["check"]["agree"], true);
    assert_eq!(v["check"]["primes"].list().len(), 2);
    let v = run_json("search four-bar --format json --check none");
    assert_eq!(v["check"], Value::Null);
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
            let diagrams = search.build_diagrams(Control::NONE);
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
