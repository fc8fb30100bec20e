//! Positions of the levers and the part: the pose of a two-lever gripper, and whether it can hold a part at all.
//!
//! Axes: x along the gripper's axis of symmetry from the pivots to the part, y from the lower to the upper lever, z
//! along the pivots and the part. The origin is midway between the pivots.

use crate::geom::vector::{
    add, add_scaled, cross_plane, dot, plane_norm, quarter_turn, rotate_plane, scale, sub,
};
use crate::grip::lever_arm::Lever;
use std::fmt;

/// A point or a vector in the plane of motion. `[m]`
pub type Planar = [f64; 2];

/// Two mirrored levers on fixed pivots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gripper {
    /// The upper lever; the lower one is its mirror image.
    pub lever: Lever,
    /// Signed distance a of the upper lever's pivot from the axis; negative if the levers cross. `[m]`
    pub pivot: f64,
    /// Length of a face from the vertex, if known. `[m]`
    pub face_length: Option<f64>,
    /// Width of a lever perpendicular to its line from pivot to vertex; 0 for a line. `[m]`
    pub lever_width: f64,
    /// Whether the levers lie in separate planes and may cross.
    pub may_cross: bool,
}

/// A contact of the part with a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Name: upper far, upper near, lower far, lower near.
    pub name: &'static str,
    /// 0 for the upper lever, 1 for the lower.
    pub lever: usize,
    /// Whether it is the contact far from the pivot, with arm l1.
    pub far: bool,
    /// Position. `[m]`
    pub point: Planar,
    /// Unit normal of the face, towards the part.
    pub normal: Planar,
    /// Unit tangent along the face, from its vertex.
    pub tangent: Planar,
}

/// A gripper that touches a part with all four faces.
#[derive(Debug, Clone, PartialEq)]
pub struct TouchingPose {
    /// Diameter of the part. `[m]`
    pub diameter: f64,
    /// Centre of the part, on the axis of symmetry. `[m]`
    pub centre: Planar,
    /// The pivots of the upper and the lower lever. `[m]`
    pub pivots: [Planar; 2],
    /// The vertices of the upper and the lower V-block. `[m]`
    pub vertices: [Planar; 2],
    /// Counterclockwise angle of the upper lever from the position with its bisector perpendicular to the axis. `[rad]`
    pub turn: f64,
    /// Upper far, upper near, lower far, lower near.
    pub contacts: [Contact; 4],
}

/// Reason why a part cannot be held by any forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unholdable {
    /// The V-blocks cannot close around it between these pivots. `[m]`
    OutOfReach {
        /// Distance from a pivot to the part's centre.
        reach: f64,
        /// Distance a of the pivots from the axis.
        pivot: f64,
    },
    /// An arm is not positive.
    Arm {
        /// l1 or l2.
        name: &'static str,
        /// Its value. `[m]`
        arm: f64,
    },
    /// The contacts lie beyond the faces. `[m]`
    OffFace {
        /// Distance of the contacts from the vertex.
        distance: f64,
        /// Length of the faces.
        face: f64,
    },
    /// The levers' lines cross the axis of symmetry.
    Crossed {
        /// Signed distance of the nearer end of the upper lever from the axis. `[m]`
        clearance: f64,
        /// Half the width of a lever. `[m]`
        half_width: f64,
    },
    /// The tips of the two V-blocks would overlap before they touch the part. `[m]`
    TipsMeet {
        /// Signed distance of the upper tip from the axis.
        tip: f64,
    },
    /// The pivots lie within the part. `[m]`
    PivotInPart {
        /// Distance from a pivot to the part's centre.
        reach: f64,
    },
}

impl fmt::Display for Unholdable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mm = |x: f64| x * 1e3;
        match *self {
            Unholdable::OutOfReach { reach, pivot } => write!(
                f,
                "out of reach: the part's centre is {:.4} mm from a pivot, but the axis is {:.4} mm from it; bring the pivots closer",
                mm(reach),
                mm(pivot)
            ),
            Unholdable::Arm { name, arm } => write!(
                f,
                "arm {name} is {:.4} mm, not positive: this contact opens the lever; use a longer lever or a smaller part",
                mm(arm)
            ),
            Unholdable::OffFace { distance, face } => write!(
                f,
                "larger than the jaws: contacts {:.4} mm from the vertex on faces of {:.4} mm; use longer faces",
                mm(distance),
                mm(face)
            ),
            Unholdable::Crossed {
                clearance,
                half_width,
            } => write!(
                f,
                "the levers collide: the middle of one is {:.4} mm from the axis, but {:.4} mm are needed",
                mm(clearance),
                mm(half_width)
            ),
            Unholdable::TipsMeet { tip } => write!(
                f,
                "the prisms' tips collide: they would overlap by {:.4} mm; use shorter faces",
                mm(-2.0 * tip)
            ),
            Unholdable::PivotInPart { reach } => {
                write!(
                    f,
                    "the pivots would lie within the part, {:.4} mm from its centre",
                    mm(reach)
                )
            }
        }
    }
}

impl Gripper {
    /// Creates the gripper for which a diameter is nominal.
    ///
    /// # Examples
    /// ```
    /// use ozols::grip::{contact::Gripper, lever_arm::Lever};
    /// let lever = Lever::new(0.1, 120f64.to_radians(), 30f64.to_radians())?;
    /// let gripper = Gripper::with_nominal(lever, 0.05);
    /// assert!(gripper.find_obstacles(0.05).is_empty());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_nominal(lever: Lever, diameter: f64) -> Gripper {
        Gripper {
            lever,
            pivot: lever.nominal_pivot(diameter),
            face_length: None,
            lever_width: 0.0,
            may_cross: false,
        }
    }

    /// Returns the pose in which all four faces touch a part of this diameter; the levers turn to fit it.
    ///
    /// # Errors
    /// Returns an error if there is no such pose.
    ///
    /// # Sources
    /// The triangle of pivot, vertex and centre; `[Pavlenko & Godunko 2010]` fig. 1 for its angle at the vertex.
    ///
    /// # Examples
    /// ```
    /// use ozols::grip::{contact::Gripper, lever_arm::Lever};
    /// let lever = Lever::new(0.1, 120f64.to_radians(), 30f64.to_radians())?;
    /// let pose = Gripper::with_nominal(lever, 0.05).touching_pose(0.05).expect("it is held");
    /// assert!(pose.turn.abs() < 1e-12); // The nominal part turns no lever.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn touching_pose(&self, diameter: f64) -> Result<TouchingPose, Unholdable> {
        let (lever, half) = (&self.lever, self.lever.prism_angle / 2.0);
        let to_centre = lever.centre_distance(diameter);
        // With the vertex at the origin and the bisector pointing down, perpendicular to the axis.
        let theta = lever.bisector_angle();
        let pivot_there = [-lever.length * theta.sin(), -lever.length * theta.cos()];
        let centre_there = [0.0, -to_centre];
        let across = sub(centre_there, pivot_there);
        let reach = plane_norm(across);
        let ahead = (reach - self.pivot.abs()) * (reach + self.pivot.abs());
        // At a difference this small the part is between the pivots.
        if ahead.is_nan() || ahead <= 1e-18 * reach * reach {
            return Err(Unholdable::OutOfReach {
                reach,
                pivot: self.pivot.abs(),
            });
        }
        let centre = [ahead.sqrt(), 0.0];
        let pivot = [0.0, self.pivot];
        let wanted = [centre[0], -self.pivot];
        let turn = cross_plane(across, wanted).atan2(dot(across, wanted));
        let vertex = add(pivot, rotate_plane(scale(pivot_there, -1.0), turn));
        let down = rotate_plane([0.0, -1.0], turn);
        let along = lever.face_distance(diameter);
        let contact = |name, lever, far: bool| {
            let tangent = rotate_plane(down, if far { half } else { -half });
            let normal = scale(quarter_turn(tangent), if far { -1.0 } else { 1.0 });
            let point = add_scaled(vertex, along, tangent);
            // The face that opens counterclockwise from the bisector has the part on its clockwise side.
            let mirror = |v: Planar| if lever == 1 { [v[0], -v[1]] } else { v };
            Contact {
                name,
                lever,
                far,
                point: mirror(point),
                normal: mirror(normal),
                tangent: mirror(tangent),
            }
        };
        Ok(TouchingPose {
            diameter,
            centre,
            pivots: [pivot, [0.0, -self.pivot]],
            vertices: [vertex, [vertex[0], -vertex[1]]],
            turn,
            contacts: [
                contact("upper far", 0, true),
                contact("upper near", 0, false),
                contact("lower far", 1, true),
                contact("lower near", 1, false),
            ],
        })
    }

    /// Returns every reason why a part of this diameter cannot be held by any forces. Empty if it can be held.
    ///
    /// # Sources
    /// `[Pavlenko & Godunko 2010]`: only combinations that can really hold the part count.
    #[must_use]
    pub fn find_obstacles(&self, diameter: f64) -> Vec<Unholdable> {
        let pose = match self.touching_pose(diameter) {
            Ok(pose) => pose,
            Err(reason) => return vec![reason],
        };
        let mut out = Vec::new();
        let arms = self.lever.force_arms(diameter);
        for (name, arm) in [("l1", arms.l1), ("l2", arms.l2)] {
            if arm <= 0.0 {
                out.push(Unholdable::Arm { name, arm });
            }
        }
        let distance = self.lever.face_distance(diameter);
        if let Some(face) = self.face_length {
            if distance > face {
                out.push(Unholdable::OffFace { distance, face });
            }
            let tips = pose.contacts[..2]
                .iter()
                .map(|c| pose.vertices[0][1] + face * c.tangent[1]);
            let tip = tips.fold(f64::INFINITY, f64::min);
            if tip < 0.0 {
                out.push(Unholdable::TipsMeet { tip });
            }
        }
        let clearance = pose.pivots[0][1].min(pose.vertices[0][1]);
        let half_width = self.lever_width / 2.0;
        // Rounding must not reject levers that lie on the axis.
        if !self.may_cross && clearance < half_width - 1e-12 * self.lever.length {
            out.push(Unholdable::Crossed {
                clearance,
                half_width,
            });
        }
        let reach = pose.centre[0].hypot(self.pivot);
        if reach <= diameter / 2.0 {
            out.push(Unholdable::PivotInPart { reach });
        }
        out
    }
}
