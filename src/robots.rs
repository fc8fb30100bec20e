//! Robot descriptions (URDF, MJCF, SDF) as mechanism files.
//!
//! A description is read into links and joints with a place on either side; loops come from the file or from a file
//! beside it ([`Options::loops`]). The joints are composed into one pose, loops that are open there are closed by
//! changing joint values as little as possible, rigidly joined links become one, and the result is the text of a
//! mechanism file that [`crate::file::text`] reads, with a [`Report`] of what was mapped, approximated and dropped.

mod build;
mod close;
mod coupling;
mod emit;
pub mod export;
mod graph;
mod kinematics;
mod loops;
mod mimic;
mod mjcf;
mod parts;
mod problem;
mod sdf;
mod single_freedoms;
mod urdf;
mod warning;
mod xml;

pub use parts::Format;
pub use warning::{Kept, Note, Report};

use crate::file::problem::ImportError;
use crate::file::text::mechanism_from_str;
use build::{apply_pose, close_loops, held, root_link, write};
use kinematics::spanning_tree;
use problem::RobotProblem;
use xml::Document;

/// What to do with a description.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Name and bytes of a file of loop closures.
    pub loops: Option<(String, Vec<u8>)>,
    /// Values of joints, in radians and metres, one for each freedom.
    pub pose: Vec<(String, Vec<f64>)>,
    /// Hang a robot without a fixed link on the world by a joint of six freedoms.
    pub floating: bool,
    /// SDF drawn in parts: every joint puts the frame that is its parent onto its child.
    pub assemble: bool,
    /// Take loops that do not close as they are.
    pub open: bool,
    /// The link to be the frame, in place of the root.
    pub frame: Option<String>,
    /// The links to be outputs, in place of the end links.
    pub outputs: Vec<String>,
}

/// A mechanism file and how it came about.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The file, TOML.
    pub toml: String,
    /// The format read.
    pub format: Format,
    /// What was mapped, approximated and dropped.
    pub report: Report,
}

/// Reads the bytes of a file that an included file's name stands for.
pub type Reader<'a> = &'a dyn Fn(&str) -> std::io::Result<Vec<u8>>;

/// Whether a file of this name is a robot description, by its ending.
#[must_use]
pub fn is_description(name: &str) -> bool {
    std::path::Path::new(name).extension().is_some_and(|e| {
        ["urdf", "xml", "mjcf", "sdf", "world"]
            .iter()
            .any(|known| e.eq_ignore_ascii_case(known))
    })
}

/// Imports a description. `read` gives the files it includes.
///
/// # Errors
/// The first problem found, with its place.
pub fn import(
    name: &str,
    bytes: &[u8],
    read: Reader<'_>,
    options: &Options,
) -> Result<Imported, ImportError> {
    let mut document = Document::default();
    let root = document.read(name, xml::utf8(name, bytes)?)?;
    if document.element(root).name() == "mujoco" {
        mjcf::include::expand(&mut document, root, read)?;
    }
    let element = document.element(root);
    let mut robot = match element.name() {
        "robot" => urdf::read::read(element)?,
        "mujoco" => mjcf::read::read(element)?,
        "sdf" => sdf::read::read(element, options.assemble)?,
        other => {
            let found = other.to_owned();
            return Err(element.fail(None, RobotProblem::Format { found }));
        }
    };
    let fail = |p: RobotProblem| p.at(name, "", None);
    if robot.links.is_empty() {
        let what = "links".to_owned();
        return Err(element.fail(
            None,
            RobotProblem::Missing {
                element: element.label(),
                what,
            },
        ));
    }
    if let Some((side, bytes)) = &options.loops {
        loops::add(side, bytes, &mut robot)?;
    }
    apply_pose(&mut robot, options).map_err(fail)?;
    let frame = root_link(&mut robot, options).map_err(fail)?;
    let tree = spanning_tree(&robot, frame);
    held(&robot, &tree).map_err(fail)?;
    close_loops(&mut robot, &tree, options).map_err(fail)?;
    let toml = write(&mut robot, &tree, name, options).map_err(fail)?;
    // What is written must read back; limits on size are found here.
    let mechanism = mechanism_from_str("the imported mechanism", &toml)?;
    robot.report.kept = coupling::kept(&mechanism);
    Ok(Imported {
        toml,
        format: robot.format,
        report: robot.report,
    })
}
