//! From a mechanism file to its redesigns in every form in which they are written, and back from there.

use super::mechanism_files::told;
use crate::common::*;
use ozols::Scheme;
use ozols::file::text::mechanism_from_bytes;
use ozols::file::write::mechanism_file;
use ozols::rank::exact::certificate::{certify_state, closure_matrix, number_field};
use ozols::score::request::{Check, List};
use ozols::score::run::run;
use ozols::search::question::conditions::Symmetry;
use ozols::verify;
use ozols::verify::certificate::{CertificateFile, FORMAT};
use ozols::view::search::{csv, json, text};
use ozols::{Outcome, Request};
use std::time::{Duration, Instant};

/// So long a search may take; then it is ended, as by somebody who waits for it.
const PATIENCE: Duration = Duration::from_secs(2);
/// Joints of a mechanism at most.
const JOINTS: usize = 12;

/// What is asked of the search, from a byte.
fn request(bits: u8) -> Request {
    let on = |bit: u8| bits >> bit & 1 == 1;
    Request {
        max_redundant: u32::from(bits & 3),
        allow_output_change: on(2),
        distinct: on(3),
        symmetry: if on(4) {
            Symmetry::OnePerOrbit
        } else {
            Symmetry::All
        },
        as_written: on(5),
        check: if on(6) { Check::None } else { Check::Full },
        max_mobility: on(7).then_some(1),
        nodes: 2000,
        memory: 64 << 20,
        pool: Some(20),
        list: List::Top(4),
        ..Request::default()
    }
}

/// Reads a mechanism, whose last byte says what is asked, and searches it. Returns what was found.
pub(crate) fn look(bytes: &[u8]) -> String {
    let Some((&bits, file)) = bytes.split_last() else {
        return String::new();
    };
    let m = match mechanism_from_bytes("x.toml", file) {
        Ok(m) => m,
        Err(e) => return told(&e),
    };
    if m.joints.len() > JOINTS {
        return "large".to_owned();
    }
    for scheme in [Scheme::Structural, Scheme::Kinematic] {
        if let Ok(svg) = ozols::draw(&m, scheme)
            && let Err(e) = roxmltree::Document::parse(&svg)
        {
            panic!("{e} in\n{svg}");
        }
    }
    proven(&m);
    let begun = Instant::now();
    let ended = || begun.elapsed() > PATIENCE;
    match run(m, &request(bits), &ended, &mut |_| {}) {
        Ok(outcome) => written(&outcome),
        Err(e) => e.to_string(),
    }
}

/// The certificate of a mechanism, written and read, proves the rank that the analysis finds.
fn proven(m: &Mechanism) {
    let Ok(certificate) = certify_state(m, StateId::FREE) else {
        return;
    };
    let file = CertificateFile {
        format: FORMAT.to_owned(),
        mechanism: m.name.clone(),
        certificates: vec![certificate],
        without: Vec::new(),
    };
    let text = serde_json::to_vec(&file).unwrap();
    let again = CertificateFile::read(&text).unwrap();
    assert_eq!(again, file);
    let over = closure_matrix(&number_field(m, StateId::FREE).unwrap(), m, StateId::FREE).unwrap();
    let rank = verify::check_certificate(&over, &again.certificates[0]).unwrap();
    let found = analyse_states(m, &[StateId::FREE], Method::Modular).unwrap();
    assert_eq!(rank, found[0].rank);
}

/// The outcome in every form; JSON says the same, and each variant is what it is said to be. Returns the counts.
fn written(outcome: &Outcome) -> String {
    let none = outcome.make_remarks(&|| false).unwrap_or_default();
    let (mut told, mut table, mut words) = (Vec::new(), Vec::new(), Vec::new());
    json::write_json(&mut told, outcome, outcome.variants(), &none, None).unwrap();
    csv::write_csv(&mut table, outcome, outcome.variants()).unwrap();
    text::write_text(
        &mut words,
        outcome,
        outcome.variants(),
        &none,
        "x",
        Some(80),
        true,
    )
    .unwrap();
    let told: Value = serde_json::from_slice(&told).unwrap();
    let number = |key: &str| told[key].word().to_owned();
    assert_eq!(number("determinate"), outcome.determinate.to_string());
    assert_eq!(number("admissible"), outcome.admissible.to_string());
    let list: Vec<_> = outcome.variants().collect();
    assert_eq!(told["variants"].list().len(), list.len());
    for v in &list {
        let made = v.as_mechanism();
        let file = ozols::export(&made, "toml").unwrap();
        let again =
            mechanism_from_str("x.toml", &file).unwrap_or_else(|e| panic!("{e} in\n{file}"));
        let json = |m: &Mechanism| mechanism_file(m).json();
        assert_eq!(json(&again), json(&made));
        if outcome.numeric.is_none() {
            let found = &analyse_states(&made, &[StateId::FREE], Method::Modular).unwrap()[0];
            assert_eq!(
                (found.mobility as i64, found.redundant),
                (v.mobility(), v.redundant() as usize),
                "{file}"
            );
        }
    }
    format!("{} of {}", outcome.admissible, outcome.determinate)
}
