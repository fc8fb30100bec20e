//! Joint forces at a pose of the stroke, if all joints are hinges except for an input that slides. Each jaw holds the part with 1 N,
//! without friction. The figures are the greatest force, the force transmission of driver and jaws, and the efficiency.

use super::pose::LinkPose;
use crate::chains::Input;
use crate::geom::vector::{add_scaled, cross_plane, dot, quarter_turn, sub};
use crate::synthesis::equations::elimination::SmallSystem;
use crate::synthesis::equations::velocities::{Contours, Side};
use crate::synthesis::place::Point;
use crate::synthesis::sketch::Sketch;

/// The action of a joint: the force on its second link, the point at which it acts, and a moment, in N and N mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::synthesis) struct JointForce {
    /// The force on the second link of the joint.
    pub(in crate::synthesis) force: Point,
    /// The point at which the force acts.
    pub(in crate::synthesis) at: Point,
    /// The moment of a slide about that point.
    pub(in crate::synthesis) moment: f64,
}

/// Forces at a pose.
#[derive(Debug, Clone)]
pub(in crate::synthesis) struct HingeForces {
    system: SmallSystem,
    /// The force of each pin. The force of a slide presses on the driver, across the guide.
    pub(super) pins: Vec<JointForce>,
    /// The wrench on each link, without the force of its joint in the tree.
    on_links: Vec<Wrench>,
}

/// Figures of the forces at a pose, or the worst figures of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceFigures {
    /// The greatest joint force, in N for 1 N of each jaw.
    pub peak: f64,
    /// The smallest transmission angle of jaws and driver, in degrees. Its sine is the transmitted work over the greatest work of the joint
    /// forces at the same speeds. For a jaw hinged in the frame and pushed by a rod, it is the usual transmission angle.
    pub transmission: f64,
    /// The work at the jaws over that of the drive, with friction.
    pub efficiency: f64,
}

impl ForceFigures {
    /// Figures that are better than those of any pose.
    pub const BEST: ForceFigures = ForceFigures {
        peak: 0.0,
        transmission: 90.0,
        efficiency: 1.0,
    };

    /// The figures if the forces are infinite.
    pub const WORST: ForceFigures = ForceFigures {
        peak: f64::INFINITY,
        transmission: 0.0,
        efficiency: 0.0,
    };

    /// Returns the worse of both, figure by figure.
    #[must_use]
    pub fn worse_of(self, other: ForceFigures) -> ForceFigures {
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
    /// Adds a force, multiplied by `times`, that acts at a place.
    fn add_force(&mut self, times: f64, force: Point, place: Point) {
        self.force = add_scaled(self.force, times, force);
        self.moment += times * cross_plane(place, force);
    }

    fn about(&self, place: Point) -> f64 {
        self.moment - cross_plane(place, self.force)
    }
}

impl HingeForces {
    /// Creates the forces of a sketch, not yet solved.
    pub(super) fn new(sketch: &Sketch<'_>, contours: &Contours) -> HingeForces {
        HingeForces {
            system: SmallSystem::new(2 * contours.cuts.len(), 1),
            pins: vec![JointForce::default(); sketch.rules.joints.len()],
            on_links: vec![Wrench::default(); sketch.at_rest.len()],
        }
    }

    /// Solves for the forces, with the links at these poses and points drawn at these places. Returns whether there is exactly one
    /// solution.
    ///
    /// One pin of each contour is cut. This leaves a tree, whose links turn independently. At every turn, the work of the forces in the
    /// cuts and at the part adds up to zero. From the forces in the cuts, each link gives the force of its joint in the tree.
    ///
    /// # Complexity
    /// O(c³ + n) for c contours and n links.
    pub(super) fn solve_forces(
        &mut self,
        sketch: &Sketch<'_>,
        contours: &Contours,
        links: &[LinkPose],
        at: &[Point],
    ) -> bool {
        let slides = contours.input == Input::Slide;
        for (i, joint) in sketch.rules.joints.iter().enumerate() {
            // The force on a guide moves with the driver.
            let guide = slides && i == sketch.input;
            let link = if guide {
                contours.driver
            } else {
                joint.links[1]
            };
            self.pins[i].at = links[link].moved_point(at[i]);
        }
        self.fill(sketch, contours, links, at);
        if self.system.solve_all().is_none() {
            return false;
        }
        self.gather_forces(sketch, contours, links);
        true
    }

    /// Fills the virtual work at every turn: of the forces in the cuts, and, as the right side, of the part.
    fn fill(&mut self, sketch: &Sketch<'_>, contours: &Contours, links: &[LinkPose], at: &[Point]) {
        let right = 2 * contours.cuts.len();
        let turned = |side: &Side| {
            let arm = sub(at[side.leaves], at[side.comes]);
            let unknown = contours.unknown[side.link]?;
            Some((
                unknown,
                quarter_turn(links[side.link].turned_direction(arm)),
            ))
        };
        self.system.clear();
        for (k, ways) in contours.contours.iter().enumerate() {
            for (way, sign) in ways.iter().zip([1.0, -1.0]) {
                for (row, [x, y]) in way.iter().filter_map(turned) {
                    self.system.add_entry(row, 2 * k, sign * x);
                    self.system.add_entry(row, 2 * k + 1, sign * y);
                }
            }
        }
        for (way, inward) in contours.tips.iter().zip(&sketch.bones.inward) {
            for (row, rate) in way.iter().filter_map(turned) {
                self.system.add_entry(row, right, -dot(rate, *inward));
            }
        }
    }

    /// Computes the forces in all joints from the forces in the cuts, from the leaves of the tree to its root.
    fn gather_forces(&mut self, sketch: &Sketch<'_>, contours: &Contours, links: &[LinkPose]) {
        let (bones, joints) = (&sketch.bones, &sketch.rules.joints);
        self.on_links.fill(Wrench::default());
        for (n, (&jaw, inward)) in bones.jaws.iter().zip(&bones.inward).enumerate() {
            // The part pushes outward.
            let tip = links[jaw].moved_point(bones.tips[n]);
            self.on_links[jaw].add_force(-1.0, *inward, tip);
        }
        for (k, &cut) in contours.cuts.iter().enumerate() {
            let force = [self.system.get(2 * k, 0), self.system.get(2 * k + 1, 0)];
            let ([u, v], place) = (joints[cut].links, self.pins[cut].at);
            self.pins[cut].force = force;
            self.on_links[u].add_force(-1.0, force, place);
            self.on_links[v].add_force(1.0, force, place);
        }
        for s in contours.tree.iter().rev() {
            let (wrench, place) = (self.on_links[s.link], self.pins[s.joint].at);
            let is_second = joints[s.joint].links[1] == s.link;
            let on_second = if is_second { -1.0 } else { 1.0 };
            self.pins[s.joint].force = wrench.force.map(|x| on_second * x);
            self.on_links[s.from].add_force(1.0, wrench.force, place);
            if s.link == contours.driver && contours.input == Input::Slide {
                // The slide lies on the x axis: the force of its guide is normal to it.
                let guide = &mut self.pins[sketch.input];
                guide.moment = -wrench.about(place);
                guide.force[0] = 0.0;
            }
        }
    }
}
