//! The directions of the coordinates and the scale, below the drawing.

use super::Kinematic;
use crate::draw::place::projection;
use crate::draw::sheet::{Anchor, PAD, Sheet};
use crate::svg::labels::{self, Wish};
use crate::svg::plane::{Rect, add, plane_norm, scale};

impl Kinematic<'_> {
    /// Draws the directions of the coordinates.
    pub(super) fn draw_axes(&self, sheet: &mut Sheet, y: f64) {
        let origin = [PAD + 44.0, y + 8.0];
        let mut taken = vec![Rect::around(origin, 9.0, 9.0)];
        let mut wishes = Vec::new();
        for axis in 0..3 {
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            let tip = scale(self.projection.view.flat_vector(unit), 30.0);
            let length = plane_norm(tip);
            if length < 4.0 {
                sheet.draw_circle("joint", origin, 4.5);
                if projection::dot(unit, self.projection.view.toward) > 0.0 {
                    sheet.draw_circle("ink", origin, 1.6);
                } else {
                    let d = 3.0;
                    sheet.draw_line("line", add(origin, [-d, -d]), add(origin, [d, d]));
                    sheet.draw_line("line", add(origin, [-d, d]), add(origin, [d, -d]));
                }
            } else {
                sheet.draw_arrow("line", origin, add(origin, tip), 6.5);
                taken.push(Rect::around(
                    add(origin, scale(tip, 0.5)),
                    tip[0].abs() + 3.0,
                    tip[1].abs() + 3.0,
                ));
            }
            let clear = if length < 4.0 { 5.0 } else { 1.0 };
            wishes.push(Wish {
                height: 12.0,
                ..Wish::for_text("x", 12.0, add(origin, tip), clear)
            });
        }
        for (place, name) in labels::place_labels(&wishes, &mut taken, &[])
            .iter()
            .zip(["x", "y", "z"])
        {
            sheet.write_text("axis", 12.0, place.rect.middle(), Anchor::Middle, name);
        }
    }

    /// Draws a scale bar with a round length.
    pub(super) fn draw_scale(&self, sheet: &mut Sheet, y: f64) {
        let longest = 150.0 / self.projection.scale;
        let (Some(length), unit) = (
            round_below(longest),
            self.subject.mechanism.length_unit.symbol,
        ) else {
            return;
        };
        if self.spots.len() < 2 {
            return;
        }
        let x = PAD + 130.0;
        let end = x + length * self.projection.scale;
        for [a, b] in [
            [[x, y], [end, y]],
            [[x, y - 4.0], [x, y + 4.0]],
            [[end, y - 4.0], [end, y + 4.0]],
        ] {
            sheet.draw_line("line", a, b);
        }
        let text = format!("{length} {unit}");
        sheet.write_text("legend", 12.0, [x, y + 16.0], Anchor::Start, &text);
    }
}

/// Returns the largest of 1, 2 and 5 times a power of ten that is not above `x`.
fn round_below(x: f64) -> Option<f64> {
    if !(x.is_finite() && x > 1e-200) {
        return None;
    }
    let power = 10f64.powi(x.log10().floor() as i32);
    let step = [5.0, 2.0, 1.0].into_iter().find(|s| s * power <= x)?;
    // through text, so that 0.2 is 0.2
    let text = format!("{:e}", step * power);
    let (mantissa, exponent) = text.split_once('e')?;
    let mantissa: f64 = mantissa.parse().ok()?;
    format!("{}e{exponent}", mantissa.round()).parse().ok()
}
