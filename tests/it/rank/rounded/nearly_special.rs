//! What is nearly special in small mechanisms, against what is exact by hand: directions, places and reach.

use crate::common::*;
use ozols::rank::rounded::nearly_special::{NearJoint, Reach, Relation, nearly_special};

/// A chain of joints, each with its type, point and axis.
fn chain(joints: &[(&str, Vector, Vector)]) -> Mechanism {
    let links = (0..=joints.len()).map(|l| format!("l{l}")).join(" ") + "*";
    let line = |(i, (kind, p, d)): (usize, &(&str, Vector, Vector))| {
        let vector = |v: &Vector| v.iter().map(|x| format!("{x:?}")).join(", ");
        format!(
            "j{i} | l{i} l{} | {kind} | {} | {}",
            i + 1,
            vector(p),
            vector(d)
        )
    };
    let joints = joints.iter().enumerate().map(line).join("\n");
    read(&write_mechanism(
        "name = \"chain\"\nlength_unit = \"m\"",
        &links,
        &joints,
    ))
}

fn near(m: &Mechanism, tolerance: f64) -> Vec<NearJoint> {
    nearly_special(m, Reach::relative(tolerance, mechanism_size(m)))
}

fn relations(near: &[NearJoint], joint: usize) -> Vec<Relation> {
    let of = near.iter().find(|x| x.joint.index() == joint);
    of.map_or(Vec::new(), |x| x.relations.iter().map(|r| r.0).collect())
}

/// The side that an axis points to makes no difference.
#[test]
fn axes_are_nearly_parallel_to_global_ones_either_way() {
    let m = chain(&[
        ("revolute", [0.0, 0.0, 0.0], [1e-5, 0.0, -1.0]),
        ("revolute", [1.0, 0.5, 0.0], [0.0, 1.0, 2e-5]),
        ("revolute", [2.0, 0.0, 0.5], [-1.0, 1e-5, 0.0]),
    ]);
    let found = near(&m, 1e-4);
    for (joint, turn) in [1e-5, 2e-5, 1e-5].into_iter().enumerate() {
        assert!(relations(&found, joint).contains(&Relation::Parallel));
        assert!((found[joint].turn - turn).abs() < 1e-12, "{found:?}");
    }
}

/// The third axis lies in the plane of the first two but for a hair, the fourth by far not, and no two are square.
#[test]
fn only_what_is_nearly_in_a_plane_is_said_to_be() {
    let third = [1.3, 1.1, 1.7 + 1e-5];
    let m = chain(&[
        ("revolute", [0.0, 0.0, 0.0], [1.0, 0.3, 0.6]),
        ("revolute", [1.0, 0.0, 0.7], [0.3, 0.8, 1.1]),
        ("revolute", [2.0, 1.0, 0.0], third),
        ("revolute", [3.0, 0.3, 0.2], [1.0, 0.3, 0.55]),
    ]);
    let found = near(&m, 1e-4);
    assert_eq!(relations(&found, 2), [Relation::InPlane]);
    // across both: (1, 0.3, 0.6) × (0.3, 0.8, 1.1) = (-0.15, -0.92, 0.71)
    let normal = unit([-0.15, -0.92, 0.71]);
    let off = dot(normal, unit(third)).abs().asin();
    let told = found.iter().find(|x| x.joint.index() == 2).unwrap().turn;
    assert!((told - off).abs() < 1e-12, "{told} {off}");
    assert_eq!(relations(&found, 3), []);
}

/// Two axes pass each other by a hair above (1, 0, 0), which is where they nearly meet.
#[test]
fn axes_that_nearly_meet_are_said_to() {
    let m = chain(&[
        ("revolute", [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ("revolute", [1.0, 0.5, 1e-5], [0.0, 1.0, 0.0]),
        ("revolute", [3.0, 2.0, 1.0], [0.0, 0.0, 1.0]),
    ]);
    let found = near(&m, 1e-4);
    let meet = |j: usize| relations(&found, j).contains(&Relation::Meeting);
    assert!(meet(0) || meet(1));
    let off = found.iter().map(|x| x.shift).fold(0.0, f64::max);
    assert!((off - 1e-5).abs() < 1e-12, "{off}");
}

/// Lines along (1, 2, 2) and (2, -1, 2), a thousandth apart along their common square (6, 2, -5); short as their directions are
/// written, they are no nearer.
#[test]
fn axes_that_pass_each_other_clearly_do_not_meet() {
    let m = chain(&[
        ("revolute", [0.0, 0.0, 0.0], [0.01, 0.02, 0.02]),
        (
            "revolute",
            [-0.1 + 0.000744, 0.8 + 0.000248, 0.2 - 0.00062],
            [0.02, -0.01, 0.02],
        ),
    ]);
    let found = near(&m, 1e-5);
    assert!(found.is_empty(), "{found:?}");
}
