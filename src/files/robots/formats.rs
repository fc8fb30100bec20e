//! The formats of files, with their readers and writers.

use crate::file::schema::MechanismFile;
use crate::file::write;
use crate::robots::cad::archive::Archive;
use crate::robots::cad::{asmt, fcstd};
use crate::robots::prelude::*;
use crate::robots::{mjcf, sdf, urdf};

/// A format of files.
#[derive(Debug)]
pub struct Format {
    /// The word on the command line.
    pub word: &'static str,
    /// The usual name.
    pub name: &'static str,
    /// The content of a written file.
    pub about: &'static str,
    /// Endings of files that are robot descriptions of this format.
    endings: &'static [&'static str],
    /// The root element and the reader, for a format that is read.
    read: Option<(&'static str, Describe)>,
    /// The writer, for a format that is written. A mechanism has no shapes and references, which CAD documents need.
    write: Option<Writer>,
}

/// Reads a robot.
pub(crate) type Describe = fn(Input<'_>) -> Read<Robot>;

/// Writes a mechanism.
type Writer = fn(&Mechanism) -> Result<FormattedFile, ExportError>;

/// A mechanism in a format.
#[derive(Debug)]
pub struct FormattedFile {
    /// The text.
    pub text: String,
    /// The omissions and placeholders of the format, a sentence each; comments of the text repeat them.
    pub told: Vec<String>,
}

impl From<String> for FormattedFile {
    fn from(text: String) -> FormattedFile {
        let told = Vec::new();
        FormattedFile { text, told }
    }
}

/// Returns a format that is neither read nor written.
const fn format(word: &'static str, name: &'static str, about: &'static str) -> Format {
    Format {
        word,
        name,
        about,
        endings: &[],
        read: None,
        write: None,
    }
}

/// All formats.
static FORMATS: [Format; 8] = [
    Format {
        write: Some(|m| Ok(write::toml(&own_file(m)?)?.into())),
        ..format(
            "toml",
            "TOML",
            "The mechanism file, with the options of every joint",
        )
    },
    Format {
        write: Some(|m| Ok(format!("{:#}\n", own_file(m)?.json()).into())),
        ..format("json", "JSON", "The same as JSON")
    },
    Format {
        endings: &["urdf", "xacro", "xml"],
        read: Some(("robot", urdf::read_urdf)),
        write: Some(urdf::write::write_urdf),
        ..format("urdf", "URDF", "A spanning tree, loops as <loop_joint>")
    },
    Format {
        endings: &["mjcf", "xml"],
        read: Some(("mujoco", mjcf::read_mujoco)),
        write: Some(mjcf::write::write_mjcf),
        ..format("mjcf", "MJCF", "Bodies; loops as connect and weld")
    },
    Format {
        endings: &["sdf", "world", "xml"],
        read: Some(("sdf", sdf::read_sdf)),
        write: Some(|m| Ok(sdf::write::write_sdf(m))),
        ..format("sdf", "SDF", "Loops closed by joints")
    },
    Format {
        endings: &["fcstd"],
        read: Some(("Document", fcstd::read_document)),
        ..format("fcstd", "FreeCAD", "")
    },
    Format {
        endings: &["asmt"],
        read: Some(("Assembly", asmt::read_assembly)),
        ..format("asmt", "OndselSolver", "")
    },
    Format {
        write: Some(|m| Ok(write_dot(m).into())),
        ..format("dot", "DOT", "Graphviz")
    },
];

/// Returns the formats in which a mechanism can be written.
///
/// # Examples
/// ```
/// let words: Vec<&str> = ozols::robots::formats::writable_formats().map(|f| f.word).collect();
/// assert!(["toml", "json", "urdf", "mjcf", "sdf", "dot"].iter().all(|w| words.contains(w)));
/// ```
pub fn writable_formats() -> impl Iterator<Item = &'static Format> {
    FORMATS.iter().filter(|f| f.write.is_some())
}

/// Writes a mechanism in the format of the given name, one of those of [`writable_formats`].
///
/// # Errors
/// Returns an error if there is no such format, or if it cannot represent the mechanism.
///
/// # Examples
/// ```
/// let m = ozols::built_in("four-bar").unwrap();
/// let graph = ozols::robots::formats::write(&m, "dot").unwrap();
/// assert!(graph.contains("graph"));
/// ```
pub fn write(m: &Mechanism, word: &str) -> Result<String, ExportError> {
    Ok(export(m, word)?.text)
}

/// Writes a mechanism, and lists the properties that the format cannot represent.
///
/// # Errors
/// Returns the errors of [`write()`].
///
/// # Examples
/// ```
/// let file = ozols::robots::formats::export(&ozols::built_in("four-bar")?, "urdf")?;
/// // URDF has no loops, and masses are placeholders.
/// assert!(!file.told.is_empty());
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn export(m: &Mechanism, word: &str) -> Result<FormattedFile, ExportError> {
    let format = writable_formats().find(|f| f.word == word);
    let write = format.and_then(|f| f.write);
    write.ok_or_else(|| ExportError::Unknown {
        word: word.to_owned(),
        known: writable_formats().map(|f| f.word).join(", "),
    })?(m)
}

/// Returns true if a file of this name is a robot description, by its ending.
///
/// # Examples
/// ```
/// use ozols::robots::is_description;
/// assert!(is_description("arm.URDF") && is_description("vice.FCStd"));
/// assert!(!is_description("four-bar.toml"));
/// ```
#[must_use]
pub fn is_description(name: &str) -> bool {
    std::path::Path::new(name).extension().is_some_and(|e| {
        let known = FORMATS.iter().flat_map(|f| f.endings);
        known.into_iter().any(|k| e.eq_ignore_ascii_case(k))
    })
}

/// Returns whether the bytes of a file begin as a robot description or a CAD assembly does: as XML, a FreeCAD document or an assembly
/// of OndselSolver.
///
/// # Examples
/// ```
/// use ozols::robots::begins_description;
/// assert!(begins_description(b"<robot name=\"arm\"/>"));
/// assert!(!begins_description(b"name = \"four-bar\""));
/// ```
#[must_use]
pub fn begins_description(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    Archive::find_archive("", bytes).is_some()
        || asmt::is_one(text)
        || text.trim_ascii_start().starts_with(b"<")
}

/// Returns the format of descriptions with a root element, and its reader.
pub(crate) fn of_root(element: &str) -> Option<(&'static Format, Describe)> {
    let read = |f: &'static Format| {
        f.read
            .filter(|(root, _)| *root == element)
            .map(|(_, d)| (f, d))
    };
    FORMATS.iter().find_map(read)
}

/// Lists the root elements that can be read.
pub(crate) fn list_roots() -> String {
    let known = FORMATS.iter().filter_map(|f| Some((f.read?.0, f.name)));
    let mut words = known.map(|(root, name)| format!("<{root}> ({name})"));
    let all = words.join(", ");
    let (first, last) = all.rsplit_once(", ").unwrap_or(("", &all));
    format!("{first} and {last}")
}

/// Formats that are not read, a line for each remedy: after a bar the name of each format and the endings of its files in lower case.
const FOREIGN: &str = include_str!("foreign.txt");

/// The first bytes of files, and their formats.
const BEGINNINGS: [(&[u8], &str); 14] = [
    (b"ISO-10303-21", "STEP"),
    (b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "Parasolid"),
    (b"ACIS BinaryFile", "ACIS"),
    (b"DBRep_DrawableShape", "BREP"),
    (b"glTF", "glTF"),
    (b"ply\n", "PLY"),
    (b"#VRML", "VRML"),
    (b"AC10", "DWG"),
    (b"3D Geometry File Format", "Rhino 3DM"),
    (b"V5_CFV2", "CATIA"),
    (OLE, "OLE document (SolidWorks, Inventor and others)"),
    (b"#usda", "USD"),
    (b"PXR-USDC", "USD"),
    (b"BLENDER", "Blender"),
];
const OLE: &[u8] = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1";

/// Rejects a file of a format that is not read, by its first bytes or by its ending, which no mechanism file has.
///
/// # Errors
/// Returns the name of the format and the remedy.
///
/// # Examples
/// ```
/// use ozols::robots::refuse_foreign;
/// assert!(refuse_foreign("hand.jinja", b"{{ x }}").is_err());
/// assert!(refuse_foreign("hand.urdf", b"<robot/>").is_ok());
/// ```
pub fn refuse_foreign(name: &str, bytes: &[u8]) -> Result<(), ImportError> {
    let path = std::path::Path::new(name);
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let ending = ending.to_lowercase();
    // The first line of IGES ends in its section and number.
    let line = bytes.split(|b| *b == b'\n').next().unwrap_or_default();
    let is_iges = line.len() >= 80 && &line[72..80] == b"S      1";
    let begins = BEGINNINGS.iter().find(|(b, _)| bytes.starts_with(b));
    let begins = begins.map(|b| b.1).or(is_iges.then_some("IGES"));
    let known = FOREIGN.lines().filter_map(|line| line.split_once(" | "));
    let known = known.flat_map(|(remedy, formats)| {
        let each = formats.split("; ").filter_map(|f| f.split_once(':'));
        each.map(move |(format, endings)| (format, endings, remedy))
    });
    let is_it = |(format, endings, _): &(&str, &str, &str)| match begins {
        Some(found) => *format == found,
        None => !ending.is_empty() && endings.split(' ').any(|e| e == ending),
    };
    let mut known = known.filter(is_it);
    known.next().map_or(Ok(()), |(format, _, remedy)| {
        let message = format!("this is a {format} file, which is not read; {remedy}");
        Err(syntax_problem(message).in_file(name, "", None))
    })
}

/// Returns the file of a mechanism, unless its tables are not those of the file that it was read from.
fn own_file(m: &Mechanism) -> Result<MechanismFile, ExportError> {
    write::own_file(m).ok_or(ExportError::Changed)
}

/// Writes links as nodes (the frame with a double outline, outputs filled) and joints as edges with their class.
fn write_dot(m: &Mechanism) -> String {
    let mut out = format!("graph {} {{\n", quote_dot(&m.name));
    for (l, link) in m.links_with_ids() {
        let shape = match link.role {
            Role::Frame => "box peripheries=2",
            Role::Output => "box style=filled fillcolor=lightgrey",
            Role::Object => "octagon",
            Role::Inner => "box",
        };
        let (l, label) = (l.index(), quote_dot(&link.id));
        let _ = writeln!(out, "    {l} [ label={label} shape={shape}]");
    }
    for j in &m.joints {
        let [a, b] = j.links.map(LinkId::index);
        let (class, kind) = (j.joint_type.class_numeral(), j.joint_type.name());
        let label = quote_dot(&format!("{}\n{class} {kind}", j.id));
        let drive = if j.drive { " penwidth=3" } else { "" };
        let dashed = j.states.as_ref().map_or("", |_| " style=dashed");
        let _ = writeln!(out, "    {a} -- {b} [ label={label}{drive}{dashed}]");
    }
    out + "}\n"
}

/// Quotes a string for DOT.
fn quote_dot(text: &str) -> String {
    let inner = text.replace('\\', "\\\\").replace('"', "\\\"");
    let inner = inner.replace('\n', "\\n");
    format!("\"{inner}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_root_elements_are_unique() {
        assert!(FORMATS.iter().map(|f| f.word).all_unique());
        assert!(
            FORMATS
                .iter()
                .filter_map(|f| f.read)
                .map(|r| r.0)
                .all_unique()
        );
        for f in &FORMATS {
            // Descriptions are recognised by their ending.
            assert_eq!(f.read.is_some(), !f.endings.is_empty(), "{}", f.word);
        }
    }

    #[test]
    fn root_elements_are_listed() {
        assert_eq!(
            list_roots(),
            "<robot> (URDF), <mujoco> (MJCF), <sdf> (SDF), <Document> (FreeCAD) and <Assembly> (OndselSolver)"
        );
    }
}
