//! The mechanism in space on the report page: its first view is the drawing it lies on, and its poses keep joints together.

use super::reading::moved;
use crate::common::*;
type Vector = [f64; 3];

fn vector(v: &Value) -> Vector {
    [0, 1, 2].map(|i| v[i].real())
}

/// A point carried by six numbers, a rotation vector and where the origin goes (Rodrigues), or by none.
fn carried(by: &Value, p: Vector) -> Vector {
    let n: Vec<f64> = by.list().iter().map(|x| x.real()).collect();
    if n.is_empty() {
        return p;
    }
    let turn = [n[0], n[1], n[2]];
    let turned = RigidMotion::from_turn(turn, length(turn)).map_direction(p);
    add(turned, [n[3], n[4], n[5]])
}

/// A page and what it knows of the mechanism in space in its first state.
fn page(name: &str) -> (String, Value) {
    let page = run_quiet(&["report", name, "--top", "1"]);
    let (_, data) = page.split_once("id=\"data\">").unwrap();
    let data: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    let scene = data["scenes"][0].clone();
    (page, scene)
}

#[test]
fn the_first_view_is_the_drawing() {
    for name in ["bennett", "gripper-10", "rssr", "scissor-lift", "3-rps"] {
        let (page, scene) = page(name);
        let (before, _) = page.split_once("data-scene").unwrap();
        let figure = &page[before.rfind("<svg").unwrap()..];
        let figure = &figure[..figure.find("</svg>").unwrap() + "</svg>".len()];
        let figure = roxmltree::Document::parse(figure).unwrap();
        let joints = figure
            .descendants()
            .filter(|n| n.has_attribute("data-joint"));
        let mut drawn: Vec<[f64; 2]> = joints.map(moved).collect();
        let [right, up] = [0, 1].map(|i| vector(&scene["view"][i]));
        let first = &scene["moves"][0];
        let pose = &first["poses"][first["start"].whole() as usize];
        let joints = scene["joints"].list().iter();
        // the marks of points are no joints
        let joints = joints
            .filter(|j| !j["turned"].as_bool().unwrap())
            .rev()
            .take(drawn.len());
        drawn.reverse();
        assert!(drawn.len() > 3, "{name}");
        for (joint, at) in joints.zip(&drawn) {
            let link = joint["links"][0].whole() as usize;
            let p = carried(&pose[link], vector(&joint["at"]));
            let on = [dot(right, p), -dot(up, p)];
            for i in 0..2 {
                let off = on[i] + scene["origin"][i].real() - at[i];
                assert!(off.abs() < 0.05, "{name}: {off}");
            }
        }
    }
}

#[test]
fn hinges_hold_together_in_every_pose() {
    for name in ["bennett", "jansen-leg", "peaucellier", "rssr"] {
        let (_, scene) = page(name);
        let (mut held, mut far) = (0, 0.0f64);
        for motion in scene["moves"].list() {
            for pose in motion["poses"].list() {
                for joint in scene["joints"].list() {
                    let at = vector(&joint["at"]);
                    let [a, b] = [0, 1].map(|i| {
                        let link = joint["links"][i].whole() as usize;
                        carried(&pose[link], at)
                    });
                    held += 1;
                    far = far.max((0..3).map(|i| (a[i] - at[i]).abs()).fold(0.0, f64::max));
                    let apart = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
                    assert!(apart < 0.05, "{name}: {apart} pixels");
                }
            }
        }
        assert!(held > 200 && far > 20.0, "{name}: {held} {far}");
    }
}
