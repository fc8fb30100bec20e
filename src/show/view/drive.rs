//! A torsional drive: what was found of it, from which text, JSON and charts are made. SI units, angles in radians; the keys are a
//! stable contract.

pub mod charts;
pub mod text;

use crate::drive::driving::{Design, Driving};
use crate::drive::programme::{Endurance, Event, Ran};
use crate::drive::swing::End;
use crate::drive::torsion::{Sizing, log_decrement};
use crate::file::read::workload::WorkloadFile;
use crate::model::claim::Topic;
use crate::model::drive::DriveSpec;
use crate::view::claims::claims_about;
use crate::view::prelude::*;

/// A drive of a file and what was found of it.
#[derive(Debug)]
pub struct Drive<'a> {
    /// The file.
    pub file: &'a WorkloadFile<DriveSpec>,
    /// How the bar was sized.
    pub sizing: &'a Sizing,
    /// The drive, if there is a bar.
    pub design: Option<&'a Design>,
}

impl<'a> Drive<'a> {
    /// A drive of a file and what was found of it.
    pub fn new(file: &'a WorkloadFile<DriveSpec>, found: &'a Driving) -> Self {
        Drive {
            file,
            sizing: &found.sizing,
            design: found.design.as_ref(),
        }
    }

    /// Returns whether every swing ended in a latch.
    pub fn is_complete(&self) -> bool {
        self.design.is_some_and(|d| d.run.is_complete())
    }

    /// Returns all of it as data.
    ///
    /// # Examples
    /// ```
    /// use ozols::{drive::driving::design_drive, view::drive::Drive};
    /// let text = ozols::builtin::text("torsion-module").unwrap_or_default();
    /// let file = ozols::file::read::workload::drive_from_bytes("torsion-module.toml", text.as_bytes())?;
    /// let found = design_drive(&file.spec)?;
    /// assert_eq!(Drive::new(&file, &found).json()["complete"], true);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn json(&self) -> Value {
        let spec = &self.file.spec;
        json!({
            "mechanism": self.file.name,
            "units": "SI; angles in radians",
            "half_swing": spec.twist,
            "period": spec.period,
            "inertias": spec.inertias,
            "complete": self.is_complete(),
            "sizing": self.sizing,
            "design": self.design.map(|d| design_json(spec, d)),
            "claims": claims_about(&self.file.claims, Topic::Drive),
        })
    }
}

fn design_json(spec: &DriveSpec, d: &Design) -> Value {
    let feed = d.module.feed;
    let moment = feed.push_moment(d.module.latch.at);
    let moments = moment.map(|moment| json!({ "from": feed.from, "moment": moment }));
    json!({
        "length": d.bar.length,
        "diameter": d.bar.diameter,
        "stiffness": d.stiffness,
        "stress": d.bar.rim_stress(spec.twist),
        "damping": {
            "viscous": d.damping.viscous,
            "coulomb": d.damping.coulomb,
            "from": d.damping_from,
        },
        "missing_angle": d.missing,
        "decrement": log_decrement(spec.twist, spec.twist - d.missing),
        "friction_energy": d.friction_energy,
        "needed_feed": d.needed_feed,
        "feed": d.feed,
        "feed_moments": Vec::from_iter(moments),
        "cam": d.cam,
        "motions": d.motions,
        "endurance": match d.endurance {
            Endurance::Lasts { missing } => json!({ "lasts": true, "missing": missing }),
            Endurance::Drifts { missing } => json!({ "lasts": null, "missing": missing }),
            Endurance::Fails { after } => json!({ "lasts": false, "after": after }),
        },
        "latched": d.run.latched,
        "wanted": d.run.wanted,
        "programme": d.run.steps.iter().map(step_json).collect::<Value>(),
    })
}

/// A step of the programme; its swing is nothing in a dwell.
fn step_json(s: &Ran) -> Value {
    let swing = match &s.event {
        Event::Dwell => Value::Null,
        Event::Swing { disc, swing } => {
            let (end, missing) = match swing.end {
                End::Latched { .. } => ("latched", 0.0),
                End::Caught { missing } => ("caught", missing),
                End::Missed { missing } => ("missed", missing),
                End::Stuck => ("stuck", 0.0),
            };
            let residual = json!({ "residual": swing.balance.residual() });
            let energy = join_objects([json!(swing.balance), residual]);
            json!({ "disc": disc + 1, "end": end, "missing": missing, "energy": energy })
        }
    };
    json!({ "start": s.start, "duration": s.duration, "angles": s.angles, "swing": swing })
}
