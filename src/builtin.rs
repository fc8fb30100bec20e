//! The catalogue of mechanisms built into the program: `catalogs/`, a folder for each family. The folder also has
//! specifications of catalogues of grippers, which are not built in.

use include_dir::{Dir, File, include_dir};

static CATALOGS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/catalogs");

/// The families in the order of `ozols list`, each by its folder and its name.
const FAMILIES: [(&str, &str); 7] = [
    ("grippers", "grippers"),
    ("planar-linkages", "planar linkages"),
    ("straight-line-linkages", "straight-line linkages"),
    ("spatial-loops", "spatial loops"),
    (
        "parallel-robots-and-platforms",
        "parallel robots and platforms",
    ),
    (
        "shafts-slides-and-couplings",
        "shafts, slides and couplings",
    ),
    (
        "frameworks-plates-and-folds",
        "frameworks, plates and folds",
    ),
];

fn files() -> impl Iterator<Item = &'static File<'static>> {
    let folders = FAMILIES.iter().filter_map(|(f, _)| CATALOGS.get_dir(f));
    folders.flat_map(Dir::files)
}

/// Returns the name of the mechanism in a file.
fn name_of(file: &'static File<'static>) -> Option<&'static str> {
    file.path().file_name()?.to_str()?.strip_suffix(".toml")
}

/// Returns the names of the built-in mechanisms, ascending.
///
/// # Examples
/// ```
/// let names = ozols::builtin::names();
/// assert!(names.contains(&"gripper-10") && names.is_sorted());
/// ```
#[must_use]
pub fn names() -> Vec<&'static str> {
    let mut names: Vec<&str> = files().filter_map(name_of).collect();
    names.sort_unstable();
    names
}

/// Returns the file of a built-in mechanism, or `None` if there is none of this name.
///
/// # Examples
/// ```
/// assert!(ozols::builtin::text("four-bar").unwrap().contains("revolute"));
/// assert!(ozols::builtin::text("perpetuum-mobile").is_none());
/// ```
#[must_use]
pub fn text(name: &str) -> Option<&'static str> {
    files().find(|f| name_of(f) == Some(name))?.contents_utf8()
}

/// Returns every built-in mechanism by its name, ascending, with its file.
///
/// # Examples
/// ```
/// for (name, text) in ozols::builtin::all().into_iter().take(3) {
///     assert_eq!(ozols::from_toml(text)?.name, name);
/// }
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn all() -> Vec<(&'static str, &'static str)> {
    let with = |name| Some((name, text(name)?));
    names().into_iter().filter_map(with).collect()
}

/// Returns the names of the mechanisms of a family, ascending.
fn members(folder: &str) -> Vec<&'static str> {
    let dir = CATALOGS.get_dir(folder).into_iter();
    let mut names: Vec<&str> = dir.flat_map(Dir::files).filter_map(name_of).collect();
    names.sort_unstable();
    names
}

/// Returns the names of the built-in mechanisms by family, ascending in each.
#[must_use]
pub fn families() -> Vec<(&'static str, Vec<&'static str>)> {
    FAMILIES
        .map(|(folder, name)| (name, members(folder)))
        .into()
}

/// Returns the names of the built-in grippers, ascending.
#[must_use]
pub fn grippers() -> Vec<&'static str> {
    members("grippers")
}

#[cfg(test)]
mod tests {
    use super::{families, grippers, names};

    #[test]
    fn every_mechanism_is_in_one_family_and_has_a_name_of_its_own() {
        let mut of_families: Vec<&str> = families().into_iter().flat_map(|f| f.1).collect();
        of_families.sort_unstable();
        assert_eq!(of_families, names());
        assert!(names().windows(2).all(|pair| pair[0] != pair[1]));
        assert!(families().iter().all(|f| !f.1.is_empty()));
        assert_eq!(families()[0], ("grippers", grippers()));
    }
}
