//! The tables `[workload.grip]`, `[workload.drive]`, `[ranking]` and `[joint_types]`.

use crate::file::prelude::*;
use crate::file::read::workload::drive::regular_programme;
use crate::file::write::number::{write_angle, write_number, write_numbers};
use crate::model::drive::{DriveSpec, ProgrammeStep};
use crate::model::grip::{GripLoad, GripSpec, LeverDrive, PartMass, Pivots, Toward, Transmission};
use crate::model::loads::Accuracy;
use crate::model::ranking::{ClearanceSum, Ranking};

/// Returns the entry of a gripper, with lengths in the mechanism's unit.
pub(crate) fn write_grip(m: &Mechanism, spec: &GripSpec) -> GripEntry {
    let length = |x: f64| write_number(x, m.length_unit.metres);
    let mut entry = GripEntry {
        lever_length: length(spec.lever_length),
        prism_angle: write_angle(spec.prism_angle),
        mounting_angle: write_angle(spec.mounting_angle),
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
        contacts: spec.contacts.map(|c| c.map(|j| m.joints[j].id.clone())),
        ..GripEntry::default()
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

/// Writes the load of a gripper, with lengths in units of `metres`.
fn write_load(entry: &mut GripEntry, load: &GripLoad, metres: f64) {
    let plain = |x: f64| -> Coordinate { write_number(x, 1.0) };
    match load.mass {
        PartMass::Constant(mass) => entry.mass = Some(plain(mass)),
        PartMass::Cylinder { density, length } => {
            entry.density = Some(plain(density));
            entry.part_length = Some(write_number(length, metres));
        }
    }
    entry.centre_of_mass = Some(write_numbers(load.centre_of_mass, metres));
    entry.gravity = Some(match load.gravity {
        Toward::Fixed(v) => Gravity::Vector(write_numbers(v, 1.0)),
        Toward::Any(_) => Gravity::Word("any".to_owned()),
    });
    for a in &load.accelerations {
        match *a {
            Toward::Fixed(v) => entry.accelerations.push(write_numbers(v, 1.0)),
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

/// Returns the entry of a torsional drive, with lengths in units of `metres`.
pub(crate) fn write_drive(spec: &DriveSpec, metres: f64) -> DriveEntry {
    let length = |x: f64| write_number(x, metres);
    let plain = |x: f64| -> Coordinate { write_number(x, 1.0) };
    let [first, second] = spec.inertias;
    let mut entry = DriveEntry {
        swing_angle: write_angle(2.0 * spec.twist),
        period: Some(plain(spec.period)),
        // The total inertia, which includes that of the payload.
        inertia: Some(plain(first)),
        // A payload without mass only gives a radius.
        payload_mass: spec.payload.filter(|p| p.mass > 0.0).map(|p| plain(p.mass)),
        payload_radius: spec.payload.map(|p| length(p.radius)),
        second_inertia: (second.to_bits() != first.to_bits()).then(|| plain(second)),
        shear_modulus: plain(spec.shear_modulus),
        allowable_stress: plain(spec.allowable_stress),
        torsion_length: spec.length.map(length),
        max_length: spec.max_length.map(length),
        diameters: spec.diameters.iter().map(|d| length(*d)).collect(),
        missing_angle: spec.missing.map(write_angle),
        viscous_damping: spec.damping.map(|d| plain(d.viscous)),
        friction_moment: spec.damping.map(|d| plain(d.coulomb)),
        spring_stroke: spec.cam.map(|c| length(c.stroke)),
        mounting_coefficient: spec.cam.map(|c| plain(c.mounting)),
        cam_efficiency: spec.cam.map(|c| plain(c.efficiency)),
        feed_energy: spec.push.energy.map(plain),
        feed_from: Some(write_angle(spec.push.from)),
        latch_capture: Some(write_angle(spec.capture)),
        ..DriveEntry::default()
    };
    write_programme(&mut entry, &spec.programme);
    entry
}

/// Writes the programme: as a number of swings if it is regular, otherwise step by step.
fn write_programme(entry: &mut DriveEntry, steps: &[ProgrammeStep]) {
    let is_swing = |s: &&ProgrammeStep| matches!(s, ProgrammeStep::Swing(_));
    let swings = steps.iter().filter(is_swing).count();
    let dwell = match steps {
        [ProgrammeStep::Swing(_), ProgrammeStep::Dwell(time), ..] if *time > 0.0 => Some(*time),
        _ => None,
    };
    for (stepwise, word) in [(true, "stepwise"), (false, "reversing")] {
        if regular_programme(stepwise, swings, dwell) == steps {
            entry.motion = Some(word.to_owned());
            entry.swings = i64::try_from(swings).ok();
            entry.dwell = dwell.map(|d| write_number(d, 1.0));
            return;
        }
    }
    let word = |s: &ProgrammeStep| match s {
        ProgrammeStep::Swing(disc) => (disc + 1).to_string(),
        ProgrammeStep::Dwell(time) => format!("wait {time}"),
    };
    entry.programme = Some(steps.iter().map(word).collect());
}

/// Returns the entry of the accuracy of the joints, with lengths in the mechanism's unit.
pub(crate) fn write_accuracy(m: &Mechanism, accuracy: &Accuracy) -> AccuracyEntry {
    let length = |x: f64| Some(write_number(x, m.length_unit.metres));
    let own = accuracy.joints.iter();
    let own = own.map(|(joint, t)| JointAccuracyEntry {
        joint: m.joints[*joint].id.clone(),
        position: length(t.position),
        angle: Some(Quantity::Number(t.angle)),
    });
    AccuracyEntry {
        fit: None,
        position: length(accuracy.usual.position),
        angle: Some(Quantity::Number(accuracy.usual.angle)),
        hand_force: Some(write_number(accuracy.hand_force, 1.0)),
        joint: own.collect(),
    }
}

/// Returns the entry of a ranking.
pub(crate) fn write_ranking(m: &Mechanism, r: &Ranking) -> RankingEntry {
    let term = |&(term, weight): &(crate::model::ranking::Term, f64)| TermEntry {
        term: term.name().to_owned(),
        weight: Some(weight),
    };
    let limits = r.limits.iter().map(|l| LimitEntry {
        term: l.term.name().to_owned(),
        min: l.min,
        max: l.max,
    });
    RankingEntry {
        order: None,
        terms: r.terms.iter().map(term).collect(),
        limits: limits.collect(),
        clearance: (r.clearance == ClearanceSum::Rms).then(|| "rms".to_owned()),
        states: r.states.iter().map(|&s| m.states[s].clone()).collect(),
    }
}

/// Returns the capacities of joint types in the mechanism; their costs are under `[search.costs]`.
pub(crate) fn joint_types(m: &Mechanism) -> BTreeMap<String, JointTypeEntry> {
    let each = m.joint_types.iter().map(|t| {
        let entry = JointTypeEntry {
            cost: None,
            capacity_force: t.capacity_force,
            capacity_moment: t.capacity_moment,
            clearance: t.clearance,
        };
        (t.name.clone(), entry)
    });
    each.collect()
}
