//! `ozols drive`.

use crate::cli::option::named::File;
use crate::cli::option::{TextOrJson, load};
use crate::cli::terminal::{Done, charts, output};
use crate::drive::driving::drive;
use crate::file::read::workload::drive_from_bytes;
use crate::view;
use crate::view::drive::{charts::charts, charts::motion, text};
use crate::view::terminal::next_commands::{self, NextCommand};
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Drive {
    #[command(flatten)]
    pub(in crate::cli) file: File,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(in crate::cli) format: TextOrJson,
    /// Also write to this folder: charts as SVG and CSV, and the payload's motion on the first disc for `ozols grip --motion`.
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) svg: Option<PathBuf>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(in crate::cli) output: Option<PathBuf>,
}

pub(in crate::cli) fn run(a: &Drive) -> anyhow::Result<Done> {
    let (name, bytes) = load::named(&a.file)?;
    let file = drive_from_bytes(&name, &bytes)?;
    let found = drive(&file.spec)?;
    let shown = view::drive::Drive::new(&file, &found);
    if let (Some(folder), true) = (&a.svg, shown.design.is_some()) {
        let motion = motion(&shown).map(|table| charts::ChartDrawing {
            name: "motion".to_owned(),
            files: vec![("csv", table)],
            title: String::new(),
        });
        charts::write(folder, None, &charts(&shown), &Vec::from_iter(motion))?;
    }
    output::to(a.output.as_deref(), |out| {
        match a.format {
            TextOrJson::Json => output::json(out, &shown.json())?,
            TextOrJson::Text => {
                let width = output::width(a.output.as_deref());
                write!(out, "{}", text::drive(&shown, width))?;
                if a.svg.is_none() && shown.design.is_some() {
                    let gives = "charts of the programme: angle and energy over time";
                    let charts = NextCommand::new("drive", &a.file.file, "--svg charts", gives);
                    write!(out, "{}", next_commands::text(&[charts], width))?;
                }
            }
        }
        Ok(if shown.complete() {
            Done::Found
        } else {
            Done::Nothing
        })
    })
}
