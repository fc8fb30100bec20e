//! Joint reactions of a gripping mechanism: the part is cut free, and the contact forces of its worst case act on the
//! jaws.

use crate::closure::drive::driven_freedoms;
use crate::grip::clamping::DiameterRow;
use crate::grip::drive_effort;
use crate::grip::jaw_loads::{Fit, Gripping, JawError};
use crate::model::grip::Transmission;
use crate::model::mechanism::Mechanism;
use crate::motion::pose::Pose;
use crate::statics::cycle::{PlanarStaticsError, statics_at};
use crate::statics::reactions::{Cycle, Reactions, Unsolved};
use crate::statics::solve::{SolvedReactions, is_for_space};
use crate::statics::transmission::drive_rates;
use thiserror::Error;

/// Reason why a clamped mechanism has no reactions.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ClampedError {
    /// The levers do not fit the part.
    #[error(transparent)]
    Jaw(#[from] JawError),
    /// The planar statics have no solution.
    #[error(transparent)]
    Planar(#[from] PlanarStaticsError),
    /// The spatial statics have no solution.
    #[error(transparent)]
    Spatial(#[from] Unsolved),
}

/// A mechanism around a part.
#[derive(Debug, Clone)]
pub struct Clamped {
    /// The mechanism with the part's forces among its loads.
    pub mechanism: Mechanism,
    /// Its pose.
    pub fit: Fit,
    /// Force `[N]`, or moment `[N·m]`, that the grip requires of one drive of both levers, and whether that drive
    /// slides.
    pub effort: Option<(f64, bool)>,
    /// The reactions.
    pub found: SolvedReactions,
}

/// Returns the effort that the grip requires of one drive of both levers in a pose, if the mechanism has one.
fn required_effort(g: &Gripping, row: &DiameterRow, pose: &Pose) -> Option<(f64, bool)> {
    let spec = g.mechanism.loads.grip.as_ref()?;
    let Transmission::Joints(joints) = spec.transmission else {
        return None;
    };
    let h = row.hardest.as_ref()?.held_forces()?;
    let t = drive_rates(&g.mechanism, pose, &joints).ok()?;
    Some((drive_effort(spec.load.as_ref()?.levers, h, &t)?, t.slides))
}

/// Returns the reactions around the part of a row, or `None` if it is not held. With one drive, planar statics are used
/// if they determine the mechanism, unless all six components are requested.
///
/// # Errors
/// Returns a [`ClampedError`].
pub fn clamped_reactions(
    g: &Gripping,
    row: &DiameterRow,
    spatial: bool,
) -> Result<Option<Clamped>, ClampedError> {
    let fit = g.fit_part(row)?;
    let Some(loads) = g.jaw_loads(row) else {
        return Ok(None);
    };
    let mut m = g.mechanism.clone();
    m.edit().loads = loads;
    let one_drive = m.joints.iter().filter(|j| j.drive).count() == 1;
    let planar = match (!spatial && one_drive).then(|| statics_at(&m, g.state, &[fit.drive])) {
        Some(Err(e)) if !is_for_space(&e) => return Err(e.into()),
        Some(Ok(found)) => Some(found),
        Some(Err(_)) | None => None,
    };
    let found = match planar {
        Some(found) => SolvedReactions::Planar(Box::new(found)),
        None => {
            let drives = driven_freedoms(&m, g.state);
            let found = Reactions::solve_at(&m, g.state, &m.loads, &fit.pose, fit.drive, &drives)?;
            SolvedReactions::Spatial(Cycle {
                drives,
                positions: vec![(fit.drive, Ok(found))],
                stopped: None,
            })
        }
    };
    Ok(Some(Clamped {
        effort: required_effort(g, row, &fit.pose),
        mechanism: m,
        fit,
        found,
    }))
}
