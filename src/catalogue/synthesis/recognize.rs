//! A drawn mechanism as a structure: the chain of pairs that its joints are in their plane, with the roles of its links.
//!
//! What a joint does in the plane is what of its motions lies there: a ball is a hinge, a pin with play along its axis is one,
//! too. So a gripper and its redesign have the same structure.

mod found;
mod in_plane;
mod motion_plane;
mod sides;
mod threads;

pub use found::{NoStructure, Recognized};

use crate::chains::chain::Chain;
use crate::chains::classics::MadeAs;
use crate::chains::roles::Roles;
use crate::chains::structure::PairStructure;
use crate::model::StateId;
use crate::model::mechanism::Mechanism;
use found::jaw_links;
use in_plane::InPlane;
use itertools::Itertools;
use sides::three_sides;
use threads::{is_thread, screw_with_nuts};

/// The structure of a mechanism in its free state.
///
/// # Errors
/// Why it has none.
///
/// # Complexity
/// A few eliminations of six columns for each joint and each axis.
///
/// # Examples
/// ```
/// use ozols::synthesis::recognize::recognize_structure;
/// let found = recognize_structure(&ozols::built_in("gripper-10")?)?;
/// assert_eq!((found.structure.chain.links(), found.structure.roles.jaws.len()), (10, 2));
/// assert!(recognize_structure(&ozols::built_in("bennett")?).is_err()); // It moves in no plane.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn recognize_structure(m: &Mechanism) -> Result<Recognized, NoStructure> {
    if let Some(found) = screw_with_nuts(m)? {
        return Ok(found);
    }
    let mut joints = m.joints_in(StateId::FREE).map(|j| &m.joints[j]);
    if let Some(thread) = joints.find(|j| is_thread(j)) {
        return Err(NoStructure::Thread(thread.id.clone()));
    }
    match three_sides(m) {
        Ok(Some(found)) => Ok(found),
        Ok(None) => in_a_plane(m),
        // Three jaws that are no sides may be all in one plane.
        Err(why) => in_a_plane(m).map_err(|_| why),
    }
}

/// The structure of what moves in a plane.
fn in_a_plane(m: &Mechanism) -> Result<Recognized, NoStructure> {
    let present = m.joints_in(StateId::FREE).collect_vec();
    let found = InPlane::new(m, &present)?;
    let roles = Roles {
        frame: found.links.frame,
        input: found.links.input,
        jaws: jaw_links(m, |l| found.body(l))?,
    };
    let jaws_on_one_pin = match roles.jaws[..] {
        [a, b] => {
            let at_frame = [a, b].map(|jaw| found.at_frame(jaw));
            found.plane.are_on_one_pin(at_frame)?
        }
        _ => false,
    };
    let made_as = MadeAs {
        flat: found.links.flat,
        jaws_on_one_pin,
        threaded: false,
    };
    let chain = Chain::new(found.links.names.len(), found.links.joints);
    let structure = PairStructure { chain, roles };
    Ok(Recognized {
        whole: structure.clone(),
        structure,
        names: found.links.names,
        made_as,
    })
}
