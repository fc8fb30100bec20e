//! The lists that `tests/mutants/run` works through do not rot: each place stands in its file once, and the tests named are there.

use serde::Deserialize;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Mutant {
    file: String,
    what: String,
    within: Option<String>,
    before: String,
    after: String,
    #[serde(default)]
    tests: Vec<String>,
    /// Why no test notices it.
    survives: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    mutant: Vec<Mutant>,
}

/// The mutants of all rooms.
fn every(root: &Path) -> Vec<Mutant> {
    let rooms = fs::read_dir(root.join("tests/mutants/list")).unwrap();
    let list = |room: fs::DirEntry| {
        let text = fs::read_to_string(room.path()).unwrap();
        toml::from_str::<List>(&text).unwrap().mutant
    };
    rooms.flat_map(|room| list(room.unwrap())).collect()
}

/// Those of which it is not known yet whether a test notices them.
fn undecided(root: &Path) -> Vec<Mutant> {
    let text = fs::read_to_string(root.join("tests/mutants/undecided.toml")).unwrap();
    toml::from_str::<List>(&text).unwrap().mutant
}

/// What is wrong with the place of a mutant: its text stands in its file once, whole, and another is put there.
fn misplaced(root: &Path, m: &Mutant) -> Option<String> {
    let source = fs::read_to_string(root.join(&m.file)).unwrap_or_default();
    let within = m.within.as_ref().unwrap_or(&m.before);
    let once =
        source.matches(within.as_str()).count() == 1 && within.matches(&m.before).count() == 1;
    // `field = 1;` of `a.field = 1;` is no statement of its own, and no switch can stand there.
    let cut = source.split(within.as_str()).next().unwrap_or_default();
    let cut = cut.to_owned() + within.split(&m.before).next().unwrap_or_default();
    let whole = !cut.ends_with('.');
    // What a branch of a switch names is not known behind it.
    let named = m.before.ends_with(';') && m.before.starts_with("let ");
    // A switch is a block, and so are its branches.
    let open = [&m.before, &m.after].map(|text| format!("{{ {text} }}"));
    let open = open
        .iter()
        .any(|text| syn::parse_str::<syn::Block>(text).is_err());
    (!once || !whole || named || open || m.after == m.before).then(|| {
        format!(
            "{}: {:?} does not stand there once, or no switch can",
            m.file, m.before
        )
    })
}

/// The text of the file that a test's module is in, and of those that it takes from elsewhere.
fn module(root: &Path, name: &str) -> Option<String> {
    let (mut at, mut text) = (root.join("tests/it"), None);
    for part in name.split("::") {
        match fs::read_to_string(at.join(part).with_extension("rs")) {
            Ok(found) => {
                at.push(part);
                text = Some(found);
            }
            Err(_) => break,
        }
    }
    let own = text?;
    let elsewhere = own.split("#[path = \"").skip(1);
    let elsewhere = elsewhere.filter_map(|rest| rest.split('"').next());
    let beside = elsewhere.filter_map(|path| fs::read_to_string(at.with_file_name(path)).ok());
    let all: Vec<String> = beside.collect();
    Some(own + &all.concat())
}

/// Whether a test is there: in `tests/it`, or beside the code of a crate, in the file of its place or one of its own.
fn is_there(root: &Path, m: &Mutant, test: &str) -> bool {
    let last = test.rsplit("::").next().unwrap();
    let text = match test.split_once(": ") {
        None => module(root, test),
        Some((of, name)) => {
            let source = root.join(&m.file);
            let own = source.with_extension("").join("tests.rs");
            let (rooms, _) = name.split_once("::tests::").unwrap_or_default();
            let file = format!("src/{of}/{}.rs", rooms.replace("::", "/"));
            let text = fs::read_to_string(own).or_else(|_| fs::read_to_string(source));
            (file == m.file).then(|| text.unwrap_or_default())
        }
    };
    text.is_some_and(|t| t.contains(&format!("fn {last}(")))
}

/// The name of the switch, as `tests/mutants/run` gives it.
fn name(m: &Mutant) -> String {
    let path = Path::new(&m.file).with_extension("");
    let last: Vec<_> = path.iter().rev().take(2).map(|p| p.display()).collect();
    format!("{}/{}: {}", last[1], last[0], m.what)
}

#[test]
fn every_place_stands_in_its_file_once_and_its_tests_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut names, mut wrong) = (BTreeSet::new(), Vec::new());
    for m in &every(root) {
        wrong.extend(misplaced(root, m));
        if !names.insert(name(m)) {
            wrong.push(format!("{}: {:?} is no mutant of its own", m.file, m.what));
        }
        for test in &m.tests {
            if !is_there(root, m, test) {
                wrong.push(format!("{}: there is no test {test}", m.file));
            }
        }
        if m.tests.is_empty() {
            wrong.push(format!("{}: no test is to notice {:?}", m.file, m.what));
        }
        if m.survives.as_ref().is_some_and(|why| why.len() < 20) {
            wrong.push(format!("{}: why {:?} survives is not said", m.file, m.what));
        }
    }
    for m in &undecided(root) {
        wrong.extend(misplaced(root, m));
        if !names.insert(name(m)) || !m.tests.is_empty() || m.survives.is_some() {
            wrong.push(format!("{}: {:?} is decided elsewhere", m.file, m.what));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(names.len() >= 500, "only {} mutants are left", names.len());
}
