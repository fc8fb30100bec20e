//! The formats of files: which are read, which are written, and by what.

use crate::file::write::{self, mechanism_file};
use crate::model::mechanism::Mechanism;
use crate::robots::cad::archive::Archive;
use crate::robots::description::Robot;
use crate::robots::problem::{ExportError, Read};
use crate::robots::warning::{Options, Reader};
use crate::robots::xml::Document;
use crate::robots::{asmt, fcstd, graph, mjcf, sdf, urdf};

/// A format of files.
#[derive(Debug)]
pub struct Format {
    /// The word on the command line.
    pub word: &'static str,
    /// The usual name.
    pub name: &'static str,
    /// The content of the format.
    pub about: &'static str,
    /// Endings of files that are robot descriptions of this format.
    endings: &'static [&'static str],
    read: Option<(&'static str, Describe)>,
    write: Option<FormatWriter>,
}

/// Reads the robot below the root element of a document; the files it includes are given by the reader.
pub(crate) type Describe = fn(&mut Document, usize, Reader<'_>, &Options) -> Read<Robot>;

/// How a format is written.
#[derive(Debug, Clone, Copy)]
enum FormatWriter {
    /// From a mechanism alone.
    Mechanism(fn(&Mechanism) -> Result<FormattedFile, ExportError>),
    /// Into the owner's document alone, joints changed: shapes and references are there and in no mechanism.
    Own,
}

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

/// All formats: with the root element of what is read, and the writer of what is written.
static FORMATS: [Format; 9] = [
    Format {
        word: "toml",
        name: "TOML",
        about: "The mechanism file, with the options of every joint",
        endings: &[],
        read: None,
        write: Some(FormatWriter::Mechanism(|m| {
            Ok(write::toml(&mechanism_file(m), &[])?.into())
        })),
    },
    Format {
        word: "json",
        name: "JSON",
        about: "The same as JSON",
        endings: &[],
        read: None,
        write: Some(FormatWriter::Mechanism(|m| {
            Ok(format!("{:#}\n", mechanism_file(m).json()).into())
        })),
    },
    Format {
        word: "urdf",
        name: "URDF",
        about: "A spanning tree, loops as <loop_joint>",
        endings: &["urdf", "xacro", "xml"],
        read: Some(("robot", urdf::read)),
        write: Some(FormatWriter::Mechanism(urdf::write::urdf)),
    },
    Format {
        word: "mjcf",
        name: "MJCF",
        about: "Bodies; loops as connect and weld",
        endings: &["mjcf", "xml"],
        read: Some(("mujoco", mjcf::read)),
        write: Some(FormatWriter::Mechanism(mjcf::write::mjcf)),
    },
    Format {
        word: "sdf",
        name: "SDF",
        about: "Loops closed by joints",
        endings: &["sdf", "world", "xml"],
        read: Some(("sdf", sdf::read)),
        write: Some(FormatWriter::Mechanism(|m| Ok(sdf::write::sdf(m)))),
    },
    Format {
        word: "fcstd",
        name: "FreeCAD",
        about: "FILE, a FreeCAD document, with joints of other types",
        endings: &["fcstd"],
        read: Some(("Document", fcstd::read)),
        write: Some(FormatWriter::Own),
    },
    Format {
        word: "asmt",
        name: "OndselSolver",
        about: "FILE, an assembly of FreeCAD's solver, with joints of other types",
        endings: &["asmt"],
        read: Some(("Assembly", asmt::read)),
        write: Some(FormatWriter::Own),
    },
    Format {
        word: "dot",
        name: "DOT",
        about: "Graphviz",
        endings: &[],
        read: None,
        write: Some(FormatWriter::Mechanism(|m| Ok(graph::dot(m).into()))),
    },
    Format {
        word: "graphml",
        name: "GraphML",
        about: "GraphML, for graph programs",
        endings: &[],
        read: None,
        write: Some(FormatWriter::Mechanism(|m| Ok(graph::graphml(m).into()))),
    },
];

/// Returns true if a format can only be written from files read in it, with joints changed.
#[must_use]
pub fn is_own(word: &str) -> bool {
    written().any(|f| f.word == word && matches!(f.write, Some(FormatWriter::Own)))
}

/// Returns the formats in which a mechanism can be written.
pub fn written() -> impl Iterator<Item = &'static Format> {
    FORMATS.iter().filter(|f| f.write.is_some())
}

/// Writes a mechanism in the format of the given name, one of those of [`written`].
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

/// Writes a mechanism and lists what is lost.
///
/// # Errors
/// Returns the errors of [`write()`].
pub fn export(m: &Mechanism, word: &str) -> Result<FormattedFile, ExportError> {
    let format = written().find(|f| f.word == word);
    match format.and_then(|f| Some((f.name, f.write?))) {
        Some((_, FormatWriter::Mechanism(write))) => write(m),
        Some((format, FormatWriter::Own)) => Err(ExportError::Own { format }),
        None => Err(ExportError::Unknown {
            word: word.to_owned(),
            known: written().map(|f| f.word).collect::<Vec<_>>().join(", "),
        }),
    }
}

/// Returns true if a file of this name is a robot description, by its ending.
#[must_use]
pub fn is_description(name: &str) -> bool {
    std::path::Path::new(name).extension().is_some_and(|e| {
        let known = FORMATS.iter().flat_map(|f| f.endings);
        known.into_iter().any(|k| e.eq_ignore_ascii_case(k))
    })
}

/// Returns whether the bytes of a file begin as a robot description or a CAD assembly does: as XML, a FreeCAD document or an assembly
/// of OndselSolver.
#[must_use]
pub fn begins_description(bytes: &[u8]) -> bool {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    Archive::of("", bytes).is_some()
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
pub(crate) fn roots() -> String {
    let known = FORMATS.iter().filter_map(|f| Some((f.read?.0, f.name)));
    let words: Vec<String> = known
        .map(|(root, name)| format!("<{root}> ({name})"))
        .collect();
    let (last, first) = words
        .split_last()
        .map_or(("", &[][..]), |(l, f)| (l.as_str(), f));
    format!("{} and {last}", first.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use itertools::Itertools;

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
            assert!(f.read.is_some() || f.write.is_some(), "{}", f.word);
            // Descriptions are told by their ending.
            assert_eq!(f.read.is_some(), !f.endings.is_empty(), "{}", f.word);
        }
    }

    #[test]
    fn root_elements_are_listed() {
        assert_eq!(
            roots(),
            "<robot> (URDF), <mujoco> (MJCF), <sdf> (SDF), <Document> (FreeCAD) and <Assembly> (OndselSolver)"
        );
    }
}
