//! The `[workload.drive]` table.

mod inertias;
mod programme;

use crate::file::Findings;
use crate::file::locate::{DocumentStep as Place, index, key};
use crate::file::read::value::quantity::{Bound, ValueTable};
use crate::file::schema::{Coordinate, DriveEntry, MechanismFile};
use crate::model::drive::{Cam, Damping, DriveSpec, Push};
use crate::model::mechanism::Mechanism;
use inertias::inertias;
pub(crate) use programme::regular;
use programme::{MOST, programme};

fn damping(t: &mut ValueTable<'_>, e: &DriveEntry) -> Option<Damping> {
    let viscous = t.not_negative("viscous_damping", &e.viscous_damping, 1.0);
    let coulomb = t.not_negative("friction_moment", &e.friction_moment, 1.0);
    (viscous.is_some() || coulomb.is_some()).then(|| Damping {
        viscous: viscous.unwrap_or(0.0),
        coulomb: coulomb.unwrap_or(0.0),
    })
}

fn cam(t: &mut ValueTable<'_>, e: &DriveEntry, unit: f64) -> Option<Cam> {
    let stroke = t.positive("spring_stroke", &e.spring_stroke, unit);
    let mounting = t.not_negative("mounting_coefficient", &e.mounting_coefficient, 1.0);
    let efficiency = t.optional(
        "cam_efficiency",
        e.cam_efficiency.as_ref(),
        1.0,
        Bound::Range(1e-6, 1.0, "a number above 0, up to 1"),
    );
    if stroke.is_none() {
        for (k, _) in [
            ("mounting_coefficient", mounting),
            ("cam_efficiency", efficiency),
        ]
        .iter()
        .filter(|(_, v)| v.is_some())
        {
            t.needs(k, "spring_stroke beside it");
        }
    }
    let radius = t.positive("cam_radius", &e.cam_radius, unit);
    let roller = t.positive("roller_radius", &e.roller_radius, unit);
    let profile = radius.zip(roller);
    match (stroke, radius, roller) {
        (_, Some(_), None) => t.needs("cam_radius", "roller_radius beside it"),
        (_, None, Some(_)) => t.needs("roller_radius", "cam_radius beside it"),
        (None, Some(_), Some(_)) => t.needs("cam_radius", "spring_stroke beside it"),
        (Some(stroke), Some(radius), Some(roller)) if radius <= stroke + roller => {
            let path = key(&t.at, "cam_radius");
            t.bad(
                &path,
                "cam_radius",
                (radius / unit).to_string(),
                "more than spring_stroke and roller_radius together, so that the cam keeps clear of the axis",
            );
        }
        _ => {}
    }
    stroke.map(|stroke| Cam {
        stroke,
        mounting: mounting.unwrap_or(0.0),
        efficiency: efficiency.unwrap_or(1.0),
        profile,
    })
}

/// Time of a whole oscillation.
fn period(t: &mut ValueTable<'_>, e: &DriveEntry) -> f64 {
    let whole = t.positive("period", &e.period, 1.0);
    let half = t.positive("swing_time", &e.swing_time, 1.0);
    match (whole, half) {
        (Some(period), None) => period,
        (None, Some(half)) => 2.0 * half,
        (Some(_), Some(_)) => {
            t.excludes("swing_time", "period");
            1.0
        }
        (None, None) => {
            let at = t.at.clone();
            t.needs_at(&at, "drive", "period, or swing_time, its half");
            1.0
        }
    }
}

/// The diameters that bars come in, ascending.
fn diameters(t: &mut ValueTable<'_>, e: &DriveEntry, unit: f64) -> Vec<f64> {
    let at = key(&t.at, "diameters");
    let mut diameters = Vec::new();
    let entries = t.out.at_most(MOST, &e.diameters, "diameters", &at);
    for (i, d) in entries.iter().enumerate() {
        diameters.push(t.number_at(&index(&at, i), "diameter", d, unit, Bound::Positive));
    }
    diameters.sort_by(f64::total_cmp);
    diameters
}

/// The angle missing after a swing without the cam, where it was measured.
fn missing_angle(t: &mut ValueTable<'_>, e: &DriveEntry, twist: f64) -> Option<f64> {
    let missing = e
        .missing_angle
        .as_ref()
        .map(|c| t.angle("missing_angle", c));
    if let Some(found) = missing.filter(|m| !(0.0..twist).contains(m)) {
        let path = key(&t.at, "missing_angle");
        t.bad(
            &path,
            "missing_angle",
            format!("{} degrees", found.to_degrees()),
            "an angle from 0 to below half the swing",
        );
    }
    missing
}

/// The drive of a file, where it has one.
pub(crate) fn drive(
    file: &MechanismFile,
    unit: f64,
    mechanism: Option<&Mechanism>,
    out: &mut Findings,
) -> Option<DriveSpec> {
    let e = file.workload.drive.as_ref()?;
    let at = ["workload", "drive"]
        .map(|k| Place::Key(k.to_owned()))
        .to_vec();
    let t = &mut ValueTable { at, out };
    let twist = t.angle_in(
        "swing_angle",
        &e.swing_angle,
        1e-3,
        3600.0,
        "an angle above 0, up to 3600 degrees",
    ) / 2.0;
    let period = period(t, e);
    let (inertias, payload) = inertias(t, e, unit, mechanism);
    let diameters = diameters(t, e, unit);
    let missing = missing_angle(t, e, twist);
    let damping = damping(t, e);
    let cam = cam(t, e, unit);
    let push = push(t, e, twist);
    let capture = e
        .latch_capture
        .as_ref()
        .map(|c| t.angle_in("latch_capture", c, 0.0, 3600.0, "an angle from 0"));
    let modulus = "a modulus from 1e3 to 1e12 Pa, such as 8e10 for steel";
    let modulus = Bound::Range(1e3, 1e12, modulus);
    let stress = Bound::Range(1e3, 1e12, "a stress from 1e3 to 1e12 Pa, such as 4e8");
    Some(DriveSpec {
        twist,
        period,
        inertias,
        payload,
        shear_modulus: t.number("shear_modulus", &e.shear_modulus, 1.0, modulus),
        allowable_stress: t.number("allowable_stress", &e.allowable_stress, 1.0, stress),
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

/// Most pieces of a push.
const PIECES: usize = 1000;

/// The cam's push over a swing of half as much as twice `twist`.
fn push(t: &mut ValueTable<'_>, e: &DriveEntry, twist: f64) -> Push {
    if let Some(list) = &e.feed_moments {
        return pieces(t, e, list, twist);
    }
    let from = e.feed_from.as_ref();
    let from = from.map_or(0.0, |c| t.angle("feed_from", c));
    if !(-twist..twist).contains(&from) {
        let path = key(&t.at, "feed_from");
        t.bad(
            &path,
            "feed_from",
            format!("{} degrees", from.to_degrees()),
            "an angle within the swing, 0 being its middle",
        );
    }
    let energy = t.not_negative("feed_energy", &e.feed_energy, 1.0);
    Push::Even { energy, from }
}

fn pieces(t: &mut ValueTable<'_>, e: &DriveEntry, list: &[[Coordinate; 2]], twist: f64) -> Push {
    let beside = [
        ("feed_energy", e.feed_energy.is_some()),
        ("feed_from", e.feed_from.is_some()),
    ];
    for (k, _) in beside.into_iter().filter(|(_, given)| *given) {
        t.excludes(k, "feed_moments");
    }
    let at = key(&t.at, "feed_moments");
    if list.is_empty() || list.len() > PIECES {
        t.bad(&at, "number of pieces", list.len().to_string(), "1 to 1000");
        return Push::Pieces(Vec::new());
    }
    let mut pieces: Vec<(f64, f64)> = Vec::new();
    for (i, [from, moment]) in list.iter().enumerate() {
        let path = index(&at, i);
        let from = t.angle_at(&index(&path, 0), "feed_moments", from);
        let after = pieces.last().map(|p| p.0);
        if !(-twist..twist).contains(&from) || after.is_some_and(|last| from <= last) {
            t.bad(
                &index(&path, 0),
                "beginning of a piece",
                format!("{} degrees", from.to_degrees()),
                "an angle within the swing, 0 being its middle, beyond that of the piece before",
            );
        }
        let bound = match after {
            // The push begins with what pushes.
            None => Bound::Positive,
            Some(_) => Bound::NotNegative,
        };
        let moment = t.number_at(&index(&path, 1), "moment", moment, 1.0, bound);
        pieces.push((from, moment));
    }
    Push::Pieces(pieces)
}
