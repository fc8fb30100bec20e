//! Inputs that are kept: each reaches code that no other does, as `tests/fuzz/run` found. Every run of the tests reads all of
//! them again, and spoils them for what is left of a fifth of a second a reader; a longer run, here of ten minutes:
//!
//! ```text
//! OZOLS_FUZZ_SECONDS=600 cargo test --test integration fuzz::corpus -- --nocapture
//! ```
//!
//! An input that makes a reader panic is told by its file `READER.failed` in the build's temporary folder; of one that hangs or
//! aborts, the file `READER.current` there has the bytes.

use super::readers::{READERS, Reader};
use super::{edits, spoilt};
use crate::common::*;
use fs::File;
use proptest::prelude::any;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use rayon::ThreadPoolBuilder;
use std::io::{Seek, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The processor time of this thread that an input of a few kilobytes may take, in a build for tests.
const PATIENCE: Duration = Duration::from_secs(20);

/// Bytes of an input at most.
const LONGEST: usize = 1 << 16;

/// What is kept for a reader, and what it is given first.
fn kept(reader: &Reader) -> Vec<Vec<u8>> {
    let mut all = (reader.seeds)();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let files = fs::read_dir(folder.join(reader.name)).unwrap();
    let mut files: Vec<PathBuf> = files.map(|f| f.unwrap().path()).collect();
    files.sort();
    all.extend(files.iter().map(|f| fs::read(f).unwrap()));
    all
}

/// Gives a reader all that is kept, then spoils it until the time is over; how often it gave an input.
fn run(reader: &Reader, time: Duration) -> u64 {
    let begun = Instant::now();
    let kept = kept(reader);
    let mut given = Given::new(reader);
    kept.iter().for_each(|input| given.give(input));
    let mut runner = TestRunner::deterministic();
    let drawn = (any::<Index>(), edits(reader.words));
    while begun.elapsed() < time {
        let (which, edits) = drawn.new_tree(&mut runner).unwrap().current();
        let input = spoilt(&kept[which.index(kept.len())], &edits);
        if input.len() <= LONGEST {
            given.give(&input);
        }
    }
    given.executions
}

/// Inputs given to a reader.
struct Given<'r> {
    reader: &'r Reader,
    /// Holds the one that is being read. It stays open: opening it anew would wait for the disk.
    current: File,
    executions: u64,
}

/// A file of a reader in the build's temporary folder.
fn beside(reader: &Reader, what: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}.{what}", reader.name))
}

impl<'r> Given<'r> {
    fn new(reader: &'r Reader) -> Self {
        Given {
            reader,
            current: File::create(beside(reader, "current")).unwrap(),
            executions: 0,
        }
    }

    fn give(&mut self, input: &[u8]) {
        self.executions += 1;
        self.current.rewind().unwrap();
        self.current.write_all(input).unwrap();
        self.current.set_len(input.len() as u64).unwrap();
        let begun = thread_time();
        let answer = catch_unwind(AssertUnwindSafe(|| (self.reader.look)(input)));
        let time = thread_time().saturating_sub(begun);
        if answer.is_err() || time > PATIENCE {
            let failed = beside(self.reader, "failed");
            fs::write(&failed, input).unwrap();
            let name = self.reader.name;
            panic!("{name}: {time:?}, see {}", failed.display());
        }
    }
}

/// The processor time that this thread has taken. Other programs do not change it.
#[cfg(unix)]
fn thread_time() -> Duration {
    let taken = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(taken).unwrap()
}

/// The time on the clock, where no other is at hand.
#[cfg(not(unix))]
fn thread_time() -> Duration {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    BEGUN.elapsed()
}

#[test]
fn what_is_kept_and_what_comes_of_it() {
    let seconds = std::env::var("OZOLS_FUZZ_SECONDS").map_or(0.2, |s| s.parse().unwrap());
    let look = |reader: &Reader| {
        let executions = run(reader, Duration::from_secs_f64(seconds));
        eprintln!("{}: {executions} executions", reader.name);
        assert!(executions > 0, "{}", reader.name);
    };
    std::thread::scope(|threads| {
        for half in 0..2 {
            threads.spawn(move || {
                // What readers do in parallel is done on this thread and counts as its time. A thread of a larger pool would take up
                // another reader while a search waits.
                let own = ThreadPoolBuilder::new().num_threads(1);
                let _own = own.use_current_thread().build().unwrap();
                READERS.iter().skip(half).step_by(2).for_each(look);
            });
        }
    });
}

/// A folder that no reader reads would be kept for nothing.
#[test]
fn every_folder_of_the_corpus_is_a_readers() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus");
    let found = fs::read_dir(folder).unwrap();
    let mut found: Vec<_> = found.map(|f| f.unwrap().file_name()).collect();
    found.sort();
    let mut names = READERS.map(|r| std::ffi::OsString::from(r.name));
    names.sort();
    assert_eq!(found, names);
}
