//! Unit twists of a joint's freedoms.
//!
//! There is one convention throughout. A twist is (ω; v): angular velocity first, then the velocity of the body point
//! that passes through the global origin, in global axes. A wrench is (moment about the origin; force), written as (m;
//! f). Its power on a twist is the plain scalar product of the six numbers.

use crate::geom::Scalars;
use crate::geom::exact::ExactError;
use crate::geom::expr::Expr;
pub use crate::geom::rigid::Twist;
use crate::geom::rigid::{join_twist, split_twist};
use crate::geom::vector::length;
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Frame, Mode};

/// The space of twists: all six components, or the three of a plane.
#[derive(Debug, Clone)]
pub enum MotionSpace<N> {
    /// All six.
    Spatial,
    /// (ω·n, v·e1, v·e2) with n the plane's normal and e1, e2 perpendicular to it.
    Planar {
        /// n, e1, e2.
        axes: [[N; 3]; 3],
    },
}

impl<N: Clone + PartialEq + Default> MotionSpace<N> {
    /// Creates the motion space for a mechanism's mode.
    ///
    /// # Errors
    /// Returns an error if the normal has no value in the number system.
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

    /// Returns the number of rows per contour: 6 or 3.
    #[must_use]
    pub fn dim(&self) -> usize {
        match self {
            MotionSpace::Spatial => 6,
            MotionSpace::Planar { .. } => 3,
        }
    }

    /// Returns the components of a twist in this space, or `None` for a motion that leaves the plane.
    pub fn components_in_space<S: Scalars<Number = N>>(
        &self,
        s: &S,
        t: &Twist<N>,
    ) -> Option<Vec<N>> {
        if let MotionSpace::Planar { axes: [n, ..] } = self {
            let (w, v) = split_twist(t);
            let dot = |a: &[N; 3], b: &[N; 3]| s.dot(a.clone(), b.clone());
            // Products of decimals are rounded. This must not move a turn about the normal out of the plane.
            let (nn, ww) = (dot(n, n), dot(&w, &w));
            let turn = s.mul(ww.clone(), nn.clone());
            let shift = s.mul(s.add(dot(&v, &v), ww), nn);
            let tilt = s.cross(w.clone(), n.clone());
            let inside = tilt.into_iter().all(|c| s.vanishes(c, turn.clone()))
                && s.vanishes(dot(&v, n), shift);
            if !inside {
                return None;
            }
        }
        Some(self.along_axes(s, t))
    }

    /// Returns the components of a twist that stays in this space.
    pub(crate) fn along_axes<S: Scalars<Number = N>>(&self, s: &S, t: &Twist<N>) -> Vec<N> {
        match self {
            MotionSpace::Spatial => t.to_vec(),
            MotionSpace::Planar { axes: [n, e1, e2] } => {
                let (w, v) = split_twist(t);
                let dot = |a: &[N; 3], b: &[N; 3]| s.dot(a.clone(), b.clone());
                vec![dot(&w, n), dot(&v, e1), dot(&v, e2)]
            }
        }
    }
}

/// Returns a twist about or along an axis of unit length, because rounding must not let axes grow or shrink over many
/// steps.
#[must_use]
pub fn unit_twist(mut t: Twist<f64>) -> Twist<f64> {
    let (w, v) = split_twist(&t);
    let size = match length(w) {
        0.0 => length(v),
        turn => turn,
    };
    t.iter_mut().for_each(|x| *x /= size);
    t
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

impl<N: Clone + PartialEq + Default> FrameValues<N> {
    /// Evaluates a frame: z = axis, x = reference·(z·z) - z·(z·reference), y = z × x.
    ///
    /// # Errors
    /// Returns an error if a coordinate has no value in the number system.
    pub fn new<S: Scalars<Number = N>>(s: &S, frame: &Frame) -> Result<Self, ExactError> {
        let vectors = [
            s.eval3(&frame.point)?,
            s.eval3(&frame.axis)?,
            s.eval3(&frame.reference)?,
        ];
        Ok(Self::from_vectors(s, vectors, s.eval(&frame.pitch)?))
    }

    /// Creates a frame from the values of its point, axis and reference.
    pub fn from_vectors<S: Scalars<Number = N>>(
        s: &S,
        [point, z, r]: [[N; 3]; 3],
        pitch: N,
    ) -> Self {
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

    /// Returns the motions of a joint with these freedoms that stay in a motion space, as a basis of twists.
    ///
    /// In a plane, freedoms that leave it are combined so that together they stay in it. For example, a ball turns
    /// about the plane's normal for any direction of its axes. A combination has the name of its last freedom. Freedoms
    /// that cannot be combined are omitted.
    pub fn motions_in_space<S: Scalars<Number = N>>(
        &self,
        s: &S,
        space: &MotionSpace<N>,
        freedoms: &[Freedom],
    ) -> Vec<(Freedom, Twist<N>)> {
        let MotionSpace::Planar { axes } = space else {
            return freedoms.iter().map(|&f| (f, self.twist_of(s, f))).collect();
        };
        // At the joint's own point, turns and slides do not mix.
        let point = [(); 3].map(|()| N::default());
        let here = FrameValues {
            point,
            ..self.clone()
        };
        let mut rest: Vec<_> = freedoms
            .iter()
            .map(|&f| (f, OutOfPlane::new(s, axes, here.twist_of(s, f))))
            .collect();
        for way in 0..3 {
            let Some(first) = rest.iter().position(|(_, m)| m.leaves_plane(s, way)) else {
                continue;
            };
            let (_, first) = rest.remove(first);
            for (_, motion) in rest.iter_mut().filter(|(_, m)| m.leaves_plane(s, way)) {
                *motion = motion.combine_with(s, &first, way);
            }
        }
        let at_origin = |t: Twist<N>| {
            let (w, v) = split_twist(&t);
            let arm = s.cross(self.point.clone(), w.clone());
            let v = [0, 1, 2].map(|i| s.add(v[i].clone(), arm[i].clone()));
            join_twist(w, v)
        };
        rest.into_iter()
            .map(|(f, m)| (f, at_origin(m.twist)))
            .collect()
    }

    /// Returns [`FrameValues::motions_in_space`] in the order of passage from the first link of the joint to the second. Slides
    /// come before turns. For a pin in a slot the turn comes first, because the slot belongs to the second link.
    pub fn motions_in_series<S: Scalars<Number = N>>(
        &self,
        s: &S,
        space: &MotionSpace<N>,
        freedoms: &[Freedom],
    ) -> Vec<(Freedom, Twist<N>)> {
        let mut all = self.motions_in_space(s, space, freedoms);
        let slot = freedoms.contains(&Freedom::Tx) && !freedoms.contains(&Freedom::Ty);
        all.sort_by_key(|(f, _)| f.is_slide() == slot);
        all
    }

    /// Returns [`FrameValues::motions_in_space`] in the components of the motion space.
    pub fn twists_in_space<S: Scalars<Number = N>>(
        &self,
        s: &S,
        space: &MotionSpace<N>,
        freedoms: &[Freedom],
    ) -> FreedomTwists<N> {
        let motions = self.motions_in_space(s, space, freedoms).into_iter();
        motions.map(|(f, t)| (f, space.along_axes(s, &t))).collect()
    }

    /// Returns the twist of one freedom.
    pub fn twist_of<S: Scalars<Number = N>>(&self, s: &S, freedom: Freedom) -> Twist<N> {
        let axis = self.axis(freedom);
        if freedom.is_slide() {
            let zero = || s.sub(self.point[0].clone(), self.point[0].clone());
            return join_twist([zero(), zero(), zero()], axis);
        }
        let turned = s.cross(self.point.clone(), axis.clone());
        let moved = match freedom {
            Freedom::Screw => s.scaled_sum(self.pitch.clone(), axis.clone(), turned),
            _ => turned,
        };
        join_twist(axis, moved)
    }

    /// Returns the axis that a freedom turns about or slides along.
    pub(crate) fn axis(&self, freedom: Freedom) -> [N; 3] {
        self.axes[freedom.axis()].clone()
    }
}

/// A motion of a joint about its point, with its parts out of the plane.
struct OutOfPlane<N> {
    twist: Twist<N>,
    /// The turns about the two axes perpendicular to the plane's normal, and the slide along it.
    ways: [N; 3],
    /// Squares of the reference sizes of these parts.
    sizes: [N; 3],
}

impl<N: Clone + PartialEq + Default> OutOfPlane<N> {
    fn new<S: Scalars<Number = N>>(s: &S, [n, e1, e2]: &[[N; 3]; 3], twist: Twist<N>) -> Self {
        let dot = |a: &[N; 3], b: &[N; 3]| s.dot(a.clone(), b.clone());
        let (w, v) = split_twist(&twist);
        let of = |a: &[N; 3], b: &[N; 3]| (dot(a, b), s.mul(dot(a, a), dot(b, b)));
        let all = [of(&w, e1), of(&w, e2), of(&v, n)];
        OutOfPlane {
            twist,
            ways: all.clone().map(|(way, _)| way),
            sizes: all.map(|(_, size)| size),
        }
    }

    /// Returns true if the motion leaves the plane in this part.
    fn leaves_plane<S: Scalars<Number = N>>(&self, s: &S, way: usize) -> bool {
        !s.vanishes(self.ways[way].clone(), self.sizes[way].clone())
    }

    /// Returns the combination of this motion and another that does not leave the plane in this part.
    fn combine_with<S: Scalars<Number = N>>(&self, s: &S, other: &Self, way: usize) -> Self {
        let (a, b) = (other.ways[way].clone(), self.ways[way].clone());
        let minus = s.sub(N::default(), b.clone());
        let sum = |[f, g]: [&N; 2], x: &N, y: &N| {
            s.add(s.mul(f.clone(), x.clone()), s.mul(g.clone(), y.clone()))
        };
        let squares = [s.mul(a.clone(), a.clone()), s.mul(b.clone(), b)];
        OutOfPlane {
            twist: std::array::from_fn(|i| sum([&a, &minus], &self.twist[i], &other.twist[i])),
            ways: std::array::from_fn(|i| sum([&a, &minus], &self.ways[i], &other.ways[i])),
            sizes: std::array::from_fn(|i| {
                sum(squares.each_ref(), &self.sizes[i], &other.sizes[i])
            }),
        }
    }
}

/// Freedoms, each with its twist.
pub type FreedomTwists<N> = Vec<(Freedom, Vec<N>)>;

/// Returns the motions of a joint in a motion space, see [`FrameValues::motions_in_space`].
///
/// # Errors
/// Returns an error if a coordinate has no value in the number system.
pub fn joint_twists<S: Scalars>(
    s: &S,
    space: &MotionSpace<S::Number>,
    frame: &Frame,
    joint_type: &JointType,
) -> Result<FreedomTwists<S::Number>, ExactError> {
    Ok(FrameValues::new(s, frame)?.twists_in_space(s, space, joint_type.freedoms()))
}
