//! No file makes the program panic.

use ozols::builtin;
use ozols::file::text::mechanism_from_bytes;
use ozols::model::mechanism::StateId;
use ozols::redundancy::analysis::{Method, analyse};
use proptest::prelude::*;

fn read(name: &str, bytes: &[u8]) {
    match mechanism_from_bytes(name, bytes) {
        Ok(m) if m.joints.len() < 20 => {
            let _ = analyse(&m, &[StateId::FREE], Method::Auto { tolerance: None });
        }
        Ok(_) => {}
        Err(e) => {
            assert!(!e.problems.is_empty());
            let _ = (e.render(true), e.to_string());
        }
    }
}

const NASTY: [&str; 12] = [
    "1e308",
    "-0.0",
    "nan",
    "inf",
    "99999999999999999999",
    "\"sqrt(-1)\"",
    "\"1/0\"",
    "\"tan(90deg)\"",
    "[]",
    "{}",
    "\"\"",
    "\"2^(2^9)\"",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]
    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read("x.toml", &bytes);
        read("x.json", &bytes);
    }

    #[test]
    fn spoilt_files(
        which in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        length in 0usize..40,
        put in prop_oneof![".{0,8}", prop::sample::select(&NASTY[..]).prop_map(str::to_owned)],
    ) {
        let names = builtin::names();
        let mut text = builtin::text(names[which.index(names.len())]).unwrap().as_bytes().to_vec();
        let start = at.index(text.len());
        let end = (start + length).min(text.len());
        text.splice(start..end, put.bytes());
        read("x.toml", &text);
    }

    #[test]
    fn spoilt_numbers(which in any::<prop::sample::Index>(), at in any::<prop::sample::Index>(), put in prop::sample::select(&NASTY[..])) {
        let names = builtin::names();
        let text = builtin::text(names[which.index(names.len())]).unwrap();
        let digits: Vec<usize> = text.match_indices(|c: char| c.is_ascii_digit()).map(|(i, _)| i).collect();
        let i = digits[at.index(digits.len())];
        read("x.toml", format!("{}{put}{}", &text[..i], &text[i + 1..]).as_bytes());
    }
}

/// A mechanism of one hinge, with more behind its joint.
fn hinge(more: &str) -> String {
    format!(
        "name = \"x\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\nrole = \"output\"\n\
         [[joint]]\nid = \"a\"\nlinks = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n{more}\n"
    )
}

/// Each mistake was once looked up by reading the whole file again, and all of them were drawn: minutes for a few megabytes.
#[test]
fn of_very_many_mistakes_the_first_are_told() {
    let mirror = r#"["a", "a"], "#.repeat(5000);
    let costs: String = (0..5000).map(|i| format!("b{i} = 1\n")).collect();
    for more in [
        format!("[search]\nmirror = [{mirror}]"),
        format!("[search.costs]\n{costs}"),
        "[[expected]]\nstate = \"nowhere\"\n".repeat(5000),
    ] {
        let e = mechanism_from_bytes("x.toml", hinge(&more).as_bytes()).unwrap_err();
        assert_eq!(e.problems.len(), 101);
        assert!(e.problems[..100].iter().all(|p| p.span.is_some()));
        let last = e.problems[100].kind.to_string();
        assert!(
            last.ends_with("more problems are not listed; mend those above first"),
            "{last}"
        );
    }
}

#[test]
fn lists_have_limits() {
    let words = |n: usize| (0..n).map(|i| format!("\"s{i}\", ")).collect::<String>();
    for (more, said) in [
        (format!("state = [{}]", words(200)), "states"),
        (
            format!("unloading = [{}]", "\"spherical\", ".repeat(65)),
            "65 unloading joints",
        ),
        (
            "[[contour]]\njoints = [\"a\"]\n".repeat(4001),
            "4001 contours",
        ),
    ] {
        let e = mechanism_from_bytes("x.toml", hinge(&more).as_bytes()).unwrap_err();
        let e = e.to_string();
        assert!(e.contains(said) && e.contains("allowed"), "{said}: {e}");
    }
}
