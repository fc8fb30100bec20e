//! A torsional drive: one value from which text, JSON and charts are made. SI units, angles in radians; the keys are a stable
//! contract.

pub(crate) mod cam;
pub mod charts;
pub mod samples;
pub mod text;

use crate::drive::driving::{self, DampingFrom, Driving};
use crate::drive::programme::{self, Event, Ran};
use crate::drive::swing::{Balance, End};
use crate::drive::torsion::{BarTrial, Remedy, decrement};
use crate::file::read::workload::WorkloadFile;
use crate::model::claim::Topic;
use crate::model::drive::DriveSpec;
use crate::view::claims::{Claim, about};
use crate::view::drive::cam::{CamData, FeedMoment, feed_moments};
use serde::Serialize;

/// A drive of a file and what was found of it.
#[derive(Debug, Serialize)]
pub struct Drive<'a> {
    /// Its name.
    pub mechanism: &'a str,
    /// What the numbers are in.
    pub units: &'static str,
    /// φ0 `[rad]`.
    pub half_swing: f64,
    /// τ `[s]`.
    pub period: f64,
    /// Of the two discs `[kg·m²]`.
    pub inertias: [f64; 2],
    /// Whether every swing ended in a latch.
    pub complete: bool,
    /// How the bar was sized.
    pub sizing: Sizing,
    /// The drive, where there is a bar.
    pub design: Option<Design>,
    /// Of drives out of true, where they were asked for.
    pub samples: Option<samples::Samples>,
    /// What is published of this drive, so or not.
    pub claims: Vec<Claim<'a>>,
    /// The file, for its units and inputs.
    #[serde(skip)]
    pub file: &'a WorkloadFile<DriveSpec>,
    /// The design as it was found, where there is a bar.
    #[serde(skip)]
    pub found: Option<&'a driving::Design>,
}

/// How a bar was sized.
#[derive(Debug, Serialize)]
pub struct Sizing {
    /// The bars tried, in order.
    pub trials: Vec<TriedBar>,
    /// What would have to change, each alone, where none was found.
    pub remedies: Option<Remedies>,
}

/// A bar that was tried.
#[derive(Debug, Serialize)]
pub struct TriedBar {
    /// l `[m]`.
    pub length: f64,
    /// d `[m]`.
    pub diameter: f64,
    /// `[φ]` `[rad]`.
    pub allowable_twist: f64,
    /// Whether (11) holds.
    pub strong: bool,
    /// Whether there is room for it.
    pub fits: bool,
}

/// What would be enough, each alone.
#[derive(Debug, Serialize)]
pub struct Remedies {
    /// A longer bar `[m]`.
    pub length_above: f64,
    /// A stronger material `[Pa]`.
    pub allowable_stress_above: f64,
    /// A longer period `[s]`.
    pub period_above: f64,
    /// A smaller φ0 `[rad]`.
    pub half_swing_below: f64,
    /// A smaller inertia `[kg·m²]`.
    pub inertia_below: f64,
}

/// A drive with a bar.
#[derive(Debug, Serialize)]
pub struct Design {
    /// l `[m]`.
    pub length: f64,
    /// d `[m]`.
    pub diameter: f64,
    /// k `[N·m/rad]`.
    pub stiffness: f64,
    /// At the rim when wound `[Pa]`.
    pub stress: f64,
    /// What takes the energy.
    pub damping: Damping,
    /// Δφ `[rad]`.
    pub missing_angle: f64,
    /// δ a swing, equation (6).
    pub decrement: f64,
    /// E_fr by equation (12) `[J]`.
    pub friction_energy: f64,
    /// The cam's work that brings the disc to its latch at rest `[J]`.
    pub needed_feed: Option<f64>,
    /// The cam's work in this run `[J]`.
    pub feed: f64,
    /// By piece of the cam's push.
    pub feed_moments: Vec<FeedMoment>,
    /// The cam's spring, where a cam is stated.
    pub cam: Option<CamData>,
    /// Of each disc.
    pub motions: [DiscMotion; 2],
    /// What comes of the programme repeated without end.
    pub endurance: Endurance,
    /// How many swings ended in a latch.
    pub latched: usize,
    /// How many were asked for.
    pub wanted: usize,
    /// The programme as it ran.
    pub programme: Vec<StepData>,
}

/// Damping of the simulation.
#[derive(Debug, Serialize)]
pub struct Damping {
    /// `[N·m·s/rad]`
    pub viscous: f64,
    /// `[N·m]`
    pub coulomb: f64,
    /// Where it comes from.
    pub from: DampingFrom,
}

/// Greatest motion of a disc.
#[derive(Debug, Serialize)]
pub struct DiscMotion {
    /// `[rad/s²]`
    pub angular_acceleration: f64,
    /// `[rad/s]`
    pub angular_speed: f64,
    /// Of the payload, where one is stated `[m/s²]`.
    pub acceleration: Option<f64>,
}

/// What comes of the programme repeated without end.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Endurance {
    /// They go on, or are still drifting when counting stops.
    Going {
        /// True; nothing while they drift.
        lasts: Option<bool>,
        /// How far short of the latch `[rad]`.
        missing: f64,
    },
    /// A latch is missed.
    Failing {
        /// False.
        lasts: bool,
        /// After so many swings.
        after: usize,
    },
}

/// A step of the programme.
#[derive(Debug, Serialize)]
pub struct StepData {
    /// When it began `[s]`.
    pub start: f64,
    /// `[s]`
    pub duration: f64,
    /// Of the discs when it began `[rad]`.
    pub angles: [f64; 2],
    /// The swing; nothing in a dwell.
    pub swing: Option<Swing>,
}

/// A swing.
#[derive(Debug, Serialize)]
pub struct Swing {
    /// 1 or 2.
    pub disc: usize,
    /// `latched`, `caught`, `missed` or `stuck`.
    pub end: &'static str,
    /// How far short of the latch `[rad]`.
    pub missing: f64,
    /// Where its energy went.
    pub energy: Energy,
}

/// Where the energy of a swing went `[J]`.
#[derive(Debug, Serialize)]
pub struct Energy {
    /// The parts.
    #[serde(flatten)]
    pub balance: Balance,
    /// What they fail to add up to.
    pub residual: f64,
}

impl<'a> Drive<'a> {
    /// A drive of a file and what was found of it.
    #[must_use]
    pub fn new(file: &'a WorkloadFile<DriveSpec>, found: &'a Driving) -> Self {
        let (spec, design) = (&file.spec, found.design.as_ref());
        let tried = |t: &BarTrial| TriedBar {
            length: t.bar.length,
            diameter: t.bar.diameter,
            allowable_twist: t.allowable_twist,
            strong: t.strong,
            fits: t.fits,
        };
        let remedies = |r: Remedy| Remedies {
            length_above: r.length,
            allowable_stress_above: r.allowable_stress,
            period_above: r.period,
            half_swing_below: r.twist,
            inertia_below: r.inertia,
        };
        Drive {
            mechanism: &file.name,
            units: "SI; angles in radians",
            half_swing: spec.twist,
            period: spec.period,
            inertias: spec.inertias,
            complete: design.is_some_and(|d| d.run.complete()),
            sizing: Sizing {
                trials: found.sizing.trials.iter().map(tried).collect(),
                remedies: found.sizing.remedy.map(remedies),
            },
            design: design.map(|d| Design::new(spec, d)),
            samples: None,
            claims: about(&file.claims, Topic::Drive),
            file,
            found: design,
        }
    }
}

impl Design {
    fn new(spec: &DriveSpec, d: &driving::Design) -> Self {
        Design {
            length: d.bar.length,
            diameter: d.bar.diameter,
            stiffness: d.stiffness,
            stress: d.bar.stress(spec.twist),
            damping: Damping {
                viscous: d.damping.viscous,
                coulomb: d.damping.coulomb,
                from: d.damping_from,
            },
            missing_angle: d.missing,
            decrement: decrement(spec.twist, spec.twist - d.missing),
            friction_energy: d.friction_energy,
            needed_feed: d.needed_feed,
            feed: d.feed,
            feed_moments: feed_moments(&d.module),
            cam: d.cam.as_ref().map(CamData::new),
            motions: d.motions.map(|m| DiscMotion {
                angular_acceleration: m.angular_acceleration,
                angular_speed: m.angular_speed,
                acceleration: m.acceleration,
            }),
            endurance: match d.endurance {
                programme::Endurance::Lasts { missing } => Endurance::Going {
                    lasts: Some(true),
                    missing,
                },
                programme::Endurance::Drifts { missing } => Endurance::Going {
                    lasts: None,
                    missing,
                },
                programme::Endurance::Fails { after } => Endurance::Failing {
                    lasts: false,
                    after,
                },
            },
            latched: d.run.latched,
            wanted: d.run.wanted,
            programme: d.run.steps.iter().map(StepData::new).collect(),
        }
    }
}

impl StepData {
    fn new(s: &Ran) -> Self {
        let swing = match &s.event {
            Event::Dwell => None,
            Event::Swing { disc, swing } => {
                let (end, missing) = match swing.end {
                    End::Latched { .. } => ("latched", 0.0),
                    End::Caught { missing } => ("caught", missing),
                    End::Missed { missing } => ("missed", missing),
                    End::Stuck => ("stuck", 0.0),
                };
                let balance = swing.balance;
                Some(Swing {
                    disc: disc + 1,
                    end,
                    missing,
                    energy: Energy {
                        balance,
                        residual: balance.residual(),
                    },
                })
            }
        };
        StepData {
            start: s.start,
            duration: s.duration,
            angles: s.angles,
            swing,
        }
    }
}
