//! A variant as a mechanism: joints are replaced, and unloading joints are in series, each with its own link.

use crate::model::joint_type::JointType;
use crate::model::mechanism::{
    Joint, JointId, JointOption, Link, LinkId, Mechanism, Parts, Role, StateId,
};
use crate::search::question::Question;

/// Returns for each joint of the searched mechanism its option in a variant, the unloading joint put in series with it, and whether it is a
/// joint that the searched state adds.
#[must_use]
pub fn chosen_options(question: &Question, choices: &[usize]) -> Vec<(usize, Option<usize>, bool)> {
    let mut chosen = vec![(0, None, false); question.mechanism.joints.len()];
    for (variable, &choice) in question.space.variables.iter().zip(choices) {
        if let Some(c) = variable.choices.get(choice) {
            for &j in &variable.joints {
                chosen[j.index()] = (c.option, c.unloading, variable.external);
            }
        }
    }
    chosen
}

/// Returns the mechanism of a variant. Joints keep their places in the list. Unloading joints and their links follow all
/// others. An unloading joint of a contact exists in every state, as its link does.
#[must_use]
pub fn realize_variant(question: &Question, choices: &[usize]) -> Mechanism {
    let old = &question.mechanism;
    let chosen = chosen_options(question, choices);
    let stays = |l| {
        old.joints_in(StateId::FREE)
            .any(|j| old.joints[j].links.contains(&l))
    };
    let mut links = old.links.clone();
    let mut contours = old.contours.clone();
    let (mut joints, mut inserted) = (Vec::with_capacity(old.joints.len()), Vec::new());
    for (joint, &(option, unloading, external)) in old.joints.iter().zip(&chosen) {
        let mut here = replace_joint(joint, joint.options.get(option));
        if let Some(u) = unloading.and_then(|u| joint.unloading.get(u)) {
            let pad = LinkId::new(links.len());
            // The pad stays on the mechanism when the body it held is gone.
            let [a, b] = joint.links.map(&stays);
            let end = usize::from(external && b && !a);
            here.links[end] = pad;
            links.push(Link {
                id: format!("{} pad", joint.id),
                role: Role::Inner,
                mass: None,
            });
            let at = JointId::new(old.joints.len() + inserted.len());
            let before = JointId::new(joints.len());
            for contour in contours.iter_mut().filter(|c| c.contains(&before)) {
                contour.push(at);
            }
            inserted.push(in_series(joint, u, external, end, pad));
        }
        joints.push(here);
    }
    joints.extend(inserted);
    Mechanism::of_valid(Parts {
        name: old.name.clone(),
        description: old.description.clone(),
        sources: old.sources.clone(),
        length_unit: old.length_unit,
        mode: old.mode.clone(),
        links,
        joints,
        couplings: old.couplings.clone(),
        states: old.states.clone(),
        contours,
        search: Default::default(),
        loads: old.loads.clone(),
        ranking: old.ranking.clone(),
        joint_types: old.joint_types.clone(),
        points: old.points.clone(),
        expected: Vec::new(),
        claims: Vec::new(),
        assumed: old.assumed.clone(),
        tables: old.tables.clone(),
    })
}

/// Returns an unloading joint in series with another, from the link at one end of it to a pad. That of a contact exists in
/// every state.
fn in_series(
    joint: &Joint,
    unloading: &JointOption,
    external: bool,
    end: usize,
    pad: LinkId,
) -> Joint {
    let mut series = replace_joint(joint, Some(unloading));
    series.id = format!("{} unloading", joint.id);
    (series.drive, series.drive_freedom) = (false, None);
    if external {
        series.states = None;
    }
    series.links[end] = joint.links[end];
    series.links[1 - end] = pad;
    series
}

/// Returns a realized variant with its kept links fixed to the frame. The constraints that become redundant give the
/// dimension of the kept links' motion.
#[must_use]
pub(crate) fn lock_links(question: &Question, realized: &Mechanism) -> Mechanism {
    let mut out = realized.clone();
    let frame = realized.frame_link();
    let Some(any) = realized.joints.first() else {
        return out;
    };
    for &link in question.kept.links.iter().filter(|l| **l != frame) {
        let mut lock = replace_joint(any, None);
        lock.id = format!("lock {}", realized.links[link].id);
        lock.links = [frame, link];
        lock.joint_type = JointType::Fixed;
        lock.states = None;
        out.parts_mut().joints.push(lock);
    }
    out
}

/// Returns a joint with another type and frame, without options.
fn replace_joint(joint: &Joint, by: Option<&JointOption>) -> Joint {
    let (joint_type, frame) = match by {
        Some(o) => (o.joint_type.clone(), o.frame.clone()),
        None => (joint.joint_type.clone(), joint.frame.clone()),
    };
    Joint {
        id: joint.id.clone(),
        links: joint.links,
        frame,
        drive: joint.drive,
        drive_freedom: joint
            .drive_freedom
            .filter(|f| joint_type.freedoms().contains(f)),
        joint_type,
        states: joint.states.clone(),
        options: Vec::new(),
        unloading: Vec::new(),
    }
}
