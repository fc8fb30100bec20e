//! Mechanisms that a millionth makes others: of digits that do not tell them apart nothing is sure that holds of one of them only.

use super::*;
use crate::model::drawn::{Drawn, X, Y, Z, draw_mechanism, hinges};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::exact::field::exact_field;
use crate::search::question::conditions::{Conditions, InState};

/// Digits that do not decide whether a millionth is zero.
const OPEN: Digits = Digits {
    tolerance: 1e-9,
    undecided: true,
};
/// Digits by which it is.
const FINE: Digits = Digits {
    undecided: false,
    ..OPEN
};
/// A millionth.
const LITTLE: f64 = 1e-6;

/// Returns the standing for the determinate condition and for all conditions, each as no, sure or doubtful.
fn judged(m: &Mechanism, conditions: Conditions, digits: Digits, choices: &[usize]) -> [String; 2] {
    let exact = exact_field(m, 0).unwrap();
    let question = Question::new(exact, m, conditions).unwrap();
    let found = Judge::new(&question, digits)
        .unwrap()
        .judge_variant(choices);
    let word = |s| match s {
        Answer::No => "no",
        Answer::Yes => "sure",
        Answer::Perhaps => "doubtful",
    };
    [found.determinate, found.admissible].map(|s| word(s).to_owned())
}

/// Creates a body on two hinges at a distance of `apart`, and a hinge to the side that sets the size.
fn door(apart: f64) -> Vec<Drawn> {
    hinges(&[([0, 1], [0.0; 3]), ([0, 1], [apart, 0.0, 0.0]), ([0, 2], X)])
}

/// Checks a door: two hinges have five redundant constraints on one line, and four on two lines.
#[test]
fn redundant_constraints_are_sure_where_their_number_is() {
    for (apart, digits, wanted) in [
        (0.0, FINE, ["no", "no", "sure"]),
        (LITTLE, FINE, ["no", "sure", "sure"]),
        (LITTLE, OPEN, ["no", "doubtful", "doubtful"]),
    ] {
        let found = [3, 4, 5].map(|max_redundant| {
            let conditions = Conditions {
                max_redundant,
                keep_output: false,
                ..Conditions::default()
            };
            let [determinate, _] = judged(
                &draw_mechanism(&door(apart), &[]),
                conditions,
                digits,
                &[0; 3],
            );
            determinate
        });
        assert_eq!(found, wanted, "{apart} {digits:?}");
    }
}

/// Checks a body that slides on an arm that turns. A freedom to turn about the slide keeps its motion if the arm turns about
/// that line. Otherwise it adds a third dimension.
#[test]
fn a_kept_motion_is_sure_where_its_dimension_is() {
    for (apart, digits, wanted) in [
        (0.0, FINE, "sure"),
        (LITTLE, FINE, "no"),
        (LITTLE, OPEN, "doubtful"),
    ] {
        let mut joints = hinges(&[([0, 1], [0.0; 3]), ([0, 3], X)]);
        joints.push((JointType::Prismatic, [1, 2], [apart, 0.0, 0.0], Z));
        let mut m = draw_mechanism(&joints, &[2]);
        let mut turns = m.joints[2].options[0].clone();
        turns.joint_type = JointType::Cylindrical;
        turns.name = turns.joint_type.name().to_owned();
        m.parts_mut().joints[2].options.push(turns);
        let said = |choices| judged(&m, Conditions::default(), digits, choices)[1].clone();
        assert_eq!(said(&[0, 0, 0]), "sure");
        assert_eq!(said(&[0, 0, 1]), wanted, "{apart} {digits:?}");
    }
}

/// Checks a contact that stops a door: it adds no redundant constraint with hinges on one line, and one if the hinges
/// already hold the door.
#[test]
fn external_constraints_are_sure_where_their_number_is() {
    for (apart, digits, wanted) in [
        (0.0, FINE, ["sure", "sure"]),
        (LITTLE, FINE, ["no", "sure"]),
        (LITTLE, OPEN, ["doubtful", "doubtful"]),
    ] {
        let mut joints = door(apart);
        joints.push((JointType::SphereOnPlane, [0, 1], X, Y));
        let mut m = draw_mechanism(&joints, &[]);
        m.parts_mut().states.push("stopped".to_owned());
        let stopped = StateId::new(1);
        m.parts_mut().joints[3].states = Some(vec![stopped]);
        let found = [0, 1].map(|most| {
            let conditions = Conditions {
                max_redundant: 5,
                keep_output: false,
                state: Some(InState {
                    state: stopped,
                    max_external: Some(most),
                    max_harmful: None,
                    hold_objects: false,
                }),
                ..Conditions::default()
            };
            let [_, admissible] = judged(&m, conditions, digits, &[0; 4]);
            admissible
        });
        assert_eq!(found, wanted, "{apart} {digits:?}");
    }
}
