//! The catalogue of mechanisms built into the program.

use include_dir::{Dir, include_dir};
use serde::Deserialize;

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

/// Names of the built-in mechanisms by family, each in one; those that no family names are `other mechanisms`.
///
/// # Panics
/// Never: a test reads the list of families.
#[must_use]
pub fn families() -> Vec<(String, Vec<&'static str>)> {
    let listed: Families =
        toml::from_str(include_str!("builtin/families.toml")).expect("a test reads the file");
    let mut left = names();
    let mut families = Vec::new();
    for family in listed.family {
        let here = |n: &&str| family.members.iter().any(|m| m == n);
        let (members, rest) = left.into_iter().partition(here);
        families.push((family.name, members));
        left = rest;
    }
    if !left.is_empty() {
        families.push(("other mechanisms".to_owned(), left));
    }
    families
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Families {
    family: Vec<Family>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Family {
    name: String,
    members: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::{Families, families, names};

    #[test]
    fn families_name_mechanisms_that_exist_each_once() {
        let listed: Families = toml::from_str(include_str!("builtin/families.toml")).expect("TOML");
        let mut members: Vec<&String> = listed.family.iter().flat_map(|f| &f.members).collect();
        members.sort();
        for pair in members.windows(2) {
            assert_ne!(pair[0], pair[1]);
        }
        for m in members {
            assert!(names().contains(&m.as_str()), "{m}");
        }
        let mut all: Vec<&str> = families().into_iter().flat_map(|f| f.1).collect();
        all.sort_unstable();
        assert_eq!(all, names());
    }
}
