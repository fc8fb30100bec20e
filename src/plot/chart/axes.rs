//! The two axes of a plot, and the place of points between them.

use super::axis::{Label, Room, Ruler};
use super::frame;
use crate::chart::style::{PAD, TICK, WIDTH};
use crate::svg::plane::Rect;
use crate::svg::text;
use crate::svg::xml::Xml;

/// An axis across, an axis up, and the rectangle that they span.
#[derive(Debug)]
pub(super) struct PlotAxes {
    pub(super) plot: Rect,
    height: f64,
    x: Ruler,
    y: Ruler,
}

impl PlotAxes {
    /// Axes that go down from `top` by `height` and end at `right`. They begin behind the labels of the axis up; `across` makes
    /// the ruler for the room that is left.
    pub(super) fn new(
        top: f64,
        height: f64,
        right: f64,
        y: Ruler,
        across: impl FnOnce(Room) -> Ruler,
    ) -> Self {
        let labels = y.ticks.iter().filter_map(|t| t.label.as_ref());
        let left = labels.map(Label::width).fold(0.0, f64::max);
        let left = (PAD + left + 8.0).max(48.0);
        let room = Room::Across(right - left, left - 4.0, WIDTH - right - 4.0);
        PlotAxes {
            plot: Rect {
                left,
                top,
                right,
                bottom: top + height,
            },
            height,
            x: across(room),
            y,
        }
    }

    /// Draws them with their names.
    pub(super) fn draw(&self, xml: &mut Xml, across: &str, up: &str) {
        let plot = &self.plot;
        let label = text::cut(up, TICK, WIDTH - 2.0 * PAD);
        let text = xml.tag("text").set("class", "name").num("x", PAD);
        text.num("y", plot.top - 14.0).text(&label);
        frame::up(xml, &self.y, plot);
        frame::across(xml, &self.x, across, plot);
        let corners = [plot.left, plot.right].map(|x| (x, plot.bottom));
        frame::stroke(xml, "axis", corners[0], corners[1]);
    }

    /// Where a point is in the picture; none if it cannot be shown.
    pub(super) fn place(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (across, up) = (self.x.place(x)?, self.y.place(y)?);
        let plot = &self.plot;
        Some((
            plot.left + across * (plot.right - plot.left),
            plot.bottom - up * self.height,
        ))
    }
}
