//! Whether a body that a state adds is held: no motion moves it against all the links that may hold it.
//!
//! The motions of a mechanism form a space, and those in which the body moves with one given link a subspace of it. A space
//! is not the union of smaller ones, so if each of the links is left behind by some motion, one motion leaves all of them
//! behind. The body is held, then, exactly where it moves with one and the same link in every motion; between the pads of
//! two unloading joints it turns about the line through their centres, with neither jaw.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::model::mechanism::{JointId, LinkId, Mechanism, Role, StateId};
use crate::redundancy::motion::{link_twist, motion_basis};

/// A body to be held, with the links that may hold it.
#[derive(Debug, Clone)]
pub(crate) struct Grasp {
    /// The body.
    pub body: LinkId,
    /// The links.
    pub jaws: Vec<LinkId>,
}

/// Returns true if a link has a joint in the free state.
#[must_use]
pub fn is_free(mechanism: &Mechanism, link: LinkId) -> bool {
    let mut free = mechanism.joints_in(StateId::FREE);
    link == mechanism.frame_link() || free.any(|j| mechanism.joints[j].links.contains(&link))
}

/// Returns the links of the free mechanism that hold a body in a state. They connect to it through joints and other bodies
/// that the state adds.
fn find_jaws(mechanism: &Mechanism, state: StateId, body: LinkId) -> Vec<LinkId> {
    let added: Vec<JointId> = mechanism.joints_added_in(state).collect();
    let (mut bodies, mut jaws) = (vec![body], Vec::new());
    let mut next = 0;
    while let Some(&at) = bodies.get(next) {
        next += 1;
        for &j in &added {
            let [a, b] = mechanism.joints[j].links;
            let Some(other) = [(a, b), (b, a)].into_iter().find(|x| x.0 == at) else {
                continue;
            };
            if is_free(mechanism, other.1) {
                jaws.push(other.1);
            } else if !bodies.contains(&other.1) {
                bodies.push(other.1);
            }
        }
    }
    jaws.sort_unstable();
    jaws.dedup();
    jaws.retain(|l| *l != body);
    jaws
}

/// Returns the bodies to be held in a state. These are the objects of the file, if `objects` is set, and the links that the search holds,
/// if the state joins them to the mechanism.
#[must_use]
pub(crate) fn find_grasps(mechanism: &Mechanism, state: StateId, objects: bool) -> Vec<Grasp> {
    let wanted = |l: &LinkId| {
        let object = objects && mechanism.links[*l].role == Role::Object;
        object || mechanism.search.hold.contains(l) && !is_free(mechanism, *l)
    };
    let links = mechanism.link_ids().filter(wanted);
    let each = links.map(|body| Grasp {
        body,
        jaws: find_jaws(mechanism, state, body),
    });
    each.filter(|g| !g.jaws.is_empty()).collect()
}

/// Returns the bodies that can move relative to all the links that may hold them.
///
/// # Errors
/// Returns an error if a coordinate has no value in the field.
///
/// # Complexity
/// One elimination of J of the state.
pub(crate) fn loose_bodies(
    exact: &ExactField,
    mechanism: &Mechanism,
    state: StateId,
    grasps: &[Grasp],
) -> Result<Vec<LinkId>, ExactError> {
    let closure = Closure::new(exact, mechanism, state)?;
    let kernel = motion_basis(exact, &closure);
    let twists = |l: LinkId| -> Vec<_> {
        let motion = closure.link_motion(exact, mechanism, l);
        kernel
            .iter()
            .map(|k| link_twist(exact, &motion, k))
            .collect()
    };
    let held = |g: &Grasp| {
        let own = twists(g.body);
        g.jaws.iter().any(|&j| twists(j) == own)
    };
    let loose = grasps.iter().filter(|g| !held(g));
    Ok(loose.map(|g| g.body).collect())
}
