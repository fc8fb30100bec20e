//! Drives: the freedom that a driven joint moves, and the drives that a search follows.

use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Joint, Mechanism};
use crate::model::{JointId, LinkId};

impl Joint {
    /// Returns the freedom that the drive moves. If the file names none, this is the thread, otherwise the slide along
    /// the axis, otherwise the turn about it, otherwise the first freedom. Returns `None` for a joint without a drive
    /// or without a freedom.
    #[must_use]
    pub fn driven_freedom(&self) -> Option<Freedom> {
        let own = self.joint_type.freedoms();
        let usual = [Freedom::Screw, Freedom::Tz, Freedom::Rz];
        let usual = usual.into_iter().find(|f| own.contains(f));
        let driven = self.drive_freedom.or(usual).or(own.first().copied());
        driven.filter(|_| self.drive)
    }
}

impl Mechanism {
    /// Returns the index of the drive at a joint among [`SearchSpec::drives`](crate::model::mechanism::SearchSpec::drives).
    #[must_use]
    pub fn drive_at(&self, joint: JointId) -> Option<usize> {
        self.search.drives.iter().position(|d| d.joint == joint)
    }

    /// Returns the index as `drive_at` does, if the motion of the drive is kept.
    #[must_use]
    pub fn kept_drive(&self, joint: JointId) -> Option<usize> {
        self.drive_at(joint).filter(|_| !self.search.locks_drives)
    }

    /// Returns the number of kept drives.
    #[must_use]
    pub fn kept_drives(&self) -> usize {
        if self.search.locks_drives {
            0
        } else {
            self.search.drives.len()
        }
    }

    /// Returns the number of locked drives.
    #[must_use]
    pub fn locked_drives(&self) -> usize {
        self.search.drives.len() - self.kept_drives()
    }

    /// Returns the number of the virtual link that represents a kept drive among the motions of links. It comes after
    /// all links, and the first number of its twist is the drive's rate.
    #[must_use]
    pub fn drive_link(&self, drive: usize) -> LinkId {
        LinkId::new(self.links.len() + drive)
    }

    /// Returns the number of rates of a joint that follow its twist: one for each of its couplings, then that of its
    /// drive.
    #[must_use]
    pub fn rates_of(&self, joint: JointId) -> usize {
        self.couplings_of(joint).count() + usize::from(self.drive_at(joint).is_some())
    }
}
