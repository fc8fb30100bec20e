//! `ozols grip`.

use super::args::{AnalyzeFormat, Args, Grip};
use super::{Done, charts, load, output};
use crate::import::workload::grip_from_bytes;
use crate::model::grip::{Toward, Transmission};
use crate::report::next::{self, Step};
use crate::report::{grip_charts, grip_json, grip_text};
use crate::workload::clamping::study;
use crate::workload::transmission::{Rates, rates};
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
    let transmission = match (file.spec.transmission, &file.mechanism) {
        (Transmission::Arm(arm), _) => Some(Rates {
            slides: true,
            rates: vec![1.0 / arm; 2],
        }),
        (Transmission::Joints(joints), Some(mechanism)) => Some(rates(mechanism, &joints)?),
        (Transmission::Joints(_), None) | (Transmission::Unknown, _) => None,
    };
    if let Some(folder) = &a.svg {
        charts::write(folder, &grip_charts::charts(&file, &found))?;
    }
    let report = grip_text::Report {
        file: &file,
        study: &found,
        transmission: transmission.as_ref(),
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
