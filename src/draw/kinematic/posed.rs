//! What a pose of the motion carries where.

use crate::draw::place::projection::{Place, Vector, add as add3, scale as times, sub as sub3};
use crate::geom::rigid::Motion;
use crate::model::mechanism::LinkId;
use crate::motion::pose::Pose;

/// Where a link has carried what is fixed to it.
pub(super) struct Carried<'p> {
    pub(super) pose: &'p Pose,
    pub(super) links: &'p [Motion],
}

impl Carried<'_> {
    pub(super) fn point(&self, link: LinkId, p: Vector) -> Vector {
        let (middle, length) = (self.pose.middle, self.pose.length);
        let there = self.links[link].point(times(sub3(p, middle), 1.0 / length));
        add3(middle, times(there, length))
    }

    pub(super) fn place(&self, link: LinkId, frame: LinkId, place: &Place) -> Place {
        let turn = |v| self.links[frame].direction(v);
        place.carried(self.point(link, place.point), turn)
    }
}
