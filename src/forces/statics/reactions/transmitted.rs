//! What joints and couplings pass on together, as the equations have it.

use crate::statics::reactions::geometry::{Geometry, Six, about};

/// Wrenches of the joints and unknowns of the couplings.
#[derive(Debug, Clone)]
pub(crate) struct Transmitted {
    /// By joint: all that goes from its first link to its second, what couplings pass there included.
    pub(crate) joints: Vec<Six>,
    /// By coupling of the state: x.
    pub(crate) couplings: Vec<f64>,
}

impl Transmitted {
    /// Wrenches of joints, and nothing in the couplings.
    pub(crate) fn of_joints(geometry: &Geometry, joints: Vec<Six>) -> Transmitted {
        Transmitted {
            joints,
            couplings: vec![0.0; geometry.couplings.len()],
        }
    }

    /// Adds wrenches that go round the contours, their coefficients in the basis, to those of the joints, and the coefficients
    /// behind them to the couplings.
    pub(crate) fn add_round(&mut self, geometry: &Geometry, coefficients: &[f64]) {
        let dim = geometry.basis.len();
        for (k, contour) in geometry.contours.iter().enumerate() {
            let mut round = [0.0; 6];
            for (b, x) in geometry.basis.iter().zip(&coefficients[k * dim..]) {
                for (r, y) in round.iter_mut().zip(b) {
                    *r += x * y;
                }
            }
            for &(j, forward) in &contour.joints {
                for (w, r) in self.joints[j].iter_mut().zip(&round) {
                    *w += if forward { *r } else { -r };
                }
            }
        }
        let of_couplings = &coefficients[dim * geometry.contours.len()..];
        for (x, c) in self.couplings.iter_mut().zip(of_couplings) {
            *x += c;
        }
    }

    /// What the joints bear and their drives do: without what couplings pass beside them.
    pub(crate) fn own(&self, geometry: &Geometry) -> Vec<Six> {
        let mut out = self.joints.clone();
        for (c, x) in geometry.couplings.iter().zip(&self.couplings) {
            for (n, end) in c.ends.iter().enumerate() {
                let beside = c.beside(n, c.meshes);
                for (w, b) in out[end.joint].iter_mut().zip(&beside) {
                    *w -= x * b;
                }
            }
        }
        out
    }

    /// All numbers one after another: each joint of the state about its own point, then the couplings.
    pub(crate) fn flat(&self, geometry: &Geometry) -> Vec<f64> {
        let own = self.own(geometry);
        let joints = geometry.joints.iter();
        joints
            .flat_map(|&j| about(&own[j], geometry.points[j]))
            .chain(self.couplings.iter().copied())
            .collect()
    }

    /// Adds a multiple of another.
    pub(crate) fn add(&mut self, factor: f64, other: &Transmitted) {
        let joints = self.joints.iter_mut().flatten();
        for (w, o) in joints.zip(other.joints.iter().flatten()) {
            *w += factor * o;
        }
        for (x, o) in self.couplings.iter_mut().zip(&other.couplings) {
            *x += factor * o;
        }
    }

    /// Multiplies all.
    pub(crate) fn scale(&mut self, factor: f64) {
        let joints = self.joints.iter_mut().flatten();
        joints.chain(&mut self.couplings).for_each(|x| *x *= factor);
    }
}
