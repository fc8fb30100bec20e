//! The `[workload.drive]` table.

mod inertias;
mod programme;

use crate::file::findings::Findings;
use crate::file::locate::Step as Place;
use crate::file::read::quantity::{Bound, Table};
use crate::file::read::resolve::{index, key};
use crate::file::schema::{Coordinate, MechanismFile};
use crate::model::drive::{Cam, Damping, DriveSpec};
use crate::model::mechanism::Mechanism;
use inertias::inertias;
use programme::programme;
pub use programme::regular;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most steps of a programme.
const MOST: usize = 10_000;

/// Two discs on a torsion bar, for `ozols drive`. Lengths in the file's unit; angles in degrees, or as "120deg", "2.1rad",
/// "pi/2"; all else in SI units.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DriveEntry {
    /// 2 φ0, from one latched position to the next.
    pub swing_angle: Coordinate,
    /// τ in s, a whole oscillation: two swings.
    #[serde(default)]
    pub period: Option<Coordinate>,
    /// Time of one swing in s, in place of `period`.
    #[serde(default)]
    pub swing_time: Option<Coordinate>,
    /// I in kg·m², the largest inertia of a disc with its payload.
    #[serde(default)]
    pub inertia: Option<Coordinate>,
    /// Inertia in kg·m² of the bare disc, in place of `inertia`; with the payload.
    #[serde(default)]
    pub disc_inertia: Option<Coordinate>,
    /// The link whose mass and inertia are those of the bare disc, in place of `disc_inertia`; it turns on the frame.
    #[serde(default)]
    pub disc_link: Option<String>,
    /// Mass of the payload in kg, taken as a point.
    #[serde(default)]
    pub payload_mass: Option<Coordinate>,
    /// From the axis to the payload.
    #[serde(default)]
    pub payload_radius: Option<Coordinate>,
    /// Inertia of the second disc in kg·m² where it differs.
    #[serde(default)]
    pub second_inertia: Option<Coordinate>,
    /// G of the bar in Pa.
    pub shear_modulus: Coordinate,
    /// Allowable shear stress of the bar in Pa.
    pub allowable_stress: Coordinate,
    /// Length of the bar to begin with; it is lengthened until strong enough.
    #[serde(default)]
    pub torsion_length: Option<Coordinate>,
    /// Greatest length of the bar.
    #[serde(default)]
    pub max_length: Option<Coordinate>,
    /// Diameters that bars come in; any where left out.
    #[serde(default)]
    pub diameters: Vec<Coordinate>,
    /// Δφ, the angle missing after a swing without the cam, measured.
    #[serde(default)]
    pub missing_angle: Option<Coordinate>,
    /// Damping moment per speed in N·m·s/rad.
    #[serde(default)]
    pub viscous_damping: Option<Coordinate>,
    /// Moment of dry friction in N·m.
    #[serde(default)]
    pub friction_moment: Option<Coordinate>,
    /// S, stroke of the cam spring's end.
    #[serde(default)]
    pub spring_stroke: Option<Coordinate>,
    /// ψ0, deformation of the mounted spring over its stroke; 0 where left out.
    #[serde(default)]
    pub mounting_coefficient: Option<Coordinate>,
    /// η, mean efficiency of the cam; 1 where left out.
    #[serde(default)]
    pub cam_efficiency: Option<Coordinate>,
    /// Work of the cam in a swing in J, in place of what friction takes by equation (12).
    #[serde(default)]
    pub feed_energy: Option<Coordinate>,
    /// Where the cam begins to push, from the middle of the swing; the middle where left out. It pushes up to the latch.
    #[serde(default)]
    pub feed_from: Option<Coordinate>,
    /// How far short of its groove a latch still catches a disc; 1 degree where left out.
    #[serde(default)]
    pub latch_capture: Option<Coordinate>,
    /// "stepwise" (the default): the discs take turns, and both step on the same way; "reversing": one disc goes to and fro.
    #[serde(default)]
    pub motion: Option<String>,
    /// Number of swings; 8 where left out.
    #[serde(default)]
    pub swings: Option<i64>,
    /// Dwell after each swing in s; none where left out.
    #[serde(default)]
    pub dwell: Option<Coordinate>,
    /// In place of `motion`, `swings` and `dwell`: steps such as ["1", "wait 0.3", "2"], a disc swinging or a dwell in s.
    #[serde(default)]
    pub programme: Option<Vec<String>>,
}

fn damping(t: &mut Table<'_>, e: &DriveEntry) -> Option<Damping> {
    let viscous = t.not_negative("viscous_damping", &e.viscous_damping, 1.0);
    let coulomb = t.not_negative("friction_moment", &e.friction_moment, 1.0);
    (viscous.is_some() || coulomb.is_some()).then(|| Damping {
        viscous: viscous.unwrap_or(0.0),
        coulomb: coulomb.unwrap_or(0.0),
    })
}

fn cam(t: &mut Table<'_>, e: &DriveEntry, unit: f64) -> Option<Cam> {
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
    stroke.map(|stroke| Cam {
        stroke,
        mounting: mounting.unwrap_or(0.0),
        efficiency: efficiency.unwrap_or(1.0),
    })
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
    let t = &mut Table { at, out };
    let twist = t.angle_in(
        "swing_angle",
        &e.swing_angle,
        (1e-3, 3600.0),
        "an angle above 0, up to 3600 degrees",
    ) / 2.0;
    let whole = t.positive("period", &e.period, 1.0);
    let half = t.positive("swing_time", &e.swing_time, 1.0);
    let period = match (whole, half) {
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
    };
    let (inertias, payload) = inertias(t, e, unit, mechanism);
    let at = key(&t.at, "diameters");
    let mut diameters = Vec::new();
    for (i, d) in e.diameters.iter().take(MOST).enumerate() {
        diameters.push(t.number_at(&index(&at, i), "diameter", d, unit, Bound::Positive));
    }
    diameters.sort_by(f64::total_cmp);
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
    let damping = damping(t, e);
    let cam = cam(t, e, unit);
    let feed_from = e
        .feed_from
        .as_ref()
        .map_or(0.0, |c| t.angle("feed_from", c));
    if !(-twist..twist).contains(&feed_from) {
        let path = key(&t.at, "feed_from");
        t.bad(
            &path,
            "feed_from",
            format!("{} degrees", feed_from.to_degrees()),
            "an angle within the swing, 0 being its middle",
        );
    }
    let capture = e
        .latch_capture
        .as_ref()
        .map(|c| t.angle_in("latch_capture", c, (0.0, 3600.0), "an angle from 0"));
    Some(DriveSpec {
        twist,
        period,
        inertias,
        payload,
        shear_modulus: t.number(
            "shear_modulus",
            &e.shear_modulus,
            1.0,
            Bound::Range(
                1e3,
                1e12,
                "a modulus from 1e3 to 1e12 Pa, such as 8e10 for steel",
            ),
        ),
        allowable_stress: t.number(
            "allowable_stress",
            &e.allowable_stress,
            1.0,
            Bound::Range(1e3, 1e12, "a stress from 1e3 to 1e12 Pa, such as 4e8"),
        ),
        length: t.positive("torsion_length", &e.torsion_length, unit),
        max_length: t.positive("max_length", &e.max_length, unit),
        diameters,
        missing,
        damping,
        cam,
        feed: t.not_negative("feed_energy", &e.feed_energy, 1.0),
        feed_from,
        capture: capture.unwrap_or(1f64.to_radians()),
        programme: programme(t, e),
    })
}
