//! The group of displacements each contour moves in, and when it proves that a motion is really there.
//!
//! The displacement round a contour is a product of its joints' displacements, so it stays in the group whose Lie algebra
//! the joints' twists generate under the bracket: 1 dimension for coaxial hinges, 3 for a planar or spherical contour,
//! 4 for a Schoenflies one, 6 in general [Hervé 1978]. Closing all contours is a map into the product of these groups.
//! Where J has the full rank of that product, the map is a submersion and the closed poses near this one form a
//! manifold of dimension f - rank J: the instantaneous mobility is then the finite one, proven, whatever σ is.

use crate::closure::contour::Contour;
use crate::closure::twist::FrameValues;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Residue;
use crate::model::mechanism::{JointId, Mechanism, Mode};

/// The bracket of two twists, [ω1 × ω2; ω1 × v2 + v1 × ω2].
pub(super) fn bracket(exact: &ExactField, a: &[Residue], b: &[Residue]) -> Vec<Residue> {
    use crate::geom::scalars::Scalars;
    let three = |t: &[Residue], at: usize| [t[at], t[at + 1], t[at + 2]];
    let (wa, va, wb, vb) = (three(a, 0), three(a, 3), three(b, 0), three(b, 3));
    let w = exact.cross(wa, wb);
    let (p, q) = (exact.cross(wa, vb), exact.cross(va, wb));
    let field = exact.field();
    let v = [0, 1, 2].map(|i| field.add(p[i], q[i]));
    vec![w[0], w[1], w[2], v[0], v[1], v[2]]
}

/// Six-component twists of a joint's freedoms, those that planar mode keeps.
pub(super) fn spatial_twists(
    exact: &ExactField,
    mechanism: &Mechanism,
    joint: JointId,
) -> Result<Vec<Vec<Residue>>, ExactError> {
    let joint = &mechanism.joints[joint];
    let values = FrameValues::new(exact, &joint.frame)?;
    Ok(joint
        .joint_type
        .freedoms()
        .iter()
        .map(|&f| values.twist(exact, f).to_vec())
        .collect())
}

/// Dimension of the group a contour's displacements generate. In planar mode at most 3.
///
/// # Errors
/// Where a coordinate has no value in the field.
///
/// # Complexity
/// At most 15 brackets of at most 6 independent twists.
pub fn group_dimension(
    exact: &ExactField,
    mechanism: &Mechanism,
    contour: &Contour,
) -> Result<usize, ExactError> {
    let mut algebra = Echelon::new(exact.field());
    let mut basis: Vec<Vec<Residue>> = Vec::new();
    if let Mode::Planar { normal } = &mechanism.mode {
        // Three rows: turning about the normal and sliding across it. Two slides alone commute.
        let space = crate::closure::twist::MotionSpace::new(
            exact,
            &Mode::Planar {
                normal: normal.clone(),
            },
        )?;
        let mut turning = false;
        for &(j, _) in &contour.joints {
            let joint = &mechanism.joints[j];
            for (_, t) in
                crate::closure::twist::joint_twists(exact, &space, &joint.frame, &joint.joint_type)?
            {
                turning |= t[0] != 0;
                algebra.insert(&t);
            }
        }
        // The bracket of two turns about different points is a slide, of a turn and a slide the slide across it.
        return Ok(match (turning, algebra.rank()) {
            (true, r) if r > 1 => 3,
            (_, r) => r,
        });
    }
    for &(j, _) in &contour.joints {
        for t in spatial_twists(exact, mechanism, j)? {
            if algebra.insert(&t) {
                basis.push(t);
            }
        }
    }
    let mut next = 0;
    while next < basis.len() && basis.len() < 6 {
        for other in 0..next {
            let t = bracket(exact, &basis[next], &basis[other]);
            if algebra.insert(&t) {
                basis.push(t);
            }
        }
        next += 1;
    }
    Ok(basis.len())
}
