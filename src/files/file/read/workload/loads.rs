//! Masses of links and the `[workload]` table.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::problem::ProblemKind;
use crate::file::read::value::names::{link_by_id, states_by_name};
use crate::file::read::value::number::vector;
use crate::file::read::workload::joint_loads::{faces, misalignments, moments, stiffness};
use crate::file::read::workload::motion::{
    LARGEST, MAX_FORCES, MAX_STEPS, POSITION, SPEED, position, quantity, speed,
};
use crate::file::schema::{
    ForceEntry, InertiaEntry, LinkEntry, MechanismFile, Quantities, Quantity, StrokeEntry,
};
use crate::model::loads::{ExternalForce, Inertia, Loads, MassProperties, Stroke};
use crate::model::mechanism::Mechanism;

/// What inertias and masses may be.
const NOT_NEGATIVE: &str = "a number from 0 to 1e12";

/// Whether a mass or an inertia is in range.
fn fits(x: f64) -> bool {
    (0.0..=LARGEST).contains(&x)
}

/// Notes a figure of a link that will not do.
fn bad(
    out: &mut Findings,
    path: &[DocumentStep],
    what: &'static str,
    value: String,
    allowed: &'static str,
) {
    let kind = ProblemKind::BadQuantity {
        what,
        value,
        allowed,
    };
    out.add(path, kind);
}

/// Inertia about the mass centre, where an entry states one that is in range.
fn inertia(
    entry: Option<&InertiaEntry>,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Option<Inertia> {
    match entry? {
        InertiaEntry::Plane(x) if fits(*x) => Some(Inertia::Plane(*x)),
        InertiaEntry::Plane(x) => {
            bad(out, path, "inertia", x.to_string(), NOT_NEGATIVE);
            None
        }
        InertiaEntry::List(v) => {
            let diagonal = v.iter().take(3).all(|x| fits(*x));
            let finite = v.iter().all(|x| x.abs() <= LARGEST);
            match v[..] {
                [a, b, c] if diagonal => Some(Inertia::Principal([a, b, c])),
                [a, b, c, d, e, f] if diagonal && finite => {
                    Some(Inertia::Tensor([a, b, c, d, e, f]))
                }
                _ => {
                    let allowed = "one number, 3 about the axes or 6 of a tensor, those on the diagonal from 0 to 1e12";
                    bad(out, path, "inertia", format!("{v:?}"), allowed);
                    None
                }
            }
        }
    }
}

/// The mass of a link, where its entry states one.
pub(crate) fn mass(
    entry: &LinkEntry,
    at: &[DocumentStep],
    out: &mut Findings,
) -> Option<MassProperties> {
    let centre = entry
        .centre
        .as_ref()
        .map(|c| vector(c, &key(at, "centre"), out));
    let inertia = inertia(entry.inertia.as_ref(), &key(at, "inertia"), out);
    if let Some(x) = entry.mass.filter(|&x| !fits(x)) {
        bad(out, &key(at, "mass"), "mass", x.to_string(), NOT_NEGATIVE);
    }
    let missing = match (entry.mass, &centre, &entry.inertia) {
        (Some(mass), Some(centre), _) => {
            return Some(MassProperties {
                mass,
                centre: centre.clone(),
                inertia,
            });
        }
        (None, None, None) => return None,
        (Some(_), None, _) => "centre, its mass centre at the pose of the file",
        (None, _, _) => "mass, in kg",
    };
    out.add(
        at,
        ProblemKind::LinkNeeds {
            link: entry.id.clone(),
            what: missing,
        },
    );
    None
}

/// The `[workload]` table.
pub(crate) fn loads(file: &MechanismFile, mechanism: &Mechanism, out: &mut Findings) -> Loads {
    let at = [DocumentStep::Key("workload".to_owned())];
    let entry = &file.workload;
    let mut forces = Vec::new();
    let path = key(&at, "force");
    let entries = out.at_most(MAX_FORCES, &entry.force, "forces", &path);
    for (i, f) in entries.iter().enumerate() {
        forces.extend(force(f, &index(&path, i), mechanism, out));
    }
    let moments = moments(entry, mechanism, &at, out);
    let stiffness = stiffness(entry, &at, out);
    let faces = faces(entry, mechanism, &at, out);
    let misalignments = misalignments(entry, mechanism, &at, out);
    let path = key(&at, "drive_speed");
    let drive_speeds = drive_speeds(entry.drive_speed.as_ref(), mechanism, &path, out);
    Loads {
        gravity: entry
            .gravity
            .as_ref()
            .map(|g| vector(g, &key(&at, "gravity"), out)),
        forces,
        moments,
        faces,
        stiffness,
        misalignments,
        drive_speeds,
        stroke: entry
            .stroke
            .as_ref()
            .map(|s| stroke(s, &key(&at, "stroke"), out)),
        // These name joints and links; they are read once all of those are.
        grip: None,
        drive: None,
    }
}

/// A force from outside, where its link is known.
fn force(
    f: &ForceEntry,
    at: &[DocumentStep],
    mechanism: &Mechanism,
    out: &mut Findings,
) -> Option<ExternalForce> {
    let point = vector(&f.point, &key(at, "point"), out);
    let force = vector(&f.force, &key(at, "force"), out);
    let mut end = |q: &Option<Quantity>, k: &str, open: f64| {
        q.as_ref().map_or(open, |q| {
            quantity(q, position, "drive position", POSITION, &key(at, k), out)
        })
    };
    let from = end(&f.from, "from", f64::NEG_INFINITY);
    let to = end(&f.to, "to", f64::INFINITY);
    if from > to {
        out.add(
            &key(at, "to"),
            ProblemKind::BadQuantity {
                what: "end of the range",
                value: to.to_string(),
                allowed: "at or after its beginning",
            },
        );
    }
    let states = states_by_name(mechanism, f.state.as_ref(), &key(at, "state"), out);
    let link = link_by_id(&mechanism.links, &f.link, &key(at, "link"), out)?;
    Some(ExternalForce {
        link,
        point,
        force,
        range: (f.from.is_some() || f.to.is_some()).then_some([from, to]),
        states,
    })
}

/// The speeds of the drives, no more of them than there are drives.
fn drive_speeds(
    entry: Option<&Quantities>,
    mechanism: &Mechanism,
    path: &[DocumentStep],
    out: &mut Findings,
) -> Vec<f64> {
    let speeds = match entry {
        None => Vec::new(),
        Some(Quantities::One(q)) => vec![quantity(q, speed, "drive speed", SPEED, path, out)],
        Some(Quantities::Many(list)) => list
            .iter()
            .enumerate()
            .map(|(i, q)| quantity(q, speed, "drive speed", SPEED, &index(path, i), out))
            .collect(),
    };
    let drives = mechanism.joints.iter().filter(|j| j.drive).count();
    if speeds.len() > drives {
        out.add(
            path,
            ProblemKind::TooMany {
                what: "drive speeds",
                count: speeds.len(),
                limit: drives,
            },
        );
    }
    speeds
}

fn stroke(s: &StrokeEntry, at: &[DocumentStep], out: &mut Findings) -> Stroke {
    let from = quantity(
        &s.from,
        position,
        "drive position",
        POSITION,
        &key(at, "from"),
        out,
    );
    let to = quantity(
        &s.to,
        position,
        "drive position",
        POSITION,
        &key(at, "to"),
        out,
    );
    let steps = usize::try_from(s.steps).unwrap_or(0);
    if !(1..=MAX_STEPS).contains(&steps) {
        out.add(
            &key(at, "steps"),
            ProblemKind::BadQuantity {
                what: "number of steps",
                value: s.steps.to_string(),
                allowed: "a whole number from 1 to 100000",
            },
        );
    }
    Stroke { from, to, steps }
}
