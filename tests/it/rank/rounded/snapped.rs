//! What snapping makes of small mechanisms, against what is exact by hand: directions, places and reach.

use ozols::file::text::mechanism_from_str;
use ozols::geom::vector::{Vector, real};
use ozols::model::mechanism::Mechanism;
use ozols::rank::rounded::snap::relation::{Reach, Relation};
use ozols::rank::rounded::snap::{Snapped, size, snap};

/// A chain of joints, each with its type, point and axis.
fn chain(joints: &[(&str, Vector, Vector)]) -> Mechanism {
    let mut text = "name = \"chain\"\nlength_unit = \"m\"\n".to_owned();
    for l in 0..=joints.len() {
        let role = match l {
            0 => "role = \"frame\"\n",
            l if l == joints.len() => "role = \"output\"\n",
            _ => "",
        };
        text += &format!("[[link]]\nid = \"l{l}\"\n{role}");
    }
    for (i, (kind, p, d)) in joints.iter().enumerate() {
        text += &format!(
            "[[joint]]\nid = \"j{i}\"\nlinks = [\"l{i}\", \"l{}\"]\ntype = \"{kind}\"\npoint = {p:?}\naxis = {d:?}\n",
            i + 1
        );
    }
    mechanism_from_str("chain.toml", &text).unwrap()
}

fn snapped(m: &Mechanism, tolerance: f64) -> Snapped {
    snap(m, Reach::relative(tolerance, size(m)))
}

fn axis(s: &Snapped, joint: usize) -> Vector {
    real(&s.mechanism.joints[joint].frame.axis)
}

fn relations(s: &Snapped, joint: usize) -> Vec<Relation> {
    let of = s.moved.iter().find(|x| x.joint.index() == joint);
    of.map_or(Vec::new(), |x| x.relations.iter().map(|r| r.0).collect())
}

#[test]
fn an_axis_stays_on_the_side_it_points_to() {
    let m = chain(&[
        ("revolute", [0.0, 0.0, 0.0], [1e-5, 0.0, -1.0]),
        ("revolute", [1.0, 0.5, 0.0], [0.0, 1.0, 2e-5]),
        ("revolute", [2.0, 0.0, 0.5], [-1.0, 1e-5, 0.0]),
    ]);
    let s = snapped(&m, 1e-4);
    assert_eq!(axis(&s, 0), [0.0, 0.0, -1.0]);
    assert_eq!(axis(&s, 1), [0.0, 1.0, 0.0]);
    assert_eq!(axis(&s, 2), [-1.0, 0.0, 0.0]);
}

/// The third axis lies in the plane of the first two but for a hair, the fourth by far not, and no two are square.
#[test]
fn only_what_is_nearly_in_a_plane_is_put_there() {
    let third = [1.3, 1.1, 1.7 + 1e-5];
    let fourth = [1.0, 0.3, 0.55];
    let m = chain(&[
        ("revolute", [0.0, 0.0, 0.0], [1.0, 0.3, 0.6]),
        ("revolute", [1.0, 0.0, 0.7], [0.3, 0.8, 1.1]),
        ("revolute", [2.0, 1.0, 0.0], third),
        ("revolute", [3.0, 0.3, 0.2], fourth),
    ]);
    let s = snapped(&m, 1e-4);
    assert_eq!(relations(&s, 2), [Relation::InPlane]);
    let [x, y, z] = axis(&s, 2);
    // across both: (1, 0.3, 0.6) × (0.3, 0.8, 1.1) = (-0.15, -0.92, 0.71)
    assert!((-0.15 * x - 0.92 * y + 0.71 * z).abs() < 1e-12);
    assert_eq!(relations(&s, 3), []);
    assert_eq!(axis(&s, 3), fourth);
    assert!(s.refused.is_empty(), "{s:?}");
}

/// Two axes pass each other by a hair above (1, 0, 0): both are put through one point, which is where they nearly meet.
#[test]
fn axes_that_nearly_meet_meet_where_they_nearly_do() {
    let m = chain(&[
        ("revolute", [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ("revolute", [1.0, 0.5, 1e-5], [0.0, 1.0, 0.0]),
        ("revolute", [3.0, 2.0, 1.0], [0.0, 0.0, 1.0]),
    ]);
    let s = snapped(&m, 1e-4);
    let place = |j: usize| real(&s.mechanism.joints[j].frame.point);
    let (one, two) = (place(0), place(1));
    assert!(one[1].abs() < 1e-12 && (one[2] - two[2]).abs() < 1e-12);
    assert!((two[0] - 1.0).abs() < 1e-12);
    let meet = |j: usize| relations(&s, j).contains(&Relation::Meeting);
    assert!(meet(0) || meet(1));
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
    let s = snapped(&m, 1e-5);
    assert!(s.moved.is_empty() && s.refused.is_empty(), "{s:?}");
}
