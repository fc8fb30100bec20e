//! No file makes the program panic.

use ozols::builtin;
use ozols::import::text::mechanism_from_bytes;
use ozols::redundancy::analysis::{Method, analyse};
use proptest::prelude::*;

fn read(name: &str, bytes: &[u8]) {
    match mechanism_from_bytes(name, bytes) {
        Ok(m) if m.joints.len() < 20 => {
            let _ = analyse(&m, &[0], Method::Auto { tolerance: None });
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
