//! How robot descriptions and CAD assemblies are read.

use crate::api;
use crate::cli::option::named::Loops;
use crate::cli::terminal::output;
use crate::robots::{self, Options};
use crate::view::terminal::next_commands::word;
use anyhow::{Context, ensure};
use clap::{Args as ClapArgs, ValueHint};
use itertools::Itertools;
use std::path::{Path, PathBuf};

/// How a description is read: the same for every command that reads one.
#[derive(Debug, ClapArgs)]
#[command(next_help_heading = "How a description is read")]
pub(in crate::cli) struct Reading {
    #[command(flatten)]
    loops: Loops,
    /// Value of a joint in radians or metres: elbow=0.3 (repeatable); several with commas for joints of several
    /// freedoms. Loops that are open there are closed from there.
    #[arg(long, value_name = "JOINT=VALUE", allow_hyphen_values = true)]
    pose: Vec<String>,
    /// Let a robot without a fixed link float: a joint of six freedoms to the world.
    #[arg(long)]
    floating: bool,
    /// A folder of models (repeatable): what `model://NAME` of an SDF include stands for, and where MJCF includes with `../` may
    /// lead.
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    models: Vec<PathBuf>,
    /// SDF drawn in parts: every joint puts the frame that is its parent onto its child. CAD assemblies: joints that are open in
    /// the file are closed.
    #[arg(long)]
    assemble: bool,
    /// Take loops that are open in the given pose as they are.
    #[arg(long)]
    open: bool,
    /// The assembly of a FreeCAD document; the one with most joints by default.
    #[arg(long, value_name = "NAME")]
    assembly: Option<String>,
    /// The fixed link; the root by default.
    #[arg(long, value_name = "LINK")]
    frame: Option<String>,
    /// A link whose motion is the working motion (repeatable); the ends of chains by default.
    #[arg(long, value_name = "LINK")]
    working_link: Vec<String>,
}

impl Reading {
    /// Returns the options of the import.
    pub(in crate::cli) fn options(&self) -> anyhow::Result<Options> {
        let mut options = Options {
            floating: self.floating,
            assemble: self.assemble,
            models: self.models.clone(),
            open: self.open,
            assembly: self.assembly.clone(),
            frame: self.frame.clone(),
            outputs: self.working_link.clone(),
            ..self.loops.options()?
        };
        for p in &self.pose {
            options.pose.push(pose(p)?);
        }
        Ok(options)
    }

    /// Returns the options as they are typed.
    pub(in crate::cli) fn flags(&self) -> String {
        let path = |p: &PathBuf| p.display().to_string();
        let valued = [
            ("--loops", self.loops.path.iter().map(path).collect()),
            ("--pose", self.pose.clone()),
            ("--models", self.models.iter().map(path).collect()),
            ("--assembly", self.assembly.iter().cloned().collect()),
            ("--frame", self.frame.iter().cloned().collect()),
            ("--working-link", self.working_link.clone()),
        ];
        let valued = valued
            .iter()
            .flat_map(|(flag, values): &(&str, Vec<String>)| {
                values.iter().map(move |v| format!("{flag} {}", word(v)))
            });
        let switches = [
            ("--floating", self.floating),
            ("--assemble", self.assemble),
            ("--open", self.open),
        ];
        let switches = switches.iter().filter(|s| s.1).map(|s| s.0.to_owned());
        valued.chain(switches).join(" ")
    }
}

fn pose(text: &str) -> anyhow::Result<(String, Vec<f64>)> {
    let bad = || {
        format!(
            "--pose {text}: write joint=value, in radians or metres, with commas between several"
        )
    };
    let (joint, values) = text.rsplit_once('=').with_context(bad)?;
    let values = values
        .split(',')
        .map(|v| v.trim().parse::<f64>())
        .collect::<Result<Vec<_>, _>>()
        .with_context(bad)?;
    Ok((joint.to_owned(), values))
}

/// Returns the mechanism of a description, with the report on it.
pub(in crate::cli) fn description(
    path: &Path,
    options: &Options,
) -> anyhow::Result<robots::Imported> {
    ensure!(
        path.is_file(),
        "{} is not a file; give the path of a URDF, MJCF, SDF, FreeCAD or OndselSolver file",
        path.display()
    );
    output::kept::keep(path);
    Ok(api::import(path, options)?)
}
