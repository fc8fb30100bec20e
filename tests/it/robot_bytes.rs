//! No robot description makes the program panic.

use ozols::file::text::mechanism_from_str;
use ozols::robots::{Options, import};
use proptest::prelude::*;

/// Name and text of a description, and of the file beside it.
type Input = (
    &'static str,
    &'static str,
    Option<(&'static str, &'static str)>,
);

const FILES: [Input; 6] = [
    (
        "a.xml",
        include_str!("../data/robots/robotiq_2f85_v4/2f85.nomesh.xml"),
        None,
    ),
    (
        "b.xml",
        include_str!("../data/robots/xarm7_hand/hand.nomesh.xml"),
        None,
    ),
    (
        "c.urdf",
        include_str!("../data/robots/epr_5bar_linkage/robot.urdf"),
        Some((
            "s.yaml",
            include_str!("../data/robots/epr_5bar_linkage/robot.yaml"),
        )),
    ),
    (
        "d.urdf",
        include_str!("../data/robots/robotiq_ros_urdf/robotiq_arg2f_85_model.expanded.urdf"),
        None,
    ),
    (
        "e.sdf",
        include_str!("../data/robots/drake_four_bar/four_bar_loop.sdf"),
        None,
    ),
    (
        "f.sdf",
        include_str!("../data/robots/drake_four_bar/four_bar_weld.sdf"),
        None,
    ),
];

const NASTY: [&str; 26] = [
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

fn read(name: &str, bytes: &[u8], side: Option<(&str, &[u8])>, bits: u8) {
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
            assert!(!i.report.text(name).is_empty());
        }
        Err(e) => {
            assert!(!e.problems.is_empty());
            let _ = (e.render(true), e.to_string());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]
    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read("x.urdf", &bytes, None, 0);
        read("c.urdf", FILES[2].1.as_bytes(), Some(("s.yaml", &bytes)), 2);
    }

    #[test]
    fn spoilt_files(
        which in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        length in 0usize..60,
        put in prop_oneof![".{0,8}", prop::sample::select(&NASTY[..]).prop_map(str::to_owned)],
        bits in 0u8..8,
    ) {
        let (name, text, side) = FILES[which.index(FILES.len())];
        let mut bytes = text.as_bytes().to_vec();
        let start = at.index(bytes.len());
        bytes.splice(start..(start + length).min(text.len()), put.bytes());
        read(name, &bytes, side.map(|(n, t)| (n, t.as_bytes())), bits);
    }

    #[test]
    fn spoilt_values(
        which in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        put in prop::sample::select(&NASTY[..]),
        bits in 0u8..8,
    ) {
        let (name, text, side) = FILES[which.index(FILES.len())];
        // From one quote to the next: an attribute's value, or what stands between two.
        let quotes: Vec<usize> = text.match_indices('"').map(|(i, _)| i).collect();
        let n = at.index(quotes.len() - 1);
        let spoilt = format!("{}{put}{}", &text[..=quotes[n]], &text[quotes[n + 1]..]);
        read(name, spoilt.as_bytes(), side.map(|(n, t)| (n, t.as_bytes())), bits);
    }

    // Pieces of one file moved to another place: elements out of order, doubled, or within others.
    #[test]
    fn moved_pieces(
        which in any::<prop::sample::Index>(),
        from in any::<prop::sample::Index>(),
        to in any::<prop::sample::Index>(),
        length in 1usize..6,
        bits in 0u8..8,
    ) {
        let (name, text, side) = FILES[which.index(FILES.len())];
        let tags: Vec<usize> = text.match_indices('<').map(|(i, _)| i).collect();
        let first = from.index(tags.len());
        let end = tags.get(first + length).copied().unwrap_or(text.len());
        let place = tags[to.index(tags.len())];
        let moved = format!("{}{}{}", &text[..place], &text[tags[first]..end], &text[place..]);
        read(name, moved.as_bytes(), side.map(|(n, t)| (n, t.as_bytes())), bits);
    }
}
