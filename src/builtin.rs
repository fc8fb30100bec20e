//! The catalogue of mechanisms built into the program.

use include_dir::{Dir, include_dir};

static CATALOGS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/catalogs");

/// Names of the built-in mechanisms, ascending.
#[must_use]
pub fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = CATALOGS
        .files()
        .filter(|f| f.path().extension().is_some_and(|e| e == "toml"))
        .filter_map(|f| f.path().file_stem()?.to_str())
        .collect();
    names.sort_unstable();
    names
}

/// The file of a built-in mechanism.
#[must_use]
pub fn text(name: &str) -> Option<&'static str> {
    CATALOGS.get_file(format!("{name}.toml"))?.contents_utf8()
}
