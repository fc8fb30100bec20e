//! What was found in small files beside mechanisms.

use super::readers::small_files::{sweep, sweep_seeds};

/// Rows of other parameters than the first line has were read, and the table of them could not be written.
#[test]
fn rows_of_other_parameters_are_refused() {
    let whole = String::from_utf8(sweep_seeds()[0].clone()).unwrap();
    assert!(sweep(whole.as_bytes()).starts_with("drawn"));
    for (from, to) in [
        ("\"at\":{\"a\":1,\"b\":2}", "\"at\":{\"a\":1}"),
        ("\"at\":{\"a\":2,\"b\":1}", "\"at\":{\"a\":2,\"c\":1}"),
    ] {
        let said = sweep(crate::common::changed(&whole, from, to).as_bytes());
        assert!(said.contains("has other parameters"), "{said}");
    }
}
