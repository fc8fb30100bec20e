//! `ozols export`.

use super::args::{Args, Export, ExportFormat};
use super::{Done, load, output};
use crate::export;

pub(super) fn run(_: &Args, a: &Export) -> anyhow::Result<Done> {
    let m = load::mechanism(&a.file.file)?;
    let text = match a.to {
        ExportFormat::Toml => export::toml(&m)?,
        ExportFormat::Json => format!("{:#}\n", export::mechanism_file(&m).json()),
        ExportFormat::Urdf => export::urdf(&m)?,
        ExportFormat::Sdf => export::sdf(&m),
        ExportFormat::Dot => export::dot(&m),
        ExportFormat::Graphml => export::graphml(&m),
    };
    output::to(a.output.as_deref(), |out| {
        write!(out, "{text}")?;
        Ok(Done::Found)
    })
}
