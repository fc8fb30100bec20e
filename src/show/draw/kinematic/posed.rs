//! What a pose of the motion carries where.

use crate::draw::place::projection::{JointInSpace, Vector};
use crate::geom::rigid::RigidMotion;
use crate::model::mechanism::LinkId;
use crate::motion::pose::Pose;

/// Where a link has carried what is fixed to it.
pub(super) struct Carried<'p> {
    pub(super) pose: &'p Pose,
    pub(super) links: &'p [RigidMotion],
}

impl Carried<'_> {
    pub(super) fn point(&self, link: LinkId, p: Vector) -> Vector {
        self.pose.carried(self.links, link, p)
    }

    pub(super) fn place(&self, link: LinkId, frame: LinkId, place: &JointInSpace) -> JointInSpace {
        let turn = |v| self.links[frame].direction(v);
        place.carried(self.point(link, place.point), turn)
    }
}
