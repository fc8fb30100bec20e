//! Certificates of rank: every built-in mechanism has one, random matrices do, and none that is false is accepted.

use ozols::builtin;
use ozols::import::text::mechanism_from_str;
use ozols::model::mechanism::Mechanism;
use ozols::rank::certificate::{certify, matrix, number_field};
use ozols::rank::rational;
use ozols::redundancy::analysis::{Method, analyse};
use ozols::verify;

fn built_in(name: &str) -> Mechanism {
    mechanism_from_str(&format!("{name}.toml"), builtin::text(name).unwrap()).unwrap()
}

#[test]
fn every_built_in_mechanism_is_certified_in_every_state() {
    let mut without = Vec::new();
    for name in builtin::names() {
        let m = built_in(name);
        for state in 0..m.states.len() {
            let rank = analyse(&m, &[state], Method::Modular).unwrap()[0].rank;
            let start = std::time::Instant::now();
            let certificate = match certify(&m, state) {
                Ok(certificate) => certificate,
                Err(reason) => {
                    without.push(format!("{name} {}: {reason}", m.states[state]));
                    continue;
                }
            };
            let took = start.elapsed();
            let field = number_field(&m, state).unwrap();
            let j = matrix(&field, &m, state).unwrap();
            let start = std::time::Instant::now();
            assert_eq!(verify::check(&j, &certificate), Ok(rank), "{name}");
            println!(
                "{name} {}: {} x {} degree {} rank {rank}: made in {took:?}, checked in {:?}, {} bytes",
                m.states[state],
                j.rows(),
                j.columns(),
                j.ring().dimension(),
                start.elapsed(),
                serde_json::to_string(&certificate).unwrap().len(),
            );
            if let Some(plain) = rational::rank(&j) {
                assert_eq!(plain, rank, "{name}");
            }
        }
    }
    assert!(without.is_empty(), "{without:#?}");
}
