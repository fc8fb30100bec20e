//! Rules of a request for single links and joints: held links, and offered, allowed and forbidden options.

use crate::model::mechanism::{JointId, JointOption, Mechanism, Parts, StateId};
use crate::score::request::unlisted::{framed_types, named_part};
use crate::score::request::{Inserts, JointOptions, Request, RequestError};
use itertools::Itertools;

/// Returns the joint of a name.
fn joint_of(mechanism: &Mechanism, name: &str) -> Result<JointId, RequestError> {
    let joint = mechanism.joint_named(name);
    joint.ok_or_else(|| RequestError::NoJoint {
        mechanism: mechanism.name.clone(),
        joint: name.to_owned(),
    })
}

/// Refuses names that no joint and no type or part has; a type that no joint is offered can be forbidden.
fn check_names(mechanism: &Mechanism, names: &[String]) -> Result<(), RequestError> {
    let offered = || mechanism.joints.iter().flat_map(|j| &j.options);
    let unknown = |n: &&String| offered().all(|o| o.name != **n) && named_part(n).is_none();
    match names.iter().find(unknown) {
        None => Ok(()),
        Some(option) => Err(RequestError::NoOption {
            mechanism: mechanism.name.clone(),
            option: option.clone(),
            known: (offered().map(|o| o.name.clone()).sorted())
                .chain(framed_types().map(|t| t.name().to_owned()))
                .unique()
                .collect(),
        }),
    }
}

impl Request {
    /// Holds links, and leaves the options that are allowed.
    pub(in crate::score) fn restrict_options(
        &self,
        mechanism: &mut Mechanism,
    ) -> Result<(), RequestError> {
        let mut held = Vec::with_capacity(self.hold.len());
        for link in &self.hold {
            held.push(
                mechanism
                    .link_named(link)
                    .ok_or_else(|| RequestError::NoLink {
                        mechanism: mechanism.name.clone(),
                        link: link.clone(),
                    })?,
            );
        }
        if !self.wants_any() {
            check_names(mechanism, &self.options)?;
        }
        // The options that are allowed at a joint, or forbidden; no names mean all changes.
        let mut rules = Vec::new();
        for (list, is_allowed) in [(&self.allow, true), (&self.forbid, false)] {
            for JointOptions { joint, names } in list {
                let id = joint_of(mechanism, joint)?;
                if is_allowed && names.is_empty() {
                    let joint = joint.clone();
                    return Err(RequestError::NoNames { joint });
                }
                check_names(mechanism, names)?;
                rules.push((id, names, is_allowed));
            }
        }
        for &l in &held {
            let joints = mechanism.joint_ids();
            let joints = joints.filter(|&j| mechanism.joints[j].links.contains(&l));
            let item = || format!("link {}", mechanism.links[l].id);
            self.takes_part(mechanism, &joints.collect_vec(), item)?;
        }
        mechanism.edit().search.hold.extend(held);
        for (id, joint) in mechanism.joint_ids().zip(&mut mechanism.edit().joints) {
            let kept = |name: &String| {
                let mut own = rules.iter().filter(|r| r.0 == id);
                (self.options.is_empty() || self.wants_any() || self.options.contains(name))
                    && own.all(|(_, names, is_allowed)| {
                        !names.is_empty() && names.contains(name) == *is_allowed
                    })
            };
            let mut place = 0;
            joint.options.retain(|o| {
                place += 1;
                // The present joint stays.
                place == 1 || kept(&o.name)
            });
        }
        Ok(())
    }

    /// Refuses what is in none of the states that are searched: all of whose `joints` are in others.
    fn takes_part(
        &self,
        mechanism: &Mechanism,
        joints: &[JointId],
        item: impl Fn() -> String,
    ) -> Result<(), RequestError> {
        let searched = self.searched_state(mechanism)?.map(|s| s.state);
        let there = |s: StateId| mechanism.joints_in(s).any(|j| joints.contains(&j));
        if there(StateId::FREE) || searched.is_some_and(there) {
            return Ok(());
        }
        let states = mechanism.states_with_ids().filter(|(s, _)| there(*s));
        let states = states.map(|(_, name)| name.clone()).collect_vec();
        if states.is_empty() {
            return Ok(());
        }
        Err(RequestError::Absent {
            mechanism: mechanism.name.clone(),
            item: item(),
            states,
        })
    }

    /// Adds the unloading joints that are asked for to those of the file.
    pub(in crate::score) fn insert_unloading(
        &self,
        mechanism: &mut Mechanism,
    ) -> Result<(), RequestError> {
        let searched = self.searched_state(mechanism)?.map(|s| s.state);
        for Inserts { names, joints } in &self.unloading {
            let places: Vec<JointId> = match (joints.as_slice(), searched) {
                ([], None) => {
                    return Err(RequestError::NoPlace {
                        names: names.join(","),
                    });
                }
                ([], Some(state)) => mechanism.joints_added_in(state).collect(),
                (named, _) => {
                    let id = |joint: &String| {
                        let id = joint_of(mechanism, joint)?;
                        let item = || format!("joint {joint}");
                        self.takes_part(mechanism, &[id], item)?;
                        Ok(id)
                    };
                    named.iter().map(id).collect::<Result<_, RequestError>>()?
                }
            };
            let mut parts = mechanism.edit();
            for j in places {
                for name in names {
                    offer_unloading(&mut parts, j, name)?;
                }
            }
        }
        Ok(())
    }
}

/// Offers an unloading joint by name: one that the file has there, now in every state, or a type in the joint's own frame.
fn offer_unloading(mechanism: &mut Parts, at: JointId, name: &str) -> Result<(), RequestError> {
    let joint = &mut mechanism.joints[at];
    if let Some(known) = joint.unloading.iter_mut().find(|u| u.name == name) {
        known.state = None;
        return Ok(());
    }
    let Some(joint_type) = named_part(name) else {
        let named = joint.unloading.iter().map(|u| u.name.clone());
        return Err(RequestError::NoUnloading {
            joint: joint.id.clone(),
            word: name.to_owned(),
            known: named
                .chain(framed_types().map(|t| t.name().to_owned()))
                .collect(),
        });
    };
    let part = JointOption {
        name: name.to_owned(),
        ..JointOption::in_frame_of(joint, &joint_type)
    };
    joint.unloading.push(part);
    Ok(())
}
