//! Regions of an axis, row by row.

use super::axis::{AxisFit, Room, Ruler};
use super::data::{Bands, Scale, VerdictKind};
use super::frame::{self, Head};
use crate::chart::data::{PAD, TICK, WIDTH};
use crate::format::six_digits;
use crate::svg::plane::Rect;
use crate::svg::text;
use crate::svg::xml::Xml;

/// The height of a row.
const ROW: f64 = 28.0;
/// The kinds in the order of the legend, with their meanings.
const MEANINGS: [(VerdictKind, &str); 4] = [
    (VerdictKind::Good, "right"),
    (VerdictKind::Warn, "in doubt"),
    (VerdictKind::Bad, "wrong"),
    (VerdictKind::None, "no verdict"),
];

impl Bands {
    /// Returns the bands as a self-contained SVG element, for a separate file or inside HTML.
    ///
    /// A band may end at infinity, or on a log axis at zero. It then reaches the edge. Bands differ in height as well
    /// as in colour: right ones are the highest, wrong ones low.
    pub fn svg(&self) -> String {
        let names = self.rows.iter().map(|r| text::text_width(r.0.trim(), TICK));
        let left = (PAD + names.fold(0.0, f64::max).min(250.0) + 12.0).max(48.0);
        let right = WIDTH - 36.0;
        let head = Head::new(&self.title, &self.subtitle, WIDTH);
        let top = head.head_height() + 34.0;
        let bottom = top + ROW * self.rows.len().max(1) as f64;
        let bands = || self.rows.iter().flat_map(|r| &r.1);
        let ends = bands().flat_map(|b| [b.0, b.1]);
        let room = Room::Across(right - left, left - 4.0, WIDTH - right - 4.0);
        let ruler = Ruler::new(self.x.scale, ends, AxisFit::Tight, room);

        let about = self.about_text();
        let size = (WIDTH, bottom + 52.0);
        let mut xml = frame::begin_picture(size, "oz oz-bands", &self.title, &about, &head);
        let mut x = left;
        for (kind, meaning) in MEANINGS {
            if bands().any(|b| b.2 == kind) {
                draw_bar(&mut xml, kind, x, x + 22.0, top - 20.0, "");
                frame::begin_text(&mut xml, "soft", (x + 28.0, top - 16.0), "").write_text(meaning);
                x += 28.0 + text::text_width(meaning, TICK) + 18.0;
            }
        }
        let plot = Rect::new(left, top, right, bottom);
        frame::draw_across(&mut xml, &ruler, &self.x.label, &plot);
        for (n, (name, bands)) in self.rows.iter().enumerate() {
            let y = top + ROW * n as f64;
            frame::draw_stroke(&mut xml, "grid", (PAD, y), (right, y));
            let at = (left - 10.0, y + ROW / 2.0 + 4.0);
            frame::begin_text(&mut xml, "name", at, "end")
                .text_and_tip(&text::cut_text(name, TICK, 250.0), name.trim());
            for &(from, to, kind) in bands {
                let Some((a, b)) = self.band_ends(&ruler, from, to) else {
                    continue;
                };
                let place = |at: f64| left + at * (right - left);
                let meaning = MEANINGS.iter().find(|m| m.0 == kind).map_or("", |m| m.1);
                let tip = format!(
                    "{name}: {meaning} from {} to {}",
                    six_digits(from),
                    six_digits(to)
                );
                draw_bar(&mut xml, kind, place(a), place(b), y + ROW / 2.0, &tip);
            }
        }
        frame::draw_stroke(&mut xml, "axis", (left, bottom), (right, bottom));
        xml.finish_document()
    }

    /// Returns the start and end of a band, or `None` if it does not lie on the axis.
    fn band_ends(&self, ruler: &Ruler, from: f64, to: f64) -> Option<(f64, f64)> {
        if from.is_nan() || to.is_nan() {
            return None;
        }
        let (low, high) = (from.min(to), from.max(to));
        if self.x.scale == Scale::Log && high <= 0.0 {
            return None;
        }
        Some((
            ruler.place_value(low).unwrap_or(0.0),
            ruler.place_value(high).unwrap_or(1.0),
        ))
    }

    /// Returns the text for screen readers.
    fn about_text(&self) -> String {
        let rows = self.rows.iter().map(|(name, bands)| {
            let right = bands.iter().filter(|b| b.2 == VerdictKind::Good);
            let right = right.map(|b| format!("{} to {}", six_digits(b.0), six_digits(b.1)));
            match right.collect::<Vec<_>>().join(", ").as_str() {
                "" => format!("{name}: nowhere right"),
                regions => format!("{name}: right from {regions}"),
            }
        });
        let rows = rows.collect::<Vec<_>>().join("; ");
        let text = format!("{} Over {}. {rows}.", self.subtitle, self.x.label);
        text.trim_start().to_owned()
    }
}

/// Draws a band centred on the height `y`; the kind determines its colour and its height.
fn draw_bar(xml: &mut Xml, kind: VerdictKind, from: f64, to: f64, y: f64, tip: &str) {
    let height = match kind {
        VerdictKind::Good => 16.0,
        VerdictKind::Warn => 10.0,
        VerdictKind::Bad => 5.0,
        VerdictKind::None => 2.0,
    };
    let (from, to) = if to - from < 2.0 {
        (from - 1.0, to + 1.0)
    } else {
        (from, to)
    };
    let rect = xml
        .begin_tag("rect")
        .set_text("class", &format!("bar {}", kind.colour_class()));
    let rect = rect.set_number("x", from).set_number("y", y - height / 2.0);
    rect.set_number("width", to - from)
        .set_number("height", height)
        .close_with_tip(tip);
}
