//! `ozols export`.

use super::args::{Args, Export, ExportFormat};
use super::{Done, load, output, variant};
use crate::robots::export;

pub(super) fn run(_: &Args, a: &Export) -> anyhow::Result<Done> {
    let mut m = load::mechanism(&a.file.file)?;
    if let Some(k) = a.variant {
        m = variant::kth(&mut m, &a.question, a.state.as_deref(), k, |search, v| {
            variant::mechanism(search, v, k)
        })?;
    }
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
