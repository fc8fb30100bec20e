//! Files of certificates.

use ozols::model::mechanism::StateId;
use ozols::rank::exact::certificate::{certify_state, closure_matrix, number_field};
use ozols::verify;
use ozols::verify::certificate::{CertificateFile, FORMAT};
use ozols::verify::matrix::MatrixOverRing;
use std::sync::LazyLock;

/// Mechanisms over the rationals, with roots, and with cosines.
pub(crate) const NAMES: [&str; 4] = ["four-bar", "bennett", "peaucellier", "schatz-turbula"];

pub(crate) const WORDS: [&str; 16] = [
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
        let m = ozols::built_in(name).unwrap();
        let certificate = certify_state(&m, StateId::FREE).unwrap();
        let rank = certificate.rank;
        let file = CertificateFile {
            format: FORMAT.to_owned(),
            mechanism: m.name.clone(),
            certificates: vec![certificate],
            without: Vec::new(),
        };
        let over =
            closure_matrix(&number_field(&m, StateId::FREE).unwrap(), &m, StateId::FREE).unwrap();
        (over, rank, serde_json::to_string_pretty(&file).unwrap())
    };
    NAMES.iter().map(|name| certified(name)).collect()
});

/// No rank but the right one is accepted of a file about one of the mechanisms. Returns what was said.
pub(crate) fn look_at(which: usize, bytes: &[u8]) -> String {
    let (over, rank, _) = &CERTIFIED[which];
    match CertificateFile::read(bytes) {
        Ok(file) => {
            let checked =
                file.certificates
                    .iter()
                    .map(|c| match verify::check_certificate(over, c) {
                        Ok(accepted) => {
                            assert_eq!(accepted, *rank);
                            "accepted".to_owned()
                        }
                        Err(flaw) => flaw.to_string(),
                    });
            checked.collect::<Vec<_>>().join("\n")
        }
        Err(e) => {
            let said = e.to_string();
            assert!(!said.is_empty());
            said
        }
    }
}

pub(crate) fn seeds() -> Vec<Vec<u8>> {
    let texts = CERTIFIED.iter().map(|(.., text)| text.as_bytes().to_vec());
    texts.collect()
}

/// Looks at a file about the mechanism that it names.
pub(crate) fn look(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let named = NAMES.iter().position(|name| text.contains(name));
    look_at(named.unwrap_or(0), bytes)
}
