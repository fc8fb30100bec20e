//! `ozols drive`.

use crate::cli::prelude::*;
use crate::cli::terminal::charts;
use crate::drive::driving::drive;
use crate::drive::shares;
use crate::file::read::workload::drive_from_bytes;
use crate::view;
use crate::view::drive::charts::{cam, charts, motion};
use crate::view::drive::text;

/// Maximum number of samples; each may take [`PATIENCE`](crate::drive::programme::PATIENCE) swings.
const MOST_SAMPLES: usize = 1_000_000;

#[derive(Debug, ClapArgs)]
pub(crate) struct Drive {
    #[command(flatten)]
    pub(crate) file: File,
    /// Also report the share of swings that latch if stiffness, inertia, losses, cam and latches vary by up to this fraction:
    /// 0.05 is 5 %.
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// Number of samples.
    #[arg(long, value_name = "N", requires = "tolerance", default_value = "200")]
    pub(crate) samples: usize,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: TextOrJson,
    /// Also write to this folder: charts as SVG and CSV, the cam's profile as SVG, CSV and DXF, and the payload's motion on the
    /// first disc for `ozols grip --motion`.
    #[arg(long, value_name = "DIR")]
    pub(crate) svg: Option<PathBuf>,
    #[command(flatten)]
    to: ToFile,
}

pub(crate) fn run(args: &Global, a: &Drive) -> anyhow::Result<Done> {
    let (name, bytes) = load::named(&a.file)?;
    let file = drive_from_bytes(&name, &bytes)?;
    let found = drive(&file.spec)?;
    let mut shown = view::drive::Drive::new(&file, &found);
    if let Some(t) = a.tolerance {
        ensure!(
            (0.0..1.0).contains(&t),
            "--tolerance must be a share from 0 to below 1, such as 0.05 for 5 %"
        );
        ensure!(
            (1..=MOST_SAMPLES).contains(&a.samples),
            "--samples must be from 1 to {MOST_SAMPLES}"
        );
        if let Some(design) = &found.design {
            let (module, programme) = (&design.module, &file.spec.programme);
            let shares = shares(module, programme, t, a.samples, args.seed)
                .context("a sample does not swing; lower --tolerance")?;
            shown.samples = Some(shares);
        }
    }
    if let (Some(folder), true) = (&a.svg, shown.design.is_some()) {
        let cam = cam(&shown).map(|cam| charts::ChartDrawing {
            name: "cam".to_owned(),
            files: vec![("svg", cam.svg()), ("csv", cam.csv()), ("dxf", cam.dxf())],
            title: cam.title,
        });
        let motion = motion(&shown).map(|table| charts::ChartDrawing {
            name: "motion".to_owned(),
            files: vec![("csv", table)],
            title: String::new(),
        });
        let more: Vec<charts::ChartDrawing> = cam.into_iter().chain(motion).collect();
        charts::write(folder, None, &charts(&shown), &more)?;
    }
    let gives = "charts of the programme, angle and energy over time, and the cam's profile if its radii are given";
    let charts = NextCommand::new("drive", &a.file.file, "--svg charts", gives);
    let wanted = a.svg.is_none() && shown.design.is_some();
    let next = if wanted { &[charts][..] } else { &[] };
    let width = a.to.width();
    a.to.put(match a.format {
        TextOrJson::Json => output::json(&shown.json())?,
        TextOrJson::Text => text::drive(&shown, width) + &next_commands::text(next, width),
    })?;
    Ok(Done::found(shown.complete()))
}
