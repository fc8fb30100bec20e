//! Planes that contain joints, and the parts of a twist in such a plane and out of it.
//!
//! # Sources
//! The two parts: Hunt, "Kinematic Geometry of Mechanisms" (1978), planar and out-of-plane freedoms of planar linkages.

use crate::closure::twist::FrameValues;
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::model::mechanism::{JointId, Mechanism};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// A plane: its normal, scaled so that the first nonzero entry is one, and its distance from the origin along that
/// normal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Plane {
    pub(crate) normal: [Residue; 3],
    distance: Residue,
}

/// Three rows of a twist, as functions of its six numbers.
pub(crate) type Rows = [[Residue; 6]; 3];

/// Number of planes examined, those of most frames first.
const PLANES: usize = 8;

/// Returns the planes perpendicular to the axes of some joints' frames, through their points, those of most joints
/// first.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
pub(crate) fn planes_of_joints(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: impl IntoIterator<Item = JointId>,
) -> Result<Vec<Plane>, ExactError> {
    let f = exact.field();
    let mut counted: BTreeMap<Plane, usize> = BTreeMap::new();
    for joint in joints {
        let frame = FrameValues::new(exact, &mechanism.joints[joint].frame)?;
        for axis in frame.axes {
            let Some(&first) = axis.iter().find(|x| **x != 0) else {
                continue;
            };
            let scale = f.inv(first);
            let normal = axis.map(|x| f.mul(x, scale));
            let distance = exact.dot(normal, frame.point);
            *counted.entry(Plane { normal, distance }).or_default() += 1;
        }
    }
    let mut all: Vec<(Plane, usize)> = counted.into_iter().collect();
    all.sort_by_key(|&(plane, times)| (Reverse(times), plane));
    Ok(all.into_iter().map(|(p, _)| p).take(PLANES).collect())
}

impl Plane {
    /// Returns the three rows of a twist in the plane, and the three out of it. Returns `None` in the rare case that
    /// they are dependent modulo the prime.
    pub(crate) fn split_rows(self, exact: &ExactField) -> Option<[Rows; 2]> {
        let (f, n) = (exact.field(), self.normal);
        let size = exact.dot(n, n);
        if size == 0 {
            return None;
        }
        let across = |i: usize| exact.cross(n, [0, 1, 2].map(|j| if i == j { f.one() } else { 0 }));
        let e1 = [0, 1].map(across).into_iter().find(|e| *e != [0; 3])?;
        let e2 = exact.cross(n, e1);
        let share = f.mul(self.distance, f.inv(size));
        let foot = n.map(|x| f.mul(x, share));
        let turn = |[x, y, z]: [Residue; 3]| [x, y, z, 0, 0, 0];
        // The velocity of the plane's point nearest the origin is v + ω × foot, and (ω × foot) · e = ω · (foot × e).
        let slide = |e: [Residue; 3]| {
            let ([a, b, c], [x, y, z]) = (exact.cross(foot, e), e);
            [a, b, c, x, y, z]
        };
        let out = [
            [turn(n), slide(e1), slide(e2)],
            [turn(e1), turn(e2), slide(n)],
        ];
        let mut all = Echelon::new(f);
        out.iter()
            .flatten()
            .all(|row| all.insert(row))
            .then_some(out)
    }
}

/// Returns a twist in three rows.
pub(crate) fn twist_in_rows(f: Field, rows: &Rows, twist: &[Residue]) -> [Residue; 3] {
    rows.map(|row| f.sum_of_products(row.into_iter().zip(twist.iter().copied())))
}
