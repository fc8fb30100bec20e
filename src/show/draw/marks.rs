//! What a variant of a search changed.

use super::subject::Marks;
use crate::model::mechanism::{JointId, Mechanism};
use crate::search::Search;
use crate::search::answer::k_best::Assignment;
use crate::search::check::variant_mechanism;
use crate::search::question::space::choice_name;

/// The mechanism that a variant is, with its changes marked for drawing.
#[must_use]
pub fn of_variant(search: &Search, variant: &Assignment, name: &str) -> (Mechanism, Marks) {
    let old = &search.mechanism;
    let realized = variant_mechanism::realize(search, &variant.choices);
    let mut changed: Vec<(JointId, String)> = Vec::new();
    for (v, &choice) in search.space.variables.iter().zip(&variant.choices) {
        if choice == 0 {
            continue;
        }
        for &j in &v.joints {
            let joint = &old.joints[j];
            let to = choice_name(old, j, &v.choices[choice]);
            let (from, now) = (
                joint.joint_type.class(),
                realized.joints[j].joint_type.class(),
            );
            changed.push((j, format!("{}: {from} → {now} {to}", joint.id)));
        }
    }
    changed.sort_unstable();
    let mut before = realized.clone();
    for (joint, present) in before.joints.iter_mut().zip(&old.joints) {
        joint.joint_type = present.joint_type.clone();
        joint.frame = present.frame.clone();
    }
    let marks = Marks {
        name: name.to_owned(),
        changed,
        joints: old.joints.len(),
        links: old.links.len(),
        before: Some(before),
    };
    (realized, marks)
}
