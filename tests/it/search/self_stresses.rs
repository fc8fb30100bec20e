//! What self-stresses do to each joint: directions, moments, shares, harm, in the plane and in space.

use crate::common::*;
/// A bar on two slides along x, at x = 0 and x = 2: size ℓ = 1, the root mean square distance of the joints.
fn slides() -> String {
    write_mechanism(
        "name = \"two-slides\"\nmode = \"planar\"",
        "0 1*",
        "
        left | 0 1 | prismatic | 0, 0, 0 | 1, 0, 0
        right | 0 1 | prismatic | 2, 0, 0 | 1, 0, 0
        ",
    )
}

fn joint<'a>(stress: &'a Value, name: &str) -> &'a Value {
    let all = stress["joints"].list();
    all.iter().find(|j| j["joint"] == name).unwrap()
}

/// By hand: slides along x press across it; the force that is no moment at the left is one of 2 at the right.
#[test]
fn a_plane_has_its_directions_and_moments_at_the_joints() {
    let found = json_on("analyze", "m.toml", &slides(), "");
    let stresses = found["states"][0]["self_stresses"].list();
    assert_eq!(stresses.len(), 2);
    let across: Vec<&Value> = stresses
        .iter()
        .filter(|s| joint(s, "left")["forces"] == json!(["y"]))
        .collect();
    let couple: Vec<&Value> = stresses
        .iter()
        .filter(|s| joint(s, "left")["forces"] == json!([]))
        .collect();
    let ([across], [couple]) = (&across[..], &couple[..]) else {
        panic!("{stresses:?}")
    };
    assert_eq!(joint(across, "left")["moments"], json!([]));
    assert_eq!(joint(across, "right")["moments"], json!(["z"]));
    assert_eq!(joint(across, "right")["forces"], json!(["y"]));
    assert_eq!(joint(couple, "right")["moments"], json!(["z"]));
    // |f|² + |m|²/ℓ²: 1 on the left, 1 + 4 on the right.
    for (stress, left, right) in [(across, 1.0 / 6.0, 5.0 / 6.0), (couple, 0.5, 0.5)] {
        near(joint(stress, "left")["share"].real(), left, 1e-12);
        near(joint(stress, "right")["share"].real(), right, 1e-12);
    }
    let (_, text, _) = run_on("analyze", "m.toml", &slides(), "--verbose");
    has(&text, "right 83 %, left 17 %");
    lacks(&text, "force along x");
}

/// The same in the plane of x and z, and off the origin: names follow the plane, shares do not change.
#[test]
fn planes_may_lie_anywhere() {
    let tilted = slides()
        .replace(
            "mode = \"planar\"",
            "mode = \"planar\"\nplane_normal = [0, 1, 0]",
        )
        .replace("point = [0, 0, 0]", "point = [10, 3, 7]")
        .replace("point = [2, 0, 0]", "point = [12, 3, 7]");
    let found = json_on("analyze", "m.toml", &tilted, "");
    for stress in found["states"][0]["self_stresses"].list() {
        for j in stress["joints"].list() {
            assert!(
                j["forces"] == json!(["z"]) || j["forces"] == json!([]),
                "{j}"
            );
            assert!(
                j["moments"] == json!(["y"]) || j["moments"] == json!([]),
                "{j}"
            );
        }
    }
}

/// In its plane the clamped gripper has two external constraints: friction along the faces, which does no harm, and the
/// parallel faces, which do.
#[test]
fn harm_is_judged_in_the_plane_too() {
    let found = run_json("analyze gripper-10 --planar --state clamped --format json");
    let stresses = found["states"][0]["self_stresses"].list();
    let verdicts: Vec<&str> = stresses.iter().map(|s| s["verdict"].word()).collect();
    assert_eq!(verdicts, ["harmless", "harmful"], "{stresses:?}");
    let at_pad = joint(&stresses[0], "4-a");
    assert_eq!(
        (&at_pad["forces"], &at_pad["moments"]),
        (&json!(["x"]), &json!([]))
    );
    assert_eq!(joint(&stresses[1], "4-a")["moments"], json!(["z"]));
}

/// The plane leaves out the slider's turn about its axis, and so does the count in it.
#[test]
fn planar_counting_counts_what_moves_in_the_plane() {
    let planar = split_words("analyze gripper-10 --planar --state free --format json --method");
    let counted = run_json(&[&planar[..], &["count-planar"]].concat());
    assert_eq!(counted["states"][0]["mobility"], 1, "{counted}");
    let modular = run_json(&[&planar[..], &["modular"]].concat());
    assert_eq!(modular["states"][0]["mobility"], 1);
}

/// Two coupled slides in a loop, and a part across it. The one self-stress that both couplings carry inside is the
/// difference of two that also load the part: it must not be counted with those.
fn coupled() -> String {
    let ball = "unloading = [{ type = \"spherical\", point = [4, 2, 0] }]";
    write_mechanism(
        "name = \"random\"",
        "0 1* 2 3* part!",
        &format!(
            "
        j0 | 0 1 | revolute | 0, 0, 0 | 0, 0, 1
        j1 | 1 2 | revolute | 0, 0, 0 | 0, 0, 1
        j2 | 2 3 | prismatic | -2, 2, -3 | 0, 3, 0 | options = [\"cylindrical\"]
        j3 | 3 1 | slotted | 3, -2, -2 | 1, 0, 0
        c0 | 0 part | revolute | 4, 0, 1 | 0, 2, 0 | state = \"clamped\"\\n{ball}
        c1 | 3 part | revolute | 4, 1, 1 | 0, 2, 0 | state = \"clamped\"\\nunloading = [\"spherical\"]
        "
        ),
    ) + "[[coupling]]\njoints = [\"j3:rz\", \"j2:tz\"]\nratio = 2\n\
         [[coupling]]\njoints = [\"j1:rz\", \"j3:tx\"]\nratio = \"1/2\"\n"
}

#[test]
fn what_a_state_adds_is_counted_without_what_is_there_already() {
    let a = json_on("analyze", "m.toml", &coupled(), "");
    let clamped = &a["states"][1];
    let stresses = clamped["self_stresses"].list();
    let external = stresses.iter().filter(|s| s["external"] == true).count();
    assert_eq!(clamped["external"]["redundant_by_rank"], 4);
    assert_eq!((external, stresses.len()), (4, 8), "{stresses:#?}");
    has(
        &run_quiet("analyze gripper-10 --state clamped"),
        "External: σ = ",
    );
}

/// What joints bear of a self-stress: nothing along or about what they leave free, and every link is in equilibrium.
#[test]
fn joints_bear_what_they_can_and_links_are_in_equilibrium() {
    let mut seen = 0;
    for name in ozols::builtin::names() {
        let m = built_in(name);
        if m.joints.len() > 30 {
            continue;
        }
        let states: Vec<_> = m.state_ids().collect();
        let found = analyse_states(&m, &states, Method::Modular).unwrap();
        // What a coupling passes on is borne along a freedom.
        let all = found.iter().flat_map(|s| &s.self_stresses);
        for stress in all.filter(|s| s.couplings.is_empty()) {
            let mut on_link = vec![([0.0; 3], [0.0; 3]); m.links.len()];
            for at in &stress.joints {
                let Some(borne) = at.borne else { continue };
                let joint = &m.joints[at.joint];
                let free = |f: &Freedom| match f {
                    Freedom::Screw => 0.0,
                    f if f.is_turn() => dot(borne.moment, direction_of(&joint.frame, *f)),
                    f => dot(borne.force, direction_of(&joint.frame, *f)),
                };
                for f in joint.joint_type.freedoms() {
                    assert!(free(f).abs() < 1e-7, "{name} {} {f:?}: {borne:?}", joint.id);
                }
                let named = |flags: [bool; 3], v: Vector| {
                    (0..3).all(|i| flags[i] == (v[i].abs() > 1e-9) || v[i].abs() < 1e-7)
                };
                assert!(named(at.moments, borne.moment), "{name} {at:?}");
                assert!(named(at.forces, borne.force), "{name} {at:?}");
                let moment = scale(borne.moment, stress.size);
                let moment = add(moment, cross(to_vector(&joint.frame.point), borne.force));
                for (link, sign) in [(joint.links[0], -1.0), (joint.links[1], 1.0)] {
                    let (f, t) = &mut on_link[link];
                    *f = add(*f, scale(borne.force, sign));
                    *t = add(*t, scale(moment, sign));
                }
                seen += 1;
            }
            let far = m.joints.iter().map(|j| length(to_vector(&j.frame.point)));
            let far = far.fold(stress.size, f64::max);
            for (l, (f, t)) in m.link_ids().zip(&on_link) {
                if m.links[l].role != Role::Frame {
                    let left = length(*f).max(length(*t) / far);
                    assert!(left < 1e-7, "{name} {}: {left}", m.links[l].id);
                }
            }
        }
    }
    assert!(seen > 500, "{seen}");
}
