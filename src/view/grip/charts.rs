//! Charts of a gripper over its diameters: its arms, and its drive moments.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::view::grip::{Diameter, Grip};

/// Every chart with the name of its file.
#[must_use]
pub fn charts(g: &Grip<'_>) -> Vec<(String, Chart)> {
    let (metres, symbol) = (g.file.length_unit.metres, g.file.length_unit.symbol);
    let series = |name: &str, style, y: &dyn Fn(&Diameter) -> Option<f64>| Series {
        name: name.to_owned(),
        points: g
            .diameters
            .iter()
            .filter_map(|d| Some((d.diameter / metres, y(d)?)))
            .collect(),
        style,
    };
    let linear = |label: String| Axis {
        label,
        scale: Scale::Linear,
    };
    let held = |d: &Diameter, arm: f64| d.obstacles.is_empty().then_some(arm / metres);
    let mut out = vec![(
        "arms".to_owned(),
        Chart {
            title: format!("{}: arms of the clamping forces", g.mechanism),
            subtitle: "Points: what the jaws can hold.".to_owned(),
            x: linear(format!("D, {symbol}")),
            y: linear(format!("arm, {symbol}")),
            series: vec![
                series("l1", Style::Line, &|d| Some(d.arms.l1 / metres)),
                series("l2", Style::Line, &|d| Some(d.arms.l2 / metres)),
                series("held, l1", Style::Points, &|d| held(d, d.arms.l1)),
                series("held, l2", Style::Points, &|d| held(d, d.arms.l2)),
            ],
        },
    )];
    if g.file.spec.load.is_some() {
        let moment = |d: &Diameter| d.load.as_ref()?.drive_moment_per_lever;
        out.push((
            "drive-moment".to_owned(),
            Chart {
                title: format!("{}: least drive moment per lever", g.mechanism),
                subtitle: "In the hardest case of each diameter.".to_owned(),
                x: linear(format!("D, {symbol}")),
                y: linear("moment, N·m".to_owned()),
                series: vec![series("drive moment", Style::Line, &moment)],
            },
        ));
    }
    out.extend(
        g.motion
            .as_ref()
            .map(|m| ("motion".to_owned(), m.chart(g.mechanism))),
    );
    out
}
