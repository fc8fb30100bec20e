//! Masses of links and the `[workload]` table.

use crate::file::findings::Findings;
use crate::file::locate::Step;
use crate::file::problem::ProblemKind;
use crate::file::read::drive::DriveEntry;
use crate::file::read::grip::GripEntry;
use crate::file::read::joint_loads::{
    MisalignmentEntry, MomentEntry, StiffnessEntry, misalignments, moments, stiffness,
};
use crate::file::read::names::link_by_id;
use crate::file::read::resolve::{index, key, vector};
use crate::file::schema::{Coordinate, LinkEntry, MechanismFile};
use crate::model::loads::{ExternalForce, Inertia, Loads, MassProperties, Stroke};
use crate::model::mechanism::Mechanism;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Most steps of a stroke.
pub const MAX_STEPS: usize = 100_000;
/// Most forces from outside.
pub(crate) const MAX_FORCES: usize = 10_000;
/// Largest mass, inertia or speed.
const LARGEST: f64 = 1e12;

/// A number, or a number with a unit in quotes: "360deg", "60rpm".
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a number, or a number with its unit in quotes such as \"360deg\""
)]
pub enum Quantity {
    /// In SI, lengths in the file's unit.
    Number(f64),
    /// With a unit.
    Text(String),
}

/// One quantity or several.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number or a list of numbers")]
pub enum Quantities {
    /// One.
    One(Quantity),
    /// Several.
    Many(Vec<Quantity>),
}

/// Inertia about the mass centre: a number for the plane, three about the axes, or six of a tensor.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected one number, or a list of 3 or 6 numbers"
)]
pub enum InertiaEntry {
    /// About the plane's normal.
    Plane(f64),
    /// xx, yy, zz, and perhaps xy, yz, zx.
    List(Vec<f64>),
}

/// Loads and drive, for `ozols statics`; a gripper, for `ozols grip`.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorkloadEntry {
    /// Acceleration of gravity in m/s², such as [0, -9.81, 0]; none where left out.
    #[serde(default)]
    pub gravity: Option<[Coordinate; 3]>,
    /// Forces from outside.
    #[serde(default)]
    pub force: Vec<ForceEntry>,
    /// Moments from outside.
    #[serde(default)]
    pub moment: Vec<MomentEntry>,
    /// Stiffness of joints by the name of their type, `default` for the rest: `[workload.stiffness.spherical]`.
    #[serde(default)]
    pub stiffness: BTreeMap<String, StiffnessEntry>,
    /// Joints made or mounted askew.
    #[serde(default)]
    pub misalignment: Vec<MisalignmentEntry>,
    /// Speed of the drive in rad/s, or the file's length unit per second; "60rpm" and "30deg/s" will do too. One for
    /// each drive where there are several.
    #[serde(default)]
    pub drive_speed: Option<Quantities>,
    /// The cycle.
    #[serde(default)]
    pub stroke: Option<StrokeEntry>,
    /// Clamping levers and what they must hold, for `ozols grip`.
    #[serde(default)]
    pub grip: Option<GripEntry>,
    /// Two discs on a torsion bar, for `ozols drive`.
    #[serde(default)]
    pub drive: Option<DriveEntry>,
}

/// A force of fixed direction at a point that moves with a link.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceEntry {
    /// The link it acts on.
    pub link: String,
    /// Its point at the pose of the file.
    pub point: [Coordinate; 3],
    /// The force in N.
    pub force: [Coordinate; 3],
    /// It acts from this position of the first drive, in each turn: radians or "90deg", or the file's length unit.
    #[serde(default)]
    pub from: Option<Quantity>,
    /// And up to this one.
    #[serde(default)]
    pub to: Option<Quantity>,
}

/// A range of the first drive's position, counted from the pose of the file.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrokeEntry {
    /// Where it begins: radians or "90deg", or the file's length unit.
    pub from: Quantity,
    /// Where it ends.
    pub to: Quantity,
    /// Number of equal steps.
    pub steps: i64,
}

/// A drive position in radians or the file's length unit: "1.5", "1.5rad", "360deg".
#[must_use]
pub fn position(text: &str) -> Option<f64> {
    with_units(text, &[("deg", 1f64.to_radians()), ("rad", 1.0)])
}

/// A drive speed in rad/s or the file's length unit per second: "6.28", "60rpm", "30deg/s".
#[must_use]
pub fn speed(text: &str) -> Option<f64> {
    let rpm = std::f64::consts::TAU / 60.0;
    let units = [("rpm", rpm), ("deg/s", 1f64.to_radians()), ("rad/s", 1.0)];
    with_units(text, &units)
}

fn with_units(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let text = text.trim();
    let (number, factor) = units
        .iter()
        .find_map(|(u, f)| text.strip_suffix(u).map(|n| (n.trim_end(), *f)))
        .unwrap_or((text, 1.0));
    let value = number.parse::<f64>().ok()? * factor;
    (value.abs() <= LARGEST).then_some(value)
}

pub(crate) fn quantity(
    q: &Quantity,
    parse: fn(&str) -> Option<f64>,
    what: &'static str,
    allowed: &'static str,
    path: &[Step],
    out: &mut Findings,
) -> f64 {
    let (value, shown) = match q {
        Quantity::Number(x) => (Some(*x).filter(|x| x.abs() <= LARGEST), x.to_string()),
        Quantity::Text(t) => (parse(t), format!("{t:?}")),
    };
    value.unwrap_or_else(|| {
        out.add(
            path,
            ProblemKind::BadQuantity {
                what,
                value: shown,
                allowed,
            },
        );
        0.0
    })
}

const POSITION: &str =
    "a number of radians or length units such as 1.5, or an angle such as \"90deg\"";
const SPEED: &str =
    "a number of rad/s or length units per second, or a speed such as \"60rpm\" or \"30deg/s\"";

/// The mass of a link, where its entry states one.
pub(crate) fn mass(entry: &LinkEntry, at: &[Step], out: &mut Findings) -> Option<MassProperties> {
    let centre = entry
        .centre
        .as_ref()
        .map(|c| vector(c, &key(at, "centre"), out));
    let mut bad = |k: &str, what, value: String, allowed| {
        let kind = ProblemKind::BadQuantity {
            what,
            value,
            allowed,
        };
        out.add(&key(at, k), kind);
    };
    let allowed = "a number from 0 to 1e12";
    let fits = |x: f64| (0.0..=LARGEST).contains(&x);
    let inertia = match &entry.inertia {
        None => None,
        Some(InertiaEntry::Plane(x)) if fits(*x) => Some(Inertia::Plane(*x)),
        Some(InertiaEntry::Plane(x)) => {
            bad("inertia", "inertia", x.to_string(), allowed);
            None
        }
        Some(InertiaEntry::List(v)) => {
            let diagonal = v.iter().take(3).all(|x| fits(*x));
            let finite = v.iter().all(|x| x.abs() <= LARGEST);
            match v[..] {
                [a, b, c] if diagonal => Some(Inertia::Principal([a, b, c])),
                [a, b, c, d, e, f] if diagonal && finite => {
                    Some(Inertia::Tensor([a, b, c, d, e, f]))
                }
                _ => {
                    let allowed = "one number, 3 about the axes or 6 of a tensor, those on the diagonal from 0 to 1e12";
                    bad("inertia", "inertia", format!("{v:?}"), allowed);
                    None
                }
            }
        }
    };
    if entry.mass.is_some_and(|x| !fits(x)) {
        let value = entry.mass.unwrap_or(0.0).to_string();
        bad("mass", "mass", value, allowed);
    }
    let missing = match (entry.mass, &centre, &entry.inertia) {
        (Some(mass), Some(centre), _) => {
            return Some(MassProperties {
                mass,
                centre: centre.clone(),
                inertia,
            });
        }
        (None, None, None) => return None,
        (Some(_), None, _) => "centre, its mass centre at the pose of the file",
        (None, _, _) => "mass, in kg",
    };
    out.add(
        at,
        ProblemKind::LinkNeeds {
            link: entry.id.clone(),
            what: missing,
        },
    );
    None
}

/// The `[workload]` table.
pub(crate) fn loads(file: &MechanismFile, mechanism: &Mechanism, out: &mut Findings) -> Loads {
    let at = [Step::Key("workload".to_owned())];
    let entry = &file.workload;
    if entry.force.len() > MAX_FORCES {
        out.add(
            &key(&at, "force"),
            ProblemKind::TooMany {
                what: "forces",
                count: entry.force.len(),
                limit: MAX_FORCES,
            },
        );
        return Loads::default();
    }
    let mut forces = Vec::new();
    for (i, f) in entry.force.iter().enumerate() {
        let at = index(&key(&at, "force"), i);
        let point = vector(&f.point, &key(&at, "point"), out);
        let force = vector(&f.force, &key(&at, "force"), out);
        let mut end = |q: &Option<Quantity>, k: &str, open: f64| {
            q.as_ref().map_or(open, |q| {
                quantity(q, position, "drive position", POSITION, &key(&at, k), out)
            })
        };
        let from = end(&f.from, "from", f64::NEG_INFINITY);
        let to = end(&f.to, "to", f64::INFINITY);
        if from > to {
            out.add(
                &key(&at, "to"),
                ProblemKind::BadQuantity {
                    what: "end of the range",
                    value: to.to_string(),
                    allowed: "at or after its beginning",
                },
            );
        }
        let Some(link) = link_by_id(&mechanism.links, &f.link, &key(&at, "link"), out) else {
            continue;
        };
        forces.push(ExternalForce {
            link,
            point,
            force,
            range: (f.from.is_some() || f.to.is_some()).then_some([from, to]),
        });
    }
    let moments = moments(entry, mechanism, &at, out);
    let stiffness = stiffness(entry, &at, out);
    let misalignments = misalignments(entry, mechanism, &at, out);
    let path = key(&at, "drive_speed");
    let drive_speeds = match &entry.drive_speed {
        None => Vec::new(),
        Some(Quantities::One(q)) => vec![quantity(q, speed, "drive speed", SPEED, &path, out)],
        Some(Quantities::Many(list)) => list
            .iter()
            .enumerate()
            .map(|(i, q)| quantity(q, speed, "drive speed", SPEED, &index(&path, i), out))
            .collect(),
    };
    let drives = mechanism.joints.iter().filter(|j| j.drive).count();
    if drive_speeds.len() > drives {
        out.add(
            &path,
            ProblemKind::TooMany {
                what: "drive speeds",
                count: drive_speeds.len(),
                limit: drives,
            },
        );
    }
    Loads {
        gravity: entry
            .gravity
            .as_ref()
            .map(|g| vector(g, &key(&at, "gravity"), out)),
        forces,
        moments,
        stiffness,
        misalignments,
        drive_speeds,
        stroke: entry
            .stroke
            .as_ref()
            .map(|s| stroke(s, &key(&at, "stroke"), out)),
        // These name joints and links; they are read once all of those are.
        grip: None,
        drive: None,
    }
}

fn stroke(s: &StrokeEntry, at: &[Step], out: &mut Findings) -> Stroke {
    let from = quantity(
        &s.from,
        position,
        "drive position",
        POSITION,
        &key(at, "from"),
        out,
    );
    let to = quantity(
        &s.to,
        position,
        "drive position",
        POSITION,
        &key(at, "to"),
        out,
    );
    let steps = usize::try_from(s.steps).unwrap_or(0);
    if !(1..=MAX_STEPS).contains(&steps) {
        out.add(
            &key(at, "steps"),
            ProblemKind::BadQuantity {
                what: "number of steps",
                value: s.steps.to_string(),
                allowed: "a whole number from 1 to 100000",
            },
        );
    }
    Stroke { from, to, steps }
}
