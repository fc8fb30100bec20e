//! Small files beside mechanisms, and words: costs, changes, motions, specifications, tables, chains.

use super::mechanism_files::told;
use crate::common::*;
use ozols::catalog::spec::{Spec, parse_range};
use ozols::chains::graph6;
use ozols::file::edit::{Edit, apply_edits};
use ozols::file::read::search::costs_from_str;
use ozols::file::read::workload::trajectory::read_trajectory;
use ozols::shard::Shard;
use std::sync::LazyLock;

fn texts(some: &[&str]) -> Vec<Vec<u8>> {
    some.iter().map(|t| t.as_bytes().to_vec()).collect()
}

/// Costs of a mechanism's redesigns. Returns what was said.
pub(crate) fn costs(bytes: &[u8]) -> String {
    static GRIPPER: LazyLock<ozols::Mechanism> =
        LazyLock::new(|| ozols::built_in("gripper-10").unwrap());
    match costs_from_str("c.toml", &String::from_utf8_lossy(bytes), &GRIPPER) {
        Ok(spec) => {
            let all = spec.by_type_milli.iter().map(|(_, cost)| *cost);
            assert!(all.clone().all(|c| (0..=1_000_000_000).contains(&c)));
            format!("{} costs", all.count())
        }
        Err(e) => told(&e),
    }
}

pub(crate) fn costs_seeds() -> Vec<Vec<u8>> {
    texts(&["spherical = 2\nchange = 1\nlink = 0.5\nharmful = 3\n\"cylindrical\" = 1e6"])
}

/// Changes to a file, as the studio sends them: what comes of them is TOML again. Returns what was said.
pub(crate) fn edits(bytes: &[u8]) -> String {
    let edits: Vec<Edit> = match serde_json::from_slice(bytes) {
        Ok(edits) => edits,
        Err(e) => return e.to_string(),
    };
    let text = builtin::text("gripper-10").unwrap();
    match apply_edits(text, &edits) {
        Ok(after) => {
            let other = edits.iter().any(|e| matches!(e, Edit::Text { .. }));
            if let Err(e) = after.parse::<toml::Table>() {
                assert!(other, "{e} in\n{after}");
            }
            match mechanism_from_str("x.toml", &after) {
                Ok(_) => "a mechanism".to_owned(),
                Err(e) => told(&e),
            }
        }
        Err(e) => e.to_string(),
    }
}

pub(crate) fn edits_seeds() -> Vec<Vec<u8>> {
    texts(&[
        r#"[{"do": "set", "what": "joint", "id": "1-2", "key": "type", "value": "spherical"}]"#,
        r#"[{"do": "put", "path": ["search", "options"], "value": ["revolute", {"type": "universal"}]}]"#,
        r#"[{"do": "add", "what": "link", "entry": {"id": "x"}}, {"do": "rename", "what": "link", "id": "1", "to": "y"}]"#,
        r#"[{"do": "remove", "items": [["link", "2"], ["joint", "0-1"]]}]"#,
        r#"[{"do": "text", "text": "name = \"x\""}, {"do": "add", "what": "point", "entry": {"id": "p", "link": "1", "point": [0, 1, "sqrt(2)"]}}]"#,
    ])
}

/// A motion as CSV: all that is read of it is finite. Returns what was said.
pub(crate) fn motion(bytes: &[u8]) -> String {
    match read_trajectory("m.csv", bytes, 0.001) {
        Ok(steps) => {
            let finite = |v: &[f64; 3]| v.iter().all(|x| x.is_finite());
            assert!(steps.iter().all(|s| finite(&s.acceleration)));
            assert!(steps.iter().flat_map(|s| &s.gravity).all(finite));
            assert!(!steps.is_empty());
            "steps".to_owned()
        }
        Err(e) => e.to_string(),
    }
}

pub(crate) fn motion_seeds() -> Vec<Vec<u8>> {
    texts(&[
        "ax,ay,az\n0,1,-9.81\n",
        "# a comment\ntime, ax, ay, az, gx, gy, gz, diameter\n0, 1, 2, 3, 0, 0, -9.81, 40\n0.1, \"1e3\", -2, 3, 0, 0, -9.81, 41\n",
    ])
}

/// What a catalogue is to hold: written in one form, which reads as itself. Returns what was said.
pub(crate) fn spec(bytes: &[u8]) -> String {
    let spec: Spec = match toml::from_str(&String::from_utf8_lossy(bytes)) {
        Ok(spec) => spec,
        Err(e) => return e.message().to_owned(),
    };
    if let Err(e) = spec.check_all() {
        return e.to_string();
    }
    let written = spec.to_canonical();
    let again: Spec = toml::from_str(&written).unwrap();
    assert_eq!(again.to_canonical(), written);
    assert_eq!(again.check_all(), Ok(()));
    assert!(!again.hinged_forms().is_empty());
    assert_eq!(again.layout_limits(), spec.layout_limits());
    "a specification".to_owned()
}

pub(crate) fn spec_seeds() -> Vec<Vec<u8>> {
    let all = Spec {
        links: "4..10".to_owned(),
        jaws: 3,
        unloading: vec!["prismatic".to_owned()],
        ..Spec::default()
    };
    let mut out = texts(&["links = \"6\"\njaws = 2\n", ""]);
    out.extend([Spec::default(), all].map(|s| s.to_canonical().into_bytes()));
    out
}

/// Words of the command line that are taken apart, and chains. Returns what was said.
pub(crate) fn words(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let shard = match text.parse::<Shard>() {
        Ok(part) => {
            assert_eq!(part.to_string().parse(), Ok(part));
            "a part".to_owned()
        }
        Err(e) => e.to_string(),
    };
    let numbers = match parse_range(&text) {
        Ok(_) => "a range".to_owned(),
        Err(part) => format!("{part:?}"),
    };
    let chain = match graph6::read_graph(&text) {
        Ok(chain) => {
            assert_eq!(
                graph6::read_graph(&graph6::write_graph(&chain)).as_ref(),
                Ok(&chain)
            );
            let code = graph6::write_graph(&chain.canonical_form().0);
            assert_eq!(
                graph6::write_graph(&graph6::read_graph(&code).unwrap().canonical_form().0),
                code
            );
            "a chain".to_owned()
        }
        Err(e) => e.to_string(),
    };
    [shard, numbers, chain].join("\n")
}

pub(crate) fn words_seeds() -> Vec<Vec<u8>> {
    texts(&["1/7", "4..8", "4..=8", "E?lw", "Ctilde", "E?Bw", "CF", "Bw"])
}
