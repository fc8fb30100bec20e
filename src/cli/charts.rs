//! Charts into a folder, each as SVG and CSV.

use super::{Done, output};
use crate::chart::{Chart, page};
use anyhow::Context;
use std::path::Path;

/// Writes `NAME.svg` and `NAME.csv` of each chart, making the folder where it is missing, and a page of all where it gets a
/// title.
pub(super) fn write(
    folder: &Path,
    title: Option<&str>,
    charts: &[(String, Chart)],
) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    let write = |name: &str, text: &str| {
        output::to(Some(&folder.join(name)), |out| {
            write!(out, "{text}")?;
            Ok(Done::Found)
        })
    };
    let mut parts = Vec::new();
    for (name, chart) in charts {
        let svg = chart.svg();
        write(&format!("{name}.svg"), &svg)?;
        // Where a line breaks there is no row.
        let mut table = chart.clone();
        for series in &mut table.series {
            series.points.retain(|p| p.1.is_finite());
        }
        write(&format!("{name}.csv"), &table.csv())?;
        parts.push((chart.title.clone(), chart.subtitle.clone(), svg));
    }
    if let Some(title) = title {
        write("index.html", &page(title, &parts))?;
    }
    Ok(())
}
