//! The `[workload.grip]` table.

use crate::file::prelude::*;
use crate::file::read::value::quantity::Bound;
use crate::model::grip::{GripLoad, GripSpec, LeverDrive, PartMass, Pivots, Toward, Transmission};

/// Standard gravity. `[m/s²]`
const GRAVITY: f64 = 9.80665;
/// Maximum number of diameters, and of accelerations.
const MOST: usize = 1000;

/// The keys for the mass of a part, which contacts and loads need.
const MASS: &str = "the mass of the part: mass, or density and part_length";
/// The condition for keys that name joints or links.
pub(super) const MECHANISM: &str = "a mechanism in the same file: links and joints";

/// Returns the diameters in ascending order without duplicates; only the nominal one if they cannot be read.
fn read_diameters(t: &Place<'_>, entry: &GripEntry, unit: f64, nominal: f64) -> Vec<f64> {
    let Some(entry) = &entry.diameters else {
        return vec![nominal];
    };
    let mut list = read_listed(&t.key("diameters"), entry, unit).unwrap_or(vec![nominal]);
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

/// Returns the diameters of a list or of a range with steps; `None` if there are not 1 to 1000.
fn read_listed(at: &Place<'_>, entry: &Diameters, unit: f64) -> Option<Vec<f64>> {
    let (what, allowed) = ("number of diameters", "1 to 1000");
    let s = match entry {
        Diameters::List(list) => {
            at.number_of(what, list.len(), MOST, allowed)?;
            let each = at.each_entry(list);
            let each = each.map(|(at, c)| at.read_value("diameter", c, unit, Bound::Positive));
            return Some(each.collect());
        }
        Diameters::Steps(s) => s,
    };
    let end = |k: &str, c| at.key(k).read_value("diameter", c, 1.0, Bound::Positive);
    let (from, to) = (end("from", &s.from), end("to", &s.to));
    if to < from {
        let allowed = "one not below `from`";
        at.key("to")
            .add_bad_value("the greatest diameter", to, allowed);
    }
    let count = at.key("count").number_of(what, s.count, MOST, allowed)?;
    let step = (to - from) / (count.max(2) - 1) as f64;
    // Steps in the unit of the file, so that a list of the same numbers is equal.
    let each = (0..count).map(|i| (from + step * i as f64) * unit);
    Some(each.collect())
}

/// Returns the mass of the part at each diameter; `None` if the file does not state it, or states it twice.
fn part_mass(t: &Place<'_>, e: &GripEntry, unit: f64) -> Option<PartMass> {
    let mass = t.read_positive("mass", &e.mass, 1.0);
    let density = t.read_positive("density", &e.density, 1.0);
    let length = t.read_positive("part_length", &e.part_length, unit);
    match (mass, density, length) {
        (Some(m), None, None) => return Some(PartMass::Constant(m)),
        (None, Some(density), Some(length)) => return Some(PartMass::Cylinder { density, length }),
        (None, None, None) => {
            let loads = [
                ("friction", e.friction.is_some()),
                ("gravity", e.gravity.is_some()),
                ("accelerations", !e.accelerations.is_empty()),
                ("any_acceleration", e.any_acceleration.is_some()),
                ("safety", e.safety.is_some()),
            ];
            let given = loads.into_iter().filter(|(_, given)| *given);
            given.for_each(|(k, _)| t.add_missing_key(k, MASS));
        }
        (Some(_), _, _) => t.add_excluded_key("mass", "density or part_length"),
        (None, Some(_), None) => t.add_missing_key("density", "part_length"),
        (None, None, Some(_)) => t.add_missing_key("part_length", "density"),
    }
    None
}

/// Returns gravity in the gripper's axes; down by default.
fn read_gravity(t: &Place<'_>, e: &GripEntry) -> Toward {
    match &e.gravity {
        None => Toward::Fixed([0.0, -GRAVITY, 0.0]),
        Some(Gravity::Vector(v)) => Toward::Fixed(t.key("gravity").read_reals(v, 1.0)),
        Some(Gravity::Word(w)) => {
            if w != "any" {
                t.key("gravity").add_unknown_word("gravity", w, ["any"]);
            }
            Toward::Any(GRAVITY)
        }
    }
}

/// Returns the accelerations of the gripper, each a load case. Without any it is one case at rest; `None` if there are too many.
fn read_accelerations(t: &Place<'_>, e: &GripEntry) -> Option<Vec<Toward>> {
    let (at, count) = (t.key("accelerations"), e.accelerations.len());
    if count > MOST {
        at.add_bad_value("number of accelerations", count, "at most 1000");
        return None;
    }
    let each = at.each_entry(&e.accelerations);
    let mut all = each
        .map(|(at, v)| Toward::Fixed(at.read_reals(v, 1.0)))
        .collect_vec();
    let any = t.not_negative("any_acceleration", &e.any_acceleration, 1.0);
    all.extend(any.map(Toward::Any));
    if all.is_empty() {
        all.push(Toward::Fixed([0.0; 3]));
    }
    Some(all)
}

/// Returns the load of the gripper, if the file gives the weight of the part.
fn read_load(t: &Place<'_>, e: &GripEntry, unit: f64) -> Option<GripLoad> {
    let mass = part_mass(t, e, unit)?;
    let Some(friction) = &e.friction else {
        let key = if e.mass.is_some() { "mass" } else { "density" };
        t.add_missing_key(key, "friction, the coefficient between part and faces");
        return None;
    };
    let gravity = read_gravity(t, e);
    let accelerations = read_accelerations(t, e)?;
    let kinds = [
        ("coupled", LeverDrive::Coupled),
        ("equal", LeverDrive::Equal),
        ("independent", LeverDrive::Independent),
    ];
    let coefficient = Bound::Range(0.0, 10.0, "a coefficient from 0 to 10");
    let factor = Bound::Range(1.0, 1000.0, "a factor from 1 to 1000");
    let centre = e.centre_of_mass.as_ref();
    let safety = t.read_optional("safety", &e.safety, 1.0, factor);
    Some(GripLoad {
        mass,
        centre_of_mass: centre.map_or([0.0; 3], |v| t.key("centre_of_mass").read_reals(v, unit)),
        gravity,
        accelerations,
        friction: t.read_figure("friction", friction, 1.0, coefficient),
        safety: safety.unwrap_or(1.0),
        levers: t.read_word("levers", &e.levers, &kinds),
    })
}

fn read_transmission(t: &Place<'_>, e: &GripEntry, unit: f64, m: Option<&Parts>) -> Transmission {
    let arm = t.read_positive("drive_arm", &e.drive_arm, unit);
    match (arm, &e.lever_joints, m) {
        (Some(_), Some(_), _) => t.add_excluded_key("lever_joints", "drive_arm"),
        (Some(arm), None, _) => return Transmission::Arm(arm),
        (None, None, _) => {}
        (None, Some(_), None) => t.add_missing_key("lever_joints", MECHANISM),
        (None, Some(ids), Some(m)) => {
            if m.joints.iter().filter(|j| j.drive).count() != 1 {
                t.add_missing_key("lever_joints", "one joint with drive = true");
            }
            if let [a, b] = read_joints(&t.key("lever_joints"), ids, m)[..] {
                return Transmission::Joints([a, b]);
            }
        }
    }
    Transmission::Unknown
}

/// Returns the joints that a list names, without unknown ones.
fn read_joints(at: &Place<'_>, ids: &[String], m: &Parts) -> Vec<JointId> {
    at.each_entry(ids)
        .filter_map(|(at, id)| at.find_joint(m, id))
        .collect()
}

/// Reports conditions of contacts that the rest of the table does not meet.
fn contacts_go_with(t: &Place<'_>, spec: &GripSpec) {
    let levers = spec.load.as_ref().map(|l| l.levers);
    if levers.is_none() {
        t.add_missing_key("contacts", MASS);
    }
    if levers == Some(LeverDrive::Independent) {
        let other = "levers = \"coupled\" or \"equal\": the mechanism has one drive for both";
        t.add_missing_key("contacts", other);
    }
    if spec.pivots == Pivots::Nominal {
        let other = "pivots = \"fixed\": the pivots of the mechanism do not move";
        t.add_missing_key("contacts", other);
    }
}

/// Returns the joints that represent the contacts: upper far, upper near, lower far, lower near. Each joins the part to its lever, and
/// all act in the same states.
fn read_contacts(t: &Place<'_>, e: &GripEntry, spec: &GripSpec, m: &Parts) -> Option<[JointId; 4]> {
    let ids = e.contacts.as_ref()?;
    let Transmission::Joints(levers) = spec.transmission else {
        if e.lever_joints.is_none() {
            let other = "lever_joints, the joints that the two levers turn in";
            t.add_missing_key("contacts", other);
        }
        return None;
    };
    contacts_go_with(t, spec);
    let at = t.key("contacts");
    let contacts: [JointId; 4] = read_joints(&at, ids, m).try_into().ok()?;
    let first = &m.joints[contacts[0]];
    let held = |l: &LinkId| m.links[*l].role == Role::Object && first.links.contains(l);
    let part = m.link_ids().find(held);
    let of_part = |j: &JointId| part.is_some_and(|p| m.joints[*j].links.contains(&p));
    for (i, (at, &j)) in at.each_entry(&contacts).enumerate() {
        let (joint, lever) = (&m.joints[j], &m.joints[levers[i / 2]]);
        let shared = |l: &LinkId| lever.links.contains(l) && *l != m.frame_link();
        let allowed = if !of_part(&j) || !joint.links.iter().any(shared) {
            let which = ["first", "second"][i / 2];
            &format!(
                "a joint between the part (a link of role \"object\") and the link that turns in the {which} of lever_joints"
            )
        } else if joint.states.is_none() || joint.states != first.states {
            "one with the same `state` as the other contacts, such as state = \"clamped\""
        } else {
            continue;
        };
        at.add_bad_value("contact", format!("{:?}", joint.id), allowed);
    }
    for (at, &j) in t.key("lever_joints").each_entry(&levers) {
        if !m.joints[j].links.contains(&m.frame_link()) {
            let allowed = "a joint at the frame: with contacts, the pivots stand still";
            at.add_bad_value("lever joint", format!("{:?}", m.joints[j].id), allowed);
        }
    }
    let further = m.joint_ids().any(|j| of_part(&j) && !contacts.contains(&j));
    if further || !contacts.iter().all_unique() {
        let allowed =
            "all four joints of the part, each once, and no other joint may hold the part";
        at.add_bad_value("list of contacts", format!("{ids:?}"), allowed);
    }
    Some(contacts)
}

/// Returns the positions of the pivots of the levers.
fn read_pivots(t: &Place<'_>, e: &GripEntry, unit: f64) -> Pivots {
    let fixed = t.read_word("pivots", &e.pivots, &[("fixed", true), ("nominal", false)]);
    let distance = t.not_negative("pivot_distance", &e.pivot_distance, unit);
    if distance.is_some() && !fixed {
        t.add_missing_key("pivot_distance", "pivots = \"fixed\"");
    }
    match (fixed, distance) {
        (false, _) => Pivots::Nominal,
        (true, Some(a)) if e.levers_cross => Pivots::Fixed(-a),
        (true, Some(a)) => Pivots::Fixed(a),
        (true, None) => Pivots::FixedForDiameter,
    }
}

/// Returns the gripper of a file, if it has one.
pub(crate) fn read_grip(
    file: &MechanismFile,
    unit: f64,
    mechanism: Option<&Parts>,
    out: &Findings,
) -> Option<GripSpec> {
    let e = file.workload.grip.as_ref()?;
    let t = &out.key("workload").key("grip");
    let allowed = "an angle from 1 to 179 degrees: at 180 the faces form no V";
    let prism_angle = t.angle_in("prism_angle", &e.prism_angle, [1.0, 179.0], allowed);
    let allowed = "an angle from 0 to 179 degrees";
    let mounting_angle = t.angle_in("mounting_angle", &e.mounting_angle, [0.0, 179.0], allowed);
    let diameter = t.read_figure("diameter", &e.diameter, unit, Bound::Positive);
    let pivots = read_pivots(t, e, unit);
    let width = t.not_negative("lever_width", &e.lever_width, unit);
    let mut spec = GripSpec {
        lever_length: t.read_figure("lever_length", &e.lever_length, unit, Bound::Positive),
        prism_angle,
        mounting_angle,
        diameter,
        diameters: read_diameters(t, e, unit, diameter),
        pivots,
        face_length: t.read_positive("face_length", &e.face_length, unit),
        lever_width: width.unwrap_or(0.0),
        may_cross: e.levers_cross,
        load: read_load(t, e, unit),
        transmission: read_transmission(t, e, unit, mechanism),
        contacts: None,
    };
    match mechanism {
        Some(m) => spec.contacts = read_contacts(t, e, &spec, m),
        None if e.contacts.is_some() => t.add_missing_key("contacts", MECHANISM),
        None => {}
    }
    Some(spec)
}
