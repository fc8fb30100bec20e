//! The plane in which joints move, and the kind of each joint in that plane.

use crate::chains::PairKind;
use crate::closure::twist::FrameValues;
use crate::geom::Scalars;
use crate::geom::exact::ExactField;
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::JointId;
use crate::model::mechanism::{Joint, Mechanism, Mode};
use crate::rank::exact::field::exact_field;
use crate::synthesis::recognize::found::NoStructure;
use itertools::Itertools;
use std::cmp::Reverse;

/// The plane of motion, with the field of its numbers.
pub(super) struct MotionPlane {
    exact: ExactField,
    normal: [Residue; 3],
}

impl MotionPlane {
    /// Returns the planes in which joints may move, normal to the axes of turns. Planes in which the most joints move come first.
    pub(super) fn candidate_planes(
        m: &Mechanism,
        present: &[JointId],
    ) -> Result<(MotionPlane, Vec<[Residue; 3]>), NoStructure> {
        let exact = exact_field(m, 0)?;
        if let Mode::Planar { normal } = &m.mode {
            let normal = exact.eval3(normal)?;
            return Ok((MotionPlane { exact, normal }, vec![normal]));
        }
        let mut axes = Vec::new();
        let mut ways = Vec::new();
        for &j in present {
            let joint = &m.joints[j];
            let frame = FrameValues::new(&exact, &joint.frame)?;
            for freedom in joint.joint_type.freedoms() {
                let [x, y, z, a, b, c] = frame.twist_of(&exact, *freedom);
                if freedom.is_turn() {
                    axes.push([x, y, z]);
                } else {
                    ways.push([a, b, c]);
                }
            }
        }
        // Wedges have no turns, or none in their plane, so the normals to pairs of slides are candidates, too.
        let zero = [exact.field().zero(); 3];
        let two = ways.iter().tuple_combinations();
        axes.extend(two.map(|(a, b)| exact.cross(*a, *b)));
        let mut distinct: Vec<[Residue; 3]> = Vec::new();
        for axis in axes.into_iter().filter(|a| *a != zero) {
            if distinct.iter().all(|d| exact.cross(*d, axis) != zero) {
                distinct.push(axis);
            }
        }
        let mut plane = MotionPlane {
            exact,
            normal: zero,
        };
        let mut counted = Vec::with_capacity(distinct.len());
        for normal in distinct {
            plane.normal = normal;
            counted.push((plane.moving_count(m, present)?, normal));
        }
        counted.sort_by_key(|(moving, _)| Reverse(*moving));
        Ok((plane, counted.into_iter().map(|(_, n)| n).collect()))
    }

    /// Sets the normal.
    pub(super) fn turn_to(&mut self, normal: [Residue; 3]) {
        self.normal = normal;
    }

    /// Returns true if two joints are hinges at the same place in the plane.
    pub(super) fn are_on_one_pin(&self, joints: [Option<&Joint>; 2]) -> Result<bool, NoStructure> {
        let [Some(a), Some(b)] = joints else {
            return Ok(false);
        };
        let joints = [a, b];
        let kinds = [
            self.kind_in_plane(joints[0])?,
            self.kind_in_plane(joints[1])?,
        ];
        let [a, b] = joints.map(|j| FrameValues::new(&self.exact, &j.frame));
        let (a, b) = (a?.point, b?.point);
        let apart = [0, 1, 2].map(|k| self.exact.field().sub(a[k], b[k]));
        let zero = self.exact.field().zero();
        let along = self.exact.cross(apart, self.normal) == [zero; 3];
        Ok(along && kinds == [Some(PairKind::Hinge); 2])
    }

    /// Returns the number of joints of a known kind that move in the plane.
    fn moving_count(&self, m: &Mechanism, present: &[JointId]) -> Result<usize, NoStructure> {
        let mut out = 0;
        for &j in present {
            match self.kind_in_plane(&m.joints[j]) {
                Ok(kind) => out += usize::from(kind.is_some()),
                Err(NoStructure::Kind { .. }) => {}
                Err(e) => return Err(e),
            }
        }
        Ok(out)
    }

    fn span(&self, twists: impl IntoIterator<Item = [Residue; 6]>) -> Echelon {
        let mut out = Echelon::new(self.exact.field());
        for twist in twists {
            out.insert(&twist);
        }
        out
    }

    /// Returns the kind of a joint in the plane; `None` if it does not move there.
    pub(super) fn kind_in_plane(&self, joint: &Joint) -> Result<Option<PairKind>, NoStructure> {
        let frame = FrameValues::new(&self.exact, &joint.frame)?;
        let freedoms = joint.joint_type.freedoms();
        let twists = freedoms.iter().map(|&f| frame.twist_of(&self.exact, f));
        let twists = twists.collect_vec();
        // Dimension of the joint's motions in a space: dim U + dim V = dim (U + V) + dim (U ∩ V).
        let own = self.span(twists.iter().copied()).rank();
        let shared = |space: &[[Residue; 6]]| {
            let both = twists.iter().chain(space).copied();
            own + self.span(space.iter().copied()).rank() - self.span(both).rank()
        };
        let slides = self.two_slides();
        let turn = {
            let [x, y, z] = self.normal;
            let p = frame.point;
            let [a, b, c] = self.exact.cross(p, self.normal);
            [x, y, z, a, b, c]
        };
        let all = slides.into_iter().chain([turn]).collect_vec();
        let slides = shared(&slides);
        let turns = shared(&all) - slides;
        match (turns, slides) {
            (0, 0) => Ok(None),
            (1, 0) => Ok(Some(PairKind::Hinge)),
            (0, 1) => Ok(Some(PairKind::Slide)),
            (1, 1) => Ok(Some(PairKind::Slot)),
            _ => Err(NoStructure::Kind {
                joint: joint.id.clone(),
                turns,
                slides,
            }),
        }
    }

    /// Returns two independent slides normal to the plane's normal.
    fn two_slides(&self) -> [[Residue; 6]; 2] {
        let zero = self.exact.field().zero();
        let one = self.exact.field().one();
        let units = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        let across = units.map(|u| self.exact.cross(self.normal, u));
        let independent = across.into_iter().tuple_combinations().find(|&(a, b)| {
            let wide = |[x, y, z]: [Residue; 3]| [zero, zero, zero, x, y, z];
            self.span([wide(a), wide(b)]).rank() == 2
        });
        let (a, b) = independent.unwrap_or((units[0], units[1]));
        [a, b].map(|[x, y, z]| [zero, zero, zero, x, y, z])
    }
}
