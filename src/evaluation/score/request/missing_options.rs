//! Joint types and parts that would help if a search finds nothing.

use crate::model::joint_type::JointType;
use crate::model::mechanism::{Joint, JointId, Mechanism, StateId};
use crate::score::outcome::Outcome;
use crate::score::request::unlisted::{framed_types, named_part, type_fits};
use crate::score::request::{Check, Inserts, JointOptions, List, Method, Request};
use crate::score::run::answer_request;
use crate::search::answer::single_changes::USUAL;
use itertools::Itertools;
use std::sync::Arc;

/// Node budget of the search that tests whether they help.
const NODES: usize = 20_000;
/// Number of the best variants whose joint types and parts are offered.
const BEST: usize = 5;
/// Joints in series with a screw, which keep its motion and let its nut tilt or shift.
const NUTS: [&str; 4] = [
    "gimbal-z",
    "sliding-gimbal-x",
    "sliding-gimbal-y",
    "floating-nut-z",
];
/// Seats in place of a bolt or a ball.
const GROOVES: [&str; 2] = ["ball-in-v-groove-x", "ball-in-v-groove-y"];

impl Outcome {
    /// Returns the request with more joint types or parts at some joints, if nothing was found and a search with these finds a variant.
    /// The usual types come first, then all that need only a joint's own frame, at last those that have to be pressed together. Only
    /// those are offered that the best variants use.
    pub fn would_help(&self) -> Option<Request> {
        let pressed =
            |t: &JointType| matches!(t, JointType::SphereOnPlane | JointType::CylinderOnPlane);
        let firm = framed_types().filter(|t| !pressed(t)).collect_vec();
        let lists = [USUAL.iter().collect(), firm, framed_types().collect_vec()];
        lists.iter().find_map(|types| self.offer_types(types))
    }

    /// Returns the request with types that the best variants of a wider search use, if it finds any. Screws remain screws.
    fn offer_types(&self, types: &[&JointType]) -> Option<Request> {
        let (m, asked) = (&*self.search.mechanism, &self.request);
        let mut wider = asked.clone();
        let changeable = |j: &Joint| {
            let named = asked.allow.iter().any(|rule| rule.joint == j.id);
            j.is_in(StateId::FREE) && !j.drive && !named
        };
        for (id, j) in m.joints_with_ids().filter(|(_, j)| changeable(j)) {
            let joint = j.id.clone();
            if j.joint_type == JointType::Helical {
                wider.unloading.push(Inserts {
                    names: NUTS.map(str::to_owned).to_vec(),
                    joints: vec![joint.clone()],
                });
                wider.forbid.push(all_changes(joint));
                continue;
            }
            let bolt = matches!(j.joint_type, JointType::Fixed | JointType::Spherical);
            let seats = GROOVES.iter().filter(|_| bolt);
            let fits = |name: &&str| named_part(name).is_some_and(|t| type_fits(m, id, &t));
            let types = types.iter().map(|t| t.name());
            let more = types.chain(seats.copied()).filter(fits);
            let names = own_names(j).chain(more).map(str::to_owned).unique();
            let names = names.collect_vec();
            if !asked.options.is_empty() {
                wider.options.extend(names);
            } else if !names.is_empty() {
                wider.allow.push(JointOptions { joint, names });
            }
        }
        let used = self.changes_found(&wider)?;
        let is_used = |joint: Option<&str>, name: &str| {
            let here = |id: &str| joint.is_none_or(|j| j == id);
            let mut parts = used.iter().filter(|(id, _)| here(id));
            parts.any(|(_, to)| to.split(" + unloading ").any(|part| part == name))
        };
        let usual = self.offers_usual();
        let new = |rule: &JointOptions| {
            let joint = m.joint_named(&rule.joint).map(|j| &m.joints[j]);
            let listed = |n: &String| joint.is_some_and(|j| own_names(j).contains(&n.as_str()));
            !rule.names.is_empty() && (usual || !rule.names.iter().all(listed))
        };
        let names = wider.options.into_iter().unique();
        let names = names.filter(|n| asked.options.contains(n) || is_used(None, n));
        wider.options = names.collect();
        let mut rules = wider.allow.split_off(asked.allow.len());
        for rule in &mut rules {
            rule.names.retain(|n| is_used(Some(&rule.joint), n));
        }
        wider.allow.extend(rules.into_iter().filter(new));
        wider.forbid.truncate(asked.forbid.len());
        for mut insert in wider.unloading.split_off(asked.unloading.len()) {
            insert.names.retain(|n| is_used(Some(&insert.joints[0]), n));
            if !insert.names.is_empty() {
                wider.forbid.push(all_changes(insert.joints[0].clone()));
                wider.unloading.push(insert);
            }
        }
        Some(wider)
    }

    /// Returns true if the usual types are offered, because the file lists none. A request that names other types excludes them.
    fn offers_usual(&self) -> bool {
        let m = &self.search.mechanism;
        let usual = |(id, j): (JointId, &Joint)| {
            let fits = |t: &&JointType| **t != j.joint_type && type_fits(m, id, t);
            let names = USUAL.iter().filter(fits).map(JointType::name);
            j.options.len() < 2 || names.eq(own_names(j))
        };
        m.joints_with_ids().all(usual)
    }

    /// Returns the changes of the best variants of a wider request: joints by name, and what they become. `None` if it finds no variant.
    fn changes_found(&self, wider: &Request) -> Option<Vec<(String, String)>> {
        // What is prepared already is not prepared again.
        let trial = Request {
            hold: Vec::new(),
            unloading: wider.unloading[self.request.unloading.len()..].to_vec(),
            costs: None,
            as_written: true,
            rank: Vec::new(),
            list: List::Top(BEST),
            method: Method::Diagram,
            distinct: true,
            check: Check::None,
            poses: 0,
            nodes: NODES.min(wider.nodes),
            ..wider.clone()
        };
        let mut unranked = Mechanism::clone(&self.search.mechanism);
        unranked.edit().ranking = None;
        let prepared = trial.prepare(unranked, &mut |_| {}).ok()?;
        let (mut conditions, rounded) = trial.search_conditions(&prepared, &mut |_| {}).ok()?;
        // Nobody reads how many variants there are.
        conditions.estimate = None;
        let mechanism = Arc::new(prepared.mechanism);
        let never = &|| false;
        let found = answer_request(mechanism, conditions, rounded, &trial, never, &mut |_| {});
        let found = found.ok()?;
        let variants = found.variants().collect_vec();
        let changes = variants.iter().flat_map(|v| v.list_changes());
        let id = |j: JointId| self.search.mechanism.joints[j].id.clone();
        let changes = changes.map(|c| (id(c.joint), c.to)).collect();
        (!variants.is_empty()).then_some(changes)
    }
}

/// Returns the names of a joint's options, without that of the original joint.
fn own_names(j: &Joint) -> impl Iterator<Item = &str> {
    j.options.iter().skip(1).map(|o| o.name.as_str())
}

/// Returns the rule that forbids all changes of a joint.
fn all_changes(joint: String) -> JointOptions {
    JointOptions {
        joint,
        names: Vec::new(),
    }
}
