//! Where numbers fail: digits, closeness to special geometry, size, unit, shakiness, dead points, prime, model and costs moved until answers
//! turn wrong.

mod closeness;
mod forces;
mod limits;
mod scenes;

use super::cases::Case;
use super::study::{Effort, Progress, Study};

/// Runs every study in turn.
pub fn run_studies(cases: &[Case], effort: Effort, progress: Progress<'_>) -> Vec<Study> {
    let step = if effort.quick { 4 } else { 1 };
    let some: Vec<Case> = cases.iter().step_by(step).cloned().collect();
    vec![
        closeness::study_rounded(&some, effort, progress),
        closeness::study_digits(effort, progress),
        closeness::study_distance(effort, progress),
        limits::study_size(effort, progress),
        limits::study_scale(&some, effort, progress),
        limits::study_prime(&some, effort, progress),
        limits::study_shaky(effort, progress),
        forces::study_dead_points(effort, progress),
        scenes::study_least_model(cases, effort, progress),
        scenes::study_first_idea(cases, effort, progress),
    ]
}
