//! Charts of a drive's programme: angles and energies over time.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::drive::programme::Sample;
use crate::view::drive::Drive;

/// Points drawn of a swing.
const PER_SWING: u32 = 48;

/// Both charts with the names of their files; none without a bar.
#[must_use]
pub fn charts(d: &Drive<'_>) -> Vec<(String, Chart)> {
    let Some(found) = d.found else {
        return Vec::new();
    };
    let samples = found.module.samples(&found.run, PER_SWING);
    let series = |name: &str, style, y: &dyn Fn(&Sample) -> f64| Series {
        name: name.to_owned(),
        points: samples.iter().map(|s| (s.time, y(s))).collect(),
        style,
    };
    let chart = |title: &str, y: &str, series| Chart {
        title: format!("{}: {title}", d.mechanism),
        subtitle: String::new(),
        x: Axis {
            label: "time, s".to_owned(),
            scale: Scale::Linear,
        },
        y: Axis {
            label: y.to_owned(),
            scale: Scale::Linear,
        },
        series,
    };
    let angles = vec![
        series("disc 1", Style::Line, &|s| s.angles[0].to_degrees()),
        series("disc 2", Style::Dashed, &|s| s.angles[1].to_degrees()),
    ];
    let energies = vec![
        series("in the bar", Style::Line, &|s| s.potential),
        series("of the disc", Style::Dashed, &|s| s.kinetic),
        series("both", Style::Line, &|s| s.potential + s.kinetic),
    ];
    vec![
        (
            "angles".to_owned(),
            chart("angles of the discs", "angle, degrees", angles),
        ),
        ("energy".to_owned(), chart("energy", "energy, J", energies)),
    ]
}
