//! Charts of a drive's programme: angles and energies over time.

use crate::chart::{Axis, Chart, Series, Style};
use crate::drive::programme::RunMoment;
use crate::format::csv;
use crate::view::drive::Drive;

/// Points drawn of a swing.
const PER_SWING: u32 = 48;

/// The payload's acceleration on the first disc over the programme, as `ozols grip --motion` takes it: a gripper that reaches
/// outwards from the axis (its x), the part along the axis (its z).
pub fn motion_csv(d: &Drive<'_>) -> Option<String> {
    let (found, payload) = (d.design?, d.file.spec.payload?);
    let rows = found
        .module
        .sample_run(&found.run, PER_SWING)
        .into_iter()
        .map(|s| {
            let inwards = -s.speeds[0] * s.speeds[0] * payload.radius;
            let across = s.accelerations[0] * payload.radius;
            [s.time, inwards, across, 0.0]
                .map(|x| format!("{x:?}"))
                .to_vec()
        });
    Some(csv::write_table(&["time", "ax", "ay", "az"], rows))
}

/// Returns both charts with the names of their files. Empty without a bar.
///
/// # Examples
/// ```
/// use ozols::{drive::driving::design_drive, view::drive::{Drive, charts::drive_charts}};
/// let text = ozols::builtin::text("torsion-module").unwrap_or_default();
/// let file = ozols::file::read::workload::drive_from_bytes("torsion-module.toml", text.as_bytes())?;
/// let found = design_drive(&file.spec)?;
/// let charts = drive_charts(&Drive::new(&file, &found));
/// assert!(!charts.is_empty() && charts.iter().all(|(_, chart)| chart.svg().starts_with("<svg")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn drive_charts(d: &Drive<'_>) -> Vec<(String, Chart)> {
    let Some(found) = d.design else {
        return Vec::new();
    };
    let samples = found.module.sample_run(&found.run, PER_SWING);
    let series = |name: &str, style, y: &dyn Fn(&RunMoment) -> f64| Series {
        name: name.to_owned(),
        points: samples.iter().map(|s| (s.time, y(s))).collect(),
        style,
    };
    let chart = |title: &str, y: &str, series| Chart {
        title: format!("{}: {title}", d.file.name),
        subtitle: String::new(),
        x: Axis::linear("time, s"),
        y: Axis::linear(y),
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
