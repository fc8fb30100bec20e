//! A part between the contacts of a mechanism with its drives at rest, prepared for the analysis of closure.

use crate::geom::vector::{add, length, scale, sub};
use crate::grip::faces::JawFace;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::motion::pose::Pose;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::contact::contacts;
use crate::statics::reactions::drives::driven;
use crate::statics::reactions::geometry::{FreedomColumn, Geometry, Six, TOLERANCE};
use ozols_dense::{Matrix, svd};
use thiserror::Error;

/// Reason why there is no clamped part to analyse.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PartError {
    /// No state has contacts with a clamped part.
    #[error(
        "state {state} of {name} has no clamped part between contacts; give a link of role = \
        \"object\", and joints of type fixed, planar, cylinder-on-plane or sphere-on-plane to it"
    )]
    NoPart {
        /// The mechanism.
        name: String,
        /// The state.
        state: String,
    },
    /// A clamped part has another kind of joint.
    #[error(
        "{object} is held by joint {joint}, which is not a face; name only faces, or remove the role \"object\" from the link"
    )]
    Joined {
        /// The clamped part.
        object: String,
        /// The joint.
        joint: String,
    },
    /// The mechanism has no solution.
    #[error(transparent)]
    Unsolved(#[from] Unsolved),
}

/// A motion of the mechanism with its contacts released.
#[derive(Debug, Clone)]
pub struct LooseMotion {
    /// Twist of the part, about the geometry's middle.
    pub part: Six,
    /// For each face, the twist of the part relative to the jaw.
    pub against: Vec<Six>,
}

/// A part between faces; lengths in the geometry's size.
#[derive(Debug, Clone)]
pub struct ClampedPart {
    /// The state.
    pub state: StateId,
    /// The clamped part.
    pub object: LinkId,
    /// The pose of the file.
    pub geometry: Geometry,
    /// The contacts.
    pub faces: Vec<JawFace>,
    /// Independent motions of part and jaws, with drives held and contacts released.
    pub motions: Vec<LooseMotion>,
    /// Mean of the contacts' points.
    pub middle: [f64; 3],
    /// Root mean square distance of the contacts' points from the middle, by which moments are divided.
    pub size: f64,
    /// Unit loads that span all loads, (moment; force): six, or three in a plane.
    pub axes: Vec<Six>,
}

impl ClampedPart {
    /// Returns the clamped part of a state at the pose of the file.
    ///
    /// # Errors
    /// Returns a [`PartError`].
    ///
    /// # Complexity
    /// O((6k)²·f) for k contours and f freedoms.
    pub fn new(m: &Mechanism, state: StateId) -> Result<ClampedPart, PartError> {
        let pose = Pose::of_file(m, state).map_err(Unsolved::from)?;
        let geometry = Geometry::new(m, state, &pose).map_err(Unsolved::from)?;
        let all = contacts(m, &geometry)?;
        let held = |l: &LinkId| all.iter().any(|c| m.joints[c.joint].links.contains(l));
        let mut objects = m.link_ids().filter(|&l| m.links[l].role == Role::Object);
        let object = objects.find(held).ok_or_else(|| PartError::NoPart {
            name: m.name.clone(),
            state: m.states[state].clone(),
        })?;
        let at_part = |j: JointId| m.joints[j].links.contains(&object);
        let faces: Vec<JawFace> = all
            .iter()
            .filter(|c| at_part(c.joint))
            .map(|c| JawFace::new(m, &geometry, c, object))
            .collect();
        let is_face = |j: JointId| faces.iter().any(|f| f.joint == j);
        let mut others = geometry.joints.iter().filter(|&&j| at_part(j));
        if let Some(&joint) = others.find(|&&j| !is_face(j)) {
            return Err(PartError::Joined {
                object: m.links[object].id.clone(),
                joint: m.joints[joint].id.clone(),
            });
        }
        let points: Vec<[f64; 3]> = faces.iter().map(|f| geometry.points[f.joint]).collect();
        #[allow(clippy::cast_precision_loss, reason = "a count of contacts")]
        let share = 1.0 / points.len() as f64;
        let middle = scale(points.iter().fold([0.0; 3], |s, p| add(s, *p)), share);
        let square: f64 = points.iter().map(|p| length(sub(*p, middle)).powi(2)).sum();
        let spread = (square * share).sqrt();
        let motions = motions(m, &geometry, object, &faces)?;
        Ok(ClampedPart {
            state,
            object,
            axes: geometry.basis.clone(),
            motions,
            middle,
            // A part with one contact has no size.
            size: if spread > TOLERANCE { spread } else { 1.0 },
            faces,
            geometry,
        })
    }

    /// Returns the faces without friction.
    #[must_use]
    pub fn smooth(&self) -> Vec<JawFace> {
        self.faces.iter().map(|f| f.smooth()).collect()
    }
}

/// Returns the motions with drives held and every contact released in all directions.
fn motions(
    m: &Mechanism,
    geometry: &Geometry,
    object: LinkId,
    faces: &[JawFace],
) -> Result<Vec<LooseMotion>, Unsolved> {
    let drives = driven(m, geometry)?;
    let is_face = |c: &FreedomColumn| faces.iter().any(|f| f.joint == c.joint);
    let kept = |c: &&FreedomColumn| !is_face(c) && !drives.contains(&(c.joint, c.freedom));
    let mut free = geometry.clone();
    free.columns = geometry.columns.iter().filter(kept).copied().collect();
    let first = free.columns.len();
    for face in faces {
        free.columns
            .extend(geometry.basis.iter().map(|twist| FreedomColumn {
                joint: face.joint,
                // A released contact has no joint freedom, because it has all of them.
                freedom: Freedom::Screw,
                twist: *twist,
            }));
    }
    let dim = geometry.basis.len();
    let all = free.motions()?.into_iter().map(|speeds| {
        let mut out = free.link_twists(m.links.len(), &speeds)[object].to_vec();
        for (k, face) in faces.iter().enumerate() {
            let own = &speeds[first + k * dim..][..dim];
            let against = geometry.basis.iter().zip(own);
            out.extend(against.fold([0.0; 6], |t, (b, x)| add(t, scale(*b, *x * face.second))));
        }
        out
    });
    felt(&all.collect::<Vec<_>>())
}

/// Returns the independent motions of part and jaws among those of the whole mechanism, each as the part's twist and
/// its twists relative to the jaws. Idle rods may turn without moving either.
fn felt(all: &[Vec<f64>]) -> Result<Vec<LooseMotion>, Unsolved> {
    let width = all.first().map_or(0, Vec::len);
    let a = Matrix::from_fn(all.len(), width, |r, c| all[r][c]);
    let found = svd(&a).ok_or(Unsolved::NoConvergence)?;
    let six = |x: &[f64]| -> Six { std::array::from_fn(|i| x[i]) };
    let one = |i: usize| {
        let twists = found.v.col(i);
        LooseMotion {
            part: six(twists),
            against: twists[6..].chunks(6).map(six).collect(),
        }
    };
    Ok((0..found.rank(TOLERANCE)).map(one).collect())
}
