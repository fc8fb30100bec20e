//! The `[workload.drive]` table.

use crate::file::prelude::*;
use crate::file::read::value::quantity::Bound;
use crate::file::read::workload::grip::MECHANISM;
use crate::geom::vector::{dot, scale};
use crate::model::drive::{Cam, Damping, DriveSpec, Payload, ProgrammeStep, Push};
use crate::model::loads::Inertia;

fn read_damping(t: &Place<'_>, e: &DriveEntry) -> Option<Damping> {
    let viscous = t.not_negative("viscous_damping", &e.viscous_damping, 1.0);
    let coulomb = t.not_negative("friction_moment", &e.friction_moment, 1.0);
    (viscous.is_some() || coulomb.is_some()).then(|| Damping {
        viscous: viscous.unwrap_or(0.0),
        coulomb: coulomb.unwrap_or(0.0),
    })
}

fn read_cam(t: &Place<'_>, e: &DriveEntry, unit: f64) -> Option<Cam> {
    let stroke = t.read_positive("spring_stroke", &e.spring_stroke, unit);
    let mounting = t.not_negative("mounting_coefficient", &e.mounting_coefficient, 1.0);
    let share = Bound::Range(1e-6, 1.0, "a number above 0, up to 1");
    let efficiency = t.read_optional("cam_efficiency", &e.cam_efficiency, 1.0, share);
    if stroke.is_none() {
        let of_cam = [
            ("mounting_coefficient", mounting),
            ("cam_efficiency", efficiency),
        ];
        let given = of_cam.into_iter().filter(|(_, v)| v.is_some());
        given.for_each(|(k, _)| t.add_missing_key(k, "spring_stroke"));
    }
    stroke.map(|stroke| Cam {
        stroke,
        mounting: mounting.unwrap_or(0.0),
        efficiency: efficiency.unwrap_or(1.0),
    })
}

/// Returns the time of a whole oscillation.
fn read_period(t: &Place<'_>, e: &DriveEntry) -> f64 {
    let whole = t.read_positive("period", &e.period, 1.0);
    let half = t.read_positive("swing_time", &e.swing_time, 1.0);
    match (whole, half) {
        (Some(period), None) => return period,
        (None, Some(half)) => return 2.0 * half,
        (Some(_), Some(_)) => t.add_excluded_key("swing_time", "period"),
        (None, None) => add_lacking(t, "period, or swing_time, its half"),
    }
    1.0
}

/// Returns the available diameters of bars, ascending.
fn read_diameters(t: &Place<'_>, e: &DriveEntry, unit: f64) -> Vec<f64> {
    let at = t.key("diameters");
    let entries = at.first_entries(MOST, &e.diameters, "diameters");
    let entries = entries.map(|(at, d)| at.read_value("diameter", d, unit, Bound::Positive));
    let mut diameters: Vec<f64> = entries.collect();
    diameters.sort_by(f64::total_cmp);
    diameters
}

/// Returns the angle missing after a swing without the cam, if it was measured.
fn missing_angle(t: &Place<'_>, e: &DriveEntry, twist: f64) -> Option<f64> {
    let key = "missing_angle";
    let missing = e.missing_angle.as_ref();
    let missing = missing.map(|c| t.key(key).read_angle(key, c));
    if let Some(found) = missing.filter(|m| !(0.0..twist).contains(m)) {
        let allowed = "an angle from 0 to below half the swing";
        t.key(key).bad_angle(key, found, allowed);
    }
    missing
}

/// Returns the drive of a file, if it has one.
pub(crate) fn read_drive(
    file: &MechanismFile,
    unit: f64,
    mechanism: Option<&Parts>,
    out: &Findings,
) -> Option<DriveSpec> {
    let e = file.workload.drive.as_ref()?;
    let t = &out.key("workload").key("drive");
    let allowed = "an angle above 0, up to 3600 degrees";
    let twist = t.angle_in("swing_angle", &e.swing_angle, [1e-3, 3600.0], allowed) / 2.0;
    let period = read_period(t, e);
    let (inertias, payload) = read_inertias(t, e, unit, mechanism);
    let diameters = read_diameters(t, e, unit);
    let missing = missing_angle(t, e, twist);
    let damping = read_damping(t, e);
    let cam = read_cam(t, e, unit);
    let push = read_push(t, e, twist);
    let capture = e.latch_capture.as_ref();
    let range = [0.0, 3600.0];
    let capture = capture.map(|c| t.angle_in("latch_capture", c, range, "an angle from 0"));
    let modulus = "a modulus from 1e3 to 1e12 Pa, such as 8e10 for steel";
    let modulus = Bound::Range(1e3, 1e12, modulus);
    let stress = Bound::Range(1e3, 1e12, "a stress from 1e3 to 1e12 Pa, such as 4e8");
    Some(DriveSpec {
        twist,
        period,
        inertias,
        payload,
        shear_modulus: t.read_figure("shear_modulus", &e.shear_modulus, 1.0, modulus),
        allowable_stress: t.read_figure("allowable_stress", &e.allowable_stress, 1.0, stress),
        length: t.read_positive("torsion_length", &e.torsion_length, unit),
        max_length: t.read_positive("max_length", &e.max_length, unit),
        diameters,
        missing,
        damping,
        cam,
        push,
        capture: capture.unwrap_or(1f64.to_radians()),
        programme: read_programme(t, e),
    })
}

/// Returns the cam's push over a swing of `twist` to either side.
fn read_push(t: &Place<'_>, e: &DriveEntry, twist: f64) -> Push {
    let key = "feed_from";
    let from = e.feed_from.as_ref();
    let from = from.map_or(0.0, |c| t.key(key).read_angle(key, c));
    if !(-twist..twist).contains(&from) {
        let allowed = "an angle within the swing, 0 being its middle";
        t.key(key).bad_angle(key, from, allowed);
    }
    let energy = t.not_negative("feed_energy", &e.feed_energy, 1.0);
    Push { energy, from }
}

/// Reports a key that the table lacks.
pub(super) fn add_lacking(t: &Place<'_>, other: &str) {
    t.add_problem(format!("drive needs {other}"));
}

/// Returns the inertia of a link about the axis of its joint with the frame.
fn link_inertia(t: &Place<'_>, id: &str, unit: f64, mechanism: Option<&Parts>) -> Option<f64> {
    let key = "disc_link";
    let Some(m) = mechanism else {
        t.add_missing_key(key, MECHANISM);
        return None;
    };
    let l = t.key(key).read_link(&m.links, id)?;
    let hinge = m.joints_in(StateId::FREE).map(|j| &m.joints[j]).find(|j| {
        j.joint_type == JointType::Revolute
            && j.links.contains(&l)
            && j.links.contains(&m.frame_link())
    });
    let mass = m.links[l].mass.as_ref();
    let mass = mass.and_then(|p| Some((p, p.inertia.as_ref()?)));
    let (Some(hinge), Some((body, inertia))) = (hinge, mass) else {
        let other = "a link with mass, centre and inertia, and a revolute joint to the frame";
        t.add_missing_key(key, other);
        return None;
    };
    let (axis, point) = (to_vector(&hinge.frame.axis), to_vector(&hinge.frame.point));
    let size = dot(axis, axis).sqrt();
    let [x, y, z] = axis.map(|c| c / size);
    let about = match *inertia {
        Inertia::Plane(i) => i,
        Inertia::Principal([a, b, c]) => a * x * x + b * y * y + c * z * z,
        Inertia::Tensor([xx, yy, zz, xy, yz, zx]) => {
            xx * x * x + yy * y * y + zz * z * z + 2.0 * (xy * x * y + yz * y * z + zx * z * x)
        }
    };
    let from = scale(sub(to_vector(&body.centre), point), unit);
    let along = dot(from, [x, y, z]);
    Some(about + body.mass * (dot(from, from) - along * along).max(0.0))
}

/// Inertias of the discs with what they carry, and the payload.
fn read_inertias(
    t: &Place<'_>,
    e: &DriveEntry,
    unit: f64,
    mechanism: Option<&Parts>,
) -> ([f64; 2], Option<Payload>) {
    let mass = t.read_positive("payload_mass", &e.payload_mass, 1.0);
    let radius = t.not_negative("payload_radius", &e.payload_radius, unit);
    let stated = t.not_negative("disc_inertia", &e.disc_inertia, 1.0);
    let linked = e.disc_link.as_ref();
    if stated.is_some() && linked.is_some() {
        t.add_excluded_key("disc_link", "disc_inertia");
    }
    let linked = linked.filter(|_| stated.is_none());
    let linked = linked.map(|id| link_inertia(t, id, unit, mechanism).unwrap_or(1.0));
    let disc = stated.or(linked);
    let whole = t.read_positive("inertia", &e.inertia, 1.0);
    match (mass, radius) {
        (Some(_), None) => t.add_missing_key("payload_mass", "payload_radius"),
        (None, Some(_)) if whole.is_none() => t.add_missing_key("payload_radius", "payload_mass"),
        _ => {}
    }
    // With a total inertia, the radius only sets where accelerations are computed.
    let mass = mass.or(whole.map(|_| 0.0));
    let payload = mass.zip(radius);
    let payload = payload.map(|(mass, radius)| Payload { mass, radius });
    let sum = disc.map(|i| i + payload.map_or(0.0, |p| p.mass * p.radius * p.radius));
    match (whole, sum) {
        (None, None) => {
            let other = "inertia, or disc_inertia with payload_mass and payload_radius";
            add_lacking(t, other);
        }
        (Some(_), Some(_)) => t.add_excluded_key("disc_inertia", "inertia"),
        (None, Some(sum)) if sum <= 0.0 => {
            let allowed = "a disc or a payload with an inertia above 0";
            t.key("disc_inertia").add_bad_value("inertia", sum, allowed);
        }
        _ => {}
    }
    let first = whole.or(sum).unwrap_or(1.0);
    let second = t.read_positive("second_inertia", &e.second_inertia, 1.0);
    ([first, second.unwrap_or(first)], payload)
}

/// Maximum number of steps of a programme.
pub(in crate::file::read) const MOST: usize = 10_000;

/// Returns the given number of swings, of both discs in turn or only of the second, with a dwell after each if one is given.
pub(crate) fn regular_programme(
    stepwise: bool,
    swings: usize,
    dwell: Option<f64>,
) -> Vec<ProgrammeStep> {
    let mut steps = Vec::new();
    for i in 0..swings {
        // The second disc goes first, so that the first, which is ahead, is followed.
        steps.push(ProgrammeStep::Swing(if stepwise { (i + 1) % 2 } else { 1 }));
        steps.extend(dwell.map(ProgrammeStep::Dwell));
    }
    steps
}

/// Returns the steps of a file: those it lists, or the number of swings it asks for.
fn read_programme(t: &Place<'_>, e: &DriveEntry) -> Vec<ProgrammeStep> {
    let time = Bound::Range(0.0, 1e6, "a time from 0 to 1e6 s");
    let dwell = t.read_optional("dwell", &e.dwell, 1.0, time);
    let Some(list) = &e.programme else {
        return read_swings(t, e, dwell);
    };
    let beside = [
        ("motion", e.motion.is_some()),
        ("swings", e.swings.is_some()),
        ("dwell", e.dwell.is_some()),
    ];
    let given = beside.into_iter().filter(|(_, given)| *given);
    given.for_each(|(k, _)| t.add_excluded_key(k, "programme"));
    let at = t.key("programme");
    let mut steps = Vec::new();
    let count = at.number_of("number of steps", list.len(), MOST, "1 to 10000");
    if count.is_none() {
        return steps;
    }
    for (at, text) in at.each_entry(list) {
        let found = parse_step(text);
        if found.is_none() {
            let allowed = "\"1\", \"2\" or a dwell such as \"wait 0.3\"";
            at.add_bad_value("step", format!("{text:?}"), allowed);
        }
        steps.extend(found);
    }
    steps
}

/// Returns the steps of a file that gives the number of swings and the dwell after each.
fn read_swings(t: &Place<'_>, e: &DriveEntry, dwell: Option<f64>) -> Vec<ProgrammeStep> {
    let ways = [("stepwise", true), ("reversing", false)];
    let stepwise = t.read_word("motion", &e.motion, &ways);
    let (at, allowed) = (t.key("swings"), "a whole number from 1 to 10000");
    let count = at.number_of("number of swings", e.swings.unwrap_or(8), MOST, allowed);
    count.map_or_else(Vec::new, |n| {
        regular_programme(stepwise, n, dwell.filter(|d| *d > 0.0))
    })
}

/// Parses a step: "1" or "2" for a disc that swings, or "wait 0.3" for a dwell in s.
fn parse_step(text: &str) -> Option<ProgrammeStep> {
    match text.trim() {
        "1" => Some(ProgrammeStep::Swing(0)),
        "2" => Some(ProgrammeStep::Swing(1)),
        other => {
            let time = other.strip_prefix("wait")?.trim();
            let time: f64 = time.trim_end_matches('s').trim_end().parse().ok()?;
            let allowed = (0.0..=1e6).contains(&time);
            allowed.then_some(ProgrammeStep::Dwell(time))
        }
    }
}
