//! Self-stresses: the wrenches that an over-constrained mechanism carries with no load at all, once a part is a little
//! out of true. They are the left null vectors of the closure matrix; each row block is the wrench that a contour
//! passes round, and the entry of a coupling's row the force or moment that it passes from one joint to the other.

use crate::closure::matrix::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::linalg::echelon::{Echelon, relations, transpose};
use crate::linalg::modp::Residue;
use crate::model::joint_type::JointType;
use crate::model::mechanism::{JointId, Mechanism};
use crate::redundancy::borne::{Faces, Shares};
use crate::redundancy::joint_wrench::JointWrenches;
use itertools::Itertools;

/// What a self-stress does to the parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Only friction at the faces of shared-load contacts: forces along them, or a moment about their normal.
    Harmless,
    /// Moments that faces or bearings must carry, or forces that press parts together.
    Harmful,
}

/// Components of a wrench at a joint, as moments and forces along the global axes.
#[derive(Debug, Clone, PartialEq)]
pub struct JointWrench {
    /// The joint.
    pub joint: JointId,
    /// Which of the moments about x, y, z through the joint's point are not zero.
    pub moments: [bool; 3],
    /// Which of the forces along x, y, z are not zero.
    pub forces: [bool; 3],
    /// Its part of Σ |f|² + |m|²/ℓ² over all joints, about their own points, ℓ the size of the mechanism: what it bears of
    /// the stress in joints alike. `None` where that is left uncomputed, see [`Shares`].
    pub share: Option<f64>,
}

/// One self-stress of a basis.
#[derive(Debug, Clone)]
pub struct SelfStress {
    /// Indices of the contours that pass a wrench round.
    pub contours: Vec<usize>,
    /// Indices of the couplings that pass a force or moment from joint to joint, among those of the state.
    pub couplings: Vec<usize>,
    /// What each joint of those contours carries, its couplings included.
    pub joints: Vec<JointWrench>,
    /// Whether the self-stress exists only with the state's additional joints.
    pub external: bool,
    /// Harmless or harmful.
    pub verdict: Verdict,
}

/// The left kernel of J in the echelon form that keeps to the earliest contours it can: each vector ends in a one that
/// no other vector has an entry at, and they are sorted by where they end.
///
/// # Complexity
/// One elimination of J by rows, see [`relations`].
#[must_use]
pub fn stress_basis(exact: &ExactField, closure: &Closure<Residue>) -> Vec<Vec<Residue>> {
    let columns = closure.dense(exact);
    let mut rows = if columns.is_empty() {
        vec![vec![0]; closure.rows()]
    } else {
        transpose(&columns)
    };
    // Reversing the order of coordinates makes the reduced form keep to the earliest contours it can.
    rows.reverse();
    let mut stresses = relations(exact.field(), &rows);
    stresses.iter_mut().for_each(|v| v.reverse());
    stresses.reverse();
    stresses
}

/// A sparse basis of the self-stresses of a state: those of the free state's contours first, then those that need the
/// additional ones; among the latter, friction at the contacts first.
///
/// # Errors
/// Where a coordinate has no value in the field.
///
/// # Complexity
/// One elimination of J, O((6k)² f), and one per joint and stress.
pub fn self_stresses(
    exact: &ExactField,
    mechanism: &Mechanism,
    closure: &Closure<Residue>,
) -> Result<Vec<SelfStress>, ExactError> {
    let f = exact.field();
    let stresses = stress_basis(exact, closure);
    let added: Vec<JointId> = mechanism.joints_added_in(closure.state).collect();
    let wrenches = JointWrenches::new(exact, mechanism, closure)?;
    let wrench = |stress: &[Residue], j: JointId| wrenches.at(stress, j);
    let needs_contacts =
        |s: &[Residue]| added.iter().any(|&j| wrench(s, j).iter().any(|&x| x != 0));
    let (external, internal): (Vec<_>, Vec<_>) =
        stresses.into_iter().partition(|s| needs_contacts(s));
    let faces: Vec<JointId> = added
        .iter()
        .copied()
        .filter(|&j| mechanism.joints[j].joint_type == JointType::Fixed)
        .collect();
    // Forces along two faces apart are a couple that one of them must take up as a shift of pressure, so moments are
    // judged at one face: the one that shows most friction.
    let harm_at = |s: &[Residue], reference: Option<JointId>| -> Vec<Residue> {
        let part = |&j: &JointId| wrenches.harm(s, j, Some(j) == reference);
        faces.iter().flat_map(part).collect()
    };
    let friction = |reference: Option<JointId>| {
        let images: Vec<Vec<Residue>> = external.iter().map(|s| harm_at(s, reference)).collect();
        relations(f, &images).len()
    };
    let reference = faces
        .iter()
        .copied()
        .rev()
        .max_by_key(|&j| friction(Some(j)));
    let harm = |s: &[Residue]| harm_at(s, reference);
    let external = friction_first(exact, external, &harm);
    let mut shares = Shares::new(mechanism, closure)?;
    let at_faces = Faces {
        joints: &faces,
        reference,
    };
    let mut describe = |s: &Vec<Residue>, is_external: bool| {
        let contours = (0..closure.contours.len())
            .filter(|i| {
                s[i * closure.dim..(i + 1) * closure.dim]
                    .iter()
                    .any(|&x| x != 0)
            })
            .collect_vec();
        let couplings = (0..closure.couplings.len())
            .filter(|q| s[closure.contour_rows() + q] != 0)
            .collect();
        let friction = is_external && !faces.is_empty() && harm(s).iter().all(|&x| x == 0);
        let borne = shares.of(s, friction.then_some(at_faces));
        let joints = mechanism.joints_in(closure.state).filter_map(|j| {
            let w = wrench(s, j);
            let nonzero = |v: [Residue; 3]| v.map(|x| x != 0);
            w.iter().any(|&x| x != 0).then(|| JointWrench {
                joint: j,
                moments: nonzero(wrenches.moment_at(j, &w)),
                forces: nonzero([w[3], w[4], w[5]]),
                share: borne.as_ref().map(|b| b[j]),
            })
        });
        SelfStress {
            contours,
            couplings,
            joints: joints.collect(),
            external: is_external,
            verdict: if friction {
                Verdict::Harmless
            } else {
                Verdict::Harmful
            },
        }
    };
    let internal = internal.iter().map(|s| (s, false));
    let all = internal.chain(external.iter().map(|s| (s, true)));
    Ok(all
        .map(|(s, is_external)| describe(s, is_external))
        .collect())
}

/// A basis of the same space that begins with a basis of the stresses without harm.
fn friction_first(
    exact: &ExactField,
    stresses: Vec<Vec<Residue>>,
    harm: &dyn Fn(&[Residue]) -> Vec<Residue>,
) -> Vec<Vec<Residue>> {
    let f = exact.field();
    let images: Vec<Vec<Residue>> = stresses.iter().map(|s| harm(s)).collect();
    if images.iter().all(Vec::is_empty) {
        return stresses;
    }
    let mut span = Echelon::new(f);
    let mut out = Vec::new();
    let harmless = relations(f, &images).into_iter().map(|combination| {
        let mut sum = vec![0; stresses[0].len()];
        for (&a, s) in combination.iter().zip(&stresses).filter(|(a, _)| **a != 0) {
            sum.iter_mut()
                .zip(s)
                .for_each(|(o, &x)| *o = f.add(*o, f.mul(a, x)));
        }
        sum
    });
    for s in harmless
        .collect_vec()
        .into_iter()
        .chain(stresses.iter().cloned())
    {
        if span.insert(&s) {
            out.push(s);
        }
    }
    out
}
