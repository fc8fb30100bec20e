//! What places do over the stroke of a task, and what that costs.

use super::forces::ForceFigures;
use super::motion::{HingeMotion, StrokeMotion};
use super::planes::{Meetings, Stacking};
use super::pose::LinkPose;
use super::shortfall::NOISE;
use super::walk::{SETTLED, StrokeEnd};
use crate::geom::vector::{dot, length, sub};
use crate::synthesis::layout_quality::{DEAR, beyond, transmission};
use crate::synthesis::limits::Limits;
use crate::synthesis::point::Point;
use crate::synthesis::skeleton::Skeleton;
use crate::synthesis::sketch::LayoutSketch;
use crate::synthesis::task::{AskedMotion, PARALLEL, Task};

/// Poses of a stroke while places are tried, and how near to its end it is followed: a fraction of the stroke.
const COARSE: Grid = Grid {
    steps: 10.0,
    finest: 0.01,
    settled: 3e-4,
    forces_everywhere: false,
};

/// Where a stroke is looked at that is told.
const FINE: Grid = Grid {
    steps: 48.0,
    finest: 1e-5,
    settled: SETTLED,
    forces_everywhere: true,
};

/// Where a stroke is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Grid {
    /// How many steps there are over the task's stroke.
    steps: f64,
    /// How near to an end before the task's it is followed, over the stroke.
    finest: f64,
    /// The last correction of a pose is smaller than this, in rad.
    settled: f64,
    /// Whether joint forces are solved for at every pose, or at the drawn one and both ends alone.
    forces_everywhere: bool,
}

/// Figures of a stroke. Where it does not reach, of what is reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeFigures {
    /// How far apart the tips come, least and greatest, in millimetres: no farther than the task asks.
    pub reached: [f64; 2],
    /// Why no nearer, and no farther, where it is less than the task asks.
    pub ends: [Option<StrokeEnd>; 2],
    /// The drive's way by the opening where it is least and greatest, mm or rad a millimetre: by work, the force of each of two jaws
    /// over the drive's.
    pub rates: [f64; 2],
    /// The least force of a jaw: N for 1 N of the drive, or for 1 Nm where it turns.
    pub force: f64,
    /// The drive at both ends, from where it is drawn: mm or rad.
    pub drive: [f64; 2],
    /// The least angle between a rod and the motion across it at its ends, in degrees; 90 where there are no rods.
    pub transmission: f64,
    /// The least share of the tips' motion that closes them; 0 where one opens as the others close.
    pub straightness: f64,
    /// The most that a jaw turns, from where it turned least to where it turned most, in degrees.
    pub turn: f64,
    /// The box round pins, tips and pitch circles, in millimetres.
    pub size: [f64; 2],
    /// How near two pins come to each other, in millimetres; beyond all bounds where that is not asked.
    pub pin_distance: f64,
    /// How far pins and pitch circles of each jaw's half keep on its side of the middle, in millimetres: less than nothing where they
    /// come beyond it.
    pub on_side: f64,
    /// How long a cylinder between two links is, from pin to pin, pulled out over pushed in; 1 where there is none.
    pub pulled_out: f64,
    /// How far the tips are drawn ahead of all pins, in millimetres; beyond all bounds where that is not asked, or the part is not ahead.
    pub reach: f64,
    /// What the joint forces say.
    pub forces: ForceFigures,
}

impl StrokeFigures {
    /// The greatest force of a jaw over the least.
    #[must_use]
    pub fn force_ratio(&self) -> f64 {
        self.rates[1] / self.rates[0].max(1e-12)
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

    /// The greatest over the least; 1 where nothing was taken.
    fn ratio(self) -> f64 {
        let [least, most] = self.0;
        if least > most {
            1.0
        } else {
            most / least.max(1e-9)
        }
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
    /// The pins at the last pose, and the least square of the distance of two of them.
    pins: Vec<Point>,
    nearest: f64,
    on_side: f64,
    cylinder: Between,
    reach: f64,
}

/// How far a stroke has come, narrower and wider: how far apart the tips are, the drive there, and why it ends.
struct ReachedStroke {
    reached: [f64; 2],
    drive: [f64; 2],
    ends: [Option<StrokeEnd>; 2],
}

/// Strokes, one after another.
#[derive(Debug)]
pub struct Judge<M> {
    pub(in crate::synthesis) motion: M,
    pub(super) links: Vec<LinkPose>,
    gathered: Gathered,
    /// What meets on the way, where that is asked.
    meetings: Option<Meetings>,
}

/// The places of what moves.
pub(in crate::synthesis) type PlacesOf<M> = <<M as StrokeMotion>::Of as LayoutSketch>::JointPlaces;

impl<'a> Judge<HingeMotion<'a>> {
    /// Of a skeleton.
    #[must_use]
    pub fn new(skeleton: &'a Skeleton<'a>) -> Self {
        Judge::of(HingeMotion::new(skeleton))
    }
}

impl<M: StrokeMotion> Judge<M> {
    /// Of what moves.
    #[must_use]
    pub fn of(motion: M) -> Judge<M> {
        let bones = motion.sketch().bones();
        Judge {
            links: vec![LinkPose::AT_REST; bones.of_link.len()],
            gathered: Gathered {
                transmission: 90.0,
                straightness: 1.0,
                rates: Between::NOTHING,
                turns: vec![Between::NOTHING; bones.tips.len()],
                sides: [Between::NOTHING; 2],
                forces: ForceFigures::BEST,
                pins: Vec::new(),
                nearest: f64::INFINITY,
                on_side: f64::INFINITY,
                cylinder: Between::NOTHING,
                reach: f64::INFINITY,
            },
            meetings: None,
            motion,
        }
    }

    /// Watches what meets on the next stroke, unless a link stands for several images of it.
    pub fn watch(&mut self) {
        let bones = self.motion.sketch().bones();
        let all = bones.sides == bones.jaws.len();
        self.meetings = all.then(|| Meetings::new(bones));
    }

    /// The planes in which the links passed each other on the stroke that was watched.
    ///
    /// # Complexity
    /// That of [`Meetings::stacking`].
    pub fn stacking(&mut self) -> Stacking {
        let bones = self.motion.sketch().bones();
        let met = self.meetings.take();
        met.map_or(Stacking::NotAsked, |m| m.stacking(bones))
    }

    fn limits(&self) -> &Limits {
        self.motion.sketch().limits()
    }

    /// Stands at the drawn pose of places; `false` where that is singular.
    fn stand(&mut self, at: &PlacesOf<M>) -> bool {
        self.motion.place(at);
        self.motion.walk_mut().stand()
    }

    /// The figures of places at a dozen poses, as they are looked at while places are tried; `None` where the drawn pose is
    /// singular, or where they cost more than `most`, which the first poses may tell.
    ///
    /// # Complexity
    /// Some corrections of O(n³) for n links, for each of some dozen poses.
    pub fn coarse(&mut self, at: &PlacesOf<M>, most: f64) -> Option<StrokeFigures> {
        self.follow(at, COARSE, most)
    }

    /// The figures of places as they are told; `None` where the drawn pose is singular.
    ///
    /// # Complexity
    /// As [`Judge::coarse`], for some fifty poses.
    pub fn fine(&mut self, at: &PlacesOf<M>) -> Option<StrokeFigures> {
        self.follow(at, FINE, f64::INFINITY)
    }

    /// The figures of places, at the poses of a grid; `None` where the drawn pose is singular, or where they cost more than `most`.
    ///
    /// # Complexity
    /// As [`Judge::coarse`], by the number of poses.
    fn follow(&mut self, at: &PlacesOf<M>, grid: Grid, most: f64) -> Option<StrokeFigures> {
        self.motion.walk_mut().settled = grid.settled;
        if !self.stand(at) {
            return None;
        }
        let task = self.limits().task;
        let drawn = 2.0 * f64::from(task.half_opening());
        let finest = grid.finest * task.span();
        // Until an end is reached, or is not, nothing is said against it.
        let mut way = ReachedStroke {
            reached: [task.narrowest, task.widest],
            drive: [0.0; 2],
            ends: [None; 2],
        };
        self.gathered.begin();
        if task.reach > 0.0 {
            let sketch = self.motion.sketch();
            self.gathered.reach = sketch.bones().reach(sketch.points(at));
        }
        self.look(at);
        if self.is_dearer(&way, most) {
            return None;
        }
        self.weigh(at);
        for (n, to) in [task.narrowest, task.widest].into_iter().enumerate() {
            if n > 0 {
                self.motion.walk_mut().back();
            }
            let all = to - drawn;
            let count = (all.abs() / task.span() * grid.steps).ceil().max(1.0);
            let mut i = 0.0;
            while i < count && way.ends[n].is_none() {
                if self.is_dearer(&way, most) {
                    return None;
                }
                i += 1.0;
                way.ends[n] = self
                    .motion
                    .walk_mut()
                    .advance(all * i / count, finest)
                    .err();
                self.look(at);
                if grid.forces_everywhere || i == count || way.ends[n].is_some() {
                    self.weigh(at);
                }
            }
            let walk = self.motion.walk();
            way.reached[n] = drawn + walk.wider;
            way.drive[n] = walk.x.last().copied().unwrap_or(0.0);
        }
        (!self.is_dearer(&way, most)).then(|| self.figures(&way))
    }

    /// Whether what is known so far costs more than `most`: more poses make no figure better.
    fn is_dearer(&self, way: &ReachedStroke, most: f64) -> bool {
        most < f64::INFINITY && self.limits().stroke_cost(&self.figures(way)) > most
    }

    fn figures(&self, way: &ReachedStroke) -> StrokeFigures {
        let g = &self.gathered;
        StrokeFigures {
            reached: way.reached,
            ends: way.ends,
            drive: way.drive,
            rates: g.rates.0,
            force: self.motion.sketch().bones().force(g.rates.0[0]),
            transmission: g.transmission,
            straightness: g.straightness,
            turn: self.turns().fold(0.0, f64::max).to_degrees(),
            size: g.sides.map(Between::span),
            pin_distance: g.nearest.sqrt(),
            on_side: g.on_side,
            pulled_out: g.cylinder.ratio(),
            reach: g.reach,
            forces: g.forces,
        }
    }

    /// How far each jaw turned on the last stroke, from where it turned least to where it turned most, in rad.
    pub fn turns(&self) -> impl Iterator<Item = f64> {
        self.gathered.turns.iter().map(|t| t.span())
    }

    /// How fast the drive goes by the width at the last pose, mm or rad a millimetre: negative where it goes back as jaws open.
    #[must_use]
    pub fn drive_rate(&self) -> f64 {
        self.motion.walk().rate()
    }

    /// How much farther than the task asks the tips can come, narrower and wider, in millimetres and at most `most`; 0 where they
    /// do not come as far.
    pub fn margin(&mut self, at: &PlacesOf<M>, most: f64) -> [f64; 2] {
        let task = self.limits().task;
        let drawn = 2.0 * f64::from(task.half_opening());
        [(task.narrowest, -most), (task.widest, most)].map(|(end, more)| {
            let goes = self.stand(at);
            let to = end - drawn;
            let walk = self.motion.walk_mut();
            // That it ends on the way is what is asked.
            let _ = walk.advance(to + more, 1e-3);
            let farther = (walk.wider - to) * more.signum();
            if goes { farther.max(0.0) } else { 0.0 }
        })
    }

    /// Takes in what the joint forces say; where they have no one solution, the worst.
    fn weigh(&mut self, at: &PlacesOf<M>) {
        let here = self.motion.forces(at, &self.links);
        let here = here.unwrap_or(ForceFigures::WORST);
        self.gathered.forces = self.gathered.forces.worse(here);
    }

    fn look(&mut self, at: &PlacesOf<M>) {
        self.motion.pose(at, &mut self.links);
        let sketch = self.motion.sketch();
        let (bones, points) = (sketch.bones(), sketch.points(at));
        let g = &mut self.gathered;
        let apart = sketch.limits().task.pin_distance > 0.0;
        g.pins.clear();
        g.rates.take(self.motion.walk().rate().abs());
        for &(link, ends) in &bones.rods {
            let pose = &self.links[link];
            let ends = ends.map(|i| pose.point(points[i]));
            g.transmission = g.transmission.min(transmission(&pose.velocity, ends));
        }
        let (mut opens, mut all, mut least) = (0.0, 0.0, f64::INFINITY);
        for (n, (&jaw, inward)) in bones.jaws.iter().zip(&bones.inward).enumerate() {
            let pose = &self.links[jaw];
            let tip = pose.point(bones.tips[n]);
            let velocity = pose.velocity.at(tip);
            let open = -dot(velocity, *inward);
            (opens, all, least) = (opens + open, all + length(velocity), least.min(open));
            g.turns[n].take(pose.angle);
            sketch.each_copy(bones.joints.len() + n, tip, &mut |p| g.take(p));
        }
        let share = if least > 0.0 { opens / all } else { 0.0 };
        g.straightness = g.straightness.min(share);
        for (i, (place, ends)) in points.iter().zip(&bones.joints).enumerate() {
            if let Some([link, _]) = *ends {
                let now = self.links[link].point(*place);
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
            let Some([link, _]) = bones.joints[centre] else {
                return;
            };
            let now = self.links[link].point(points[centre]);
            sketch.each_copy(centre, now, &mut |p| {
                g.take(p.map(|x| x - radius));
                g.take(p.map(|x| x + radius));
            });
            let half = if apart { bones.halves[centre] } else { 0.0 };
            g.take_on_side(half * now[1] - radius, half);
        });
        if let Some(ends) = bones.cylinder {
            let [a, b] = ends.map(|(link, joint)| self.links[link].point(points[joint]));
            g.cylinder.take(length(sub(b, a)));
        }
        if let Some(meetings) = &mut self.meetings {
            let ends = bones.joints.iter().map(|ends| ends.map(|[link, _]| link));
            let of = ends.chain(bones.jaws.iter().map(|&jaw| Some(jaw)));
            let now = of
                .zip(points)
                .map(|(link, &p)| link.map_or(p, |l| self.links[l].point(p)));
            meetings.look(bones, &now.collect::<Vec<Point>>());
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
        (self.nearest, self.on_side, self.reach) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        self.cylinder = Between::NOTHING;
    }

    /// So far on its side of the middle, of a half where that is no 0.
    fn take_on_side(&mut self, far: f64, half: f64) {
        if half != 0.0 {
            self.on_side = self.on_side.min(far);
        }
    }

    fn take_pin(&mut self, pin: Point) {
        for other in &self.pins {
            let apart = sub(pin, *other);
            self.nearest = self.nearest.min(dot(apart, apart));
        }
        self.pins.push(pin);
    }

    fn take(&mut self, point: Point) {
        for (side, x) in self.sides.iter_mut().zip(point) {
            side.take(x);
        }
    }
}

impl Task {
    /// Distances that are asked for at least, each with that of a stroke, in millimetres.
    fn least_distances(&self, f: &StrokeFigures) -> impl Iterator<Item = (f64, f64)> {
        let side = if self.own_sides {
            0.5 * self.distances()[0]
        } else {
            0.0
        };
        let all = [
            (self.pin_distance, f.pin_distance),
            (self.reach, f.reach),
            (side, f.on_side),
        ];
        all.into_iter().filter(|(least, _)| *least > 0.0)
    }
}

impl Limits {
    /// What a stroke costs, 0 at best. First that both ends are reached, then what the task and the limits ask.
    #[must_use]
    pub fn stroke_cost(&self, f: &StrokeFigures) -> f64 {
        let task = &self.task;
        let missing = [f.reached[0] - task.narrowest, task.widest - f.reached[1]];
        let mut cost = 0.0;
        for m in missing.into_iter().filter(|m| *m > 0.0) {
            cost += 6.0 + 40.0 * m / task.span();
        }
        let ratio = f.force_ratio().ln();
        let asked = (0.9 * task.force_ratio).max(1.0).ln();
        cost += 3.0 * beyond(ratio - asked, 0.2).min(10.0);
        if task.least_force > 0.0 {
            let lacks = (1.1 * task.least_force / f.force.max(1e-12)).ln();
            cost += 3.0 * beyond(lacks, 0.2).min(10.0);
        }
        cost += beyond(30.0 - f.transmission, 15.0);
        cost += 2.0 * beyond(0.6 - f.straightness, 0.5);
        cost += beyond(20.0 - f.forces.transmission, 10.0);
        cost += 2.0 * beyond((f.forces.peak / 6.0).max(1e-12).ln(), 0.7).min(10.0);
        cost += beyond(0.8 - f.forces.efficiency, 0.2);
        let turn = f.turn;
        cost += match task.motion {
            AskedMotion::Parallel => 2.0 * beyond(turn - 0.5 * PARALLEL, 0.5).min(10.0),
            AskedMotion::Any | AskedMotion::Swinging => beyond(turn - 40.0, 20.0).min(20.0),
        };
        for (size, most) in f.size.into_iter().zip(task.room) {
            if most > 0.0 {
                cost += beyond(size - most + 2.0, 4.0).min(10.0);
            }
        }
        for (least, is) in task.least_distances(f) {
            cost += beyond(least - is + 1.0, 3.0).min(10.0);
        }
        if task.pulled_out > 0.0 {
            cost += beyond((f.pulled_out / (0.95 * task.pulled_out)).ln(), 0.1).min(10.0);
        }
        cost
    }

    /// What a stroke costs where the force alone counts: less than nothing for a great one, and much for each limit that is broken, by so
    /// many times the usual width.
    #[must_use]
    pub fn force_cost(&self, f: &StrokeFigures, slack: f64) -> f64 {
        let task = &self.task;
        let missing = [f.reached[0] - task.narrowest, task.widest - f.reached[1]];
        let missing = missing.into_iter().filter(|m| *m > 0.0);
        let unreached: f64 = missing.map(|m| 1.0 + 10.0 * m / task.span()).sum();
        let over = |value: f64, most: f64| (value / most).max(1e-12).ln();
        let mut broken = vec![
            (over(f.force_ratio(), task.force_ratio), 0.1),
            (self.transmission - f.transmission, 2.0),
            (self.transmission - f.forces.transmission, 2.0),
            (0.05 - f.straightness, 0.05),
        ];
        if task.motion == AskedMotion::Parallel {
            broken.push((f.turn - PARALLEL, 0.2));
        }
        let sides = f.size.into_iter().zip(task.room);
        broken.extend(
            sides
                .filter(|s| s.1 > 0.0)
                .map(|(size, most)| (size - most, 1.0)),
        );
        let distances = task.least_distances(f);
        broken.extend(distances.map(|(least, is)| (least - is, 1.0)));
        if task.pulled_out > 0.0 {
            broken.push((over(f.pulled_out, task.pulled_out), 0.02));
        }
        // However little a limit is broken, it is.
        let cost = |(over, width): (f64, f64)| match over {
            over if over > NOISE => 0.02 + beyond(over, slack * width),
            _ => 0.0,
        };
        let broken: f64 = broken.into_iter().map(cost).sum();
        DEAR * (unreached + broken) - 20.0 * f.force.max(1e-12).ln()
    }
}
