//! Charts of reactions over the cycle.

use crate::statics::assur::Group;
use crate::statics::cycle::Moment;
use crate::statics::kinetostatics::{LinkInertia, LoadSource};
use crate::statics::planar::PairId;
use crate::view::prelude::*;
use crate::view::statics::{StaticsData, vector_size};

/// Returns the number of forces from outside.
fn outside_forces(x: &Moment) -> usize {
    let outside = x.loads.iter().filter(|l| l.source == LoadSource::External);
    outside.count()
}

fn scale_series(series: &mut [Series]) -> &'static str {
    let all = series.iter().flat_map(|e| &e.points).map(|p| p.1.abs());
    let (unit, prefix) = unit_prefix(all.filter(|x| x.is_finite()).fold(0.0, f64::max));
    let points = series.iter_mut().flat_map(|e| &mut e.points);
    points.for_each(|p| p.1 /= unit);
    prefix
}

/// Returns charts with the names of their files, without the ending: the reactions of each group, the drives' effort, and what inertia does.
pub fn cycle_charts(s: &StaticsData<'_>) -> Vec<(String, Chart)> {
    let groups = s.found.decomposition.groups.iter().enumerate();
    let groups = groups.map(|(index, g)| group_chart(s, index, g));
    groups
        .chain(drive_chart(s))
        .chain(inertia_charts(s))
        .collect()
}

/// Returns values over the cycle, one series a name; lines are broken where forces set in or end.
fn series_over(s: &StaticsData<'_>, f: impl Fn(&Moment) -> Vec<(String, f64)>) -> Vec<Series> {
    let mut series: Vec<Series> = Vec::new();
    let mut before = s.found.moments.first().map_or(0, outside_forces);
    for x in &s.found.moments {
        let at = s.shown_position(x.drive);
        if outside_forces(x) != before {
            let each = series.iter_mut();
            each.for_each(|e| e.points.push((at, f64::NAN)));
            before = outside_forces(x);
        }
        for (name, value) in f(x) {
            match series.iter_mut().find(|e| e.name == name) {
                Some(e) => e.points.push((at, value)),
                None => series.push(Series {
                    name,
                    points: vec![(at, value)],
                    style: Style::Line,
                }),
            }
        }
    }
    series
}

fn make_chart(
    s: &StaticsData<'_>,
    file: impl Into<String>,
    [title, subtitle]: [&str; 2],
    y: String,
    series: Vec<Series>,
) -> (String, Chart) {
    let drive = s.found.decomposition.drives.first();
    let drive = drive.map_or("", |&p| pair_name(s, p));
    let unit = if s.found.drive_slides() {
        "length units"
    } else {
        "degrees"
    };
    let chart = Chart {
        title: format!("{}: {title}", s.of.name),
        subtitle: subtitle.to_owned(),
        x: Axis::linear(format!("position of drive {drive}, {unit}")),
        y: Axis::linear(y),
        series,
    };
    (file.into(), chart)
}

fn pair_name<'a>(s: &StaticsData<'a>, p: PairId) -> &'a str {
    &s.planar_mechanism().pairs[p].name
}

/// Returns the reactions of a group.
fn group_chart(s: &StaticsData<'_>, index: usize, g: &Group) -> (String, Chart) {
    let (title, pairs) = (s.group_name(index), g.all_pairs());
    let mut series = series_over(s, |x| {
        let own = x.reactions.iter().filter(|r| pairs.contains(&r.pair));
        own.map(|r| (pair_name(s, r.pair).to_owned(), vector_size(r.force)))
            .collect()
    });
    let y = format!("reaction, {}N", scale_series(&mut series));
    let words = [
        &*format!("reactions of group {title}"),
        &g.class.to_string(),
    ];
    make_chart(s, format!("group-{title}"), words, y, series)
}

/// Returns the effort of the drives.
fn drive_chart(s: &StaticsData<'_>) -> Option<(String, Chart)> {
    let mut series = series_over(s, |x| {
        let drives = x.reactions.iter();
        drives
            .filter_map(|r| Some((pair_name(s, r.pair).to_owned(), r.effort?)))
            .collect()
    });
    let prefix = scale_series(&mut series);
    let (what, unit) = if s.found.drive_slides() {
        ("force", "N")
    } else {
        ("torque", "N·m")
    };
    let (words, y) = (
        format!("{what} of the drive"),
        format!("{what}, {prefix}{unit}"),
    );
    let there = !series.is_empty();
    there.then(|| make_chart(s, "drive", [&words, ""], y, series))
}

/// Returns accelerations and inertia forces, if anything moves that has a mass.
fn inertia_charts(s: &StaticsData<'_>) -> Vec<(String, Chart)> {
    let links = |of: &dyn Fn(&LinkInertia) -> f64| {
        series_over(s, |x| {
            let name = |l: &LinkInertia| s.planar_mechanism().bodies[l.body].name.clone();
            x.links.iter().map(|l| (name(l), of(l))).collect()
        })
    };
    let series = links(&|l| vector_size(l.acceleration));
    let mut forces = links(&|l| vector_size(l.force));
    if series.iter().flat_map(|e| &e.points).all(|p| p.1 <= 0.0) {
        return Vec::new();
    }
    let words = ["accelerations of the links' mass centres", ""];
    let y = "acceleration, m/s²".to_owned();
    let accelerations = make_chart(s, "accelerations", words, y, series);
    let words = ["inertia forces of the links", ""];
    let y = format!("inertia force, {}N", scale_series(&mut forces));
    vec![
        accelerations,
        make_chart(s, "inertia-forces", words, y, forces),
    ]
}
