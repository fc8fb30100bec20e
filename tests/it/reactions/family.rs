//! Reactions that equilibrium leaves open: self-stresses, misalignment, stiffness.

use super::{SOLVED, built_in, left_over, solve};
use crate::common::*;
use ozols::model::loads::{Misalignment, Stiffness};

#[test]
fn self_stresses_are_in_equilibrium_and_as_many_as_the_redundant_constraints() {
    for name in split_words(SOLVED) {
        let mut m = built_in(name);
        let s = solve(&m);
        let by_rank = analysed(&m).redundant;
        assert_eq!(s.self_stresses.len(), by_rank, "{name}");
        m.edit().loads = Default::default();
        for stress in &s.self_stresses {
            assert!(left_over(&m, stress) < 1e-9, "{name}");
        }
    }
}

/// A bar between two walls, both ends fixed: a turn of one end by θ bends it against the two joints' angular stiffness in
/// series with what their linear stiffness gives way at the arm's length. By hand: the ends at distance L take a moment
/// each and forces ±F; least energy under M1 + M2 = F L gives the stiffness.
#[test]
fn a_misaligned_joint_strains_as_by_hand() {
    // Of length 2 the joints' mean distance from their middle is 1, and lengths in it are metres.
    for length in [2.0, 5.0, 0.3] {
        strained(length);
    }
}

fn strained(l: f64) {
    let ends = format!("a | 0 1 | fixed | 0, 0, 0\nb | 0 1 | fixed | {l}, 0, 0");
    let text = write_mechanism("name = \"bar\"", "0 1*", &ends)
        + "[workload.stiffness.default]\nlinear = 1000\nangular = 300\n\
           [[workload.misalignment]]\njoint = \"b\"\nangle = 0.01\naxis = \"z\"\n";
    let m = read(&text);
    let s = solve(&m);
    assert_eq!(s.self_stresses.len(), 6);
    let elastic = s.elastic.as_ref().unwrap();
    assert!(left_over(&m, elastic) < 1e-12);
    // Round the contour: M about b = m, force F along y at b; at a the opposite, moment -(m + F L).
    // Energy ½(m² + (m + F L)²)/ka + ½·2F²/kl - m θ: its gradient vanishes.
    let (ka, kl, theta) = (300.0, 1000.0, 0.01);
    // (2m + F L)/ka = θ, L(m + F L)/ka + 2F/kl = 0
    let det = (2.0 / ka) * (l * l / ka + 2.0 / kl) - (l / ka) * (l / ka);
    let (moment, force) = (
        theta * (l * l / ka + 2.0 / kl) / det,
        -theta * (l / ka) / det,
    );
    let b = &elastic[1];
    assert!(
        (b.global_moment()[2] - moment).abs() < 1e-9 * moment,
        "{b:?} {moment}"
    );
    assert!(
        (b.global_force()[1] - force).abs() < 1e-9 * moment,
        "{b:?} {force}"
    );
    // Without strain, nothing.
    assert!(s.reactions.iter().all(|r| r.force_size() < 1e-12));
}

/// The same bar, its end mounted beside where it belongs: along it by both joints' linear stiffness in series; across it the arm
/// also turns the joints. By hand: 2m + F L = 0 turns neither end, L(m + F L)/ka + 2F/kl = δ.
#[test]
fn a_shifted_joint_strains_as_by_hand() {
    for l in [2.0, 5.0, 0.3] {
        for (axis, along) in [("x", 0), ("y", 1)] {
            let ends = format!(
                "a | 0 1 | fixed | 0, 0, 0\nb | 0 1 | fixed | {}, 0, 0",
                1000.0 * l
            );
            let strain = format!(
                "[workload.stiffness.default]\nlinear = 1000\nangular = 300\n\
                 [[workload.misalignment]]\njoint = \"b\"\nlength = 10\naxis = \"{axis}\"\n"
            );
            let head = "name = \"bar\"\nlength_unit = \"mm\"";
            let text = write_mechanism(head, "0 1*", &ends) + &strain;
            let m = read(&text);
            let elastic = solve(&m).elastic.unwrap();
            assert!(left_over(&m, &elastic) < 1e-12);
            let (ka, kl, delta) = (300.0, 1000.0, 0.01);
            let force = if along == 0 {
                delta * kl / 2.0
            } else {
                delta / (l * l / (2.0 * ka) + 2.0 / kl)
            };
            let found = elastic[1].global_force();
            assert!(
                (found[along] - force).abs() < 1e-9 * force,
                "{l} {axis}: {found:?} {force}"
            );
        }
    }
}

/// A misalignment is a turn or a shift: neither and both are refused, and a shift is written as it was read.
#[test]
fn a_misalignment_is_an_angle_or_a_length() {
    let text = builtin::text("gripper-10-loaded").unwrap();
    let with = |what: &str| {
        format!("{text}\n[[workload.misalignment]]\njoint = \"2-3\"\naxis = \"y\"\n{what}\n")
    };
    for what in ["", "angle = 0.1\nlength = 0.2"] {
        assert_fails_on(
            "check",
            "g.toml",
            &with(what),
            "",
            "either an angle or a length",
        );
    }
    let m = read(&with("length = 0.25"));
    has(&formats::write(&m, "toml").unwrap(), "length = 0.25");
}

#[test]
fn stiffness_decides_among_the_family_and_equilibrium_stays() {
    let mut m = built_in("gripper-10-loaded");
    let soft = Stiffness {
        linear: 1e7,
        angular: 1e3,
    };
    m.edit().loads.stiffness = vec![("default".into(), soft)];
    let s = solve(&m);
    let straight = s.elastic.clone().unwrap();
    assert!(left_over(&m, &straight) < 1e-9);
    let joint = m.joint_named("2-3").unwrap();
    m.edit().loads.misalignments.push(Misalignment {
        joint,
        turn: [0.001, 0.0, 0.0],
        shift: [0.0; 3],
    });
    let askew = solve(&m).elastic.unwrap();
    assert!(left_over(&m, &askew) < 1e-9);
    let moment = |l: &[JointReaction]| l.iter().map(JointReaction::moment_size).fold(0.0, f64::max);
    assert!(moment(&askew) > 1.01 * moment(&straight));
    // A hinge turned about its own axis strains nothing.
    m.edit().loads.misalignments[0].turn = [0.0, 0.0, 0.001];
    let free = solve(&m).elastic.unwrap();
    for (x, y) in free.iter().zip(&straight) {
        assert!((x.force_size() - y.force_size()).abs() < 1e-6);
    }
}

/// A joint's own stiffness goes before that of all others.
#[test]
fn a_types_own_stiffness_goes_before_the_default() {
    let mut m = built_in("four-bar");
    m.edit().loads.misalignments = vec![Misalignment {
        joint: m.joint_ids().next().unwrap(),
        turn: [0.01, 0.0, 0.0],
        shift: [0.0; 3],
    }];
    let stiff = |linear, angular| Stiffness { linear, angular };
    let own = ("revolute".to_owned(), stiff(1e6, 2e3));
    let strained = |all: Vec<(String, Stiffness)>| {
        let mut m = m.clone();
        m.edit().loads.stiffness = all;
        solve(&m).elastic.unwrap()
    };
    let alone = strained(vec![own.clone()]);
    let both = strained(vec![("default".to_owned(), stiff(3e4, 5e4)), own]);
    assert!(alone.iter().any(|r| r.moment_size() > 1e-3));
    for (a, b) in alone.iter().zip(&both) {
        assert!((a.moment_size() - b.moment_size()).abs() < 1e-9 * (1.0 + a.moment_size()));
        assert!((a.force_size() - b.force_size()).abs() < 1e-9 * (1.0 + a.force_size()));
    }
}
