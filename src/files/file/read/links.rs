//! The links, each of which hangs on the frame; and the contours that the designer chose.

use crate::closure::contour::closed_walk;
use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::names::{check_id, joint_by_id};
use crate::file::read::workload::loads::mass;
use crate::file::schema::{MechanismFile, Words};
use crate::model::mechanism::{JointId, Link, LinkId, Mechanism, Role, StateId};
use std::collections::BTreeSet;

pub(crate) fn links(file: &MechanismFile, out: &mut Findings) -> Vec<Link> {
    let mut links: Vec<Link> = Vec::new();
    for (i, entry) in file.link.iter().enumerate() {
        let at = [DocumentStep::Key("link".to_owned()), DocumentStep::Index(i)];
        check_id(
            "link",
            &entry.id,
            links.iter().any(|l| l.id == entry.id),
            &key(&at, "id"),
            out,
        );
        let role = match entry.role.as_deref() {
            None => Role::Inner,
            Some("frame") => Role::Frame,
            Some("output") => Role::Output,
            Some("object") => Role::Object,
            Some(word) => {
                let known = "frame, output, object".to_owned();
                out.add(
                    &key(&at, "role"),
                    ProblemKind::UnknownWord {
                        what: "role",
                        word: word.to_owned(),
                        known,
                    },
                );
                Role::Inner
            }
        };
        if let (Role::Frame, Some(first)) = (role, links.iter().find(|l| l.role == Role::Frame)) {
            out.add(
                &key(&at, "role"),
                ProblemKind::SecondFrame {
                    first: first.id.clone(),
                    second: entry.id.clone(),
                },
            );
        }
        links.push(Link {
            id: entry.id.clone(),
            role,
            mass: mass(entry, &at, out),
        });
    }
    let has = |role| links.iter().any(|l| l.role == role);
    if !has(Role::Frame) {
        out.add(
            &[DocumentStep::Key("link".to_owned())],
            ProblemKind::NoFrame,
        );
    }
    if !has(Role::Output) {
        outputs(file, &mut links);
    }
    links
}

/// Where no link is said to be an output, all are that move in the free state: nothing then is idle, and a search keeps all
/// motions.
fn outputs(file: &MechanismFile, links: &mut [Link]) {
    let free = file.joint.iter().filter(|j| match &j.state {
        None => true,
        Some(Words::One(state)) => state == "free",
        Some(Words::Many(states)) => states.iter().any(|s| s == "free"),
    });
    let there: BTreeSet<&String> = free.flat_map(|j| &j.links).collect();
    for link in links {
        if link.role == Role::Inner && there.contains(&link.id) {
            link.role = Role::Output;
        }
    }
}

/// Every link must hang on the frame in each state it has joints in.
pub(crate) fn connected(mechanism: &Mechanism, out: &mut Findings) {
    let at = |l: LinkId| {
        [
            DocumentStep::Key("link".to_owned()),
            DocumentStep::Index(l.index()),
            DocumentStep::Key("id".to_owned()),
        ]
    };
    for (l, link) in mechanism.links_with_ids() {
        if !mechanism.joints.iter().any(|j| j.links.contains(&l)) {
            out.add(
                &at(l),
                ProblemKind::Unused {
                    link: link.id.clone(),
                },
            );
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
        for (l, link) in mechanism
            .links_with_ids()
            .filter(|(l, _)| !reached.contains(l))
        {
            let here = joints
                .iter()
                .any(|&j| mechanism.joints[j].links.contains(&l));
            if here || (s == StateId::FREE && link.role == Role::Output) {
                out.add(
                    &at(l),
                    ProblemKind::Disconnected {
                        link: link.id.clone(),
                        state: state.clone(),
                    },
                );
            }
        }
    }
}

pub(crate) fn contours(
    file: &MechanismFile,
    mechanism: &Mechanism,
    out: &mut Findings,
) -> Vec<Vec<JointId>> {
    let mut contours = Vec::new();
    for (i, entry) in file.contour.iter().enumerate() {
        let at = [
            DocumentStep::Key("contour".to_owned()),
            DocumentStep::Index(i),
            DocumentStep::Key("joints".to_owned()),
        ];
        let joints: Vec<JointId> = entry
            .joints
            .iter()
            .enumerate()
            .filter_map(|(n, id)| joint_by_id(mechanism, id, &index(&at, n), out))
            .collect();
        if joints.len() == entry.joints.len() && closed_walk(mechanism, &joints).is_none() {
            out.add(&at, ProblemKind::OpenContour);
        }
        contours.push(joints);
    }
    contours
}
