//! The repository stands alone: no source file, no test and no script needs a file outside of it.
//!
//! This looks at what they name. `.ci/run` runs all tests in a copy with nothing beside it.

use crate::common::*;
use crate::sources::root;
use std::path::Component;

/// Folders of other projects' files. Who names them here does without where they are missing.
const OTHERS: [(&str, &str); 3] = [
    (".ci/run", "../shared"),
    ("tests/peers/run", "../shared/models"),
    ("tests/peers/run", "../shared/assemblies"),
];

/// Names that the program is given to refuse, or that lie within a folder that a test makes.
const GIVEN: [(&str, &[&str]); 4] = [
    ("src/cli/terminal/memory/group.rs", &["/../x"]),
    ("tests/it/robots/mjcf.rs", &["../arm.xml", "../secret.xml"]),
    (
        "tests/it/robots/readers.rs",
        &[
            "//../secret",
            "../secret/model.sdf",
            "../part.xml",
            "../../secret.xml",
        ],
    ),
    (
        "tests/it/studio/door.rs",
        &[
            "../secret.toml",
            "picture/../../secret.toml",
            "../out.toml",
            "../secret",
        ],
    ),
];

/// Folders of a person's own, by the beginning of their paths.
const HOMES: [&str; 5] = ["/home/", "/root/", "/Users/", "/work/", "/mnt/"];

/// Returns the names in a text that lead out of the repository.
fn leading_out<'t>(file: &str, text: &'t str) -> Vec<&'t str> {
    let is_part = |c: char| c.is_alphanumeric() || "._-/".contains(c);
    let names = text.split(|c: char| !is_part(c));
    // `${FOLDER:-../x}` of a shell.
    let names = names.map(|name| name.trim_start_matches('-'));
    let own = Path::new(file).parent().unwrap_or(Path::new(""));
    let leads_out = |name: &&str| {
        if HOMES.iter().any(|home| name.starts_with(home)) {
            return true;
        }
        let climbs = Path::new(name)
            .components()
            .any(|c| c == Component::ParentDir);
        // A script begins in the folder of its own, a test in that of the repository.
        let name = name.trim_start_matches('/');
        let there = |from: &Path| inside(&from.join(name)).is_some_and(|p| root().join(p).exists());
        climbs && name.contains('/') && !there(own) && inside(Path::new(name)).is_none()
    };
    names.filter(leads_out).collect()
}

/// Returns a path from the root of the repository without what goes up in it; none where it leads out.
fn inside(path: &Path) -> Option<PathBuf> {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir if !out.pop() => return None,
            Component::Normal(name) => out.push(name),
            _ => {}
        }
    }
    Some(out)
}

/// Adds the files below a folder that are compiled, run, or say what is.
fn add_code(folder: &Path, to: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        let made = [
            "target",
            "corpus",
            "data",
            "proptest-regressions",
            "node_modules",
        ];
        if path.is_dir() {
            if !made.contains(&name) {
                add_code(&path, to);
            }
        } else {
            let ending = path.extension().and_then(|e| e.to_str());
            let code = ["rs", "toml", "py", "mjs", "js", "c", "cpp", "yml", "sql"];
            if ending.is_none_or(|e| code.contains(&e)) {
                to.push(path);
            }
        }
    }
}

#[test]
fn nothing_outside_is_needed() {
    let mut files = vec![root().join("Cargo.toml"), root().join("build.rs")];
    for folder in ["src", "tests", "benches", ".ci", ".github"] {
        add_code(&root().join(folder), &mut files);
    }
    let (mut wrong, mut read) = (Vec::new(), 0);
    for path in files {
        let Ok(text) = fs::read_to_string(&path) else {
            continue;
        };
        read += 1;
        let file = path.strip_prefix(root()).unwrap().to_str().unwrap();
        let file = file.replace('\\', "/");
        if file == "tests/it/alone.rs" {
            continue;
        }
        let given = GIVEN.iter().find(|(of, _)| *of == file);
        let given = given.map_or(&[][..], |(_, names)| names);
        let is_known =
            |name: &&str| OTHERS.contains(&(file.as_str(), *name)) || given.contains(name);
        let names = leading_out(&file, &text).into_iter();
        wrong.extend(
            names
                .filter(|n| !is_known(n))
                .map(|n| format!("{file}: {n}")),
        );
    }
    assert!(read > 1000, "{read}");
    assert!(
        wrong.is_empty(),
        "names that lead out of the repository; what a test needs belongs in tests/data: {wrong:#?}"
    );
}

/// Each of these needs a file outside, whatever the way in which it is read.
#[test]
fn what_is_outside_is_seen() {
    for (file, text) in [
        ("tests/it/x.rs", r#"include_str!("../../../beside/x.csv")"#),
        ("tests/it/a/x.rs", r#"include_bytes!("../../../../x.bin")"#),
        ("src/x.rs", r#"#[path = "../../beside/x.rs"] mod x;"#),
        ("tests/it/x.rs", r#"root().join("../beside/data/x.json")"#),
        ("tests/it/x.rs", r##"read(r#"./../beside"#)"##),
        ("tests/it/x.rs", r#"read("tests/../../beside/x")"#),
        ("tests/peers/run", "models=${MODELS:-../beside/models}"),
        ("tests/peers/x.py", "open('../../../beside/x')"),
        ("tests/it/x.rs", r#"read("/home/me/x.json")"#),
    ] {
        assert_eq!(leading_out(file, text).len(), 1, "{file}: {text}");
    }
    for (file, text) in [
        ("tests/it/x.rs", r#"include_str!("../data/counts.csv")"#),
        ("tests/peers/run", r#"cd "$(dirname "$0")/../..""#),
        ("src/files/Cargo.toml", r#"path = "../..""#),
        ("src/x.rs", "0..9, a.../b, Some(..)"),
    ] {
        assert_eq!(leading_out(file, text), [""; 0], "{file}: {text}");
    }
}
