//! Charts of reactions over the cycle and of the methods' stability.

use crate::chart::{Axis, Chart, Scale, Series, Style};
use crate::statics::contour_group::pose::GroupReactions;
use crate::statics::contour_group::solutions::{GroupMethod, GroupSolutions};
use crate::statics::contour_group::stability::{DistanceErrors, Failure};
use crate::statics::cycle::Moment;
use crate::statics::inertia::{LinkInertia, link_inertias};
use crate::statics::kinetostatics::LoadSource;
use crate::statics::planar::PairId;
use crate::view::statics::{StaticsData, magnitudes};
use crate::view::terminal::si_prefix::prefix;
use itertools::Itertools;

/// Named figures of a group's reactions.
type Figures<'a> = &'a dyn Fn(&GroupSolutions, GroupReactions) -> Vec<(&'static str, f64)>;

/// A chart with the name of its file, without the ending.
pub type Named = (String, Chart);

fn linear(label: impl Into<String>) -> Axis {
    Axis {
        label: label.into(),
        scale: Scale::Linear,
    }
}

fn log(label: impl Into<String>) -> Axis {
    Axis {
        label: label.into(),
        scale: Scale::Log,
    }
}

fn drive_axis(s: &StaticsData<'_>) -> Axis {
    let name = s.drives.first().copied().unwrap_or("");
    let unit = if s.found.drive_slides() {
        "length units"
    } else {
        "degrees"
    };
    linear(format!("position of drive {name}, {unit}"))
}

/// How many forces from outside act.
fn acting(x: &Moment) -> usize {
    let outside = x.loads.iter().filter(|l| l.source == LoadSource::External);
    outside.count()
}

/// Values over the cycle, one series a name; where forces set in or end the lines are broken.
fn over(s: &StaticsData<'_>, f: impl Fn(&Moment) -> Vec<(String, f64)>) -> Vec<Series> {
    let mut series: Vec<Series> = Vec::new();
    let mut before = s.found.moments.first().map_or(0, acting);
    for x in &s.found.moments {
        let at = s.shown(x.instant.drive);
        if acting(x) != before {
            series
                .iter_mut()
                .for_each(|e| e.points.push((at, f64::NAN)));
            before = acting(x);
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

fn scale(series: &mut [Series]) -> &'static str {
    let all = series.iter().flat_map(|e| &e.points).map(|p| p.1.abs());
    let (unit, prefix) = prefix(all.filter(|x| x.is_finite()).fold(0.0, f64::max));
    let points = series.iter_mut().flat_map(|e| &mut e.points);
    points.for_each(|p| p.1 /= unit);
    prefix
}

/// Reactions of every group, where the guides' reactions act, the drives' effort, and how far the methods differ.
#[must_use]
pub fn cycle(s: &StaticsData<'_>) -> Vec<Named> {
    let (found, methods, name) = (s.found, s.methods, s.mechanism);
    let (m, d) = (&found.linkage.mechanism, &found.decomposition);
    let mut out = Vec::new();
    let Some(&shown) = methods.last() else {
        return out;
    };
    let mut add = |file: String, title: String, subtitle: String, y: Axis, series: Vec<Series>| {
        let chart = Chart {
            title: format!("{name}: {title}"),
            subtitle,
            x: drive_axis(s),
            y,
            series,
        };
        out.push((file, chart));
    };
    for (i, (index, letters)) in found.contour_groups.iter().enumerate() {
        let title = s.groups[*index].name();
        let place = |p: PairId| m.pairs[p].name.as_str();
        let solved = |x: &Moment, f: Figures<'_>| {
            let found = x.groups.get(i).and_then(|g| Some(f(g, g.by(shown)?)));
            let named = found.into_iter().flatten();
            named.map(|(n, v)| (n.to_owned(), v)).collect_vec()
        };
        let mut series = over(s, |x| solved(x, &|g, r| magnitudes(&r, &g.pose).to_vec()));
        let prefix = scale(&mut series);
        let letters_named = [letters.d, letters.f, letters.k, letters.m, letters.l];
        let key = "DFKML"
            .chars()
            .zip(letters_named)
            .map(|(c, p)| format!("{c} = {}", place(p)))
            .join(", ");
        add(
            format!("group-{title}"),
            format!("reactions of group {title}"),
            format!("{key}; guide {} with its sign", place(letters.guide)),
            linear(format!("reaction, {prefix}N")),
            series,
        );
        let mut series = over(s, |x| {
            solved(x, &|g, _| {
                let steps = &g.steps;
                vec![
                    ("R46τ", steps.r46_tangential),
                    ("R47τ", steps.r47_tangential),
                    ("R34τ", steps.r34_tangential),
                ]
            })
        });
        let prefix = scale(&mut series);
        add(
            format!("tangential-{title}"),
            format!("tangential reactions of group {title}"),
            format!("By the δ-point method, across the rods and across Dδ; {key}"),
            linear(format!("reaction, {prefix}N")),
            series,
        );
        let far = 2.0 * found.linkage.size;
        // Far out the line only says that the reaction changes its sign.
        let near = |x: f64| if x.abs() <= far { x } else { f64::NAN };
        let series = over(s, |x| {
            let guide = found.linkage.place(&x.instant.pose, letters.guide);
            solved(x, &|g, r| {
                let offset = r.guide_offset(&g.pose, guide);
                vec![
                    ("arm h about D", near(r.arm)),
                    ("offset along the guide", near(offset)),
                ]
            })
        });
        add(
            format!("guide-{title}"),
            format!(
                "where the guide bears link {}",
                m.bodies[letters.slider].name
            ),
            format!(
                "Point of application of the reaction of {}; broken where it vanishes",
                place(letters.guide)
            ),
            linear("m"),
            series,
        );
    }
    for (index, g) in d.groups.iter().enumerate() {
        if found.contour_groups.iter().any(|c| c.0 == index) {
            continue;
        }
        let (title, pairs) = (s.groups[index].name(), g.pairs());
        let mut series = over(s, |x| {
            let all = x.whole.iter().flat_map(|e| &e.reactions);
            let own = all.filter(|r| pairs.contains(&r.pair));
            own.map(|r| (m.pairs[r.pair].name.clone(), r.force[0].hypot(r.force[1])))
                .collect()
        });
        let prefix = scale(&mut series);
        add(
            format!("group-{title}"),
            format!("reactions of group {title}"),
            g.class.to_string(),
            linear(format!("reaction, {prefix}N")),
            series,
        );
    }
    let mut series = over(s, |x| {
        let all = x.whole.iter().flat_map(|e| &e.reactions);
        all.filter_map(|r| Some((m.pairs[r.pair].name.clone(), r.effort?)))
            .collect()
    });
    if !series.is_empty() {
        let prefix = scale(&mut series);
        let (what, unit) = if found.drive_slides() {
            ("force", "N")
        } else {
            ("torque", "N·m")
        };
        add(
            "drive".to_owned(),
            format!("{what} of the drive"),
            String::new(),
            linear(format!("{what}, {prefix}{unit}")),
            series,
        );
    }
    let links = |x: &Moment, of: &dyn Fn(&LinkInertia) -> f64| -> Vec<(String, f64)> {
        let all = link_inertias(&found.loads.masses, &found.linkage, &x.instant);
        all.iter()
            .map(|l| (m.bodies[l.body].name.clone(), of(l)))
            .collect()
    };
    let size = |v: [f64; 2]| v[0].hypot(v[1]);
    let moving = |series: &[Series]| series.iter().flat_map(|e| &e.points).any(|p| p.1 > 0.0);
    let series = over(s, |x| links(x, &|l| size(l.acceleration)));
    if moving(&series) {
        let title = "accelerations of the links' mass centres".to_owned();
        let axis = linear("acceleration, m/s²");
        add(
            "accelerations".to_owned(),
            title,
            String::new(),
            axis,
            series,
        );
        let mut series = over(s, |x| links(x, &|l| size(l.force)));
        let prefix = scale(&mut series);
        let title = "inertia forces of the links".to_owned();
        let axis = linear(format!("inertia force, {prefix}N"));
        add(
            "inertia-forces".to_owned(),
            title,
            String::new(),
            axis,
            series,
        );
    }
    if methods.len() > 1 && !found.contour_groups.is_empty() {
        let series = over(s, |x| {
            let named = x.groups.iter().map(|g| {
                let differ = g.disagreement(methods).unwrap_or(f64::NAN);
                let name = s.groups[g.group].name();
                (format!("group {name}"), differ.max(1e-17))
            });
            named.collect()
        });
        add(
            "methods".to_owned(),
            "how far the methods differ".to_owned(),
            methods.iter().map(|x| x.name()).join(", "),
            log("greatest difference over the greatest reaction"),
            series,
        );
    }
    out
}

/// What a stability chart shows: title, subtitle, axis.
fn labels(failure: Failure) -> (&'static str, &'static str, &'static str) {
    match failure {
        Failure::ParallelRods => (
            "Rods 6 and 7 nearly parallel",
            "δ goes to infinity; the group itself is sound",
            "angle between the rods, rad",
        ),
        Failure::AcrossGuide => (
            "D nearly on the line through δ across the guide",
            "The group nears a dead point: reactions grow without bound",
            "angle between Dδ and the guide's normal, rad",
        ),
        Failure::AtDelta => (
            "D nearly at δ",
            "The group nears a dead point: reactions grow without bound",
            "l_Dδ over its length in the machine",
        ),
        Failure::NoGuideReaction => (
            "Guide reaction nearly zero: error of its arm h",
            "The forces stay right; h = moment over force loses its figures whatever the method",
            "R_0/10 over its value in the machine",
        ),
    }
}

/// Errors of the methods against the distance from a failure.
#[must_use]
pub fn stability(failure: Failure, samples: &[DistanceErrors]) -> Named {
    // What is exact to the last bit is shown at the foot.
    let shown = |x: f64| {
        if x.is_finite() {
            x.clamp(1e-17, 1e3)
        } else {
            1e3
        }
    };
    let arms = failure == Failure::NoGuideReaction;
    let line = |name: &str, style, f: &dyn Fn(&DistanceErrors) -> f64| Series {
        name: name.to_owned(),
        points: samples.iter().map(|s| (s.distance, shown(f(s)))).collect(),
        style,
    };
    let of = |k: usize| move |s: &DistanceErrors| if arms { s.arm[k] } else { s.forces[k] };
    let mut series = vec![
        line("δ-point", Style::Line, &of(0)),
        line("projective", Style::Line, &of(1)),
        line("equilibrium, LU", Style::Line, &of(2)),
    ];
    if arms {
        let worst = |s: &DistanceErrors| s.forces.into_iter().fold(0.0, f64::max);
        series.push(line("forces, worst of the three", Style::Dashed, &worst));
    } else {
        series.push(line(
            "condition of LU × rounding unit",
            Style::Dashed,
            &|s| s.condition * f64::EPSILON / 2.0,
        ));
    }
    let (title, subtitle, x) = labels(failure);
    let chart = Chart {
        title: title.to_owned(),
        subtitle: subtitle.to_owned(),
        x: log(x),
        y: log("relative error against exact arithmetic"),
        series,
    };
    (format!("stability-{}", failure.name()), chart)
}

/// Rows of a table: failure, figure, method, and the errors at distances 1, 1e-3, ... 1e-15.
#[must_use]
pub fn stability_rows(failure: Failure, samples: &[DistanceErrors]) -> Vec<Vec<String>> {
    let at = |decade: i32| {
        let wanted = 10f64.powi(-decade);
        let near = |s: &&DistanceErrors| (s.distance.log10() - wanted.log10()).abs();
        samples.iter().min_by(|a, b| near(a).total_cmp(&near(b)))
    };
    let figures: &[(&str, bool)] = match failure {
        Failure::NoGuideReaction => &[("h", true), ("forces", false)],
        _ => &[("forces", false)],
    };
    let mut rows = Vec::new();
    for (figure, arms) in figures {
        for (k, method) in GroupMethod::ALL.iter().enumerate() {
            let mut row = vec![
                failure.name().to_owned(),
                (*figure).to_owned(),
                method.name().to_owned(),
            ];
            row.extend([0, 3, 6, 9, 12, 15].map(|d| {
                let error = at(d).map(|s| if *arms { s.arm[k] } else { s.forces[k] });
                error
                    .filter(|e| e.is_finite())
                    .map_or_else(|| "-".to_owned(), |e| format!("{e:.0e}"))
            }));
            rows.push(row);
        }
    }
    rows
}
