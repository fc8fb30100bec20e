//! Charts of reactions over the cycle.

use crate::statics::contour_group::ContourGroup;
use crate::statics::contour_group::pose::GroupReactions;
use crate::statics::contour_group::solutions::{GroupMethod, GroupSolutions};
use crate::statics::cycle::Moment;
use crate::statics::kinetostatics::{LinkInertia, LoadSource};
use crate::statics::planar::PairId;
use crate::view::prelude::*;
use crate::view::statics::{StaticsData, magnitudes, vector_size};

/// Named figures of a group's reactions.
type Figures<'a> = &'a dyn Fn(&Moment, &GroupSolutions, GroupReactions) -> Vec<(&'static str, f64)>;

/// A chart with the name of its file, without the ending.
pub type Named = (String, Chart);

fn log_axis(label: impl Into<String>) -> Axis {
    let scale = Scale::Log;
    Axis {
        scale,
        ..Axis::linear(label)
    }
}

/// Returns the number of forces from outside.
fn outside_forces(x: &Moment) -> usize {
    let outside = x.loads.iter().filter(|l| l.source == LoadSource::External);
    outside.count()
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

fn scale_series(series: &mut [Series]) -> &'static str {
    let all = series.iter().flat_map(|e| &e.points).map(|p| p.1.abs());
    let (unit, prefix) = unit_prefix(all.filter(|x| x.is_finite()).fold(0.0, f64::max));
    let points = series.iter_mut().flat_map(|e| &mut e.points);
    points.for_each(|p| p.1 /= unit);
    prefix
}

/// Returns the reactions of every group, where the guides' reactions act, the drives' effort, and how far the methods differ.
pub fn cycle_charts(s: &StaticsData<'_>) -> Vec<Named> {
    let Some(&shown) = s.methods.last() else {
        return Vec::new();
    };
    let list = Vec::new();
    let mut out = Charts { of: s, shown, list };
    for (i, (index, letters)) in s.found.contour_groups.iter().enumerate() {
        let title = s.group_name(*index);
        out.contour_reactions(i, &title, letters);
        out.tangential_reactions(i, &title, letters);
        out.guide_bearing(i, &title, letters);
    }
    for index in 0..s.found.decomposition.groups.len() {
        if s.found.contour_groups.iter().all(|c| c.0 != index) {
            out.other_group(index);
        }
    }
    out.add_drive();
    out.add_inertia();
    if s.methods.len() > 1 && !s.found.contour_groups.is_empty() {
        out.add_methods();
    }
    out.list
}

/// The charts of a cycle, one after another.
struct Charts<'s, 'a> {
    of: &'s StaticsData<'a>,
    /// The method whose reactions are shown.
    shown: GroupMethod,
    list: Vec<Named>,
}

impl Charts<'_, '_> {
    fn add_chart(
        &mut self,
        file: impl Into<String>,
        [title, subtitle]: [&str; 2],
        y: Axis,
        series: Vec<Series>,
    ) {
        let found = self.of.found;
        let drive = found.decomposition.drives.first();
        let drive = drive.map_or("", |&p| self.pair_name(p));
        let unit = if found.drive_slides() {
            "length units"
        } else {
            "degrees"
        };
        let chart = Chart {
            title: format!("{}: {title}", self.of.of.name),
            subtitle: subtitle.to_owned(),
            x: Axis::linear(format!("position of drive {drive}, {unit}")),
            y,
            series,
        };
        self.list.push((file.into(), chart));
    }

    /// Returns figures of a group with a closed contour over the cycle.
    fn group_series(&self, i: usize, f: Figures<'_>) -> Vec<Series> {
        series_over(self.of, |x| {
            let found = x.groups.get(i);
            let found = found.and_then(|g| Some(f(x, g, g.reactions_by(self.shown)?)));
            let named = found.into_iter().flatten();
            named.map(|(n, v)| (n.to_owned(), v)).collect_vec()
        })
    }

    fn pair_name(&self, p: PairId) -> &str {
        &self.of.planar_mechanism().pairs[p].name
    }

    /// Explains which joints the letters of a group are.
    fn letters_key(&self, letters: &ContourGroup) -> String {
        let named = [letters.d, letters.f, letters.k, letters.m, letters.l];
        let key = "DFKML".chars().zip(named);
        key.map(|(c, p)| format!("{c} = {}", self.pair_name(p)))
            .join(", ")
    }

    fn contour_reactions(&mut self, i: usize, title: &str, letters: &ContourGroup) {
        let mut series = self.group_series(i, &|_, g, r| magnitudes(&r, &g.pose).to_vec());
        let y = Axis::linear(format!("reaction, {}N", scale_series(&mut series)));
        let (key, guide) = (self.letters_key(letters), self.pair_name(letters.guide));
        let subtitle = format!("{key}; guide {guide} with its sign");
        let words = [&format!("reactions of group {title}"), &*subtitle];
        self.add_chart(format!("group-{title}"), words, y, series);
    }

    fn tangential_reactions(&mut self, i: usize, title: &str, letters: &ContourGroup) {
        let mut series = self.group_series(i, &|_, g, _| {
            let s = &g.steps;
            let forces = [s.r46_tangential, s.r47_tangential, s.r34_tangential];
            ["R46τ", "R47τ", "R34τ"].into_iter().zip(forces).collect()
        });
        let y = Axis::linear(format!("reaction, {}N", scale_series(&mut series)));
        let key = self.letters_key(letters);
        let subtitle = format!("By the δ-point method, across the rods and across Dδ; {key}");
        let words = [
            &format!("tangential reactions of group {title}"),
            &*subtitle,
        ];
        self.add_chart(format!("tangential-{title}"), words, y, series);
    }

    /// Adds the arm of the guide's reaction, and where along the guide it acts.
    fn guide_bearing(&mut self, i: usize, title: &str, letters: &ContourGroup) {
        let linkage = &self.of.found.linkage;
        let far = 2.0 * linkage.size;
        // Far out the line only says that the reaction changes its sign.
        let near = |x: f64| if x.abs() <= far { x } else { f64::NAN };
        let series = self.group_series(i, &|x, g, r| {
            let guide = linkage.pair_position(&x.pose, letters.guide);
            let offset = near(r.guide_offset(&g.pose, guide));
            vec![
                ("arm h about D", near(r.arm)),
                ("offset along the guide", offset),
            ]
        });
        let slider = &linkage.mechanism.bodies[letters.slider].name;
        let guide = self.pair_name(letters.guide);
        let subtitle =
            format!("Point of application of the reaction of {guide}; broken where it vanishes");
        let words = [&format!("where the guide bears link {slider}"), &*subtitle];
        self.add_chart(format!("guide-{title}"), words, Axis::linear("m"), series);
    }

    /// Adds the reactions of a group without a closed contour.
    fn other_group(&mut self, index: usize) {
        let (found, title) = (self.of.found, self.of.group_name(index));
        let g = &found.decomposition.groups[index];
        let pairs = g.all_pairs();
        let mut series = series_over(self.of, |x| {
            let own = x.reactions.iter().filter(|r| pairs.contains(&r.pair));
            own.map(|r| (self.pair_name(r.pair).to_owned(), vector_size(r.force)))
                .collect()
        });
        let y = Axis::linear(format!("reaction, {}N", scale_series(&mut series)));
        let words = [
            &*format!("reactions of group {title}"),
            &g.class.to_string(),
        ];
        self.add_chart(format!("group-{title}"), words, y, series);
    }

    /// Adds the effort of the drives.
    fn add_drive(&mut self) {
        let mut series = series_over(self.of, |x| {
            let drives = x.reactions.iter();
            drives
                .filter_map(|r| Some((self.pair_name(r.pair).to_owned(), r.effort?)))
                .collect()
        });
        if series.is_empty() {
            return;
        }
        let prefix = scale_series(&mut series);
        let (what, unit) = if self.of.found.drive_slides() {
            ("force", "N")
        } else {
            ("torque", "N·m")
        };
        let y = Axis::linear(format!("{what}, {prefix}{unit}"));
        self.add_chart("drive", [&format!("{what} of the drive"), ""], y, series);
    }

    /// Adds accelerations and inertia forces, if anything moves that has a mass.
    fn add_inertia(&mut self) {
        let links = |of: &dyn Fn(&LinkInertia) -> f64| {
            series_over(self.of, |x| {
                let name = |l: &LinkInertia| self.of.planar_mechanism().bodies[l.body].name.clone();
                x.links.iter().map(|l| (name(l), of(l))).collect()
            })
        };
        let series = links(&|l| vector_size(l.acceleration));
        let mut forces = links(&|l| vector_size(l.force));
        if series.iter().flat_map(|e| &e.points).all(|p| p.1 <= 0.0) {
            return;
        }
        let words = ["accelerations of the links' mass centres", ""];
        self.add_chart(
            "accelerations",
            words,
            Axis::linear("acceleration, m/s²"),
            series,
        );
        let y = Axis::linear(format!("inertia force, {}N", scale_series(&mut forces)));
        self.add_chart(
            "inertia-forces",
            ["inertia forces of the links", ""],
            y,
            forces,
        );
    }

    /// Adds how far the methods differ.
    fn add_methods(&mut self) {
        let (s, methods) = (self.of, self.of.methods);
        let series = series_over(s, |x| {
            let named = x.groups.iter().map(|g| {
                let differ = g.max_disagreement(methods).unwrap_or(f64::NAN);
                (
                    format!("group {}", s.group_name(g.group)),
                    differ.max(1e-17),
                )
            });
            named.collect()
        });
        let names = methods.iter().map(|x| x.name()).join(", ");
        let y = log_axis("greatest difference over the greatest reaction");
        self.add_chart("methods", ["how far the methods differ", &names], y, series);
    }
}
