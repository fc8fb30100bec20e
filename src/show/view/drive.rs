//! A torsional drive: one value from which text, JSON and charts are made. SI units, angles in radians; the keys are a stable
//! contract.

pub mod charts;
pub mod samples;
pub mod text;

use crate::drive::driving::{self, CamDesign, DampingFrom, Driving, PayloadMotion};
use crate::drive::programme::{self, Event, Module, Ran};
use crate::drive::swing::{Balance, End};
use crate::drive::torsion::{Sizing, decrement};
use crate::file::read::workload::WorkloadFile;
use crate::model::claim::{Claim, Topic};
use crate::model::drive::DriveSpec;
use crate::view::claims::about;
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
    pub sizing: &'a Sizing,
    /// The drive, where there is a bar.
    pub design: Option<Design<'a>>,
    /// Of drives out of true, where they were asked for.
    pub samples: Option<samples::Samples>,
    /// What is published of this drive, so or not.
    pub claims: Vec<&'a Claim>,
    /// The file, for its units and inputs.
    #[serde(skip)]
    pub file: &'a WorkloadFile<DriveSpec>,
    /// The design as it was found, where there is a bar.
    #[serde(skip)]
    pub found: Option<&'a driving::Design>,
}

/// A drive with a bar.
#[derive(Debug, Serialize)]
pub struct Design<'a> {
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
    pub cam: Option<&'a CamDesign>,
    /// Of each disc.
    pub motions: [PayloadMotion; 2],
    /// What comes of the programme repeated without end.
    pub endurance: Endurance,
    /// How many swings ended in a latch.
    pub latched: usize,
    /// How many were asked for.
    pub wanted: usize,
    /// The programme as it ran.
    pub programme: Vec<StepData>,
}

/// A piece of the cam's push.
#[derive(Debug, Serialize)]
pub struct FeedMoment {
    /// Where it begins, from the middle of the swing `[rad]`.
    pub from: f64,
    /// `[N·m]`
    pub moment: f64,
}

/// The pieces of the push of a drive, each up to the next and the last up to the latch; none where nothing is fed.
#[must_use]
pub(crate) fn feed_moments(module: &Module) -> Vec<FeedMoment> {
    let pieces = module.feed.moments(module.latch.at).into_iter();
    let piece = |([from, _], moment): ([f64; 2], f64)| FeedMoment { from, moment };
    pieces.map(piece).collect()
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
        Drive {
            mechanism: &file.name,
            units: "SI; angles in radians",
            half_swing: spec.twist,
            period: spec.period,
            inertias: spec.inertias,
            complete: design.is_some_and(|d| d.run.complete()),
            sizing: &found.sizing,
            design: design.map(|d| Design::new(spec, d)),
            samples: None,
            claims: about(&file.claims, Topic::Drive),
            file,
            found: design,
        }
    }
}

impl<'a> Design<'a> {
    fn new(spec: &DriveSpec, d: &'a driving::Design) -> Self {
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
            cam: d.cam.as_ref(),
            motions: d.motions,
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
