//! Efficiency, transmission, joint forces and room of layouts with slides, gears and slots, worked out anew from their files: all links
//! moved, and all forces from the equilibrium of every link, teeth's among them. None of it is code that lays them out.

use crate::common::*;
pub(in super::super) mod filed;

use super::super::solve_square;
use super::{known, number, query_rows, some, three_generic};
use filed::{FiledJoint, Gripper, Holds, Point, To, place};
use std::array::from_fn;

/// The friction of a task that says nothing of it: coefficient, and in mm the radius of pins and the length of guides.
const COEFFICIENT: f64 = 0.1;
const PIN_RADIUS: f64 = 4.0;
const GUIDE: f64 = 40.0;

/// What a joint does to its second link, and the other way round to its first.
#[derive(Clone, Copy, Default)]
struct Acts {
    force: Point,
    at: Point,
    moment: f64,
}

impl Acts {
    fn about_origin(self) -> [f64; 3] {
        let [x, y] = self.force;
        [x, y, dot(quarter_turn(self.at), self.force) + self.moment]
    }
}

/// A part of what the joint of a number does.
struct Does {
    of: usize,
    links: [usize; 2],
    acts: Acts,
}

impl Gripper {
    /// What joints, teeth and the drive do by a newton or a newton millimetre of each. They are numbered: joints, then teeth, then the
    /// drive.
    fn units(&self, x: &[f64]) -> Vec<Does> {
        let mut out = Vec::new();
        let drive = self.joints.len() + self.teeth.len();
        for (i, j) in self.joints.iter().enumerate() {
            let acts = Acts {
                at: self.on(x, j, j.pin),
                ..Acts::default()
            };
            let pushes = |force: Point| Acts { force, ..acts };
            let turns = Acts {
                moment: 1.0,
                ..acts
            };
            let links = j.links;
            let mut add = |of: usize, acts: Acts| out.push(Does { of, links, acts });
            match j.holds {
                Holds::Hinge => {
                    add(i, pushes([1.0, 0.0]));
                    add(i, pushes([0.0, 1.0]));
                }
                Holds::Slide => {
                    add(i, pushes(quarter_turn(self.along(x, j, 0))));
                    add(i, turns);
                }
                Holds::Slot => add(i, pushes(quarter_turn(self.along(x, j, 1)))),
            }
            match (j.driven, j.holds) {
                (false, _) => {}
                (true, Holds::Slide) => add(drive, pushes(self.along(x, j, 0))),
                (true, _) => add(drive, turns),
            }
        }
        for (i, t) in self.teeth.iter().enumerate() {
            let [first, second, _] = self.meshing(t);
            let [at, force] = self.pitch(x, t);
            out.push(Does {
                of: self.joints.len() + i,
                links: [first, second],
                acts: Acts {
                    force,
                    at,
                    moment: 0.0,
                },
            });
        }
        out
    }

    /// What all these do where the part pushes each jaw outward with a newton: nothing is left over at any link.
    fn acts(&self, x: &[f64]) -> Vec<Acts> {
        let units = self.units(x);
        let column = |does: &Does| {
            let mut column = vec![0.0; x.len()];
            for (k, y) in does.acts.about_origin().into_iter().enumerate() {
                column[3 * does.links[1] + k] += y;
                column[3 * does.links[0] + k] -= y;
            }
            column
        };
        let mut columns: Vec<Vec<f64>> = units.iter().map(column).collect();
        // The ground holds the frame.
        columns.extend((0..3).map(|k| {
            let mut column = vec![0.0; x.len()];
            column[3 * self.frame + k] = 1.0;
            column
        }));
        let mut right = vec![0.0; x.len()];
        for (n, force) in self.outward().into_iter().enumerate() {
            let (at, moment) = (self.tip(x, n), 0.0);
            let push = Acts { force, at, moment }.about_origin();
            (0..3).for_each(|k| right[3 * self.jaws[n] + k] -= push[k]);
        }
        let mut out = vec![Acts::default(); self.joints.len() + self.teeth.len() + 1];
        for (does, by) in units.iter().zip(solve_square(&columns, &right)) {
            let (sum, unit) = (&mut out[does.of], does.acts);
            sum.at = unit.at;
            sum.moment += by * unit.moment;
            sum.force = from_fn(|k| sum.force[k] + by * unit.force[k]);
        }
        out
    }

    /// Points of the box round pins, tips and pitch circles at a pose.
    fn outermost(&self, x: &[f64]) -> Vec<Point> {
        let pins = self.joints.iter().map(|j| self.on(x, j, j.pin));
        let mut out: Vec<Point> = pins
            .chain((0..self.jaws.len()).map(|n| self.tip(x, n)))
            .collect();
        for t in &self.teeth {
            let [touch, _] = self.pitch(x, t);
            let held = t.held.map(|j| &self.joints[j]);
            for j in held.iter().filter(|j| j.holds == Holds::Hinge) {
                let centre = self.on(x, j, 0);
                let radius = length(sub(touch, centre));
                out.extend([radius, -radius].map(|r| centre.map(|c| c + r)));
            }
        }
        out
    }

    pub(in super::super) fn seen(&self, x: Vec<f64>) -> Looked<'_> {
        let mut right = vec![0.0; x.len()];
        *right.last_mut().unwrap() = 1.0;
        Looked {
            of: self,
            rates: solve_square(&self.columns(&x, To::Width(self.width(&x))), &right),
            acts: self.acts(&x),
            x,
        }
    }
}

/// A pose of a gripper: how all links go for a millimetre of the width, and what acts on them.
pub(in super::super) struct Looked<'g> {
    of: &'g Gripper,
    x: Vec<f64>,
    rates: Vec<f64>,
    acts: Vec<Acts>,
}

impl Looked<'_> {
    /// The velocity of a point of a link that is there now.
    pub(in super::super) fn speed(&self, link: usize, at: Point) -> Point {
        let [turning, u, v] = from_fn(|k| self.rates[3 * link + k]);
        let arm = sub(at, [self.x[3 * link + 1], self.x[3 * link + 2]]);
        let [x, y] = scale(quarter_turn(arm), turning);
        [x + u, y + v]
    }

    /// How fast the second link of a joint turns against the first, and how fast a point of it goes there.
    fn against(&self, [u, v]: [usize; 2], at: Point) -> (f64, Point) {
        let turning = self.rates[3 * v] - self.rates[3 * u];
        (turning, sub(self.speed(v, at), self.speed(u, at)))
    }

    /// How fast the drive goes, in mm or rad.
    pub(in super::super) fn drive(&self) -> f64 {
        let input = self.of.input();
        let at = self.of.on(&self.x, input, input.pin);
        let (turning, goes) = self.against(input.links, at);
        match input.holds {
            Holds::Slide => dot(goes, self.of.along(&self.x, input, 0)),
            _ => turning,
        }
    }

    /// How fast each tip goes away from the part.
    pub(in super::super) fn parting(&self) -> Vec<f64> {
        let g = self.of;
        let tips = g.outward().into_iter().enumerate();
        tips.map(|(n, out)| dot(self.speed(g.jaws[n], g.tip(&self.x, n)), out))
            .collect()
    }

    /// What the jaws do: of two a newton for a millimetre of the width, of three half as much again.
    fn done(&self) -> f64 {
        self.of.jaws.len() as f64 / 2.0
    }

    /// The work of the drive, which is what the jaws do.
    fn given(&self) -> f64 {
        let does = self.acts.last().unwrap();
        let (turning, goes) = self.against(self.of.input().links, does.at);
        (dot(does.force, goes) + does.moment * turning).abs()
    }

    /// The work at the jaws over that of the drive with friction.
    fn efficiency(&self) -> f64 {
        let rubs = |(j, f): (&FiledJoint, &Acts)| {
            let (turning, goes) = self.against(j.links, f.at);
            let press = length(f.force);
            match j.holds {
                Holds::Hinge => press * PIN_RADIUS * turning.abs(),
                // At both ends of the guide.
                Holds::Slide => press.max(2.0 * f.moment.abs() / GUIDE) * length(goes),
                Holds::Slot => press * length(goes),
            }
        };
        let lost: f64 = self.of.joints.iter().zip(&self.acts).map(rubs).sum();
        self.done() / (self.done() + COEFFICIENT * lost)
    }

    /// The greatest force of a joint or of teeth.
    fn peak(&self) -> f64 {
        let but_the_drive = &self.acts[..self.acts.len() - 1];
        but_the_drive
            .iter()
            .map(|f| length(f.force))
            .fold(0.0, f64::max)
    }

    /// The least angle of what the driver, or a jaw, passes on of what could be done at the speeds of its joints, in degrees.
    fn passed(&self) -> f64 {
        let g = self.of;
        let ends = g.joints.iter().map(|j| (j.links, j.driven));
        let gears = g.teeth.iter().map(|t| {
            let [first, second, _] = g.meshing(t);
            ([first, second], false)
        });
        let ends: Vec<([usize; 2], bool)> = ends.chain(gears).collect();
        let angle = |work: f64, link: usize| {
            let own = |(links, driven): &([usize; 2], bool)| {
                links.contains(&link) && !links.contains(&g.frame) && !driven
            };
            let acts = ends.iter().zip(&self.acts).filter(|(e, _)| own(e));
            let could: f64 = acts
                .map(|(_, f)| length(f.force) * length(self.speed(link, f.at)))
                .sum();
            (work / could).min(1.0).asin().to_degrees()
        };
        let jaws = (0..g.jaws.len()).map(|n| {
            let goes = self.speed(g.jaws[n], g.tip(&self.x, n));
            angle(dot(goes, g.outward()[n]).abs(), g.jaws[n])
        });
        jaws.fold(angle(self.done(), g.input().links[1]), f64::min)
    }

    /// The least angle between a rod and the motion across it at its faster end, in degrees.
    pub(in super::super) fn rods(&self) -> f64 {
        let g = self.of;
        let mut least = 90.0_f64;
        for link in (0..g.links).filter(|l| *l != g.input().links[1] && *l != g.frame) {
            let at = |j: &&FiledJoint| j.links.contains(&link);
            let own: Vec<&FiledJoint> = g.joints.iter().filter(at).collect();
            let hinged = own.iter().all(|j| j.holds == Holds::Hinge);
            let geared = g.teeth.iter().any(|t| g.meshing(t)[..2].contains(&link));
            let (true, false, [a, b]) = (hinged && !g.jaws.contains(&link), geared, &own[..])
            else {
                continue;
            };
            let ends = [a, b].map(|j| place(&self.x, link, j.at));
            let mut goes = ends.map(|p| self.speed(link, p));
            goes.sort_by(|a, b| length(*a).total_cmp(&length(*b)));
            // What turns about a pin at rest pulls nothing.
            if length(goes[0]) > 1e-6 * length(goes[1]) {
                let rod = sub(ends[1], ends[0]);
                let sine = dot(rod, goes[1]).abs() / length(rod) / length(goes[1]);
                least = least.min(sine.min(1.0).asin().to_degrees());
            }
        }
        least
    }
}

/// Returns the least of a list over the stroke, and by how much it changes to the poses before and after: those of the catalogue lie
/// between them. A rod that comes to rest for a moment has any angle there, and carries no force.
fn least(list: &[f64]) -> (f64, f64) {
    let at = (0..list.len()).min_by(|&i, &j| list[i].total_cmp(&list[j]));
    let at = at.unwrap();
    // Both ends are looked at by either.
    let beside = list.get(at.wrapping_sub(1)..at + 2).unwrap_or_default();
    let change = beside.iter().map(|x| x - list[at]);
    (list[at], change.fold(0.0, f64::max))
}

/// The figures of a gripper over its stroke; where a figure is of the worst pose, by how much worse it may be between poses.
pub(in super::super) struct WorkedOut {
    pub(in super::super) efficiency: (f64, f64),
    pub(in super::super) transmission: (f64, f64),
    pub(in super::super) peak: (f64, f64),
    pub(in super::super) size: Point,
    /// How far the drive goes, in mm or rad.
    pub(in super::super) travel: f64,
    /// The least and the greatest force of a jaw over what the drive takes, in N or N mm.
    pub(in super::super) forces: [f64; 2],
    pub(in super::super) turns: Vec<f64>,
}

impl WorkedOut {
    pub(in super::super) fn new(g: &Gripper, [narrowest, widest]: [f64; 2]) -> WorkedOut {
        let all: Vec<Looked<'_>> = g
            .stroke(narrowest, widest)
            .into_iter()
            .map(|x| g.seen(x))
            .collect();
        for pose in &all {
            // Forces and motion are worked out apart from each other: teeth that pressed in a wrong place would not do the work.
            near(pose.given() / pose.done(), 1.0, 1e-6);
        }
        let list = |of: &dyn Fn(&Looked<'_>) -> f64| -> Vec<f64> { all.iter().map(of).collect() };
        let range = |all: Vec<f64>| all.into_iter().minmax().into_option().unwrap();
        let span = |all: Vec<f64>| {
            let (least, most) = range(all);
            most - least
        };
        let side = |k: usize| {
            let points = all.iter().flat_map(|pose| g.outermost(&pose.x));
            span(points.map(|p| p[k]).collect())
        };
        let (peak, change) = least(&list(&|pose| -pose.peak()));
        let forces = range(list(&|pose| {
            let drive = pose.acts.last().unwrap();
            1.0 / length(drive.force).hypot(drive.moment)
        }));
        WorkedOut {
            efficiency: least(&list(&|pose| pose.efficiency())),
            transmission: least(&list(&|pose| pose.passed().min(pose.rods()))),
            peak: (-peak, change),
            size: [side(0), side(1)],
            travel: span(list(&|pose| g.gone(&pose.x, g.input()))),
            forces: forces.into(),
            turns: (g.jaws.iter().map(|&j| span(list(&|pose| pose.x[3 * j])))).collect(),
        }
    }
}

/// The figures of a layout over its stroke: four digits of them are told, and poses lie a little beside those of the catalogue.
fn is_as_worked_out(row: &Value) {
    let g = Gripper::read(row["mechanism"].word());
    let found = WorkedOut::new(&g, ["narrowest", "widest"].map(|key| number(row, key)));
    let near = |key: &str, found: f64, within: f64| {
        let told = number(row, key);
        assert!(
            (told - found).abs() <= within,
            "{} {}: {key}: told {told}, found {found}",
            row["id"],
            row["name"]
        );
    };
    let (efficiency, change) = found.efficiency;
    near("efficiency", efficiency, 3e-4 + change);
    let (angle, change) = found.transmission;
    near("transmission", angle, 0.03 + change);
    let (peak, change) = found.peak;
    near("pin_force", peak, 1e-9 + 1e-3 * peak + change);
    near("width", found.size[0], 0.1);
    near("height", found.size[1], 0.1);
}

fn all_of(file: &str) -> Vec<Value> {
    query_rows(
        file,
        "SELECT id, name, mechanism, narrowest, widest, efficiency, k.transmission, pin_force, k.width, k.height, shortfall \
         FROM structures JOIN layouts l ON l.structure = id JOIN strokes k ON k.structure = id WHERE reached = 1 AND name NOT LIKE '%threaded'",
    )
}

#[test]
fn well_known_schemes_are_as_worked_out() {
    let all = all_of(known());
    assert_eq!(all.len(), 33);
    all.iter().for_each(is_as_worked_out);
}

#[test]
fn three_jaws_without_symmetry_are_as_worked_out() {
    let mut all = all_of(three_generic::free());
    // Where a jaw turns back it passes nothing on, and poses beside that one see other angles.
    let turns_back = |why: &str| why.starts_with("a jaw opens");
    all.retain(|row| !row["shortfall"].as_str().is_some_and(turns_back));
    assert!(all.len() > 60, "{}", all.len());
    all.iter().for_each(is_as_worked_out);
}

#[test]
fn structures_of_few_links_are_as_worked_out() {
    let all = all_of(some());
    assert!(all.len() > 100);
    all.iter().for_each(is_as_worked_out);
}
