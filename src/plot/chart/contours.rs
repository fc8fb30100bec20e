//! A quantity over two others: a mark for each sample, and lines of equal value where the samples are a grid.

use super::axes::PlotAxes;
use super::axis::{AxisFit, Label, Room, Ruler};
use super::data::{Contours, Scale};
use super::frame::{self, Head};
use crate::chart::style::{PAD, WIDTH};
use crate::format::csv;
use crate::format::number::tooltip;
use crate::svg::xml::{Xml, number};

/// The height of the plot.
const HEIGHT: f64 = 400.0;
/// A row of the legend.
const ROW: f64 = 20.0;
/// How faint the least value is.
const FAINT: f64 = 0.12;

/// A place in the picture, and the value there as a fraction of all of them.
type Node = (f64, f64, f64);

impl Contours {
    /// The plot as a self-contained SVG element, for a file of its own or inside HTML.
    ///
    /// The darker a mark, the greater its value; a hollow one has none. Lines are read between the samples of a full grid, along
    /// its diagonals from the lower left; there are none where values are counts.
    pub fn svg(&self) -> String {
        let head = Head::new(&self.title, &self.subtitle, WIDTH);
        let seen = self.samples.iter().filter(|s| s.2.is_finite());
        let values = Ruler::new(
            Scale::Linear,
            seen.map(|s| s.2),
            AxisFit::Tight,
            Room::Up(260.0),
        );
        let legend = self.legend(&values);
        let axes = self.axes(head.height() + 32.0, &legend);
        let plot = &axes.plot;
        let size = (WIDTH, plot.bottom + 52.0);
        let mut xml = frame::begin(size, "oz oz-contours", &self.title, &self.about(), &head);
        axes.draw(&mut xml, &self.x.label, &self.y.label);
        let place = |&(a, b, value): &(f64, f64, f64)| {
            let (x, y) = axes.place(a, b)?;
            let value = if value.is_finite() {
                values.place(value)?
            } else {
                f64::NAN
            };
            Some((x, y, value))
        };
        let nodes: Vec<Option<Node>> = self.samples.iter().map(place).collect();
        let labels = match self.grid().filter(|_| !self.counts) {
            Some(grid) => lines(&mut xml, &values, &nodes, &grid),
            None => Vec::new(),
        };
        self.marks(&mut xml, &nodes);
        for (x, y, label) in &labels {
            frame::tick(&mut xml, label, (*x, y - 4.0), "middle", "halo");
        }
        for (n, (label, share)) in legend.iter().enumerate() {
            let y = plot.top + 12.0 + ROW * n as f64;
            mark(&mut xml, plot.right + 20.0, y - 4.0, 5.5, *share, "");
            frame::tick(&mut xml, label, (plot.right + 32.0, y), "start", "value");
        }
        xml.finish()
    }

    /// The axes below `top`, as wide as the legend leaves room for.
    fn axes(&self, top: f64, legend: &[(Label, f64)]) -> PlotAxes {
        let widest = legend.iter().map(|(l, _)| l.width());
        let right = WIDTH - PAD - 34.0 - widest.fold(30.0, f64::max);
        let up = self.samples.iter().map(|s| s.1);
        let y = Ruler::new(self.y.scale, up, AxisFit::Padded, Room::Up(HEIGHT));
        PlotAxes::new(top, HEIGHT, right, y, |room| {
            let across = self.samples.iter().map(|s| s.0);
            Ruler::new(self.x.scale, across, AxisFit::Padded, room)
        })
    }

    /// A mark for each sample that can be shown.
    fn marks(&self, xml: &mut Xml, nodes: &[Option<Node>]) {
        let radius = radius(nodes.iter().flatten());
        for (node, &(a, b, value)) in nodes.iter().zip(&self.samples) {
            let Some((px, py, share)) = *node else {
                continue;
            };
            let said = if share.is_nan() {
                "none".to_owned()
            } else {
                tooltip(value)
            };
            let tip = format!("{}, {}: {said}", tooltip(a), tooltip(b));
            mark(xml, px, py, radius, share, &tip);
        }
    }

    /// The samples, one a line.
    pub fn csv(&self) -> String {
        let head = [self.x.label.as_str(), &self.y.label, &self.value];
        let line = |s: &(f64, f64, f64)| [s.0, s.1, s.2].map(|x| format!("{x:?}"));
        csv::table(&head, self.samples.iter().map(line))
    }

    /// Values told beside the plot, with their fractions: all counts where they are few, otherwise round numbers.
    fn legend(&self, values: &Ruler) -> Vec<(Label, f64)> {
        let mut out = self.shades(values);
        if self.samples.iter().any(|s| !s.2.is_finite()) {
            out.push((Label::plain("none".to_owned()), f64::NAN));
        }
        out
    }

    fn shades(&self, values: &Ruler) -> Vec<(Label, f64)> {
        let mut counts: Vec<f64> = self
            .samples
            .iter()
            .map(|s| s.2)
            .filter(|v| v.is_finite())
            .collect();
        counts.sort_by(f64::total_cmp);
        counts.dedup();
        if self.counts && counts.len() <= 16 {
            let each = counts
                .iter()
                .filter_map(|&v| Some((Label::plain(tooltip(v)), values.place(v)?)));
            return each.rev().collect();
        }
        let ticks = values.ticks.iter().rev();
        ticks
            .filter_map(|t| Some((t.label.clone()?, t.at)))
            .collect()
    }

    /// Places in the list of samples by row and column, where the samples are a full grid of two rows and two columns at least.
    fn grid(&self) -> Option<Vec<Vec<usize>>> {
        let sorted = |of: &dyn Fn(&(f64, f64, f64)) -> f64| {
            let mut all: Vec<f64> = self.samples.iter().map(of).collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            all
        };
        let (xs, ys) = (sorted(&|s| s.0), sorted(&|s| s.1));
        if xs.len() < 2 || ys.len() < 2 || xs.len() * ys.len() != self.samples.len() {
            return None;
        }
        let mut out = vec![vec![usize::MAX; xs.len()]; ys.len()];
        for (i, s) in self.samples.iter().enumerate() {
            let column = xs.binary_search_by(|x| x.total_cmp(&s.0)).ok()?;
            let row = ys.binary_search_by(|y| y.total_cmp(&s.1)).ok()?;
            out[row][column] = i;
        }
        out.iter().flatten().all(|&i| i < usize::MAX).then_some(out)
    }

    /// What a screen reader says.
    fn about(&self) -> String {
        let seen = self.samples.iter().map(|s| s.2).filter(|v| v.is_finite());
        let (least, most) = seen
            .clone()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                (a.min(v), b.max(v))
            });
        let range = match seen.count() {
            0 => "no sample has one".to_owned(),
            n => format!(
                "{n} of {} samples, from {} to {}",
                self.samples.len(),
                tooltip(least),
                tooltip(most)
            ),
        };
        let (x, y) = (&self.x.label, &self.y.label);
        let text = format!(
            "{} {} over {x} and {y}: {range}.",
            self.subtitle, self.value
        );
        text.trim_start().to_owned()
    }
}

/// Draws lines of equal value over a grid; a place on each, and its value.
fn lines(
    xml: &mut Xml,
    values: &Ruler,
    nodes: &[Option<Node>],
    grid: &[Vec<usize>],
) -> Vec<(f64, f64, Label)> {
    let node = |i: usize| nodes[i].filter(|n| !n.2.is_nan());
    let mut labels = Vec::new();
    for tick in &values.ticks {
        let (mut path, mut ends) = (String::new(), Vec::new());
        for rows in grid.windows(2) {
            for (low, high) in rows[0].windows(2).zip(rows[1].windows(2)) {
                let corners = [low[0], low[1], high[1], high[0]].map(node);
                for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                    let (Some(a), Some(b), Some(c)) = (corners[a], corners[b], corners[c]) else {
                        continue;
                    };
                    let sides = [(a, b), (b, c), (c, a)];
                    let mut met = sides
                        .into_iter()
                        .filter_map(|(p, q)| crossing(p, q, tick.at));
                    if let (Some(from), Some(to)) = (met.next(), met.next()) {
                        let at = [from.0, from.1, to.0, to.1].map(number);
                        path += &format!("M{} {}L{} {}", at[0], at[1], at[2], at[3]);
                        ends.push(from);
                    }
                }
            }
        }
        if path.is_empty() {
            continue;
        }
        xml.tag("path")
            .set("class", "line c4")
            .set("d", &path)
            .close();
        if let (Some(&(x, y)), Some(label)) = (ends.get(ends.len() / 2), &tick.label) {
            labels.push((x, y, label.clone()));
        }
    }
    labels
}

/// Where a level is met between two places, its end not included, so that each is met once.
fn crossing(p: Node, q: Node, level: f64) -> Option<(f64, f64)> {
    if (p.2 < level) == (q.2 < level) {
        return None;
    }
    let t = (level - p.2) / (q.2 - p.2);
    Some((p.0 + t * (q.0 - p.0), p.1 + t * (q.1 - p.1)))
}

/// How large marks may be, so that the nearest do not touch.
fn radius<'a>(nodes: impl Iterator<Item = &'a Node>) -> f64 {
    let n = nodes.count().max(1) as f64;
    (0.25 * (HEIGHT * HEIGHT / n).sqrt()).clamp(2.0, 9.0)
}

/// A mark of a value, given as a fraction of all; hollow where there is none.
fn mark(xml: &mut Xml, x: f64, y: f64, radius: f64, share: f64, tip: &str) {
    let circle = xml.tag("circle").num("cx", x).num("cy", y).num("r", radius);
    if share.is_nan() {
        return circle.set("class", "hollow c5").tip(tip);
    }
    let shade = FAINT + (1.0 - FAINT) * share;
    let circle = circle.set("class", "f0 c0").num("fill-opacity", shade);
    circle.tip(tip);
}
