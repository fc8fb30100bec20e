//! Names: of links and joints as they are declared, and as others refer to them.

use crate::import::locate::Step;
use crate::import::problem::ProblemKind;
use crate::import::resolve::Findings;
use crate::model::mechanism::{JointId, Mechanism};
use itertools::Itertools;

pub(super) fn check_id(
    what: &'static str,
    id: &str,
    earlier: bool,
    path: &[Step],
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

pub(super) fn joint_by_id(
    mechanism: &Mechanism,
    id: &str,
    path: &[Step],
    out: &mut Findings,
) -> Option<JointId> {
    let found = mechanism.joint(id);
    if found.is_none() {
        let known = mechanism
            .joints
            .iter()
            .take(30)
            .map(|j| j.id.as_str())
            .join(", ");
        out.add(
            path,
            ProblemKind::UnknownJoint {
                id: id.to_owned(),
                known,
            },
        );
    }
    found
}
