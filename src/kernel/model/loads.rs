//! Loads of a mechanism: masses of links, gravity, external forces, and the drive.

use crate::geom::expr::Expr;
use crate::model::drive::DriveSpec;
use crate::model::grip::GripSpec;
use crate::model::{JointId, LinkId, StateId};
use serde::Serialize;

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

/// Mass of a link and its position.
#[derive(Debug, Clone)]
pub struct MassProperties {
    /// Mass `[kg]`, not negative.
    pub mass: f64,
    /// Mass centre at the pose of the file, in the file's length unit.
    pub centre: [Expr; 3],
    /// Inertia about the mass centre, or `None` if the file does not state it.
    pub inertia: Option<Inertia>,
}

/// An external force of fixed direction, at a point that moves with a link.
#[derive(Debug, Clone)]
pub struct ExternalForce {
    /// The link it acts on.
    pub link: LinkId,
    /// Its point at the pose of the file, in the file's length unit.
    pub point: [Expr; 3],
    /// The force `[N]` in global axes.
    pub force: [Expr; 3],
    /// The range of the first drive's position in which it acts, including the ends, and repeated in each turn. `None`
    /// means always. Radians, or the file's length unit.
    pub range: Option<[f64; 2]>,
    /// The states in which it acts; `None` means all.
    pub states: Option<Vec<StateId>>,
}

/// Returns true if a force acts when the first drive is at a position, relative to the pose of the file. `range` is the
/// range in which it acts (always if `None`), and is repeated after `period`, if given.
///
/// # Examples
/// ```
/// use ozols::model::loads::acts_at;
/// // In the first quarter of each turn.
/// let range = Some([0.0, 90.0]);
/// assert!(acts_at(range, 400.0, Some(360.0)) && !acts_at(range, 200.0, Some(360.0)));
/// ```
#[must_use]
pub fn acts_at(range: Option<[f64; 2]>, drive: f64, period: Option<f64>) -> bool {
    /// Tolerance at the ends of a range of drive positions.
    const AT_END: f64 = 1e-9;
    let Some([from, to]) = range else {
        return true;
    };
    match period.filter(|_| from.is_finite() && to.is_finite()) {
        Some(period) => (drive - from + AT_END).rem_euclid(period) <= to - from + 2.0 * AT_END,
        None => (from - AT_END..=to + AT_END).contains(&drive),
    }
}

/// An external moment of fixed direction on a link.
#[derive(Debug, Clone)]
pub struct ExternalMoment {
    /// The link it acts on.
    pub link: LinkId,
    /// The moment `[N·m]` in global axes.
    pub moment: [Expr; 3],
    /// The states in which it acts; `None` means all.
    pub states: Option<Vec<StateId>>,
}

/// Properties of the face of a contact with a clamped part, in addition to pushing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// The joint.
    pub joint: JointId,
    /// Coefficient of friction. `None` means as much friction as required.
    pub friction: Option<f64>,
    /// Radius in the file's length unit within which the centre of pressure lies. `None` means anywhere.
    pub radius: Option<f64>,
}

/// Stiffness of a joint in its constrained directions, the same in all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Force by displacement `[N/m]`, positive.
    pub linear: f64,
    /// Moment by turn `[N·m/rad]`, positive.
    pub angular: f64,
}

/// A joint made or mounted inaccurately: without strain, its second link is turned and shifted by this relative to its
/// first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misalignment {
    /// The joint.
    pub joint: JointId,
    /// The small turn `[rad]` about x, y and z of the joint's own frame.
    pub turn: [f64; 3],
    /// The small shift `[m]` along them.
    pub shift: [f64; 3],
}

/// Tolerances of a joint. The error of each axis is normal and independent; a tolerance is three standard deviations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tolerances {
    /// Tolerance of the position `[m]`.
    pub position: f64,
    /// Tolerance of the direction `[rad]`.
    pub angle: f64,
}

const FINE: Tolerances = Tolerances {
    position: 0.15e-3,
    angle: 0.5_f64.to_radians(),
};
const MEDIUM: Tolerances = Tolerances {
    position: 0.3e-3,
    ..FINE
};
const COARSE: Tolerances = Tolerances {
    position: 0.8e-3,
    angle: 1.0_f64.to_radians(),
};

impl Tolerances {
    /// Names of the general tolerances of ISO 2768 for 30 to 120 mm.
    pub const NAMES: [&str; 3] = ["fine", "medium", "coarse"];

    /// Returns the general tolerances of a name; `None` if it is not one of [`Tolerances::NAMES`].
    ///
    /// # Examples
    /// ```
    /// use ozols::model::loads::Tolerances;
    /// assert_eq!(Tolerances::named("medium").map(|t| t.position), Some(0.3e-3));
    /// assert_eq!(Tolerances::named("rough"), None);
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Tolerances> {
        let at = Tolerances::NAMES.iter().position(|n| *n == name)?;
        Some([FINE, MEDIUM, COARSE][at])
    }
}

/// Accuracy with which the joints of a mechanism are made and mounted.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// Tolerances of joints without their own.
    pub usual: Tolerances,
    /// Joints with their own tolerances.
    pub joints: Vec<(JointId, Tolerances)>,
    /// Force that a person applies at each joint in assembly `[N]`.
    pub hand_force: f64,
}

impl Accuracy {
    /// Returns the accuracy of joints that all have the same tolerances, with 50 N by hand.
    #[must_use]
    pub fn uniform(usual: Tolerances) -> Accuracy {
        Accuracy {
            usual,
            joints: Vec::new(),
            hand_force: 50.0,
        }
    }

    /// Returns the tolerances of a joint.
    #[must_use]
    pub fn of_joint(&self, joint: JointId) -> Tolerances {
        let own = self.joints.iter().find(|(j, _)| *j == joint);
        own.map_or(self.usual, |(_, t)| *t)
    }
}

impl Default for Accuracy {
    /// Returns the tolerances "fine" for all joints.
    fn default() -> Accuracy {
        Accuracy::uniform(FINE)
    }
}

/// A range of the first drive's position, from the pose of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Start `[rad]` or in the file's length unit.
    pub from: f64,
    /// End.
    pub to: f64,
    /// Number of equal steps, at least 1.
    pub steps: usize,
}

impl Stroke {
    /// Returns its positions, including both ends.
    ///
    /// # Examples
    /// ```
    /// use ozols::model::loads::Stroke;
    /// let stroke = Stroke { from: -1.0, to: 1.0, steps: 4 };
    /// assert_eq!(stroke.positions(), [-1.0, -0.5, 0.0, 0.5, 1.0]);
    /// ```
    #[must_use]
    pub fn positions(&self) -> Vec<f64> {
        let steps = self.steps.max(1);
        let part = |i: usize| i as f64 / steps as f64;
        (0..=steps)
            .map(|i| self.from + (self.to - self.from) * part(i))
            .collect()
    }
}

/// Returns true if something that acts in `states`, or in all states if `None`, acts in `state`.
#[must_use]
pub fn acts_in(states: Option<&Vec<StateId>>, state: StateId) -> bool {
    states.is_none_or(|s| s.contains(&state))
}

/// Loads and drive of a mechanism.
#[derive(Debug, Clone, Default)]
pub struct Loads {
    /// Acceleration of gravity `[m/s²]`, if the file states one.
    pub gravity: Option<[Expr; 3]>,
    /// External forces.
    pub forces: Vec<ExternalForce>,
    /// External moments.
    pub moments: Vec<ExternalMoment>,
    /// Stiffness by the name of a joint type; `default` for all others.
    pub stiffness: Vec<(String, Stiffness)>,
    /// Faces of contacts.
    pub faces: Vec<Face>,
    /// Inaccurate joints.
    pub misalignments: Vec<Misalignment>,
    /// Accuracy of the joints, if the file states it.
    pub accuracy: Option<Accuracy>,
    /// Speed of each drive `[rad/s]` or in the file's length unit per second. Drives without a stated speed are at
    /// rest.
    pub drive_speeds: Vec<f64>,
    /// The cycle, if the file states one.
    pub stroke: Option<Stroke>,
    /// The gripper that the mechanism represents, and its load, if the file states them.
    pub grip: Option<GripSpec>,
    /// The torsional drive, if the file states one.
    pub drive: Option<DriveSpec>,
}

impl Loads {
    /// Returns only the forces and moments of a state, which then act in any state of the result.
    #[must_use]
    pub fn in_state(&self, state: StateId) -> Loads {
        let mut out = self.clone();
        out.forces.retain(|f| acts_in(f.states.as_ref(), state));
        out.moments.retain(|x| acts_in(x.states.as_ref(), state));
        out.forces.iter_mut().for_each(|f| f.states = None);
        out.moments.iter_mut().for_each(|x| x.states = None);
        out
    }

    /// Returns true if an external force or moment acts in a state.
    #[must_use]
    pub fn acts_from_outside(&self, state: StateId) -> bool {
        let force = self.forces.iter().map(|f| f.states.as_ref());
        let mut all = force.chain(self.moments.iter().map(|x| x.states.as_ref()));
        all.any(|s| acts_in(s, state))
    }
}
