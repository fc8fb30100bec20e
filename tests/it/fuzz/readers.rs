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
    use mechanism_files as mechanisms;
    use robot_files as robots;
    [
        Reader::new("asmt", &robots::WORDS, robots::none, |b| {
            robots::look("x.asmt", b)
        }),
        Reader::new(
            "certificates",
            &certificates::WORDS,
            certificates::seeds,
            certificates::look,
        ),
        Reader::new(
            "costs",
            &mechanisms::WORDS,
            small_files::costs_seeds,
            small_files::costs,
        ),
        Reader::new(
            "edits",
            &mechanisms::WORDS,
            small_files::edits_seeds,
            small_files::edits,
        ),
        Reader::new(
            "expressions",
            &expressions::TOKENS,
            expressions::seeds,
            expressions::look,
        ),
        Reader::new("fcstd", &robots::WORDS, robots::none, robots::look_fcstd),
        Reader::new("json", &mechanisms::WORDS, mechanisms::json, |b| {
            mechanisms::read("x.json", b)
        }),
        Reader::new("loops", &robots::WORDS, robots::loops, robots::look_loops),
        Reader::new("mjcf", &robots::WORDS, robots::mjcf, |b| {
            robots::look("x.xml", b)
        }),
        Reader::new(
            "motion",
            &mechanisms::WORDS,
            small_files::motion_seeds,
            small_files::motion,
        ),
        Reader::new("sdf", &robots::WORDS, robots::sdf, |b| {
            robots::look("x.sdf", b)
        }),
        Reader::new(
            "spec",
            &mechanisms::WORDS,
            small_files::spec_seeds,
            small_files::spec,
        ),
        Reader::new("toml", &mechanisms::WORDS, mechanisms::toml, |b| {
            mechanisms::read("x.toml", b)
        }),
        Reader::new("urdf", &robots::WORDS, robots::urdf, |b| {
            robots::look("x.urdf", b)
        }),
        Reader::new(
            "words",
            &expressions::TOKENS,
            small_files::words_seeds,
            small_files::words,
        ),
        Reader::new(
            "workload",
            &mechanisms::WORDS,
            mechanisms::workloads,
            mechanisms::workload,
        ),
        Reader::new(
            "differential",
            &[""],
            differential::seeds,
            differential::look,
        ),
        Reader::new(
            "result",
            &mechanisms::WORDS,
            mechanisms::toml,
            search_result::look,
        ),
    ]
};
