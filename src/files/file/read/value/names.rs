//! Names of links and joints: as they are declared, and as others refer to them.

use crate::file::Findings;
use crate::file::locate::DocumentStep;
use crate::file::problem::ProblemKind;
use crate::file::schema::Words;
use crate::model::mechanism::{JointId, Link, LinkId, Mechanism, StateId};
use itertools::Itertools;

/// Most names listed where one is not known.
const LISTED: usize = 30;

pub(crate) fn check_id(
    what: &'static str,
    id: &str,
    earlier: bool,
    path: &[DocumentStep],
    out: &mut Findings,
) {
    if id.is_empty() || id.chars().count() > 64 || id.chars().any(char::is_control) {
        out.add(path, ProblemKind::BadId { id: id.to_owned() });
    }
    if earlier {
        out.add(
            path,
            ProblemKind::Duplicate {
                what,
                id: id.to_owned(),
            },
        );
    }
}

/// The link that an entry means.
pub(crate) fn link_by_id(
    links: &[Link],
    id: &str,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<LinkId> {
    let found = links.iter().position(|l| l.id == *id).map(LinkId::new);
    if found.is_none() {
        let mut known = links.iter().take(LISTED).map(|l| l.id.as_str());
        out.add(
            path,
            ProblemKind::UnknownLink {
                id: id.to_owned(),
                known: known.join(", "),
            },
        );
    }
    found
}

/// The states that an entry names; `None` where it names none, which means all.
pub(crate) fn states_by_name(
    mechanism: &Mechanism,
    named: Option<&Words>,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<Vec<StateId>> {
    let words = match named? {
        Words::One(word) => std::slice::from_ref(word),
        Words::Many(words) => words,
    };
    let mut found = Vec::new();
    for word in words {
        match mechanism.state(word) {
            Some(state) => found.push(state),
            None => out.add(
                path,
                ProblemKind::UnknownWord {
                    what: "state",
                    word: word.clone(),
                    known: mechanism.states.iter().take(LISTED).join(", "),
                },
            ),
        }
    }
    Some(found)
}

/// The joint that an entry means.
pub(crate) fn joint_by_id(
    mechanism: &Mechanism,
    id: &str,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<JointId> {
    let found = mechanism.joint(id);
    if found.is_none() {
        let joints = mechanism.joints.iter();
        let mut known = joints.take(LISTED).map(|j| j.id.as_str());
        out.add(
            path,
            ProblemKind::UnknownJoint {
                id: id.to_owned(),
                known: known.join(", "),
            },
        );
    }
    found
}
