//! The texts of a kinematic scheme: its legend and its description.

use crate::draw::kinematic::body::{WireForm, arrow_head};
use crate::draw::kinematic::{Kinematic, Spot};
use crate::draw::place::projection;
use crate::draw::prelude::*;
use crate::draw::sheet::PAD;
use crate::draw::symbol::ground::Ground;
use crate::svg::labels::{self, Wish};

impl Kinematic<'_> {
    pub(super) fn legend_rows(&self) -> Vec<(Swatch, String)> {
        let m = self.subject.mechanism;
        let mut out = self.joint_type_rows();
        if self.spots.iter().any(|s| s.symbol.ring.is_some()) {
            let arrow = Swatch::Shapes(crate::draw::symbol::symbols::round_arrow("", 9.5));
            out.push((arrow, "driving pair".to_owned()));
        }
        if self.spots.iter().any(|s| s.symbol.slide.is_some()) {
            let arrow = vec![
                Shape::line("line", vec![[-11.0, 0.0], [5.0, 0.0]]),
                Shape::path("ink", vec![[11.0, 0.0], [4.0, 3.0], [4.0, -3.0]], true),
            ];
            out.push((Swatch::Shapes(arrow), "driven slide".to_owned()));
        }
        if !self.grounds.is_empty() {
            let ground = Ground::under_pivot([0.0, -7.0], [0.0, -1.0]);
            out.push((Swatch::Shapes(ground.ground_shapes()), m.frame_words()));
        }
        if self.spots.iter().any(|s| self.subject.only_here(s.joint)) {
            let ring = Shape::circle("fine dash", [0.0; 2], 9.5);
            let state = &m.states[self.subject.state];
            out.push((Swatch::Shapes(vec![ring]), format!("in state {state} only")));
        }
        if self.links.iter().any(|(l, _)| self.is_output(*l)) {
            out.push((Swatch::line("bone out"), "output link".to_owned()));
        }
        out.extend(self.point_rows());
        if self.wires.iter().any(|w| w.form == WireForm::Loop) {
            let circle = Shape::circle("fine pitch", [0.0; 2], 9.0);
            let text = "pitch circle of a gear".to_owned();
            out.push((Swatch::Shapes(vec![circle]), text));
        }
        if !self.coupling_lines().is_empty() {
            out.extend(self.subject.coupling_row());
        }
        out.extend(self.arrow_rows(&self.arrows));
        out.extend(self.subject.mark_rows());
        out.extend(self.departure_rows());
        out
    }

    /// Returns a row for each joint type, drawn as its first joint.
    fn joint_type_rows(&self) -> Vec<(Swatch, String)> {
        let m = self.subject.mechanism;
        let mut types: Vec<(&JointType, &Spot)> = Vec::new();
        for s in &self.spots {
            let t = &m.joints[s.joint].joint_type;
            if !types.iter().any(|(other, _)| *other == t) {
                types.push((t, s));
            }
        }
        let row = |(t, s): (&JointType, &Spot)| {
            let shapes = s.symbol.legend_shapes();
            (
                Swatch::Shapes(shapes),
                format!("{t}, class {}", t.class_numeral()),
            )
        };
        types.into_iter().map(row).collect()
    }

    /// Returns a row for each way in which the drawing departs from the coordinates.
    fn departure_rows(&self) -> impl Iterator<Item = (Swatch, String)> {
        let moved = self.places.iter().any(|p| p.moved);
        let moved = moved.then_some("joints that meet in a point stand farther along their axes");
        let bowed = self.wires.iter().any(|w| w.form == WireForm::Bow);
        let bowed = bowed.then_some("a straight bar bows where it would lie on another");
        let texts = moved.into_iter().chain(bowed);
        texts.map(|text| (Swatch::Shapes(Vec::new()), text.to_owned()))
    }

    /// Describes the drawing in words, for readers who cannot see it.
    pub(super) fn describe_drawing(&self) -> String {
        let joints = self.spots.iter().map(|s| s.joint);
        let out = self.subject.describe_joints(&self.view_title(), joints);
        out + &self.subject.coupling_words()
    }
}

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
                let (end, back) = (add(origin, tip), scale(tip, -1.0 / length));
                sheet.draw_line("line", origin, end);
                sheet.draw_shapes(&[arrow_head(end, back, 6.5, "ink")]);
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
    let exponent = x.log10().floor();
    // through text, so that 0.2 is 0.2
    let round = [5, 2, 1].map(|step| format!("{step}e{exponent}").parse().ok());
    round.into_iter().flatten().find(|round: &f64| *round <= x)
}
