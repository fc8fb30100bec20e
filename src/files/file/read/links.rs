//! The links, each of which hangs on the frame; and the contours that the designer chose.

use crate::closure::contour::closed_walk;
use crate::file::problem::ProblemKind;
use crate::file::read::workload::loads::mass;
use crate::file::schema::{MechanismFile, Words};
use crate::file::{Findings, Place};
use crate::model::mechanism::{JointId, Link, Mechanism, Role, StateId};
use std::collections::BTreeSet;

pub(crate) fn links(file: &MechanismFile, out: &Findings) -> Vec<Link> {
    let mut links: Vec<Link> = Vec::new();
    for (at, entry) in out.key("link").entries(&file.link) {
        at.check_id("link", &entry.id, links.iter().any(|l| l.id == entry.id));
        let role = match entry.role.as_deref() {
            None => Role::Inner,
            Some("frame" | "ground") => Role::Frame,
            Some("output") => Role::Output,
            Some("object" | "part") => Role::Object,
            Some(word) => {
                at.key("role")
                    .unknown("role", word, ["frame", "output", "object"]);
                Role::Inner
            }
        };
        if let (Role::Frame, Some(first)) = (role, links.iter().find(|l| l.role == Role::Frame)) {
            at.key("role").add(format!(
                "link \"{}\" is a second frame after \"{}\"; keep only one role = \"frame\"",
                entry.id, first.id
            ));
        }
        let (id, mass) = (entry.id.clone(), mass(entry, &at));
        links.push(Link { id, role, mass });
    }
    let has = |role| links.iter().any(|l| l.role == role);
    if !has(Role::Frame) {
        out.key("link")
            .add("no link has the role \"frame\"; mark the fixed link with role = \"frame\"");
    }
    if !has(Role::Output) {
        outputs(file, &mut links);
    }
    links
}

/// Makes all links that move in the free state outputs if no link is marked as one. Then no motion is idle, and a search keeps
/// all motions.
fn outputs(file: &MechanismFile, links: &mut [Link]) {
    let is_free = |w: &Words| w.list().iter().any(|s| s == "free");
    let free = file
        .joint
        .iter()
        .filter(|j| j.state.as_ref().is_none_or(is_free));
    let there: BTreeSet<&String> = free.flat_map(|j| &j.links).collect();
    for link in links {
        if link.role == Role::Inner && there.contains(&link.id) {
            link.role = Role::Output;
        }
    }
}

/// Checks that every link is connected to the frame in each state in which it has joints.
pub(crate) fn connected(mechanism: &Mechanism, out: &Findings) {
    let at = |l: usize| out.key("link").index(l).key("id");
    for (l, link) in mechanism.links_with_ids() {
        if !mechanism.joints.iter().any(|j| j.links.contains(&l)) {
            let link = link.id.clone();
            at(l.index()).add(ProblemKind::Unused { link });
        }
    }
    for (s, state) in mechanism.states_with_ids() {
        let mut reached = vec![mechanism.frame()];
        let mut next = 0;
        let joints: Vec<JointId> = mechanism.joints_in(s).collect();
        while let Some(&l) = reached.get(next) {
            next += 1;
            for &j in &joints {
                let [a, b] = mechanism.joints[j].links;
                for (from, to) in [(a, b), (b, a)] {
                    if from == l && !reached.contains(&to) {
                        reached.push(to);
                    }
                }
            }
        }
        let all = mechanism.links_with_ids();
        for (l, link) in all.filter(|(l, _)| !reached.contains(l)) {
            let here = joints
                .iter()
                .any(|&j| mechanism.joints[j].links.contains(&l));
            if here || (s == StateId::FREE && link.role == Role::Output) {
                let (link, state) = (link.id.clone(), state.clone());
                at(l.index()).add(ProblemKind::Disconnected { link, state });
            }
        }
    }
}

pub(crate) fn contours(file: &MechanismFile, m: &Mechanism, out: &Findings) -> Vec<Vec<JointId>> {
    let contour = |joints: &[String], at: Place<'_>| {
        let named = at.entries(joints).filter_map(|(at, id)| at.joint(m, id));
        let named: Vec<JointId> = named.collect();
        if named.len() == joints.len() && closed_walk(m, &named).is_none() {
            at.add("the joints of this contour do not form one closed loop; list them in order around the loop");
        }
        named
    };
    let all = out.key("contour").entries(&file.contour);
    all.map(|(at, entry)| contour(&entry.joints, at.key("joints")))
        .collect()
}
