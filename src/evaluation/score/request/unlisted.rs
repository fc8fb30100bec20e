//! Joint types that a request names and the file does not list: offered in the joints' own frames.

use crate::closure::coupling::in_plane;
use crate::file::read::coupling::{coupled_freedoms, keeps_coupled};
use crate::file::read::resolve::contains_option;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Joint, JointId, JointOption, Mechanism, Parts, StateId};
use crate::score::request::{Request, RequestError};
use crate::search::answer::single_changes::{USUAL, USUAL_UNLOADING};
use itertools::Itertools;

/// Returns the types that need only a joint's own frame. A screw also needs its lead, and a weld has nothing to choose.
pub(in crate::score) fn framed_types() -> impl Iterator<Item = &'static JointType> {
    let fits = |t: &&JointType| !t.freedoms().is_empty() && !t.freedoms().contains(&Freedom::Screw);
    JointType::NAMED.iter().filter(fits)
}

/// Returns the type of a name: one that needs only a joint's own frame, or a part by its freedoms in that frame, such as
/// `ball-in-v-groove-x`.
pub(in crate::score) fn named_part(name: &str) -> Option<JointType> {
    let sets = || (1..6).flat_map(|n| FRAME_FREEDOMS.into_iter().combinations(n));
    let part = || sets().find(|set| name_of_set(set) == name);
    let framed = framed_types().find(|t| t.name() == name).cloned();
    framed.or_else(|| part().map(JointType::Custom))
}

/// Returns the freedoms of a part, as files have them; `None` if the name is not that of a part.
///
/// # Examples
/// ```
/// use ozols::score::request::unlisted::part_freedoms;
/// assert_eq!(part_freedoms("floating-nut-z").unwrap(), ["rx", "ry", "tx", "ty"]);
/// assert_eq!(part_freedoms("spherical"), None); // a joint type
/// ```
pub fn part_freedoms(name: &str) -> Option<Vec<&'static str>> {
    match named_part(name)? {
        JointType::Custom(set) => Some(set.iter().map(|f| f.name()).collect()),
        _ => None,
    }
}

/// The freedoms in a joint's frame.
const FRAME_FREEDOMS: [Freedom; 6] = {
    use Freedom::{Rx, Ry, Rz, Tx, Ty, Tz};
    [Rx, Ry, Rz, Tx, Ty, Tz]
};

/// The word for every set of freedoms.
const ANY: &str = "any";

impl Request {
    /// Returns the request with the words of joint types in place of trade names that no joint has an option of; `None` if it has none.
    pub(in crate::score) fn in_words_of_types(&self, mechanism: &Mechanism) -> Option<Request> {
        let mut named = self.clone();
        let mut found = false;
        let rules = named.allow.iter_mut().chain(&mut named.forbid);
        let inserts = named.unloading.iter_mut().map(|i| &mut i.names);
        let lists = rules.map(|rule| &mut rule.names).chain(inserts);
        for name in lists.chain([&mut named.options]).flatten() {
            let word = JointType::word_of_trade(name);
            if word != name && mechanism.option_named(name).is_none() {
                *name = word.to_owned();
                found = true;
            }
        }
        found.then_some(named)
    }

    /// Returns whether every set of freedoms is asked for.
    pub(in crate::score) fn wants_any(&self) -> bool {
        self.options.iter().any(|name| name == ANY)
    }

    /// Offers every set of freedoms in its own frame at each joint that may change, except the set of all: 30 in
    /// addition to the original one at a hinge in space. A set that is a type has its name.
    fn offer_any(&self, mechanism: &mut Mechanism) {
        let changeable = |j: &JointId| is_changeable(&mechanism.joints[*j]);
        let all: Vec<JointId> = mechanism.joint_ids().filter(changeable).collect();
        let mechanism = &mut *mechanism.edit();
        for id in all {
            let of_space = FRAME_FREEDOMS.into_iter();
            let own: Vec<Freedom> = of_space.filter(|&f| in_plane(mechanism, id, f)).collect();
            for set in own
                .iter()
                .copied()
                .powerset()
                .filter(|set| set.len() < own.len())
            {
                let alike = |t: &&JointType| {
                    let freedoms = t.freedoms();
                    freedoms.len() == set.len() && set.iter().all(|f| freedoms.contains(f))
                };
                let named = framed_types().find(alike).cloned();
                offer_type(mechanism, id, &named.unwrap_or(JointType::Custom(set)));
            }
        }
    }

    /// Offers the usual types at every joint where neither the file nor the request offers any. `tell` hears which.
    pub(in crate::score) fn offer_usual(
        &self,
        mechanism: &mut Mechanism,
        tell: &mut dyn FnMut(String),
    ) {
        let offers = |j: &Joint| j.options.len() > 1 || !j.unloading.is_empty();
        let names_some =
            !(self.options.is_empty() && self.allow.is_empty() && self.unloading.is_empty());
        if names_some || mechanism.joints.iter().any(offers) {
            return;
        }
        // All are offered before the mechanism is checked.
        let mut parts = mechanism.edit();
        for id in parts.joint_ids() {
            let joint = &parts.joints[id];
            if is_changeable(joint) {
                for t in USUAL {
                    offer_type(&mut parts, id, &t);
                }
            } else if !joint.is_in(StateId::FREE) {
                let usual = JointOption::in_frame_of(joint, &USUAL_UNLOADING);
                parts.joints[id].unloading.push(usual);
            }
        }
        drop(parts);
        if mechanism.joints.iter().any(offers) {
            tell(format!(
                "note: {} offers no joint types, so the usual ones are tried at all joints without a drive: {}",
                mechanism.name,
                USUAL.iter().map(|t| t.name()).join(", ")
            ));
        }
    }

    /// Offers the types that are named and that no joint has an option of: those for all joints wherever a file's list would be
    /// offered, those for one joint at it. `tell` hears of directions that nobody stated.
    pub(in crate::score) fn offer_unlisted(
        &self,
        mechanism: &mut Mechanism,
        tell: &mut dyn FnMut(String),
    ) -> Result<(), RequestError> {
        if self.wants_any() {
            self.offer_any(mechanism);
            tell("note: every set of freedoms is tried at all joints without a drive, in the joints' own frames".to_owned());
        }
        // The first option of a joint is what it is now, and offers nothing.
        let listed: Vec<String> = {
            let offered = mechanism
                .joints
                .iter()
                .flat_map(|j| j.options.iter().skip(1));
            offered.map(|o| o.name.clone()).unique().collect()
        };
        let new = |name: &&String| !listed.contains(name);
        let mut wanted: Vec<(String, JointType, Vec<JointId>)> = Vec::new();
        for name in self.options.iter().filter(new).unique() {
            if let Some(t) = named_part(name) {
                let all = mechanism
                    .joints_with_ids()
                    .filter(|(_, j)| is_changeable(j));
                let all = all.map(|(id, _)| id).collect();
                wanted.push((name.clone(), t, all));
            }
        }
        for rule in &self.allow {
            let Some(at) = mechanism.joint_named(&rule.joint) else {
                continue;
            };
            for name in &rule.names {
                let there = mechanism.joints[at].options.iter().any(|o| o.name == *name);
                if let (Some(t), false) = (named_part(name), there) {
                    wanted.push((name.clone(), t, vec![at]));
                }
            }
        }
        let mut parts = mechanism.edit();
        for (name, joint_type, at) in wanted {
            let mut taken = false;
            for id in at {
                taken |= offer_type(&mut parts, id, &joint_type);
            }
            if !taken {
                return Err(RequestError::LosesMotion {
                    mechanism: parts.name.clone(),
                    option: name,
                });
            }
            if let Some(what) = guessed_direction(&joint_type) {
                tell(format!(
                    "note: {name} is not in the file, and is taken in the joints' own frames, {what}; an option in the file may have its own"
                ));
            }
        }
        Ok(())
    }
}

/// Returns whether a list of options for all joints is offered at this one.
fn is_changeable(joint: &Joint) -> bool {
    joint.is_in(StateId::FREE) && !joint.drive && joint.joint_type != JointType::Fixed
}

/// Returns the name of a set of freedoms that is not a type: the part that has it with its axis in the joint's frame, as
/// `ball-in-v-groove-x`, or else its freedoms, as `rz+ty`. The axis of a blade flexure is the normal of the blade.
///
/// # Sources
/// Blanding, "Exact Constraint: Machine Design Using Kinematic Principles", 1999: wire and sheet flexures.
fn name_of_set(set: &[Freedom]) -> String {
    use Freedom::{Rx, Ry, Rz, Tx, Ty, Tz};
    let all = [(Rx, Tx, "x"), (Ry, Ty, "y"), (Rz, Tz, "z")];
    // Whether a part turns about an axis and slides along it.
    let free = |i: usize| [set.contains(&all[i].0), set.contains(&all[i].1)];
    let part = |i: usize| {
        let [along, across, other] = [0, 1, 2].map(|k| free((i + k) % 3));
        let name = match (along, across) {
            _ if across != other => return None,
            ([true, false], [true, true]) => "wire-flexure",
            ([true, true], [true, false]) => "ball-in-v-groove",
            ([false, true], [true, false]) => "blade-flexure",
            ([false, false], [true, true]) => "floating-nut",
            ([false, false], [true, false]) => "gimbal",
            _ => return None,
        };
        Some(format!("{name}-{}", all[i].2))
    };
    // A gimbal about the joint's axis that slides along one of its pins.
    let sliding = |i: usize| {
        let alike = (0..3).all(|k| free(k) == [k != 2, k == i]);
        alike.then(|| format!("sliding-gimbal-{}", all[i].2))
    };
    let named = (0..3).find_map(part).or_else(|| (0..2).find_map(sliding));
    named.unwrap_or_else(|| set.iter().map(|f| f.name()).join("+"))
}

/// Offers a type at a joint, if it fits there, and returns whether it is offered.
fn offer_type(mechanism: &mut Parts, id: JointId, joint_type: &JointType) -> bool {
    let joint = &mechanism.joints[id];
    let name = match joint_type {
        JointType::Custom(set) => name_of_set(set),
        named => named.name().to_owned(),
    };
    // The file may offer the same motion under a name of its own.
    let new = JointOption::in_frame_of(joint, joint_type);
    let alike = |o: &JointOption| {
        o.name == name
            || (contains_option(o, &new), contains_option(&new, o)) == (Some(true), Some(true))
                && matches!(joint_type, JointType::Custom(_))
    };
    if joint.joint_type == *joint_type || joint.options.iter().any(alike) {
        return true;
    }
    let fits = type_fits(mechanism, id, joint_type);
    if fits {
        let joint = &mut mechanism.joints[id];
        if joint.options.is_empty() {
            joint
                .options
                .push(JointOption::in_frame_of(joint, &joint.joint_type));
        }
        joint.options.push(JointOption { name, ..new });
    }
    fits
}

/// Returns whether a type in a joint's frame allows what the joint does now and keeps the freedoms that are coupled there.
pub(in crate::score) fn type_fits(mechanism: &Parts, id: JointId, joint_type: &JointType) -> bool {
    let joint = &mechanism.joints[id];
    let [new, present] =
        [joint_type, &joint.joint_type].map(|t| JointOption::in_frame_of(joint, t));
    contains_option(&new, &present) == Some(true)
        && keeps_coupled(&new, &present, &coupled_freedoms(mechanism, id))
}

/// Returns the direction of a type that a joint's frame does not determine.
fn guessed_direction(of: &JointType) -> Option<&'static str> {
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
