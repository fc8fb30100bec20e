//! The `[workload.grip]` table.

use crate::file::schema::{Coordinate, Diameters, Gravity, GripEntry};
use crate::file::write::quantity::{angle, number, numbers};
use crate::model::grip::{GripLoad, GripSpec, LeverDrive, PartMass, Pivots, Toward, Transmission};
use crate::model::mechanism::Mechanism;

/// The entry of a gripper, lengths in the mechanism's unit.
pub(crate) fn grip(m: &Mechanism, spec: &GripSpec) -> GripEntry {
    let length = |x: f64| number(x, m.length_unit.metres);
    let mut entry = GripEntry {
        lever_length: length(spec.lever_length),
        prism_angle: angle(spec.prism_angle),
        mounting_angle: angle(spec.mounting_angle),
        diameter: length(spec.diameter),
        diameters: Some(Diameters::List(
            spec.diameters.iter().map(|d| length(*d)).collect(),
        )),
        pivots: (spec.pivots == Pivots::Nominal).then(|| "nominal".to_owned()),
        pivot_distance: match spec.pivots {
            Pivots::Fixed(a) => Some(length(a.abs())),
            Pivots::Nominal | Pivots::FixedForDiameter => None,
        },
        face_length: spec.face_length.map(length),
        lever_width: Some(length(spec.lever_width)),
        levers_cross: spec.may_cross,
        mass: None,
        density: None,
        part_length: None,
        centre_of_mass: None,
        gravity: None,
        accelerations: Vec::new(),
        any_acceleration: None,
        friction: None,
        safety: None,
        levers: None,
        drive_arm: None,
        lever_joints: None,
        contacts: spec.contacts.map(|c| c.map(|j| m.joints[j].id.clone())),
    };
    match spec.transmission {
        Transmission::Unknown => {}
        Transmission::Arm(arm) => entry.drive_arm = Some(length(arm)),
        Transmission::Joints(joints) => {
            entry.lever_joints = Some(joints.map(|j| m.joints[j].id.clone()));
        }
    }
    if let Some(load) = &spec.load {
        write_load(&mut entry, load, m.length_unit.metres);
    }
    entry
}

/// What the gripper must hold, lengths in units of so many metres.
fn write_load(entry: &mut GripEntry, load: &GripLoad, metres: f64) {
    let plain = |x: f64| -> Coordinate { number(x, 1.0) };
    match load.mass {
        PartMass::Constant(mass) => entry.mass = Some(plain(mass)),
        PartMass::Cylinder { density, length } => {
            entry.density = Some(plain(density));
            entry.part_length = Some(number(length, metres));
        }
    }
    entry.centre_of_mass = Some(numbers(load.centre_of_mass, metres));
    entry.gravity = Some(match load.gravity {
        Toward::Fixed(v) => Gravity::Vector(numbers(v, 1.0)),
        Toward::Any(_) => Gravity::Word("any".to_owned()),
    });
    for a in &load.accelerations {
        match *a {
            Toward::Fixed(v) => entry.accelerations.push(numbers(v, 1.0)),
            Toward::Any(size) => entry.any_acceleration = Some(plain(size)),
        }
    }
    entry.friction = Some(plain(load.friction));
    entry.safety = Some(plain(load.safety));
    entry.levers = match load.levers {
        LeverDrive::Coupled => None,
        LeverDrive::Equal => Some("equal".to_owned()),
        LeverDrive::Independent => Some("independent".to_owned()),
    };
}
