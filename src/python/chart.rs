//! Charts in the style of the program.

use ozols::chart::{Axis, Chart, Scale, Series, Style};
use pyo3::prelude::*;

/// Returns a chart of lines over two axes as SVG. An axis has a label and whether it is logarithmic; a line has a name and points.
#[pyfunction]
pub(crate) fn chart(
    title: String,
    subtitle: String,
    x: (String, bool),
    y: (String, bool),
    lines: Vec<(String, Vec<(f64, f64)>)>,
) -> String {
    let axis = |(label, log): (String, bool)| Axis {
        label,
        scale: if log { Scale::Log } else { Scale::Linear },
    };
    let series = lines.into_iter().map(|(name, points)| Series {
        name,
        points,
        style: Style::Steps,
    });
    let chart = Chart {
        title,
        subtitle,
        x: axis(x),
        y: axis(y),
        series: series.collect(),
    };
    chart.svg()
}
