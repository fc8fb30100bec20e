//! Imports go downward only.

use crate::common::*;
use crate::sources::{CRATES, below, rooms, root, without_tests};

/// The layers, lowest first, each with the folder of its crate; rooms of one row do not import each other. Between crates the
/// compiler holds them, within one this test does.
const LAYERS: [(&str, &[&str]); 28] = [
    ("kernel", &["format", "shard"]),
    ("kernel", &["linalg"]),
    ("kernel", &["geom", "verify"]),
    ("kernel", &["model"]),
    ("kernel", &["closure"]),
    ("kernel", &["motion", "meant"]),
    ("kernel", &["rank"]),
    ("kernel", &["redundancy"]),
    ("kernel", &["search"]),
    ("forces", &["statics"]),
    ("forces", &["grip", "drive"]),
    ("plot", &["svg"]),
    ("plot", &["chart"]),
    ("files", &["file"]),
    ("files", &["robots"]),
    ("evaluation", &["score"]),
    ("evaluation", &["accuracy"]),
    ("catalogue", &["chains"]),
    ("catalogue", &["synthesis"]),
    ("catalogue", &["catalog"]),
    ("show", &["terms"]),
    ("show", &["draw"]),
    ("show", &["view"]),
    ("show", &["page"]),
    ("", &["guide", "builtin"]),
    ("", &["api"]),
    ("", &["studio"]),
    ("", &["cli"]),
];

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|(_, row)| row.contains(&module))
}

#[test]
fn no_module_imports_upward_or_sideways() {
    let mut wrong = Vec::new();
    for source in rooms() {
        let module = source.module.split('/').next().unwrap();
        let own = layer(module)
            .unwrap_or_else(|| panic!("{module} has no place in the layers; give it one"));
        assert_eq!(LAYERS[own].0, source.of, "the crate of {module}");
        for (n, line) in fs::read_to_string(&source.path)
            .unwrap()
            .lines()
            .enumerate()
        {
            for used in line.split("crate::").skip(1) {
                let used: String = used
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect();
                let Some(other) = layer(&used) else { continue };
                if used != module && other >= own {
                    wrong.push(format!("{}:{}: {module} -> {used}", source.module, n + 1));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A crate imports those of lower layers, and each room is in one.
#[test]
fn crates_are_in_the_order_of_the_layers() {
    let mut order: Vec<&str> = LAYERS.iter().map(|(of, _)| *of).collect();
    order.dedup();
    assert_eq!(order[..CRATES.len()], CRATES);
    for (n, of) in CRATES.into_iter().enumerate() {
        let manifest = root().join(format!("src/{of}/Cargo.toml"));
        let manifest: toml::Table = fs::read_to_string(manifest).unwrap().parse().unwrap();
        let needs = manifest["dependencies"].as_table().unwrap();
        for higher in &CRATES[n..] {
            assert!(
                !needs.contains_key(&format!("ozols-{higher}")),
                "{of} -> {higher}"
            );
        }
    }
}

/// What a person reads at one sitting.
const LINES: usize = 450;

#[test]
fn no_file_is_longer_than_a_sitting() {
    let folders = ["src", "tests/it", "benches"].map(|f| below(&root().join(f)));
    let mut files = folders.concat();
    let lines = |f: &PathBuf| fs::read_to_string(f).unwrap().lines().count();
    files.retain(|f| lines(f) > LINES);
    assert!(files.is_empty(), "over {LINES} lines: {files:#?}");
}

/// A file as a module, such as `rank/method`, and its source without comments and tests.
fn modules() -> BTreeMap<String, String> {
    let named = rooms().into_iter().map(|source| {
        let text = fs::read_to_string(&source.path).unwrap();
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
        (source.module, code.join("\n"))
    });
    named.collect()
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
        .map(|(m, of)| format!("{m} -> {:?}", of.intersection(&names).collect_vec()))
        .collect();
    assert!(tied.is_empty(), "in a circle, or between two: {tied:#?}");
}

#[test]
fn the_architecture_page_names_every_room_in_order() {
    let page = fs::read_to_string(root().join("src/guide/architecture.md")).unwrap();
    let rows = page.lines().filter_map(|l| l.strip_prefix("| `"));
    let all: Vec<&str> = rows
        .flat_map(|l| l.split(" | ").next().unwrap().split(", "))
        .map(|room| room.trim_matches('`'))
        .collect();
    let (inner, named): (Vec<&str>, Vec<&str>) = all.into_iter().partition(|r| r.contains("::"));
    let folders = fs::read_dir(root().join("src/kernel/search")).unwrap();
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
    let rooms: usize = LAYERS.iter().map(|(_, row)| row.len()).sum();
    assert_eq!(named.len(), rooms);
}
