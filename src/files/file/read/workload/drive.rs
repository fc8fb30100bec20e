//! The `[workload.drive]` table.

mod inertias;
mod programme;

use crate::file::read::value::quantity::Bound;
use crate::file::schema::{DriveEntry, MechanismFile};
use crate::file::{Findings, Place};
use crate::model::drive::{Cam, Damping, DriveSpec, Push};
use crate::model::mechanism::Mechanism;
use inertias::{inertias, lacks};
pub(crate) use programme::regular;
use programme::{MOST, programme};

fn damping(t: &Place<'_>, e: &DriveEntry) -> Option<Damping> {
    let viscous = t.not_negative("viscous_damping", &e.viscous_damping, 1.0);
    let coulomb = t.not_negative("friction_moment", &e.friction_moment, 1.0);
    (viscous.is_some() || coulomb.is_some()).then(|| Damping {
        viscous: viscous.unwrap_or(0.0),
        coulomb: coulomb.unwrap_or(0.0),
    })
}

fn cam(t: &Place<'_>, e: &DriveEntry, unit: f64) -> Option<Cam> {
    let stroke = t.positive("spring_stroke", &e.spring_stroke, unit);
    let mounting = t.not_negative("mounting_coefficient", &e.mounting_coefficient, 1.0);
    let share = Bound::Range(1e-6, 1.0, "a number above 0, up to 1");
    let efficiency = t.optional("cam_efficiency", &e.cam_efficiency, 1.0, share);
    if stroke.is_none() {
        let of_cam = [
            ("mounting_coefficient", mounting),
            ("cam_efficiency", efficiency),
        ];
        let given = of_cam.into_iter().filter(|(_, v)| v.is_some());
        given.for_each(|(k, _)| t.needs(k, "spring_stroke"));
    }
    stroke.map(|stroke| Cam {
        stroke,
        mounting: mounting.unwrap_or(0.0),
        efficiency: efficiency.unwrap_or(1.0),
    })
}

/// Returns the time of a whole oscillation.
fn period(t: &Place<'_>, e: &DriveEntry) -> f64 {
    let whole = t.positive("period", &e.period, 1.0);
    let half = t.positive("swing_time", &e.swing_time, 1.0);
    match (whole, half) {
        (Some(period), None) => return period,
        (None, Some(half)) => return 2.0 * half,
        (Some(_), Some(_)) => t.excludes("swing_time", "period"),
        (None, None) => lacks(t, "period, or swing_time, its half"),
    }
    1.0
}

/// Returns the available diameters of bars, ascending.
fn diameters(t: &Place<'_>, e: &DriveEntry, unit: f64) -> Vec<f64> {
    let at = t.key("diameters");
    let entries = at.most(MOST, &e.diameters, "diameters");
    let entries = entries.map(|(at, d)| at.value("diameter", d, unit, Bound::Positive));
    let mut diameters: Vec<f64> = entries.collect();
    diameters.sort_by(f64::total_cmp);
    diameters
}

/// Returns the angle missing after a swing without the cam, if it was measured.
fn missing_angle(t: &Place<'_>, e: &DriveEntry, twist: f64) -> Option<f64> {
    let key = "missing_angle";
    let missing = e.missing_angle.as_ref().map(|c| t.key(key).angle(key, c));
    if let Some(found) = missing.filter(|m| !(0.0..twist).contains(m)) {
        let allowed = "an angle from 0 to below half the swing";
        t.key(key).bad_angle(key, found, allowed);
    }
    missing
}

/// Returns the drive of a file, if it has one.
pub(crate) fn drive(
    file: &MechanismFile,
    unit: f64,
    mechanism: Option<&Mechanism>,
    out: &Findings,
) -> Option<DriveSpec> {
    let e = file.workload.drive.as_ref()?;
    let t = &out.key("workload").key("drive");
    let allowed = "an angle above 0, up to 3600 degrees";
    let twist = t.angle_in("swing_angle", &e.swing_angle, [1e-3, 3600.0], allowed) / 2.0;
    let period = period(t, e);
    let (inertias, payload) = inertias(t, e, unit, mechanism);
    let diameters = diameters(t, e, unit);
    let missing = missing_angle(t, e, twist);
    let damping = damping(t, e);
    let cam = cam(t, e, unit);
    let push = push(t, e, twist);
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
        shear_modulus: t.figure("shear_modulus", &e.shear_modulus, 1.0, modulus),
        allowable_stress: t.figure("allowable_stress", &e.allowable_stress, 1.0, stress),
        length: t.positive("torsion_length", &e.torsion_length, unit),
        max_length: t.positive("max_length", &e.max_length, unit),
        diameters,
        missing,
        damping,
        cam,
        push,
        capture: capture.unwrap_or(1f64.to_radians()),
        programme: programme(t, e),
    })
}

/// Returns the cam's push over a swing of `twist` to either side.
fn push(t: &Place<'_>, e: &DriveEntry, twist: f64) -> Push {
    let key = "feed_from";
    let from = e
        .feed_from
        .as_ref()
        .map_or(0.0, |c| t.key(key).angle(key, c));
    if !(-twist..twist).contains(&from) {
        let allowed = "an angle within the swing, 0 being its middle";
        t.key(key).bad_angle(key, from, allowed);
    }
    let energy = t.not_negative("feed_energy", &e.feed_energy, 1.0);
    Push { energy, from }
}
