//! Series over two axes, as SVG and as CSV.

use crate::chart::axis::{AxisFit, Label, Room, Ruler};
use crate::chart::data::{COLOURS, Chart, PAD, STYLE, Series, Style, TICK, WIDTH};
use crate::chart::drawn::{self, DrawnSeries, LEAD, SAMPLE, STEP};
use crate::chart::frame::{self, Head};
use crate::format::csv;
use crate::svg::plane::Rect;
use crate::svg::text;
use crate::svg::xml::Xml;

/// A series with its index among all of them.
type Numbered<'a> = (usize, &'a Series);

impl Chart {
    /// Returns the chart as a self-contained SVG element, for a separate file or inside HTML.
    pub fn svg(&self) -> String {
        let (shown, absent): (Vec<Numbered>, Vec<Numbered>) = self
            .series
            .iter()
            .enumerate()
            .partition(|(_, s)| s.points.iter().any(|p| self.shows_point(p)));
        let head = Head::new(&self.title, &self.subtitle, WIDTH);
        let axes = self.make_axes(head.head_height() + 32.0, &shown);
        let note = missing_note(&absent);
        let foot = axes.plot.bottom + 52.0;

        let size = [WIDTH, foot + 16.0 * note.len() as f64];
        let texts = [&*self.title, &self.about_text()];
        let mut xml = Xml::begin_picture("oz oz-chart", size, texts, STYLE);
        head.write_head(&mut xml);
        axes.draw_axes(&mut xml, &self.x.label, &self.y.label);
        let lines = self.series.iter().filter(|s| s.style != Style::Points);
        let many = lines.count() > COLOURS;
        let drawn: Vec<DrawnSeries> = shown
            .iter()
            .map(|&(number, series)| DrawnSeries {
                many,
                number,
                series,
                runs: drawn::find_runs(series, |p| axes.place_point(p.0, p.1)),
            })
            .collect();
        for d in &drawn {
            drawn::draw_body(&mut xml, d);
        }
        drawn::name_in_margin(&mut xml, &drawn, &axes.plot);
        for (n, line) in note.iter().enumerate() {
            let y = foot + 16.0 * n as f64;
            frame::begin_text(&mut xml, "soft small", (PAD, y), "").write_text(line);
        }
        xml.finish_document()
    }

    /// Returns true if a point can be shown on both axes.
    fn shows_point(&self, &(x, y): &(f64, f64)) -> bool {
        Ruler::can_show(self.x.scale, x) && Ruler::can_show(self.y.scale, y)
    }

    /// Returns the points that can be shown.
    fn seen_points(&self) -> impl Iterator<Item = &(f64, f64)> {
        let points = self.series.iter().flat_map(|s| &s.points);
        points.filter(|p| self.shows_point(p))
    }

    /// Returns the axes below `top`, behind the labels of the vertical one, as high as the names of series in the margin require, and as
    /// wide as those leave space for.
    fn make_axes(&self, top: f64, shown: &[Numbered]) -> PlotAxes {
        let beside = shown.iter().filter(|(_, s)| !s.name.is_empty());
        let longest = beside
            .clone()
            .map(|(_, s)| text::text_width(&s.name, TICK))
            .fold(0.0, f64::max);
        let names = beside.count();
        let height = (names as f64 * STEP).max(330.0);
        let right = match names {
            0 => WIDTH - 36.0,
            _ => WIDTH - PAD - LEAD - SAMPLE - 8.0 - longest.min(230.0),
        };
        let y = Ruler::new(
            self.y.scale,
            self.seen_points().map(|p| p.1),
            AxisFit::Round,
            Room::Up(height),
        );
        let points = self.series.iter().any(|s| s.style == Style::Points);
        let fit = if points {
            AxisFit::Padded
        } else {
            AxisFit::Tight
        };
        let labels = y.ticks.iter().filter_map(|t| t.label.as_ref());
        let left = labels.map(Label::label_width).fold(0.0, f64::max);
        let left = (PAD + left + 8.0).max(48.0);
        let room = Room::Across(right - left, left - 4.0, WIDTH - right - 4.0);
        PlotAxes {
            plot: Rect::new(left, top, right, top + height),
            height,
            x: Ruler::new(self.x.scale, self.seen_points().map(|p| p.0), fit, room),
            y,
        }
    }

    /// Returns the points in long form, one per line, under the heads `series,x,y`.
    ///
    /// # Examples
    /// ```
    /// use ozols::chart::{Axis, Chart, Series, Style};
    /// let series = Series { name: "drive".into(), points: vec![(0.0, 0.5)], style: Style::Points };
    /// let [x, y] = ["time, s", "angle, rad"].map(Axis::linear);
    /// let chart = Chart { title: "Swing".into(), subtitle: String::new(), x, y, series: vec![series] };
    /// assert_eq!(chart.csv(), "series,x,y\ndrive,0.0,0.5\n");
    /// ```
    pub fn csv(&self) -> String {
        let points = |s: &Series| {
            let one = |(x, y)| [s.name.clone(), format!("{x:?}"), format!("{y:?}")];
            s.points.iter().copied().map(one).collect::<Vec<_>>()
        };
        csv::write_table(&["series", "x", "y"], self.series.iter().flat_map(points))
    }

    /// Returns the text for screen readers.
    fn about_text(&self) -> String {
        let all: usize = self.series.iter().map(|s| s.points.len()).sum();
        let shown = self.seen_points().count();
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
fn missing_note(absent: &[Numbered]) -> Vec<String> {
    let names = absent
        .iter()
        .map(|(_, s)| s.name.as_str())
        .collect::<Vec<_>>()
        .join(", ");
    match names.as_str() {
        "" => Vec::new(),
        names => text::wrap_text(
            &format!("Nothing to show: {names}."),
            11.0,
            WIDTH - 2.0 * PAD,
        ),
    }
}

/// A horizontal axis, a vertical axis, and the rectangle that they span.
#[derive(Debug)]
struct PlotAxes {
    plot: Rect,
    height: f64,
    x: Ruler,
    y: Ruler,
}

impl PlotAxes {
    /// Draws the axes with their names.
    fn draw_axes(&self, xml: &mut Xml, across: &str, up: &str) {
        let plot = &self.plot;
        let label = text::cut_text(up, TICK, WIDTH - 2.0 * PAD);
        frame::begin_text(xml, "name", (PAD, plot.top - 14.0), "").write_text(&label);
        frame::draw_up(xml, &self.y, plot);
        frame::draw_across(xml, &self.x, across, plot);
        let corners = [plot.left, plot.right].map(|x| (x, plot.bottom));
        frame::draw_stroke(xml, "axis", corners[0], corners[1]);
    }

    /// Returns the position of a point in the picture, or `None` if it cannot be shown.
    fn place_point(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (across, up) = (self.x.place_value(x)?, self.y.place_value(y)?);
        let plot = &self.plot;
        Some((
            plot.left + across * (plot.right - plot.left),
            plot.bottom - up * self.height,
        ))
    }
}
