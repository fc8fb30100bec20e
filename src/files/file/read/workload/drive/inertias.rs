//! The inertias on the bar: discs, given by figures or by a link, and a payload.

use crate::file::Place;
use crate::file::read::workload::grip::MECHANISM;
use crate::file::schema::DriveEntry;
use crate::geom::vector::{dot, real, scale, sub};
use crate::model::drive::Payload;
use crate::model::joint_type::JointType;
use crate::model::loads::Inertia;
use crate::model::mechanism::{Mechanism, StateId};

/// Reports a key that the table lacks.
pub(super) fn lacks(t: &Place<'_>, other: &str) {
    t.add(format!("drive needs {other}"));
}

/// Returns the inertia of a link about the axis of its joint with the frame.
fn link_inertia(t: &Place<'_>, id: &str, unit: f64, mechanism: Option<&Mechanism>) -> Option<f64> {
    let key = "disc_link";
    let Some(m) = mechanism else {
        t.needs(key, MECHANISM);
        return None;
    };
    let l = t.key(key).link(&m.links, id)?;
    let hinge = m.joints_in(StateId::FREE).map(|j| &m.joints[j]).find(|j| {
        j.joint_type == JointType::Revolute && j.links.contains(&l) && j.links.contains(&m.frame())
    });
    let mass = m.links[l].mass.as_ref();
    let mass = mass.and_then(|p| Some((p, p.inertia.as_ref()?)));
    let (Some(hinge), Some((body, inertia))) = (hinge, mass) else {
        let other = "a link with mass, centre and inertia, and a revolute joint to the frame";
        t.needs(key, other);
        return None;
    };
    let (axis, point) = (real(&hinge.frame.axis), real(&hinge.frame.point));
    let size = dot(axis, axis).sqrt();
    let [x, y, z] = axis.map(|c| c / size);
    let about = match *inertia {
        Inertia::Plane(i) => i,
        Inertia::Principal([a, b, c]) => a * x * x + b * y * y + c * z * z,
        Inertia::Tensor([xx, yy, zz, xy, yz, zx]) => {
            xx * x * x + yy * y * y + zz * z * z + 2.0 * (xy * x * y + yz * y * z + zx * z * x)
        }
    };
    let from = scale(sub(real(&body.centre), point), unit);
    let along = dot(from, [x, y, z]);
    Some(about + body.mass * (dot(from, from) - along * along).max(0.0))
}

/// Returns the inertia of the bare disc, from its figure or its link.
fn disc_inertia(
    t: &Place<'_>,
    e: &DriveEntry,
    unit: f64,
    mechanism: Option<&Mechanism>,
) -> Option<f64> {
    let disc = t.not_negative("disc_inertia", &e.disc_inertia, 1.0);
    match (disc, &e.disc_link) {
        (Some(_), Some(_)) => {
            t.excludes("disc_link", "disc_inertia");
            disc
        }
        (None, Some(id)) => Some(link_inertia(t, id, unit, mechanism).unwrap_or(1.0)),
        (_, None) => disc,
    }
}

/// Inertias of the discs with what they carry, and the payload.
pub(crate) fn inertias(
    t: &Place<'_>,
    e: &DriveEntry,
    unit: f64,
    mechanism: Option<&Mechanism>,
) -> ([f64; 2], Option<Payload>) {
    let mass = t.positive("payload_mass", &e.payload_mass, 1.0);
    let radius = t.not_negative("payload_radius", &e.payload_radius, unit);
    let disc = disc_inertia(t, e, unit, mechanism);
    let whole = t.positive("inertia", &e.inertia, 1.0);
    match (mass, radius) {
        (Some(_), None) => t.needs("payload_mass", "payload_radius"),
        (None, Some(_)) if whole.is_none() => t.needs("payload_radius", "payload_mass"),
        _ => {}
    }
    // Of a whole inertia the radius alone tells how far out accelerations are wanted.
    let mass = mass.or(whole.map(|_| 0.0));
    let payload = mass.zip(radius);
    let payload = payload.map(|(mass, radius)| Payload { mass, radius });
    let Some(first) = loaded_inertia(t, whole, disc, payload) else {
        return ([1.0; 2], payload);
    };
    let second = t.positive("second_inertia", &e.second_inertia, 1.0);
    ([first, second.unwrap_or(first)], payload)
}

/// Returns the inertia of a disc with its payload: the given sum, or the sum of both; `None` if neither has an inertia.
fn loaded_inertia(
    t: &Place<'_>,
    whole: Option<f64>,
    disc: Option<f64>,
    payload: Option<Payload>,
) -> Option<f64> {
    match (whole, disc) {
        (Some(i), None) => return Some(i),
        (Some(_), Some(_)) => t.excludes("disc_inertia", "inertia"),
        (None, Some(disc)) => {
            let sum = disc + payload.map_or(0.0, |p| p.mass * p.radius * p.radius);
            if sum <= 0.0 {
                let allowed = "a disc or a payload with an inertia above 0";
                t.key("disc_inertia").bad("inertia", sum, allowed);
                return None;
            }
            return Some(sum);
        }
        (None, None) => {
            let other = "inertia, or disc_inertia with payload_mass and payload_radius";
            lacks(t, other);
        }
    }
    Some(1.0)
}
