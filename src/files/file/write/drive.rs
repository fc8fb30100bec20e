//! The `[workload.drive]` table.

use crate::file::read::workload::drive::regular;
use crate::file::schema::{Coordinate, DriveEntry};
use crate::file::write::quantity::{angle, number};
use crate::model::drive::{DriveSpec, ProgrammeStep, Push};

/// The entry of a torsional drive, lengths in a unit of so many metres.
pub(crate) fn drive(spec: &DriveSpec, metres: f64) -> DriveEntry {
    let length = |x: f64| number(x, metres);
    let plain = |x: f64| -> Coordinate { number(x, 1.0) };
    let [first, second] = spec.inertias;
    let (feed_energy, feed_from, feed_moments) = match &spec.push {
        Push::Even { energy, from } => (energy.map(plain), Some(angle(*from)), None),
        Push::Pieces(pieces) => {
            let piece = |p: &(f64, f64)| [angle(p.0), plain(p.1)];
            (None, None, Some(pieces.iter().map(piece).collect()))
        }
    };
    let mut entry = DriveEntry {
        swing_angle: angle(2.0 * spec.twist),
        period: Some(plain(spec.period)),
        swing_time: None,
        // The whole, of which a payload beside it is a part.
        inertia: Some(plain(first)),
        disc_inertia: None,
        disc_link: None,
        // A payload of no mass tells a radius alone.
        payload_mass: spec.payload.filter(|p| p.mass > 0.0).map(|p| plain(p.mass)),
        payload_radius: spec.payload.map(|p| length(p.radius)),
        second_inertia: (second.to_bits() != first.to_bits()).then(|| plain(second)),
        shear_modulus: plain(spec.shear_modulus),
        allowable_stress: plain(spec.allowable_stress),
        torsion_length: spec.length.map(length),
        max_length: spec.max_length.map(length),
        diameters: spec.diameters.iter().map(|d| length(*d)).collect(),
        missing_angle: spec.missing.map(angle),
        viscous_damping: spec.damping.map(|d| plain(d.viscous)),
        friction_moment: spec.damping.map(|d| plain(d.coulomb)),
        spring_stroke: spec.cam.map(|c| length(c.stroke)),
        mounting_coefficient: spec.cam.map(|c| plain(c.mounting)),
        cam_efficiency: spec.cam.map(|c| plain(c.efficiency)),
        cam_radius: spec.cam.and_then(|c| c.profile).map(|p| length(p.0)),
        roller_radius: spec.cam.and_then(|c| c.profile).map(|p| length(p.1)),
        feed_energy,
        feed_from,
        feed_moments,
        latch_capture: Some(angle(spec.capture)),
        motion: None,
        swings: None,
        dwell: None,
        programme: None,
    };
    programme(&mut entry, &spec.programme);
    entry
}

/// The programme: as a number of swings where it is regular, else step by step.
fn programme(entry: &mut DriveEntry, steps: &[ProgrammeStep]) {
    let swings = steps
        .iter()
        .filter(|s| matches!(s, ProgrammeStep::Swing(_)))
        .count();
    let dwell = match steps {
        [ProgrammeStep::Swing(_), ProgrammeStep::Dwell(time), ..] if *time > 0.0 => Some(*time),
        _ => None,
    };
    for (stepwise, word) in [(true, "stepwise"), (false, "reversing")] {
        if regular(stepwise, swings, dwell) == steps {
            entry.motion = Some(word.to_owned());
            entry.swings = i64::try_from(swings).ok();
            entry.dwell = dwell.map(|d| number(d, 1.0));
            return;
        }
    }
    let word = |s: &ProgrammeStep| match s {
        ProgrammeStep::Swing(disc) => (disc + 1).to_string(),
        ProgrammeStep::Dwell(time) => format!("wait {time}"),
    };
    entry.programme = Some(steps.iter().map(word).collect());
}
