//! Exports read back as the same mechanism.

use crate::cli::{out, ozols};
use ozols::builtin;
use ozols::export;
use ozols::import::text::mechanism_from_str;
use ozols::model::mechanism::{Mechanism, Mode};
use ozols::redundancy::analysis::{Elimination, Method, analyse};
use ozols::robot::{Options, import};

fn all() -> impl Iterator<Item = Mechanism> {
    builtin::names()
        .into_iter()
        .map(|n| mechanism_from_str(&format!("{n}.toml"), builtin::text(n).unwrap()).unwrap())
}

fn none(_: &str) -> std::io::Result<Vec<u8>> {
    Err(std::io::Error::other("there is no such file"))
}

// Everything but the spelling survives: a second export is the first, and both analyse alike.
#[test]
fn toml_and_json() {
    for m in all() {
        let toml = export::toml(&m).unwrap();
        let json = export::mechanism_file(&m).json().to_string();
        for (name, text) in [("x.toml", &toml), ("x.json", &json)] {
            let back = mechanism_from_str(name, text)
                .unwrap_or_else(|e| panic!("{}: {e}\n{text}", m.name));
            assert_eq!(export::toml(&back).unwrap(), toml, "{}", m.name);
            let names = |m: &Mechanism| {
                let all = m
                    .joints
                    .iter()
                    .flat_map(|j| j.options.iter().chain(&j.unloading));
                all.map(|o| (o.name.clone(), o.cost_milli))
                    .collect::<Vec<_>>()
            };
            assert_eq!(names(&back), names(&m), "{}", m.name);
            let states: Vec<usize> = (0..m.states.len()).collect();
            let figures = |m: &Mechanism| {
                let all = analyse(m, &states, Method::Modular).unwrap();
                all.iter()
                    .map(|s| {
                        (
                            s.state.clone(),
                            s.links,
                            s.freedoms,
                            s.mobility,
                            s.redundant,
                        )
                    })
                    .collect::<Vec<_>>()
            };
            assert_eq!(figures(&back), figures(&m), "{}", m.name);
        }
    }
}

#[test]
fn searches_alike() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("g.toml");
    out(&[
        "export",
        "gripper-10",
        "--to",
        "toml",
        "-o",
        file.to_str().unwrap(),
    ]);
    let count = |f: &str| out(&["search", f, "--top", "3", "--format", "json"]);
    assert_eq!(count(file.to_str().unwrap()), count("gripper-10"));
}

// SDF keeps loops: W and σ of the free state by singular values survive the way there and back.
#[test]
fn sdf_there_and_back() {
    let mut tried = 0;
    for m in all() {
        if matches!(m.mode, Mode::Planar { .. }) {
            continue;
        }
        let text = export::sdf(&m);
        let i = import("x.sdf", text.as_bytes(), &none, &Options::default())
            .unwrap_or_else(|e| panic!("{}: {e}\n{text}", m.name));
        let back = mechanism_from_str("x.toml", &i.toml).unwrap();
        // A joint mimics one other: couplings beyond a tree, which are redundant where the mechanism moves, are comments.
        let unsaid = text.matches("<!-- coupled, ").count();
        let figures = |m: &Mechanism, unsaid: usize| {
            let s = &analyse(m, &[0], Method::Numeric(Elimination::Svd, 1e-9)).unwrap()[0];
            (s.contours, s.mobility, s.redundant - unsaid)
        };
        assert_eq!(figures(&back, 0), figures(&m, unsaid), "{}\n{text}", m.name);
        tried += 1;
    }
    assert!(tried > 25);
}

// URDF keeps a spanning tree: one comment for each contour, W the freedoms of the tree.
#[test]
fn urdf_trees() {
    for m in all() {
        let s = &analyse(&m, &[0], Method::Modular).unwrap()[0];
        let text = match export::urdf(&m) {
            Ok(t) => t,
            Err(e) => {
                assert!(
                    e.to_string().contains("write SDF instead"),
                    "{}: {e}",
                    m.name
                );
                continue;
            }
        };
        assert_eq!(
            text.matches("<!-- closes a loop").count(),
            s.contours,
            "{}",
            m.name
        );
        match import("x.urdf", text.as_bytes(), &none, &Options::default()) {
            Ok(i) => {
                let back = mechanism_from_str("x.toml", &i.toml).unwrap();
                let t = &analyse(&back, &[0], Method::Numeric(Elimination::Svd, 1e-9)).unwrap()[0];
                assert_eq!((t.contours, t.redundant), (0, 0));
                assert!(t.mobility <= s.freedoms);
            }
            Err(e) => assert!(
                e.to_string().contains("nothing can move"),
                "{}: {e}",
                m.name
            ),
        }
    }
}

#[test]
fn graphs() {
    for m in all() {
        let dot = export::dot(&m);
        assert_eq!(dot.matches(" -- ").count(), m.joints.len(), "{dot}");
        let xml = export::graphml(&m);
        assert_eq!(xml.matches("<node ").count(), m.links.len());
        assert_eq!(xml.matches("<edge ").count(), m.joints.len());
    }
    let tricky = "name = \"a\\\"b<&>\"\n[[link]]\nid = \"<0>\"\nrole = \"frame\"\n[[link]]\nid = \"\\\"&--\\\\\"\nrole = \"output\"\n[[joint]]\nid = \"]]>-->\"\nlinks = [\"<0>\", \"\\\"&--\\\\\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\ndrive = true\n";
    let m = mechanism_from_str("t.toml", tricky).unwrap();
    assert!(export::dot(&m).starts_with("graph \"a\\\"b<&>\" {"));
    assert!(export::graphml(&m).contains("id=\"&lt;0&gt;\""));
    for (name, text) in [
        ("t.urdf", export::urdf(&m).unwrap()),
        ("t.sdf", export::sdf(&m)),
    ] {
        let i = import(name, text.as_bytes(), &none, &Options::default())
            .unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert!(mechanism_from_str("t.toml", &i.toml).is_ok(), "{text}");
    }
}

#[test]
fn the_command() {
    for to in ["toml", "json", "urdf", "sdf", "dot", "graphml"] {
        assert!(out(&["export", "four-bar", "--to", to]).len() > 200, "{to}");
    }
    let o = ozols(&["export", "nowhere", "--to", "dot"])
        .output()
        .unwrap();
    assert_eq!(o.status.code(), Some(2));
}

// Masses, gravity, forces, speed and stroke are written, too: the statics of the copy are those of the file.
#[test]
fn the_workload_survives() {
    let folder = tempfile::tempdir().unwrap();
    for to in ["toml", "json"] {
        let file = folder.path().join(format!("shears.{to}"));
        let file = file.to_str().unwrap();
        out(&["export", "parallel-shears", "--to", to, "-o", file]);
        let statics = |f: &str| out(&["statics", f, "--format", "json"]);
        assert_eq!(statics(file), statics("parallel-shears"));
    }
    let shears = all().find(|m| m.name == "parallel-shears").unwrap();
    let text = export::toml(&shears).unwrap();
    let back = mechanism_from_str("x.toml", &text).unwrap();
    assert_eq!(back.loads.stroke, shears.loads.stroke);
    assert_eq!(back.loads.drive_speeds, shears.loads.drive_speeds);
    for (a, b) in back.links.iter().zip(&shears.links) {
        let all = |l: &ozols::model::mechanism::Link| {
            l.mass.as_ref().map(|p| {
                (
                    p.mass,
                    p.centre.each_ref().map(ToString::to_string),
                    p.inertia,
                )
            })
        };
        assert_eq!(all(a), all(b));
    }
    let forces = |m: &Mechanism| format!("{:?}", m.loads.forces);
    assert_eq!(forces(&back), forces(&shears));
}
