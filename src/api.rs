//! The front door: a mechanism from a file or a name, its analysis, its redesigns, its drawings, and itself in other
//! formats.

use crate::builtin;
use crate::draw::{self, Subject};
use crate::file::disk;
use crate::file::problem::ImportError;
use crate::file::text::{MAX_BYTES, mechanism_from_bytes, mechanism_from_str};
use crate::model::mechanism::{Mechanism, StateId};
use crate::redundancy::AnalysisError;
use crate::redundancy::analysis::{Method, StateAnalysis, analyse};
use crate::robots::ExportError;
use crate::robots::{self, Imported, Options, formats};
use crate::score::outcome::Outcome;
use crate::score::request::Request;
use crate::score::run::{RunError, run};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest robot description and file beside it, in bytes.
pub(crate) const MAX_DESCRIPTION_BYTES: usize = 64 << 20;

/// What went wrong, in the words of the command line.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file says what it should not; every problem with its place.
    #[error(transparent)]
    File(#[from] ImportError),
    /// A file cannot be read.
    #[error("cannot read {}: {why}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why not.
        why: io::Error,
    },
    /// No mechanism of this name is built in.
    #[error("{0} is not a built-in mechanism (`ozols list` shows them)")]
    NotBuiltIn(String),
    /// A mechanism cannot be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// A mechanism cannot be searched as the request asks.
    #[error(transparent)]
    Search(#[from] RunError),
    /// A format cannot say what a mechanism is.
    #[error(transparent)]
    Export(#[from] ExportError),
}

/// One of the mechanisms that are built in, by the name that [`builtin::names`] or `ozols list` gives.
///
/// # Errors
/// Where there is none of this name.
pub fn built_in(name: &str) -> Result<Mechanism, Error> {
    let text = builtin::text(name).ok_or_else(|| Error::NotBuiltIn(name.to_owned()))?;
    Ok(mechanism_from_str(&format!("{name}.toml"), text)?)
}

/// Reads a mechanism file (JSON where its name ends in .json, else TOML) or a robot description or CAD assembly (URDF,
/// MJCF, SDF, FCStd, ASMT, by the ending). What was approximated in a description is in the report of [`import`].
///
/// # Errors
/// Where the file cannot be read, and every problem in it, each with its place.
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
/// Every problem found, each with its place.
pub fn from_toml(text: &str) -> Result<Mechanism, Error> {
    Ok(mechanism_from_str("mechanism.toml", text)?)
}

/// Reads the text of a mechanism file in JSON.
///
/// # Errors
/// Every problem found, each with its place.
pub fn from_json(text: &str) -> Result<Mechanism, Error> {
    Ok(mechanism_from_str("mechanism.json", text)?)
}

/// The bytes of a file, one more than `limit` at most: the reader of them says that there are too many.
pub(crate) fn bytes(path: &Path, limit: usize) -> Result<Vec<u8>, Error> {
    disk::bytes(path, limit).map_err(|why| Error::Read {
        path: path.to_owned(),
        why,
    })
}

/// Imports a robot description or CAD assembly, with a report of what was approximated; files it includes are read from its folder and
/// from the folders of models that the options name, and nowhere else.
///
/// # Errors
/// Where a file cannot be read, and every problem in it.
pub fn import(path: impl AsRef<Path>, options: &Options) -> Result<Imported, Error> {
    let path = path.as_ref();
    let bytes = bytes(path, MAX_DESCRIPTION_BYTES)?;
    description_of(path, &bytes, options)
}

/// Imports the text of a robot description as if it stood in a file.
pub(crate) fn description_of(
    path: &Path,
    bytes: &[u8],
    options: &Options,
) -> Result<Imported, Error> {
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let folder = std::fs::canonicalize(folder).map_err(|why| Error::Read {
        path: path.to_owned(),
        why,
    })?;
    let read = |inner: &str| included(&folder, &options.models, inner);
    let name = path.display().to_string();
    Ok(robots::import(&name, bytes, &read, options)?)
}

/// The bytes of an included file: of the description's own folder, or of one of the folders of models.
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
            disk::bytes(&path, MAX_DESCRIPTION_BYTES)
        });
        match found {
            Ok(bytes) => return Ok(bytes),
            Err(e) => why = e,
        }
    }
    Err(why)
}

/// The structure of a mechanism in each of its states, the free one first: mobility, redundant constraints, contour by
/// contour, and how certain that is.
///
/// # Guarantee
/// Exact where the geometry is; where its coordinates look measured, what singular values say to within the digits. Each
/// state's `certainty` tells.
///
/// # Errors
/// Where the geometry has no exact image, the singular values fail, or two primes disagree.
///
/// # Sources
/// `[Pogrebnyak 2018]` for the figures of the example.
///
/// ```
/// let gripper = ozols::built_in("gripper-10")?;
/// let free = &ozols::analyze(&gripper)?[0];
/// assert_eq!((free.mobility, free.redundant), (1, 11));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn analyze(mechanism: &Mechanism) -> Result<Vec<StateAnalysis>, Error> {
    let states: Vec<StateId> = mechanism.state_ids().collect();
    let method = Method::Auto;
    Ok(analyse(mechanism, &states, method)?)
}

/// Every redesign of a mechanism that meets a request: exact counts, and the best of them one by one.
///
/// [`run`] does the same, can be cancelled and says how far it has come.
///
/// # Units
/// Costs are those of the file, 1 a freedom unless it says otherwise; forces of a ranking in N, moments in N·m, errors in m.
///
/// # Guarantee
/// Counts are exact where [`Outcome::is_exact`], and lower bounds where the node budget ended the search. With the default
/// check the whole diagram agrees modulo two primes near 2^61, and each variant given is analysed again by singular values.
///
/// # Errors
/// Where the request names what the mechanism has not, measured coordinates change the figures, two primes disagree, or a
/// ranking asks for loads that are not there.
pub fn search(mechanism: &Mechanism, request: &Request) -> Result<Outcome, Error> {
    Ok(run(mechanism.clone(), request, &|| false, &mut |_| {})?)
}

/// A mechanism in another format, as text: `toml` and `json` for the mechanism file, `urdf`, `mjcf`, `sdf`, `dot` and `graphml`;
/// see
/// [`formats::written`].
///
/// # Errors
/// Where there is no such format, or it has no such joint.
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

/// A drawing of a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// Links as polygons, joints as circles with their class, contours tinted by their redundant constraints.
    Structural,
    /// Links and the symbols of joints in place, from the coordinates.
    Kinematic,
}

/// A drawing of a mechanism in its free state, as SVG that needs nothing beside it.
///
/// # Errors
/// As [`analyze`]: the structural scheme shows where the redundant constraints are.
pub fn draw(mechanism: &Mechanism, scheme: Scheme) -> Result<String, Error> {
    let found = analyse(mechanism, &[StateId::FREE], Method::Auto)?;
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
