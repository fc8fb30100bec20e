//! Rules of a request for single links and joints: held links, and offered, allowed and forbidden options.

use crate::model::mechanism::{JointId, JointOption, Mechanism, Parts, StateId};
use crate::score::request::unlisted::{framed_types, named_part};
use crate::score::request::{Inserts, JointOptions, Request, RequestError};
use itertools::Itertools;

/// The names of the options that the joints of a mechanism have.
struct KnownOptions<'m> {
    mechanism: &'m Mechanism,
    names: Vec<&'m str>,
}

impl<'m> KnownOptions<'m> {
    fn of(mechanism: &'m Mechanism) -> KnownOptions<'m> {
        let offered = mechanism.joints.iter().flat_map(|j| &j.options);
        let mut names: Vec<&str> = offered.map(|o| o.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        KnownOptions { mechanism, names }
    }

    /// Refuses names that no joint and no type or part has; a type that no joint is offered can be forbidden.
    fn check_names(&self, names: &[String]) -> Result<(), RequestError> {
        let unknown = |n: &&String| !self.names.contains(&n.as_str()) && named_part(n).is_none();
        match names.iter().find(unknown) {
            None => Ok(()),
            Some(option) => Err(RequestError::NoOption {
                mechanism: self.mechanism.name.clone(),
                option: option.clone(),
                known: (self.names.iter().map(|k| (*k).to_owned()))
                    .chain(framed_types().map(|t| t.name().to_owned()))
                    .unique()
                    .collect(),
            }),
        }
    }
}

/// Options that are allowed at a joint, or forbidden.
struct OptionRule<'r> {
    joint: JointId,
    /// Empty means all changes.
    names: &'r [String],
    allow: bool,
}

impl<'r> OptionRule<'r> {
    /// Reads the rules that allow options, or those that forbid them.
    fn read_rules(
        list: &'r [JointOptions],
        allow: bool,
        mechanism: &Mechanism,
        known: &KnownOptions<'_>,
    ) -> Result<Vec<OptionRule<'r>>, RequestError> {
        let mut rules = Vec::with_capacity(list.len());
        for JointOptions { joint: id, names } in list {
            let joint = mechanism
                .joint_named(id)
                .ok_or_else(|| RequestError::NoJoint {
                    mechanism: mechanism.name.clone(),
                    joint: id.clone(),
                })?;
            if allow && names.is_empty() {
                return Err(RequestError::NoNames { joint: id.clone() });
            }
            known.check_names(names)?;
            rules.push(OptionRule {
                joint,
                names,
                allow,
            });
        }
        Ok(rules)
    }

    /// Returns true if the rules keep an option.
    fn leaves_option(&self, name: &String) -> bool {
        !self.names.is_empty() && self.names.contains(name) == self.allow
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
        let known = KnownOptions::of(mechanism);
        if !self.wants_any() {
            known.check_names(&self.options)?;
        }
        let mut rules = OptionRule::read_rules(&self.allow, true, mechanism, &known)?;
        rules.extend(OptionRule::read_rules(
            &self.forbid,
            false,
            mechanism,
            &known,
        )?);
        for &l in &held {
            let joints = mechanism.joint_ids();
            let joints = joints.filter(|&j| mechanism.joints[j].links.contains(&l));
            let item = || format!("link {}", mechanism.links[l].id);
            self.takes_part(mechanism, &joints.collect_vec(), item)?;
        }
        mechanism.edit().search.hold.extend(held);
        for (id, joint) in mechanism.joint_ids().zip(&mut mechanism.edit().joints) {
            let kept = |name: &String| {
                let mut own = rules.iter().filter(|r| r.joint == id);
                (self.options.is_empty() || self.wants_any() || self.options.contains(name))
                    && own.all(|r| r.leaves_option(name))
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
                        let id = mechanism.joint_named(joint);
                        let id = id.ok_or_else(|| RequestError::NoJoint {
                            mechanism: mechanism.name.clone(),
                            joint: joint.clone(),
                        })?;
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
