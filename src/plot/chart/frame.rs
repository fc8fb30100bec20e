//! Common parts of every picture: the root element, the title, horizontal axes.

use super::axis::{Label, Ruler};
use crate::chart::style::{PAD, STYLE, TICK};
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
            title: text::wrap(title, 16.5, width - 2.0 * PAD),
            subtitle: text::wrap(subtitle, 12.0, width - 2.0 * PAD),
        }
    }

    /// Returns the height.
    pub(super) fn height(&self) -> f64 {
        PAD + 23.0 * self.title.len() as f64 + 18.0 * self.subtitle.len() as f64 + 6.0
    }

    fn write(&self, xml: &mut Xml) {
        let mut y = PAD - 6.0;
        for (lines, step, class) in [(&self.title, 23.0, "title"), (&self.subtitle, 18.0, "sub")] {
            y += if class == "sub" { 3.0 } else { 0.0 };
            for line in lines {
                y += step;
                label(xml, class, (PAD, y), "").text(line);
            }
        }
    }
}

/// Begins a picture. `class` is added to its root, `about` is read out after the title.
pub(super) fn begin(size: (f64, f64), class: &str, title: &str, about: &str, head: &Head) -> Xml {
    let (width, height) = (size.0.ceil(), size.1.ceil());
    let mut xml = Xml::default();
    let view = format!("0 0 {width} {height}");
    let root = xml.tag("svg").set("xmlns", "http://www.w3.org/2000/svg");
    let root = root
        .set("class", class)
        .set("role", "img")
        .set("viewBox", &view);
    root.num("width", width).num("height", height).open();
    xml.tag("title").text(title);
    xml.tag("desc").text(about);
    xml.tag("style").open();
    xml.raw(STYLE);
    xml.end();
    let back = xml.tag("rect").set("class", "bg");
    back.num("width", width).num("height", height).close();
    head.write(&mut xml);
    xml
}

/// Draws a line between two points.
pub(super) fn stroke(xml: &mut Xml, class: &str, from: (f64, f64), to: (f64, f64)) {
    let line = xml
        .tag("line")
        .set("class", class)
        .num("x1", from.0)
        .num("y1", from.1);
    line.num("x2", to.0).num("y2", to.1).close();
}

/// Begins a text; `anchor` is the SVG text anchor, or empty if the text starts at the point.
pub(super) fn label<'x>(
    xml: &'x mut Xml,
    class: &str,
    (x, y): (f64, f64),
    anchor: &str,
) -> Tag<'x> {
    let text = xml.tag("text").set("class", class).num("x", x).num("y", y);
    if anchor.is_empty() {
        text
    } else {
        text.set("text-anchor", anchor)
    }
}

/// Draws a tick's label; `anchor` is the SVG text anchor.
pub(super) fn tick(xml: &mut Xml, label: &Label, at: (f64, f64), anchor: &str, class: &str) {
    self::label(xml, &format!("soft {class}"), at, anchor).open();
    xml.text(&label.base);
    if let Some(power) = &label.power {
        xml.tag("tspan")
            .set("class", "raised")
            .set("dy", "-5")
            .text(power);
    }
    xml.end();
}

/// Draws the horizontal axis: lines over the plot from `top` to `bottom`, labels below, and the name of the axis under
/// them.
pub(super) fn across(xml: &mut Xml, ruler: &Ruler, name: &str, plot: &Rect) {
    let [left, top, right, bottom] = plot.edges();
    for at in &ruler.fine {
        let x = left + at * (right - left);
        stroke(xml, "fine", (x, top), (x, bottom));
    }
    for tick in &ruler.ticks {
        let x = left + tick.at * (right - left);
        stroke(xml, "grid", (x, top), (x, bottom));
    }
    for tick in &ruler.ticks {
        if let Some(label) = &tick.label {
            let x = left + tick.at * (right - left);
            stroke(xml, "axis", (x, bottom), (x, bottom + 4.0));
            self::tick(xml, label, (x, bottom + 18.0), "middle", "xt");
        }
    }
    let room = right - left;
    let name = text::cut(name, TICK, room.max(300.0));
    label(xml, "name", (right, bottom + 38.0), "end").text(&name);
}

/// Draws the vertical axis: lines over the plot and labels before it.
pub(super) fn up(xml: &mut Xml, ruler: &Ruler, plot: &Rect) {
    let [left, top, right, bottom] = plot.edges();
    let height = |at: f64| bottom - at * (bottom - top);
    for at in &ruler.fine {
        stroke(xml, "fine", (left, height(*at)), (right, height(*at)));
    }
    for tick in &ruler.ticks {
        let y = height(tick.at);
        let zero = tick.label.as_ref().is_some_and(|l| l.base == "0");
        let class = if zero { "axis" } else { "grid" };
        stroke(xml, class, (left, y), (right, y));
        if let Some(label) = &tick.label {
            self::tick(xml, label, (left - 8.0, y + 4.0), "end", "yt");
        }
    }
}
