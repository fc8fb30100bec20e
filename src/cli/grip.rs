//! `ozols grip`.

use super::args::{AnalyzeFormat, Args, Grip};
use super::{Done, charts, load, output};
use crate::file::read::workload::{Workload, grip_from_bytes};
use crate::grip::clamping::{Row, Study, study};
use crate::grip::jaw_loads::{Gripping, JawError};
use crate::model::grip::{GripSpec, Toward, Transmission};
use crate::model::mechanism::StateId;
use crate::motion::pose::Pose;
use crate::statics::transmission::{Rates, rates};
use crate::view::next::{self, Step};
use crate::view::{grip_charts, grip_json, grip_text};
use anyhow::bail;

pub(super) fn run(_: &Args, a: &Grip) -> anyhow::Result<Done> {
    let (name, bytes) = load::named(&a.file.file)?;
    let mut file = grip_from_bytes(&name, &bytes)?;
    let mut further: Vec<Toward> = a.acceleration.iter().map(|v| Toward::Fixed(*v)).collect();
    if let Some(size) = a.any_acceleration {
        anyhow::ensure!(
            (0.0..=1e6).contains(&size),
            "--any-acceleration must be a number from 0 to 1e6 m/s²"
        );
        further.push(Toward::Any(size));
    }
    match &mut file.spec.load {
        Some(load) => load.accelerations.extend(further),
        None if further.is_empty() => {}
        None => bail!(
            "{} states no load; give [workload.grip] a mass and friction before accelerations",
            file.name
        ),
    }
    let found = study(&file.spec)?;
    let transmission = transmission(&file, &found)?;
    if let Some(folder) = &a.svg {
        charts::write(folder, &grip_charts::charts(&file, &found))?;
    }
    let report = grip_text::Report {
        file: &file,
        study: &found,
        transmission: &transmission,
    };
    output::to(a.output.as_deref(), |out| {
        match a.format {
            AnalyzeFormat::Json => writeln!(out, "{:#}", grip_json::grip(&report))?,
            AnalyzeFormat::Text => {
                let width = output::width(a.output.as_deref());
                write!(out, "{}", grip_text::grip(&report, width))?;
                if a.svg.is_none() {
                    let gives = "charts of the arms, the contact forces and the drive moment";
                    let charts = Step::new("grip", &a.file.file, "--svg charts", gives);
                    write!(out, "{}", next::text(&[charts], width))?;
                }
            }
        }
        Ok(if found.holds() {
            Done::Found
        } else {
            Done::Nothing
        })
    })
}

/// How the drive works on the levers, diameter by diameter; empty where the file does not say.
fn transmission(file: &Workload<GripSpec>, found: &Study) -> anyhow::Result<Vec<Rates>> {
    let rows = &found.rows;
    match (file.spec.transmission, &file.mechanism) {
        (Transmission::Arm(arm), _) => {
            let rates = vec![1.0 / arm; 2];
            Ok(vec![
                Rates {
                    slides: true,
                    rates
                };
                rows.len()
            ])
        }
        (Transmission::Joints(joints), Some(m)) => {
            let at_home = rates(m, &Pose::of_file(m, StateId::FREE)?, &joints)?;
            let states = file
                .spec
                .contacts
                .and_then(|c| m.joints[c[0]].states.as_ref());
            let state = states.and_then(|s| s.first());
            let gripping = match state.map(|&s| Gripping::of_study(m, s, found.clone())) {
                // Without contacts nobody knows which way the levers turn.
                None | Some(Ok(None) | Err(JawError::Nominal(_))) => None,
                Some(other) => other?,
            };
            let there = |row: &Row| match &gripping {
                Some(g) if row.holds() => Ok(rates(m, &g.fit(row)?.pose, &joints)?),
                _ => Ok(at_home.clone()),
            };
            rows.iter().map(there).collect()
        }
        (Transmission::Joints(_), None) | (Transmission::Unknown, _) => Ok(Vec::new()),
    }
}
