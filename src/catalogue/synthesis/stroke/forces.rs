//! Forces in the joints at a pose of the stroke, the jaws each holding the part with a newton, without friction; and what they
//! say of it: the greatest, how well driver and jaws pass work on, and how much of it friction would take.

use super::pose::LinkPose;
use crate::chains::layout_symmetry::Input;
use crate::geom::vector::{add_scaled, cross_plane, dot, length, quarter, sub};
use crate::synthesis::elimination::SmallSystem;
use crate::synthesis::place::Point;
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::task::Friction;
use crate::synthesis::velocities::Side;

/// Forces at a pose.
#[derive(Debug, Clone)]
pub struct JointForces {
    system: SmallSystem,
    /// Of each pin on its second link; of a slide what presses on the driver across it, in N.
    pub pins: Vec<Point>,
    /// The moment of a slide on the driver about the input joint, which goes with the driver, in N mm.
    pub moment: f64,
    /// What the drive does: N, or N mm, the way its coordinate grows.
    pub drive: f64,
    /// Where the pins are.
    places: Vec<Point>,
    /// What acts on each link besides its joint in the tree.
    on_links: Vec<Wrench>,
}

/// What forces say of a pose, or of the worst of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceFigures {
    /// The greatest joint force, in N for 1 N of each jaw.
    pub peak: f64,
    /// The least angle whose sine is the work that a jaw or the driver passes on over what its joint forces could at the same
    /// speeds, in degrees: of a jaw hinged in the frame and pushed by a rod, the transmission angle.
    pub transmission: f64,
    /// The work at the jaws over that of the drive, with friction.
    pub efficiency: f64,
}

impl ForceFigures {
    /// What is better than all poses.
    pub const BEST: ForceFigures = ForceFigures {
        peak: 0.0,
        transmission: 90.0,
        efficiency: 1.0,
    };

    /// What is said where the forces are beyond all bounds.
    pub const WORST: ForceFigures = ForceFigures {
        peak: f64::INFINITY,
        transmission: 0.0,
        efficiency: 0.0,
    };

    /// The worse of both, figure by figure.
    #[must_use]
    pub fn worse(self, other: ForceFigures) -> ForceFigures {
        ForceFigures {
            peak: self.peak.max(other.peak),
            transmission: self.transmission.min(other.transmission),
            efficiency: self.efficiency.min(other.efficiency),
        }
    }
}

/// A force with its moment about the origin.
#[derive(Debug, Clone, Copy, Default)]
struct Wrench {
    force: Point,
    moment: f64,
}

impl Wrench {
    /// Adds a force, taken so many times, that acts at a place.
    fn add(&mut self, times: f64, force: Point, place: Point) {
        self.force = add_scaled(self.force, times, force);
        self.moment += times * cross_plane(place, force);
    }

    fn about(&self, place: Point) -> f64 {
        self.moment - cross_plane(place, self.force)
    }
}

impl JointForces {
    /// Room for those of a skeleton.
    #[must_use]
    pub fn new(skeleton: &Skeleton<'_>) -> JointForces {
        let (links, pins) = (skeleton.structure.chain.links(), skeleton.rules.pins.len());
        JointForces {
            system: SmallSystem::new(2 * skeleton.contours.cuts.len(), 1),
            pins: vec![[0.0; 2]; pins],
            moment: 0.0,
            drive: 0.0,
            places: vec![[0.0; 2]; pins],
            on_links: vec![Wrench::default(); links],
        }
    }

    /// Solves for the forces, with the links at these poses and points drawn at these places; `false` where there is no one
    /// solution.
    ///
    /// One pin of each contour is cut. What is left is a tree, whose links turn one without the other: what the forces in the
    /// cuts and the part do at every turn adds up to nothing. From the cuts on, each link tells what its joint in the tree bears.
    ///
    /// # Complexity
    /// O(c³ + n) for c contours and n links.
    pub(super) fn solve(
        &mut self,
        skeleton: &Skeleton<'_>,
        links: &[LinkPose],
        at: &[Point],
    ) -> bool {
        let roles = &skeleton.structure.roles;
        let slides = skeleton.structure.form.input == Input::Slide;
        for (i, &(_, v)) in skeleton.rules.pins.iter().enumerate() {
            // What presses on a guide goes with the driver.
            let guide = slides && i == skeleton.rules.input;
            self.places[i] = links[if guide { roles.driver } else { v }].point(at[i]);
        }
        self.fill(skeleton, links, at);
        if self.system.solve().is_none() {
            return false;
        }
        self.gather(skeleton, links);
        true
    }

    /// The work at every turn: of the forces in the cuts, and, as the right side, of what the part makes them do.
    fn fill(&mut self, skeleton: &Skeleton<'_>, links: &[LinkPose], at: &[Point]) {
        let contours = &skeleton.contours;
        let right = 2 * contours.cuts.len();
        let turned = |side: &Side| {
            let arm = sub(at[side.leaves], at[side.comes]);
            let unknown = contours.unknown[side.link]?;
            Some((unknown, quarter(links[side.link].direction(arm))))
        };
        self.system.clear();
        for (k, ways) in contours.contours.iter().enumerate() {
            for (way, sign) in ways.iter().zip([1.0, -1.0]) {
                for (row, [x, y]) in way.iter().filter_map(turned) {
                    self.system.add(row, 2 * k, sign * x);
                    self.system.add(row, 2 * k + 1, sign * y);
                }
            }
        }
        for (way, inward) in contours.tips.iter().zip(&skeleton.bones.inward) {
            for (row, rate) in way.iter().filter_map(turned) {
                self.system.add(row, right, -dot(rate, *inward));
            }
        }
    }

    /// From the forces in the cuts those in all joints, from the ends of the tree on.
    fn gather(&mut self, skeleton: &Skeleton<'_>, links: &[LinkPose]) {
        let (roles, pins) = (&skeleton.structure.roles, &skeleton.rules.pins);
        let contours = &skeleton.contours;
        self.on_links.fill(Wrench::default());
        for (n, (&jaw, inward)) in roles.jaws.iter().zip(&skeleton.bones.inward).enumerate() {
            // The part pushes outward.
            let tip = links[jaw].point(skeleton.bones.tips[n]);
            self.on_links[jaw].add(-1.0, *inward, tip);
        }
        for (k, &cut) in contours.cuts.iter().enumerate() {
            let force = [self.system.get(2 * k, 0), self.system.get(2 * k + 1, 0)];
            let ((u, v), place) = (pins[cut], self.places[cut]);
            self.pins[cut] = force;
            self.on_links[u].add(-1.0, force, place);
            self.on_links[v].add(1.0, force, place);
        }
        for s in contours.tree.iter().rev() {
            let (wrench, place) = (self.on_links[s.link], self.places[s.joint]);
            let on_second = if pins[s.joint].1 == s.link { -1.0 } else { 1.0 };
            self.pins[s.joint] = wrench.force.map(|x| on_second * x);
            self.on_links[s.from].add(1.0, wrench.force, place);
            if s.link == roles.driver {
                self.drive_with(skeleton, wrench, place);
            }
        }
    }

    /// What drive and guide do, where so much acts on the driver besides, and its input joint is at a place.
    fn drive_with(&mut self, skeleton: &Skeleton<'_>, wrench: Wrench, place: Point) {
        let moment = wrench.about(place);
        if skeleton.structure.form.input == Input::Turn {
            self.drive = -moment;
            return;
        }
        // A slide lies on the x axis: its guide presses across.
        self.drive = -wrench.force[0];
        self.moment = -moment;
        self.pins[skeleton.rules.input][0] = 0.0;
    }

    /// What the forces say, with the links moving as they do for a millimetre of the width.
    pub(super) fn figures(
        &self,
        skeleton: &Skeleton<'_>,
        links: &[LinkPose],
        friction: &Friction,
    ) -> ForceFigures {
        let roles = &skeleton.structure.roles;
        let slides = skeleton.structure.form.input == Input::Slide;
        let input = skeleton.rules.input;
        let mut out = ForceFigures::BEST;
        let (mut lost, mut given) = (0.0, 0.0);
        for (i, &(u, v)) in skeleton.rules.pins.iter().enumerate() {
            let force = length(self.pins[i]);
            out.peak = out.peak.max(force);
            if slides && i == input {
                // Pressed on at both ends of the guide.
                let press = force.max(2.0 * self.moment.abs() / friction.guide);
                lost += friction.coefficient * press * length(links[roles.driver].velocity.shift);
            } else {
                let turning = links[u].velocity.turning - links[v].velocity.turning;
                lost += friction.coefficient * friction.pin_radius * force * turning.abs();
            }
        }
        for (n, &jaw) in roles.jaws.iter().enumerate() {
            let velocity = links[jaw]
                .velocity
                .at(links[jaw].point(skeleton.bones.tips[n]));
            let work = dot(velocity, skeleton.bones.inward[n]).abs();
            given += work;
            out.transmission = out
                .transmission
                .min(self.passed(skeleton, links, jaw, work));
        }
        let driver = self.passed(skeleton, links, roles.driver, given);
        out.transmission = out.transmission.min(driver);
        out.efficiency = given / (given + lost).max(1e-12);
        out
    }

    /// The angle whose sine is the work of a link over what the forces at its moving pins could do at their speeds.
    fn passed(&self, skeleton: &Skeleton<'_>, links: &[LinkPose], link: usize, work: f64) -> f64 {
        let pins = skeleton.rules.pins.iter().enumerate();
        let own = pins.filter(|(i, (u, v))| {
            let slide = *i == skeleton.rules.input && skeleton.structure.form.input == Input::Slide;
            (*u == link || *v == link) && !slide
        });
        let could = own
            .map(|(i, _)| length(self.pins[i]) * length(links[link].velocity.at(self.places[i])));
        let could: f64 = could.sum();
        (work / could.max(1e-12)).min(1.0).asin().to_degrees()
    }
}
