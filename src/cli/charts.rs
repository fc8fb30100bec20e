//! Charts into a folder, each as SVG and CSV.

use super::{Done, output};
use crate::chart::Chart;
use anyhow::Context;
use std::path::Path;

/// Writes `NAME.svg` and `NAME.csv` of each chart, making the folder where it is missing.
pub(super) fn write(folder: &Path, charts: &[(&str, Chart)]) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for (name, chart) in charts {
        for (ending, text) in [("svg", chart.svg()), ("csv", chart.csv())] {
            let path = folder.join(format!("{name}.{ending}"));
            output::to(Some(&path), |out| {
                out.write_all(text.as_bytes())?;
                Ok(Done::Found)
            })?;
        }
    }
    Ok(())
}
