//! What a mechanism carries: masses of links, gravity, forces from outside, and how it is driven.

use crate::geom::expr::Expr;
use crate::model::drive::DriveSpec;
use crate::model::grip::GripSpec;
use crate::model::{JointId, LinkId, StateId};

/// Inertia of a link about its mass centre `[kg·m²]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inertia {
    /// About the normal of the plane of motion.
    Plane(f64),
    /// About the global axes x, y, z.
    Principal([f64; 3]),
    /// xx, yy, zz, xy, yz, zx in global axes.
    Tensor([f64; 6]),
}

/// Mass of a link and where it is.
#[derive(Debug, Clone)]
pub struct MassProperties {
    /// Mass `[kg]`, not negative.
    pub mass: f64,
    /// Mass centre at the pose of the file, in the file's length unit.
    pub centre: [Expr; 3],
    /// Inertia about the mass centre; none where the file states none.
    pub inertia: Option<Inertia>,
}

/// A force from outside, of fixed direction, at a point that moves with a link.
#[derive(Debug, Clone)]
pub struct ExternalForce {
    /// The link it acts on.
    pub link: LinkId,
    /// Its point at the pose of the file, in the file's length unit.
    pub point: [Expr; 3],
    /// The force `[N]` in global axes.
    pub force: [Expr; 3],
    /// The range of the first drive's position it acts in, ends included, again in each turn; always where `None`. Radians,
    /// or the file's length unit.
    pub range: Option<[f64; 2]>,
    /// The states it acts in; all where `None`.
    pub states: Option<Vec<StateId>>,
}

/// Whether a force acts when the first drive is at a position, counted from the pose of the file, given the range it acts
/// in (always where there is none); the range comes again after `period`, where there is one.
#[must_use]
pub fn acts_at(range: Option<[f64; 2]>, drive: f64, period: Option<f64>) -> bool {
    /// Drive positions nearer than this to the end of a range are in it.
    const AT_END: f64 = 1e-9;
    let Some([from, to]) = range else {
        return true;
    };
    match period.filter(|_| from.is_finite() && to.is_finite()) {
        Some(period) => (drive - from + AT_END).rem_euclid(period) <= to - from + 2.0 * AT_END,
        None => (from - AT_END..=to + AT_END).contains(&drive),
    }
}

/// A moment from outside, of fixed direction, on a link.
#[derive(Debug, Clone)]
pub struct ExternalMoment {
    /// The link it acts on.
    pub link: LinkId,
    /// The moment `[N·m]` in global axes.
    pub moment: [Expr; 3],
    /// The states it acts in; all where `None`.
    pub states: Option<Vec<StateId>>,
}

/// What the face of a contact with a clamped part can do beside pushing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// The joint.
    pub joint: JointId,
    /// Coefficient of friction; as much friction as it takes where `None`.
    pub friction: Option<f64>,
    /// Radius in the file's length unit, within which the pressure has its centre; anywhere where `None`.
    pub radius: Option<f64>,
}

/// How stiff a joint is where it does not move, alike in all directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Force by displacement `[N/m]`, positive.
    pub linear: f64,
    /// Moment by turn `[N·m/rad]`, positive.
    pub angular: f64,
}

/// A joint made or mounted askew: its second link is turned and shifted by this against its first where nothing strains it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misalignment {
    /// The joint.
    pub joint: JointId,
    /// The turn `[rad]` about x, y and z of the joint's own frame, small.
    pub turn: [f64; 3],
    /// The shift `[m]` along them, small.
    pub shift: [f64; 3],
}

/// A range of the first drive's position, from the pose of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Where it begins `[rad]` or in the file's length unit.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Number of equal steps, at least 1.
    pub steps: usize,
}

impl Stroke {
    /// Its positions, both ends included.
    #[must_use]
    pub fn positions(&self) -> Vec<f64> {
        let steps = self.steps.max(1);
        #[allow(clippy::cast_precision_loss, reason = "at most 1e5 steps")]
        let part = |i: usize| i as f64 / steps as f64;
        (0..=steps)
            .map(|i| self.from + (self.to - self.from) * part(i))
            .collect()
    }
}

/// Whether what acts in `states`, in all where there are none, acts in `state`.
#[must_use]
pub fn acts_in(states: Option<&Vec<StateId>>, state: StateId) -> bool {
    states.is_none_or(|s| s.contains(&state))
}

/// Loads and drive of a mechanism.
#[derive(Debug, Clone, Default)]
pub struct Loads {
    /// Acceleration of gravity `[m/s²]`, where the file states one.
    pub gravity: Option<[Expr; 3]>,
    /// Forces from outside.
    pub forces: Vec<ExternalForce>,
    /// Moments from outside.
    pub moments: Vec<ExternalMoment>,
    /// Stiffness by the name of a joint type; `default` for the rest.
    pub stiffness: Vec<(String, Stiffness)>,
    /// Faces of contacts.
    pub faces: Vec<Face>,
    /// Joints made askew.
    pub misalignments: Vec<Misalignment>,
    /// Speed of each drive `[rad/s]` or in the file's length unit per second; those not stated stand still.
    pub drive_speeds: Vec<f64>,
    /// The cycle, where the file states one.
    pub stroke: Option<Stroke>,
    /// The gripper that the mechanism is, and what it must hold, where the file says so.
    pub grip: Option<GripSpec>,
    /// The torsional drive, where the file states one.
    pub drive: Option<DriveSpec>,
}

impl Loads {
    /// Only the forces and moments of a state, which then act wherever these loads are put.
    #[must_use]
    pub fn in_state(&self, state: StateId) -> Loads {
        let mut out = self.clone();
        out.forces.retain(|f| acts_in(f.states.as_ref(), state));
        out.moments.retain(|x| acts_in(x.states.as_ref(), state));
        out.forces.iter_mut().for_each(|f| f.states = None);
        out.moments.iter_mut().for_each(|x| x.states = None);
        out
    }

    /// Whether a force or moment from outside acts in a state.
    #[must_use]
    pub fn acts_from_outside(&self, state: StateId) -> bool {
        let force = self.forces.iter().map(|f| f.states.as_ref());
        let mut all = force.chain(self.moments.iter().map(|x| x.states.as_ref()));
        all.any(|s| acts_in(s, state))
    }
}
