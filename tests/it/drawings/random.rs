//! Any linkage is drawn without collisions.

use super::reading::collisions;
use crate::common::*;
use ozols::draw::{Subject, scheme};
use std::fmt::Write as _;

const TYPES: &str = "
    revolute prismatic helical cylindrical universal slotted spherical planar
    cylindrical-universal sphere-in-cylinder cylinder-on-plane sphere-on-plane fixed";

/// A connected mechanism: each link after the first hangs on one before it, and some joints close contours.
fn any_mechanism() -> impl Strategy<Value = Mechanism> {
    let number = prop_oneof![Just(0.0), -2.0..2.0f64, -1e6..1e6f64];
    let joint = (
        any::<prop::sample::Index>(),
        select(split_words(TYPES)),
        [number.clone(), number.clone(), number],
        [-1i32..=1, -1..=1, 1..=2],
        any::<bool>(),
    );
    let id = prop_oneof![
        "[a-z0-9]{1,3}",
        "[<>&\"' \u{3c3}\u{4e00}]{1,4}",
        "[a-z]{24}"
    ];
    let links = prop::collection::vec((id, joint.clone()), 1..9);
    let more = prop::collection::vec((any::<prop::sample::Index>(), joint), 0..7);
    (links, more).prop_map(|(links, more)| {
        let mut text = String::from("name = \"<&>\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n");
        let names: Vec<String> = std::iter::once("0".to_owned())
            .chain(links.iter().enumerate().map(|(i, (id, _))| format!("{id}{i}")))
            .collect();
        for (i, name) in names[1..].iter().enumerate() {
            writeln!(text, "[[link]]\nid = {name:?}").unwrap();
            if i == 0 {
                text += "role = \"output\"\n";
            }
        }
        let tree = links.iter().enumerate().map(|(i, (_, j))| (i + 1, j.0.index(i + 1), j));
        let closing = more.iter().map(|(a, j)| (a.index(names.len()), j.0.index(names.len()), j));
        for (n, (a, b, (_, t, point, axis, drive))) in tree.chain(closing).enumerate() {
            if a == b {
                continue;
            }
            writeln!(
                text,
                "[[joint]]\nid = {:?}\nlinks = [{:?}, {:?}]\ntype = {:?}\npoint = {point:?}\naxis = {axis:?}",
                format!("{}-{}-{n}", names[a], names[b]),
                names[a],
                names[b],
                t
            )
            .unwrap();
            if *t == "helical" {
                text += "pitch = 1\n";
            }
            if *drive && *t != "fixed" {
                text += "drive = true\n";
            }
        }
        read(&text)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn any_graph_is_drawn(m in any_mechanism()) {
        let found = analyse_states(&m, &[StateId::FREE], Method::Modular).ok();
        for analysis in [None, found.as_ref().and_then(|f| f.first())] {
            let subject = Subject { mechanism: &m, state: StateId::FREE, analysis, marks: None };
            for d in [scheme(&subject), kinematic(&subject)] {
                prop_assert!(!d.svg.contains("NaN") && !d.svg.contains("inf "));
                let wrong = collisions(&d);
                prop_assert!(wrong.is_empty(), "{:?}", wrong);
            }
        }
    }
}
