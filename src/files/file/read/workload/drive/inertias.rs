//! What the bar swings: discs, given by figures or by a link, and a payload.

use crate::file::locate::key;
use crate::file::read::value::names::link_by_id;
use crate::file::read::value::quantity::ValueTable;
use crate::file::schema::DriveEntry;
use crate::geom::expr::Expr;
use crate::model::drive::Payload;
use crate::model::joint_type::JointType;
use crate::model::loads::Inertia;
use crate::model::mechanism::{Mechanism, StateId};

/// Inertia of a link about the axis it turns on the frame about.
fn link_inertia(
    t: &mut ValueTable<'_>,
    id: &str,
    unit: f64,
    mechanism: Option<&Mechanism>,
) -> Option<f64> {
    let path = key(&t.at, "disc_link");
    let Some(m) = mechanism else {
        t.needs(
            "disc_link",
            "a mechanism in the same file: links and joints",
        );
        return None;
    };
    let l = link_by_id(&m.links, id, &path, t.out)?;
    let hinge = m.joints_in(StateId::FREE).map(|j| &m.joints[j]).find(|j| {
        j.joint_type == JointType::Revolute && j.links.contains(&l) && j.links.contains(&m.frame())
    });
    let mass = m.links[l]
        .mass
        .as_ref()
        .and_then(|p| Some((p, p.inertia.as_ref()?)));
    let (Some(hinge), Some((body, inertia))) = (hinge, mass) else {
        t.needs(
            "disc_link",
            "a link with mass, centre and inertia, and a revolute joint to the frame",
        );
        return None;
    };
    let real = |v: &[Expr; 3]| [v[0].to_f64(), v[1].to_f64(), v[2].to_f64()];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (axis, centre, point) = (
        real(&hinge.frame.axis),
        real(&body.centre),
        real(&hinge.frame.point),
    );
    let size = dot(axis, axis).sqrt();
    let [x, y, z] = axis.map(|c| c / size);
    let about = match *inertia {
        Inertia::Plane(i) => i,
        Inertia::Principal([a, b, c]) => a * x * x + b * y * y + c * z * z,
        Inertia::Tensor([xx, yy, zz, xy, yz, zx]) => {
            xx * x * x + yy * y * y + zz * z * z + 2.0 * (xy * x * y + yz * y * z + zx * z * x)
        }
    };
    let from = [0, 1, 2].map(|i| (centre[i] - point[i]) * unit);
    let along = dot(from, [x, y, z]);
    Some(about + body.mass * (dot(from, from) - along * along).max(0.0))
}

/// Inertia of the bare disc, by its figure or by its link.
fn disc_inertia(
    t: &mut ValueTable<'_>,
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
    t: &mut ValueTable<'_>,
    e: &DriveEntry,
    unit: f64,
    mechanism: Option<&Mechanism>,
) -> ([f64; 2], Option<Payload>) {
    let mass = t.positive("payload_mass", &e.payload_mass, 1.0);
    let radius = t.not_negative("payload_radius", &e.payload_radius, unit);
    let disc = disc_inertia(t, e, unit, mechanism);
    let whole = t.positive("inertia", &e.inertia, 1.0);
    let payload = match (mass, radius) {
        (Some(mass), Some(radius)) => Some(Payload { mass, radius }),
        // The radius alone tells how far out accelerations are wanted.
        (None, Some(radius)) if whole.is_some() => Some(Payload { mass: 0.0, radius }),
        (None, None) => None,
        (Some(_), None) => {
            t.needs("payload_mass", "payload_radius beside it");
            None
        }
        (None, Some(_)) => {
            t.needs("payload_radius", "payload_mass beside it");
            None
        }
    };
    let Some(first) = loaded_inertia(t, whole, disc, payload) else {
        return ([1.0; 2], payload);
    };
    let second = t.positive("second_inertia", &e.second_inertia, 1.0);
    ([first, second.unwrap_or(first)], payload)
}

/// Inertia of a disc with its payload: as a whole, or as the sum of both; none where both are without inertia.
fn loaded_inertia(
    t: &mut ValueTable<'_>,
    whole: Option<f64>,
    disc: Option<f64>,
    payload: Option<Payload>,
) -> Option<f64> {
    match (whole, disc) {
        (Some(i), None) => Some(i),
        (Some(_), Some(_)) => {
            t.excludes("disc_inertia", "inertia");
            Some(1.0)
        }
        (None, Some(disc)) => {
            let sum = disc + payload.map_or(0.0, |p| p.mass * p.radius * p.radius);
            if sum <= 0.0 {
                let path = key(&t.at, "disc_inertia");
                t.bad(
                    &path,
                    "inertia",
                    sum.to_string(),
                    "a disc or a payload with an inertia above 0",
                );
                return None;
            }
            Some(sum)
        }
        (None, None) => {
            let at = t.at.clone();
            t.needs_at(
                &at,
                "drive",
                "inertia, or disc_inertia with payload_mass and payload_radius",
            );
            Some(1.0)
        }
    }
}
