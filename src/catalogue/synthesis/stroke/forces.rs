//! Forces in the joints at a pose of the stroke, the jaws each holding the part with a newton, without friction; and what they
//! say of it: the greatest, how well driver and jaws pass work on, and how much of it friction would take.

use super::pose::LinkPose;
use crate::chains::layout_symmetry::Input;
use crate::geom::vector::{cross_plane, dot, length};
use crate::synthesis::elimination::SmallSystem;
use crate::synthesis::point::Point;
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::task::Friction;

/// So many millimetres make a moment as large as a force, so that pivots are chosen evenly.
const ARM: f64 = 50.0;

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

/// The first of the three equations of a link; the frame has none.
fn first_row(link: usize, frame: usize) -> Option<usize> {
    (link != frame).then(|| 3 * (link - usize::from(link > frame)))
}

impl JointForces {
    /// Room for those of a skeleton.
    #[must_use]
    pub fn new(skeleton: &Skeleton<'_>) -> JointForces {
        let (links, pins) = (skeleton.structure.chain.links(), skeleton.rules.pins.len());
        JointForces {
            system: SmallSystem::new(3 * (links - 1), 1),
            pins: vec![[0.0; 2]; pins],
            moment: 0.0,
            drive: 0.0,
            places: vec![[0.0; 2]; pins],
        }
    }

    /// Solves the equilibrium of every moving link, with the links at these poses and pins drawn at these places; `false` where
    /// there is no one solution.
    ///
    /// # Complexity
    /// O(n³) for n links.
    pub(super) fn solve(
        &mut self,
        skeleton: &Skeleton<'_>,
        links: &[LinkPose],
        at: &[Point],
    ) -> bool {
        let roles = &skeleton.structure.roles;
        let drive = 2 * skeleton.rules.pins.len();
        self.system.clear();
        self.add_joints(skeleton, links, at);
        if let Some(row) = first_row(roles.driver, roles.frame) {
            // A slide lies on the x axis.
            let slides = skeleton.structure.form.input == Input::Slide;
            self.system
                .add(row + if slides { 0 } else { 2 }, drive, 1.0);
        }
        self.add_part(skeleton, links);
        if self.system.solve().is_none() {
            return false;
        }
        self.read(skeleton);
        true
    }

    /// Adds what the joints do to their links.
    fn add_joints(&mut self, skeleton: &Skeleton<'_>, links: &[LinkPose], at: &[Point]) {
        let roles = &skeleton.structure.roles;
        let slides = skeleton.structure.form.input == Input::Slide;
        for (i, &(u, v)) in skeleton.rules.pins.iter().enumerate() {
            let guide = slides && i == skeleton.rules.input;
            // What presses on a guide goes with the driver.
            let place = links[if guide { roles.driver } else { v }].point(at[i]);
            self.places[i] = place;
            for (link, sign) in [(u, -1.0), (v, 1.0)] {
                let Some(row) = first_row(link, roles.frame) else {
                    continue;
                };
                if guide {
                    // Across the slide, and a moment about its place.
                    self.system.add(row + 1, 2 * i, sign);
                    self.system.add(row + 2, 2 * i, sign * place[0] / ARM);
                    self.system.add(row + 2, 2 * i + 1, sign);
                } else {
                    self.system.add(row, 2 * i, sign);
                    self.system.add(row + 1, 2 * i + 1, sign);
                    self.system.add(row + 2, 2 * i, -sign * place[1] / ARM);
                    self.system.add(row + 2, 2 * i + 1, sign * place[0] / ARM);
                }
            }
        }
    }

    /// Adds what the part does to the jaws, as the right side.
    fn add_part(&mut self, skeleton: &Skeleton<'_>, links: &[LinkPose]) {
        let roles = &skeleton.structure.roles;
        let right = 3 * (skeleton.structure.chain.links() - 1);
        for (n, &jaw) in roles.jaws.iter().enumerate() {
            let Some(row) = first_row(jaw, roles.frame) else {
                continue;
            };
            // The part pushes outward; what the joints do makes up for it.
            let push = skeleton.bones.inward[n];
            let tip = links[jaw].point(skeleton.bones.tips[n]);
            self.system.add(row, right, push[0]);
            self.system.add(row + 1, right, push[1]);
            self.system
                .add(row + 2, right, cross_plane(tip, push) / ARM);
        }
    }

    /// Reads the forces from the system solved.
    fn read(&mut self, skeleton: &Skeleton<'_>) {
        let (roles, pins) = (&skeleton.structure.roles, &skeleton.rules.pins);
        let slides = skeleton.structure.form.input == Input::Slide;
        for (i, force) in self.pins.iter_mut().enumerate() {
            *force = [self.system.get(2 * i, 0), self.system.get(2 * i + 1, 0)];
        }
        let arm = if slides { 1.0 } else { ARM };
        self.drive = arm * self.system.get(2 * pins.len(), 0);
        if slides {
            let input = skeleton.rules.input;
            let to_driver = if pins[input].1 == roles.driver {
                1.0
            } else {
                -1.0
            };
            let [across, moment] = self.pins[input];
            self.pins[input] = [0.0, across];
            self.moment = to_driver * moment * ARM;
        }
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
