//! The `[workload.drive]` table.

use crate::geom::expr::Expr;
use crate::import::locate::Step as Place;
use crate::import::problem::ProblemKind;
use crate::import::quantity::{Bound, Table, word};
use crate::import::resolve::{Findings, index, key};
use crate::import::schema::{Coordinate, MechanismFile};
use crate::model::drive::{Cam, Damping, DriveSpec, Payload, Step};
use crate::model::joint_type::JointType;
use crate::model::loads::Inertia;
use crate::model::mechanism::Mechanism;
use itertools::Itertools;
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

/// So many swings, of both discs in turn or of the second alone, with a dwell after each where one is given.
#[must_use]
pub fn regular(stepwise: bool, swings: usize, dwell: Option<f64>) -> Vec<Step> {
    let mut steps = Vec::new();
    for i in 0..swings {
        // The second disc goes first, so that the first, which is ahead, is followed.
        steps.push(Step::Swing(if stepwise { (i + 1) % 2 } else { 1 }));
        steps.extend(dwell.map(Step::Dwell));
    }
    steps
}

fn programme(t: &mut Table<'_>, e: &DriveEntry) -> Vec<Step> {
    let dwell = t.optional(
        "dwell",
        e.dwell.as_ref(),
        1.0,
        Bound::Range(0.0, 1e6, "a time from 0 to 1e6 s"),
    );
    let Some(list) = &e.programme else {
        let stepwise = word(
            t,
            "motion",
            e.motion.as_ref(),
            &[("stepwise", true), ("reversing", false)],
        );
        let count = e.swings.unwrap_or(8);
        let Some(count) = usize::try_from(count)
            .ok()
            .filter(|n| (1..=MOST).contains(n))
        else {
            let path = key(&t.at, "swings");
            t.bad(
                &path,
                "number of swings",
                count.to_string(),
                "a whole number from 1 to 10000",
            );
            return Vec::new();
        };
        return regular(stepwise, count, dwell.filter(|d| *d > 0.0));
    };
    let beside = [
        ("motion", e.motion.is_some()),
        ("swings", e.swings.is_some()),
        ("dwell", e.dwell.is_some()),
    ];
    for (k, _) in beside.into_iter().filter(|(_, given)| *given) {
        t.excludes(k, "programme");
    }
    let at = key(&t.at, "programme");
    if list.is_empty() || list.len() > MOST {
        t.bad(&at, "number of steps", list.len().to_string(), "1 to 10000");
        return Vec::new();
    }
    let step = |text: &str| match text.trim() {
        "1" => Some(Step::Swing(0)),
        "2" => Some(Step::Swing(1)),
        other => {
            let time = other
                .strip_prefix("wait")?
                .trim()
                .trim_end_matches('s')
                .trim_end()
                .parse::<f64>()
                .ok()?;
            (0.0..=1e6).contains(&time).then_some(Step::Dwell(time))
        }
    };
    let mut steps = Vec::new();
    for (i, text) in list.iter().enumerate() {
        match step(text) {
            Some(s) => steps.push(s),
            None => t.bad(
                &index(&at, i),
                "step",
                format!("{text:?}"),
                "\"1\", \"2\" or a dwell such as \"wait 0.3\"",
            ),
        }
    }
    steps
}

/// Inertia of a link about the axis it turns on the frame about.
fn link_inertia(
    t: &mut Table<'_>,
    id: &str,
    unit: f64,
    mechanism: Option<&Mechanism>,
) -> Option<f64> {
    let path = key(&t.at, "disc_link");
    let Some(m) = mechanism else {
        t.needs(
            "disc_link",
            "a mechanism in the same file: links and joints",
        );
        return None;
    };
    let Some(l) = m.link(id) else {
        let known = m.links.iter().take(30).map(|l| l.id.as_str()).join(", ");
        t.out.add(
            &path,
            ProblemKind::UnknownLink {
                id: id.to_owned(),
                known,
            },
        );
        return None;
    };
    let hinge = m.joints_in(0).map(|j| &m.joints[j]).find(|j| {
        j.joint_type == JointType::Revolute && j.links.contains(&l) && j.links.contains(&m.frame())
    });
    let mass = m.links[l]
        .mass
        .as_ref()
        .and_then(|p| Some((p, p.inertia.as_ref()?)));
    let (Some(hinge), Some((body, inertia))) = (hinge, mass) else {
        t.needs(
            "disc_link",
            "a link with mass, centre and inertia, and a revolute joint to the frame",
        );
        return None;
    };
    let real = |v: &[Expr; 3]| [v[0].to_f64(), v[1].to_f64(), v[2].to_f64()];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (axis, centre, point) = (
        real(&hinge.frame.axis),
        real(&body.centre),
        real(&hinge.frame.point),
    );
    let size = dot(axis, axis).sqrt();
    let [x, y, z] = axis.map(|c| c / size);
    let about = match *inertia {
        Inertia::Plane(i) => i,
        Inertia::Principal([a, b, c]) => a * x * x + b * y * y + c * z * z,
        Inertia::Tensor([xx, yy, zz, xy, yz, zx]) => {
            xx * x * x + yy * y * y + zz * z * z + 2.0 * (xy * x * y + yz * y * z + zx * z * x)
        }
    };
    let from = [0, 1, 2].map(|i| (centre[i] - point[i]) * unit);
    let along = dot(from, [x, y, z]);
    Some(about + body.mass * (dot(from, from) - along * along).max(0.0))
}

fn inertias(
    t: &mut Table<'_>,
    e: &DriveEntry,
    unit: f64,
    mechanism: Option<&Mechanism>,
) -> ([f64; 2], Option<Payload>) {
    let mass = t.optional(
        "payload_mass",
        e.payload_mass.as_ref(),
        1.0,
        Bound::Positive,
    );
    let radius = t.optional(
        "payload_radius",
        e.payload_radius.as_ref(),
        unit,
        Bound::NotNegative,
    );
    let disc = t.optional(
        "disc_inertia",
        e.disc_inertia.as_ref(),
        1.0,
        Bound::NotNegative,
    );
    let disc = match (disc, &e.disc_link) {
        (Some(_), Some(_)) => {
            t.excludes("disc_link", "disc_inertia");
            disc
        }
        (None, Some(id)) => Some(link_inertia(t, id, unit, mechanism).unwrap_or(1.0)),
        (_, None) => disc,
    };
    let whole = t.optional("inertia", e.inertia.as_ref(), 1.0, Bound::Positive);
    let payload = match (mass, radius) {
        (Some(mass), Some(radius)) => Some(Payload { mass, radius }),
        // The radius alone tells how far out accelerations are wanted.
        (None, Some(radius)) if whole.is_some() => Some(Payload { mass: 0.0, radius }),
        (None, None) => None,
        (Some(_), None) => {
            t.needs("payload_mass", "payload_radius beside it");
            None
        }
        (None, Some(_)) => {
            t.needs("payload_radius", "payload_mass beside it");
            None
        }
    };
    let first = match (whole, disc, payload) {
        (Some(i), None, _) => i,
        (Some(_), Some(_), _) => {
            t.excludes("disc_inertia", "inertia");
            1.0
        }
        (None, Some(disc), payload) => {
            let sum = disc + payload.map_or(0.0, |p| p.mass * p.radius * p.radius);
            if sum <= 0.0 {
                let path = key(&t.at, "disc_inertia");
                t.bad(
                    &path,
                    "inertia",
                    sum.to_string(),
                    "a disc or a payload with an inertia above 0",
                );
                return ([1.0; 2], payload);
            }
            sum
        }
        (None, None, _) => {
            let at = t.at.clone();
            t.needs_at(
                &at,
                "drive",
                "inertia, or disc_inertia with payload_mass and payload_radius",
            );
            1.0
        }
    };
    let second = t.optional(
        "second_inertia",
        e.second_inertia.as_ref(),
        1.0,
        Bound::Positive,
    );
    ([first, second.unwrap_or(first)], payload)
}

/// The drive of a file, where it has one.
pub(super) fn drive(
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
    let whole = t.optional("period", e.period.as_ref(), 1.0, Bound::Positive);
    let half = t.optional("swing_time", e.swing_time.as_ref(), 1.0, Bound::Positive);
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
    let viscous = t.optional(
        "viscous_damping",
        e.viscous_damping.as_ref(),
        1.0,
        Bound::NotNegative,
    );
    let coulomb = t.optional(
        "friction_moment",
        e.friction_moment.as_ref(),
        1.0,
        Bound::NotNegative,
    );
    let damping = (viscous.is_some() || coulomb.is_some()).then(|| Damping {
        viscous: viscous.unwrap_or(0.0),
        coulomb: coulomb.unwrap_or(0.0),
    });
    let stroke = t.optional(
        "spring_stroke",
        e.spring_stroke.as_ref(),
        unit,
        Bound::Positive,
    );
    let mounting = t.optional(
        "mounting_coefficient",
        e.mounting_coefficient.as_ref(),
        1.0,
        Bound::NotNegative,
    );
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
    let cam = stroke.map(|stroke| Cam {
        stroke,
        mounting: mounting.unwrap_or(0.0),
        efficiency: efficiency.unwrap_or(1.0),
    });
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
        length: t.optional(
            "torsion_length",
            e.torsion_length.as_ref(),
            unit,
            Bound::Positive,
        ),
        max_length: t.optional("max_length", e.max_length.as_ref(), unit, Bound::Positive),
        diameters,
        missing,
        damping,
        cam,
        feed: t.optional(
            "feed_energy",
            e.feed_energy.as_ref(),
            1.0,
            Bound::NotNegative,
        ),
        feed_from,
        capture: capture.unwrap_or(1f64.to_radians()),
        programme: programme(t, e),
    })
}
