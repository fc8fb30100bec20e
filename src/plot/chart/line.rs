//! Series over two axes, as SVG and as CSV.

use super::axes::PlotAxes;
use super::axis::{AxisFit, Room, Ruler};
use super::data::{Chart, Series, Style};
use super::drawn::{self, DrawnSeries, LEAD, SAMPLE, STEP};
use super::frame::{self, Head};
use crate::chart::style::{COLOURS, PAD, TICK, WIDTH};
use crate::format::csv;
use crate::svg::text;

/// A series with its index among all of them.
type Numbered<'a> = (usize, &'a Series);

impl Chart {
    /// Returns the chart as a self-contained SVG element, for a separate file or inside HTML.
    pub fn svg(&self) -> String {
        let (shown, absent): (Vec<Numbered>, Vec<Numbered>) = self
            .series
            .iter()
            .enumerate()
            .partition(|(_, s)| s.points.iter().any(|p| self.shows(p)));
        let head = Head::new(&self.title, &self.subtitle, WIDTH);
        let axes = self.axes(head.height() + 32.0, &shown);
        let note = missing(&absent);
        let foot = axes.plot.bottom + 52.0;

        let size = (WIDTH, foot + 16.0 * note.len() as f64);
        let mut xml = frame::begin(size, "oz oz-chart", &self.title, &self.about(), &head);
        axes.draw(&mut xml, &self.x.label, &self.y.label);
        let lines = self.series.iter().filter(|s| s.style != Style::Points);
        let many = lines.count() > COLOURS;
        let drawn: Vec<DrawnSeries> = shown
            .iter()
            .map(|&(number, series)| DrawnSeries {
                many,
                number,
                series,
                runs: drawn::runs(series, |p| axes.place(p.0, p.1)),
            })
            .collect();
        for d in &drawn {
            drawn::body(&mut xml, d);
        }
        drawn::beside_points(&mut xml, &drawn, &axes.plot);
        drawn::margin(&mut xml, &drawn, &axes.plot);
        for (n, line) in note.iter().enumerate() {
            let y = foot + 16.0 * n as f64;
            frame::label(&mut xml, "soft small", (PAD, y), "").text(line);
        }
        xml.finish()
    }

    /// Returns true if a point can be shown on both axes.
    fn shows(&self, &(x, y): &(f64, f64)) -> bool {
        Ruler::shows(self.x.scale, x) && Ruler::shows(self.y.scale, y)
    }

    /// Returns the points that can be shown.
    fn seen(&self) -> impl Iterator<Item = &(f64, f64)> {
        let points = self.series.iter().flat_map(|s| &s.points);
        points.filter(|p| self.shows(p))
    }

    /// Returns the axes below `top`, as high as the names of series in the margin require, and as wide as those leave
    /// space for.
    fn axes(&self, top: f64, shown: &[Numbered]) -> PlotAxes {
        let lone = |s: &Series| {
            s.style == Style::Points && s.points.iter().filter(|p| self.shows(p)).count() == 1
        };
        let beside = shown.iter().filter(|(_, s)| !lone(s) && !s.name.is_empty());
        let longest = beside
            .clone()
            .map(|(_, s)| text::width(&s.name, TICK))
            .fold(0.0, f64::max);
        let names = beside.count();
        let height = (names as f64 * STEP).max(330.0);
        let right = match names {
            0 => WIDTH - 36.0,
            _ => WIDTH - PAD - LEAD - SAMPLE - 8.0 - longest.min(230.0),
        };
        let y = Ruler::new(
            self.y.scale,
            self.seen().map(|p| p.1),
            AxisFit::Round,
            Room::Up(height),
        );
        let points = self.series.iter().any(|s| s.style == Style::Points);
        let fit = if points {
            AxisFit::Padded
        } else {
            AxisFit::Tight
        };
        PlotAxes::new(top, height, right, y, |room| {
            Ruler::new(self.x.scale, self.seen().map(|p| p.0), fit, room)
        })
    }

    /// Returns the points in long form, one per line, under the heads `series,x,y`.
    pub fn csv(&self) -> String {
        let points = |s: &Series| {
            let one = |(x, y)| [s.name.clone(), format!("{x:?}"), format!("{y:?}")];
            s.points.iter().copied().map(one).collect::<Vec<_>>()
        };
        csv::table(&["series", "x", "y"], self.series.iter().flat_map(points))
    }

    /// Returns the text for screen readers.
    fn about(&self) -> String {
        let all: usize = self.series.iter().map(|s| s.points.len()).sum();
        let shown = self.seen().count();
        let names = self
            .series
            .iter()
            .map(|s| s.name.as_str())
            .collect::<Vec<_>>()
            .join(", ");
        let sentence = if self.subtitle.is_empty() {
            String::new()
        } else {
            format!("{} ", self.subtitle)
        };
        let (x, y) = (&self.x.label, &self.y.label);
        let missing = match all - shown {
            0 => String::new(),
            n => format!(" {n} of {all} points cannot be shown."),
        };
        format!("{sentence}{y} over {x}. Series: {names}.{missing}")
    }
}

/// Returns lines that list the series with nothing to show.
fn missing(absent: &[Numbered]) -> Vec<String> {
    let names = absent
        .iter()
        .map(|(_, s)| s.name.as_str())
        .collect::<Vec<_>>()
        .join(", ");
    match names.as_str() {
        "" => Vec::new(),
        names => text::wrap(
            &format!("Nothing to show: {names}."),
            11.0,
            WIDTH - 2.0 * PAD,
        ),
    }
}
