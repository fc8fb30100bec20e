//! Every link hangs on the frame; and the contours that the designer chose.

use crate::closure::contour::closed_walk;
use crate::file::Findings;
use crate::file::locate::{DocumentStep, index};
use crate::file::problem::ProblemKind;
use crate::file::read::value::names::joint_by_id;
use crate::file::schema::MechanismFile;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};

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
