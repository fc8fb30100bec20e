//! The clamping force along a motion: for each pose and acceleration of a programme the least that holds.
//!
//! [`study`](crate::grip::clamping::study) asks for the hardest case alone, and a gripper that always closes with that force
//! marks soft parts; one whose force follows the motion closes harder only where it must.

use crate::grip::clamping::{DiameterRow, HoldVerdict, verdict};
use crate::grip::holding::PartWrench;
use crate::grip::{Grip, effort};
use crate::model::grip::{GripSpec, MotionStep, Toward};
use thiserror::Error;

/// Why a motion cannot be followed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionError {
    /// Nothing to hold.
    #[error("no load is stated; give [workload.grip] a mass and friction before a motion")]
    NoLoad,
    /// The attitude is open.
    #[error(
        "step {0} of the motion needs gravity in the gripper's axes, columns gx, gy and gz, since the file has it in any direction"
    )]
    Gravity(usize),
    /// Not one of the diameters studied.
    #[error(
        "step {0} of the motion has a part of {1} m, which is not one of the diameters studied"
    )]
    Diameter(usize, f64),
}

/// A step of a motion and what it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct StepTaken {
    /// The step.
    pub of: MotionStep,
    /// The part. `[m]`
    pub diameter: f64,
    /// Gravity less acceleration. `[m/s²]`
    pub pull: [f64; 3],
    /// What comes of it; nothing where this part cannot be held whatever the forces.
    pub verdict: Option<HoldVerdict>,
    /// What one drive of both levers takes, `[N]` or `[N·m]`, and whether it slides.
    pub effort: Option<(f64, bool)>,
}

impl StepTaken {
    /// The least drive moment per lever, where it holds. `[N·m]`
    #[must_use]
    pub fn drive(&self) -> Option<f64> {
        match &self.verdict {
            Some(HoldVerdict::Held(h)) => Some(h.drive),
            Some(HoldVerdict::Slips(_) | HoldVerdict::Undecided(_)) | None => None,
        }
    }
}

/// The least clamping at every step of a motion. `grip` is the study of the same specification, with every diameter of the
/// motion among its own.
///
/// # Units
/// SI.
///
/// # Guarantee
/// Step by step that of [`hold`](crate::grip::holding::hold); nothing is said of what lies between two steps.
///
/// # Errors
/// [`MotionError`].
pub fn along(
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
        let wrench =
            PartWrench::of_mass(row.mass, pull, [0.0; 3], load.centre_of_mass).times(load.safety);
        let verdict = pose.map(|p| verdict(p, &wrench, load.friction, load.levers));
        let effort = match (&verdict, grip.transmission.get(at)) {
            (Some(HoldVerdict::Held(h)), Some(rates)) => {
                effort(load.levers, h, rates).map(|e| (e, rates.slides))
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
