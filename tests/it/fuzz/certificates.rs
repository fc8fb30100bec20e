//! Files of certificates: whatever is done to one, no wrong rank is accepted.

use super::{edits, runs, spoilt};
use ozols::builtin;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::StateId;
use ozols::rank::certificate::{certify, matrix, number_field};
use ozols::verify;
use ozols::verify::certificate::{CertificateFile, FORMAT};
use ozols::verify::matrix::MatrixOverRing;
use proptest::prelude::*;
use proptest::sample::Index;
use std::sync::LazyLock;

/// Mechanisms over the rationals, with roots, and with cosines.
const NAMES: [&str; 4] = ["four-bar", "bennett", "peaucellier", "schatz-turbula"];

const WORDS: [&str; 16] = [
    "0",
    "1",
    "-1",
    "2",
    "7",
    "1/7",
    "1/0",
    "-0",
    "18446744073709551615",
    "1e400",
    "null",
    "[]",
    "{}",
    "\"",
    ",",
    "]",
];

/// A mechanism's matrix, its rank, and the file of the certificate.
static CERTIFIED: LazyLock<Vec<(MatrixOverRing, usize, String)>> = LazyLock::new(|| {
    let certified = |name: &str| {
        let m = mechanism_from_str(name, builtin::text(name).unwrap()).unwrap();
        let certificate = certify(&m, StateId::FREE).unwrap();
        let rank = certificate.rank;
        let file = CertificateFile {
            format: FORMAT.to_owned(),
            mechanism: m.name.clone(),
            certificates: vec![certificate],
            without: Vec::new(),
        };
        let over = matrix(&number_field(&m, StateId::FREE).unwrap(), &m, StateId::FREE).unwrap();
        (over, rank, serde_json::to_string_pretty(&file).unwrap())
    };
    NAMES.iter().map(|name| certified(name)).collect()
});

proptest! {
    #![proptest_config(runs(512))]
    #[test]
    fn spoilt_certificates(which in any::<Index>(), edits in edits(&WORDS)) {
        let (over, rank, text) = &CERTIFIED[which.index(NAMES.len())];
        match CertificateFile::read(&spoilt(text, &edits)) {
            Ok(file) => {
                for certificate in &file.certificates {
                    if let Ok(accepted) = verify::check(over, certificate) {
                        prop_assert_eq!(accepted, *rank);
                    }
                }
            }
            Err(e) => prop_assert!(!e.to_string().is_empty()),
        }
    }
}
