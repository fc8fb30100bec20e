//! What several tests need: the program and what it says, closeness, a text with one thing changed.

mod folder;
mod graph;
pub(crate) mod lattice;
mod names;
mod prelude;
mod turned;

use assert_cmd::Command;
pub(crate) use folder::*;
pub(crate) use graph::*;
pub(crate) use names::*;
pub(crate) use prelude::*;
use std::hash::{BuildHasher, Hasher, RandomState};
pub(crate) use tempfile::{TempDir, tempdir};
pub(crate) use turned::*;

/// A command line: its words, or a text with blanks between them.
pub(crate) trait Line {
    fn words(&self) -> Vec<&str>;
}

impl Line for str {
    fn words(&self) -> Vec<&str> {
        split_words(self)
    }
}

impl Line for String {
    fn words(&self) -> Vec<&str> {
        split_words(self)
    }
}

impl Line for [&str] {
    fn words(&self) -> Vec<&str> {
        self.to_vec()
    }
}

impl<const N: usize> Line for [&str; N] {
    fn words(&self) -> Vec<&str> {
        self.to_vec()
    }
}

impl Line for Vec<&str> {
    fn words(&self) -> Vec<&str> {
        self.clone()
    }
}

pub(crate) fn split_words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

pub(crate) fn ozols<L: Line + ?Sized>(args: &L) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ozols"));
    // What the tests are started in is not to fold what they read.
    command.args(args.words()).env_remove("OZOLS_WIDTH");
    command
}

pub(crate) fn run<L: Line + ?Sized>(args: &L) -> Output {
    ozols(args).output().unwrap()
}

/// Asserts that a text contains a part, and shows the whole text if it does not.
#[track_caller]
pub(crate) fn has(text: &str, part: &str) {
    assert!(text.contains(part), "no {part:?} in {text}");
}

/// Asserts that a text does not contain a part, and shows the whole text if it does.
#[track_caller]
pub(crate) fn lacks(text: &str, part: &str) {
    assert!(!text.contains(part), "{part:?} in {text}");
}

/// Asserts that a value has all keys of the wanted one with their values, at any depth; what it has besides is not looked at.
#[track_caller]
pub(crate) fn assert_includes(found: &Value, wanted: &Value) {
    match (found, wanted) {
        (Value::Object(f), Value::Object(w)) => {
            let at = |key: &String| f.get(key).unwrap_or_else(|| panic!("no {key} in {found}"));
            w.iter().for_each(|(k, v)| assert_includes(at(k), v));
        }
        _ => assert_eq!(found, wanted),
    }
}

/// Asserts that a text contains all of several parts.
#[track_caller]
pub(crate) fn has_all(text: &str, parts: &[&str]) {
    for part in parts {
        has(text, part);
    }
}

/// A text without the time that a search took, the one thing in it that differs between runs.
pub(crate) fn without_time(text: &str) -> String {
    let said = text.lines().find(|l| l.starts_with("Searched in "));
    let text = said.map_or(text.to_owned(), |l| text.replace(&format!("{l}\n"), ""));
    match text.split_once(",\n  \"seconds\": ") {
        Some((before, after)) => format!("{before}{}", &after[after.find('\n').unwrap()..]),
        None => text,
    }
}

/// Standard output of a run that succeeds and says nothing else but how long a search took and which usual options it had.
pub(crate) fn run_quiet<L: Line + ?Sized>(args: &L) -> String {
    let o = run(args);
    let said = without_time(&utf8_text(&o.stderr));
    let usual = |l: &&str| !l.contains("offers no joint types, so the usual ones are tried");
    let said: String = said.split_inclusive('\n').filter(usual).collect();
    assert_eq!(
        (o.status.code(), said.as_str()),
        (Some(0), ""),
        "{:?}",
        args.words()
    );
    without_time(&utf8_text(&o.stdout))
}

pub(crate) fn run_json<L: Line + ?Sized>(args: &L) -> Value {
    serde_json::from_str(&run_quiet(args)).unwrap()
}

/// Returns the folder in which a test keeps its files: below the target folder, or below `OZOLS_TEST_FOLDER`.
fn folder_of_test(name: &str) -> PathBuf {
    let of_this_run = std::env::var_os("OZOLS_TEST_FOLDER");
    of_this_run
        .map_or(env!("CARGO_TARGET_TMPDIR").into(), PathBuf::from)
        .join(name)
}

/// What `ozols accuracy --quick` says, and the folder it writes to: run once for all tests, as it takes most of a minute.
pub(crate) fn quick_accuracy() -> (&'static str, &'static Path) {
    static RUN: OnceLock<(String, PathBuf)> = OnceLock::new();
    let (said, folder) = RUN.get_or_init(|| {
        let folder = folder_of_test("quick-accuracy");
        let _ = fs::remove_dir_all(&folder);
        let done = run(&["accuracy", "--quick", "-o", folder.to_str().unwrap()]);
        assert!(done.status.success(), "{}", utf8_text(&done.stderr));
        (utf8_text(&done.stdout), folder)
    });
    (said, folder)
}

/// Returns the bytes of a file of `tests/data`.
pub(crate) fn read_data_bytes(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name);
    fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Returns the text of a file of `tests/data`.
pub(crate) fn read_data(name: &str) -> String {
    utf8_text(&read_data_bytes(name))
}

/// Returns the default value with one change.
pub(crate) fn default_with<T: Default>(change: impl FnOnce(&mut T)) -> T {
    let mut out = T::default();
    change(&mut out);
    out
}

/// Returns a count that is written as a string.
pub(crate) fn parse_count(v: &Value) -> u64 {
    v.as_str().unwrap().parse().unwrap()
}

/// Returns how many random cases a test draws: those of `PROPTEST_CASES` if it is set.
pub(crate) fn case_count(usual: u32) -> u32 {
    let asked = std::env::var("PROPTEST_CASES");
    asked.ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

pub(crate) fn near(found: f64, stated: f64, tolerance: f64) {
    assert!(
        (found - stated).abs() <= tolerance,
        "found {found}, stated {stated}"
    );
}

/// Asserts that two numbers agree to nine digits, or to nine places if they are below one.
pub(crate) fn assert_nine_digits(found: f64, wanted: f64) {
    assert!(
        (found - wanted).abs() < 1e-9 * (1.0 + wanted.abs()),
        "{found} for {wanted}"
    );
}

/// Asserts that all components agree to nine digits.
pub(crate) fn assert_all_nine_digits(found: [f64; 3], wanted: [f64; 3]) {
    found
        .into_iter()
        .zip(wanted)
        .for_each(|(f, w)| assert_nine_digits(f, w));
}

/// Returns the place of the first line that contains this text, as errors name it: `FILE:LINE:`.
#[track_caller]
pub(crate) fn place_of(file: &str, content: &str, line_with: &str) -> String {
    let at = content.find(line_with).unwrap();
    format!("{file}:{}:", content[..at].matches('\n').count() + 1)
}

/// Returns a text with the first occurrence of a part replaced. The part must be there.
pub(crate) fn replace_once(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

/// Returns the exit code, standard output and standard error of a command.
pub(crate) fn run_full<L: Line + ?Sized>(args: &L) -> (Option<i32>, String, String) {
    let o = run(args);
    (o.status.code(), utf8_text(&o.stdout), utf8_text(&o.stderr))
}

/// Runs a command with this standard input and returns its exit code, standard output and standard error.
pub(crate) fn run_with_input<L: Line + ?Sized>(
    args: &L,
    input: &str,
) -> (Option<i32>, String, String) {
    let o = ozols(args).write_stdin(input).output().unwrap();
    (o.status.code(), utf8_text(&o.stdout), utf8_text(&o.stderr))
}

/// Returns standard output and standard error of a command that succeeds.
#[track_caller]
pub(crate) fn run_successful<L: Line + ?Sized>(args: &L) -> (String, String) {
    let (code, said, told) = run_full(args);
    assert_eq!(code, Some(0), "{:?}: {told}", args.words());
    (said, told)
}

/// Returns the standard output of a command that succeeds.
#[track_caller]
pub(crate) fn stdout_of<L: Line + ?Sized>(args: &L) -> String {
    run_successful(args).0
}

/// Asserts that a command ends with exit code 2 and an error that contains these words.
#[track_caller]
pub(crate) fn assert_fails<L: Line + ?Sized>(args: &L, says: &str) {
    let (code, _, told) = run_full(args);
    assert_eq!(
        (code, told.contains(says)),
        (Some(2), true),
        "{:?}: no {says:?} in {told}",
        args.words()
    );
}

/// Runs a command on a file with this text and returns its exit code, standard output and standard error.
pub(crate) fn run_on<L: Line + ?Sized>(
    command: &str,
    name: &str,
    content: &str,
    more: &L,
) -> (Option<i32>, String, String) {
    let (_folder, path) = write_temporary(name, content);
    run_full(&[&[command, path], &more.words()[..]].concat())
}

/// Returns the exit code of a command on a file with this text, and what it says as JSON.
#[track_caller]
pub(crate) fn answer_on<L: Line + ?Sized>(
    command: &str,
    name: &str,
    content: &str,
    more: &L,
) -> (Option<i32>, Value) {
    let more = [&more.words()[..], &["--format", "json"]].concat();
    let (code, said, told) = run_on(command, name, content, &more);
    let said = serde_json::from_str(&said).unwrap_or_else(|e| panic!("{e}: {said}{told}"));
    (code, said)
}

/// Returns what a command that succeeds says as JSON of a file with this text.
#[track_caller]
pub(crate) fn json_on<L: Line + ?Sized>(
    command: &str,
    name: &str,
    content: &str,
    more: &L,
) -> Value {
    let (code, said) = answer_on(command, name, content, more);
    assert_eq!(code, Some(0), "{said:#}");
    said
}

/// Asserts that a command on a file with this text ends with exit code 2 and an error that contains these words.
#[track_caller]
pub(crate) fn assert_fails_on<L: Line + ?Sized>(
    command: &str,
    name: &str,
    content: &str,
    more: &L,
    says: &str,
) {
    let (_folder, path) = write_temporary(name, content);
    assert_fails(&[&[command, path], &more.words()[..]].concat(), says);
}

/// Returns the rows of a table: one a line, bars between their cells, and `\n` for the end of a line within a cell.
pub(crate) fn read_cases<const N: usize>(table: &str) -> Vec<[&'static str; N]> {
    let row = |line: &str| {
        let cell = |c: &str| -> &str { c.trim().replace("\\n", "\n").leak() };
        let cells: Vec<&str> = line.split('|').map(cell).collect();
        cells.try_into().unwrap_or_else(|c| panic!("{c:?}"))
    };
    table
        .lines()
        .filter(|l| !l.trim().is_empty())
        .map(row)
        .collect()
}

/// Returns the file of a mechanism: what stands before its links; these, the first the frame, `*` behind outputs and `!` behind an
/// object; and a joint a line: name, links, type, point, axis if it has one, and what else stands there.
pub(crate) fn write_mechanism(head: &str, links: &str, joints: &str) -> String {
    let mut out = format!("{head}\n");
    for (i, link) in links.split_whitespace().enumerate() {
        let role = match (i, link.chars().last()) {
            (0, _) => "role = \"frame\"\n",
            (_, Some('*')) => "role = \"output\"\n",
            (_, Some('!')) => "role = \"object\"\n",
            _ => "",
        };
        let id = link.trim_end_matches(['*', '!']);
        out += &format!("[[link]]\nid = \"{id}\"\n{role}");
    }
    for line in joints.lines().filter(|l| !l.trim().is_empty()) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let (a, b) = cells[1].split_once(' ').unwrap();
        let [id, kind, point] = [0, 2, 3].map(|c| cells[c]);
        out += &format!("[[joint]]\nid = \"{id}\"\nlinks = [\"{a}\", \"{b}\"]\n");
        out += &format!("type = \"{kind}\"\npoint = [{point}]\n");
        if let Some(axis) = cells.get(4).filter(|a| !a.is_empty()) {
            out += &format!("axis = [{axis}]\n");
        }
        let more = cells
            .get(5)
            .map_or(String::new(), |m| m.replace("\\n", "\n"));
        out += &format!("{more}\n");
    }
    out
}

/// Returns the file of a ring of links, the first the frame, the second the output: what stands before the links, and a joint a line
/// from each link to the next as [`write_mechanism`] has it, without its name and links.
pub(crate) fn write_ring(head: &str, joints: &[String]) -> String {
    let n = joints.len();
    let links = (0..n).map(|i| format!("{i}{}", if i == 1 { "*" } else { "" }));
    let line = |(i, joint): (usize, &String)| format!("j{i} | {i} {} | {joint}", (i + 1) % n);
    let joints = joints.iter().enumerate().map(line).join("\n");
    write_mechanism(head, &links.collect_vec().join(" "), &joints)
}

/// Returns numbers with commas between them, as points and axes of [`write_mechanism`].
pub(crate) fn commas<T: std::fmt::Debug>(numbers: impl IntoIterator<Item = T>) -> String {
    numbers.into_iter().map(|x| format!("{x:?}")).join(", ")
}

/// Returns the mechanism of a file with this text, which must be valid.
#[track_caller]
pub(crate) fn read(text: &str) -> Mechanism {
    mechanism_from_str("it.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Returns the analysis of a state by exact ranks.
pub(crate) fn analysed_in(m: &Mechanism, state: StateId) -> StateAnalysis {
    let found = analyse_states(m, &[state], Method::Modular);
    found.unwrap().remove(0)
}

/// Returns the analysis of the free state by exact ranks.
pub(crate) fn analysed(m: &Mechanism) -> StateAnalysis {
    analysed_in(m, StateId::FREE)
}

/// Returns a search and its diagrams.
pub(crate) fn searched(m: &Mechanism, conditions: Conditions) -> (Search, Diagrams) {
    let search = Search::new(exact_field(m, 0).unwrap(), m, conditions).unwrap();
    let diagrams = search.build_diagrams(Control::NONE);
    (search, diagrams)
}

/// Asserts that each command line of a table is refused with exit code 2 and these words, `&` between several of them.
pub(crate) fn assert_all_fail(table: &str) {
    for [line, said] in read_cases::<2>(table) {
        let o = run(line);
        let told = utf8_text(&o.stderr);
        assert_eq!(o.status.code(), Some(2), "{line}: {told}");
        for part in said.split(" & ") {
            assert!(told.contains(part), "{line}: no {part:?} in {told}");
        }
    }
}

/// Returns a file with this text, by its path, and the folder that it is gone with.
pub(crate) fn write_temporary(name: &str, content: impl AsRef<[u8]>) -> (TempDir, &'static str) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    // A few bytes until the tests end, for which no caller keeps a second binding.
    (folder, path.to_str().unwrap().to_owned().leak())
}

/// Returns a new seed for each run; a failure names it.
pub(crate) fn fresh_seed() -> u64 {
    RandomState::new().build_hasher().finish() % 1_000_000
}

/// Returns the rank of rows of doubles, by elimination with the largest pivot left.
pub(crate) fn rank_of_rows(mut rows: Vec<Vec<f64>>) -> usize {
    let width = rows.first().map_or(0, Vec::len);
    for rank in 0..rows.len() {
        let left = (rank..rows.len()).flat_map(|r| (0..width).map(move |c| (r, c)));
        let largest = left.max_by(|&(r, c), &(s, d)| rows[r][c].abs().total_cmp(&rows[s][d].abs()));
        let Some((r, c)) = largest.filter(|&(r, c)| rows[r][c].abs() > 1e-9) else {
            return rank;
        };
        rows.swap(rank, r);
        let pivot = rows[rank].clone();
        for row in &mut rows[rank + 1..] {
            let by = row[c] / pivot[c];
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= by * p);
            row[c] = 0.0;
        }
    }
    rows.len()
}
