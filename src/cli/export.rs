//! `ozols export`.

use super::args::{Args, File};
use super::request::Which;
use super::{Done, load, output, variant};
use crate::api::{self, Format};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ExportFormat {
    /// The mechanism file, every joint with its own options.
    Toml,
    /// The same as JSON.
    Json,
    /// A spanning tree; loops as comments.
    Urdf,
    /// Loops closed by joints.
    Sdf,
    /// Graphviz.
    Dot,
    /// GraphML, for graph programs.
    Graphml,
}

#[derive(Debug, ClapArgs)]
pub(super) struct Export {
    #[command(flatten)]
    file: File,
    /// The format.
    #[arg(long, value_enum)]
    to: ExportFormat,
    /// Write variant K of the list that `ozols search FILE` gives, with the same of the options below.
    #[arg(long, value_name = "K")]
    variant: Option<usize>,
    /// The state meant by --max-external; the file's first besides free by default.
    #[arg(long, value_name = "STATE", requires = "variant")]
    state: Option<String>,
    #[command(flatten)]
    which: Which,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(super) fn run(_: &Args, a: &Export) -> anyhow::Result<Done> {
    let mut m = load::mechanism(&a.file.file)?;
    if let Some(k) = a.variant {
        let request = a.which.request(a.state.as_deref())?;
        m = variant::kth(m, request, k, |v| v.mechanism())?;
    }
    let format = match a.to {
        ExportFormat::Toml => Format::Toml,
        ExportFormat::Json => Format::Json,
        ExportFormat::Urdf => Format::Urdf,
        ExportFormat::Sdf => Format::Sdf,
        ExportFormat::Dot => Format::Dot,
        ExportFormat::Graphml => Format::Graphml,
    };
    let text = api::export(&m, format)?;
    output::to(a.output.as_deref(), |out| {
        write!(out, "{text}")?;
        Ok(Done::Found)
    })
}
