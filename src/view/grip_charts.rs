//! Charts of a gripper: those of the paper, and its own arms and drive moments over the diameters asked for.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::file::read::workload::Workload;
use crate::grip::arm_charts;
use crate::grip::clamping::{Row, Study};
use crate::model::grip::GripSpec;

/// Every chart with the name of its file.
#[must_use]
pub fn charts(file: &Workload<GripSpec>, study: &Study) -> Vec<(&'static str, Chart)> {
    let mut out = arm_charts::figures();
    let (metres, symbol) = (file.length_unit.metres, file.length_unit.symbol);
    let series = |name: &str, style, y: &dyn Fn(&Row) -> Option<f64>| Series {
        name: name.to_owned(),
        points: study
            .rows
            .iter()
            .filter_map(|r| Some((r.diameter / metres, y(r)?)))
            .collect(),
        style,
    };
    let x = || Axis {
        label: format!("D, {symbol}"),
        scale: Scale::Linear,
    };
    out.push((
        "arms",
        Chart {
            title: format!("{}: arms of the clamping forces", file.name),
            subtitle: "Points: what the jaws can hold.".to_owned(),
            x: x(),
            y: Axis {
                label: format!("arm, {symbol}"),
                scale: Scale::Linear,
            },
            series: vec![
                series("l1", Style::Line, &|r| Some(r.arms.l1 / metres)),
                series("l2", Style::Line, &|r| Some(r.arms.l2 / metres)),
                series("held, l1", Style::Points, &|r| {
                    r.obstacles.is_empty().then_some(r.arms.l1 / metres)
                }),
                series("held, l2", Style::Points, &|r| {
                    r.obstacles.is_empty().then_some(r.arms.l2 / metres)
                }),
            ],
        },
    ));
    if file.spec.load.is_some() {
        out.push((
            "drive-moment",
            Chart {
                title: format!("{}: least drive moment per lever", file.name),
                subtitle: "In the hardest case of each diameter.".to_owned(),
                x: x(),
                y: Axis {
                    label: "moment, N·m".to_owned(),
                    scale: Scale::Linear,
                },
                series: vec![series("drive moment", Style::Line, &Row::drive)],
            },
        ));
    }
    out
}
