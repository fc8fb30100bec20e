//! Mechanisms of known mobility: those built in, and those of ../shared/data/mobility.json.

use ozols::builtin;
use ozols::file::text::mechanism_from_str;
use ozols::model::mechanism::{Mechanism, StateId};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// A state of a mechanism with its figures.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) mechanism: Mechanism,
    pub(crate) state: StateId,
    /// W in the pose of the file.
    pub(crate) mobility: i64,
    /// W of the motion that is there.
    pub(crate) finite: i64,
}

pub(crate) fn cases() -> Vec<Case> {
    let mut out = Vec::new();
    for name in builtin::names() {
        let text = builtin::text(name).unwrap();
        let mechanism = mechanism_from_str("x.toml", text).unwrap();
        for e in &mechanism.expected {
            out.push(Case {
                name: format!("{name}, {}", e.state),
                state: mechanism.state(&e.state).unwrap(),
                mechanism: mechanism.clone(),
                mobility: e.mobility.unwrap(),
                finite: e.finite_mobility.unwrap(),
            });
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/mobility.json");
    // Found where the project's own files lie: beside it, or one folder further up.
    let further = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/mobility.json");
    let text = fs::read_to_string(path).or_else(|_| fs::read_to_string(further));
    let known: Value = serde_json::from_str(&text.unwrap()).unwrap();
    out.extend(known.as_array().unwrap().iter().map(of_json));
    out
}

/// A mechanism of mobility.json.
fn of_json(v: &Value) -> Case {
    let exact = |j: &Value, key: &str| {
        let exact = &j[format!("{key}_exact")];
        if exact.is_null() { &j[key] } else { exact }.clone()
    };
    let links: Vec<Value> = v["bodies"]
        .as_array()
        .unwrap()
        .iter()
        .enumerate()
        .map(|(i, b)| match i {
            0 => json!({"id": b, "role": "frame"}),
            1 => json!({"id": b, "role": "output"}),
            _ => json!({"id": b}),
        })
        .collect();
    let joints: Vec<Value> = v["joints"]
        .as_array()
        .unwrap()
        .iter()
        .enumerate()
        .map(|(i, j)| {
            let kind = match j["type"].as_str().unwrap() {
                "R" => "revolute",
                "P" => "prismatic",
                "H" => "helical",
                "C" => "cylindrical",
                "U" => "universal",
                "S" => "spherical",
                "SC" => "sphere-in-cylinder",
                other => panic!("{other}"),
            };
            let mut out = json!({
                "id": format!("{i}"), "links": [j["a"], j["b"]], "type": kind, "point": exact(j, "point"),
            });
            if !j["axis"].is_null() {
                out["axis"] = exact(j, "axis");
            }
            if !j["axis2"].is_null() {
                out["reference"] = exact(j, "axis2");
            }
            if !j["pitch"].is_null() {
                out["pitch"] = exact(j, "pitch");
            }
            out
        })
        .collect();
    let name = v["name"].as_str().unwrap().to_owned();
    let file = json!({"name": name, "link": links, "joint": joints});
    let mechanism = mechanism_from_str("x.json", &file.to_string()).unwrap();
    Case {
        name,
        mechanism,
        state: StateId::FREE,
        mobility: v["expected"]["W_inst_ref"].as_i64().unwrap(),
        finite: v["expected"]["W"].as_i64().unwrap(),
    }
}
