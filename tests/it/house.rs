//! Measures of the house that may only fall: whoever lowers one lowers its ceiling here, and nobody raises it.

use crate::sources::{rooms, root, without_tests};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Functions with more lines of code than are read at a glance ([`GLANCE`]).
const LONG_FUNCTIONS: usize = 5;
/// Functions that take a parameter apart as a tuple: a struct with names says what belongs together.
const TUPLE_PARAMETERS: usize = 0;
/// Names of types that stand in three files or more: such a name does not say which of them is meant.
const SHARED_NAMES: usize = 0;
/// Source files in one folder, without those of the folders in it.
const FILES_IN_A_FOLDER: usize = 28;

/// Lines of code, without blank lines and comments, that a function is read in at a glance.
const GLANCE: usize = 60;

/// The source files and their code without comments and test modules.
fn all() -> BTreeMap<PathBuf, String> {
    let files = rooms().into_iter().map(|source| {
        let text = without_tests(&fs::read_to_string(&source.path).unwrap());
        let lines = text.lines().filter(|l| {
            let l = l.trim_start();
            !l.is_empty() && !l.starts_with("//")
        });
        let lines: Vec<&str> = lines.collect();
        (source.path, lines.join("\n"))
    });
    files.collect()
}

fn shown(path: &Path) -> String {
    path.strip_prefix(root()).unwrap().display().to_string()
}

/// The words that may stand before `fn`, `struct` and the like.
fn without_qualifiers(line: &str) -> &str {
    let mut line = line.trim_start();
    loop {
        let before = line;
        if let Some(rest) = line.strip_prefix("pub(") {
            line = rest.split_once(')').map_or(rest, |x| x.1).trim_start();
        }
        for word in ["pub ", "const ", "async ", "unsafe "] {
            line = line.strip_prefix(word).unwrap_or(line);
        }
        if line == before {
            return line;
        }
    }
}

fn name(of: &str) -> String {
    of.chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect()
}

/// The functions of a file: name, lines from the signature to the closing brace.
fn functions(code: &str) -> Vec<(String, Vec<&str>)> {
    let lines: Vec<&str> = code.lines().collect();
    let mut out = Vec::new();
    for (n, line) in lines.iter().enumerate() {
        let Some(rest) = without_qualifiers(line).strip_prefix("fn ") else {
            continue;
        };
        let indent = &line[..line.len() - line.trim_start().len()];
        let close = format!("{indent}}}");
        let own = |l: &str| l.starts_with(indent) && !l[indent.len()..].starts_with(' ');
        // A signature without a body ends in a semicolon, a function of a single line in its own brace.
        let more = lines[n..]
            .iter()
            .position(|l| own(l) && (**l == *close || l.ends_with(';') || l.ends_with('}')));
        let last = n + more.unwrap_or(0);
        out.push((name(rest), lines[n..=last].to_vec()));
    }
    out
}

/// The parameters of a function, as they are written.
fn parameters(function: &[&str]) -> Vec<String> {
    let text = function.join(" ");
    let (mut depth, mut angle, mut out, mut now) = (0, 0, Vec::new(), String::new());
    let start = text.find("fn ").unwrap();
    let mut before = ' ';
    for c in text[start..].chars() {
        match c {
            '<' if depth == 0 => angle += 1,
            '>' if depth == 0 && before != '-' => angle -= 1,
            '(' | '[' | '{' if angle == 0 => {
                depth += 1;
                if depth == 1 {
                    before = c;
                    continue;
                }
            }
            ')' | ']' | '}' if angle == 0 => depth -= 1,
            ',' if depth == 1 => {
                out.push(std::mem::take(&mut now).trim().to_owned());
                before = c;
                continue;
            }
            _ => {}
        }
        if depth >= 1 {
            now.push(c);
        } else if !now.is_empty() || (c == ')' && angle == 0) {
            break;
        }
        before = c;
    }
    out.push(now.trim().to_owned());
    out
}

/// A ceiling that is met exactly: above it the house got worse, below it the ceiling is to be lowered.
fn ceiling(what: &str, found: &[String], allowed: usize) {
    assert!(
        found.len() <= allowed,
        "{what}: {} where {allowed} are allowed: {found:#?}",
        found.len()
    );
    assert!(
        found.len() == allowed,
        "{what}: {} now, so lower the ceiling from {allowed}",
        found.len()
    );
}

#[test]
fn no_more_functions_are_longer_than_a_glance() {
    let all = all();
    let mut long: Vec<(usize, String)> = all
        .iter()
        .flat_map(|(path, code)| {
            let long = functions(code).into_iter().filter(|f| f.1.len() > GLANCE);
            long.map(|(name, lines)| (lines.len(), format!("{}: {name}", shown(path))))
        })
        .collect();
    long.sort_by(|a, b| b.cmp(a));
    let long: Vec<String> = long.iter().map(|(n, at)| format!("{n} {at}")).collect();
    ceiling("functions over 60 lines", &long, LONG_FUNCTIONS);
}

#[test]
fn no_more_functions_take_a_tuple_apart() {
    let mut found = Vec::new();
    for (path, code) in all() {
        for (name, lines) in functions(&code) {
            if parameters(&lines).iter().any(|p| p.starts_with('(')) {
                found.push(format!("{}: {name}", shown(&path)));
            }
        }
    }
    ceiling(
        "functions with a tuple taken apart",
        &found,
        TUPLE_PARAMETERS,
    );
}

#[test]
fn no_more_names_stand_in_three_files() {
    let mut named: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (path, code) in all() {
        for line in code.lines() {
            let line = without_qualifiers(line);
            let kinds = ["struct ", "enum ", "trait ", "type "];
            let Some(rest) = kinds.iter().find_map(|k| line.strip_prefix(k)) else {
                continue;
            };
            // The types that an implementation of a trait must give have the trait's names.
            if !rest.contains(" = ") || !line.starts_with("type ") {
                let files = named.entry(name(rest)).or_default();
                if files.last() != Some(&shown(&path)) {
                    files.push(shown(&path));
                }
            }
        }
    }
    let shared: Vec<String> = named
        .iter()
        .filter(|(_, files)| files.len() >= 3)
        .map(|(name, files)| format!("{name}: {}", files.join(", ")))
        .collect();
    ceiling("names of types in three files", &shared, SHARED_NAMES);
}

#[test]
fn no_folder_has_more_files() {
    let mut folders: BTreeMap<PathBuf, Vec<String>> = BTreeMap::new();
    for path in all()
        .into_keys()
        .filter(|p| p.parent() != Some(&root().join("src")))
    {
        let folder = path.parent().unwrap().to_owned();
        folders.entry(folder).or_default().push(shown(&path));
    }
    let largest = folders.into_values().max_by_key(Vec::len).unwrap();
    ceiling("files in one folder", &largest, FILES_IN_A_FOLDER);
}
