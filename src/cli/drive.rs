//! `ozols drive`.

use super::args::{AnalyzeFormat, Args, Drive};
use super::{Done, charts, load, output};
use crate::drive::driving::drive;
use crate::file::read::workload::drive_from_bytes;
use crate::view::next::{self, Step};
use crate::view::{drive_charts, drive_json, drive_text};

pub(super) fn run(_: &Args, a: &Drive) -> anyhow::Result<Done> {
    let (name, bytes) = load::named(&a.file.file)?;
    let file = drive_from_bytes(&name, &bytes)?;
    let found = drive(&file.spec)?;
    if let (Some(folder), Some(design)) = (&a.svg, &found.design) {
        charts::write(folder, &drive_charts::charts(&file, design))?;
    }
    output::to(a.output.as_deref(), |out| {
        match a.format {
            AnalyzeFormat::Json => writeln!(out, "{:#}", drive_json::drive(&file, &found))?,
            AnalyzeFormat::Text => {
                let width = output::width(a.output.as_deref());
                write!(out, "{}", drive_text::drive(&file, &found, width))?;
                if a.svg.is_none() && found.design.is_some() {
                    let gives = "charts of the programme: angle, speed and energy over time";
                    let charts = Step::new("drive", &a.file.file, "--svg charts", gives);
                    write!(out, "{}", next::text(&[charts], width))?;
                }
            }
        }
        let done = found.design.as_ref().is_some_and(|d| d.run.complete());
        Ok(if done { Done::Found } else { Done::Nothing })
    })
}
