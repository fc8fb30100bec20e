//! Robot descriptions (URDF, MJCF, SDF), the loops beside them, and CAD assemblies.

use super::mechanism_files::told;
use crate::common::*;
use ozols::redundancy::release::Release;
use ozols::robots::{Imported, Options, apply_releases, import};
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// Name and text of a description, and of the file beside it.
pub(crate) type Input = (
    &'static str,
    &'static str,
    Option<(&'static str, &'static str)>,
);

pub(crate) const FILES: [Input; 5] = [
    (
        "a.xml",
        include_str!("../../../data/robots/gripper.xml"),
        None,
    ),
    (
        "b.urdf",
        include_str!("../../../data/robots/mimic_gripper.urdf"),
        None,
    ),
    (
        "c.urdf",
        include_str!("../../../data/robots/leg.urdf"),
        Some(("s.yaml", include_str!("../../../data/robots/leg.yaml"))),
    ),
    (
        "d.sdf",
        include_str!("../../../data/robots/four_bar_loop.sdf"),
        None,
    ),
    (
        "e.sdf",
        include_str!("../../../data/robots/four_bar_weld.sdf"),
        None,
    ),
];

pub(crate) const WORDS: [&str; 26] = [
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
    "inf",
    "-0.0",
    "0 0 0",
    "\"",
    "'",
    "<",
    ">",
    "/>",
    "</",
    "<!--",
    "]]>",
    "<![CDATA[",
    "&amp;",
    "&x;",
    "&#0;",
    "<!DOCTYPE a [<!ENTITY b 'c'>]>",
    "<?x",
    "\u{0}",
    "\u{feff}",
    "world",
    "é",
    "",
];

/// Imports a description, with what is beside it. Returns what was said.
pub(crate) fn read(name: &str, bytes: &[u8], side: Option<(&str, &[u8])>, bits: u8) -> String {
    let options = Options {
        loops: side.map(|(n, b)| (n.to_owned(), b.to_vec())),
        floating: bits & 1 != 0,
        open: bits & 2 != 0,
        assemble: bits & 4 != 0,
        ..Options::default()
    };
    let none = |_: &str| Err(std::io::Error::other("no such file"));
    match import(name, bytes, &none, &options) {
        Ok(i) => {
            mechanism_from_str("x.toml", &i.toml().unwrap()).unwrap();
            let report = i.report.text(name);
            assert!(!report.is_empty());
            report + &let_go(&i, bits)
        }
        Err(e) => told(&e),
    }
}

/// The description with a freedom added to a joint. Returns what was said.
fn let_go(i: &Imported, bits: u8) -> String {
    let axis = usize::from(bits % 3);
    let mut direction = [0.0; 3];
    direction[axis] = 1.0;
    let release = Release::Freedom {
        joint: JointId::new(usize::from(bits) % i.mechanism.joints.len()),
        slides: bits & 8 != 0,
        direction,
    };
    match apply_releases(i, &[(release, "so".to_owned())]) {
        Ok(_) => "let go".to_owned(),
        Err(e) => told(&e),
    }
}

/// The descriptions of a format, by the ending of their names.
fn of(ending: &str) -> Vec<Vec<u8>> {
    let some = FILES.iter().filter(|f| f.0.ends_with(ending));
    some.map(|f| f.1.as_bytes().to_vec()).collect()
}

pub(crate) fn mjcf() -> Vec<Vec<u8>> {
    of(".xml")
}

pub(crate) fn sdf() -> Vec<Vec<u8>> {
    of(".sdf")
}

pub(crate) fn urdf() -> Vec<Vec<u8>> {
    of(".urdf")
}

/// Imports a description; its length says what is asked besides.
pub(crate) fn look(name: &str, bytes: &[u8]) -> String {
    read(name, bytes, None, bytes.len() as u8)
}

/// The loops beside a description, in each of the formats.
pub(crate) fn loops() -> Vec<Vec<u8>> {
    let toml = "[[loop]]\na = \"l_shin\"\nb = \"r_shin\"\ntype = \"revolute\"\npoint_a = [0, 0, 0.1]\naxis_a = [0, 1, 0]\n";
    let json = r#"[{"ball_constraint_body_A": "a", "ball_constraint_p_AP": [0, 0, 1], "ball_constraint_body_B": "b", "ball_constraint_p_BQ": [0, 0, 0]}]"#;
    let yaml = FILES[2].2.map_or("", |side| side.1);
    [toml, json, yaml].map(|t| t.as_bytes().to_vec()).to_vec()
}

/// Adds loops to a description; their first character says in which format they are.
pub(crate) fn look_loops(bytes: &[u8]) -> String {
    let start = bytes.trim_ascii_start();
    let side = match start.first() {
        Some(b'{') => "s.json",
        Some(b'[') if start.starts_with(b"[[") => "s.toml",
        Some(b'[') => "s.json",
        _ => "s.yaml",
    };
    let (name, text, _) = FILES[2];
    read(name, text.as_bytes(), Some((side, bytes)), 2)
}

/// Between two members of an archive.
const NEXT: &[u8] = b"\n====";

/// Imports a FreeCAD document: an archive, or the text of its document, behind which there may be the name and text of shapes.
pub(crate) fn look_fcstd(bytes: &[u8]) -> String {
    if bytes.starts_with(b"PK") {
        return look("x.FCStd", bytes);
    }
    let mut out = ZipWriter::new(Cursor::new(Vec::new()));
    let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    let mut rest = [b"Document.xml\n".as_slice(), bytes].concat();
    loop {
        let end = rest.windows(NEXT.len()).position(|w| w == NEXT);
        let member = &rest[..end.unwrap_or(rest.len())];
        let cut = member.iter().position(|b| *b == b'\n').unwrap_or(0);
        let name = String::from_utf8_lossy(&member[..cut]).into_owned();
        // Names that no archive takes are left out.
        if out.start_file(name, stored).is_ok() {
            out.write_all(&member[(cut + 1).min(member.len())..])
                .unwrap();
        }
        match end {
            Some(end) => rest = rest[end + NEXT.len()..].to_vec(),
            None => break,
        }
    }
    let archive = out.finish().unwrap().into_inner();
    read("x.FCStd", &archive, None, bytes.len() as u8)
}

/// Those of the corpus alone.
pub(crate) fn none() -> Vec<Vec<u8>> {
    Vec::new()
}
