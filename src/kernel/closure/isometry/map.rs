//! Maps of space in exact numbers.

use crate::closure::twist::{FrameValues, MotionSpace, joint_twists};
use crate::geom::Scalars;
use crate::geom::exact::{ExactError, ExactField};
use crate::geom::rigid::{join_twist, split_twist};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::model::joint_type::JointType;
use crate::model::mechanism::{Frame, Mode};

/// A joint type at a position, which determines the allowed motions.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedType<'a> {
    /// Its frame.
    pub frame: &'a Frame,
    /// The type.
    pub joint_type: &'a JointType,
}

/// Map of space: x maps to `linear`·x + `shift`, and lengths are preserved.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Map {
    /// Images of x, y and z.
    pub(super) linear: [[Residue; 3]; 3],
    /// Image of the origin.
    pub(super) shift: [Residue; 3],
    /// Whether the map reverses orientation.
    pub(super) reflects: bool,
}

impl Map {
    fn map_direction(&self, f: Field, v: [Residue; 3]) -> [Residue; 3] {
        [0, 1, 2].map(|i| {
            let columns = self.linear.iter().zip(v);
            f.sum_of_products(columns.map(|(c, x)| (c[i], x)))
        })
    }

    pub(super) fn maps_motions(
        &self,
        exact: &ExactField,
        mode: &Mode,
        from: PlacedType<'_>,
        to: PlacedType<'_>,
    ) -> Result<bool, ExactError> {
        let f = exact.field();
        // A turn about u is a turn about -u in a mirror. The body point at the origin is the image of that at the
        // shift.
        let image = |t: [Residue; 6]| {
            let (w, v) = split_twist(&t);
            let turned = self.map_direction(f, w);
            let w = if self.reflects {
                turned.map(|x| f.neg(x))
            } else {
                turned
            };
            let arm = exact.cross(self.shift, w);
            let v = self.map_direction(f, v);
            join_twist(w, [0, 1, 2].map(|i| f.add(v[i], arm[i])))
        };
        let space = MotionSpace::new(exact, mode)?;
        let freedoms = from.joint_type.freedoms();
        let values = FrameValues::new(exact, from.frame)?;
        let mut images = Echelon::new(f);
        for (_, twist) in values.motions_in_space(exact, &space, freedoms) {
            match space.components_in_space(exact, &image(twist)) {
                Some(t) => images.insert(&t),
                None => return Ok(false),
            };
        }
        let own = joint_twists(exact, &space, to.frame, to.joint_type)?;
        let own = Echelon::from_vectors(f, own.into_iter().map(|(_, t)| t));
        Ok(images.reduced_rows() == own.reduced_rows())
    }
}
