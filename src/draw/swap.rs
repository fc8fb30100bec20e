//! The symbols of joints that a redesign may put in place of the present ones, so that a page can show any redesign in
//! one drawing of the mechanism as it is.

use super::sheet::Sheet;
use super::{Drawing, Subject, kinematic, scheme};
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

/// The structural scheme, and for each swap the SVG elements that stand in the group of its joint (`data-joint`) instead
/// of those there, marked as changed.
#[must_use]
pub fn scheme_with(subject: &Subject<'_>, swaps: &[Swap<'_>]) -> (Drawing, Vec<String>) {
    scheme::with_swaps(subject, swaps)
}

/// The same of the kinematic scheme, whose labels leave room for every swap.
#[must_use]
pub fn kinematic_with(subject: &Subject<'_>, swaps: &[Swap<'_>]) -> (Drawing, Vec<String>) {
    kinematic::with_swaps(subject, swaps)
}

/// The mark of an unloading joint round a symbol of some reach.
pub(super) fn ring(sheet: &mut Sheet, reach: f64) {
    sheet.circle("line new", [0.0; 2], reach + 4.0);
}
