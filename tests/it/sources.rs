//! The source files, for tests that look at the code itself.

use crate::common::*;
/// The folders of the crates below `src`, which hold the rooms; what stands beside them is the root crate's.
/// `src/dense` and `src/python` know nothing of rooms.
pub(crate) const CRATES: [&str; 7] = [
    "kernel",
    "forces",
    "plot",
    "files",
    "evaluation",
    "catalogue",
    "show",
];

pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every Rust file below a folder.
pub(crate) fn below(folder: &Path) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            out.extend(below(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
    out
}

/// A Rust file in a room.
pub(crate) struct Source {
    pub(crate) path: PathBuf,
    /// The folder of its crate, or nothing where it is the root crate's.
    pub(crate) of: &'static str,
    /// Its path as a module, such as `rank/method`.
    pub(crate) module: String,
}

/// The files of all rooms; those that only put crates together, `lib.rs` and `main.rs`, left out.
pub(crate) fn rooms() -> Vec<Source> {
    let src = root().join("src");
    let named = below(&src).into_iter().filter_map(|path| {
        let inside = path.strip_prefix(&src).unwrap();
        let of = CRATES.into_iter().find(|c| inside.starts_with(c));
        let of = of.unwrap_or("");
        let module = inside.strip_prefix(of).unwrap().with_extension("");
        let module = module.to_str().unwrap().replace('\\', "/");
        let room = module.split('/').next().unwrap();
        let elsewhere = ["lib", "main", "dense", "python"].contains(&room);
        (!elsewhere).then_some(Source { path, of, module })
    });
    named.collect()
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
