//! What is fuzzed: for every reader, what it is given first, and what must hold of its answer. Shared with `tests/fuzz`, whose
//! inputs are made by how far into the code earlier ones came; here what was kept of them is read again.

// Paths are written out: this file is a module of `fuzz` here, and of the root there.
#[path = "readers/certificates.rs"]
pub(crate) mod certificates;
#[path = "readers/differential.rs"]
pub(crate) mod differential;
#[path = "readers/expressions.rs"]
pub(crate) mod expressions;
#[path = "readers/mechanism_files.rs"]
pub(crate) mod mechanism_files;
#[path = "readers/robot_files.rs"]
pub(crate) mod robot_files;
#[path = "readers/search_result.rs"]
pub(crate) mod search_result;
#[path = "readers/slow_search.rs"]
pub(crate) mod slow_search;
#[path = "readers/small_files.rs"]
pub(crate) mod small_files;

/// A reader.
pub(crate) struct Reader {
    /// Its folder in `tests/corpus`.
    pub(crate) name: &'static str,
    /// What it may stumble over.
    pub(crate) words: &'static [&'static str],
    /// What it is given first.
    pub(crate) seeds: fn() -> Vec<Vec<u8>>,
    /// Gives it an input, asserts what holds of every answer, and returns the answer.
    pub(crate) look: fn(&[u8]) -> String,
}

impl Reader {
    const fn new(
        name: &'static str,
        words: &'static [&'static str],
        seeds: fn() -> Vec<Vec<u8>>,
        look: fn(&[u8]) -> String,
    ) -> Reader {
        Reader {
            name,
            words,
            seeds,
            look,
        }
    }
}

/// All of them; the last two go the whole way from a mechanism to its redesigns.
pub(crate) const READERS: [Reader; 18] = {
    use certificates as proofs;
    use differential as twin;
    use expressions as terms;
    use mechanism_files as files;
    use robot_files as robots;
    use small_files as small;
    [
        Reader::new("asmt", &robots::WORDS, robots::none, |b| {
            robots::look("x.asmt", b)
        }),
        Reader::new("certificates", &proofs::WORDS, proofs::seeds, proofs::look),
        Reader::new("costs", &files::WORDS, small::costs_seeds, small::costs),
        Reader::new("edits", &files::WORDS, small::edits_seeds, small::edits),
        Reader::new("expressions", &terms::TOKENS, terms::seeds, terms::look),
        Reader::new("fcstd", &robots::WORDS, robots::none, robots::look_fcstd),
        Reader::new("json", &files::WORDS, files::json, |b| {
            files::read("x.json", b)
        }),
        Reader::new("loops", &robots::WORDS, robots::loops, robots::look_loops),
        Reader::new("mjcf", &robots::WORDS, robots::mjcf, |b| {
            robots::look("x.xml", b)
        }),
        Reader::new("motion", &files::WORDS, small::motion_seeds, small::motion),
        Reader::new("sdf", &robots::WORDS, robots::sdf, |b| {
            robots::look("x.sdf", b)
        }),
        Reader::new("spec", &files::WORDS, small::spec_seeds, small::spec),
        Reader::new("toml", &files::WORDS, files::toml, |b| {
            files::read("x.toml", b)
        }),
        Reader::new("urdf", &robots::WORDS, robots::urdf, |b| {
            robots::look("x.urdf", b)
        }),
        Reader::new("words", &terms::TOKENS, small::words_seeds, small::words),
        Reader::new("workload", &files::WORDS, files::workloads, files::workload),
        Reader::new("differential", &[""], twin::seeds, twin::look),
        Reader::new("result", &files::WORDS, files::toml, search_result::look),
    ]
};
