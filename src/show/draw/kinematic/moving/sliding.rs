//! Links and joints carried by a pose, and how far joints slide.

use crate::draw::kinematic::Kinematic;
use crate::draw::place::projection::{JointInSpace, Vector, dot, scale as times, sub as sub3};
use crate::draw::symbol::placed::one_place;
use crate::geom::rigid::RigidMotion;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::LinkId;
use crate::motion::pose::Pose;

/// The displacement of the links in a pose.
pub(crate) struct Carried<'p> {
    pub(crate) pose: &'p Pose,
    pub(crate) links: &'p [RigidMotion],
}

impl Carried<'_> {
    pub(crate) fn carried_point(&self, link: LinkId, p: Vector) -> Vector {
        self.pose.carry_point(self.links, link, p)
    }

    pub(crate) fn carried_place(
        &self,
        link: LinkId,
        frame: LinkId,
        place: &JointInSpace,
    ) -> JointInSpace {
        let turn = |v| self.links[frame].map_direction(v);
        place.carried_to(self.carried_point(link, place.point), turn)
    }
}

impl Kinematic<'_> {
    /// Returns how far along its axis each joint slides from its position at rest, over all poses. `None` for joints that do
    /// not slide.
    pub(crate) fn slide_ranges(&self, poses: &[Carried<'_>]) -> Vec<Option<[f64; 2]>> {
        let one = |i: usize| {
            let along = self.slide_axis(i)?;
            let (rides, guides) = self.carrier_links(i);
            let place = &self.places[i];
            let of = poses.iter().map(|c| {
                let apart = sub3(
                    c.carried_point(rides, place.point),
                    c.carried_point(guides, place.point),
                );
                dot(apart, c.links[guides].map_direction(along))
            });
            Some(of.fold([0.0f64, 0.0], |[l, h], x| [l.min(x), h.max(x)]))
        };
        (0..self.spots.len()).map(one).collect()
    }

    /// Returns the direction that a joint slides in. `None` unless there is exactly one.
    pub(crate) fn slide_axis(&self, i: usize) -> Option<Vector> {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let place = &self.places[i];
        let freedoms = joint.joint_type.freedoms();
        let axes = [
            (Freedom::Tx, place.x),
            (Freedom::Ty, place.y),
            (Freedom::Tz, place.z),
            (Freedom::Screw, place.z),
        ];
        let mut slides = axes.into_iter().filter(|(f, _)| freedoms.contains(f));
        let first = slides.next()?;
        slides.next().is_none().then_some(first.1)
    }

    /// Returns the link that the symbol of a joint moves with, and the link that it slides along. A block moves with a link
    /// that has no other shape, and preferably not with the frame. A slot belongs to the second link, and the pin in it to
    /// the first.
    pub(crate) fn carrier_links(&self, i: usize) -> (LinkId, LinkId) {
        let joint = &self.subject.mechanism.joints[self.spots[i].joint];
        let [a, b] = joint.links;
        if joint.joint_type.freedoms().contains(&Freedom::Tx) {
            return (a, b);
        }
        let small = |l: LinkId| {
            let of = self.links.iter().find(|(k, _)| *k == l);
            of.is_some_and(|(_, of)| {
                of.len() > 1
                    && of
                        .iter()
                        .all(|&k| one_place(self.spots[k].at, self.spots[i].at))
            })
        };
        if small(a) || self.is_frame(b) {
            (a, b)
        } else if small(b) || self.is_frame(a) {
            (b, a)
        } else {
            (a, b)
        }
    }

    /// Rails are as long as what slides along them needs.
    pub(crate) fn lengthen_rails(&mut self, slides: &[Option<[f64; 2]>]) {
        for (i, &range) in slides.iter().enumerate() {
            let (Some(range), Some(axis)) = (range, self.slide_axis(i)) else {
                continue;
            };
            if !self.is_frame(self.carrier_links(i).1) {
                continue;
            }
            let [low, high] = range.map(|x| {
                let flat = self.projection.view.flat_vector(times(axis, x));
                flat.map(|c| c * self.projection.scale)
            });
            let at = self.spots[i].at;
            let rail = self.grounds.iter_mut().find(|g| one_place(g.from, at));
            if let Some(g) = rail {
                g.lengthen_rail(low, high);
            }
        }
    }
}
