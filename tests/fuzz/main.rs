//! The readers, the way from a mechanism to its redesigns, and the search against brute force, given inputs that libFuzzer
//! makes of earlier ones and keeps where they reach new code. `tests/fuzz/run` builds it and runs it.
//!
//! What is looked at, and what must hold, is in `tests/it/fuzz/readers.rs`: the usual tests give it what was kept.

#![no_main]

#[path = "../it/common/names.rs"]
mod common;
#[path = "../it/fuzz/readers.rs"]
mod readers;

use libfuzzer_sys::fuzz_target;
use readers::{READERS, Reader};
use std::sync::LazyLock;

/// A word as it stands in one of libFuzzer's dictionaries.
fn entry(word: &str) -> String {
    let bytes = word.bytes().map(|b| format!("\\x{b:02x}"));
    format!("\"{}\"\n", bytes.collect::<String>())
}

/// The reader that is named; its first inputs, and beside them its words, are written where a folder for them is named.
static READER: LazyLock<&Reader> = LazyLock::new(|| {
    let name = std::env::var("OZOLS_FUZZ_READER").expect("tests/fuzz/run names a reader");
    let reader = READERS.iter().find(|r| r.name == name);
    let reader = reader.expect("one of those of readers.rs");
    if let Ok(folder) = std::env::var("OZOLS_FUZZ_SEEDS") {
        for (i, seed) in (reader.seeds)().iter().enumerate() {
            std::fs::write(format!("{folder}/{i:03}"), seed).expect("a folder to write to");
        }
        let words = reader.words.iter().filter(|w| !w.is_empty());
        let words: String = words.map(|w| entry(w)).collect();
        std::fs::write(format!("{folder}.words"), words).expect("a folder to write beside");
        std::process::exit(0);
    }
    reader
});

fuzz_target!(
    init: {
        LazyLock::force(&READER);
    },
    |bytes: &[u8]| {
        (READER.look)(bytes);
    }
);
