//! Unit twists of a joint's freedoms.
//!
//! One convention throughout: a twist is (ω; v), angular velocity first, then the velocity of the body point that
//! passes through the global origin, in global axes. A wrench is (moment about the origin; force) written as (m; f), so
//! that its power on a twist is the plain scalar product of the six numbers.

use crate::geom::exact::ExactError;
use crate::geom::expr::Expr;
use crate::geom::scalars::Scalars;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Frame, Mode};

/// A twist (ω; v) about the global origin.
pub type Twist<N> = [N; 6];

/// The space that twists live in: all six components, or the three of a plane.
#[derive(Debug, Clone)]
pub enum MotionSpace<N> {
    /// All six.
    Spatial,
    /// (ω·n, v·e1, v·e2) with n the plane's normal and e1, e2 across it.
    Planar {
        /// n, e1, e2.
        axes: [[N; 3]; 3],
    },
}

impl<N: Copy + PartialEq + Default> MotionSpace<N> {
    /// The space a mechanism's mode asks for.
    ///
    /// # Errors
    /// Where the normal has no value in the number system.
    pub fn new<S: Scalars<Number = N>>(s: &S, mode: &Mode) -> Result<Self, ExactError> {
        Ok(match mode {
            Mode::Spatial => MotionSpace::Spatial,
            Mode::Planar { normal } => {
                let n = s.eval3(normal)?;
                let zero = N::default();
                let one = s.eval(&Expr::from(1))?;
                let e1 = [[one, zero, zero], [zero, one, zero]]
                    .into_iter()
                    .map(|x| s.cross(n, x))
                    .find(|e| e.iter().any(|&c| c != zero))
                    .unwrap_or([one, zero, zero]);
                MotionSpace::Planar {
                    axes: [n, e1, s.cross(n, e1)],
                }
            }
        })
    }

    /// Rows per contour: 6 or 3.
    #[must_use]
    pub fn dim(&self) -> usize {
        match self {
            MotionSpace::Spatial => 6,
            MotionSpace::Planar { .. } => 3,
        }
    }

    /// The components of a twist in this space, or `None` for a motion that leaves the plane.
    pub fn components<S: Scalars<Number = N>>(&self, s: &S, t: &Twist<N>) -> Option<Vec<N>> {
        match self {
            MotionSpace::Spatial => Some(t.to_vec()),
            MotionSpace::Planar { axes: [n, e1, e2] } => {
                let (w, v) = ([t[0], t[1], t[2]], [t[3], t[4], t[5]]);
                // Products of decimals round: a turn about the normal must not fall out of the plane by that.
                let (nn, ww) = (s.dot(*n, *n), s.dot(w, w));
                let (turn, shift) = (s.mul(ww, nn), s.mul(s.add(s.dot(v, v), ww), nn));
                let inside = s.cross(w, *n).iter().all(|&c| s.vanishes(c, turn))
                    && s.vanishes(s.dot(v, *n), shift);
                inside.then(|| vec![s.dot(w, *n), s.dot(v, *e1), s.dot(v, *e2)])
            }
        }
    }
}

/// Axes x, y, z and origin of a joint's frame, in a number system. The axes are perpendicular, not of unit length.
#[derive(Debug, Clone, Copy)]
pub struct FrameValues<N> {
    /// x, y, z.
    pub axes: [[N; 3]; 3],
    /// Origin.
    pub point: [N; 3],
    /// Translation per radian of a helical joint.
    pub pitch: N,
}

impl<N: Copy> FrameValues<N> {
    /// Evaluates a frame: z = axis, x = reference·(z·z) - z·(z·reference), y = z × x.
    ///
    /// # Errors
    /// Where a coordinate has no value in the number system.
    pub fn new<S: Scalars<Number = N>>(s: &S, frame: &Frame) -> Result<Self, ExactError> {
        let z = s.eval3(&frame.axis)?;
        let r = s.eval3(&frame.reference)?;
        let minus = s.sub(s.sub(z[0], z[0]), s.dot(z, r));
        let zz = s.dot(z, z);
        let x = s.scaled_sum(minus, z, r.map(|c| s.mul(zz, c)));
        Ok(FrameValues {
            axes: [x, s.cross(z, x), z],
            point: s.eval3(&frame.point)?,
            pitch: s.eval(&frame.pitch)?,
        })
    }

    /// The twist of one freedom.
    pub fn twist<S: Scalars<Number = N>>(&self, s: &S, freedom: Freedom) -> Twist<N> {
        let zero = s.sub(self.point[0], self.point[0]);
        let rotation = |u: [N; 3]| {
            let v = s.cross(self.point, u);
            [u[0], u[1], u[2], v[0], v[1], v[2]]
        };
        let translation = |u: [N; 3]| [zero, zero, zero, u[0], u[1], u[2]];
        let [x, y, z] = self.axes;
        match freedom {
            Freedom::Rx => rotation(x),
            Freedom::Ry => rotation(y),
            Freedom::Rz => rotation(z),
            Freedom::Tx => translation(x),
            Freedom::Ty => translation(y),
            Freedom::Tz => translation(z),
            Freedom::Screw => {
                let r = rotation(z);
                let t = s.scaled_sum(self.pitch, z, [r[3], r[4], r[5]]);
                [r[0], r[1], r[2], t[0], t[1], t[2]]
            }
        }
    }
}

/// Freedoms, each with its twist.
pub type FreedomTwists<N> = Vec<(Freedom, Vec<N>)>;

/// The freedoms of a joint as twists in a motion space, each with the freedom it comes from. In a plane, a joint whose
/// rotations are complete (spherical and its kin) turns about the plane's normal whatever its own axis.
///
/// # Errors
/// Where a coordinate has no value in the number system.
pub fn joint_twists<S: Scalars>(
    s: &S,
    space: &MotionSpace<S::Number>,
    frame: &Frame,
    joint_type: &JointType,
) -> Result<FreedomTwists<S::Number>, ExactError> {
    let mut values = FrameValues::new(s, frame)?;
    let freedoms = joint_type.freedoms();
    if let MotionSpace::Planar { axes: [n, e1, e2] } = space {
        let all_turns = [Freedom::Rx, Freedom::Ry, Freedom::Rz]
            .iter()
            .all(|r| freedoms.contains(r));
        if all_turns
            && !freedoms
                .iter()
                .any(|f| matches!(f, Freedom::Tx | Freedom::Ty | Freedom::Tz))
        {
            values.axes = [*e1, *e2, *n];
        }
    }
    Ok(freedoms
        .iter()
        .filter_map(|&f| space.components(s, &values.twist(s, f)).map(|c| (f, c)))
        .collect())
}
