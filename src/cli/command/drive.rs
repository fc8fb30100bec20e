//! `ozols drive`.

use crate::cli::Done;
use crate::cli::option::args::{AnalyzeFormat, Args, File};
use crate::cli::option::load;
use crate::cli::terminal::charts;
use crate::cli::terminal::output;
use crate::drive::driving::drive;
use crate::file::read::workload::drive_from_bytes;
use crate::view;
use crate::view::drive::{charts::cam, charts::charts, charts::motion, text};
use crate::view::terminal::next_commands::{self, Step};
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Drive {
    #[command(flatten)]
    pub(in crate::cli) file: File,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(in crate::cli) format: AnalyzeFormat,
    /// Also write charts, each as SVG and CSV, the cam's profile as SVG, CSV and DXF, and the payload's motion on the first
    /// disc for `ozols grip --motion`, into this folder.
    #[arg(long, value_name = "DIR")]
    pub(in crate::cli) svg: Option<PathBuf>,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    pub(in crate::cli) output: Option<PathBuf>,
}

pub(in crate::cli) fn run(_: &Args, a: &Drive) -> anyhow::Result<Done> {
    let (name, bytes) = load::named(&a.file.file)?;
    let file = drive_from_bytes(&name, &bytes)?;
    let found = drive(&file.spec)?;
    let shown = view::drive::Drive::new(&file, &found);
    if let (Some(folder), true) = (&a.svg, shown.design.is_some()) {
        let cam = cam(&shown).map(|cam| charts::Drawing {
            name: "cam".to_owned(),
            files: vec![("svg", cam.svg()), ("csv", cam.csv()), ("dxf", cam.dxf())],
            title: cam.title,
        });
        let motion = motion(&shown).map(|table| charts::Drawing {
            name: "motion".to_owned(),
            files: vec![("csv", table)],
            title: String::new(),
        });
        let more: Vec<charts::Drawing> = cam.into_iter().chain(motion).collect();
        charts::write(folder, None, &charts(&shown), &more)?;
    }
    output::to(a.output.as_deref(), |out| {
        match a.format {
            AnalyzeFormat::Json => output::json(out, &shown)?,
            AnalyzeFormat::Text => {
                let width = output::width(a.output.as_deref());
                write!(out, "{}", text::drive(&shown, width))?;
                if a.svg.is_none() && shown.design.is_some() {
                    let gives = "charts of the programme, angle and energy over time, and the cam's profile where its radii are stated";
                    let charts = Step::new("drive", &a.file.file, "--svg charts", gives);
                    write!(out, "{}", next_commands::text(&[charts], width))?;
                }
            }
        }
        Ok(if shown.complete {
            Done::Found
        } else {
            Done::Nothing
        })
    })
}
