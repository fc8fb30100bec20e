//! `ozols drive`.

use crate::cli::prelude::*;
use crate::cli::terminal::charts;
use crate::drive::driving::design_drive;
use crate::file::read::workload::drive_from_bytes;
use crate::view;
use crate::view::drive::charts::{drive_charts, motion_csv};
use crate::view::drive::text;

#[derive(Debug, ClapArgs)]
pub(crate) struct Drive {
    #[command(flatten)]
    pub(crate) file: File,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: TextOrJson,
    /// Also write to this folder: charts as SVG and CSV, and the payload's motion on the first disc for `ozols grip --motion`.
    #[arg(long, value_name = "DIR")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    to: ToFile,
}

pub(crate) fn run_drive(a: &Drive) -> anyhow::Result<Done> {
    let (name, bytes) = load::read_named(&a.file)?;
    let file = drive_from_bytes(&name, &bytes)?;
    let found = design_drive(&file.spec)?;
    let shown = view::drive::Drive::new(&file, &found);
    if let (Some(folder), true) = (&a.svg, shown.design.is_some()) {
        let motion = motion_csv(&shown).map(|table| charts::ChartDrawing {
            name: "motion".to_owned(),
            files: vec![("csv", table)],
            title: String::new(),
        });
        charts::write(folder, None, &drive_charts(&shown), &Vec::from_iter(motion))?;
    }
    let gives = "charts of the programme: angle and energy over time";
    let charts = NextCommand::new("drive", &a.file.file, "--svg charts", gives);
    let wanted = a.svg.is_none() && shown.design.is_some();
    let next = if wanted { &[charts][..] } else { &[] };
    let width = a.to.width();
    a.to.write_all_of(match a.format {
        TextOrJson::Json => output::json_text(&shown.json())?,
        TextOrJson::Text => {
            text::drive_text(&shown, width) + &next_commands::steps_text(next, width)
        }
    })?;
    Ok(Done::found_or_nothing(shown.is_complete()))
}
