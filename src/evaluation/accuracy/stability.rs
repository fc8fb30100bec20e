//! Where numbers fail: closeness to special geometry, tolerance, digits, size, unit, shakiness, prime, model and costs moved until answers
//! turn wrong.

mod closeness;
mod limits;
mod scenes;

use super::cases::Case;
use super::study::{Effort, Progress, Study};

/// Every study in turn.
pub fn all(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Vec<Study> {
    let step = if effort.quick { 4 } else { 1 };
    let some: Vec<Case> = cases.iter().step_by(step).cloned().collect();
    vec![
        closeness::distance(cases, effort, progress),
        closeness::tolerance(cases, effort, progress),
        closeness::digits(effort, progress),
        closeness::rounded(&some, effort, progress),
        limits::size(effort, progress),
        limits::scale(&some, effort, progress),
        limits::prime(&some, effort, progress),
        limits::shaky(effort, progress),
        scenes::model(cases, effort, progress),
        scenes::first_idea(cases, effort, progress),
    ]
}
