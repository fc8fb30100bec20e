//! The `[workload.grip]` table.

use crate::file::Findings;
use crate::file::locate::{DocumentStep, index, key};
use crate::file::read::value::names::joint_by_id;
use crate::file::read::value::quantity::{Bound, ValueTable, word};
use crate::file::schema::{Diameters, Gravity, GripEntry, MechanismFile};
use crate::model::grip::{GripLoad, GripSpec, LeverDrive, PartMass, Pivots, Toward, Transmission};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role};
use itertools::Itertools;

/// Standard gravity. `[m/s²]`
const GRAVITY: f64 = 9.80665;
/// Most diameters and accelerations.
const MOST: usize = 1000;

fn diameters(t: &mut ValueTable<'_>, entry: &GripEntry, unit: f64, nominal: f64) -> Vec<f64> {
    let at = key(&t.at, "diameters");
    let mut list = match &entry.diameters {
        None => return vec![nominal],
        Some(Diameters::List(list)) if list.is_empty() || list.len() > MOST => {
            t.bad(
                &at,
                "number of diameters",
                list.len().to_string(),
                "1 to 1000",
            );
            return vec![nominal];
        }
        Some(Diameters::List(list)) => {
            let each = list.iter().enumerate();
            each.map(|(i, c)| t.number_at(&index(&at, i), "diameter", c, unit, Bound::Positive))
                .collect_vec()
        }
        Some(Diameters::Steps(s)) => {
            let from = t.number_at(&key(&at, "from"), "diameter", &s.from, 1.0, Bound::Positive);
            let to = t.number_at(&key(&at, "to"), "diameter", &s.to, 1.0, Bound::Positive);
            if to < from {
                let path = key(&at, "to");
                t.bad(
                    &path,
                    "the greatest diameter",
                    to.to_string(),
                    "one not below `from`",
                );
            }
            let Some(count) = usize::try_from(s.count)
                .ok()
                .filter(|n| (1..=MOST).contains(n))
            else {
                let path = key(&at, "count");
                t.bad(
                    &path,
                    "number of diameters",
                    s.count.to_string(),
                    "1 to 1000",
                );
                return vec![nominal];
            };
            let step = (to - from) / (count.max(2) - 1) as f64;
            // Steps in the unit of the file, so that a list of them says the same.
            (0..count)
                .map(|i| (from + step * i as f64) * unit)
                .collect()
        }
    };
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

/// What the part weighs at each diameter; none where the file does not say, or says it twice.
fn part_mass(t: &mut ValueTable<'_>, e: &GripEntry, unit: f64) -> Option<PartMass> {
    let mass = t.optional("mass", e.mass.as_ref(), 1.0, Bound::Positive);
    let density = t.optional("density", e.density.as_ref(), 1.0, Bound::Positive);
    let length = t.optional("part_length", e.part_length.as_ref(), unit, Bound::Positive);
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
            for (k, _) in loads.into_iter().filter(|(_, given)| *given) {
                t.needs(k, "the mass of the part: mass, or density and part_length");
            }
        }
        (Some(_), _, _) => t.excludes("mass", "density or part_length"),
        (None, Some(_), None) => t.needs("density", "part_length beside it"),
        (None, None, Some(_)) => t.needs("part_length", "density beside it"),
    }
    None
}

/// Gravity in the gripper's axes; down where left out.
fn gravity(t: &mut ValueTable<'_>, e: &GripEntry) -> Toward {
    match &e.gravity {
        None => Toward::Fixed([0.0, -GRAVITY, 0.0]),
        Some(Gravity::Vector(v)) => Toward::Fixed(t.vector("gravity", v, 1.0)),
        Some(Gravity::Word(w)) => {
            word(t, "gravity", Some(w), &[("any", ())]);
            Toward::Any(GRAVITY)
        }
    }
}

/// The accelerations of the gripper, each a case; one at rest where there are none, nothing where there are too many.
fn accelerations(t: &mut ValueTable<'_>, e: &GripEntry) -> Option<Vec<Toward>> {
    let at = key(&t.at, "accelerations");
    if e.accelerations.len() > MOST {
        t.bad(
            &at,
            "number of accelerations",
            e.accelerations.len().to_string(),
            "at most 1000",
        );
        return None;
    }
    let mut accelerations = Vec::new();
    for (i, v) in e.accelerations.iter().enumerate() {
        let v = crate::file::read::value::number::vector(v, &index(&at, i), t.out);
        accelerations.push(Toward::Fixed(v.map(|x| x.to_f64())));
    }
    let any = t.optional(
        "any_acceleration",
        e.any_acceleration.as_ref(),
        1.0,
        Bound::NotNegative,
    );
    accelerations.extend(any.map(Toward::Any));
    if accelerations.is_empty() {
        accelerations.push(Toward::Fixed([0.0; 3]));
    }
    Some(accelerations)
}

/// What the gripper must hold, where the file says what the part weighs.
fn load(t: &mut ValueTable<'_>, e: &GripEntry, unit: f64) -> Option<GripLoad> {
    let mass = part_mass(t, e, unit)?;
    let Some(friction) = &e.friction else {
        t.needs(
            if e.mass.is_some() { "mass" } else { "density" },
            "friction, the coefficient between part and faces, beside it",
        );
        return None;
    };
    let gravity = gravity(t, e);
    let accelerations = accelerations(t, e)?;
    let kinds = [
        ("coupled", LeverDrive::Coupled),
        ("equal", LeverDrive::Equal),
        ("independent", LeverDrive::Independent),
    ];
    Some(GripLoad {
        mass,
        centre_of_mass: e
            .centre_of_mass
            .as_ref()
            .map_or([0.0; 3], |v| t.vector("centre_of_mass", v, unit)),
        gravity,
        accelerations,
        friction: t.number(
            "friction",
            friction,
            1.0,
            Bound::Range(0.0, 10.0, "a coefficient from 0 to 10"),
        ),
        safety: t
            .optional(
                "safety",
                e.safety.as_ref(),
                1.0,
                Bound::Range(1.0, 1000.0, "a factor from 1 to 1000"),
            )
            .unwrap_or(1.0),
        levers: word(t, "levers", e.levers.as_ref(), &kinds),
    })
}

fn transmission(
    t: &mut ValueTable<'_>,
    e: &GripEntry,
    unit: f64,
    mechanism: Option<&Mechanism>,
) -> Transmission {
    let arm = t.optional("drive_arm", e.drive_arm.as_ref(), unit, Bound::Positive);
    match (arm, &e.lever_joints) {
        (Some(_), Some(_)) => {
            t.excludes("lever_joints", "drive_arm");
            Transmission::Unknown
        }
        (Some(arm), None) => Transmission::Arm(arm),
        (None, None) => Transmission::Unknown,
        (None, Some(ids)) => {
            let Some(m) = mechanism else {
                t.needs(
                    "lever_joints",
                    "a mechanism in the same file: links and joints",
                );
                return Transmission::Unknown;
            };
            if m.joints.iter().filter(|j| j.drive).count() != 1 {
                t.needs("lever_joints", "one joint with drive = true");
            }
            match joints(t, "lever_joints", ids, m)[..] {
                [a, b] => Transmission::Joints([a, b]),
                _ => Transmission::Unknown,
            }
        }
    }
}

/// The joints that a list names; shorter than the list where some are not known.
fn joints(t: &mut ValueTable<'_>, k: &'static str, ids: &[String], m: &Mechanism) -> Vec<JointId> {
    let at = key(&t.at, k);
    let each = ids
        .iter()
        .enumerate()
        .filter_map(|(i, id)| joint_by_id(m, id, &index(&at, i), t.out));
    each.collect()
}

/// What contacts need of the rest of the table.
fn contacts_go_with(t: &mut ValueTable<'_>, spec: &GripSpec) {
    if spec.load.is_none() {
        t.needs(
            "contacts",
            "the mass of the part: mass, or density and part_length",
        );
    }
    if spec
        .load
        .as_ref()
        .is_some_and(|l| l.levers == LeverDrive::Independent)
    {
        t.needs(
            "contacts",
            "levers = \"coupled\" or \"equal\": the mechanism has one drive for both",
        );
    }
    if spec.pivots == Pivots::Nominal {
        t.needs(
            "contacts",
            "pivots = \"fixed\": the mechanism's own stand where they are",
        );
    }
}

/// The joints of a clamped part and of the levers that clamp it.
struct Clamp<'a> {
    mechanism: &'a Mechanism,
    /// The joints of the levers, upper and lower.
    levers: [JointId; 2],
    /// Upper far, upper near, lower far, lower near.
    contacts: [JointId; 4],
    /// The clamped object, where the first contact has one.
    part: Option<LinkId>,
}

impl Clamp<'_> {
    /// Whether each contact is between the part and its lever, and all act in the same states.
    fn check_contacts(&self, t: &mut ValueTable<'_>) {
        let m = self.mechanism;
        let at = key(&t.at, "contacts");
        for (i, &j) in self.contacts.iter().enumerate() {
            let joint = &m.joints[j];
            let lever = &m.joints[self.levers[i / 2]];
            let touches = joint.links.iter().any(|&l| Some(l) == self.part);
            let on_lever = joint
                .links
                .iter()
                .any(|l| lever.links.contains(l) && *l != m.frame());
            if !touches || !on_lever {
                t.bad(&index(&at, i), "contact", format!("{:?}", joint.id), match i / 2 {
                    0 => "a joint between the part (a link of role \"object\") and the link that turns in the first of lever_joints",
                    _ => "a joint between the part (a link of role \"object\") and the link that turns in the second of lever_joints",
                });
            } else if joint.states.is_none() || joint.states != m.joints[self.contacts[0]].states {
                t.bad(
                    &index(&at, i),
                    "contact",
                    format!("{:?}", joint.id),
                    "one with the same `state` as the other contacts, such as state = \"clamped\"",
                );
            }
        }
    }

    /// Whether the levers turn on the frame.
    fn check_pivots(&self, t: &mut ValueTable<'_>) {
        let m = self.mechanism;
        for (k, &j) in self.levers.iter().enumerate() {
            if !m.joints[j].links.contains(&m.frame()) {
                t.bad(
                    &index(&key(&t.at, "lever_joints"), k),
                    "lever joint",
                    format!("{:?}", m.joints[j].id),
                    "a joint at the frame: with contacts, the pivots stand still",
                );
            }
        }
    }

    /// Whether the contacts are four, and nothing else holds the part.
    fn holds_alone(&self) -> bool {
        let m = self.mechanism;
        let further = |j: JointId| {
            self.part.is_some_and(|p| m.joints[j].links.contains(&p)) && !self.contacts.contains(&j)
        };
        !m.joint_ids().any(further) && self.contacts.iter().all_unique()
    }
}

/// The joints that stand for the contacts: each joins the part to the lever that is to touch it there.
fn contacts(
    t: &mut ValueTable<'_>,
    e: &GripEntry,
    spec: &GripSpec,
    m: &Mechanism,
) -> Option<[JointId; 4]> {
    let ids = e.contacts.as_ref()?;
    let Transmission::Joints(levers) = spec.transmission else {
        if e.lever_joints.is_none() {
            t.needs(
                "contacts",
                "lever_joints, the joints that the two levers turn in, beside it",
            );
        }
        return None;
    };
    contacts_go_with(t, spec);
    let [upper_far, upper_near, lower_far, lower_near] = joints(t, "contacts", ids, m)[..] else {
        return None;
    };
    let clamp = Clamp {
        mechanism: m,
        levers,
        contacts: [upper_far, upper_near, lower_far, lower_near],
        part: m
            .link_ids()
            .find(|&l| m.links[l].role == Role::Object && m.joints[upper_far].links.contains(&l)),
    };
    clamp.check_contacts(t);
    clamp.check_pivots(t);
    if !clamp.holds_alone() {
        let at = key(&t.at, "contacts");
        t.bad(
            &at,
            "list of contacts",
            format!("{ids:?}"),
            "all four joints of the part, each once: nothing else may hold it",
        );
    }
    Some(clamp.contacts)
}

/// Where the pivots of the levers stand.
fn pivots(t: &mut ValueTable<'_>, e: &GripEntry, unit: f64) -> Pivots {
    let fixed = word(
        t,
        "pivots",
        e.pivots.as_ref(),
        &[("fixed", true), ("nominal", false)],
    );
    let distance = t.optional(
        "pivot_distance",
        e.pivot_distance.as_ref(),
        unit,
        Bound::NotNegative,
    );
    if distance.is_some() && !fixed {
        t.needs("pivot_distance", "pivots = \"fixed\"");
    }
    match (fixed, distance) {
        (false, _) => Pivots::Nominal,
        (true, Some(a)) if e.levers_cross => Pivots::Fixed(-a),
        (true, Some(a)) => Pivots::Fixed(a),
        (true, None) => Pivots::FixedForDiameter,
    }
}

/// The gripper of a file, where it has one.
pub(crate) fn grip(
    file: &MechanismFile,
    unit: f64,
    mechanism: Option<&Mechanism>,
    out: &mut Findings,
) -> Option<GripSpec> {
    let e = file.workload.grip.as_ref()?;
    let at = ["workload", "grip"]
        .map(|k| DocumentStep::Key(k.to_owned()))
        .to_vec();
    let t = &mut ValueTable { at, out };
    let prism_angle = t.angle_in(
        "prism_angle",
        &e.prism_angle,
        1.0,
        179.0,
        "an angle from 1 to 179 degrees: at 180 the faces form no V",
    );
    let mounting_angle = t.angle_in(
        "mounting_angle",
        &e.mounting_angle,
        0.0,
        179.0,
        "an angle from 0 to 179 degrees",
    );
    let diameter = t.number("diameter", &e.diameter, unit, Bound::Positive);
    let pivots = pivots(t, e, unit);
    let mut spec = GripSpec {
        lever_length: t.number("lever_length", &e.lever_length, unit, Bound::Positive),
        prism_angle,
        mounting_angle,
        diameter,
        diameters: diameters(t, e, unit, diameter),
        pivots,
        face_length: t.optional("face_length", e.face_length.as_ref(), unit, Bound::Positive),
        lever_width: t
            .optional(
                "lever_width",
                e.lever_width.as_ref(),
                unit,
                Bound::NotNegative,
            )
            .unwrap_or(0.0),
        may_cross: e.levers_cross,
        load: load(t, e, unit),
        transmission: transmission(t, e, unit, mechanism),
        contacts: None,
    };
    match mechanism {
        Some(m) => spec.contacts = contacts(t, e, &spec, m),
        None if e.contacts.is_some() => {
            t.needs("contacts", "a mechanism in the same file: links and joints");
        }
        None => {}
    }
    Some(spec)
}
