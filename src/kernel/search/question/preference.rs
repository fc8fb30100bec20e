//! The preference among redesigns of equal cost: the drive and the pivots in the frame stay, and the ends of rods change before other
//! joints.
//!
//! A rod is the simplest part of a linkage: it is taken out and has its ends replaced without touching what it joins. A pivot in
//! the frame carries its link over the whole width, and its bore is in the largest casting; the driven joint holds the motor.

use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::search::question::space::Space;

/// Weight of a change at the driven joint.
const DRIVEN: u64 = 4;
/// Weight of a change at a pivot in the frame.
const FRAME: u64 = 2;
/// Weight of a change at any other joint that is not a rod's end.
const PIVOT: u64 = 1;

/// Returns for each variable the weight of changing its joints. Lower weights come first.
#[must_use]
pub(crate) fn change_weights(mechanism: &Mechanism, space: &Space) -> Vec<u64> {
    let of = |&j: &JointId| change_weight(mechanism, j);
    let variables = space.variables.iter();
    variables.map(|v| v.joints.iter().map(of).sum()).collect()
}

/// Returns the weight of changing a joint.
#[must_use]
pub(crate) fn change_weight(mechanism: &Mechanism, joint: JointId) -> u64 {
    let (frame, here) = (mechanism.frame_link(), &mechanism.joints[joint]);
    let driven = if here.drive { DRIVEN } else { 0 };
    let place = match here.links {
        links if links.contains(&frame) => FRAME,
        links if links.iter().any(|&l| is_rod(mechanism, l)) => 0,
        _ => PIVOT,
    };
    driven + place
}

/// Returns true if a link joins exactly two others, neither of them the frame.
#[must_use]
pub fn is_rod(mechanism: &Mechanism, link: LinkId) -> bool {
    let frame = mechanism.frame_link();
    let links = mechanism
        .joints_in(StateId::FREE)
        .map(|j| mechanism.joints[j].links);
    let own: Vec<[LinkId; 2]> = links.filter(|l| l.contains(&link)).collect();
    let inner = mechanism.links[link].role == Role::Inner;
    inner && own.len() == 2 && !own.iter().any(|l| l.contains(&frame))
}
