//! Drawing of the series of a chart: lines, marks, names.

use super::data::{Series, Style};
use super::frame;
use crate::chart::data::{COLOURS, PAD, TICK, WIDTH};
use crate::format::six_digits;
use crate::svg::plane::{Rect, path_data};
use crate::svg::text;
use crate::svg::xml::{Xml, format_number};

/// The vertical distance between names in the margin.
pub(super) const STEP: f64 = 18.0;
/// The length of the line sample before a name.
pub(super) const SAMPLE: f64 = 24.0;
/// The space between the plot and the samples.
pub(super) const LEAD: f64 = 16.0;
/// Number of points above which a line has only a few marks, and only among many series.
const SPARSE: usize = 40;

/// The outline of a plus sign.
const PLUS: [(f64, f64); 12] = [
    (-0.45, -1.35),
    (0.45, -1.35),
    (0.45, -0.45),
    (1.35, -0.45),
    (1.35, 0.45),
    (0.45, 0.45),
    (0.45, 1.35),
    (-0.45, 1.35),
    (-0.45, 0.45),
    (-1.35, 0.45),
    (-1.35, -0.45),
    (-0.45, -0.45),
];

/// Neighbouring points that can be shown: the position in pixels and the point.
pub(super) type Run = Vec<((f64, f64), (f64, f64))>;

/// A series prepared for drawing.
#[derive(Debug)]
pub(super) struct DrawnSeries<'a> {
    /// Whether lines need marks to be distinguished.
    pub(super) many: bool,
    /// Its index among all series.
    pub(super) number: usize,
    /// The series.
    pub(super) series: &'a Series,
    /// Its points, broken at those that cannot be shown.
    pub(super) runs: Vec<Run>,
}

impl DrawnSeries<'_> {
    fn shown_points(&self) -> impl Iterator<Item = ((f64, f64), (f64, f64))> + '_ {
        self.runs.iter().flatten().copied()
    }

    /// Returns the position of the rightmost point, or the later of two.
    fn last_end(&self) -> Option<(f64, f64)> {
        self.shown_points()
            .map(|(place, _)| place)
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Returns true if every point has its mark.
    fn is_marked(&self) -> bool {
        match self.series.style {
            Style::Points => true,
            Style::Steps => false,
            Style::Line | Style::Dashed => self.shown_points().count() <= SPARSE,
        }
    }

    fn colour_index(&self) -> usize {
        self.number % COLOURS
    }

    fn is_hollow(&self) -> bool {
        self.number / COLOURS % 2 == 1
    }
}

/// Returns the points that can be shown, broken at those that cannot.
pub(super) fn find_runs(
    series: &Series,
    place: impl Fn((f64, f64)) -> Option<(f64, f64)>,
) -> Vec<Run> {
    let mut runs = vec![Vec::new()];
    for &point in &series.points {
        match place(point) {
            Some(at) => runs
                .last_mut()
                .into_iter()
                .for_each(|run| run.push((at, point))),
            None => runs.push(Vec::new()),
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

/// Returns the path through runs of positions, with held levels if `steps`.
fn runs_path(runs: &[Run], steps: bool) -> String {
    let mut out = String::new();
    for run in runs.iter().filter(|run| run.len() > 1) {
        let mut last = (String::new(), String::new());
        for (n, ((x, y), _)) in run.iter().enumerate() {
            let (x, y) = (format_number(*x), format_number(*y));
            if n == 0 {
                out += &format!("M{x} {y}");
            } else if (&x, &y) != (&last.0, &last.1) {
                out += &if steps {
                    format!("H{x}V{y}")
                } else {
                    format!("L{x} {y}")
                };
            }
            last = (x, y);
        }
    }
    out
}

fn line_class(d: &DrawnSeries) -> String {
    let dash = if d.series.style == Style::Dashed {
        " dash"
    } else {
        ""
    };
    format!("line{dash} c{}", d.colour_index())
}

/// Draws the line and the points of a series.
pub(super) fn draw_body(xml: &mut Xml, d: &DrawnSeries) {
    let style = d.series.style;
    xml.begin_tag("g").keep_open();
    if style != Style::Points {
        let path = runs_path(&d.runs, style == Style::Steps);
        if !path.is_empty() {
            xml.begin_tag("path")
                .set_text("class", &line_class(d))
                .set_text("d", &path)
                .close_with_tip(&d.series.name);
        }
    }
    let count = d.shown_points().count();
    let size = match (style, count) {
        (Style::Points, ..=200) => 4.5,
        (Style::Points, _) => 3.0,
        _ => 3.2,
    };
    // Long lines among many have a few marks each, at places of their own.
    let every = match (d.is_marked(), d.many) {
        (true, _) => Some(1),
        (false, true) => Some(count.div_ceil(8).max(1)),
        (false, false) => None,
    };
    let is_its_place = |n: usize| every.is_some_and(|e| n % e == d.number * e / 14 % e);
    let points = d.runs.iter().flat_map(|run| {
        let alone = run.len() == 1;
        run.iter().map(move |point| (alone, point))
    });
    for (n, (alone, &(at, point))) in points.enumerate() {
        if alone || is_its_place(n) {
            let (x, y) = (six_digits(point.0), six_digits(point.1));
            let tip = format!("{}: {x}, {y}", d.series.name);
            let tip = if count <= 2000 { &*tip } else { "" };
            draw_mark(xml, d, at.0, at.1, size, tip);
        }
    }
    xml.end_element();
}

/// Draws the mark of a series, which is identified by its shape, colour and filling.
fn draw_mark(xml: &mut Xml, d: &DrawnSeries, x: f64, y: f64, r: f64, tip: &str) {
    let class = match (d.is_hollow(), d.series.style) {
        (true, _) => format!("hollow c{}", d.colour_index()),
        (_, Style::Points) => format!("full f{}", d.colour_index()),
        _ => format!("f{}", d.colour_index()),
    };
    let corners: &[(f64, f64)] = match (d.number + d.number / (2 * COLOURS)) % COLOURS {
        0 => {
            let circle = xml.begin_tag("circle").set_text("class", &class);
            return circle
                .set_number("cx", x)
                .set_number("cy", y)
                .set_number("r", r)
                .close_with_tip(tip);
        }
        1 => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        2 => &[(0.0, -1.25), (1.15, 0.8), (-1.15, 0.8)],
        3 => &[(0.0, -1.35), (1.35, 0.0), (0.0, 1.35), (-1.35, 0.0)],
        4 => &[(0.0, 1.25), (1.15, -0.8), (-1.15, -0.8)],
        5 => &PLUS,
        _ => &PLUS.map(|(a, b)| (0.8 * (a - b), 0.8 * (a + b))),
    };
    let corners = corners.iter().map(|(a, b)| [x + a * r, y + b * r]);
    xml.begin_tag("path")
        .set_text("class", &class)
        .set_text("d", &path_data(&corners.collect::<Vec<_>>(), true))
        .close_with_tip(tip);
}

/// Returns heights at least `step` apart within `from..=to`, in the order of the requested ones and as near to them as
/// possible.
///
/// The requested heights must ascend. If there is too little space, the last ones go below it.
fn spread_heights(wishes: &[f64], step: f64, from: f64, to: f64) -> Vec<f64> {
    // least squares with a fixed order: pools of neighbours that push each other take their mean
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (n, wish) in wishes.iter().enumerate() {
        let mut pool = (wish - n as f64 * step, 1);
        while let Some(&(mean, count)) = pools.last() {
            if mean <= pool.0 {
                break;
            }
            let all = count + pool.1;
            pool = (
                (mean * count as f64 + pool.0 * pool.1 as f64) / all as f64,
                all,
            );
            pools.pop();
        }
        pools.push(pool);
    }
    let last = (to - wishes.len().saturating_sub(1) as f64 * step).max(from);
    let means = pools
        .iter()
        .flat_map(|&(mean, count)| std::iter::repeat_n(mean, count));
    means
        .enumerate()
        .map(|(n, mean)| mean.clamp(from, last) + n as f64 * step)
        .collect()
}

/// Draws the names of all other series in the margin, each near the end of its line and with a sample of it.
pub(super) fn name_in_margin(xml: &mut Xml, drawn: &[DrawnSeries], plot: &Rect) {
    let named = drawn.iter().filter(|d| !d.series.name.is_empty());
    let mut ends: Vec<_> = named.filter_map(|d| Some((d.last_end()?, d))).collect();
    ends.sort_by(|a, b| a.0.1.total_cmp(&b.0.1));
    let wishes: Vec<_> = ends.iter().map(|(end, _)| end.1).collect();
    let half = STEP / 2.0;
    let heights = spread_heights(&wishes, STEP, plot.top + half, plot.bottom - half);
    for ((end, d), y) in ends.iter().zip(heights) {
        let from = plot.right + LEAD;
        if plot.right - end.0 < 12.0 {
            frame::draw_stroke(
                xml,
                "lead",
                (end.0.max(plot.right) + 3.0, end.1),
                (from - 2.0, y),
            );
        }
        if d.series.style != Style::Points {
            frame::draw_stroke(xml, &line_class(d), (from, y), (from + SAMPLE, y));
        }
        if d.is_marked() || d.many {
            draw_mark(xml, d, from + SAMPLE / 2.0, y, 4.0, "");
        }
        let at = from + SAMPLE + 8.0;
        let name = text::cut_text(&d.series.name, TICK, WIDTH - PAD / 2.0 - at);
        frame::begin_text(xml, "name", (at, y + 4.0), "").text_and_tip(&name, &d.series.name);
    }
}

#[cfg(test)]
mod tests {
    use super::spread_heights;

    #[test]
    fn names_keep_apart_and_near() {
        assert_eq!(
            spread_heights(&[10.0, 50.0], 16.0, 0.0, 100.0),
            [10.0, 50.0]
        );
        assert_eq!(
            spread_heights(&[50.0, 50.0], 16.0, 0.0, 100.0),
            [42.0, 58.0]
        );
        assert_eq!(
            spread_heights(&[99.0, 100.0, 100.0], 10.0, 0.0, 100.0),
            [80.0, 90.0, 100.0]
        );
        assert_eq!(spread_heights(&[1.0, 2.0], 10.0, 0.0, 5.0), [0.0, 10.0]);
        assert!(spread_heights(&[], 10.0, 0.0, 5.0).is_empty());
    }
}
