//! Joint types that a request names and the file does not list: offered in the joints' own frames.

use crate::file::read::resolve::contains;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Joint, JointId, JointOption, Mechanism, StateId};
use crate::score::request::{Request, RequestError};
use itertools::Itertools;

/// The types that need no more than a joint's own frame: a screw needs its lead, too, and a weld leaves nothing to choose.
pub(in crate::score) fn types() -> impl Iterator<Item = &'static JointType> {
    let fits = |t: &&JointType| !t.freedoms().is_empty() && !t.freedoms().contains(&Freedom::Screw);
    JointType::NAMED.iter().filter(fits)
}

impl Request {
    /// Offers the types that are named and that no joint has an option of: those of `--options` wherever a file's list would be
    /// offered, those of `--allow` at their joint. `tell` hears of directions that nobody stated.
    pub(in crate::score) fn offer_unlisted(
        &self,
        mechanism: &mut Mechanism,
        tell: &mut dyn FnMut(String),
    ) -> Result<(), RequestError> {
        // The first option of a joint is what it is now, and offers nothing.
        let listed: Vec<String> = {
            let offered = mechanism
                .joints
                .iter()
                .flat_map(|j| j.options.iter().skip(1));
            offered.map(|o| o.name.clone()).unique().collect()
        };
        let of_type = |name: &&String| types().find(|t| t.name() == name.as_str()).cloned();
        let new = |name: &&String| !listed.contains(name);
        let changeable =
            |j: &Joint| j.is_in(StateId::FREE) && !j.drive && j.joint_type != JointType::Fixed;
        let mut wanted: Vec<(&'static str, String, JointType, Vec<JointId>)> = Vec::new();
        for name in self.options.iter().filter(new).unique() {
            if let Some(t) = of_type(&name) {
                let all = mechanism.joints_with_ids().filter(|(_, j)| changeable(j));
                let all = all.map(|(id, _)| id).collect();
                wanted.push(("--options", name.clone(), t, all));
            }
        }
        for rule in &self.allow {
            let Some(at) = mechanism.joint(&rule.joint) else {
                continue;
            };
            for name in &rule.names {
                let there = mechanism.joints[at].options.iter().any(|o| o.name == *name);
                if let (Some(t), false) = (of_type(&name), there) {
                    wanted.push(("--allow", name.clone(), t, vec![at]));
                }
            }
        }
        for (flag, name, joint_type, at) in wanted {
            let mut taken = false;
            for id in at {
                taken |= offer(&mut mechanism.joints[id], &name, &joint_type);
            }
            if !taken {
                return Err(RequestError::LosesMotion {
                    flag,
                    mechanism: mechanism.name.clone(),
                    option: name,
                });
            }
            if let Some(what) = guessed(&joint_type) {
                tell(format!(
                    "note: {name} is not in the file, and is taken in the joints' own frames, {what}; an option in the file may have its own"
                ));
            }
        }
        Ok(())
    }
}

/// Offers a type at a joint, if it allows what the joint does now.
fn offer(joint: &mut Joint, name: &str, joint_type: &JointType) -> bool {
    let option = |name: &str, of: &JointType| JointOption {
        name: name.to_owned(),
        joint_type: of.clone(),
        frame: joint.frame.clone(),
        cost_milli: None,
        state: None,
    };
    let present = option(joint.joint_type.name(), &joint.joint_type);
    if joint.joint_type == *joint_type || joint.options.iter().any(|o| o.name == name) {
        return true;
    }
    let new = option(name, joint_type);
    let fits = contains(&new, &present) == Some(true);
    if fits {
        if joint.options.is_empty() {
            joint.options.push(present);
        }
        joint.options.push(new);
    }
    fits
}

/// The direction of a type that a joint's frame has no word for.
fn guessed(of: &JointType) -> Option<&'static str> {
    match of {
        JointType::Universal | JointType::CylindricalUniversal => {
            Some("the second pin along their reference")
        }
        JointType::Slotted => Some("the slot along their reference"),
        JointType::CylinderOnPlane | JointType::SphereOnPlane => {
            Some("the normal of the plane along their axis")
        }
        JointType::SphereInCylinder => Some("the tube along their axis"),
        _ => None,
    }
}
