//! Options for reading robot descriptions and CAD assemblies.

use crate::api;
use crate::cli::option::named::Loops;
use crate::cli::terminal::output;
use crate::robots::{self, Options};
use crate::view::terminal::next_commands::shell_word;
use anyhow::{Context, ensure};
use clap::{Args as ClapArgs, ValueHint};
use itertools::Itertools;
use std::path::{Path, PathBuf};

/// Options for reading a description, the same for every command.
#[derive(Debug, ClapArgs)]
#[command(next_help_heading = "Reading a description")]
pub(crate) struct Reading {
    #[command(flatten)]
    loops: Loops,
    /// Value of a joint in radians or metres: elbow=0.3 (repeatable); several with commas for joints of several freedoms. Loops
    /// that are open in this pose are closed starting from it.
    #[arg(long, value_name = "JOINT=VALUE", allow_hyphen_values = true)]
    pose: Vec<String>,
    /// Let a robot without a fixed link float on a joint of six freedoms to the world.
    #[arg(long)]
    floating: bool,
    /// Folder of models (repeatable): SDF includes `model://NAME` from it, and MJCF includes with `../` may lead into it.
    #[arg(long, value_name = "FOLDER", value_hint = ValueHint::DirPath)]
    models: Vec<PathBuf>,
    /// SDF drawn in parts: every joint moves its child onto the frame of its parent. CAD assemblies: joints that are open in the
    /// file are closed.
    #[arg(long)]
    assemble: bool,
    /// Leave loops open that are open in the given pose.
    #[arg(long)]
    open: bool,
    /// Assembly of a FreeCAD document [default: the one with most joints].
    #[arg(long, value_name = "NAME")]
    assembly: Option<String>,
    /// Fixed link [default: the root].
    #[arg(long, value_name = "LINK")]
    frame: Option<String>,
    /// Link whose motion is the output motion (repeatable) [default: the ends of chains].
    #[arg(long, value_name = "LINK")]
    working_link: Vec<String>,
}

impl Reading {
    /// Returns the options of the import.
    pub(crate) fn import_options(&self) -> anyhow::Result<Options> {
        let mut options = Options {
            floating: self.floating,
            assemble: self.assemble,
            models: self.models.clone(),
            open: self.open,
            assembly: self.assembly.clone(),
            frame: self.frame.clone(),
            outputs: self.working_link.clone(),
            ..self.loops.import_options()?
        };
        for p in &self.pose {
            options.pose.push(parse_pose(p)?);
        }
        Ok(options)
    }

    /// Returns the options as they are typed.
    pub(crate) fn typed_flags(&self) -> String {
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
                    .map(move |v| format!("{flag} {}", shell_word(v)))
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

fn parse_pose(text: &str) -> anyhow::Result<(String, Vec<f64>)> {
    let bad = || {
        format!(
            "--pose {text}: write joint=value, in radians or metres, with commas between several values"
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
pub(crate) fn import_description(
    path: &Path,
    options: &Options,
) -> anyhow::Result<robots::Imported> {
    ensure!(
        path.is_file(),
        "{} is not a file; give the path of a URDF, MJCF, SDF, FreeCAD or OndselSolver file",
        path.display()
    );
    output::kept::keep_file(path);
    Ok(api::import(path, options)?)
}
