//! Charts of a gripper: its arms and its drive moments over its diameters, and its arms over each figure of its levers.

use crate::chart::{Axis, Chart, Series, Style};
use crate::format::four_digits;
use crate::grip::arm_curves::{Varied, arm_curve};
use crate::grip::clamping::DiameterRow;
use crate::grip::lever_arm::Arms;
use crate::view::grip::GripReport;

/// Returns every chart with the name of its file.
pub fn grip_charts(g: &GripReport<'_>) -> Vec<(String, Chart)> {
    let (metres, symbol) = (g.file.length_unit.metres, g.file.length_unit.symbol);
    let series = |name: &str, style, y: &dyn Fn(&DiameterRow) -> Option<f64>| Series {
        name: name.to_owned(),
        points: g
            .found
            .study
            .rows
            .iter()
            .filter_map(|d| Some((d.diameter / metres, y(d)?)))
            .collect(),
        style,
    };
    let held = |d: &DiameterRow, arm: f64| d.obstacles.is_empty().then_some(arm / metres);
    let mut out = vec![(
        "arms".to_owned(),
        Chart {
            title: format!("{}: arms of the clamping forces", g.file.name),
            subtitle: "Points: what the jaws can hold.".to_owned(),
            x: Axis::linear(format!("D, {symbol}")),
            y: Axis::linear(format!("arm, {symbol}")),
            series: vec![
                series("l1", Style::Line, &|d| Some(d.arms.l1 / metres)),
                series("l2", Style::Line, &|d| Some(d.arms.l2 / metres)),
                series("held, l1", Style::Points, &|d| held(d, d.arms.l1)),
                series("held, l2", Style::Points, &|d| held(d, d.arms.l2)),
            ],
        },
    )];
    out.extend(Varied::ALL.map(|v| arms_over(g, v)));
    if g.file.spec.load.is_some() {
        out.push((
            "drive-moment".to_owned(),
            Chart {
                title: format!("{}: least drive moment per lever", g.file.name),
                subtitle: "In the hardest case of each diameter.".to_owned(),
                x: Axis::linear(format!("D, {symbol}")),
                y: Axis::linear("moment, N·m"),
                series: vec![series(
                    "drive moment",
                    Style::Line,
                    &DiameterRow::drive_moment,
                )],
            },
        ));
    }
    out.extend(
        g.motion
            .as_ref()
            .map(|m| ("motion".to_owned(), m.chart(&g.file.name))),
    );
    out
}

/// Returns the arms over one figure of the levers, for the smallest, the nominal and the largest part. For the nominal part,
/// adds the terms that make up the arms.
fn arms_over(g: &GripReport<'_>, varied: Varied) -> (String, Chart) {
    type Part = (&'static str, fn(&Arms) -> f64);
    const WHOLE: [Part; 2] = [("l1", |a| a.l1), ("l2", |a| a.l2)];
    const PARTS: [Part; 3] = [
        ("l11", |a| a.l11),
        ("l12 = l22", |a| a.l12),
        ("l21", |a| a.l21),
    ];
    let (spec, unit) = (&g.file.spec, g.file.length_unit);
    let (name, what, label, scale) = match varied {
        Varied::LeverLength => ("length", "L", format!("L, {}", unit.symbol), unit.metres),
        Varied::PrismAngle => ("prism-angle", "α", "α, °".to_owned(), 1f64.to_radians()),
        Varied::MountingAngle => ("mounting-angle", "γ", "γ, °".to_owned(), 1f64.to_radians()),
    };
    let all = &spec.diameters;
    let mut diameters: Vec<f64> = all.first().into_iter().chain(all.last()).copied().collect();
    diameters.push(spec.diameter);
    diameters.sort_by(f64::total_cmp);
    diameters.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * *b);
    let mut series = Vec::new();
    for diameter in diameters {
        let curve = arm_curve(spec, varied, diameter);
        let own = (diameter - spec.diameter).abs() <= 1e-9 * diameter;
        let parts = PARTS.iter().filter(|_| own).map(|p| (p, Style::Dashed));
        for (&(arm, of), style) in WHOLE.iter().map(|w| (w, Style::Line)).chain(parts) {
            // What cannot be held breaks the line.
            let y = |a: &Option<Arms>| a.as_ref().map_or(f64::NAN, |a| of(a) / unit.metres);
            series.push(Series {
                name: format!("{arm}, D = {}", four_digits(diameter / unit.metres)),
                points: curve.iter().map(|(x, a)| (x / scale, y(a))).collect(),
                style,
            });
        }
    }
    let chart = Chart {
        title: format!("{}: arms of the clamping forces over {what}", g.file.name),
        subtitle: "All else as stated; where such a gripper can hold the part.".to_owned(),
        x: Axis::linear(label),
        y: Axis::linear(format!("arm, {}", unit.symbol)),
        series,
    };
    (format!("arms-over-{name}"), chart)
}
