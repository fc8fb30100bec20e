//! A gripper over its diameters: one value from which text, JSON and charts are made. SI units, angles in radians; the keys
//! are a stable contract.

pub mod charts;
pub mod clamped;
pub mod closure;
pub mod motion;
pub mod text;

use crate::file::read::workload::WorkloadFile;
use crate::grip::clamping::{self, Hardest, HoldVerdict};
use crate::grip::holding::{ContactForce, Slip};
use crate::grip::lever_arm::{Arms, Lever};
use crate::grip::{Grip, effort};
use crate::model::claim::{Claim, Topic};
use crate::model::grip::GripSpec;
use crate::statics::transmission::Rates;
use crate::view::claims::about;
use crate::view::grip::motion::GripMotion;
use serde::Serialize;

/// What a gripper can hold.
#[derive(Debug, Serialize)]
pub struct GripReport<'a> {
    /// Its name.
    pub mechanism: &'a str,
    /// What the numbers are in.
    pub units: &'static str,
    /// The lever.
    pub lever: Lever,
    /// Whether every diameter is held in every case.
    pub holds: bool,
    /// The diameter that takes the greatest drive moment.
    pub hardest: Option<Diameter<'a>>,
    /// Every diameter, ascending.
    pub diameters: Vec<Diameter<'a>>,
    /// How the drive works on the levers at the hardest diameter, or the first.
    pub transmission: Option<Transmission<'a>>,
    /// The clamping along a motion, where one is asked about.
    pub motion: Option<GripMotion>,
    /// What is published of this gripper, so or not.
    pub claims: Vec<&'a Claim>,
    /// The file, for its units and inputs.
    #[serde(skip)]
    pub file: &'a WorkloadFile<GripSpec>,
}

/// How a drive works on two levers.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Transmission<'a> {
    /// `slides` or `turns`.
    pub drive: &'static str,
    /// Turn of each lever by travel of the drive, `[rad/m]` or `[1]`.
    pub rates: &'a [f64],
}

impl<'a> Transmission<'a> {
    fn new(r: &'a Rates) -> Self {
        Transmission {
            drive: if r.slides { "slides" } else { "turns" },
            rates: &r.rates,
        }
    }
}

/// One diameter.
#[derive(Debug, Clone, Serialize)]
pub struct Diameter<'a> {
    /// `[m]`
    pub diameter: f64,
    /// Distance of the pivots from the gripper's axis `[m]`.
    pub pivot_distance: f64,
    /// Whether the levers cross.
    pub levers_cross: bool,
    /// Arms of the clamping forces `[m]`.
    #[serde(flatten)]
    pub arms: Arms,
    /// How far the upper lever has turned `[rad]`, where it reaches.
    pub turn: Option<f64>,
    /// Centre of the part `[m]`, where the levers reach.
    pub centre: Option<[f64; 2]>,
    /// Why it cannot be held, whatever the forces.
    pub obstacles: Vec<String>,
    /// Mass of the part `[kg]`.
    pub mass: f64,
    /// How the drive works on the levers.
    pub transmission: Option<Transmission<'a>>,
    /// Whether it is held in every case.
    pub holds: bool,
    /// The hardest case, where a load is stated and nothing stands against holding.
    pub load: Option<HardestLoad<'a>>,
}

/// The hardest case of a diameter.
#[derive(Debug, Clone, Serialize)]
pub struct HardestLoad<'a> {
    /// In words.
    pub case: &'a str,
    /// On the part, with its safety factor `[N]`.
    pub force: [f64; 3],
    /// The same about the part's centre `[N·m]`.
    pub moment: [f64; 3],
    /// Whether it is held.
    pub held: bool,
    /// The least drive moment per lever that holds it `[N·m]`.
    pub drive_moment_per_lever: Option<f64>,
    /// No smaller one does `[N·m]`.
    pub lower_bound: Option<f64>,
    /// Moments on the upper and the lower lever `[N·m]`.
    pub lever_moments: Option<[f64; 2]>,
    /// What one drive of both levers takes, `[N]` or `[N·m]`.
    pub drive_effort: Option<f64>,
    /// The forces on the part.
    pub contacts: Option<Vec<PartContact>>,
    /// Why it is not held.
    pub reason: Option<String>,
}

/// A contact and its force on the part.
#[derive(Debug, Clone, Serialize)]
pub struct PartContact {
    /// Which.
    pub contact: &'static str,
    /// Where `[m]`.
    pub point: [f64; 2],
    /// Unit normal of the face, towards the part.
    pub normal_direction: [f64; 2],
    /// The force.
    #[serde(flatten)]
    pub force: ContactForce,
}

impl PartContact {
    /// Friction over the normal force; nothing where the face does not press.
    #[must_use]
    pub fn friction(&self) -> Option<f64> {
        let f = self.force;
        (f.normal > 0.0).then(|| f.along.hypot(f.axial) / f.normal)
    }
}

impl<'a> GripReport<'a> {
    /// A gripper of a file and what was found of it.
    #[must_use]
    pub fn new(file: &'a WorkloadFile<GripSpec>, found: &'a Grip) -> Self {
        let study = &found.study;
        let diameters: Vec<Diameter> = (0..study.rows.len())
            .map(|at| Diameter::new(file, &study.rows[at], found.transmission.get(at)))
            .collect();
        let hardest = study.hardest().and_then(|row| {
            let mut all = diameters.iter();
            all.find(|d| d.diameter == row.diameter).cloned()
        });
        GripReport {
            mechanism: &file.name,
            units: "SI; angles in radians",
            lever: study.lever,
            holds: study.holds(),
            transmission: hardest
                .as_ref()
                .or(diameters.first())
                .and_then(|d| d.transmission),
            hardest,
            diameters,
            motion: None,
            claims: about(&file.claims, Topic::Grip),
            file,
        }
    }
}

impl<'a> Diameter<'a> {
    fn new(
        file: &WorkloadFile<GripSpec>,
        row: &'a clamping::DiameterRow,
        transmission: Option<&'a Rates>,
    ) -> Self {
        let load = file.spec.load.as_ref();
        let friction = load.map_or(0.0, |l| l.friction);
        let case = |h: &'a Hardest| {
            let held = match &h.verdict {
                HoldVerdict::Held(held) => Some(held),
                HoldVerdict::Slips(_) | HoldVerdict::Undecided(_) => None,
            };
            let contacts = held.zip(row.pose.as_ref()).map(|(held, pose)| {
                let each = pose.contacts.iter().zip(&held.forces);
                each.map(|(c, f)| PartContact {
                    contact: c.name,
                    point: c.point,
                    normal_direction: c.normal,
                    force: *f,
                })
                .collect()
            });
            HardestLoad {
                case: &h.case,
                force: h.load.force,
                moment: h.load.moment,
                held: held.is_some(),
                drive_moment_per_lever: held.map(|h| h.drive),
                lower_bound: held.map(|h| h.lower_bound),
                lever_moments: held.map(|h| h.moments),
                drive_effort: held.and_then(|h| effort(load?.levers, h, transmission?)),
                contacts,
                reason: reason(h, friction),
            }
        };
        Diameter {
            diameter: row.diameter,
            pivot_distance: row.gripper.pivot.abs(),
            levers_cross: row.gripper.pivot < 0.0,
            arms: row.arms,
            turn: row.pose.as_ref().map(|p| p.turn),
            centre: row.pose.as_ref().map(|p| p.centre),
            obstacles: row.obstacles.iter().map(ToString::to_string).collect(),
            mass: row.mass,
            transmission: transmission.map(Transmission::new),
            holds: row.holds(),
            load: row.hardest.as_ref().map(case),
        }
    }

    /// Every reason why it is not held.
    pub(crate) fn reasons(&self) -> impl Iterator<Item = &str> {
        let forces = self.load.as_ref().and_then(|l| l.reason.as_deref());
        self.obstacles.iter().map(String::as_str).chain(forces)
    }
}

/// The motion in which a part slips, in words.
fn slip(s: &Slip) -> String {
    let names = [
        "slides outwards (x)",
        "slides across the jaws (y)",
        "slides along its axis (z)",
        "turns about x",
        "turns about y",
        "turns about its axis (z)",
    ];
    let inwards = "slides inwards (-x)";
    let parts: Vec<f64> = s.velocity.into_iter().chain(s.rotation).collect();
    let most = parts.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let told = parts
        .iter()
        .zip(names)
        .enumerate()
        .filter(|(_, (x, _))| x.abs() > 0.2 * most);
    let told = told.map(|(i, (x, n))| if i == 0 && *x < 0.0 { inwards } else { n });
    told.collect::<Vec<_>>().join(" and ")
}

/// Why the hardest case is not held.
fn reason(h: &Hardest, friction: f64) -> Option<String> {
    match &h.verdict {
        HoldVerdict::Held(_) => None,
        HoldVerdict::Undecided(e) => Some(format!("{}: {e}", h.case)),
        HoldVerdict::Slips(s) => {
            let remedy = if friction == 0.0 {
                "faces without friction cannot stop that; give friction"
            } else {
                "no closing force stops that; use more friction, deeper prisms, or pivots set for this diameter"
            };
            Some(format!("{}: the part {}; {remedy}", h.case, slip(s)))
        }
    }
}
