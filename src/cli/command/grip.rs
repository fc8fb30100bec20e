//! `ozols grip`.

pub(in crate::cli) mod args;

use crate::api::MAX_DESCRIPTION_BYTES;
use crate::cli::command::closure;
use crate::cli::done::Done;
use crate::cli::option::format::TextOrJson;
use crate::cli::option::global::Global;
use crate::cli::option::load;
use crate::cli::terminal::charts;
use crate::cli::terminal::output;
use crate::file::disk;
use crate::file::read::workload::trajectory::trajectory;
use crate::file::read::workload::{WorkloadFile, grip_from_bytes};
use crate::grip::grip;
use crate::grip::motion::along;
use crate::model::grip::{GripSpec, MotionStep, Toward};
use crate::view;
use crate::view::grip::{charts::charts, motion::GripMotion, text};
use crate::view::terminal::next_commands::{self, NextCommand};
use anyhow::{Context, bail, ensure};
use args::Grip;
use std::path::Path;

pub(in crate::cli) fn run(args: &Global, a: &Grip) -> anyhow::Result<Done> {
    if a.closure {
        return closure::run(args, a);
    }
    let (name, bytes) = load::named(&a.file)?;
    let mut file = grip_from_bytes(&name, &bytes)?;
    add_accelerations(&mut file, a)?;
    let steps = match &a.motion {
        Some(path) => Some(steps_of(path, &mut file)?),
        None => None,
    };
    let found = grip(&file.spec, file.mechanism.as_ref())?;
    let mut shown = view::grip::GripReport::new(&file, &found);
    if let Some(steps) = steps {
        let along = along(&file.spec, &found, &steps)?;
        shown.motion = Some(GripMotion::new(&along, file.length_unit));
    }
    if let Some(folder) = &a.svg {
        charts::write(folder, None, &charts(&shown), &[])?;
    }
    output::to(a.output.as_deref(), |out| {
        match a.format {
            TextOrJson::Json => output::json(out, &shown)?,
            TextOrJson::Text => {
                let width = output::width(a.output.as_deref());
                write!(out, "{}", text::grip(&shown, width))?;
                if a.svg.is_none() {
                    let gives = "charts of the arms and the drive moment";
                    let charts = NextCommand::new("grip", &a.file.file, "--svg charts", gives);
                    write!(out, "{}", next_commands::text(&[charts], width))?;
                }
            }
        }
        let held_along = shown.motion.as_ref().is_none_or(|m| m.holds);
        Ok(if shown.holds && held_along {
            Done::Found
        } else {
            Done::Nothing
        })
    })
}

/// Adds the accelerations of the command line to the load of the file.
fn add_accelerations(file: &mut WorkloadFile<GripSpec>, a: &Grip) -> anyhow::Result<()> {
    let mut further: Vec<Toward> = a.acceleration.iter().map(|v| Toward::Fixed(*v)).collect();
    if let Some(size) = a.any_acceleration {
        ensure!(
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
    Ok(())
}

/// Reads a motion, whose parts are studied along with the others.
fn steps_of(path: &Path, file: &mut WorkloadFile<GripSpec>) -> anyhow::Result<Vec<MotionStep>> {
    let bytes = disk::at_most(path, MAX_DESCRIPTION_BYTES)
        .with_context(|| format!("cannot read {}", path.display()))?;
    let steps = trajectory(&path.display().to_string(), &bytes, file.length_unit.metres)?;
    let parts = steps
        .iter()
        .map(|s| s.diameter.unwrap_or(file.spec.diameter));
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a;
    for part in parts.collect::<Vec<f64>>() {
        if !file.spec.diameters.iter().any(|d| near(*d, part)) {
            file.spec.diameters.push(part);
        }
    }
    file.spec.diameters.sort_by(f64::total_cmp);
    Ok(steps)
}
