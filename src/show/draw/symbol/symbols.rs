//! The symbols of joints, in the joints' own frames.

use crate::closure::drive::driven_freedoms;
use crate::draw::prelude::*;
use crate::draw::symbol::pieces::{PaperPose, Piece};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The pieces of each joint type's symbol, from back to front, and of the arrow of a driven slide by its axis.
///
/// # Panics
/// Never: a test draws all of them.
static SYMBOLS: LazyLock<BTreeMap<String, Vec<Piece>>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("symbols.json")).expect("a test draws all of them")
});

/// Returns the distance from the axis of a joint to the side of the part that slides along it. `None` for joints without
/// such a slide.
pub(crate) fn side_of_slide(joint: &JointType) -> Option<f64> {
    match joint {
        JointType::Prismatic => Some(5.0),
        JointType::Cylindrical | JointType::Helical => Some(5.5),
        JointType::CylindricalUniversal => Some(6.5),
        JointType::SphereInCylinder => Some(8.5),
        _ => None,
    }
}

/// Returns the symbol of a joint at the origin, scaled by `size`; `mark` is added to the classes.
pub(crate) fn symbol_shapes(
    joint: &JointType,
    pose: &PaperPose,
    mark: &str,
    size: f64,
) -> Vec<Shape> {
    let seen = |p: &Piece| p.sized_piece(mark, size).shape_seen(pose);
    symbol_pieces(joint).iter().filter_map(seen).collect()
}

/// Returns the pieces of a joint's symbol, from the back to the front.
pub(crate) fn symbol_pieces(joint: &JointType) -> &'static [Piece] {
    &SYMBOLS[joint.name()]
}

/// Returns the symbol of a type of joint as a scene has it.
///
/// # Examples
/// ```
/// use ozols::{draw::joint_symbol, model::joint_type::JointType};
/// assert!(joint_symbol(&JointType::Revolute)[0]["points"].is_array());
/// ```
#[must_use]
pub fn joint_symbol(joint: &JointType) -> serde_json::Value {
    let pieces = symbol_pieces(joint).iter().map(|p| p.sized_piece("", 1.0));
    serde_json::json!(pieces.collect::<Vec<_>>())
}

/// Returns the straight arrow of a joint that slides along one of its axes, outside the hatching of a rail.
pub(crate) fn slide_arrow(axis: usize) -> &'static [Piece] {
    &SYMBOLS[["drive x", "drive y", "drive z"][axis]]
}

/// Returns the bounding rectangle of some shapes.
pub(crate) fn shapes_extent(shapes: &[Shape]) -> Rect {
    let own = shapes.iter().map(|s| match s {
        Shape::Path { points, .. } => bounds_of(points).grown_by(0.7),
        Shape::Circle { at, radius, .. } => {
            Rect::around(*at, 2.0 * radius + 1.4, 2.0 * radius + 1.4)
        }
    });
    own.fold(Rect::around([0.0; 2], 2.0, 2.0), |all, r| all.with(&r))
}

/// Returns the joints whose drive slides them without turning, each with the axis of its frame.
pub(crate) fn driven_slides(m: &Mechanism, state: StateId) -> Vec<(JointId, usize)> {
    let driven = driven_freedoms(m, state).into_iter();
    driven
        .filter(|(_, f)| f.is_slide())
        .map(|(j, f)| (j, f.axis()))
        .collect()
}

/// Returns the arrow around a driving pair that turns. It is not a full circle, because that means a second joint.
pub(crate) fn round_arrow(mark: &str, radius: f64) -> Vec<Shape> {
    const FROM: f64 = 0.25 * PI;
    const TO: f64 = 1.85 * PI;
    let on = |angle: f64, r: f64| [r * angle.cos(), r * angle.sin()];
    let arc = (0..=28).map(|i| on(FROM + (TO - FROM) * f64::from(i) / 28.0, radius));
    let back = TO - 6.0 / radius;
    let head = vec![
        on(TO + 1.5 / radius, radius),
        on(back, radius + 2.6),
        on(back, radius - 2.6),
    ];
    vec![
        Shape::line(format!("line{mark}"), arc.collect()),
        Shape::path(format!("ink{mark}"), head, true),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::place::projection;
    use crate::geom::vector::{X, Y, Z, unit};

    #[test]
    fn each_type_of_joint_has_a_symbol_of_its_own_from_every_side() {
        let types = JointType::NAMED;
        let along_z = projection::along_z();
        for pose in [
            PaperPose::of_axes([X, Y, Z], &along_z),
            PaperPose::of_axes([Y, Z, X], &along_z),
            PaperPose::of_axes([Z, X, Y], &along_z),
            PaperPose::of_axes(
                [
                    unit([1.0, -1.0, 0.0]),
                    unit([1.0, 1.0, -2.0]),
                    unit([1.0; 3]),
                ],
                &along_z,
            ),
        ] {
            let drawn = types.each_ref().map(|t| {
                let mut shapes = symbol_shapes(t, &pose, "", 1.0);
                // what is a point on paper is not seen
                shapes.retain(|s| {
                    let r = shapes_extent(std::slice::from_ref(s));
                    (r.right - r.left).max(r.bottom - r.top) > 2.5
                });
                format!("{shapes:?}")
            });
            for (i, one) in drawn.iter().enumerate() {
                assert!(!drawn[..i].contains(one), "{} as another", types[i]);
            }
        }
    }
}
