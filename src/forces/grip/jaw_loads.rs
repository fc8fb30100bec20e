//! Loads of a grip on its mechanism: the part is cut free, and its contact forces act on the jaws.
//!
//! In a state that has the grip's contacts, there are two descriptions of them. As joints they are bilateral and
//! without friction: they pull as well as push, and move freely in the directions that friction holds. With the
//! clamping force as a self-stress, they leave the reactions undetermined. The grip's cone program
//! ([`crate::grip::holding`]) describes them better: forces that push, within the friction cone, and balance the part's
//! weight and inertia.
//!
//! So the part is cut free. Its joints are removed, and the contact forces act on the jaws instead, each at its point
//! of the lever's face. The part's mass is included in them and nowhere else. The remainder is the mechanism of the
//! free state in the pose in which its levers fit the part. It is statically determinate if the free state is, and its
//! drive bears the effort that the grip requires. By virtual work, this is the sum of the lever moments times the
//! levers' turn per travel of the drive.
//!
//! A state without the contacts has no part, and no load from the grip. Links with masses are loaded by the case's
//! gravity less acceleration, which replaces the stated gravity. Links without masses are weightless, as always. The
//! safety factor applies only to the part.
//!
//! Axes: the grip's x, y, z are derived from the points of contacts and lever joints. These must agree with the grip's
//! figures at the nominal diameter.

use crate::closure::drive::driven_freedoms;
use crate::geom::exact::ExactError;
use crate::geom::expr::Expr;
use crate::geom::rigid::RigidMotion;
use crate::geom::vector::{self, Z, across, add_scaled, cross, dot, length, sub};
use crate::grip::clamping::{DiameterRow, Study, study_diameters};
use crate::grip::contact::{self, Contact, Unholdable};
use crate::grip::lever_arm::LeverError;
use crate::model::grip::{GripSpec, Transmission};
use crate::model::joint_type::Freedom;
use crate::model::loads::{ExternalForce, Loads};
use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use crate::motion::follow::{Follower, column_unit};
use crate::motion::pose::Pose;
use crate::statics::mean_point;
use thiserror::Error;

/// Maximum deviation of points in the file from the grip's figures, as a fraction of the lever's length.
const PLACED: f64 = 1e-6;
/// Tolerance of the turn of a lever. `[rad]`
const TURNED: f64 = 1e-9;

/// Reason why a grip's forces cannot be applied to its mechanism.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum JawError {
    /// The geometry has no numerical value.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The lever's figures are out of range.
    #[error(transparent)]
    Lever(#[from] LeverError),
    /// The nominal part cannot be reached, so that there is nothing to compare the file's pose with.
    #[error("[workload.grip]: the nominal diameter cannot be held: {0}")]
    Nominal(Unholdable),
    /// A joint is not at the position given by the figures.
    #[error(
        "joint \"{joint}\" is at ({:.4}, {:.4}) {unit} from the middle of the lever joints, along the gripper and across, and \
         [workload.grip] has it at ({:.4}, {:.4}); make the joints' points and the figures agree at the nominal diameter",
        .is[0], .is[1], .wanted[0], .wanted[1]
    )]
    Misplaced {
        /// The joint.
        joint: String,
        /// Its position, in the file's unit.
        is: [f64; 2],
        /// Its position by the figures.
        wanted: [f64; 2],
        /// The file's unit.
        unit: &'static str,
    },
    /// The lever turns about another axis.
    #[error(
        "lever joint \"{0}\" must be a hinge along the part: a revolute joint, its axis across the plane of the contacts"
    )]
    NotAHinge(String),
    /// The mechanism cannot reach the pose.
    #[error(
        "the mechanism cannot turn lever joint \"{joint}\" by {degrees:.3}° to fit a part of {diameter} m; check its range with `ozols analyze` over a stroke"
    )]
    OutOfReach {
        /// The lever joint.
        joint: String,
        /// The turn from the pose of the file.
        degrees: f64,
        /// The part. `[m]`
        diameter: f64,
    },
}

/// A mechanism with the part cut free, prepared for its contact forces.
#[derive(Debug, Clone)]
pub struct Gripping {
    /// The mechanism, with the joints of the part in no state.
    pub mechanism: Mechanism,
    /// The state with the contacts.
    pub state: StateId,
    /// The grip over its diameters.
    pub study: Study,
    /// The contacts: upper far, upper near, lower far, lower near.
    pub contacts: [JointId; 4],
    /// The links they touch: upper and lower lever.
    pub levers: [LinkId; 2],
    joints: [JointId; 2],
    /// The gripper's axes in those of the file, with the origin in metres.
    axes: RigidMotion,
    nominal: contact::TouchingPose,
    start: Pose,
}

/// The mechanism around a part of one diameter.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Position of the first drive since the pose of the file: `[rad]`, or the file's unit.
    pub drive: f64,
    /// The pose.
    pub pose: Pose,
}

/// Returns the grip that loads a state: it names contacts, and the state has them.
#[must_use]
pub fn grip_of(m: &Mechanism, state: StateId) -> Option<(&GripSpec, [JointId; 4], [JointId; 2])> {
    let spec = m.loads.grip.as_ref()?;
    let contacts = spec.contacts?;
    let Transmission::Joints(levers) = spec.transmission else {
        return None;
    };
    m.joints[contacts[0]]
        .is_in(state)
        .then_some((spec, contacts, levers))
}

/// Returns the mechanism without the joints of a link. They are in no state, and ids stay unchanged.
fn cut_free(m: &Mechanism, part: LinkId) -> Mechanism {
    let mut out = m.clone();
    for joint in out
        .edit()
        .joints
        .iter_mut()
        .filter(|j| j.links.contains(&part))
    {
        joint.states = Some(Vec::new());
    }
    out
}

fn joint_metres(m: &Mechanism, joint: JointId) -> [f64; 3] {
    let p = &m.joints[joint].frame.point;
    [0, 1, 2].map(|i| p[i].to_f64() * m.length_unit.metres)
}

fn unit_vector(a: [f64; 3]) -> Option<[f64; 3]> {
    (length(a) > 0.0).then(|| vector::unit(a))
}

/// Returns the gripper's axes, from the contacts and the hinges of the levers along `hinge`.
fn grip_axes(
    contacts: [[f64; 3]; 4],
    pivots: [[f64; 3]; 2],
    hinge: [f64; 3],
) -> Option<RigidMotion> {
    let ahead = sub(mean_point(&contacts), mean_point(&pivots));
    let x = unit_vector(across(ahead, hinge))?;
    let up = across(
        sub(mean_point(&contacts[..2]), mean_point(&contacts[2..])),
        hinge,
    );
    let y = unit_vector(across(up, x))?;
    let axes = [x, y, cross(x, y)];
    Some(RigidMotion {
        rotation: [0, 1, 2].map(|i| axes.map(|a| a[i])),
        // Midway between the pivots, in the plane of the contacts.
        translation: add_scaled(mean_point(&pivots), dot(ahead, hinge), hinge),
    })
}

/// Returns an error if a joint is farther than `most` from its expected position in the gripper's plane. `[m]`
fn check_position(
    axes: &RigidMotion,
    m: &Mechanism,
    joint: JointId,
    wanted: [f64; 2],
    most: f64,
) -> Result<(), JawError> {
    let from_origin = sub(joint_metres(m, joint), axes.translation);
    let [x, y, _] = axes.inverse().map_direction(from_origin);
    let off = (x - wanted[0]).hypot(y - wanted[1]);
    if off.is_nan() || off > most {
        let told = |p: [f64; 2]| p.map(|x| x / m.length_unit.metres);
        return Err(JawError::Misplaced {
            joint: m.joints[joint].id.clone(),
            is: told([x, y]),
            wanted: told(wanted),
            unit: m.length_unit.symbol,
        });
    }
    Ok(())
}

impl Gripping {
    /// Creates the mechanism of a state with the part cut free. Returns `None` if no grip loads the state.
    ///
    /// # Errors
    /// Returns an error if points of the mechanism do not agree with the grip's figures.
    ///
    /// # Complexity
    /// That of [`study_diameters`].
    pub fn new(m: &Mechanism, state: StateId) -> Result<Option<Gripping>, JawError> {
        match grip_of(m, state) {
            Some((spec, ..)) => Gripping::of_study(m, state, study_diameters(spec)?),
            None => Ok(None),
        }
    }

    /// Creates the mechanism for an existing study.
    ///
    /// # Errors
    /// Returns an error in the same cases as [`Gripping::new`].
    pub(crate) fn of_study(
        m: &Mechanism,
        state: StateId,
        study: Study,
    ) -> Result<Option<Gripping>, JawError> {
        let Some((spec, contacts, joints)) = grip_of(m, state) else {
            return Ok(None);
        };
        let of_row = study
            .rows
            .first()
            .map(|r| r.gripper.touching_pose(spec.diameter));
        let nominal = match of_row {
            Some(Ok(pose)) => pose,
            Some(Err(why)) => return Err(JawError::Nominal(why)),
            None => return Ok(None),
        };
        // One link of the contacts is the part, which all share. The others are the levers.
        let [a, b] = m.joints[contacts[0]].links;
        let part = if m.joints[contacts[2]].links.contains(&a) {
            a
        } else {
            b
        };
        let lever = |c: usize| {
            let [a, b] = m.joints[contacts[c]].links;
            if a == part { b } else { a }
        };
        let mechanism = cut_free(m, part);
        let start = Pose::of_file(&mechanism, state)?;
        let not_a_hinge = || JawError::NotAHinge(m.joints[joints[0]].id.clone());
        let at = hinge_column(&start, joints[0]).ok_or_else(not_a_hinge)?;
        let t = start.columns[at].twist;
        let axes = grip_axes(
            contacts.map(|j| joint_metres(m, j)),
            joints.map(|j| joint_metres(m, j)),
            [t[0], t[1], t[2]],
        )
        .ok_or_else(not_a_hinge)?;
        let placed = contacts.into_iter().zip(nominal.contacts.map(|c| c.point));
        let placed = placed.chain(joints.into_iter().zip(nominal.pivots));
        for (joint, wanted) in placed {
            check_position(&axes, m, joint, wanted, PLACED * spec.lever_length)?;
        }
        Ok(Some(Gripping {
            levers: [lever(0), lever(2)],
            mechanism,
            state,
            study,
            contacts,
            joints,
            axes,
            nominal,
            start,
        }))
    }

    /// Returns the mechanism with its levers around a part, moved from the pose of the file on its branch.
    ///
    /// # Errors
    /// Returns an error if a lever is not a hinge, or cannot reach the pose.
    pub fn fit_part(&self, row: &DiameterRow) -> Result<Fit, JawError> {
        let m = &self.mechanism;
        let there = row.pose.as_ref().map_or(0.0, |p| p.turn);
        let mut pose = self.start.clone();
        let mut held = Vec::new();
        for (k, &joint) in self.joints.iter().enumerate() {
            let name = || m.joints[joint].id.clone();
            let column = hinge_column(&pose, joint).ok_or_else(|| JawError::NotAHinge(name()))?;
            // The lower lever is the mirror image of the upper one.
            let turn = (there - self.nominal.turn) * if k == 0 { 1.0 } else { -1.0 };
            let t = self.start.columns[column].twist;
            let about = dot([t[0], t[1], t[2]], self.axes.map_direction(Z));
            if about.abs() < 1.0 - 1e-9 {
                return Err(JawError::NotAHinge(name()));
            }
            let second = m.joints[joint].links[1] == self.levers[k];
            let to = turn * about.signum() * if second { 1.0 } else { -1.0 };
            if (pose.columns[column].moved - to).abs() > TURNED {
                let mut follower = Follower::new(pose, column, &held);
                follower
                    .advance_to(to, |_| {})
                    .map_err(|_| JawError::OutOfReach {
                        joint: name(),
                        degrees: to.to_degrees(),
                        diameter: row.diameter,
                    })?;
                pose = follower.current_pose();
            }
            held.push(column);
        }
        let first = driven_freedoms(m, self.state).first().copied();
        let mut columns = pose.columns.iter();
        let drive = columns.position(|c| Some((c.joint, c.freedom)) == first);
        let position = drive.map(|c| pose.columns[c].moved * column_unit(&pose, c));
        Ok(Fit {
            drive: position.unwrap_or(0.0),
            pose,
        })
    }

    /// Returns the loads of the mechanism in a diameter's worst case: those of the file, and the part's forces on the
    /// jaws. Returns `None` if the part is not held. The drives are at rest.
    #[must_use]
    pub fn jaw_loads(&self, row: &DiameterRow) -> Option<Loads> {
        let (hardest, fitted) = (row.hardest.as_ref()?, row.pose.as_ref()?);
        let holding = hardest.held_forces()?;
        let exact = |v: [f64; 3]| {
            let [x, y, z] = v.map(|x| Expr::from_f64(x).ok());
            Some([x?, y?, z?])
        };
        let mut out = Loads {
            drive_speeds: Vec::new(),
            stroke: None,
            ..self.mechanism.loads.in_state(self.state)
        };
        if out.gravity.is_some() {
            out.gravity = Some(exact(self.axes.map_direction(hardest.pull))?);
        }
        let along = self.study.lever.face_distance(row.diameter);
        let each = self.nominal.contacts.iter().zip(&fitted.contacts);
        for ((home, now), f) in each.zip(&holding.forces) {
            let point = self.axes.map_point(on_face(&self.nominal, home, along));
            let force = [0, 1].map(|i| f.normal * now.normal[i] + f.along * now.tangent[i]);
            out.forces.push(ExternalForce {
                link: self.levers[home.lever],
                point: exact(point.map(|x| x / self.mechanism.length_unit.metres))?,
                // The part's force on the jaw is the opposite of the jaw's on the part.
                force: exact(self.axes.map_direction([-force[0], -force[1], -f.axial]))?,
                range: None,
                states: None,
            });
        }
        Some(out)
    }
}

/// Returns the column of a joint that is only a hinge.
fn hinge_column(pose: &Pose, joint: JointId) -> Option<usize> {
    let mut own = (0..pose.columns.len()).filter(|&c| pose.columns[c].joint == joint);
    match (own.next(), own.next()) {
        (Some(c), None) if pose.columns[c].freedom == Freedom::Rz => Some(c),
        _ => None,
    }
}

/// Returns the point of a lever's face at a distance from the vertex, with the lever as it holds the nominal part.
fn on_face(nominal: &contact::TouchingPose, c: &Contact, along: f64) -> [f64; 3] {
    let [x, y] = add_scaled(nominal.vertices[c.lever], along, c.tangent);
    [x, y, 0.0]
}
