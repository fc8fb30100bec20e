//! Three equal sides, all in one plane with frame and driver, or each in a separate plane. Their structure is that of two of them.

use crate::chains::chain::{Chain, Joint as PairJoint, order_links};
use crate::chains::classics::MadeAs;
use crate::chains::roles::Roles;
use crate::chains::structure::PairStructure;
use crate::model::mechanism::{Mechanism, Role};
use crate::model::{JointId, LinkId, StateId};
use crate::synthesis::recognize::found::{NoStructure, Recognized};
use crate::synthesis::recognize::in_plane::InPlane;
use itertools::Itertools;
use petgraph::unionfind::UnionFind;

/// Returns the structure of two sides of a gripper with three. `None` if it has not three jaws, or if its sides are joined, differ, or are
/// not all of it.
///
/// # Errors
/// Returns an error if a side has no structure.
pub(super) fn three_sides(m: &Mechanism) -> Result<Option<Recognized>, NoStructure> {
    let jaws = m.links_with_ids().filter(|(_, l)| l.role == Role::Output);
    let jaws = jaws.map(|(l, _)| l).collect_vec();
    if jaws.len() != 3 {
        return Ok(None);
    }
    let all = m.joints_in(StateId::FREE).collect_vec();
    let driven = all.iter().filter(|&&j| m.joints[j].drive);
    let Some(drive) = driven.exactly_one().ok().map(|&j| &m.joints[j]) else {
        return Err(NoStructure::Jaws(3));
    };
    let once = |l: LinkId| l == m.frame_link() || drive.links.contains(&l);
    let mut parts = UnionFind::<usize>::new(m.links.len());
    for &j in &all {
        let [a, b] = m.joints[j].links;
        if !once(a) && !once(b) {
            parts.union(a.index(), b.index());
        }
    }
    for coupling in m.couplings_in(StateId::FREE) {
        let links = coupling.ends.iter().flat_map(|e| m.joints[e.joint].links);
        let own = links.filter(|l| !once(*l)).map(LinkId::index);
        for (a, b) in own.tuple_windows() {
            parts.union(a, b);
        }
    }
    let held = jaws.iter().map(|j| parts.find(j.index())).collect_vec();
    let links = all.iter().flat_map(|&j| m.joints[j].links);
    let mut others = links.filter(|l| !once(*l));
    // A link on no side, other than frame and driver, is not repeated: there are not three sides.
    let on_sides = others.all(|l| held.contains(&parts.find(l.index())));
    if !on_sides || !held.iter().all_unique() {
        return Ok(None);
    }
    let side = |jaw: LinkId| -> Result<Recognized, NoStructure> {
        let part = parts.find(jaw.index());
        let own = |l: &LinkId| once(*l) || parts.find(l.index()) == part;
        let present = all.iter().copied();
        let present = present.filter(|&j| m.joints[j].links.iter().all(own));
        one_side(m, &present.collect_vec(), jaw, once)
    };
    let found = jaws.iter().map(|&jaw| side(jaw));
    let found: Vec<Recognized> = found.collect::<Result<_, _>>()?;
    let mut alike = found
        .iter()
        .map(|f| (f.structure.canonical_key(), f.made_as));
    let alike = alike.all_equal();
    Ok(found.into_iter().next().filter(|_| alike))
}

/// Returns the structure of a side with one image, and with two.
fn one_side(
    m: &Mechanism,
    present: &[JointId],
    jaw: LinkId,
    once: impl Fn(LinkId) -> bool,
) -> Result<Recognized, NoStructure> {
    let one = InPlane::new(m, present)?;
    let stands_once = m.link_ids().filter(|l| once(*l));
    let stands_once = stands_once.filter_map(|l| one.body(l)).collect_vec();
    let side_of = &one.links;
    let links = side_of.names.len();
    let side = (0..links)
        .filter(|l| !stands_once.contains(l))
        .collect_vec();
    let jaw = one.body(jaw).filter(|j| side.contains(j));
    let jaw = jaw.ok_or(NoStructure::Jaws(3))?;
    let image = |l: usize, copy: usize| {
        let at = side.iter().position(|&s| s == l).filter(|_| copy > 0);
        at.map_or(l, |at| links + (copy - 1) * side.len() + at)
    };
    let carried = |(copy, j): (usize, &PairJoint)| {
        let links = order_links(j.links.map(|l| image(l, copy)));
        let pair = j.pair;
        // A joint between links that are not repeated is not repeated.
        (copy == 0 || links != j.links).then_some(PairJoint { links, pair })
    };
    let of = |sides: usize| {
        let joints = (0..sides).cartesian_product(&side_of.joints);
        PairStructure {
            chain: Chain::new(links + (sides - 1) * side.len(), joints.filter_map(carried)),
            roles: Roles {
                frame: side_of.frame,
                input: side_of.input,
                jaws: (0..sides).map(|copy| image(jaw, copy)).collect(),
            },
        }
    };
    let names = side.iter().map(|&l| side_of.names[l].clone());
    Ok(Recognized {
        structure: of(2),
        whole: of(3),
        made_as: MadeAs {
            flat: side_of.flat,
            ..MadeAs::default()
        },
        names: side_of.names.iter().cloned().chain(names).collect(),
    })
}
