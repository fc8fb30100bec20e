//! The contours the designer chose.

use crate::closure::contour::closed_walk;
use crate::file::findings::Findings;
use crate::file::locate::{DocumentStep, index};
use crate::file::problem::ProblemKind;
use crate::file::read::value::names::joint_by_id;
use crate::file::schema::MechanismFile;
use crate::model::mechanism::{JointId, Mechanism};

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
