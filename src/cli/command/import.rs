//! `ozols import`.

use crate::api;
use crate::cli::done::Done;
use crate::cli::option::named::{Loops, Named};
use crate::cli::terminal::output;
use crate::robots::{self, Options};
use crate::view::terminal::layout::fit;
use crate::view::terminal::next_commands::{self, NextCommand};
use anyhow::{Context, ensure};
use clap::{Args as ClapArgs, ValueEnum, ValueHint};
use itertools::Itertools;
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ImportFormat {
    Toml,
    Json,
}

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

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Import {
    /// A robot description (URDF, MJCF or SDF, by its root element) or a CAD assembly (FreeCAD's .FCStd, OndselSolver's .asmt).
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: Named,
    #[command(flatten)]
    pub(in crate::cli) reading: Reading,
    /// Output format.
    #[arg(long, value_enum, default_value = "toml")]
    format: ImportFormat,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Reading {
    /// The options of the import.
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

    /// The same as they are typed.
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
                values
                    .iter()
                    .map(move |v| format!("{flag} {}", next_commands::word(v)))
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

pub(in crate::cli) fn run(a: &Import) -> anyhow::Result<Done> {
    let options = a.reading.options()?;
    let imported = description(a.file.path(), &options)?;
    let width = output::error_width();
    output::note(&fit(&imported.report.text(&a.file), width));
    output::to(a.output.as_deref(), |out| {
        match a.format {
            ImportFormat::Toml => write!(out, "{}", imported.toml()?)?,
            ImportFormat::Json => writeln!(out, "{:#}", imported.file.json())?,
        }
        Ok(Done::Found)
    })?;
    if let Some(path) = &a.output {
        let file = path.display().to_string();
        let steps = [
            ("analyze", "its mobility and redundant constraints"),
            ("search", "the redesigns that remove those"),
        ];
        let steps = steps.map(|(command, gives)| NextCommand::new(command, &file, "", gives));
        output::note(&next_commands::text(&steps, output::error_width()));
    }
    Ok(Done::Found)
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

/// Imports a description.
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
