//! The sheet a drawing is on: title, style, legend, and a record of every label and symbol.

use crate::draw::prelude::*;
use crate::svg::text::cut_text;
use crate::svg::xml::{Xml, format_number};
pub(crate) use shapes::Shape;

pub(crate) mod shapes;

/// The space around everything.
pub(crate) const PAD: f64 = 20.0;
/// The size of ids.
pub(crate) const SMALL: f64 = 11.0;
/// The size of the legend.
const TEXT: f64 = 12.0;
/// The height of a row of the legend.
pub(crate) const ROW: f64 = 22.0;
const SWATCH: f64 = 40.0;
/// A legend's row is cut beyond this.
const WIDEST: f64 = 560.0;

/// The look. Its classes are its own, so that charts and drawings may share a page; colours stand outright, since many
/// viewers of files know no CSS variables.
pub const STYLE: &str = include_str!("sheet/sheet.css");

/// A text of a drawing and the room it takes at 0.6 of its size a character.
#[derive(Debug, Clone)]
pub struct Label {
    /// The text.
    pub text: String,
    /// Its room.
    pub rect: Rect,
}

/// A finished drawing.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// The picture.
    pub svg: String,
    /// Its width in pixels.
    pub width: f64,
    /// Its height in pixels.
    pub height: f64,
    /// Every text.
    pub labels: Vec<Label>,
    /// The room of the joints' symbols; a joint's class stands inside its own.
    pub symbols: Vec<Rect>,
}

/// The sample in front of a legend's text.
#[derive(Debug, Clone)]
pub(crate) enum Swatch {
    /// The tint of a contour with so many redundant constraints, and its number.
    Tint(usize, String),
    /// Drawn around the origin by a function.
    Symbol(fn(&mut Sheet)),
    /// A joint with text in it.
    Joint(&'static str, String),
    /// Shapes around the origin.
    Shapes(Vec<Shape>),
}

impl Swatch {
    /// Returns a horizontal line of a class.
    pub(crate) fn line(class: &str) -> Swatch {
        let line = Shape::line(class, vec![[-9.0, 0.0], [9.0, 0.0]]);
        Swatch::Shapes(vec![line])
    }
}

/// A drawing under way; the default is a piece without title or size.
#[derive(Debug, Default)]
pub(crate) struct Sheet {
    xml: Xml,
    /// The origin of the open groups.
    origin: Point,
    labels: Vec<Label>,
    symbols: Vec<Rect>,
}

/// The texts round a drawing.
#[derive(Debug)]
pub(crate) struct Caption<'a> {
    pub(crate) title: &'a str,
    /// Two lines.
    pub(crate) subtitle: [&'a str; 2],
    pub(crate) description: &'a str,
    pub(crate) legend: Vec<(Swatch, String)>,
}

/// The minimum width of a sheet.
const LEAST: f64 = 580.0;
/// The height of title and subtitle.
const HEAD: f64 = 62.0;

/// Lays a sheet out round a drawing that covers `area`, with `strip` pixels below it for other things. `draw` gets the offset of the
/// drawing and the top of the strip.
pub(crate) fn draw_sheet(
    caption: &Caption<'_>,
    area: Rect,
    strip: f64,
    draw: impl FnOnce(&mut Sheet, Point, f64),
) -> Drawing {
    let rows = &caption.legend;
    let widest = rows.iter().map(|(_, t)| text_width(t, TEXT));
    let column = SWATCH + widest.fold(0.0, f64::max).min(WIDEST) + 24.0;
    // a long legend has two columns, however narrow the drawing is
    let least = if rows.len() > 8 { 2.0 } else { 1.0 };
    let [left, top, right, bottom] = area.edges();
    let inner = (right - left).max(LEAST).max(least * column - 24.0);
    let columns = (((inner + 24.0) / column) as usize).clamp(1, 4);
    let lines = rows.len().div_ceil(columns);
    let below = PAD + HEAD + (bottom - top) + 18.0;
    let foot = if lines == 0 { PAD - 10.0 } else { PAD };
    let size = [inner + 2.0 * PAD, below + strip + ROW * lines as f64 + foot];
    let texts = [caption.title, caption.description];
    let mut sheet = Sheet {
        xml: Xml::begin_picture("ozd", size, texts, STYLE),
        ..Sheet::default()
    };
    sheet.write_head(caption, inner);
    let shift = [
        PAD + (inner - (right - left)) / 2.0 - left,
        PAD + HEAD - top,
    ];
    draw(&mut sheet, shift, below);
    for (i, (swatch, text)) in rows.iter().enumerate() {
        let x = PAD + column * (i / lines) as f64;
        let y = below + strip + ROW * ((i % lines) as f64 + 0.5);
        sheet.draw_swatch(swatch, [x + 15.0, y]);
        let room = column - SWATCH - 20.0;
        let shown = cut_text(text, TEXT, room.min(size[0] - x - SWATCH - PAD));
        sheet.write_text("legend", TEXT, [x + SWATCH, y], Anchor::Start, &shown);
    }
    Drawing {
        svg: sheet.xml.finish_document(),
        width: size[0].ceil(),
        height: size[1].ceil(),
        labels: sheet.labels,
        symbols: sheet.symbols,
    }
}

impl Sheet {
    /// Writes title and subtitle.
    fn write_head(&mut self, caption: &Caption<'_>, room: f64) {
        let title = cut_text(caption.title, 18.0, room);
        self.write_text("title", 18.0, [PAD, PAD + 8.0], Anchor::Start, &title);
        for (i, line) in caption.subtitle.iter().enumerate() {
            let y = PAD + 30.0 + 17.0 * i as f64;
            let line = cut_text(line, 13.0, room);
            self.write_text("sub", 13.0, [PAD, y], Anchor::Start, &line);
        }
    }

    /// Returns the elements of a piece.
    pub(crate) fn into_text(self) -> String {
        self.xml.finish_document()
    }

    /// Draws something into a group round `at` that says what it stands for, so that a program can find it.
    pub(crate) fn draw_group(
        &mut self,
        name: &str,
        value: &str,
        at: Point,
        draw: impl FnOnce(&mut Sheet),
    ) {
        let mut tag = self.xml.begin_tag("g").set_text(name, value);
        if at != [0.0; 2] {
            let by = format!(
                "translate({} {})",
                format_number(at[0]),
                format_number(at[1])
            );
            tag = tag.set_text("transform", &by);
        }
        tag.keep_open();
        let outer = self.origin;
        self.origin = add(outer, at);
        draw(self);
        self.origin = outer;
        self.xml.end_element();
    }

    /// Writes the tooltip of the open group.
    pub(crate) fn write_tip(&mut self, text: &str) {
        self.xml.begin_tag("title").write_text(text);
    }

    /// Writes further style rules.
    pub(crate) fn write_style(&mut self, rules: &str) {
        self.xml.begin_tag("style").write_text(rules);
    }

    /// Writes finished pieces for use by reference, with the ids m0, m1 and so on.
    pub(crate) fn write_defs(&mut self, pieces: &[String]) {
        self.xml.begin_tag("defs").keep_open();
        for (n, piece) in pieces.iter().enumerate() {
            // what is used elsewhere has no ancestors there but this group
            let group = self.xml.begin_tag("g").set_text("id", &format!("m{n}"));
            group.set_text("class", "ozd").keep_open();
            self.xml.write_piece(piece);
            self.xml.end_element();
        }
        self.xml.end_element();
    }

    /// Shows a piece by its id, as the symbol of a joint.
    pub(crate) fn joint_use(&mut self, joint: &str, id: &str, at: Point) {
        self.xml
            .begin_tag("use")
            .set_text("href", &format!("#{id}"))
            .set_number("x", at[0])
            .set_number("y", at[1])
            .set_text("data-joint", joint)
            .close_empty();
    }

    /// Draws one of several pictures at the same place, of which one is visible.
    pub(crate) fn draw_frame(&mut self, number: usize, seen: bool, draw: impl FnOnce(&mut Sheet)) {
        let n = number.to_string();
        let mut tag = self
            .xml
            .begin_tag("g")
            .set_text("class", &format!("f{n}"))
            .set_text("data-frame", &n);
        if !seen {
            tag = tag.set_text("visibility", "hidden");
        }
        tag.keep_open();
        draw(self);
        self.xml.end_element();
    }

    /// Writes text whose middle line is at `at`.
    pub(crate) fn write_text(
        &mut self,
        class: &str,
        size: f64,
        at: Point,
        anchor: Anchor,
        text: &str,
    ) {
        let wide = text_width(text, size);
        let left = match anchor {
            Anchor::Start => at[0],
            Anchor::Middle => at[0] - wide / 2.0,
        };
        if text.trim().is_empty() {
            return;
        }
        self.labels.push(Label {
            text: text.to_owned(),
            rect: Rect::around([left + wide / 2.0, at[1]], wide, size).moved_by(self.origin),
        });
        let mut tag = self
            .xml
            .begin_tag("text")
            .set_text("class", class)
            .set_number("x", at[0])
            .set_number("y", at[1] + 0.36 * size)
            .set_number("font-size", size);
        if anchor == Anchor::Middle {
            tag = tag.set_text("text-anchor", "middle");
        }
        tag.write_text(text);
    }

    /// Draws a path.
    pub(crate) fn draw_path(&mut self, class: &str, d: &str) {
        self.xml
            .begin_tag("path")
            .set_text("class", class)
            .set_text("d", d)
            .close_empty();
    }

    /// Draws a path that shows a tooltip.
    pub(crate) fn path_with_tip(&mut self, class: &str, d: &str, tip: &str) {
        self.xml
            .begin_tag("path")
            .set_text("class", class)
            .set_text("d", d)
            .close_with_tip(tip);
    }

    /// Draws a segment.
    pub(crate) fn draw_line(&mut self, class: &str, a: Point, b: Point) {
        self.draw_path(class, &path_data(&[a, b], false));
    }

    /// Draws a circle.
    pub(crate) fn draw_circle(&mut self, class: &str, at: Point, radius: f64) {
        self.xml
            .begin_tag("circle")
            .set_text("class", class)
            .set_number("cx", at[0])
            .set_number("cy", at[1])
            .set_number("r", radius)
            .close_empty();
    }

    /// Draws a rectangle with round corners.
    pub(crate) fn draw_rect(&mut self, class: &str, rect: &Rect, round: f64) {
        self.xml
            .begin_tag("rect")
            .set_text("class", class)
            .set_number("x", rect.left)
            .set_number("y", rect.top)
            .set_number("width", rect.right - rect.left)
            .set_number("height", rect.bottom - rect.top)
            .set_number("rx", round)
            .close_empty();
    }

    /// Draws finished shapes.
    pub(crate) fn draw_shapes(&mut self, shapes: &[Shape]) {
        for shape in shapes {
            match shape {
                Shape::Path {
                    class,
                    points,
                    closed,
                } => self.draw_path(class, &path_data(points, *closed)),
                Shape::Circle { at, radius, class } => self.draw_circle(class, *at, *radius),
            }
        }
    }

    /// Records that a symbol covers a rectangle.
    pub(crate) fn note_symbol(&mut self, rect: Rect) {
        self.symbols.push(rect.moved_by(self.origin));
    }

    /// Draws the sample in front of a row of the legend.
    fn draw_swatch(&mut self, swatch: &Swatch, at: Point) {
        let (name, value) = match swatch {
            Swatch::Tint(_, label) => ("data-contour-key", label.as_str()),
            _ => ("data-key", ""),
        };
        self.draw_group(name, value, at, |s| match swatch {
            Swatch::Tint(redundant, label) => {
                let class = format!("s s{}", redundant.min(&6));
                s.draw_rect(&class, &Rect::around([0.0; 2], 30.0, 16.0), 3.0);
                s.write_text("small", SMALL, [0.0; 2], Anchor::Middle, label);
            }
            Swatch::Symbol(draw) => draw(s),
            Swatch::Joint(class, label) => {
                s.draw_circle(class, [0.0; 2], 9.5);
                s.write_text("class", 9.0, [0.0; 2], Anchor::Middle, label);
            }
            Swatch::Shapes(shapes) => s.draw_shapes(shapes),
        });
    }
}

/// Which part of a text is at its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
}
