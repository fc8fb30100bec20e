//! The two axes of a plot, and the positions of points between them.

use super::axis::{Label, Room, Ruler};
use super::frame;
use crate::chart::style::{PAD, TICK, WIDTH};
use crate::svg::plane::Rect;
use crate::svg::text;
use crate::svg::xml::Xml;

/// A horizontal axis, a vertical axis, and the rectangle that they span.
#[derive(Debug)]
pub(super) struct PlotAxes {
    pub(super) plot: Rect,
    height: f64,
    x: Ruler,
    y: Ruler,
}

impl PlotAxes {
    /// Creates axes of this `height` that start at `top` and end at `right`. They begin behind the labels of the
    /// vertical axis. `across` creates the ruler for the remaining space.
    pub(super) fn new(
        top: f64,
        height: f64,
        right: f64,
        y: Ruler,
        across: impl FnOnce(Room) -> Ruler,
    ) -> Self {
        let labels = y.ticks.iter().filter_map(|t| t.label.as_ref());
        let left = labels.map(Label::label_width).fold(0.0, f64::max);
        let left = (PAD + left + 8.0).max(48.0);
        let room = Room::Across(right - left, left - 4.0, WIDTH - right - 4.0);
        PlotAxes {
            plot: Rect::new(left, top, right, top + height),
            height,
            x: across(room),
            y,
        }
    }

    /// Draws the axes with their names.
    pub(super) fn draw_axes(&self, xml: &mut Xml, across: &str, up: &str) {
        let plot = &self.plot;
        let label = text::cut_text(up, TICK, WIDTH - 2.0 * PAD);
        frame::begin_text(xml, "name", (PAD, plot.top - 14.0), "").write_text(&label);
        frame::draw_up(xml, &self.y, plot);
        frame::draw_across(xml, &self.x, across, plot);
        let corners = [plot.left, plot.right].map(|x| (x, plot.bottom));
        frame::draw_stroke(xml, "axis", corners[0], corners[1]);
    }

    /// Returns the position of a point in the picture, or `None` if it cannot be shown.
    pub(super) fn place_point(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let (across, up) = (self.x.place_value(x)?, self.y.place_value(y)?);
        let plot = &self.plot;
        Some((
            plot.left + across * (plot.right - plot.left),
            plot.bottom - up * self.height,
        ))
    }
}
