//! Common parts of every picture: the root element, the title, horizontal axes.

use crate::chart::axis::{Label, Ruler};
use crate::chart::data::{PAD, TICK};
use crate::svg::plane::Rect;
use crate::svg::text;
use crate::svg::xml::{Tag, Xml};

/// The title and the sentence under it, broken into lines.
#[derive(Debug)]
pub(super) struct Head {
    title: Vec<String>,
    subtitle: Vec<String>,
}

impl Head {
    /// Creates the lines for a picture of this width.
    pub(super) fn new(title: &str, subtitle: &str, width: f64) -> Self {
        Head {
            title: text::wrap_text(title, 16.5, width - 2.0 * PAD),
            subtitle: text::wrap_text(subtitle, 12.0, width - 2.0 * PAD),
        }
    }

    /// Returns the height.
    pub(super) fn head_height(&self) -> f64 {
        PAD + 23.0 * self.title.len() as f64 + 18.0 * self.subtitle.len() as f64 + 6.0
    }

    /// Writes the lines.
    pub(super) fn write_head(&self, xml: &mut Xml) {
        let mut y = PAD - 6.0;
        for (lines, step, class) in [(&self.title, 23.0, "title"), (&self.subtitle, 18.0, "sub")] {
            y += if class == "sub" { 3.0 } else { 0.0 };
            for line in lines {
                y += step;
                begin_text(xml, class, (PAD, y), "").write_text(line);
            }
        }
    }
}

/// Draws a line between two points.
pub(super) fn draw_stroke(xml: &mut Xml, class: &str, from: (f64, f64), to: (f64, f64)) {
    let line = xml
        .begin_tag("line")
        .set_text("class", class)
        .set_number("x1", from.0)
        .set_number("y1", from.1);
    line.set_number("x2", to.0)
        .set_number("y2", to.1)
        .close_empty();
}

/// Begins a text; `anchor` is the SVG text anchor, or empty if the text starts at the point.
pub(super) fn begin_text<'x>(
    xml: &'x mut Xml,
    class: &str,
    (x, y): (f64, f64),
    anchor: &str,
) -> Tag<'x> {
    let text = xml
        .begin_tag("text")
        .set_text("class", class)
        .set_number("x", x)
        .set_number("y", y);
    if anchor.is_empty() {
        text
    } else {
        text.set_text("text-anchor", anchor)
    }
}

/// Draws a tick's label; `anchor` is the SVG text anchor.
pub(super) fn draw_tick(xml: &mut Xml, label: &Label, at: (f64, f64), anchor: &str, class: &str) {
    self::begin_text(xml, &format!("soft {class}"), at, anchor).keep_open();
    xml.write_text(&label.base);
    if let Some(power) = &label.power {
        xml.begin_tag("tspan")
            .set_text("class", "raised")
            .set_text("dy", "-5")
            .write_text(power);
    }
    xml.end_element();
}

/// Draws the horizontal axis: lines over the plot from `top` to `bottom`, labels below, and the name of the axis under
/// them.
pub(super) fn draw_across(xml: &mut Xml, ruler: &Ruler, name: &str, plot: &Rect) {
    let [left, top, right, bottom] = plot.edges();
    for at in &ruler.fine {
        let x = left + at * (right - left);
        draw_stroke(xml, "fine", (x, top), (x, bottom));
    }
    for tick in &ruler.ticks {
        let x = left + tick.at * (right - left);
        draw_stroke(xml, "grid", (x, top), (x, bottom));
    }
    for tick in &ruler.ticks {
        if let Some(label) = &tick.label {
            let x = left + tick.at * (right - left);
            draw_stroke(xml, "axis", (x, bottom), (x, bottom + 4.0));
            self::draw_tick(xml, label, (x, bottom + 18.0), "middle", "xt");
        }
    }
    let room = right - left;
    let name = text::cut_text(name, TICK, room.max(300.0));
    begin_text(xml, "name", (right, bottom + 38.0), "end").write_text(&name);
}

/// Draws the vertical axis: lines over the plot and labels before it.
pub(super) fn draw_up(xml: &mut Xml, ruler: &Ruler, plot: &Rect) {
    let [left, top, right, bottom] = plot.edges();
    let height = |at: f64| bottom - at * (bottom - top);
    for at in &ruler.fine {
        draw_stroke(xml, "fine", (left, height(*at)), (right, height(*at)));
    }
    for tick in &ruler.ticks {
        let y = height(tick.at);
        let zero = tick.label.as_ref().is_some_and(|l| l.base == "0");
        let class = if zero { "axis" } else { "grid" };
        draw_stroke(xml, class, (left, y), (right, y));
        if let Some(label) = &tick.label {
            self::draw_tick(xml, label, (left - 8.0, y + 4.0), "end", "yt");
        }
    }
}
