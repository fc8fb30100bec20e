//! Robot descriptions (URDF, MJCF, SDF) and the loops beside them.

use super::{edits, runs, spoilt};
use ozols::file::text::mechanism_from_str;
use ozols::robots::{Options, import};
use proptest::prelude::*;
use proptest::sample::Index;

/// Name and text of a description, and of the file beside it.
type Input = (
    &'static str,
    &'static str,
    Option<(&'static str, &'static str)>,
);

const FILES: [Input; 5] = [
    ("a.xml", include_str!("../../data/robots/gripper.xml"), None),
    (
        "b.urdf",
        include_str!("../../data/robots/mimic_gripper.urdf"),
        None,
    ),
    (
        "c.urdf",
        include_str!("../../data/robots/leg.urdf"),
        Some(("s.yaml", include_str!("../../data/robots/leg.yaml"))),
    ),
    (
        "d.sdf",
        include_str!("../../data/robots/four_bar_loop.sdf"),
        None,
    ),
    (
        "e.sdf",
        include_str!("../../data/robots/four_bar_weld.sdf"),
        None,
    ),
];

pub(super) const WORDS: [&str; 26] = [
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

fn read(name: &str, bytes: &[u8], side: Option<(&str, &[u8])>, bits: u8) -> String {
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
            report
        }
        Err(e) => {
            assert!(!e.problems.is_empty());
            let _ = e.render(true);
            let said = e.problems.iter().map(|p| p.kind.to_string());
            said.collect::<Vec<_>>().join("\n")
        }
    }
}

/// The descriptions alone.
pub(super) fn seeds() -> Vec<Vec<u8>> {
    FILES.iter().map(|f| f.1.as_bytes().to_vec()).collect()
}

/// Imports a description, in the format that it begins as.
pub(super) fn look(bytes: &[u8]) -> String {
    let has = |tag: &[u8]| bytes.windows(tag.len()).any(|w| w == tag);
    let name = match (has(b"<mujoco"), has(b"<sdf")) {
        (true, _) => "x.xml",
        (_, true) => "x.sdf",
        _ => "x.urdf",
    };
    read(name, bytes, None, bytes.len() as u8)
}

proptest! {
    #![proptest_config(runs(512))]
    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read("x.urdf", &bytes, None, 0);
        read("c.urdf", FILES[2].1.as_bytes(), Some(("s.yaml", &bytes)), 2);
    }

    #[test]
    fn spoilt_descriptions(which in any::<Index>(), edits in edits(&WORDS), bits in 0u8..8) {
        let (name, text, side) = FILES[which.index(FILES.len())];
        read(name, &spoilt(text, &edits), side.map(|(n, t)| (n, t.as_bytes())), bits);
    }

    #[test]
    fn spoilt_loops(edits in edits(&WORDS), bits in 0u8..8) {
        let (name, text, side) = FILES[2];
        let (beside, loops) = side.unwrap();
        read(name, text.as_bytes(), Some((beside, &spoilt(loops, &edits))), bits);
    }
}
