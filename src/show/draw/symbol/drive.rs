//! The sign of a driving pair: which slides are driven, and the arrow round one that turns.

use crate::draw::sheet::Shape;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::rank::stroke::request::drive_or_any;
use std::f64::consts::PI;

/// Returns the joints whose drive slides them without turning, each with the axis of its frame.
pub(crate) fn driven_slides(m: &Mechanism, state: StateId) -> Vec<(JointId, usize)> {
    let driven = m.joints_in(state).filter(|&j| m.joints[j].drive);
    driven
        .filter_map(|j| Some((j, slide_axis_of(driven_freedom(m, state, j)?)?)))
        .collect()
}

/// Returns the axis of a slide.
fn slide_axis_of(freedom: Freedom) -> Option<usize> {
    match freedom {
        Freedom::Tx => Some(0),
        Freedom::Ty => Some(1),
        Freedom::Tz => Some(2),
        Freedom::Rx | Freedom::Ry | Freedom::Rz | Freedom::Screw => None,
    }
}

/// Returns the freedom that a drive moves. If the file leaves it open between a turn and a slide, returns the one that moves
/// the mechanism.
fn driven_freedom(m: &Mechanism, state: StateId, joint: JointId) -> Option<Freedom> {
    let of = &m.joints[joint];
    let open = of
        .joint_type
        .freedoms()
        .iter()
        .filter(|f| of.may_drive(**f));
    let open: Vec<Freedom> = open.copied().collect();
    let slides = open.iter().filter(|f| slide_axis_of(**f).is_some()).count();
    if slides == 0 || slides == open.len() {
        return open.first().copied();
    }
    let pose = Pose::of_file(m, state).ok()?;
    let (column, _) = drive_or_any(m, &pose, state, Some(&of.id)).ok()?;
    Some(pose.columns[column].freedom)
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
