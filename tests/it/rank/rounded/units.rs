//! What a unit of the last digit can do, by hand; and what is told of a scene that is meant.

use super::search_numeric::{plain_built_in, turned_bare};
use crate::common::*;
use ozols::meant::mechanism::{Meant, recover_mechanism};
use ozols::meant::mechanism::{describe_relations, moved_joints};
use ozols::rank::numeric::scaling::{Scaling, scaled_matrix};
use ozols::rank::rounded::nearly_special::rounding_reach;
use ozols::rank::rounded::verdict::{rank_verdict, settle_states};
use ozols_dense::singular_values;

fn measured(name: &str, decimals: usize) -> Mechanism {
    turned_bare(&plain_built_in(name), decimals, &mut Noise::new(3, 0))
}

/// Units of the last digit: of points, and of directions of unit length.
fn units(m: &Mechanism) -> [f64; 2] {
    let half = uncertainties(m).unwrap();
    let largest = |v: &[f64; 3]| v.iter().copied().fold(0.0, f64::max);
    let points = half
        .frames
        .iter()
        .map(|f| largest(&f.point))
        .fold(0.0, f64::max);
    let axes = m.joints.iter().zip(&half.frames);
    let axes = axes.map(|(j, h)| largest(&h.axis) / length(to_vector(&j.frame.axis)));
    let others = m.joints.iter().zip(&half.frames);
    let others = others.map(|(j, h)| largest(&h.reference) / length(to_vector(&j.frame.reference)));
    [points, axes.chain(others).fold(0.0, f64::max)].map(|half| 2.0 * half)
}

/// By hand, of hinges: half units of three components are off together by the root of their squares at most. A hinge's column is off by that of its axis, by as much
/// at an arm of the mechanism's size, and by that of its point over the size; once in every contour that passes it. No singular value
/// is off by more than all of that together [Weyl].
#[test]
fn what_rounding_can_do_is_that_of_all_hinges_together() {
    for name in split_words("bennett four-bar parallelogram-3-rods watt-six-bar") {
        let m = measured(name, 9);
        assert!(m.joints.iter().all(|j| j.joint_type == JointType::Revolute));
        let closure = Closure::new(&Reals, &m, StateId::FREE).unwrap();
        let half = uncertainties(&m).unwrap();
        let size = Scaling::of_closure(&closure).length();
        let off = |j: JointId| {
            let axis =
                length(half.frames[j.index()].axis) / length(to_vector(&m.joints[j].frame.axis));
            2.0 * axis + length(half.frames[j.index()].point) / size
        };
        let passed = closure.contours.iter().flat_map(|c| &c.joints);
        let squares: f64 = passed.map(|&(j, _)| off(j).powi(2)).sum();
        let whole = squares.sqrt();
        let largest = singular_values(&scaled_matrix(&closure)).unwrap()[0];
        let found = rank_verdict(&m, StateId::FREE).unwrap().tolerance;
        assert!(
            (found / (whole / largest) - 1.0).abs() < 1e-9,
            "{name}: {found}"
        );
        assert!((largest - 1.0).abs() > 0.1, "{name}");
    }
}

/// Two joints may each be off by a unit of its place and, at an arm of the size, by one of its direction.
#[test]
fn joints_are_near_as_far_as_two_roundings_go() {
    for name in ["bennett", "gripper-10"] {
        let m = measured(name, 7);
        let ([length, direction], found) = (units(&m), rounding_reach(&m).unwrap());
        let size = mechanism_size(&m);
        near(
            found.length,
            2.0 * (length + size * direction),
            1e-12 * size,
        );
        near(found.angle, 2.0 * direction.max(length / size), 1e-15);
        assert!(size * direction > 0.1 * length, "{name}");
    }
}

fn scene() -> Meant {
    recover_mechanism(&measured("gripper-10", 9)).unwrap()
}

/// What has not moved is not told, and what has is: its point, its axis or its reference.
#[test]
fn moves_are_of_points_axes_and_references() {
    let mut s = scene();
    for (written, joint) in s.written.iter_mut().zip(&s.mechanism.joints) {
        *written = joint.frame.clone();
    }
    assert!(moved_joints(&s).is_empty());
    let (still, angle) = (s.written.clone(), 0.01f64);
    let leaned = |v: &[Expr; 3], other: &[Expr; 3]| -> [Expr; 3] {
        let [v, other] = [v, other].map(to_vector);
        let (v, w) = (unit(v), unit(other));
        [0, 1, 2].map(|i| Expr::from_f64(v[i] + angle.tan() * w[i]).unwrap())
    };
    s.written[2].reference = leaned(&still[2].reference, &still[2].axis);
    s.written[4].axis = leaned(&still[4].axis, &still[4].reference);
    s.written[5].point[0] = Expr::from_f64(still[5].point[0].to_f64() + 0.25).unwrap();
    assert_eq!(moved_joints(&s), [2, 4, 5].map(JointId::new));
}

/// An axis that is parallel to none is not counted, and moves are told in units: two halves.
#[test]
fn what_was_understood_is_counted_in_groups_and_units() {
    let mut s = scene();
    s.rays = [0, 1, 2, 3, 4].map(|j| Some(JointId::new(j))).to_vec();
    s.scene.cluster = vec![0, 1, 0, 2, 0];
    s.scene.relations.clear();
    s.scene.moved = 0.84;
    let said = describe_relations(&s);
    assert!(said.starts_with("3 axes parallel;"), "{said}");
    assert!(
        said.ends_with("by at most 0.42 units of its last digit"),
        "{said}"
    );
    s.scene.cluster = vec![0, 1, 0, 1, 0];
    assert!(describe_relations(&s).starts_with("3 + 2 axes parallel;"));
}

/// Where nothing is open, the mechanism that a search takes has the rank of the verdict.
#[test]
fn what_is_settled_has_the_rank_of_its_verdict() {
    let (mut open, mut closed) = (0, 0);
    for name in split_words("bennett gripper-10 parallelogram-3-rods wren-platform") {
        for decimals in [4, 6, 9] {
            let m = measured(name, decimals);
            let found = settle_states(&m, &[StateId::FREE]).unwrap();
            if found.open.is_some() {
                open += 1;
                continue;
            }
            closed += 1;
            let taken = found.snapped.as_ref().unwrap_or(&m);
            let exact = analyse_states(taken, &[StateId::FREE], Method::Modular).unwrap();
            let said = found.verdicts[0].rank();
            assert_eq!(exact[0].rank, said, "{name} {decimals}");
        }
    }
    assert!(open > 0 && closed > 0, "{open} {closed}");
}
