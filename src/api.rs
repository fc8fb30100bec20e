//! The functions at the root of the library: read, analyse, search, draw and export a mechanism.

use crate::builtin;
use crate::draw::{self, Subject};
use crate::file::disk;
use crate::file::problem::ImportError;
use crate::file::text::{MAX_BYTES, mechanism_from_bytes, mechanism_from_str};
use crate::model::mechanism::{Mechanism, StateId};
use crate::redundancy::AnalysisError;
use crate::redundancy::analysis::{Method, StateAnalysis, analyse_states};
use crate::robots::ExportError;
use crate::robots::{self, Imported, Options, formats};
use crate::score::outcome::Outcome;
use crate::score::request::Request;
use crate::score::run::{RunError, run};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Maximum size of a robot description and of each file that it includes, in bytes.
pub(crate) const MAX_DESCRIPTION_BYTES: usize = 64 << 20;

/// An error of the functions at the root.
///
/// # Examples
/// ```
/// let why = ozols::built_in("perpetuum-mobile").unwrap_err();
/// assert!(matches!(&why, ozols::Error::NotBuiltIn(name) if name == "perpetuum-mobile"));
/// assert!(why.to_string().contains("ozols list"));
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file is invalid. Lists every problem with its place.
    #[error(transparent)]
    File(#[from] ImportError),
    /// A file cannot be read.
    #[error("cannot read {}: {why}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: io::Error,
    },
    /// There is no built-in mechanism of this name.
    #[error("{0} is not a built-in mechanism (`ozols list` shows them)")]
    NotBuiltIn(String),
    /// A mechanism cannot be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// A mechanism cannot be searched as requested.
    #[error(transparent)]
    Search(#[from] RunError),
    /// A format cannot represent the mechanism.
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// Returns a built-in mechanism by a name of [`builtin::names`] or `ozols list`.
///
/// # Errors
/// Returns an error if there is no such name.
///
/// # Examples
/// ```
/// let bennett = ozols::built_in("bennett")?;
/// assert_eq!(bennett.joints.len(), 4);
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn built_in(name: &str) -> Result<Mechanism, Error> {
    let text = builtin::text(name).ok_or_else(|| Error::NotBuiltIn(name.to_owned()))?;
    Ok(mechanism_from_str(&format!("{name}.toml"), text)?)
}

/// Reads a mechanism file (TOML, or JSON if its name ends in `.json`), a robot description or a CAD assembly (URDF, MJCF, SDF,
/// FCStd, ASMT, by the ending). [`import`] also reports what was approximated.
///
/// # Errors
/// Returns an error if the file cannot be read, or every problem in it with its place.
///
/// # Examples
/// ```
/// let folder = std::env::temp_dir();
/// let path = folder.join("ozols-four-bar.urdf");
/// std::fs::write(&path, ozols::export(&ozols::built_in("four-bar")?, "urdf")?).unwrap();
/// let read = ozols::open(&path)?;
/// assert_eq!(ozols::analyze(&read)?[0].redundant, 3);
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn open(path: impl AsRef<Path>) -> Result<Mechanism, Error> {
    let path = path.as_ref();
    let name = path.display().to_string();
    if robots::is_description(&name) {
        return Ok(import(path, &Options::default())?.mechanism);
    }
    let bytes = bytes(path, MAX_BYTES)?;
    robots::refuse_foreign(&name, &bytes)?;
    Ok(mechanism_from_bytes(&name, &bytes)?)
}

/// Reads the text of a mechanism file in TOML.
///
/// # Errors
/// Returns every problem found, with its place.
///
/// # Examples
/// ```
/// let error = ozols::from_toml("name = \"empty\"").unwrap_err();
/// assert!(error.to_string().contains("link"));
/// ```
pub fn from_toml(text: &str) -> Result<Mechanism, Error> {
    Ok(mechanism_from_str("mechanism.toml", text)?)
}

/// Reads the text of a mechanism file in JSON.
///
/// # Errors
/// Returns every problem found, with its place.
///
/// # Examples
/// ```
/// let four_bar = ozols::built_in("four-bar")?;
/// let again = ozols::from_json(&ozols::export(&four_bar, "json")?)?;
/// assert_eq!(again.name, four_bar.name);
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn from_json(text: &str) -> Result<Mechanism, Error> {
    Ok(mechanism_from_str("mechanism.json", text)?)
}

/// Returns the bytes of a file, at most `limit` + 1. The reader refuses more than `limit`.
pub(crate) fn bytes(path: &Path, limit: usize) -> Result<Vec<u8>, Error> {
    disk::read_bytes(path, limit).map_err(|why| Error::Read {
        path: path.to_owned(),
        why,
    })
}

/// Imports a robot description or CAD assembly, and reports what was approximated. Included files are read only from its folder
/// and from the folders of models in the options.
///
/// # Errors
/// Returns an error if a file cannot be read, or every problem in it.
///
/// # Examples
/// ```
/// let path = std::env::temp_dir().join("ozols-import-bennett.sdf");
/// std::fs::write(&path, ozols::export(&ozols::built_in("bennett")?, "sdf")?)?;
/// let read = ozols::import(&path, &ozols::robots::Options::default())?;
/// assert_eq!((read.mechanism.joints.len(), read.report.left_out), (4, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn import(path: impl AsRef<Path>, options: &Options) -> Result<Imported, Error> {
    let path = path.as_ref();
    let bytes = bytes(path, MAX_DESCRIPTION_BYTES)?;
    description_of(path, &bytes, options)
}

/// Imports the text of a robot description. `path` names it, and its folder has the included files.
pub(crate) fn description_of(
    path: &Path,
    bytes: &[u8],
    options: &Options,
) -> Result<Imported, Error> {
    let folder = std::fs::canonicalize(folder_of(path)).map_err(|why| Error::Read {
        path: path.to_owned(),
        why,
    })?;
    let read = |inner: &str| included(&folder, &options.models, inner);
    let name = path.display().to_string();
    Ok(robots::import(&name, bytes, &read, options)?)
}

/// Returns the folder of a file.
pub(crate) fn folder_of(path: &Path) -> &Path {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Returns the bytes of an included file, from the folder of the description or from a folder of models.
fn included(folder: &Path, models: &[PathBuf], name: &str) -> io::Result<Vec<u8>> {
    let (roots, name): (Vec<&Path>, &str) = match name.split_once("://") {
        Some(("model", name)) => (models.iter().map(PathBuf::as_path).collect(), name),
        Some((scheme, _)) => {
            return Err(io::Error::other(format!("{scheme}:// is not read")));
        }
        None => (vec![folder], name),
    };
    let mut why = io::Error::other("no folder of models was named");
    for root in roots {
        let root = std::fs::canonicalize(root)?;
        let found = std::fs::canonicalize(root.join(name)).and_then(|path| {
            let allowed = models.iter().filter_map(|m| std::fs::canonicalize(m).ok());
            if !path.starts_with(&root) && !allowed.into_iter().any(|m| path.starts_with(m)) {
                return Err(io::Error::other("it is outside the folder of the file"));
            }
            // A model is a folder with its description.
            let path = if path.is_dir() {
                path.join("model.sdf")
            } else {
                path
            };
            disk::read_bytes(&path, MAX_DESCRIPTION_BYTES)
        });
        match found {
            Ok(bytes) => return Ok(bytes),
            Err(e) => why = e,
        }
    }
    Err(why)
}

/// Returns the mobility and the redundant constraints of a mechanism in each of its states, the free state first, loop by
/// loop.
///
/// # Guarantee
/// Results are exact if the geometry is exact. For rounded coordinates they use singular values within the digits. The field
/// `certainty` of each state has the method.
///
/// # Errors
/// Returns an error if the geometry has no exact image, the singular values fail, or two primes disagree.
///
/// # Sources
/// `[Pogrebnyak 2018]` for the figures of the example.
///
/// # Examples
/// ```
/// let gripper = ozols::built_in("gripper-10")?;
/// let free = &ozols::analyze(&gripper)?[0];
/// assert_eq!((free.mobility, free.redundant), (1, 11));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn analyze(mechanism: &Mechanism) -> Result<Vec<StateAnalysis>, Error> {
    let states: Vec<StateId> = mechanism.state_ids().collect();
    let method = Method::Auto;
    Ok(analyse_states(mechanism, &states, method)?)
}

/// Returns every redesign of a mechanism that meets a request: exact counts, and the best redesigns one by one.
///
/// [`run`] does the same, can be cancelled, and reports progress.
///
/// # Units
/// Costs are those of the file, by default 1 for each freedom. Rankings use N, N·m and m.
///
/// # Guarantee
/// Counts are exact if [`Outcome::is_exact`], and lower bounds if the node budget ended the search. By default the whole diagram
/// is checked modulo a second prime near 2^61, and each listed variant is analysed again by singular values.
///
/// # Errors
/// Returns an error if the request names a joint, link or type that the mechanism does not have, if rounded coordinates change
/// the result, if two primes disagree, or if a ranking needs loads that the file does not state.
///
/// # Examples
/// ```
/// let four_bar = ozols::built_in("four-bar")?;
/// let outcome = ozols::search(&four_bar, &ozols::Request::default())?;
/// assert!(outcome.is_exact());
/// let best = outcome.variants().next().unwrap();
/// assert_eq!(best.redundant(), 0);
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn search(mechanism: &Mechanism, request: &Request) -> Result<Outcome, Error> {
    Ok(run(mechanism.clone(), request, &|| false, &mut |_| {})?)
}

/// Returns a mechanism as text in another format: `toml`, `json`, `urdf`, `mjcf`, `sdf` or `dot`. [`formats::writable_formats`]
/// lists them.
///
/// # Errors
/// Returns an error if there is no such format, or if it cannot represent a joint.
///
/// # Examples
/// ```
/// let m = ozols::built_in("four-bar")?;
/// assert!(ozols::export(&m, "urdf")?.contains("<robot"));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn export(mechanism: &Mechanism, format: &str) -> Result<String, Error> {
    Ok(formats::write(mechanism, format)?)
}

/// A kind of drawing.
///
/// # Examples
/// ```
/// let gripper = ozols::built_in("gripper-10")?;
/// let schemes = [ozols::Scheme::Structural, ozols::Scheme::Kinematic];
/// let [structural, kinematic] = schemes.map(|scheme| ozols::draw(&gripper, scheme));
/// assert_ne!(structural?, kinematic?);
/// # Ok::<(), ozols::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// Links as polygons, joints as circles with their class, and loops tinted by their redundant constraints.
    Structural,
    /// Links and symbols of joints at their coordinates.
    Kinematic,
}

/// Returns a drawing of a mechanism in its free state as a self-contained SVG.
///
/// # Errors
/// Returns the errors of [`analyze`]: the drawing shows the redundant constraints.
///
/// # Examples
/// ```
/// let four_bar = ozols::built_in("four-bar")?;
/// let svg = ozols::draw(&four_bar, ozols::Scheme::Kinematic)?;
/// assert!(svg.starts_with("<svg"));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn draw(mechanism: &Mechanism, scheme: Scheme) -> Result<String, Error> {
    let found = analyse_states(mechanism, &[StateId::FREE], Method::Auto)?;
    let subject = Subject {
        mechanism,
        state: StateId::FREE,
        analysis: found.first(),
        marks: None,
    };
    Ok(match scheme {
        Scheme::Structural => draw::scheme(&subject),
        Scheme::Kinematic => draw::kinematic(&subject),
    }
    .svg)
}
