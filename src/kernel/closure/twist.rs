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

impl<N: Clone + PartialEq + Default> MotionSpace<N> {
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
                let unit = |i: usize| [0, 1, 2].map(|j| if i == j { &one } else { &zero }.clone());
                let e1 = [unit(0), unit(1)]
                    .into_iter()
                    .map(|x| s.cross(n.clone(), x))
                    .find(|e| e.iter().any(|c| *c != zero))
                    .unwrap_or_else(|| unit(0));
                let e2 = s.cross(n.clone(), e1.clone());
                MotionSpace::Planar { axes: [n, e1, e2] }
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
                let [w0, w1, w2, v0, v1, v2] = t.clone();
                let (w, v) = ([w0, w1, w2], [v0, v1, v2]);
                let dot = |a: &[N; 3], b: &[N; 3]| s.dot(a.clone(), b.clone());
                // Products of decimals round: a turn about the normal must not fall out of the plane by that.
                let (nn, ww) = (dot(n, n), dot(&w, &w));
                let turn = s.mul(ww.clone(), nn.clone());
                let shift = s.mul(s.add(dot(&v, &v), ww), nn);
                let tilt = s.cross(w.clone(), n.clone());
                let inside = tilt.into_iter().all(|c| s.vanishes(c, turn.clone()))
                    && s.vanishes(dot(&v, n), shift);
                inside.then(|| vec![dot(&w, n), dot(&v, e1), dot(&v, e2)])
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

impl<N: Clone> FrameValues<N> {
    /// Evaluates a frame: z = axis, x = reference·(z·z) - z·(z·reference), y = z × x.
    ///
    /// # Errors
    /// Where a coordinate has no value in the number system.
    pub fn new<S: Scalars<Number = N>>(s: &S, frame: &Frame) -> Result<Self, ExactError> {
        let vectors = [
            s.eval3(&frame.point)?,
            s.eval3(&frame.axis)?,
            s.eval3(&frame.reference)?,
        ];
        Ok(Self::of(s, vectors, s.eval(&frame.pitch)?))
    }

    /// A frame from the values of its point, axis and reference.
    pub fn of<S: Scalars<Number = N>>(s: &S, [point, z, r]: [[N; 3]; 3], pitch: N) -> Self {
        let zero = s.sub(z[0].clone(), z[0].clone());
        let minus = s.sub(zero, s.dot(z.clone(), r.clone()));
        let zz = s.dot(z.clone(), z.clone());
        let x = s.scaled_sum(minus, z.clone(), r.map(|c| s.mul(zz.clone(), c)));
        let y = s.cross(z.clone(), x.clone());
        FrameValues {
            axes: [x, y, z],
            point,
            pitch,
        }
    }

    /// The frame in a motion space: in a plane, a joint with all three turns and no slide turns about the normal whatever
    /// its own axis.
    #[must_use]
    pub fn within(mut self, space: &MotionSpace<N>, freedoms: &[Freedom]) -> Self {
        let turns = freedoms.iter().filter(|f| f.turns()).count();
        if let MotionSpace::Planar { axes: [n, e1, e2] } = space
            && turns == 3
            && !freedoms.iter().any(|f| f.slides())
        {
            self.axes = [e1.clone(), e2.clone(), n.clone()];
        }
        self
    }

    /// The twist of one freedom.
    pub fn twist<S: Scalars<Number = N>>(&self, s: &S, freedom: Freedom) -> Twist<N> {
        let zero = || s.sub(self.point[0].clone(), self.point[0].clone());
        let join = |[a, b, c]: [N; 3], [d, e, f]: [N; 3]| [a, b, c, d, e, f];
        let rotation = |u: &[N; 3]| {
            let v = s.cross(self.point.clone(), u.clone());
            join(u.clone(), v)
        };
        let translation = |u: &[N; 3]| join([zero(), zero(), zero()], u.clone());
        let [x, y, z] = &self.axes;
        match freedom {
            Freedom::Rx => rotation(x),
            Freedom::Ry => rotation(y),
            Freedom::Rz => rotation(z),
            Freedom::Tx => translation(x),
            Freedom::Ty => translation(y),
            Freedom::Tz => translation(z),
            Freedom::Screw => {
                let v = s.cross(self.point.clone(), z.clone());
                let t = s.scaled_sum(self.pitch.clone(), z.clone(), v);
                join(z.clone(), t)
            }
        }
    }
}

/// Freedoms, each with its twist.
pub type FreedomTwists<N> = Vec<(Freedom, Vec<N>)>;

/// The freedoms of a joint as twists in a motion space, each with the freedom it comes from; see
/// [`FrameValues::within`].
///
/// # Errors
/// Where a coordinate has no value in the number system.
pub fn joint_twists<S: Scalars>(
    s: &S,
    space: &MotionSpace<S::Number>,
    frame: &Frame,
    joint_type: &JointType,
) -> Result<FreedomTwists<S::Number>, ExactError> {
    let freedoms = joint_type.freedoms();
    let values = FrameValues::new(s, frame)?.within(space, freedoms);
    Ok(freedoms
        .iter()
        .filter_map(|&f| space.components(s, &values.twist(s, f)).map(|c| (f, c)))
        .collect())
}
