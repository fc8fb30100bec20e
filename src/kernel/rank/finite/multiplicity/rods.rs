//! A platform on rods that end in balls.
//!
//! Its displacements are the points of Study's quadric in seven dimensions, and each rod keeps it on another quadric
//! [Husty 1996]. So the poses that 6 - n of them allow meet n - 1 hyperplanes and one more quadric in at most 2^(8 - n)
//! points.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::rank;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::rank::finite::displacement_group::spatial_twists;

/// Returns the highest order that can stop a platform on rods, or `None` for other mechanisms.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
pub(super) fn bound(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
    instantaneous: usize,
) -> Result<Option<usize>, ExactError> {
    let joints: Vec<JointId> = mechanism.joints_in(closure.state).collect();
    let at = |l: LinkId| -> Vec<JointId> {
        let here = |j: &&JointId| mechanism.joints[**j].links.contains(&l);
        joints.iter().filter(here).copied().collect()
    };
    let (mut rods, mut bodies) = (0, 0);
    for link in mechanism.link_ids() {
        match at(link)[..] {
            [] => {}
            [a, b] if is_rod(exact, mechanism, [a, b])? => rods += 1,
            _ => bodies += 1,
        }
    }
    let platform = bodies == 2 && joints.len() == 2 * rods;
    let power = u32::try_from(instantaneous)
        .ok()
        .and_then(|n| 8u32.checked_sub(n));
    Ok(power.filter(|_| platform).map(|p| 1 << p))
}

/// Returns true if two joints turn about one point each, so that a link between them only keeps those points at a fixed
/// distance.
fn is_rod(
    exact: &ExactField,
    mechanism: &Mechanism,
    joints: [JointId; 2],
) -> Result<bool, ExactError> {
    let mut twists = Vec::new();
    for j in joints {
        let freedoms = mechanism.joints[j].joint_type.freedoms();
        if !freedoms.iter().all(|f| f.turns()) {
            return Ok(false);
        }
        twists.extend(spatial_twists(exact, mechanism, j)?);
    }
    Ok(twists.len() == 5 && rank(exact.field(), twists.iter().map(Vec::as_slice)) == 5)
}
