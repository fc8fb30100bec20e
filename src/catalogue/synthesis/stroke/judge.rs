//! What places do over the stroke of a task, and what that costs.

use super::forces::{ForceFigures, JointForces};
use super::pose::LinkPose;
use super::walk::{StrokeEnd, Walk};
use crate::chains::layout_symmetry::Input;
use crate::geom::vector::{add_scaled, dot, length, quarter, sub};
use crate::synthesis::layout_quality::{beyond, transmission};
use crate::synthesis::point::Point;
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::task::{AskedMotion, PARALLEL};
use crate::synthesis::velocities::Velocity;

/// Poses of a stroke while places are tried, and how near to its end it is followed: a fraction of the stroke.
const COARSE: Grid = Grid {
    steps: 10.0,
    finest: 0.01,
    forces_everywhere: false,
};

/// Where a stroke is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// How many steps there are over the task's stroke.
    pub steps: f64,
    /// How near to an end before the task's it is followed, over the stroke.
    pub finest: f64,
    /// Whether joint forces are solved for at every pose, or at the drawn one and both ends alone.
    pub forces_everywhere: bool,
}

/// Figures of a stroke. Where it does not reach, of what is reached.
#[derive(Debug, Clone, PartialEq)]
pub struct StrokeFigures {
    /// How far apart the tips come, least and greatest, in millimetres: no farther than the task asks.
    pub reached: [f64; 2],
    /// Why no nearer, and no farther, where it is less than the task asks.
    pub ends: [Option<StrokeEnd>; 2],
    /// The drive's way by the opening where it is least and greatest, mm or rad a millimetre: by work, the force of each of two jaws
    /// over the drive's.
    pub rates: [f64; 2],
    /// The drive at both ends, from where it is drawn: mm or rad.
    pub drive: [f64; 2],
    /// The least angle between a rod and the motion across it at its ends, in degrees; 90 where there are no rods.
    pub transmission: f64,
    /// The least share of the tips' motion that closes them; 0 where one opens as the others close.
    pub straightness: f64,
    /// How far each jaw turns from where it turned least to where it turned most, in rad.
    pub turns: Vec<f64>,
    /// The box round pins and tips, in millimetres.
    pub size: [f64; 2],
    /// What the joint forces say.
    pub forces: ForceFigures,
}

impl StrokeFigures {
    /// The greatest force of a jaw over the least.
    #[must_use]
    pub fn force_ratio(&self) -> f64 {
        self.rates[1] / self.rates[0].max(1e-12)
    }

    /// The most that a jaw turns, in degrees.
    #[must_use]
    pub fn turn(&self) -> f64 {
        self.turns
            .iter()
            .fold(0.0_f64, |m, t| m.max(*t))
            .to_degrees()
    }
}

/// Least and greatest of figures.
#[derive(Debug, Clone, Copy)]
struct Between([f64; 2]);

impl Between {
    const NOTHING: Between = Between([f64::INFINITY, f64::NEG_INFINITY]);

    fn take(&mut self, x: f64) {
        self.0 = [self.0[0].min(x), self.0[1].max(x)];
    }

    fn span(self) -> f64 {
        (self.0[1] - self.0[0]).max(0.0)
    }
}

/// What is gathered on the way.
#[derive(Debug, Clone)]
struct Gathered {
    transmission: f64,
    straightness: f64,
    rates: Between,
    turns: Vec<Between>,
    sides: [Between; 2],
    forces: ForceFigures,
}

/// How far a stroke has come, narrower and wider: how far apart the tips are, the drive there, and why it ends.
struct ReachedStroke {
    reached: [f64; 2],
    drive: [f64; 2],
    ends: [Option<StrokeEnd>; 2],
}

/// Strokes of a skeleton, one after another.
#[derive(Debug)]
pub struct Judge<'a> {
    skeleton: &'a Skeleton<'a>,
    pub(super) walk: Walk<'a>,
    pub(super) links: Vec<LinkPose>,
    gathered: Gathered,
    forces: JointForces,
}

impl<'a> Judge<'a> {
    /// Of a skeleton.
    #[must_use]
    pub fn new(skeleton: &'a Skeleton<'a>) -> Judge<'a> {
        Judge {
            skeleton,
            walk: Walk::new(&skeleton.closure),
            links: vec![LinkPose::default(); skeleton.structure.chain.links()],
            gathered: Gathered {
                transmission: 90.0,
                straightness: 1.0,
                rates: Between::NOTHING,
                turns: vec![Between::NOTHING; skeleton.tips.len()],
                sides: [Between::NOTHING; 2],
                forces: ForceFigures::BEST,
            },
            forces: JointForces::new(skeleton),
        }
    }

    /// The figures of places at a dozen poses, as they are looked at while places are tried; `None` where the drawn pose is
    /// singular, or where they cost more than `most`, which the first poses may tell.
    ///
    /// # Complexity
    /// Some corrections of O(n³) for n links, for each of some dozen poses.
    pub fn coarse(&mut self, at: &[Point], most: f64) -> Option<StrokeFigures> {
        self.follow(at, COARSE, most)
    }

    /// The figures of places, at the poses of a grid; `None` where the drawn pose is singular, or where they cost more than `most`.
    ///
    /// # Complexity
    /// As [`Judge::coarse`], by the number of poses.
    pub fn follow(&mut self, at: &[Point], grid: Grid, most: f64) -> Option<StrokeFigures> {
        if !self.walk.stand(at) {
            return None;
        }
        let task = self.skeleton.limits.task;
        let drawn = 2.0 * f64::from(task.half_opening());
        let finest = grid.finest * task.span();
        // Until an end is reached, or is not, nothing is said against it.
        let mut way = ReachedStroke {
            reached: [task.narrowest, task.widest],
            drive: [0.0; 2],
            ends: [None; 2],
        };
        self.gathered.begin();
        self.look(at);
        if self.is_dearer(&way, most) {
            return None;
        }
        self.weigh(at);
        for (n, to) in [task.narrowest, task.widest].into_iter().enumerate() {
            if n > 0 && !self.walk.back() {
                return None;
            }
            let all = to - drawn;
            let count = (all.abs() / task.span() * grid.steps).ceil().max(1.0);
            let mut i = 0.0;
            while i < count && way.ends[n].is_none() {
                if self.is_dearer(&way, most) {
                    return None;
                }
                i += 1.0;
                way.ends[n] = self.walk.advance(all * i / count, finest).err();
                self.look(at);
                if grid.forces_everywhere || i == count || way.ends[n].is_some() {
                    self.weigh(at);
                }
            }
            way.reached[n] = drawn + self.walk.wider;
            way.drive[n] = self.walk.x.last().copied().unwrap_or(0.0);
        }
        (!self.is_dearer(&way, most)).then(|| self.figures(&way))
    }

    /// Whether what is known so far costs more than `most`: more poses make no figure better.
    fn is_dearer(&self, way: &ReachedStroke, most: f64) -> bool {
        most < f64::INFINITY && self.skeleton.stroke_cost(&self.figures(way)) > most
    }

    fn figures(&self, way: &ReachedStroke) -> StrokeFigures {
        let g = &self.gathered;
        StrokeFigures {
            reached: way.reached,
            ends: way.ends,
            drive: way.drive,
            rates: g.rates.0,
            transmission: g.transmission,
            straightness: g.straightness,
            turns: g.turns.iter().map(|t| t.span()).collect(),
            size: g.sides.map(Between::span),
            forces: g.forces,
        }
    }

    /// How fast the drive goes by the width at the last pose, mm or rad a millimetre: negative where it goes back as jaws open.
    #[must_use]
    pub fn drive_rate(&self) -> f64 {
        self.walk.rate()
    }

    /// How much farther than the task asks the tips can come, narrower and wider, in millimetres and at most `most`; 0 where they
    /// do not come as far.
    pub fn margin(&mut self, at: &[Point], most: f64) -> [f64; 2] {
        let task = self.skeleton.limits.task;
        let drawn = 2.0 * f64::from(task.half_opening());
        [(task.narrowest, -most), (task.widest, most)].map(|(end, more)| {
            let goes = self.walk.stand(at);
            let to = end - drawn;
            // That it ends on the way is what is asked.
            let _ = self.walk.advance(to + more, 1e-3);
            let farther = (self.walk.wider - to) * more.signum();
            if goes { farther.max(0.0) } else { 0.0 }
        })
    }

    /// Takes in what the joint forces say; where they have no one solution, the worst.
    fn weigh(&mut self, at: &[Point]) {
        let (skeleton, links) = (self.skeleton, &self.links);
        let here = if self.forces.solve(skeleton, links, at) {
            (self.forces).figures(skeleton, links, &skeleton.limits.task.friction)
        } else {
            ForceFigures::WORST
        };
        self.gathered.forces = self.gathered.forces.worse(here);
    }

    /// Where the links are at the pose that the walk stands in.
    fn pose(&mut self, at: &[Point]) {
        let contours = &self.skeleton.contours;
        let (x, rates) = (&self.walk.x, &self.walk.rates);
        let last = x.len() - 1;
        self.links[self.skeleton.structure.roles.frame] = LinkPose {
            turn: [1.0, 0.0],
            ..LinkPose::default()
        };
        for s in &contours.tree {
            let before = self.links[s.from];
            let unknown = contours.unknown[s.link];
            if unknown.is_none() && contours.input == Input::Slide {
                self.links[s.link] = LinkPose {
                    turn: [1.0, 0.0],
                    shift: [x[last], 0.0],
                    velocity: Velocity {
                        turning: 0.0,
                        shift: [rates[last], 0.0],
                    },
                };
                continue;
            }
            let unknown = unknown.unwrap_or(last);
            let (pin, turning) = (before.point(at[s.joint]), rates[unknown]);
            let (sine, cosine) = x[unknown].sin_cos();
            let mut here = LinkPose {
                turn: [cosine, sine],
                ..LinkPose::default()
            };
            here.shift = sub(pin, here.point(at[s.joint]));
            here.velocity = Velocity {
                turning,
                shift: add_scaled(before.velocity.at(pin), -turning, quarter(pin)),
            };
            self.links[s.link] = here;
        }
    }

    fn look(&mut self, at: &[Point]) {
        self.pose(at);
        let s = self.skeleton;
        let g = &mut self.gathered;
        g.rates.take(self.walk.rate().abs());
        for &(link, ends) in &s.rods {
            let pose = &self.links[link];
            let ends = ends.map(|i| pose.point(at[i]));
            g.transmission = g.transmission.min(transmission(&pose.velocity, ends));
        }
        let (mut opens, mut all, mut least) = (0.0, 0.0, f64::INFINITY);
        for (n, (&jaw, inward)) in s.structure.roles.jaws.iter().zip(&s.inward).enumerate() {
            let pose = &self.links[jaw];
            let tip = pose.point(s.tips[n]);
            let velocity = pose.velocity.at(tip);
            let open = -dot(velocity, *inward);
            (opens, all, least) = (opens + open, all + length(velocity), least.min(open));
            let angle = s.contours.unknown[jaw].map_or(0.0, |u| self.walk.x[u]);
            g.turns[n].take(angle);
            g.take(tip);
        }
        let share = if least > 0.0 { opens / all } else { 0.0 };
        g.straightness = g.straightness.min(share);
        for (i, &(link, _)) in s.rules.pins.iter().enumerate() {
            g.take(self.links[link].point(at[i]));
        }
    }
}

impl Gathered {
    fn begin(&mut self) {
        (self.transmission, self.straightness) = (90.0, 1.0);
        self.rates = Between::NOTHING;
        self.turns.fill(Between::NOTHING);
        self.sides = [Between::NOTHING; 2];
        self.forces = ForceFigures::BEST;
    }

    fn take(&mut self, point: Point) {
        for (side, x) in self.sides.iter_mut().zip(point) {
            side.take(x);
        }
    }
}

impl Skeleton<'_> {
    /// What a stroke costs, 0 at best. First that both ends are reached, then what the task and the limits ask.
    #[must_use]
    pub fn stroke_cost(&self, f: &StrokeFigures) -> f64 {
        let task = &self.limits.task;
        let missing = [f.reached[0] - task.narrowest, task.widest - f.reached[1]];
        let mut cost = 0.0;
        for m in missing.into_iter().filter(|m| *m > 0.0) {
            cost += 6.0 + 40.0 * m / task.span();
        }
        let ratio = f.force_ratio().ln();
        let asked = (0.9 * task.force_ratio).max(1.0).ln();
        cost += 3.0 * beyond(ratio - asked, 0.2).min(10.0);
        cost += beyond(30.0 - f.transmission, 15.0);
        cost += 2.0 * beyond(0.6 - f.straightness, 0.5);
        cost += beyond(20.0 - f.forces.transmission, 10.0);
        cost += 2.0 * beyond((f.forces.peak / 6.0).max(1e-12).ln(), 0.7).min(10.0);
        cost += beyond(0.8 - f.forces.efficiency, 0.2);
        let turn = f.turn();
        cost += match task.motion {
            AskedMotion::Parallel => 2.0 * beyond(turn - 0.5 * PARALLEL, 0.5).min(10.0),
            AskedMotion::Any | AskedMotion::Swinging => beyond(turn - 40.0, 20.0).min(20.0),
        };
        for (size, most) in f.size.into_iter().zip(task.room) {
            if most > 0.0 {
                cost += beyond(size - most + 2.0, 4.0).min(10.0);
            }
        }
        cost
    }
}
