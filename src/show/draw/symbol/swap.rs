//! The symbols of joints that a redesign may put in place of the present ones, so that a page can show any redesign in
//! one drawing of the mechanism as it is.

use crate::draw::sheet::Shape;
use crate::model::mechanism::{JointId, JointOption};

/// A joint in place of another.
#[derive(Debug, Clone, Copy)]
pub struct Swap<'a> {
    /// The place.
    pub joint: JointId,
    /// What is put there.
    pub option: &'a JointOption,
    /// Whether an unloading joint is put in series with it: a ring stands for that.
    pub unloading: bool,
}

/// The mark of an unloading joint round a symbol of some reach.
pub(in crate::draw) fn ring(reach: f64) -> Shape {
    Shape::Circle {
        at: [0.0; 2],
        radius: reach + 4.0,
        class: "line new".to_owned(),
    }
}
