//! Moments, stiffness of joints, and misaligned joints in `[workload]`.

use crate::file::Place;
use crate::file::read::value::quantity::Bound;
use crate::file::read::workload::motion::MAX_FORCES;
use crate::file::schema::WorkloadEntry;
use crate::model::joint_type::JointType;
use crate::model::loads::{ExternalMoment, Face, Misalignment, Stiffness};
use crate::model::mechanism::Mechanism;
use crate::statics::reactions::contact::object_at;

/// Returns the external moments.
pub(crate) fn moments(entry: &WorkloadEntry, m: &Mechanism, at: &Place<'_>) -> Vec<ExternalMoment> {
    let mut found = Vec::new();
    for (at, e) in at.most(MAX_FORCES, &entry.moment, "moments") {
        let moment = at.key("moment").vector(&e.moment);
        let link = at.key("link").link(&m.links, &e.link);
        let states = at.key("state").states(m, e.state.as_ref());
        found.extend(link.map(|link| ExternalMoment {
            link,
            moment,
            states,
        }));
    }
    found
}

/// Returns the faces of contacts.
pub(crate) fn faces(entry: &WorkloadEntry, m: &Mechanism, at: &Place<'_>) -> Vec<Face> {
    let mut found = Vec::new();
    for (at, e) in at.most(MAX_FORCES, &entry.contact, "contacts") {
        let Some(joint) = at.key("joint").joint(m, &e.joint) else {
            continue;
        };
        if object_at(m, joint).is_none() {
            let faces = m.joint_ids().filter(|&j| object_at(m, j).is_some());
            let what = "contact (a fixed or planar joint, or one on a plane, with a link of the role object)";
            at.key("joint")
                .unknown(what, &e.joint, faces.map(|j| &m.joints[j].id));
        }
        let range = Bound::Range(0.0, 10.0, "a number from 0 to 10");
        found.push(Face {
            joint,
            friction: at.optional("friction", &e.friction, 1.0, range),
            radius: at.positive("radius", &e.radius, 1.0),
        });
    }
    found
}

/// Returns the stiffness by joint type.
pub(crate) fn stiffness(entry: &WorkloadEntry, at: &Place<'_>) -> Vec<(String, Stiffness)> {
    let each = entry.stiffness.iter().map(|(name, s)| {
        let at = at.key(name);
        let (linear, angular) = (s.linear, s.angular);
        for (k, value) in [("linear", linear), ("angular", angular)] {
            if !(value > 0.0 && value <= 1e18) {
                at.key(k)
                    .bad("stiffness", value, "a number above 0, up to 1e18");
            }
        }
        if name != "default" && name != "custom" && JointType::from_name(name).is_none() {
            let types = JointType::NAMED.iter().map(JointType::name);
            at.unknown("joint type", name, types.chain(["custom", "default"]));
        }
        (
            JointType::word(name).to_owned(),
            Stiffness { linear, angular },
        )
    });
    each.collect()
}

/// Returns the misaligned joints.
pub(crate) fn misalignments(
    entry: &WorkloadEntry,
    m: &Mechanism,
    at: &Place<'_>,
) -> Vec<Misalignment> {
    let mut found = Vec::new();
    for (at, e) in at.most(MAX_FORCES, &entry.misalignment, "misalignments") {
        let angle = e.angle.as_ref().map(|angle| at.key("angle").turn(angle));
        if angle.is_some() == e.length.is_some() {
            at.bad("misalignment", &e.joint, "either an angle or a length");
        }
        let axis = ["x", "y", "z"].iter().position(|a| *a == e.axis);
        if axis.is_none() {
            at.key("axis").unknown("axis", &e.axis, ["x", "y", "z"]);
        }
        let joint = at.key("joint").joint(m, &e.joint);
        if let (Some(joint), Some(axis)) = (joint, axis) {
            let along = |size: Option<f64>| {
                let mut of = [0.0; 3];
                of[axis] = size.unwrap_or(0.0);
                of
            };
            found.push(Misalignment {
                joint,
                turn: along(angle),
                shift: along(e.length.map(|x| x * m.length_unit.metres)),
            });
        }
    }
    found
}
