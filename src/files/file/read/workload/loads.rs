//! Masses of links and the `[workload]` table.

use crate::file::prelude::*;
use crate::file::read::value::quantity::Bound;
use crate::file::read::value::used_twice;
use crate::file::read::workload::motion::{LARGEST, MAX_FORCES, MAX_STEPS};
use crate::model::loads::{
    Accuracy, ExternalForce, ExternalMoment, Face, Inertia, Loads, MassProperties, Misalignment,
    Stiffness, Stroke, Tolerances,
};
use crate::statics::reactions::contact::object_at;

/// The allowed range of inertias and masses.
const NOT_NEGATIVE: &str = "a number from 0 to 1e12";

/// Returns true if a mass or an inertia is in range.
fn is_in_range(x: f64) -> bool {
    (0.0..=LARGEST).contains(&x)
}

/// Returns the inertia about the centre of mass, if an entry gives one that is in range.
fn read_inertia(entry: Option<&InertiaEntry>, at: &Place<'_>) -> Option<Inertia> {
    let list = match entry? {
        InertiaEntry::Plane(x) if is_in_range(*x) => return Some(Inertia::Plane(*x)),
        InertiaEntry::Plane(x) => {
            at.add_bad_value("inertia", x, NOT_NEGATIVE);
            return None;
        }
        InertiaEntry::List(list) => list,
    };
    let diagonal = list.iter().take(3).all(|x| is_in_range(*x));
    let finite = list.iter().all(|x| x.abs() <= LARGEST);
    match list[..] {
        [a, b, c] if diagonal => Some(Inertia::Principal([a, b, c])),
        [a, b, c, d, e, f] if diagonal && finite => Some(Inertia::Tensor([a, b, c, d, e, f])),
        _ => {
            let allowed = "one number, 3 about the axes or 6 of a tensor, those on the diagonal from 0 to 1e12";
            at.add_bad_value("inertia", format!("{list:?}"), allowed);
            None
        }
    }
}

/// Returns the mass of a link, if its entry gives one.
pub(crate) fn read_mass(entry: &LinkEntry, at: &Place<'_>) -> Option<MassProperties> {
    let centre = at.read_given("centre", entry.centre.as_ref(), Place::read_vector);
    let inertia = read_inertia(entry.inertia.as_ref(), &at.key("inertia"));
    if let Some(x) = entry.mass.filter(|&x| !is_in_range(x)) {
        at.key("mass").add_bad_value("mass", x, NOT_NEGATIVE);
    }
    let what = match (entry.mass, centre) {
        (Some(mass), Some(centre)) => {
            return Some(MassProperties {
                mass,
                centre,
                inertia,
            });
        }
        (None, None) if entry.inertia.is_none() => return None,
        (Some(_), None) => "centre, its mass centre at the pose of the file",
        (None, _) => "mass, in kg",
    };
    let link = &entry.id;
    let problem = format!("link \"{link}\" has incomplete mass data; add {what}");
    at.add_problem(problem);
    None
}

/// Reads the `[workload]` table.
pub(crate) fn read_loads(file: &MechanismFile, mechanism: &Parts, out: &Findings) -> Loads {
    let (at, entry) = (&out.key("workload"), &file.workload);
    let forces = at.key("force");
    let forces = forces.first_entries(MAX_FORCES, &entry.force, "forces");
    let forces = forces.filter_map(|(at, f)| read_force(f, mechanism, &at));
    let moments = read_moments(entry, mechanism, &at.key("moment"));
    let stiffness = read_stiffness(entry, &at.key("stiffness"));
    let faces = read_faces(entry, mechanism, &at.key("contact"));
    let misalignments = read_misalignments(entry, mechanism, &at.key("misalignment"));
    let speeds = entry.drive_speed.as_ref();
    let drive_speeds = drive_speeds(speeds, mechanism, &at.key("drive_speed"));
    Loads {
        gravity: at.read_given("gravity", entry.gravity.as_ref(), Place::read_vector),
        forces: forces.collect(),
        moments,
        faces,
        stiffness,
        misalignments,
        accuracy: read_accuracy(file, mechanism, &out.key("tolerances")),
        drive_speeds,
        stroke: at.read_given("stroke", entry.stroke.as_ref(), read_stroke),
        // These name joints and links; they are read once all of those are.
        grip: None,
        drive: None,
    }
}

/// Returns an external force, if its link is known.
fn read_force(f: &ForceEntry, mechanism: &Parts, at: &Place<'_>) -> Option<ExternalForce> {
    let point = at.key("point").read_vector(&f.point);
    let force = at.key("force").read_vector(&f.force);
    let end = |q: &Option<Quantity>, k: &str| q.as_ref().map(|q| at.key(k).read_position(q));
    let from = end(&f.from, "from").unwrap_or(f64::NEG_INFINITY);
    let to = end(&f.to, "to").unwrap_or(f64::INFINITY);
    if from > to {
        at.key("to")
            .add_bad_value("end of the range", to, "at or after its beginning");
    }
    let states = at.key("state").find_states(f.state.as_ref());
    Some(ExternalForce {
        link: at.key("link").read_link(&mechanism.links, &f.link)?,
        point,
        force,
        range: (f.from.is_some() || f.to.is_some()).then_some([from, to]),
        states,
    })
}

/// Returns the speeds of the drives, at most one per drive.
fn drive_speeds(entry: Option<&Quantities>, mechanism: &Parts, at: &Place<'_>) -> Vec<f64> {
    let speeds = match entry {
        None => Vec::new(),
        Some(Quantities::One(q)) => vec![at.read_speed(q)],
        Some(Quantities::Many(list)) => at
            .each_entry(list)
            .map(|(at, q)| at.read_speed(q))
            .collect(),
    };
    let drives = mechanism.joints.iter().filter(|j| j.drive).count();
    at.count_within(drives, speeds.len(), "drive speeds");
    speeds
}

fn read_stroke(at: &Place<'_>, s: &StrokeEntry) -> Stroke {
    let from = at.key("from").read_position(&s.from);
    let to = at.key("to").read_position(&s.to);
    let allowed = "a whole number from 1 to 100000";
    let at = at.key("steps");
    let steps = at.number_of("number of steps", s.steps, MAX_STEPS, allowed);
    Stroke {
        from,
        to,
        steps: steps.unwrap_or(0),
    }
}

/// Returns the external moments.
fn read_moments(entry: &WorkloadEntry, m: &Parts, at: &Place<'_>) -> Vec<ExternalMoment> {
    let mut found = Vec::new();
    for (at, e) in at.first_entries(MAX_FORCES, &entry.moment, "moments") {
        let moment = at.key("moment").read_vector(&e.moment);
        let link = at.key("link").read_link(&m.links, &e.link);
        let states = at.key("state").find_states(e.state.as_ref());
        found.extend(link.map(|link| ExternalMoment {
            link,
            moment,
            states,
        }));
    }
    found
}

/// Returns the faces of contacts.
fn read_faces(entry: &WorkloadEntry, m: &Parts, at: &Place<'_>) -> Vec<Face> {
    let mut found = Vec::new();
    for (at, e) in at.first_entries(MAX_FORCES, &entry.contact, "contacts") {
        let Some(joint) = at.key("joint").find_joint(m, &e.joint) else {
            continue;
        };
        if object_at(m, joint).is_none() {
            let faces = m.joint_ids().filter(|&j| object_at(m, j).is_some());
            let what = "contact (a fixed or planar joint, or one on a plane, with a link of the role object)";
            let known = faces.map(|j| &m.joints[j].id);
            at.key("joint").add_unknown_word(what, &e.joint, known);
        }
        let range = Bound::Range(0.0, 10.0, "a number from 0 to 10");
        found.push(Face {
            joint,
            friction: at.read_optional("friction", &e.friction, 1.0, range),
            radius: at.read_positive("radius", &e.radius, 1.0),
        });
    }
    found
}

/// Returns the stiffness by joint type.
fn read_stiffness(entry: &WorkloadEntry, at: &Place<'_>) -> Vec<(String, Stiffness)> {
    let each = entry.stiffness.iter().map(|(name, s)| {
        let at = at.key(name);
        let (linear, angular) = (s.linear, s.angular);
        for (k, value) in [("linear", linear), ("angular", angular)] {
            if !(value > 0.0 && value <= 1e18) {
                let allowed = "a number above 0, up to 1e18";
                at.key(k).add_bad_value("stiffness", value, allowed);
            }
        }
        if name != "default" && name != "custom" && JointType::from_name(name).is_none() {
            let types = JointType::NAMED.iter().map(JointType::name);
            at.add_unknown_word("joint type", name, types.chain(["custom", "default"]));
        }
        let name = JointType::word_of_trade(name).to_owned();
        (name, Stiffness { linear, angular })
    });
    each.collect()
}

/// Returns the misaligned joints.
fn read_misalignments(entry: &WorkloadEntry, m: &Parts, at: &Place<'_>) -> Vec<Misalignment> {
    let mut found = Vec::new();
    for (at, e) in at.first_entries(MAX_FORCES, &entry.misalignment, "misalignments") {
        let angle = at.read_given("angle", e.angle.as_ref(), Place::read_turn);
        if angle.is_some() == e.length.is_some() {
            at.add_bad_value("misalignment", &e.joint, "either an angle or a length");
        }
        let axis = ["x", "y", "z"].iter().position(|a| *a == e.axis);
        if axis.is_none() {
            at.key("axis")
                .add_unknown_word("axis", &e.axis, ["x", "y", "z"]);
        }
        let joint = at.key("joint").find_joint(m, &e.joint);
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

/// Returns the accuracy of the joints, if the file states it.
fn read_accuracy(file: &MechanismFile, m: &Parts, at: &Place<'_>) -> Option<Accuracy> {
    let entry = file.tolerances.as_ref()?;
    let mut out = Accuracy::default();
    let of_fit = at.key("fit");
    if let Some(fit) = &entry.fit {
        match Tolerances::named(fit) {
            Some(named) => out.usual = named,
            None => of_fit.add_unknown_word("fit", fit, Tolerances::NAMES),
        }
    }
    let read = |at: &Place<'_>,
                position: &Option<Coordinate>,
                angle: &Option<Quantity>,
                other: Tolerances| {
        let position = at.not_negative("position", position, m.length_unit.metres);
        let angle = angle.as_ref().map(|q| at.key("angle").read_turn(q));
        if let Some(x) = angle.filter(|x| !(0.0..=1.0).contains(x)) {
            at.key("angle")
                .add_bad_value("tolerance of the direction", x, "from 0 to 1 radian");
        }
        Tolerances {
            position: position.unwrap_or(other.position),
            angle: angle.unwrap_or(other.angle),
        }
    };
    out.usual = read(at, &entry.position, &entry.angle, out.usual);
    if let Some(force) = at.not_negative("hand_force", &entry.hand_force, 1.0) {
        out.hand_force = force;
    }
    let joints = at.key("joint");
    for (at, e) in joints.first_entries(MAX_FORCES, &entry.joint, "joints with tolerances") {
        let tolerances = read(&at, &e.position, &e.angle, out.usual);
        let Some(joint) = at.key("joint").find_joint(m, &e.joint) else {
            continue;
        };
        if out.joints.iter().any(|(j, _)| *j == joint) {
            at.key("joint")
                .add_problem(used_twice("[tolerances]", &e.joint));
        }
        out.joints.push((joint, tolerances));
    }
    Some(out)
}
