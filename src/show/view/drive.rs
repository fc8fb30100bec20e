//! A torsional drive: what was found of it, from which text, JSON and charts are made. SI units, angles in radians; the keys are a
//! stable contract.

use crate::drive::driving::{Design, Driving};
use crate::drive::programme::{Endurance, Event, Ran, RunMoment};
use crate::drive::swing::End;
use crate::drive::torsion::{Sizing, log_decrement};
use crate::file::read::workload::WorkloadFile;
use crate::format::csv;
use crate::model::drive::DriveSpec;
use crate::view::prelude::*;

pub mod text;

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
    /// Creates the report on a drive of a file and its results.
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

/// Returns a step of the programme. The swing of a dwell is null.
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

/// Points drawn of a swing.
const PER_SWING: u32 = 48;

/// Returns the payload's acceleration on the first disc over the programme, in the format of `ozols grip --motion`. It is
/// for a gripper that reaches outwards from the axis (its x), with the part along the axis (its z).
pub fn motion_csv(d: &Drive<'_>) -> Option<String> {
    let (found, payload) = (d.design?, d.file.spec.payload?);
    let rows = found
        .module
        .sample_run(&found.run, PER_SWING)
        .into_iter()
        .map(|s| {
            let inwards = -s.speeds[0] * s.speeds[0] * payload.radius;
            let across = s.accelerations[0] * payload.radius;
            [s.time, inwards, across, 0.0]
                .map(|x| format!("{x:?}"))
                .to_vec()
        });
    Some(csv::write_table(&["time", "ax", "ay", "az"], rows))
}

/// Returns both charts with the names of their files. Empty without a bar.
///
/// # Examples
/// ```
/// use ozols::{drive::driving::design_drive, view::drive::{Drive, drive_charts}};
/// let text = ozols::builtin::text("torsion-module").unwrap_or_default();
/// let file = ozols::file::read::workload::drive_from_bytes("torsion-module.toml", text.as_bytes())?;
/// let found = design_drive(&file.spec)?;
/// let charts = drive_charts(&Drive::new(&file, &found));
/// assert!(!charts.is_empty() && charts.iter().all(|(_, chart)| chart.svg().starts_with("<svg")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn drive_charts(d: &Drive<'_>) -> Vec<(String, Chart)> {
    let Some(found) = d.design else {
        return Vec::new();
    };
    let samples = found.module.sample_run(&found.run, PER_SWING);
    let series = |name: &str, style, y: &dyn Fn(&RunMoment) -> f64| Series {
        name: name.to_owned(),
        points: samples.iter().map(|s| (s.time, y(s))).collect(),
        style,
    };
    let chart = |title: &str, y: &str, series| Chart {
        title: format!("{}: {title}", d.file.name),
        subtitle: String::new(),
        x: Axis::linear("time, s"),
        y: Axis::linear(y),
        series,
    };
    let angles = vec![
        series("disc 1", Style::Line, &|s| s.angles[0].to_degrees()),
        series("disc 2", Style::Dashed, &|s| s.angles[1].to_degrees()),
    ];
    let energies = vec![
        series("in the bar", Style::Line, &|s| s.potential),
        series("of the disc", Style::Dashed, &|s| s.kinetic),
        series("both", Style::Line, &|s| s.potential + s.kinetic),
    ];
    vec![
        (
            "angles".to_owned(),
            chart("angles of the discs", "angle, degrees", angles),
        ),
        ("energy".to_owned(), chart("energy", "energy, J", energies)),
    ]
}
