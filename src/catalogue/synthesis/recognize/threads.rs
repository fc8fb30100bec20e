//! A screw with nuts as jaws. It moves out of any plane; a pinion with its racks is the equivalent in a plane.

use crate::chains::PairKind;
use crate::chains::chain::{Chain, Joint as PairJoint};
use crate::chains::classics::MadeAs;
use crate::chains::roles::Roles;
use crate::chains::structure::PairStructure;
use crate::closure::twist::FrameValues;
use crate::geom::Scalars;
use crate::geom::exact::ExactField;
use crate::linalg::modp::Residue;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Joint, Mechanism};
use crate::model::{LinkId, StateId};
use crate::rank::exact::field::exact_field;
use crate::synthesis::recognize::found::{NoStructure, Recognized, jaw_links};
use itertools::Itertools;

/// Planar equivalent of a screw with two nuts in the frame. Links: frame, screw, nuts.
const PAIRS: [(usize, usize, PairKind); 5] = [
    (0, 1, PairKind::Hinge),
    (0, 2, PairKind::Slide),
    (0, 3, PairKind::Slide),
    (1, 2, PairKind::Gear),
    (1, 3, PairKind::Gear),
];

/// Axis of a joint along the screw: its direction, a point on it, and for a thread the pitch. The pitch is the travel per radian times the
/// squared length of the direction.
struct Axis {
    way: [Residue; 3],
    at: [Residue; 3],
    pitch: Residue,
}

impl Axis {
    fn of(
        exact: &ExactField,
        joint: &Joint,
        is: impl Fn(Freedom) -> bool,
    ) -> Result<Axis, NoStructure> {
        let frame = FrameValues::new(exact, &joint.frame)?;
        let mut freedoms = joint.joint_type.freedoms().iter().copied();
        let freedom = freedoms.find(|f| is(*f)).unwrap_or(Freedom::Rz);
        let [x, y, z, a, b, c] = frame.twist_of(exact, freedom);
        let field = exact.field();
        let along = |p: [Residue; 3], q: [Residue; 3]| {
            let terms = p.into_iter().zip(q).map(|(p, q)| field.mul(p, q));
            terms.fold(field.zero(), |sum, t| field.add(sum, t))
        };
        let slides = [x, y, z] == [field.zero(); 3];
        Ok(Axis {
            way: if slides { [a, b, c] } else { [x, y, z] },
            at: frame.point,
            pitch: along([x, y, z], [a, b, c]),
        })
    }

    fn is_parallel(&self, exact: &ExactField, other: &Axis) -> bool {
        exact.cross(self.way, other.way) == [exact.field().zero(); 3]
    }

    fn is_on(&self, exact: &ExactField, other: &Axis) -> bool {
        let field = exact.field();
        let apart = [0, 1, 2].map(|k| field.sub(self.at[k], other.at[k]));
        self.is_parallel(exact, other) && exact.cross(apart, other.way) == [field.zero(); 3]
    }
}

/// Returns true if two nuts that slide along a screw move in opposite directions as it turns.
fn go_apart(
    m: &Mechanism,
    bearing: &Joint,
    threads: [&Joint; 2],
    guides: [&Joint; 2],
) -> Result<bool, NoStructure> {
    let exact = exact_field(m, 0)?;
    let screw = Axis::of(&exact, bearing, Freedom::is_turn)?;
    let [a, b] = threads.map(|j| Axis::of(&exact, j, |f| f == Freedom::Screw));
    let (a, b) = (a?, b?);
    let zero = exact.field().zero();
    let opposite = a.pitch != zero && exact.field().add(a.pitch, b.pitch) == zero;
    let mut fits = opposite && a.is_on(&exact, &screw) && b.is_on(&exact, &screw);
    for guide in guides {
        let guide = Axis::of(&exact, guide, Freedom::is_slide)?;
        fits &= guide.is_parallel(&exact, &screw);
    }
    Ok(fits)
}

/// Returns the structure of a screw that is driven in the frame. Its jaws are nuts on a right and a left thread that slide along it in the
/// frame. `None` for any other mechanism.
///
/// # Errors
/// Returns an error if it has not two jaws.
pub(super) fn screw_with_nuts(m: &Mechanism) -> Result<Option<Recognized>, NoStructure> {
    let joints = m.joints_in(StateId::FREE).map(|j| &m.joints[j]);
    let (threads, others): (Vec<&Joint>, Vec<&Joint>) = joints.partition(|j| is_thread(j));
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
    let frame = m.frame_link();
    let between = |link: LinkId| {
        let own = |j: &&Joint| j.links.contains(&frame) && j.links.contains(&link);
        others.iter().copied().filter(own).exactly_one().ok()
    };
    let [Some(bearing), Some(one), Some(two)] = [screw, nuts[0], nuts[1]].map(between) else {
        return Ok(None);
    };
    let guides = [one, two];
    let is_driven = bearing.drive && has(bearing, Freedom::is_turn);
    let fits = others.len() == 3 && is_driven && guides.iter().all(|j| has(j, Freedom::is_slide));
    if !fits || !go_apart(m, bearing, [a, b], guides)? {
        return Ok(None);
    }
    let links = [frame, screw, nuts[0], nuts[1]];
    let place = |link: LinkId| links.iter().position(|l| *l == link);
    let joint = |(u, v, pair): (usize, usize, PairKind)| PairJoint {
        links: [u, v],
        pair,
    };
    let roles = Roles {
        frame: 0,
        input: [0, 1],
        jaws: jaw_links(m, place)?,
    };
    if roles.jaws != [2, 3] {
        return Ok(None);
    }
    let structure = PairStructure {
        chain: Chain::new(4, PAIRS.map(joint)),
        roles,
    };
    Ok(Some(Recognized {
        whole: structure.clone(),
        structure,
        names: links.map(|l| vec![m.links[l].id.clone()]).into(),
        made_as: MadeAs {
            threaded: true,
            ..MadeAs::default()
        },
    }))
}

/// Returns true if a joint is a thread.
pub(super) fn is_thread(joint: &Joint) -> bool {
    has(joint, |f| f == Freedom::Screw)
}

fn has(joint: &Joint, is: impl Fn(Freedom) -> bool) -> bool {
    joint.joint_type.freedoms().iter().any(|f| is(*f))
}
