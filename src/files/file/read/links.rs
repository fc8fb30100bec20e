//! The links.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::names::check_id;
use crate::file::read::workload::loads::mass;
use crate::file::schema::{MechanismFile, Words};
use crate::model::mechanism::{Link, Role};
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
