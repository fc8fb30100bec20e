//! Motion of a structure over its stroke, as far as the judge needs it.

use super::closure::Arms;
use super::forces::{ForceFigures, HingeForces};
use super::pose::LinkPose;
use super::walk::{FitEquations, RADIAN, Walk};
use crate::chains::Input;
use crate::geom::vector::{add_scaled, quarter_turn, sub};
use crate::synthesis::equations::elimination::SmallSystem;
use crate::synthesis::equations::pose_forces::{force_figures, joint_forces};
use crate::synthesis::equations::velocities::{Contours, Velocity};
use crate::synthesis::equations::{PoseEquations, place_of};
use crate::synthesis::place::Point;
use crate::synthesis::places::Places;
use crate::synthesis::sketch::Sketch;

/// The equations of the links at a pose. If all joints are hinges, turns are the only unknowns.
#[derive(Debug)]
pub(in crate::synthesis) enum Equations<'a> {
    /// The equations of contours.
    Turns(&'a Contours, Arms<'a>, HingeForces),
    /// The equations of joints.
    Poses(PoseEquations<'a>),
}

impl FitEquations for Equations<'_> {
    fn size(&self) -> usize {
        match self {
            Equations::Turns(_, arms, _) => arms.size(),
            Equations::Poses(poses) => poses.size(),
        }
    }

    fn radian(&self, unknown: usize) -> f64 {
        match self {
            Equations::Turns(_, arms, _) => arms.radian(unknown),
            Equations::Poses(poses) => poses.radian(unknown),
        }
    }

    fn fill(&mut self, x: &[f64], wider: f64, rows: &mut SmallSystem) {
        match self {
            Equations::Turns(_, arms, _) => arms.fill(x, wider, rows),
            Equations::Poses(poses) => poses.fill(x, wider, rows),
        }
    }
}

/// Strokes of a sketch, one after another.
#[derive(Debug)]
pub(in crate::synthesis) struct Motion<'a> {
    /// The structure that moves.
    pub(in crate::synthesis) sketch: &'a Sketch<'a>,
    /// The walk, at its current pose.
    pub(super) walk: Walk<Equations<'a>>,
}

impl<'a> Motion<'a> {
    pub(super) fn new(sketch: &'a Sketch<'a>) -> Motion<'a> {
        let both = sketch.contours.as_ref().zip(sketch.closure.as_ref());
        let turns = both.map(|(contours, closure)| {
            let forces = HingeForces::new(sketch, contours);
            Equations::Turns(contours, Arms::new(closure), forces)
        });
        let equations = turns.unwrap_or_else(|| Equations::Poses(PoseEquations::new(sketch)));
        Motion {
            walk: Walk::new(equations),
            sketch,
        }
    }

    /// Inserts places into the equations.
    pub(super) fn place(&mut self, at: &Places) {
        match &mut self.walk.equations {
            Equations::Turns(_, arms, _) => arms.place(&at.points),
            Equations::Poses(poses) => poses.at = Some(at.clone()),
        }
    }

    /// Writes the poses and velocities of the links at the current pose of the walk.
    pub(super) fn write_pose(&self, at: &Places, links: &mut [LinkPose]) {
        match &self.walk.equations {
            Equations::Turns(contours, arms, _) => {
                self.pose_turned(contours, arms, &at.points, links)
            }
            Equations::Poses(poses) => self.pose_moved(poses, links),
        }
    }

    fn pose_moved(&self, poses: &PoseEquations<'_>, links: &mut [LinkPose]) {
        let rates = &self.walk.rates;
        poses.unpack_poses(&self.walk.x, links);
        for (link, pose) in links.iter_mut().enumerate() {
            let Some(k) = place_of(link, self.sketch.bones.frame) else {
                *pose = LinkPose::AT_REST;
                continue;
            };
            let turning = rates[k + 2] / RADIAN;
            // The velocity of the point that is at the origin now.
            let shift = [rates[k], rates[k + 1]];
            pose.velocity = Velocity {
                turning,
                shift: add_scaled(shift, -turning, quarter_turn(pose.shift)),
            };
        }
    }

    fn pose_turned(
        &self,
        contours: &Contours,
        arms: &Arms<'_>,
        at: &[Point],
        links: &mut [LinkPose],
    ) {
        let (x, rates) = (&self.walk.x, &self.walk.rates);
        let last = x.len() - 1;
        links[self.sketch.bones.frame] = LinkPose::AT_REST;
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
            let (pin, turning) = (before.moved_point(at[s.joint]), rates[unknown]);
            let tried = &arms.turns[unknown];
            let mut here = tried.turned_to(x[unknown]);
            here.shift = sub(pin, here.moved_point(at[s.joint]));
            here.velocity = Velocity {
                turning,
                shift: add_scaled(
                    before.velocity.velocity_at(pin),
                    -turning,
                    quarter_turn(pin),
                ),
            };
            links[s.link] = here;
        }
    }

    /// Returns the figures of the joint forces at a pose; `None` if the forces do not have exactly one solution.
    pub(super) fn force_figures(
        &mut self,
        at: &Places,
        links: &[LinkPose],
    ) -> Option<ForceFigures> {
        match &mut self.walk.equations {
            Equations::Turns(contours, _, hinges) => {
                let solved = hinges.solve_forces(self.sketch, contours, links, &at.points);
                solved.then(|| force_figures(self.sketch, at, links, &hinges.pins))
            }
            Equations::Poses(_) => {
                let forces = joint_forces(self.sketch, at, links)?;
                Some(force_figures(self.sketch, at, links, &forces))
            }
        }
    }
}
