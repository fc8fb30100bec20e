//! Holding capacity of a two-lever gripper: its arms, contacts and drive moments, and the loads of a grip on its
//! mechanism.
//!
//! [`analyse_grip`] studies a gripper over its diameters with its drive: its holding capacity, and the required effort of the
//! one drive of both levers. [`clamped::clamped_reactions`] solves for the joints of a mechanism around a part.

pub mod arm_curves;
pub mod clamped;
pub mod clamping;
pub mod contact;
pub mod holding;
pub mod jaw_loads;
pub mod lever_arm;
pub mod motion;

use crate::geom::exact::ExactError;
use crate::grip::clamping::{DiameterRow, Study, study_diameters};
use crate::grip::holding::Holding;
use crate::grip::jaw_loads::{Gripping, JawError};
use crate::grip::lever_arm::LeverError;
use crate::model::grip::{GripSpec, LeverDrive, Transmission};
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::transmission::{Rates, TransmissionError, drive_rates};
use thiserror::Error;

/// Reason why a gripper cannot be studied.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum GripError {
    /// The lever is invalid.
    #[error(transparent)]
    Lever(#[from] LeverError),
    /// The mechanism around the part is invalid.
    #[error(transparent)]
    Jaw(#[from] JawError),
    /// The transmission from the drive to the levers is invalid.
    #[error(transparent)]
    Transmission(#[from] TransmissionError),
    /// The geometry of the mechanism has no value.
    #[error(transparent)]
    Exact(#[from] ExactError),
}

/// A gripper over its diameters.
#[derive(Debug, Clone)]
pub struct Grip {
    /// Its holding capacity.
    pub study: Study,
    /// Effect of the drive on the levers, by row of the study. Empty if unknown.
    pub transmission: Vec<Rates>,
}

/// Returns the force `[N]`, or the moment `[N·m]` of a rotary drive, required from one drive of both levers. Returns
/// `None` if each lever has its own drive.
#[must_use]
pub fn drive_effort(levers: LeverDrive, h: &Holding, drive: &Rates) -> Option<f64> {
    let each = h.moments.iter().zip(&drive.rates);
    let sum: f64 = each.map(|(moment, rate)| moment * rate).sum();
    (levers != LeverDrive::Independent).then_some(sum.max(0.0))
}

/// Analyses a gripper, with the mechanism it is part of if there is one.
///
/// # Units
/// SI, radians.
///
/// # Guarantee
/// As [`study_diameters`].
///
/// # Errors
/// Returns an error if figures are out of range, or if a mechanism does not agree with them.
///
/// # Examples
/// ```
/// let text = ozols::builtin::text("lever-gripper").expect("it is built in");
/// let file = ozols::file::read::workload::grip_from_bytes("lever-gripper.toml", text.as_bytes())?;
/// let found = ozols::grip::analyse_grip(&file.spec, file.mechanism.as_ref())?;
/// assert!(found.study.holds_all());
/// let hardest = found.study.hardest_row().expect("a load is stated");
/// assert!((hardest.diameter - 0.050).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn analyse_grip(spec: &GripSpec, mechanism: Option<&Mechanism>) -> Result<Grip, GripError> {
    let study = study_diameters(spec)?;
    let transmission = match (spec.transmission, mechanism) {
        (Transmission::Arm(arm), _) => {
            let rates = Rates {
                slides: true,
                rates: vec![1.0 / arm; 2],
            };
            vec![rates; study.rows.len()]
        }
        (Transmission::Joints(joints), Some(m)) => {
            let at_home = drive_rates(m, &Pose::of_file(m, StateId::FREE)?, &joints)?;
            let states = spec.contacts.and_then(|c| m.joints[c[0]].states.as_ref());
            let state = states.and_then(|s| s.first());
            let gripping = match state.map(|&s| Gripping::of_study(m, s, study.clone())) {
                // Without contacts, the direction in which the levers turn is unknown.
                None | Some(Ok(None) | Err(JawError::Nominal(_))) => None,
                Some(other) => other?,
            };
            let there = |row: &DiameterRow| match &gripping {
                Some(g) if row.is_held() => Ok(drive_rates(m, &g.fit_part(row)?.pose, &joints)?),
                _ => Ok(at_home.clone()),
            };
            study
                .rows
                .iter()
                .map(there)
                .collect::<Result<_, GripError>>()?
        }
        (Transmission::Joints(_), None) | (Transmission::Unknown, _) => Vec::new(),
    };
    Ok(Grip {
        study,
        transmission,
    })
}
