//! Series over two axes, as SVG and as CSV.

use super::axis::{AxisFit, Room, Ruler};
use super::data::{Chart, Series, Style};
use super::drawn::{self, DrawnSeries, LEAD, SAMPLE, STEP};
use super::frame::{self, Head};
use crate::chart::style::{COLOURS, PAD, TICK, WIDTH};
use crate::format::csv;
use crate::svg::plane::Rect;
use crate::svg::text;

impl Chart {
    /// The chart as a self-contained SVG element, for a file of its own or inside HTML.
    pub fn svg(&self) -> String {
        let seen =
            |(x, y): &(f64, f64)| Ruler::shows(self.x.scale, *x) && Ruler::shows(self.y.scale, *y);
        let values = || {
            self.series
                .iter()
                .flat_map(|s| &s.points)
                .filter(|p| seen(p))
        };
        let (shown, absent): (Vec<_>, Vec<_>) = self
            .series
            .iter()
            .enumerate()
            .partition(|(_, s)| s.points.iter().any(seen));
        let lone = |s: &Series| {
            s.style == Style::Points && s.points.iter().filter(|p| seen(p)).count() == 1
        };
        let beside = shown.iter().filter(|(_, s)| !lone(s) && !s.name.is_empty());
        let longest = beside
            .clone()
            .map(|(_, s)| text::width(&s.name, TICK))
            .fold(0.0, f64::max);
        let names = beside.count();

        let head = Head::new(&self.title, &self.subtitle, WIDTH);
        let top = head.height() + 32.0;
        let height = (names as f64 * STEP).max(330.0);
        let bottom = top + height;
        let y = Ruler::new(
            self.y.scale,
            values().map(|p| p.1),
            AxisFit::Round,
            Room::Up(height),
        );
        let left = y
            .ticks
            .iter()
            .filter_map(|t| t.label.as_ref())
            .map(|l| l.width());
        let left = (PAD + left.fold(0.0, f64::max) + 8.0).max(48.0);
        let right = match names {
            0 => WIDTH - 36.0,
            _ => WIDTH - PAD - LEAD - SAMPLE - 8.0 - longest.min(230.0),
        };
        let points = self.series.iter().any(|s| s.style == Style::Points);
        let fit = if points {
            AxisFit::Padded
        } else {
            AxisFit::Tight
        };
        let room = Room::Across(right - left, left - 4.0, WIDTH - right - 4.0);
        let x = Ruler::new(self.x.scale, values().map(|p| p.0), fit, room);
        let note = absent
            .iter()
            .map(|(_, s)| s.name.as_str())
            .collect::<Vec<_>>()
            .join(", ");
        let note = match note.as_str() {
            "" => Vec::new(),
            names => text::wrap(
                &format!("Nothing to show: {names}."),
                11.0,
                WIDTH - 2.0 * PAD,
            ),
        };
        let foot = bottom + 52.0;

        let size = (WIDTH, foot + 16.0 * note.len() as f64);
        let mut xml = frame::begin(size, "oz oz-chart", &self.title, &self.about(seen), &head);
        let plot = Rect {
            left,
            top,
            right,
            bottom,
        };
        let label = text::cut(&self.y.label, TICK, WIDTH - 2.0 * PAD);
        let text = xml.tag("text").set("class", "name").num("x", PAD);
        text.num("y", top - 14.0).text(&label);
        frame::up(&mut xml, &y, &plot);
        frame::across(&mut xml, &x, &self.x.label, &plot);
        frame::stroke(&mut xml, "axis", (left, bottom), (right, bottom));
        let place = |p: (f64, f64)| {
            let (a, b) = (x.place(p.0)?, y.place(p.1)?);
            Some((left + a * (right - left), bottom - b * height))
        };
        let lines = self.series.iter().filter(|s| s.style != Style::Points);
        let many = lines.count() > COLOURS;
        let drawn: Vec<DrawnSeries> = shown
            .iter()
            .map(|&(number, series)| DrawnSeries {
                many,
                number,
                series,
                runs: drawn::runs(series, place),
            })
            .collect();
        for d in &drawn {
            drawn::body(&mut xml, d);
        }
        drawn::beside_points(&mut xml, &drawn, &plot);
        drawn::margin(&mut xml, &drawn, &plot);
        for (n, line) in note.iter().enumerate() {
            let y = foot + 16.0 * n as f64;
            xml.tag("text")
                .set("class", "soft small")
                .num("x", PAD)
                .num("y", y)
                .text(line);
        }
        xml.finish()
    }

    /// The points in long form, one a line, under the heads `series,x,y`.
    pub fn csv(&self) -> String {
        let points = |s: &Series| {
            let one = |(x, y)| [s.name.clone(), format!("{x:?}"), format!("{y:?}")];
            s.points.iter().copied().map(one).collect::<Vec<_>>()
        };
        csv::table(&["series", "x", "y"], self.series.iter().flat_map(points))
    }

    /// What a screen reader says.
    fn about(&self, seen: impl Fn(&(f64, f64)) -> bool) -> String {
        let all: usize = self.series.iter().map(|s| s.points.len()).sum();
        let shown = self
            .series
            .iter()
            .flat_map(|s| &s.points)
            .filter(|p| seen(p))
            .count();
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
