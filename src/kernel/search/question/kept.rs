//! The condition on the motion of a redesign: the outputs together with the rates of the drives.
//!
//! A redesign works if its outputs and its drives move together as they do in the mechanism as built. The motions of the outputs alone are
//! not enough: a bush in place of a lead screw leaves the table its one motion, but the motor then spins without moving it.

use crate::closure::drive::{driven_freedoms, driven_in};
use crate::linalg::modp::Residue;
use crate::model::joint_type::CoupledFreedom;
use crate::model::mechanism::{LinkId, Mechanism, StateId};
pub use crate::search::question::conditions::Drives;
use crate::search::question::conditions::{Conditions, SearchError};
use std::sync::Arc;

/// The links and drives that must move as in the mechanism as built.
#[derive(Debug)]
pub struct Kept {
    /// The links, in ascending order.
    pub links: Vec<LinkId>,
    /// A reduced basis of their original motion in the free state: the twists of the links, then the rates of the drives of
    /// [`SearchSpec::drives`](crate::model::mechanism::SearchSpec::drives).
    pub motion: Vec<Vec<Residue>>,
}

impl Kept {
    /// Returns the links, and for each kept drive the link that represents it; see [`Mechanism::drive_link`].
    #[must_use]
    pub(in crate::search) fn kept_bodies(&self, mechanism: &Mechanism) -> Vec<LinkId> {
        let drives = (0..mechanism.kept_drives()).map(|d| mechanism.drive_link(d));
        self.links.iter().copied().chain(drives).collect()
    }
}

/// The driven freedoms that a search follows.
pub(super) struct Followed {
    freedoms: Vec<CoupledFreedom>,
    locked: bool,
}

impl Followed {
    /// Returns the driven freedoms that matter under some conditions.
    ///
    /// # Errors
    /// Returns an error if independent drives are required and there are none, or if a condition excludes them.
    pub(super) fn new(mechanism: &Mechanism, conditions: &Conditions) -> Result<Self, SearchError> {
        let independent = conditions.drives == Drives::Independent;
        let freedoms = match conditions.drives {
            Drives::Kept | Drives::Independent if conditions.keep_output => {
                let driven = driven_freedoms(mechanism, StateId::FREE).into_iter();
                let followed = driven.map(|(joint, freedom)| CoupledFreedom { joint, freedom });
                followed.collect()
            }
            _ => Vec::new(),
        };
        if independent && freedoms.is_empty() {
            return Err(SearchError::NoDrives);
        }
        if independent && (conditions.max_redundant > 0 || conditions.state.is_some()) {
            return Err(SearchError::DrivesBeside);
        }
        Ok(Followed {
            freedoms,
            locked: independent,
        })
    }

    /// Enters them in a mechanism.
    pub(super) fn enter_drives(&self, mechanism: &mut Arc<Mechanism>) {
        let spec = &mechanism.search;
        if (&spec.drives, spec.locks_drives) != (&self.freedoms, self.locked) {
            let spec = &mut Arc::make_mut(mechanism).parts_mut().search;
            spec.drives.clone_from(&self.freedoms);
            spec.locks_drives = self.locked;
        }
    }
}

/// Returns, for each drive that is followed, the joint and the freedom whose speed is its rate in a variant; `None` where no single one is.
#[must_use]
pub(in crate::search) fn driven_in_variant(
    mechanism: &Mechanism,
    variant: &Mechanism,
) -> Option<Vec<CoupledFreedom>> {
    let of = |drive: &CoupledFreedom| {
        let joint = &variant.joints[drive.joint];
        let present = &mechanism.joints[drive.joint].frame;
        let freedom = driven_in((present, drive.freedom), (&joint.frame, &joint.joint_type))?;
        Some(CoupledFreedom { freedom, ..*drive })
    };
    mechanism.search.drives.iter().map(of).collect()
}
