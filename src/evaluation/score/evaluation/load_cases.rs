//! The poses and loads that variants are scored in.
//!
//! A variant moves as the mechanism does, so all are scored in the same cases. They are the poses of the free state's stroke
//! under the file's loads. In a state that the grip loads, they are the pose for each part it holds, under the contact
//! forces of that part's worst case. The score is the worst over the cases of the states that count.

use crate::closure::drive::Driven;
use crate::grip::jaw_loads::{Gripping, JawError, grip_of};
use crate::model::loads::Loads;
use crate::model::mechanism::{Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::cycle::{follow_stroke, follow_to};
use itertools::Itertools;
use thiserror::Error;

/// Why variants cannot be scored under the grip's loads.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The mechanism does not go there, or has no numbers.
    #[error(transparent)]
    Unsolved(#[from] Unsolved),
    /// Grip and mechanism do not fit together.
    #[error(transparent)]
    Jaws(#[from] JawError),
    /// No part is held.
    #[error(
        "[workload.grip] holds none of its parts, so no contact forces load state {0}; `ozols grip` says why; or name the \
         states that count: [ranking] states = [\"free\"]"
    )]
    NotHeld(String),
    /// Contacts and other joints both come with the state.
    #[error(
        "state {0} differs from the free one by more than the part's contacts, and variants are scored in the free state's \
         joints; name the states that count: [ranking] states = [\"free\"]"
    )]
    OtherJoints(String),
    /// Each lever has its own drive.
    #[error(
        "the grip's loads are ranked under one drive, and the mechanism has {0}; name the states that count: [ranking] \
         states = [\"free\"]"
    )]
    Drives(usize),
    /// The drive does not go on to the part.
    #[error("the drive cannot be followed to {0}, where the levers fit a part; analyze its stroke")]
    OutOfReach(f64),
}

/// A pose with its loads.
#[derive(Debug, Clone)]
pub struct LoadCase {
    /// Position of the first drive since the pose of the file: `[rad]`, or the file's unit.
    pub drive: f64,
    /// The pose of the original mechanism.
    pub pose: Pose,
    /// The loads.
    pub loads: Loads,
}

/// The part of a grip in the cases.
#[derive(Debug, Clone, PartialEq)]
pub struct Gripped {
    /// The state with the contacts.
    pub state: StateId,
    /// Diameters held, ascending. `[m]`
    pub held: Vec<f64>,
    /// Diameters that are not. `[m]`
    pub lost: Vec<f64>,
}

/// All cases.
#[derive(Debug, Clone, Default)]
pub struct Cases {
    /// The cases.
    pub list: Vec<LoadCase>,
    /// How many of them, the first, are of the free state.
    pub free: usize,
    /// The first position of the stroke that could not be reached.
    pub stopped: Option<f64>,
    /// The grips that give the other loads.
    pub gripped: Vec<Gripped>,
}

/// Returns true if the file loads the free state.
fn free_is_loaded(m: &Mechanism) -> bool {
    let l = &m.loads;
    let weights = l.gravity.is_some() && m.links.iter().any(|x| x.mass.is_some());
    weights || l.acts_from_outside(StateId::FREE)
}

/// Returns true if the file loads any state.
pub(crate) fn is_loaded(m: &Mechanism) -> bool {
    free_is_loaded(m) || m.state_ids().any(|s| grip_of(m, s).is_some())
}

/// Returns the states that count if the ranking names none: those with loads. The free state also counts if conditioning
/// applies to its stroke, or if nothing else is loaded.
pub(crate) fn states_with_loads(m: &Mechanism) -> Vec<StateId> {
    let gripped = m.state_ids().skip(1).filter(|&s| grip_of(m, s).is_some());
    let gripped: Vec<StateId> = gripped.collect();
    let free = gripped.is_empty() || free_is_loaded(m) || m.loads.stroke.is_some();
    free.then_some(StateId::FREE)
        .into_iter()
        .chain(gripped)
        .collect()
}

/// Returns the cases of some states, or of those with loads if none are named.
///
/// # Errors
/// [`CaseError`].
///
/// # Complexity
/// That of following the stroke and of the grip's study.
pub(crate) fn list_cases(
    m: &Mechanism,
    drives: &[Driven],
    states: &[StateId],
) -> Result<Cases, CaseError> {
    let mut out = Cases::default();
    let default = states_with_loads(m);
    let states = if states.is_empty() { &default } else { states };
    for &state in states.iter().unique() {
        if state == StateId::FREE && grip_of(m, StateId::FREE).is_none() {
            let followed = follow_stroke(m, StateId::FREE, drives, m.loads.stroke)?;
            out.stopped = followed.stopped;
            out.free = followed.poses.len();
            let each = followed.poses.into_iter().map(|(drive, pose)| LoadCase {
                drive,
                pose,
                loads: m.loads.in_state(StateId::FREE),
            });
            out.list.splice(0..0, each);
        } else if let Some(g) = Gripping::new(m, state)? {
            grip_cases(m, drives, &g, &mut out)?;
        }
    }
    Ok(out)
}

fn grip_cases(
    m: &Mechanism,
    drives: &[Driven],
    g: &Gripping,
    out: &mut Cases,
) -> Result<(), CaseError> {
    let name = || m.states[g.state].clone();
    if !g
        .mechanism
        .joints_in(g.state)
        .eq(m.joints_in(StateId::FREE))
    {
        return Err(CaseError::OtherJoints(name()));
    }
    if drives.len() != 1 {
        return Err(CaseError::Drives(drives.len()));
    }
    let mut of_grip = Gripped {
        state: g.state,
        held: Vec::new(),
        lost: Vec::new(),
    };
    for row in &g.study.rows {
        let Some(loads) = g.jaw_loads(row).filter(|_| row.is_held()) else {
            of_grip.lost.push(row.diameter);
            continue;
        };
        of_grip.held.push(row.diameter);
        let drive = g.fit_part(row)?.drive;
        let followed = follow_to(m, StateId::FREE, drives, &[drive])?;
        let Some((_, pose)) = followed.poses.into_iter().next() else {
            return Err(CaseError::OutOfReach(drive));
        };
        out.list.push(LoadCase { drive, pose, loads });
    }
    if of_grip.held.is_empty() {
        return Err(CaseError::NotHeld(name()));
    }
    out.gripped.push(of_grip);
    Ok(())
}
