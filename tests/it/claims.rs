//! What publications say of the mechanisms they show, against what is so.

use crate::common::{built_in, json, near, out};
use ozols::drive::torsion::{Bar, CamSpring};
use serde_json::{Value, json as value};
use std::collections::BTreeSet;

fn claims(args: &[&str]) -> (Vec<Value>, String) {
    let found = json(&[args, &["--format", "json"]].concat());
    (found["claims"].as_array().unwrap().clone(), out(args))
}

/// `[Pogrebnyak 2018]`: the rods hang between slider and rockers, and rockers turn on the frame.
#[test]
fn rods_and_rockers_are_told_apart() {
    let (claims, text) = claims(&["analyze", "gripper-10"]);
    assert_eq!(claims[0]["holds"], false);
    assert_eq!(claims[0]["right"], "rods 2 and 6, rockers 3 and 7");
    assert!(
        text.contains("right: rods 2 and 6, rockers 3 and 7"),
        "{text}"
    );
    let m = built_in("gripper-10");
    for (link, on_frame) in [("2", false), ("6", false), ("3", true), ("7", true)] {
        let l = m.links.iter().position(|x| x.id == link).unwrap();
        let joined = |j: &&ozols::model::mechanism::Joint| {
            let at = j.links.map(ozols::model::id::LinkId::index);
            at.contains(&l) && at.contains(&m.frame().index())
        };
        assert_eq!(m.joints.iter().any(|j| joined(&j)), on_frame, "{link}");
    }
}

/// `[Pogrebnyak 2018]`: the two constraints that the unloading joint leaves are forces along x and z, so the plane is z0x.
#[test]
fn the_plane_of_the_constraints_left_is_that_of_their_forces() {
    let (claims, text) = claims(&["analyze", "gripper-10"]);
    assert_eq!(claims[1]["holds"], false);
    assert_eq!(claims[1]["right"], "in the plane z0x");
    assert!(text.contains("right: in the plane z0x"), "{text}");
    let found = json(&[
        "analyze",
        "gripper-10-unloaded",
        "--state",
        "clamped",
        "--format",
        "json",
    ]);
    let stresses = found["states"][0]["self_stresses"].as_array().unwrap();
    let mut left = BTreeSet::new();
    for stress in stresses.iter().filter(|s| s["external"] == true) {
        let joints = stress["joints"].as_array().unwrap();
        let at_pad = joints.iter().find(|j| j["joint"] == "a-10").unwrap();
        assert_eq!(at_pad["moments"], value!([]));
        for axis in at_pad["forces"].as_array().unwrap() {
            left.insert(axis.as_str().unwrap().to_owned());
        }
    }
    assert_eq!(left.into_iter().collect::<Vec<_>>(), ["x", "z"]);
}

/// `[Klyuchkovskyi 1999]` (7) and (13) as they are printed.
#[test]
fn misprints_of_the_drive_are_told() {
    let (claims, text) = claims(&["drive", "torsion-module"]);
    assert_eq!(claims.len(), 2);
    assert!(claims.iter().all(|c| c["holds"] == false));
    assert_eq!(claims[0]["right"], "τ = 2π √(I/k), k for T");
    assert_eq!(claims[1]["right"], "½ ((1 + ψ0)² - ψ0²) c S²");
    assert!(text.contains("2 claims, 0 confirmed, 2 refuted"), "{text}");
    // (9), which has no k, is (7) with the k of (8).
    let bar = Bar {
        length: 0.346,
        diameter: 0.005,
        shear_modulus: 8e10,
    };
    let k = std::f64::consts::PI * 0.005f64.powi(4) * 8e10 / (32.0 * 0.346);
    near(
        bar.period(0.23),
        std::f64::consts::TAU * (0.23 / k).sqrt(),
        1e-9,
    );
    // The work of a spring let go from (1 + ψ0) S to ψ0 S, added up in steps.
    let (rate, stroke, psi) = (2000.0, 0.015, 0.5);
    let steps = 1000;
    let force = |i: i32| rate * stroke * (psi + (f64::from(i) + 0.5) / f64::from(steps));
    let work: f64 = (0..steps)
        .map(|i| force(i) * stroke / f64::from(steps))
        .sum();
    let spring = CamSpring {
        rate,
        stroke,
        mounting: psi,
    };
    near(spring.energy(), work, 1e-9);
    let printed = 0.5 * ((1.0 + psi * psi) - psi * psi) * rate * stroke * stroke;
    assert!((printed - work).abs() > 0.1 * work);
}

#[test]
fn nothing_is_told_of_mechanisms_that_no_claim_is_about() {
    let (claims, text) = claims(&["analyze", "four-bar"]);
    assert!(
        claims.is_empty() && !text.contains("published of this mechanism"),
        "{text}"
    );
    // Claims about arms are not about structure.
    assert!(self::claims(&["analyze", "lever-gripper"]).0.is_empty());
}

/// What a mechanism does not have is empty, not absent: every answer has the same keys.
#[test]
fn optional_keys_are_empty_and_not_absent() {
    let keys = |v: &Value| {
        v.as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect::<BTreeSet<_>>()
    };
    let state = |name| json(&["analyze", name, "--format", "json"])["states"][0].clone();
    let [plain, geared, turned] = ["four-bar", "planetary-gear", "bennett"].map(state);
    assert_eq!(keys(&plain), keys(&geared));
    assert_eq!(keys(&plain), keys(&turned));
    assert_eq!(plain["per_coupling"], value!([]));
    let top = |name| json(&["analyze", name, "--format", "json"]);
    assert!(top("four-bar")["stroke"].is_null());
    let statics = |more: &[&str]| {
        let args = [
            &[
                "statics",
                "gripper-10-loaded",
                "--spatial",
                "--format",
                "json",
            ],
            more,
        ];
        json(&args.concat())
    };
    let [free, clamped] = ["free", "clamped"].map(|s| statics(&["--state", s]));
    assert_eq!(keys(&free), keys(&clamped));
    assert_eq!(free["contacts"], value!([]));
    assert!(
        free["reactions"]
            .as_array()
            .unwrap()
            .iter()
            .all(|r| r["open"].is_array())
    );
    let found = keys(&json(&[
        "search", "four-bar", "--top", "1", "--format", "json",
    ]));
    for key in [
        "ranking",
        "numeric",
        "second_opinion",
        "certainty",
        "left_out",
    ] {
        assert!(found.contains(key), "{key}: {found:?}");
    }
}
