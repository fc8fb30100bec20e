//! The list that `tests/mutants/run` works through does not rot: each place stands in its file once, and the tests named are there.

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
    tests: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    mutant: Vec<Mutant>,
}

/// The text of the file, or the files, that a test's module is in.
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
    text
}

#[test]
fn every_place_stands_in_its_file_once_and_its_tests_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("tests/mutants/list.toml")).unwrap();
    let list: List = toml::from_str(&text).unwrap();
    let (mut names, mut wrong) = (BTreeSet::new(), Vec::new());
    for m in &list.mutant {
        let source = fs::read_to_string(root.join(&m.file)).unwrap_or_default();
        let within = m.within.as_ref().unwrap_or(&m.before);
        if source.matches(within.as_str()).count() != 1 || within.matches(&m.before).count() != 1 {
            wrong.push(format!(
                "{}: {:?} does not stand there once",
                m.file, m.before
            ));
        }
        if m.after == m.before || !names.insert((&m.file, &m.what)) {
            wrong.push(format!("{}: {:?} is no mutant of its own", m.file, m.what));
        }
        for test in &m.tests {
            let last = test.rsplit("::").next().unwrap();
            let there = module(root, test).is_some_and(|t| t.contains(&format!("fn {last}(")));
            if !there {
                wrong.push(format!("{}: there is no test {test}", m.file));
            }
        }
        if m.tests.is_empty() {
            wrong.push(format!("{}: no test is to notice {:?}", m.file, m.what));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
