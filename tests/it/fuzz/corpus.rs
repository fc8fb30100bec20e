//! Inputs that are kept: one for each way a reader has answered so far. They are spoilt further, and what is answered in a
//! new way is kept, too.
//!
//! Every run looks at all of `tests/corpus` and then spoils it for a second. A longer run, with its count of executions,
//! that adds what is new to the corpus, here of ten minutes a target:
//!
//! ```text
//! OZOLS_FUZZ_SECONDS=600 OZOLS_FUZZ_KEEP=1 cargo test --test integration fuzz::corpus -- --nocapture
//! ```
//!
//! `OZOLS_FUZZ_ONLY=robots` takes one of the targets alone, `OZOLS_FUZZ_SEED=8` spoils otherwise. An input that makes a reader
//! panic is told by its file `tests/corpus/TARGET/failed`; of one that hangs or aborts, the file `TARGET.current` of the
//! build's temporary folder has the bytes.

use super::{certificates, edits, expressions, mechanism_files, robot_files, spoilt};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Seek, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The longest that an input of a few kilobytes may take, in a build for tests.
const PATIENCE: Duration = Duration::from_secs(20);

/// Bytes of an input at most, and kinds of answers told apart.
const LONGEST: usize = 1 << 16;
const MOST: usize = 50_000;

/// A reader.
struct Target {
    name: &'static str,
    /// What it may stumble over.
    words: &'static [&'static str],
    /// What it is given first.
    seeds: fn() -> Vec<Vec<u8>>,
    /// Gives it an input, asserts what holds of every answer, and returns the answer.
    look: fn(&[u8]) -> String,
}

const TARGETS: [Target; 5] = [
    Target {
        name: "certificates",
        words: &certificates::WORDS,
        seeds: certificates::seeds,
        look: certificates::look,
    },
    Target {
        name: "expressions",
        words: &expressions::TOKENS,
        seeds: expressions::seeds,
        look: expressions::look,
    },
    Target {
        name: "json",
        words: &mechanism_files::WORDS,
        seeds: mechanism_files::json,
        look: |bytes| mechanism_files::read("x.json", bytes),
    },
    Target {
        name: "robots",
        words: &robot_files::WORDS,
        seeds: robot_files::seeds,
        look: robot_files::look,
    },
    Target {
        name: "toml",
        words: &mechanism_files::WORDS,
        seeds: mechanism_files::toml,
        look: |bytes| mechanism_files::read("x.toml", bytes),
    },
];

/// An answer without what differs from input to input: numbers, and words in quotes.
fn kind(answer: &str) -> String {
    let mut out = String::new();
    let (mut quoted, mut digits) = (false, false);
    for c in answer.chars().take(400) {
        if c == '"' || c == '`' {
            quoted = !quoted;
        }
        let digit = c.is_ascii_digit();
        if !(quoted || digit && digits) {
            out.push(if digit { '0' } else { c });
        }
        digits = digit;
    }
    out
}

impl Target {
    fn folder(&self) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/corpus")
            .join(self.name)
    }

    /// Looks at the corpus, then spoils it for a time; how often it gave an input, and how many kinds of answers there are.
    fn run(&self, time: Duration, seed: u64, keep: bool) -> (u64, usize) {
        let mut kept: Vec<Vec<u8>> = (self.seeds)();
        if let Ok(folder) = std::fs::read_dir(self.folder()) {
            let mut files: Vec<PathBuf> = folder.map(|f| f.unwrap().path()).collect();
            files.sort();
            kept.extend(files.iter().map(|f| std::fs::read(f).unwrap()));
        }
        let mut given = Given::new(self);
        let mut known: BTreeSet<String> = kept.iter().map(|input| given.give(input)).collect();
        let seed = seed + if keep { given.executions } else { 0 };
        let seed: [u8; 32] = std::array::from_fn(|i| seed.to_le_bytes()[i % 8]);
        let random = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
        let mut runner = TestRunner::new_with_rng(Config::default(), random);
        let drawn = (
            proptest::prelude::any::<proptest::sample::Index>(),
            edits(self.words),
        );
        let begun = Instant::now();
        while begun.elapsed() < time {
            let (which, edits) = drawn.new_tree(&mut runner).unwrap().current();
            let input = spoilt(&kept[which.index(kept.len())], &edits);
            if input.len() > LONGEST {
                continue;
            }
            let kind = given.give(&input);
            if known.len() < MOST && known.insert(kind) {
                if keep {
                    let folder = self.folder();
                    std::fs::create_dir_all(&folder).unwrap();
                    std::fs::write(folder.join(format!("{:04}", kept.len())), &input).unwrap();
                }
                kept.push(input);
            }
        }
        (given.executions, known.len())
    }
}

/// Inputs given to a reader.
struct Given<'t> {
    target: &'t Target,
    /// Holds the one that is being read. It stays open: opening it anew would wait for the disk.
    current: File,
    executions: u64,
}

impl<'t> Given<'t> {
    fn new(target: &'t Target) -> Self {
        let name = format!("{}.current", target.name);
        let current = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        Given {
            target,
            current: File::create(current).unwrap(),
            executions: 0,
        }
    }

    /// Gives an input; the kind of the answer.
    fn give(&mut self, input: &[u8]) -> String {
        self.executions += 1;
        self.current.rewind().unwrap();
        self.current.write_all(input).unwrap();
        self.current.set_len(input.len() as u64).unwrap();
        let begun = Instant::now();
        let answer = catch_unwind(AssertUnwindSafe(|| (self.target.look)(input)));
        if answer.is_err() || begun.elapsed() > PATIENCE {
            let folder = self.target.folder();
            let failed = folder.join("failed");
            std::fs::create_dir_all(folder).unwrap();
            std::fs::write(&failed, input).unwrap();
            panic!(
                "{}: {:?}, see {}",
                self.target.name,
                begun.elapsed(),
                failed.display()
            );
        }
        kind(&answer.unwrap_or_default())
    }
}

#[test]
fn what_is_kept_and_what_comes_of_it() {
    let said = |name| std::env::var(name).ok();
    let seconds = said("OZOLS_FUZZ_SECONDS").map_or(1.0, |s| s.parse().unwrap());
    let keep = said("OZOLS_FUZZ_KEEP").is_some();
    let only = said("OZOLS_FUZZ_ONLY");
    let seed = said("OZOLS_FUZZ_SEED").map_or(7, |s| s.parse().unwrap());
    let wanted = |t: &&Target| only.as_ref().is_none_or(|o| o == t.name);
    for target in TARGETS.iter().filter(wanted) {
        let (executions, kinds) = target.run(Duration::from_secs_f64(seconds), seed, keep);
        eprintln!(
            "{}: {executions} executions, {kinds} kinds of answers",
            target.name
        );
        assert!(executions > 10 && kinds > 3, "{}", target.name);
    }
}
