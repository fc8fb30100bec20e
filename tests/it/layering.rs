//! Imports go downward only.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The layers, lowest first; modules of one row do not import each other, except where a row says so by order.
const LAYERS: [&[&str]; 20] = [
    &["format", "shard"],
    &["linalg", "terms", "guide", "builtin"],
    &["geom", "verify", "chains"],
    &["svg"],
    &["chart"],
    &["model"],
    &["closure"],
    &["motion", "meant"],
    &["rank", "statics"],
    &["grip", "drive"],
    &["redundancy", "file"],
    &["search", "robots", "synthesis"],
    &["score", "draw"],
    &["accuracy", "catalog"],
    &["sweep"],
    &["api"],
    &["view"],
    &["page"],
    &["studio"],
    &["cli"],
];

fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            // A crate of its own.
            if !path.join("Cargo.toml").exists() {
                sources(&path, out);
            }
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|row| row.contains(&module))
}

#[test]
fn no_module_imports_upward_or_sideways() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut files, mut wrong) = (Vec::new(), Vec::new());
    sources(&root, &mut files);
    for file in files {
        let inside = file.strip_prefix(&root).unwrap();
        let module = inside
            .components()
            .next()
            .unwrap()
            .as_os_str()
            .to_str()
            .unwrap()
            .trim_end_matches(".rs");
        // src/dense is a crate of its own, which knows nothing of this one.
        if ["lib", "main", "dense"].contains(&module) {
            continue;
        }
        let own = layer(module)
            .unwrap_or_else(|| panic!("{module} has no place in the layers; give it one"));
        for (n, line) in fs::read_to_string(&file).unwrap().lines().enumerate() {
            for used in line.split("crate::").skip(1) {
                let used: String = used
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect();
                let Some(other) = layer(&used) else { continue };
                if used != module && other >= own {
                    wrong.push(format!(
                        "{}:{}: {module} -> {used}",
                        inside.display(),
                        n + 1
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// What a person reads at one sitting.
const LINES: usize = 450;

#[test]
fn no_file_is_longer_than_a_sitting() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["src", "src/dense", "src/python", "tests/it", "benches"] {
        sources(&root.join(folder), &mut files);
    }
    let lines = |f: &PathBuf| fs::read_to_string(f).unwrap().lines().count();
    files.retain(|f| lines(f) > LINES);
    assert!(files.is_empty(), "over {LINES} lines: {files:#?}");
}

/// A source file without its tests: each item under `#[cfg(test)]` is left out, what follows it stays.
pub(crate) fn without_tests(text: &str) -> String {
    let mut out: Vec<&str> = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.trim_start() != "#[cfg(test)]" {
            out.push(line);
            continue;
        }
        let indent = &line[..line.len() - line.trim_start().len()];
        let close = format!("{indent}}}");
        let item = lines.find(|l| !l.trim_start().starts_with("#["));
        if item.is_some_and(|i| !i.ends_with([';', '}'])) {
            lines.find(|l| *l == close);
        }
    }
    out.join("\n")
}

/// A file as a module, such as `rank/method`, and its source without comments and tests.
fn modules() -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &mut files);
    let named = files.into_iter().map(|file| {
        let inside = file.strip_prefix(&root).unwrap().with_extension("");
        let text = fs::read_to_string(&file).unwrap();
        let code = without_tests(&text);
        // Who may see an item is no import.
        let code: Vec<&str> = code
            .lines()
            .map(|l| l.split("//").next().unwrap())
            .flat_map(|l| {
                let mut parts = l.split("pub(in ");
                let first = parts.next();
                let seen = parts.filter_map(|p| p.split_once(')').map(|x| x.1));
                first.into_iter().chain(seen)
            })
            .collect();
        let name = inside.to_str().unwrap().replace('\\', "/");
        (name, code.join("\n"))
    });
    named
        .filter(|(name, _)| !["lib", "main"].contains(&name.as_str()))
        .collect()
}

/// The paths that begin where `rest` does, a group such as `a::{b, c::d}` written out, and what follows them.
fn paths(rest: &str) -> (Vec<Vec<String>>, &str) {
    let mut head: Vec<String> = Vec::new();
    let mut rest = rest;
    loop {
        let word: String = rest
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect();
        if let Some(group) = rest.strip_prefix('{') {
            let (mut all, mut left) = (Vec::new(), group);
            loop {
                left = left.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
                if left.is_empty() || left.starts_with('}') {
                    return (all, left.strip_prefix('}').unwrap_or(left));
                }
                let (inner, after) = paths(left);
                all.extend(inner.into_iter().map(|p| [head.clone(), p].concat()));
                let next = after.find([',', '}']).unwrap_or(after.len());
                left = &after[next..];
            }
        }
        rest = &rest[word.len()..];
        if !word.is_empty() {
            head.push(word);
        }
        match rest.strip_prefix("::") {
            Some(more) => rest = more,
            None => return (vec![head], rest),
        }
    }
}

/// What a file imports: the modules that its paths lead to.
fn imports(module: &str, code: &str, all: &BTreeMap<String, String>) -> BTreeSet<String> {
    let own: Vec<&str> = module.split('/').collect();
    let children = code.lines().filter_map(|l| {
        let l = l.trim().strip_suffix(';')?;
        l.rsplit_once("mod ").map(|(_, name)| name)
    });
    let mut starts: Vec<(&str, Vec<&str>)> = vec![
        ("crate", vec![]),
        ("self", own.clone()),
        ("super", own[..own.len() - 1].to_vec()),
    ];
    starts.extend(children.map(|c| (c, [own.clone(), vec![c]].concat())));
    let mut found = BTreeSet::new();
    for (word, base) in &starts {
        for (at, _) in code.match_indices(&format!("{word}::")) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':') {
                continue;
            }
            for path in paths(&code[at + word.len() + 2..]).0 {
                let up = path.iter().take_while(|p| *p == "super").count();
                let from = &base[..base.len() - up];
                let mut full: Vec<&str> = from.to_vec();
                full.extend(path[up..].iter().map(String::as_str));
                let named = (1..=full.len()).rev().map(|n| full[..n].join("/"));
                found.extend(named.into_iter().find(|m| all.contains_key(m)));
            }
        }
    }
    found.remove(module);
    found
}

/// Whether a file only declares modules and passes their names on.
fn only_declares(code: &str) -> bool {
    let items = code.split(';').map(str::trim).filter(|i| !i.is_empty());
    items.into_iter().all(|i| {
        let i = i.strip_prefix("pub").unwrap_or(i);
        let i = match i.strip_prefix('(').and_then(|i| i.split_once(')')) {
            Some((_, after)) => after,
            None => i,
        };
        let i = i.trim_start();
        i.starts_with("mod ") || i.starts_with("use ")
    })
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let all = modules();
    let mut left: BTreeMap<&str, BTreeSet<String>> = all
        .iter()
        .filter(|(_, code)| !only_declares(code))
        .map(|(m, code)| (m.as_str(), imports(m, code, &all)))
        .collect();
    assert!(
        left["rank/method/auto"].contains("rank/method"),
        "paths are read"
    );
    // A file that no circle passes imports none that is left, or none that is left imports it, once those like it are
    // taken away.
    loop {
        let names: BTreeSet<String> = left.keys().map(|m| (*m).to_owned()).collect();
        let imported: BTreeSet<String> = left.values().flatten().cloned().collect();
        let before = left.len();
        left.retain(|name, imports| !imports.is_disjoint(&names) && imported.contains(*name));
        if left.len() == before {
            break;
        }
    }
    let names: BTreeSet<String> = left.keys().map(|m| (*m).to_owned()).collect();
    let tied: Vec<String> = left
        .iter()
        .map(|(m, of)| format!("{m} -> {:?}", of.intersection(&names).collect::<Vec<_>>()))
        .collect();
    assert!(tied.is_empty(), "in a circle, or between two: {tied:#?}");
}

#[test]
fn the_architecture_page_names_every_room_in_order() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("src/guide/architecture.md")).unwrap();
    let rows = page.lines().filter_map(|l| l.strip_prefix("| `"));
    let all: Vec<&str> = rows
        .flat_map(|l| l.split(" | ").next().unwrap().split(", "))
        .map(|room| room.trim_matches('`'))
        .collect();
    let (inner, named): (Vec<&str>, Vec<&str>) = all.into_iter().partition(|r| r.contains("::"));
    let folders = fs::read_dir(root.join("src/search")).unwrap();
    let folders = folders.map(|e| e.unwrap().path()).filter(|p| p.is_dir());
    let mut folders: Vec<String> = folders
        .map(|p| format!("search::{}", p.file_name().unwrap().display()))
        .collect();
    let mut inner: Vec<String> = inner.into_iter().map(str::to_owned).collect();
    folders.sort();
    inner.sort();
    assert_eq!(inner, folders);
    let layers: Vec<usize> = named.iter().map(|room| layer(room).unwrap()).collect();
    assert!(layers.is_sorted(), "{named:?}");
    assert_eq!(named.len(), LAYERS.concat().len());
}
