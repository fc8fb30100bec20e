//! Figures of places over the stroke of a task, and their cost.

use super::forces::ForceFigures;
use super::gathered::{Between, Gathered};
use super::motion::Motion;
use super::planes::{Meetings, Stacking};
use super::pose::LinkPose;
use super::walk::{SETTLED, StrokeEnd};
use crate::geom::vector::{dot, length, sub};
use crate::synthesis::place::Point;
use crate::synthesis::places::Places;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::sketch::layout_quality::{
    LayoutMotion, Looks, angle_degrees, transmission_sine,
};
use crate::synthesis::task::Limits;

/// Poses of a stroke during the search. They rank places as well as fifty poses do.
const COARSE: Grid = Grid {
    steps: 5.0,
    finest: 0.01,
    settled: 1e-3,
    forces_everywhere: false,
};

/// Only the drawn pose.
const DRAWN: Grid = Grid {
    steps: 0.0,
    ..COARSE
};

/// Poses of a stroke whose figures are reported.
const FINE: Grid = Grid {
    steps: 48.0,
    finest: 1e-5,
    settled: SETTLED,
    forces_everywhere: true,
};

/// Poses at which a stroke is evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Grid {
    /// Number of steps over the task's stroke; 0 for only the drawn pose.
    steps: f64,
    /// Accuracy of an end that comes before the task's end, as a fraction of the stroke.
    finest: f64,
    /// Bound for the last correction of a pose, in rad.
    settled: f64,
    /// Whether joint forces are solved at every pose, or only at the drawn pose and at both ends.
    forces_everywhere: bool,
}

/// Figures of a stroke, or of its reachable part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeFigures {
    /// Least and greatest distance between the tips, in millimetres, within the range that the task asks for.
    pub reached: [f64; 2],
    /// Why the tips come no nearer, and no farther apart, if the task asks for more.
    pub ends: [Option<StrokeEnd>; 2],
    /// The least and the greatest rate of the drive over the opening, in mm or rad per millimetre: by virtual work, the force of a jaw.
    pub rates: [f64; 2],
    /// The least force of a jaw: N for 1 N of the drive, or for 1 Nm if it turns.
    pub force: f64,
    /// The travel of the drive at both ends, from its drawn position, in mm or rad.
    pub drive: [f64; 2],
    /// The least transmission angle, of rods and by joint forces at driver and jaws, in degrees.
    pub transmission: f64,
    /// The least share of the tips' motion that closes them; 0 if one opens as the others close.
    pub straightness: f64,
    /// The greatest turn of a jaw between any two poses, in degrees.
    pub turn: f64,
    /// Width and height of the box around pins, tips and pitch circles, in millimetres.
    pub size: [f64; 2],
    /// Smallest distance between two pins, in millimetres; infinite if it is not asked for.
    pub pin_distance: f64,
    /// Smallest distance of each jaw's half (pins and pitch circles) from the middle, in millimetres; negative if it crosses the middle.
    pub on_side: f64,
    /// Longest over shortest length of a cylinder between two links, from pin to pin; 1 if there is none.
    pub pulled_out: f64,
    /// How far the tips are drawn ahead of all pins, in millimetres; infinite if it is not asked for, or if the part is not ahead.
    pub reach: f64,
    /// Figures of the joint forces.
    pub forces: ForceFigures,
}

impl StrokeFigures {
    /// Returns the greatest force of a jaw over the least.
    #[must_use]
    pub fn force_ratio(&self) -> f64 {
        self.rates[1] / self.rates[0].max(1e-12)
    }
}

/// When the evaluation of a stroke ends without a result. Further poses improve no figure.
#[derive(Debug, Clone, Copy)]
enum StopAt {
    Never,
    /// Once it costs more.
    Cost(f64),
    /// Once a requirement of the task is not met.
    Shortfall,
}

/// Progress of a stroke in both directions: distance between the tips, travel of the drive, and why the stroke ends.
struct ReachedStroke {
    reached: [f64; 2],
    drive: [f64; 2],
    ends: [Option<StrokeEnd>; 2],
}

/// Evaluates strokes, one after another.
#[derive(Debug)]
pub struct Judge<'a> {
    pub(in crate::synthesis) motion: Motion<'a>,
    pub(super) links: Vec<LinkPose>,
    gathered: Gathered,
    /// The overlaps of links over the stroke, if they are asked for.
    meetings: Option<Meetings>,
}

impl<'a> Judge<'a> {
    /// Returns a judge of the places of a sketch.
    #[must_use]
    pub fn new(sketch: &'a Sketch<'a>) -> Judge<'a> {
        Judge {
            links: sketch.at_rest.clone(),
            gathered: Gathered::new(sketch.bones.tips.len()),
            meetings: None,
            motion: Motion::new(sketch),
        }
    }

    /// Watches overlaps on the next stroke, unless a link represents several images of it or turns out of the plane.
    pub fn watch_meetings(&mut self) {
        let sketch = self.motion.sketch;
        let bones = &sketch.bones;
        let each_drawn = bones.sides == bones.jaws.len();
        self.meetings = (each_drawn && !sketch.rules.threaded).then(|| Meetings::new(bones));
    }

    /// Returns the layers in which the links passed each other on the watched stroke.
    ///
    /// # Complexity
    /// That of [`Meetings::fewest_planes`].
    pub fn find_stacking(&mut self) -> Stacking {
        let bones = &self.motion.sketch.bones;
        let met = self.meetings.take();
        met.map_or(Stacking::NotAsked, |m| m.fewest_planes(bones))
    }

    fn limits(&self) -> &Limits {
        &self.motion.sketch.limits
    }

    /// Moves to the drawn pose of places. Returns false if the pose is singular.
    fn stand_drawn(&mut self, at: &Places) -> bool {
        self.motion.place(at);
        self.motion.walk.stand_drawn()
    }

    /// Moves to the drawn pose of places, and returns its motion for a unit speed of the driver. `None` if the pose is singular.
    ///
    /// # Complexity
    /// O(n³) for n links.
    pub(in crate::synthesis) fn drawn_motion(&mut self, at: &Places) -> Option<LayoutMotion> {
        self.motion.walk.settled = COARSE.settled;
        if !self.stand_drawn(at) {
            return None;
        }
        self.motion.write_pose(at, &mut self.links);
        let rate = self.drive_rate();
        let velocity_of = |link: usize| self.links[link].velocity.divided_by(rate);
        let sketch = self.motion.sketch;
        let least_force = sketch.limits.task.least_force;
        Some(
            sketch
                .bones
                .motion_cost(&at.points, velocity_of, least_force),
        )
    }

    /// Returns the figures of the drawing and of its motion; `None` if the pose is singular.
    ///
    /// # Complexity
    /// That of all crossings, and of `Judge::drawn_motion`.
    pub fn drawn_figures(&mut self, at: &Places) -> Option<Looks> {
        let motion = self.drawn_motion(at)?;
        self.motion.sketch.drawn_figures(at, motion)
    }

    /// Returns the figures of a stroke that begins at the drawn pose of [`Judge::drawn_motion`]: of the few poses of the search if `whole`,
    /// otherwise of only the drawn pose. `None` if the cost is more than `most`.
    ///
    /// # Complexity
    /// As [`Judge::coarse_figures`] for a whole stroke, otherwise that of one pose.
    pub(in crate::synthesis) fn figures_from_drawn(
        &mut self,
        at: &Places,
        whole: bool,
        most: f64,
    ) -> Option<StrokeFigures> {
        let grid = if whole { COARSE } else { DRAWN };
        self.follow_from_drawn(at, grid, StopAt::Cost(most))
    }

    /// Returns the figures of places at the few poses of the search. `None` if the drawn pose is singular, or if the cost is more than
    /// `most`, which the first poses may show.
    ///
    /// # Complexity
    /// Some corrections of O(n³) for n links, for each of some seven poses.
    pub fn coarse_figures(&mut self, at: &Places, most: f64) -> Option<StrokeFigures> {
        self.follow_grid(at, COARSE, StopAt::Cost(most))
    }

    /// Returns the figures of places at the poses for reports; `None` if the drawn pose is singular.
    ///
    /// # Complexity
    /// As [`Judge::coarse_figures`], for some fifty poses.
    pub fn fine_figures(&mut self, at: &Places) -> Option<StrokeFigures> {
        self.follow_grid(at, FINE, StopAt::Never)
    }

    /// Returns true if places do the task at the poses for reports.
    ///
    /// # Complexity
    /// As [`Judge::fine_figures`], or less if they do not.
    pub(in crate::synthesis) fn does_task(&mut self, at: &Places) -> bool {
        self.follow_grid(at, FINE, StopAt::Shortfall).is_some()
    }

    /// Returns the figures of places at the poses of a grid; `None` if the drawn pose is singular, or if the evaluation stops.
    ///
    /// # Complexity
    /// As [`Judge::coarse_figures`], in proportion to the number of poses.
    fn follow_grid(&mut self, at: &Places, grid: Grid, stop: StopAt) -> Option<StrokeFigures> {
        self.motion.walk.settled = grid.settled;
        if !self.stand_drawn(at) {
            return None;
        }
        self.follow_from_drawn(at, grid, stop)
    }

    /// Returns the figures of places at whose drawn pose the walk stands; `None` if the evaluation stops.
    fn follow_from_drawn(
        &mut self,
        at: &Places,
        grid: Grid,
        stop: StopAt,
    ) -> Option<StrokeFigures> {
        let task = self.limits().task;
        let drawn = 2.0 * f64::from(task.half_opening());
        let finest = grid.finest * task.opening_span();
        // Both ends count as reached until the walk shows otherwise.
        let mut way = ReachedStroke {
            reached: [task.narrowest, task.widest],
            drive: [0.0; 2],
            ends: [None; 2],
        };
        self.gathered.begin_stroke();
        if task.reach > 0.0 {
            let sketch = self.motion.sketch;
            self.gathered.reach = sketch.bones.tip_reach(&at.points);
        }
        self.look(at);
        if self.is_stopped(&way, stop) {
            return None;
        }
        self.weigh_forces(at);
        let ends = [task.narrowest, task.widest].into_iter().enumerate();
        for (n, to) in ends.filter(|_| grid.steps > 0.0) {
            if n > 0 {
                self.motion.walk.go_back();
            }
            let all = to - drawn;
            let count = (all.abs() / task.opening_span() * grid.steps)
                .ceil()
                .max(1.0);
            let mut i = 0.0;
            while i < count && way.ends[n].is_none() {
                if self.is_stopped(&way, stop) {
                    return None;
                }
                i += 1.0;
                way.ends[n] = self.motion.walk.advance_to(all * i / count, finest).err();
                self.look(at);
                if grid.forces_everywhere || i == count || way.ends[n].is_some() {
                    self.weigh_forces(at);
                }
            }
            let walk = &self.motion.walk;
            way.reached[n] = drawn + walk.wider;
            way.drive[n] = walk.x.last().copied().unwrap_or(0.0);
        }
        (!self.is_stopped(&way, stop)).then(|| self.figures(&way))
    }

    /// Returns true if the figures so far end the evaluation.
    fn is_stopped(&self, way: &ReachedStroke, stop: StopAt) -> bool {
        match stop {
            StopAt::Never | StopAt::Cost(f64::INFINITY) => false,
            StopAt::Cost(most) => self.limits().stroke_cost(&self.figures(way)) > most,
            StopAt::Shortfall => {
                let swings = self.motion.sketch.bones.all_swing();
                self.limits()
                    .find_shortfall(&self.figures(way), swings)
                    .is_some()
            }
        }
    }

    fn figures(&self, way: &ReachedStroke) -> StrokeFigures {
        let g = &self.gathered;
        StrokeFigures {
            reached: way.reached,
            ends: way.ends,
            drive: way.drive,
            rates: g.rates.0,
            force: self.motion.sketch.bones.jaw_force(g.rates.0[0]),
            transmission: angle_degrees(g.sine).min(g.forces.transmission),
            straightness: g.straightness,
            turn: self.jaw_turns().fold(0.0, f64::max).to_degrees(),
            size: g.sides.map(Between::span),
            pin_distance: g.nearest.sqrt(),
            on_side: g.on_side,
            pulled_out: g.cylinder.force_ratio(),
            reach: g.reach,
            forces: g.forces,
        }
    }

    /// Returns the greatest turn of each jaw between two poses of the last stroke, in rad.
    pub fn jaw_turns(&self) -> impl Iterator<Item = f64> {
        self.gathered.turns.iter().map(|t| t.span())
    }

    /// Returns the rate of the drive over the width at the last pose, in mm or rad per millimetre. Negative if the drive goes back as the
    /// jaws open.
    #[must_use]
    pub fn drive_rate(&self) -> f64 {
        self.motion.walk.drive_rate()
    }

    /// Returns how much farther than the task asks the tips can come, narrower and wider, in millimetres and at most `most`. 0 if they do
    /// not come as far as the task asks.
    pub fn stroke_margin(&mut self, at: &Places, most: f64) -> [f64; 2] {
        let task = self.limits().task;
        let drawn = 2.0 * f64::from(task.half_opening());
        [(task.narrowest, -most), (task.widest, most)].map(|(end, more)| {
            let goes = self.stand_drawn(at);
            let to = end - drawn;
            let walk = &mut self.motion.walk;
            // The walk may end before; its position is the answer.
            let _ = walk.advance_to(to + more, 1e-3);
            let farther = (walk.wider - to) * more.signum();
            if goes { farther.max(0.0) } else { 0.0 }
        })
    }

    /// Takes the figures of the joint forces. They are the worst ones if there is not exactly one solution.
    fn weigh_forces(&mut self, at: &Places) {
        let here = self.motion.force_figures(at, &self.links);
        let here = here.unwrap_or(ForceFigures::WORST);
        self.gathered.forces = self.gathered.forces.worse_of(here);
    }

    fn look(&mut self, at: &Places) {
        self.motion.write_pose(at, &mut self.links);
        let sketch = self.motion.sketch;
        let (bones, points) = (&sketch.bones, &at.points);
        let g = &mut self.gathered;
        g.rates.take(self.motion.walk.drive_rate().abs());
        for &(link, ends) in &bones.rods {
            let pose = &self.links[link];
            let ends = ends.map(|i| pose.moved_point(points[i]));
            g.sine = g.sine.min(transmission_sine(&pose.velocity, ends));
        }
        self.look_at_tips();
        self.look_at_joints(at);
        let sketch = self.motion.sketch;
        let (bones, points) = (&sketch.bones, &at.points);
        if let Some(meetings) = &mut self.meetings {
            let ends = (0..bones.joints.len()).map(|joint| sketch.link_of(at, joint));
            let of = ends.chain(bones.jaws.iter().map(|&jaw| Some(jaw)));
            let now = of
                .zip(points)
                .map(|(link, &p)| link.map_or(p, |l| self.links[l].moved_point(p)));
            meetings.take_pose(bones, &now.collect::<Vec<Point>>());
        }
    }

    /// Takes the places and motions of the tips.
    fn look_at_tips(&mut self) {
        let sketch = self.motion.sketch;
        let bones = &sketch.bones;
        let g = &mut self.gathered;
        let (mut opens, mut all, mut least) = (0.0, 0.0, f64::INFINITY);
        for (n, (&jaw, inward)) in bones.jaws.iter().zip(&bones.inward).enumerate() {
            let pose = &self.links[jaw];
            let tip = pose.moved_point(bones.tips[n]);
            let velocity = pose.velocity.velocity_at(tip);
            let open = -dot(velocity, *inward);
            (opens, all, least) = (opens + open, all + length(velocity), least.min(open));
            g.turns[n].take(pose.angle);
            sketch.each_copy(bones.joints.len() + n, tip, &mut |p| g.take(p));
        }
        let share = if least > 0.0 { opens / all } else { 0.0 };
        g.straightness = g.straightness.min(share);
    }

    /// Takes the places of joints and pitch circles, and the length of a cylinder.
    fn look_at_joints(&mut self, at: &Places) {
        let sketch = self.motion.sketch;
        let (bones, points) = (&sketch.bones, &at.points);
        let apart = sketch.limits.task.pin_distance > 0.0;
        let g = &mut self.gathered;
        g.pins.clear();
        for (i, place) in points[..bones.joints.len()].iter().enumerate() {
            let apart = apart && bones.together[i].trailing_zeros() as usize == i;
            if let Some(link) = sketch.link_of(at, i) {
                let now = self.links[link].moved_point(*place);
                sketch.each_copy(i, now, &mut |p| {
                    g.take(p);
                    if apart {
                        g.take_pin(p);
                    }
                });
                g.take_on_side(bones.halves[i] * now[1], bones.halves[i]);
            }
        }
        sketch.each_circle(at, &mut |centre, radius, apart| {
            let Some(link) = sketch.link_of(at, centre) else {
                return;
            };
            let now = self.links[link].moved_point(points[centre]);
            sketch.each_copy(centre, now, &mut |p| {
                g.take(p.map(|x| x - radius));
                g.take(p.map(|x| x + radius));
            });
            let half = if apart { bones.halves[centre] } else { 0.0 };
            g.take_on_side(half * now[1] - radius, half);
        });
        if let Some(ends) = bones.cylinder {
            let [a, b] = ends.map(|(link, joint)| self.links[link].moved_point(points[joint]));
            g.cylinder.take(length(sub(b, a)));
        }
    }
}
