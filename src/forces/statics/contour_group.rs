//! The four-link group with a closed contour, as a separate problem.
//!
//! Letters are those of the shears in `[Bychkov, Dvornikov & Zhukov 2018]`. The ternary link 4 is attached at D and carries rods 6 (F to M)
//! and 7 (K to L). These carry the slider 10 on its guide. In any other mechanism, 4, 6, 7 and 10 are the corresponding links. Three
//! methods solve it ([`solutions`]): the published [`delta_point`], its form in homogeneous coordinates ([`projective`]), and the twelve
//! [`equilibrium`] equations, in doubles and exactly.

pub mod delta_point;
pub mod equilibrium;
pub mod pose;
pub mod projective;
pub mod solutions;

use crate::statics::assur::Group;
use crate::statics::assur_class::Kind;
use crate::statics::planar::{BodyId, PairId, PairKind, PlanarMechanism};

/// Assignment of the letters in a mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ContourGroup {
    /// Link 4, with three turning pairs.
    pub ternary: BodyId,
    /// Links 6 and 7.
    pub rods: [BodyId; 2],
    /// Link 10, with the guide.
    pub slider: BodyId,
    /// D, the outer turning pair of link 4.
    pub d: PairId,
    /// F, between 4 and 6.
    pub f: PairId,
    /// K, between 4 and 7.
    pub k: PairId,
    /// M, between 6 and 10.
    pub m: PairId,
    /// L, between 7 and 10.
    pub l: PairId,
    /// The outer sliding pair of link 10.
    pub guide: PairId,
}

/// Finds the letters in a group. Returns `None` for groups of another kind, and those with a drive inside.
#[must_use]
pub(crate) fn recognise_letters(m: &PlanarMechanism, group: &Group) -> Option<ContourGroup> {
    if group.class.kind != Kind::FourLinkContour || !group.locked.is_empty() {
        return None;
    }
    let turns = |p: &PairId| m.pairs[*p].kind == PairKind::Turning;
    let (d, guide) = match group.outer[..] {
        [a, b] if turns(&a) && m.pairs[b].kind == PairKind::Sliding => (a, b),
        [a, b] if turns(&b) && m.pairs[a].kind == PairKind::Sliding => (b, a),
        _ => return None,
    };
    if !group.inner.iter().all(turns) {
        return None;
    }
    let mine = |p: PairId| {
        m.pairs[p]
            .bodies
            .into_iter()
            .find(|b| group.bodies.contains(b))
    };
    let (ternary, slider) = (mine(d)?, mine(guide)?);
    let at = |b: BodyId| {
        group
            .inner
            .iter()
            .copied()
            .filter(move |&p| m.pairs[p].bodies.contains(&b))
    };
    let (f, k) = (at(ternary).next()?, at(ternary).nth(1)?);
    let rods = [
        m.pairs[f].other_body(ternary)?,
        m.pairs[k].other_body(ternary)?,
    ];
    let foot = |rod: BodyId| at(rod).find(|&p| m.pairs[p].other_body(rod) == Some(slider));
    Some(ContourGroup {
        ternary,
        rods,
        slider,
        d,
        f,
        k,
        m: foot(rods[0])?,
        l: foot(rods[1])?,
        guide,
    })
}
