//! Robot descriptions as mechanisms.
//!
//! A description is read into links and joints with a place on either side; loops come from the file or from a separate file
//! ([`Options::loops`]). The joints are composed into one pose. Loops that are open there are closed by changing joint values as little as
//! possible. Rigidly joined links become one. The result is a mechanism and the entries of its file, with a [`Report`] of what was
//! moved, approximated and dropped.

use crate::file::read::build_mechanism;
use crate::file::schema::{MechanismFile, ToleranceEntry};
use crate::file::text::mechanism_from_str;
use crate::file::write;
use crate::geom::extent::box_diagonal;
use crate::robots::cad::archive::Archive;
use crate::robots::cad::asmt;
use crate::robots::cad::fcstd::DOCUMENT;
use crate::robots::description::origin::Origin;
use crate::robots::description::{digits, loops};
use crate::robots::formats::{Format, list_roots, of_root, refuse_foreign};
use crate::robots::mechanism::entries::Content;
use crate::robots::mechanism::loop_closing::robot_size;
use crate::robots::mechanism::{loop_options, make_entries, pose_robot};
use crate::robots::prelude::*;
use crate::robots::warning::Report;

/// A mechanism and its origin.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// The entries of its file.
    pub file: MechanismFile,
    /// The format read.
    pub format: &'static Format,
    /// Moved, approximated and dropped elements.
    pub report: Report,
    /// The places of the mechanism's parts in the description.
    pub origin: Origin,
}

impl Imported {
    /// Returns the mechanism file as TOML.
    ///
    /// # Errors
    /// No error is known.
    ///
    /// # Examples
    /// ```
    /// use ozols::robots::{Options, import};
    /// let sdf = ozols::export(&ozols::built_in("bennett")?, "sdf")?;
    /// let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
    /// let read = import("bennett.sdf", sdf.as_bytes(), &none, &Options::default())?;
    /// assert_eq!(ozols::from_toml(&read.toml()?)?.joints.len(), 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn toml(&self) -> Result<String, ExportError> {
        Ok(write::toml(&self.file)?)
    }
}

/// Reads the root element of a description: of XML, of the document in an archive, or of lines indented by tabs.
fn read_root(
    document: &mut Document,
    name: &str,
    bytes: &[u8],
    archive: Option<&Archive>,
) -> Result<usize, ImportError> {
    let Some(archive) = archive else {
        let text = decode_utf8(name, bytes)?;
        return if asmt::is_one(text.as_bytes()) {
            asmt::read_lines(document, name, text)
        } else {
            document.read(name, text)
        };
    };
    let name = format!("{name}/{DOCUMENT}");
    let Some(found) = archive.read_member(DOCUMENT)? else {
        let message = format!("the archive has no {DOCUMENT}; it is not a FreeCAD document");
        return Err(syntax_problem(message).in_file(&name, "", None));
    };
    document.read(&name, decode_utf8(&name, &found)?)
}

/// Imports a description. `read` gives the files it includes.
///
/// # Errors
/// Returns the first problem found, with its place.
///
/// # Examples
/// ```
/// use ozols::robots::{Options, import};
/// let mjcf = ozols::export(&ozols::built_in("four-bar")?, "mjcf")?;
/// let none = |_: &str| Err(std::io::ErrorKind::NotFound.into());
/// let read = import("four-bar.xml", mjcf.as_bytes(), &none, &Options::default())?;
/// assert_eq!((read.format.word, read.report.left_out()), ("mjcf", 0));
/// assert_eq!(ozols::analyze(&read.mechanism)?[0].redundant, 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn import(
    name: &str,
    bytes: &[u8],
    read: Reader<'_>,
    options: &Options,
) -> Result<Imported, ImportError> {
    refuse_foreign(name, bytes)?;
    let mut document = Document::default();
    let archive = Archive::find_archive(name, bytes);
    let root = read_root(&mut document, name, bytes, archive.as_ref())?;
    // Members of the archive take precedence over files next to it.
    let inner = |member: &str| match archive.as_ref().map(|a| a.read_member(member)) {
        Some(Ok(Some(found))) => Ok(found),
        _ => read(member),
    };
    let read: Reader<'_> = &inner;
    let input = Input {
        document: &mut document,
        root,
        read,
        options,
    };
    let (format, mut robot) = read_described(input)?;
    if robot.links.is_empty() {
        return Err(document.element(root).missing_error("links"));
    }
    let fail = |p: ProblemKind| p.in_file(name, "", None);
    match &options.loops {
        Some((side, bytes)) => loops::add_loops(side, bytes, &mut robot)?,
        None if format.word == "urdf" => loops::report_beside(name, read, &mut robot),
        None => {}
    }
    let tree = pose_robot(&mut robot, options).map_err(fail)?;
    let source = std::path::Path::new(name).file_name().unwrap_or_default();
    let source = format!("{} ({})", source.to_string_lossy(), format.name);
    let (mut file, content) = make_entries(&mut robot, &tree, &source, options).map_err(fail)?;
    file.assumed.clone_from(&robot.report.assumed);
    file.tolerance = find_tolerance(document.element(root), &robot, &content);
    let closes = content.joints.iter().map(|&j| robot.joints[j].closes);
    let closes: Vec<bool> = closes.collect();
    let mechanism = with_offers(&mut file, &closes)?;
    Ok(Imported {
        mechanism,
        file,
        format,
        report: std::mem::take(&mut robot.report),
        origin: Origin {
            document,
            archive,
            root,
            robot,
            places: content.places,
            joints: content.joints,
            couplings: content.couplings.iter().map(|u| u.said_by).collect(),
        },
    })
}

/// Returns the accuracy of a robot: from its reader, or from the digits of the numbers below its root element.
fn find_tolerance(root: Element<'_>, robot: &Robot, content: &Content) -> Option<ToleranceEntry> {
    if let Some(known) = robot.known_to {
        return digits::stated_tolerance(known);
    }
    let at_joints = content.joints.iter().map(|&j| {
        let part = &robot.joints[j];
        content.places[part.links[0]]
            .then(&part.sides[0])
            .translation
    });
    digits::find_tolerance(root, robot_size(robot), box_diagonal(at_joints))
}

/// Returns the robot that the reader of its root element finds.
fn read_described(input: Input<'_>) -> Read<(&'static Format, Robot)> {
    let (document, root) = (&*input.document, input.root);
    let found = document.element(root).name().to_owned();
    let Some((format, describe)) = of_root(&found) else {
        let known = list_roots();
        let element = document.element(root);
        let message = format!("the root element is <{found}>; {known} can be read");
        return Err(element.error_at(None, syntax_problem(message)));
    };
    check_expanded(document)?;
    Ok((format, describe(input)?))
}

/// Rejects a template whose macros are not expanded, because no element contains their content.
fn check_expanded(document: &Document) -> Result<(), ImportError> {
    let all = (0..document.nodes.len()).map(|id| document.element(id));
    let is_macro = |e: &Element<'_>| {
        let values = e.attributes().map(|(_, v)| v).chain([e.text()]);
        let marks = ["${", "$(arg", "$(find", "$(eval", "$(env", "$(optenv"];
        e.name().starts_with("xacro:")
            || values
                .into_iter()
                .any(|v| marks.iter().any(|m| v.contains(m)))
    };
    match all.into_iter().find(is_macro) {
        None => Ok(()),
        Some(e) => Err(e.unsupported_error(
            "the file is xacro, a template whose macros are not expanded",
            "run `xacro FILE > robot.urdf` and give the result",
        )),
    }
}

/// Returns the mechanism of a file. Joints that close loops get options for searches, if these can be written.
fn with_offers(file: &mut MechanismFile, closes: &[bool]) -> Read<Mechanism> {
    // Problems are shown in the text that would be written.
    let mechanism = build_mechanism(file).or_else(|_| {
        let text = write::toml(file).unwrap_or_default();
        mechanism_from_str("the imported mechanism", &text)
    })?;
    let mut offered = file.clone();
    if loop_options::at_loops(&mechanism, closes, &mut offered)
        && let Ok(m) = build_mechanism(&offered)
    {
        *file = offered;
        return Ok(m);
    }
    Ok(mechanism)
}
