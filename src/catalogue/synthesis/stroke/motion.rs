//! How a structure moves over its stroke, as far as judging it asks.

use super::closure::Arms;
use super::forces::{ForceFigures, JointForces};
use super::pose::LinkPose;
use super::walk::{FitEquations, Walk};
use crate::chains::layout_symmetry::Input;
use crate::geom::vector::{add_scaled, quarter, sub};
use crate::synthesis::place::Point;
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::sketch::LayoutSketch;
use crate::synthesis::velocities::Velocity;

/// The strokes of a sketch, one after another.
pub trait StrokeMotion {
    /// What is moved.
    type Of: LayoutSketch;
    /// What holds where its links fit together.
    type Equations: FitEquations;

    /// What is moved.
    fn sketch(&self) -> &Self::Of;

    /// The pose on the way.
    fn walk(&self) -> &Walk<Self::Equations>;

    /// The same, to go on.
    fn walk_mut(&mut self) -> &mut Walk<Self::Equations>;

    /// Puts places into the equations.
    fn place(&mut self, at: &<Self::Of as LayoutSketch>::JointPlaces);

    /// Where the links are at the pose that the walk stands in.
    fn pose(&self, at: &<Self::Of as LayoutSketch>::JointPlaces, links: &mut [LinkPose]);

    /// What the joint forces say there; `None` where they have no one solution.
    fn forces(
        &mut self,
        at: &<Self::Of as LayoutSketch>::JointPlaces,
        links: &[LinkPose],
    ) -> Option<ForceFigures>;
}

/// The strokes of a structure of hinges.
#[derive(Debug)]
pub struct HingeMotion<'a> {
    skeleton: &'a Skeleton<'a>,
    walk: Walk<Arms<'a>>,
    forces: JointForces,
}

impl<'a> HingeMotion<'a> {
    /// Of a skeleton.
    #[must_use]
    pub fn new(skeleton: &'a Skeleton<'a>) -> HingeMotion<'a> {
        HingeMotion {
            skeleton,
            walk: Walk::new(Arms::new(&skeleton.closure)),
            forces: JointForces::new(skeleton),
        }
    }
}

impl<'a> StrokeMotion for HingeMotion<'a> {
    type Of = Skeleton<'a>;
    type Equations = Arms<'a>;

    fn sketch(&self) -> &Skeleton<'a> {
        self.skeleton
    }

    fn walk(&self) -> &Walk<Arms<'a>> {
        &self.walk
    }

    fn walk_mut(&mut self) -> &mut Walk<Arms<'a>> {
        &mut self.walk
    }

    fn place(&mut self, at: &Vec<Point>) {
        self.walk.equations.place(at);
    }

    fn pose(&self, at: &Vec<Point>, links: &mut [LinkPose]) {
        let contours = &self.skeleton.contours;
        let (x, rates) = (&self.walk.x, &self.walk.rates);
        let last = x.len() - 1;
        links[self.skeleton.structure.roles.frame] = LinkPose::AT_REST;
        for s in &contours.tree {
            let before = links[s.from];
            let unknown = contours.unknown[s.link];
            if unknown.is_none() && contours.input == Input::Slide {
                let here = &mut links[s.link];
                *here = LinkPose::AT_REST;
                here.shift = [x[last], 0.0];
                here.velocity.shift = [rates[last], 0.0];
                continue;
            }
            let unknown = unknown.unwrap_or(last);
            let (pin, turning) = (before.point(at[s.joint]), rates[unknown]);
            let tried = &self.walk.equations.turns[unknown];
            let mut here = tried.turned_to(x[unknown]);
            here.shift = sub(pin, here.point(at[s.joint]));
            here.velocity = Velocity {
                turning,
                shift: add_scaled(before.velocity.at(pin), -turning, quarter(pin)),
            };
            links[s.link] = here;
        }
    }

    fn forces(&mut self, at: &Vec<Point>, links: &[LinkPose]) -> Option<ForceFigures> {
        let friction = &self.skeleton.limits.task.friction;
        let solved = self.forces.solve(self.skeleton, links, at);
        solved.then(|| self.forces.figures(self.skeleton, links, friction))
    }
}
