//! The wrench of a self-stress on each joint, in any number system.

use crate::closure::Closure;
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::Scalars;
use crate::geom::exact::ExactError;
use crate::model::mechanism::{JointId, Mechanism};

/// A wrench about the global origin, (m; f) in global axes.
pub(super) type Wrench<N> = [N; 6];

/// The wrenches of the joints of a state under self-stresses.
///
/// A self-stress of planar mode has three numbers per contour, a moment about the plane's normal n and forces along the
/// e1 and e2 of [`MotionSpace`]. As a wrench in space this is (μ n; f1 e1 + f2 e2), whose power on any twist in the
/// plane is the same.
pub(super) struct JointWrenches<'a, S: Scalars> {
    s: &'a S,
    dim: usize,
    space: MotionSpace<S::Number>,
    frames: Vec<FrameValues<S::Number>>,
    /// For each joint, the contours that pass it, and whether forward.
    passes: Vec<Vec<(usize, bool)>>,
}

impl<'a, S: Scalars> JointWrenches<'a, S> {
    /// Prepares the joints of a mechanism, with the contours of any closure of the state.
    pub(super) fn new<N>(
        s: &'a S,
        m: &Mechanism,
        closure: &Closure<N>,
    ) -> Result<Self, ExactError> {
        let mut passes = vec![Vec::new(); m.joints.len()];
        for (i, c) in closure.contours.iter().enumerate() {
            for &(j, forward) in &c.joints {
                passes[j].push((i, forward));
            }
        }
        let frames = m.joints.iter().map(|j| FrameValues::new(s, &j.frame));
        Ok(JointWrenches {
            s,
            dim: closure.dim,
            space: MotionSpace::new(s, &m.mode)?,
            frames: frames.collect::<Result<_, _>>()?,
            passes,
        })
    }

    fn zero(&self) -> [S::Number; 3] {
        std::array::from_fn(|_| S::Number::default())
    }

    /// Returns the wrench of a self-stress on a joint.
    pub(super) fn at(&self, stress: &[S::Number], joint: JointId) -> Wrench<S::Number> {
        let s = self.s;
        let mut sum = vec![S::Number::default(); self.dim];
        for &(i, forward) in &self.passes[joint] {
            let block = &stress[i * self.dim..(i + 1) * self.dim];
            for (x, b) in sum.iter_mut().zip(block) {
                *x = if forward {
                    s.add(x.clone(), b.clone())
                } else {
                    s.sub(x.clone(), b.clone())
                };
            }
        }
        let (m, f) = match (&self.space, &sum[..]) {
            (MotionSpace::Planar { axes: [n, e1, e2] }, [turn, along, across]) => {
                let first = s.scaled_sum(along.clone(), e1.clone(), self.zero());
                (
                    s.scaled_sum(turn.clone(), n.clone(), self.zero()),
                    s.scaled_sum(across.clone(), e2.clone(), first),
                )
            }
            (_, sum) => {
                let part = |from: usize| std::array::from_fn(|i| sum[from + i].clone());
                (part(0), part(3))
            }
        };
        let ([a, b, c], [d, e, g]) = (m, f);
        [a, b, c, d, e, g]
    }

    /// Returns the moment of a wrench about the joint's point, m - p × f. In a plane it is the part along the normal,
    /// times [`Self::scale`].
    pub(super) fn moment_at(&self, joint: JointId, w: &Wrench<S::Number>) -> [S::Number; 3] {
        let s = self.s;
        let [m0, m1, m2, f0, f1, f2] = w.clone();
        let arm = s.cross(self.frames[joint].point.clone(), [f0, f1, f2]);
        let [a0, a1, a2] = arm;
        let moment = [s.sub(m0, a0), s.sub(m1, a1), s.sub(m2, a2)];
        match &self.space {
            MotionSpace::Spatial => moment,
            MotionSpace::Planar { axes: [n, ..] } => {
                s.scaled_sum(s.dot(n.clone(), moment), n.clone(), self.zero())
            }
        }
    }

    /// Returns the factor of [`Self::moment_at`] in a plane, n · n, or `None` in space.
    pub(super) fn scale(&self) -> Option<S::Number> {
        match &self.space {
            MotionSpace::Spatial => None,
            MotionSpace::Planar { axes: [n, ..] } => Some(self.s.dot(n.clone(), n.clone())),
        }
    }

    /// Returns the components of a self-stress at a face (z its normal) other than friction: a normal force and, if
    /// requested, tangential moments.
    pub(super) fn harm(
        &self,
        stress: &[S::Number],
        joint: JointId,
        moments: bool,
    ) -> Vec<S::Number> {
        let (s, w) = (self.s, self.at(stress, joint));
        let m = self.moment_at(joint, &w);
        let [x, y, z] = self.frames[joint].axes.clone();
        let [_, _, _, f0, f1, f2] = w;
        let mut out = vec![s.dot([f0, f1, f2], z)];
        if moments {
            out.extend([s.dot(m.clone(), x), s.dot(m, y)]);
        }
        out
    }
}
