//! A screw with nuts that jaws are, which moves out of any plane: in one a pinion with its racks does the same.

use crate::chains::pairs::chain::{Joint as PairJoint, PairChain, ordered};
use crate::chains::pairs::classics::MadeAs;
use crate::chains::pairs::kind::PairKind;
use crate::chains::pairs::roles::PairRoles;
use crate::chains::pairs::structure::PairStructure;
use crate::model::id::{LinkId, StateId};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Joint, Mechanism};
use crate::synthesis::recognize::found::{NoStructure, Recognized, jaws};
use itertools::Itertools;

/// The structure of a screw that is driven in the frame with two jaws on its threads, which slide in the frame; nothing of any other
/// mechanism.
///
/// # Errors
/// Where it has not two jaws.
pub(super) fn screw_with_nuts(m: &Mechanism) -> Result<Option<Recognized>, NoStructure> {
    let joints = m.joints_in(StateId::FREE).map(|j| &m.joints[j]);
    let (threads, others): (Vec<&Joint>, Vec<&Joint>) =
        joints.partition(|j| has(j, |f| f == Freedom::Screw));
    let [a, b] = threads[..] else {
        return Ok(None);
    };
    let Some(screw) = a.links.into_iter().find(|l| b.links.contains(l)) else {
        return Ok(None);
    };
    let nuts = [a, b].map(|j| {
        if j.links[0] == screw {
            j.links[1]
        } else {
            j.links[0]
        }
    });
    let frame = m.frame();
    let between = |link: LinkId| {
        let own = |j: &&Joint| j.links.contains(&frame) && j.links.contains(&link);
        others.iter().copied().filter(own).exactly_one().ok()
    };
    let is_held = between(screw).is_some_and(|j| j.drive && has(j, Freedom::turns));
    let are_guided = nuts
        .iter()
        .all(|&n| between(n).is_some_and(|j| has(j, Freedom::slides)));
    if others.len() != 3 || !is_held || !are_guided {
        return Ok(None);
    }
    let links = [frame, screw, nuts[0], nuts[1]];
    let place = |link: LinkId| links.iter().position(|l| *l == link);
    let joint = |(u, v, pair): (usize, usize, PairKind)| PairJoint {
        links: [u, v],
        pair,
    };
    let pairs = [
        (0, 1, PairKind::Hinge),
        (0, 2, PairKind::Slide),
        (0, 3, PairKind::Slide),
        (1, 2, PairKind::Gear),
        (1, 3, PairKind::Gear),
    ];
    let roles = PairRoles {
        frame: 0,
        input: [0, 1],
        jaws: ordered(jaws(m, place)?),
    };
    Ok((roles.jaws == [2, 3]).then(|| Recognized {
        structure: PairStructure {
            chain: PairChain::new(4, pairs.map(joint)),
            roles,
        },
        sides: 2,
        names: links.map(|l| vec![m.links[l].id.clone()]).into(),
        made_as: MadeAs {
            threaded: true,
            ..MadeAs::default()
        },
    }))
}

fn has(joint: &Joint, is: impl Fn(Freedom) -> bool) -> bool {
    joint.joint_type.freedoms().iter().any(|f| is(*f))
}
