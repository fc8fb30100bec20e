//! Charts and drawings into a folder, each as SVG and CSV.

use crate::chart::{Chart, page};
use crate::cli::terminal::output;

/// A drawing next to the charts.
pub(crate) struct ChartDrawing {
    /// Name of its files, without ending.
    pub(crate) name: String,
    /// Title of the drawing.
    pub(crate) title: String,
    /// Its texts by ending, including svg.
    pub(crate) files: Vec<(&'static str, String)>,
}

use anyhow::Context;
use std::path::Path;

/// Creates a folder if it is missing.
pub(crate) fn make_folder(folder: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))
}

/// Writes the files of a page, by name, and returns a line that names its start page.
pub(crate) fn write_page(folder: &Path, files: Vec<(String, String)>) -> anyhow::Result<String> {
    output::write_files(folder, files)?;
    let index = folder.join("index.html");
    Ok(format!(
        "Written to {}: open it in a browser.\n",
        index.display()
    ))
}

/// Writes `NAME.svg` and `NAME.csv` of each chart, and a page of all if a title is given. Creates the folder if it is missing.
/// Drawings come last.
pub(crate) fn write(
    folder: &Path,
    title: Option<&str>,
    charts: &[(String, Chart)],
    drawings: &[ChartDrawing],
) -> anyhow::Result<()> {
    make_folder(folder)?;
    let write = |name: &str, text: &str| output::write_bytes(Some(&folder.join(name)), text);
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
        // The drawing has its subtitle.
        parts.push((chart.title.clone(), String::new(), svg));
    }
    for drawing in drawings {
        for (ending, text) in &drawing.files {
            write(&format!("{}.{ending}", drawing.name), text)?;
            if *ending == "svg" {
                parts.push((drawing.title.clone(), String::new(), text.clone()));
            }
        }
    }
    if let Some(title) = title {
        write("index.html", &page(title, &parts))?;
    }
    Ok(())
}
