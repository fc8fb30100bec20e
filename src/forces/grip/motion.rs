//! The clamping force along a motion: the smallest that holds, for each pose and acceleration of a programme.
//!
//! [`study_diameters`](crate::grip::clamping::study_diameters) only considers the worst case. A gripper that always closes with that force
//! marks soft parts. One whose force follows the motion closes harder only when necessary.

use crate::grip::clamping::DiameterRow;
use crate::grip::holding::{Holding, HoldingError, HoldingOutcome, PartWrench, find_holding};
use crate::grip::{Grip, drive_effort};
use crate::model::grip::{GripSpec, MotionStep, Toward};
use thiserror::Error;

/// Reason why a motion cannot be followed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionError {
    /// There is no load to hold.
    #[error("no load is given; give [workload.grip] a mass and friction before a motion")]
    NoLoad,
    /// The orientation is undetermined.
    #[error(
        "step {0} of the motion needs gravity in the gripper's axes, columns gx, gy and gz, because the file gives gravity in any direction"
    )]
    Gravity(usize),
    /// The part is not one of the diameters studied.
    #[error("step {0} of the motion has a part of {1} m, which is not one of the given diameters")]
    Diameter(usize, f64),
}

/// A step of a motion and its required effort.
#[derive(Debug, Clone, PartialEq)]
pub struct StepTaken {
    /// The step.
    pub of: MotionStep,
    /// Diameter of the part. `[m]`
    pub diameter: f64,
    /// Gravity less acceleration. `[m/s²]`
    pub pull: [f64; 3],
    /// The result of the statics, or `None` if this part cannot be held by any forces.
    pub verdict: Option<Result<HoldingOutcome, HoldingError>>,
    /// Effort of one drive of both levers, `[N]` or `[N·m]`, and whether it slides.
    pub effort: Option<(f64, bool)>,
}

impl StepTaken {
    /// Returns the forces that hold the part, if it is held.
    #[must_use]
    pub fn held_forces(&self) -> Option<&Holding> {
        self.verdict.as_ref()?.as_ref().ok()?.held_forces()
    }
}

/// Returns the smallest clamping at every step of a motion. `grip` is the study of the same specification, and includes
/// every diameter of the motion.
///
/// # Units
/// SI.
///
/// # Guarantee
/// Each step has the guarantee of [`find_holding`]. Times between two steps are not examined.
///
/// # Errors
/// Returns a [`MotionError`].
pub fn clamp_along(
    spec: &GripSpec,
    grip: &Grip,
    steps: &[MotionStep],
) -> Result<Vec<StepTaken>, MotionError> {
    let load = spec.load.as_ref().ok_or(MotionError::NoLoad)?;
    let one = |(i, step): (usize, &MotionStep)| {
        let gravity = match (step.gravity, load.gravity) {
            (Some(g), _) | (None, Toward::Fixed(g)) => g,
            (None, Toward::Any(_)) => return Err(MotionError::Gravity(i + 1)),
        };
        let diameter = step.diameter.unwrap_or(spec.diameter);
        let here = |r: &DiameterRow| (r.diameter - diameter).abs() <= 1e-9 * diameter;
        let rows = &grip.study.rows;
        let at = rows
            .iter()
            .position(here)
            .ok_or(MotionError::Diameter(i + 1, diameter))?;
        let row = &rows[at];
        let pull = [0, 1, 2].map(|k| gravity[k] - step.acceleration[k]);
        let pose = row.pose.as_ref().filter(|_| row.obstacles.is_empty());
        let wrench = PartWrench::of_mass(row.mass, pull, [0.0; 3], load.centre_of_mass)
            .scaled_by(load.safety);
        let verdict = pose.map(|p| find_holding(p, &wrench, load.friction, load.levers));
        let effort = match (&verdict, grip.transmission.get(at)) {
            (Some(Ok(HoldingOutcome::Held(h))), Some(rates)) => {
                drive_effort(load.levers, h, rates).map(|e| (e, rates.slides))
            }
            _ => None,
        };
        Ok(StepTaken {
            of: *step,
            diameter,
            pull,
            verdict,
            effort,
        })
    };
    steps.iter().enumerate().map(one).collect()
}
