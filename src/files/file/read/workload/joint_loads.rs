//! What `[workload]` says of moments, of the stiffness of joints, and of joints made askew.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::names::{joint_by_id, link_by_id, states_by_name};
use crate::file::read::value::number::vector;
use crate::file::read::value::quantity::{Bound, ValueTable};
use crate::file::read::workload::motion::{MAX_FORCES, position, quantity};
use crate::file::schema::WorkloadEntry;
use crate::model::joint_type::JointType;
use crate::model::loads::{ExternalMoment, Face, Misalignment, Stiffness};
use crate::model::mechanism::Mechanism;
use crate::statics::reactions::contact::object_at;
use itertools::Itertools;

/// Moments from outside.
pub(crate) fn moments(
    entry: &WorkloadEntry,
    mechanism: &Mechanism,
    at: &[DocumentStep],
    out: &mut Findings,
) -> Vec<ExternalMoment> {
    let mut found = Vec::new();
    let path = key(at, "moment");
    let entries = out.at_most(MAX_FORCES, &entry.moment, "moments", &path);
    for (i, m) in entries.iter().enumerate() {
        let at = index(&path, i);
        let moment = vector(&m.moment, &key(&at, "moment"), out);
        let link = link_by_id(&mechanism.links, &m.link, &key(&at, "link"), out);
        let states = states_by_name(mechanism, m.state.as_ref(), &key(&at, "state"), out);
        found.extend(link.map(|link| ExternalMoment {
            link,
            moment,
            states,
        }));
    }
    found
}

/// Faces of contacts.
pub(crate) fn faces(
    entry: &WorkloadEntry,
    mechanism: &Mechanism,
    at: &[DocumentStep],
    out: &mut Findings,
) -> Vec<Face> {
    let mut found = Vec::new();
    let path = key(at, "contact");
    let entries = out.at_most(MAX_FORCES, &entry.contact, "contacts", &path);
    for (i, e) in entries.iter().enumerate() {
        let at = index(&path, i);
        let Some(joint) = joint_by_id(mechanism, &e.joint, &key(&at, "joint"), out) else {
            continue;
        };
        if object_at(mechanism, joint).is_none() {
            let faces = mechanism
                .joint_ids()
                .filter(|&j| object_at(mechanism, j).is_some());
            let known = faces.map(|j| mechanism.joints[j].id.as_str()).join(", ");
            let kind = ProblemKind::UnknownWord {
                what: "contact (a fixed or planar joint, or one on a plane, with a link of the role object)",
                word: e.joint.clone(),
                known,
            };
            out.add(&key(&at, "joint"), kind);
        }
        let t = &mut ValueTable { at, out };
        let range = Bound::Range(0.0, 10.0, "a number from 0 to 10");
        found.push(Face {
            joint,
            friction: t.optional("friction", e.friction.as_ref(), 1.0, range),
            radius: t.positive("radius", &e.radius, 1.0),
        });
    }
    found
}

/// Stiffness by joint type.
pub(crate) fn stiffness(
    entry: &WorkloadEntry,
    at: &[DocumentStep],
    out: &mut Findings,
) -> Vec<(String, Stiffness)> {
    let at = key(at, "stiffness");
    for (name, s) in &entry.stiffness {
        for (k, what, value) in [
            ("linear", "stiffness", s.linear),
            ("angular", "stiffness", s.angular),
        ] {
            if !(value > 0.0 && value <= 1e18) {
                out.add(
                    &key(&key(&at, name), k),
                    ProblemKind::BadQuantity {
                        what,
                        value: value.to_string(),
                        allowed: "a number above 0, up to 1e18",
                    },
                );
            }
        }
        if name != "default" && name != "custom" && JointType::from_name(name).is_none() {
            let types = JointType::NAMED.iter().map(JointType::name);
            out.add(
                &key(&at, name),
                ProblemKind::UnknownWord {
                    what: "joint type",
                    word: name.clone(),
                    known: types.chain(["custom", "default"]).join(", "),
                },
            );
        }
    }
    let each = entry.stiffness.iter().map(|(name, s)| {
        let (linear, angular) = (s.linear, s.angular);
        (name.clone(), Stiffness { linear, angular })
    });
    each.collect()
}

/// Joints made askew.
pub(crate) fn misalignments(
    entry: &WorkloadEntry,
    mechanism: &Mechanism,
    at: &[DocumentStep],
    out: &mut Findings,
) -> Vec<Misalignment> {
    let mut found = Vec::new();
    let path = key(at, "misalignment");
    let entries = out.at_most(MAX_FORCES, &entry.misalignment, "misalignments", &path);
    for (i, m) in entries.iter().enumerate() {
        let at = index(&path, i);
        let angle = m.angle.as_ref().map(|angle| {
            quantity(
                angle,
                position,
                "angle",
                "a number of radians, or an angle such as \"0.1deg\"",
                &key(&at, "angle"),
                out,
            )
        });
        if angle.is_some() == m.length.is_some() {
            out.add(
                &at,
                ProblemKind::BadQuantity {
                    what: "misalignment",
                    value: m.joint.clone(),
                    allowed: "either an angle or a length",
                },
            );
        }
        let axis = ["x", "y", "z"].iter().position(|a| *a == m.axis);
        if axis.is_none() {
            out.add(
                &key(&at, "axis"),
                ProblemKind::UnknownWord {
                    what: "axis",
                    word: m.axis.clone(),
                    known: "x, y, z".to_owned(),
                },
            );
        }
        let joint = joint_by_id(mechanism, &m.joint, &key(&at, "joint"), out);
        if let (Some(joint), Some(axis)) = (joint, axis) {
            let along = |size: Option<f64>| {
                let mut of = [0.0; 3];
                of[axis] = size.unwrap_or(0.0);
                of
            };
            found.push(Misalignment {
                joint,
                turn: along(angle),
                shift: along(m.length.map(|x| x * mechanism.length_unit.metres)),
            });
        }
    }
    found
}
