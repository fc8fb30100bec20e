//! Imports go downward only.

use std::fs;
use std::path::{Path, PathBuf};

/// The layers, lowest first; modules of one row do not import each other, except where a row says so by order.
const LAYERS: [&[&str]; 14] = [
    &["format"],
    &["linalg", "chart", "terms", "guide", "builtin"],
    &["geom", "verify"],
    &["model"],
    &["closure"],
    &["motion"],
    &["rank", "statics"],
    &["grip", "drive"],
    &["redundancy", "file"],
    &["search", "robots"],
    &["accuracy", "score", "draw"],
    &["view"],
    &["page"],
    &["cli"],
];

fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, out);
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
        if ["lib", "main"].contains(&module) {
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
