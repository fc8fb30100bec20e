//! Charts of a drive's programme: angles and energies over time.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::drive::driving::Design;
use crate::drive::programme::Sample;
use crate::file::read::workload::Workload;
use crate::model::drive::DriveSpec;

/// Points drawn of a swing.
const PER_SWING: u32 = 48;

/// Both charts with the names of their files.
#[must_use]
pub fn charts(file: &Workload<DriveSpec>, design: &Design) -> Vec<(&'static str, Chart)> {
    let samples = design.module.samples(&design.run, PER_SWING);
    let series = |name: &str, style, y: &dyn Fn(&Sample) -> f64| Series {
        name: name.to_owned(),
        points: samples.iter().map(|s| (s.time, y(s))).collect(),
        style,
    };
    let chart = |title: &str, y: &str, series| Chart {
        title: format!("{}: {title}", file.name),
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
            "angles",
            chart("angles of the discs", "angle, degrees", angles),
        ),
        ("energy", chart("energy", "energy, J", energies)),
    ]
}
