//! A picture of a joint type: its symbol large, seen obliquely and along its axis, with the freedoms at the axes of its
//! frame.

use crate::draw::place::projection::{self, View};
use crate::draw::sheet::{Anchor, Caption, Drawing, Sheet, plan_sheet};
use crate::draw::symbol::pieces::PaperPose;
use crate::draw::symbol::symbols;
use crate::geom::vector::{X, Y, Z};
use crate::model::joint_type::{Freedom, JointType};
use crate::svg::plane::{Point, Rect, add, plane_norm, scale};
use itertools::Itertools;

/// How many times the size in a scheme.
const LARGE: f64 = 5.5;
/// The length of an axis that lies in the paper.
const AXIS: f64 = 120.0;
/// The room of one view.
const ROOM: Point = [360.0, 310.0];

/// Draws a joint type in two views.
///
/// # Examples
/// ```
/// use ozols::model::joint_type::JointType;
/// assert!(ozols::draw::joint_type(&JointType::Spherical).svg.contains("class III, freedoms: rx, ry, rz"));
/// ```
#[must_use]
pub fn joint_type(of: &JointType) -> Drawing {
    let freedoms = of.freedoms().iter().map(|f| f.name()).join(", ");
    let freedoms = if freedoms.is_empty() {
        "none".to_owned()
    } else {
        freedoms
    };
    let line = format!("class {}, freedoms: {freedoms}", of.class_numeral());
    let caption = Caption {
        title: of.name(),
        subtitle: [&line, "left at an angle, right along the axis z"],
        description: &format!(
            "The joint type {}, {line}, in two views with the axes of its frame.",
            of.name()
        ),
        legend: Vec::new(),
    };
    let area = Rect::new(0.0, 0.0, 2.0 * ROOM[0], ROOM[1]);
    let plan = plan_sheet(&caption, area, 0.0);
    let mut sheet = Sheet::new(&caption, &plan);
    for (n, view) in [projection::isometric_view(), projection::along_z()]
        .iter()
        .enumerate()
    {
        let middle = [ROOM[0] * (n as f64 + 0.5), ROOM[1] / 2.0];
        let at = add(middle, plan.shift);
        sheet.draw_group("data-drawing", "", at, |s| draw_view(s, of, view));
    }
    sheet.finish_sheet(&caption, &plan)
}

fn draw_view(sheet: &mut Sheet, of: &JointType, view: &View) {
    let axes = [X, Y, Z];
    let shapes = symbols::symbol_shapes(of, &PaperPose::of_axes(axes, view), "", LARGE);
    for (n, axis) in axes.into_iter().enumerate() {
        let tip = scale(view.flat_vector(axis), AXIS);
        if plane_norm(tip) > 4.0 {
            sheet.draw_arrow("fine", scale(tip, -0.55), tip, 8.0);
        }
        let name = ["x", "y", "z"][n];
        let own = of.freedoms().iter().filter(|f| axis_of(**f) == n);
        let own = own.map(|f| f.name()).join(" ");
        let label = if own.is_empty() {
            name.to_owned()
        } else {
            format!("{name}: {own}")
        };
        let (x, y) = (tip[0], tip[1]);
        let place = if plane_norm(tip) > 4.0 {
            let out = scale(tip, (AXIS + 4.0) / AXIS);
            [
                out[0] + 26.0 * x.signum() * f64::from(x.abs() > 1.0),
                out[1] + 12.0 * y.signum() * f64::from(y.abs() > 1.0),
            ]
        } else {
            [-0.62 * AXIS, 0.62 * AXIS]
        };
        sheet.write_text("small", 12.0, place, Anchor::Middle, &label);
    }
    sheet.draw_shapes(&shapes);
    sheet.note_symbol(symbols::shapes_extent(&shapes));
}

/// Returns the axis of the frame that a freedom is about or along.
fn axis_of(f: Freedom) -> usize {
    match f {
        Freedom::Rx | Freedom::Tx => 0,
        Freedom::Ry | Freedom::Ty => 1,
        Freedom::Rz | Freedom::Tz | Freedom::Screw => 2,
    }
}
