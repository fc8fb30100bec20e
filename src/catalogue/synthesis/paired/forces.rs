//! Forces in the joints of a paired gripper at a pose of the stroke, the jaws each holding the part with a newton, without
//! friction, and what they say of it.

use crate::chains::pairs::PairKind;
use crate::geom::vector::{add_scaled, dot, length, quarter, sub};
use crate::synthesis::elimination::SmallSystem;
use crate::synthesis::paired::PairPlaces;
use crate::synthesis::paired::equations::{PairEquations, place_of};
use crate::synthesis::paired::rows::{PoseRows, TeethSeen, Term};
use crate::synthesis::paired::sketch::PairSketch;
use crate::synthesis::place::Point;
use crate::synthesis::stroke::forces::ForceFigures;
use crate::synthesis::stroke::motion::StrokeMotion;
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::stroke::walk::{RADIAN, Walk};
use crate::synthesis::velocities::Velocity;

/// What a joint does: the force on its second link, where that acts, and a moment beside it, in N and N mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct PairForce {
    /// On the second link of the joint.
    force: Point,
    /// Where.
    at: Point,
    /// About that point, of a slide.
    moment: f64,
}

/// What each joint does by the equilibrium of every moving link, with the links at these poses; `None` where there is no one
/// solution.
///
/// # Complexity
/// O(n³) for n links.
fn forces(sketch: &PairSketch<'_>, at: &PairPlaces, links: &[LinkPose]) -> Option<Vec<PairForce>> {
    let (bones, rules) = (&sketch.bones, &sketch.rules);
    let rows = PoseRows { rules, at, links };
    let size = 3 * (links.len() - 1);
    let mut balance = Equilibrium {
        system: SmallSystem::new(size, 1),
        frame: bones.frame,
    };
    // A column for each row of the joints: what it does to the links for a newton of it.
    let mut own: Vec<(usize, usize, PairForce)> = Vec::with_capacity(size);
    let mut column = 0;
    for (joint, j) in rules.joints.iter().enumerate() {
        rows.joint(joint, TeethSeen::Force, &mut |_, terms| {
            balance.add(column, terms);
            let on_second = terms.iter().filter(|t| t.link == j.links[1]);
            own.extend(on_second.map(|t| (joint, column, PairForce::of(t))));
            column += 1;
        });
    }
    let (_, drive) = rows.drive(sketch.input, sketch.drive);
    balance.add(column, &drive);
    for (n, &jaw) in bones.jaws.iter().enumerate() {
        // The part pushes outward; what the joints do makes up for it.
        let tip = links[jaw].point(bones.tips[n]);
        balance.add(size, &[Term::force(jaw, bones.inward[n], tip)]);
    }
    let mut system = balance.system;
    system.solve()?;
    let mut joints = vec![PairForce::default(); rules.joints.len()];
    for (joint, column, unit) in own {
        let size = system.get(column, 0);
        let sum = &mut joints[joint];
        sum.at = unit.at;
        sum.moment += size * unit.moment;
        sum.force = add_scaled(sum.force, size, unit.force);
    }
    Some(joints)
}

/// Forces and moments on every moving link, a column for each that is unknown, and one for those that are not.
struct Equilibrium {
    system: SmallSystem,
    frame: usize,
}

impl Equilibrium {
    /// Adds what a row does to its links; moments are forces at the arm [`RADIAN`].
    fn add(&mut self, column: usize, terms: &[Term]) {
        for term in terms {
            let Some(row) = place_of(term.link, self.frame) else {
                continue;
            };
            for (k, x) in term.about([0.0; 2]).into_iter().enumerate() {
                self.system.add(row + k, column, x);
            }
        }
    }
}

impl PairForce {
    fn of(term: &Term) -> PairForce {
        PairForce {
            force: term.force,
            at: term.at,
            moment: term.moment * RADIAN,
        }
    }
}

/// What forces say, with the links moving as they do for a millimetre of the width.
fn figures(
    sketch: &PairSketch<'_>,
    at: &PairPlaces,
    links: &[LinkPose],
    forces: &[PairForce],
) -> ForceFigures {
    let (bones, friction) = (&sketch.bones, &sketch.limits.task.friction);
    let rules = &sketch.rules;
    let rows = PoseRows { rules, at, links };
    let mut out = ForceFigures::BEST;
    let (mut lost, mut given) = (0.0, 0.0);
    for (i, (joint, f)) in rules.joints.iter().zip(forces).enumerate() {
        let [u, v] = joint.links.map(|l| links[l].velocity);
        let force = length(f.force);
        out.peak = out.peak.max(force);
        let slid = || length(sub(v.at(f.at), u.at(f.at)));
        lost += friction.coefficient
            * match joint.pair {
                PairKind::Hinge => friction.pin_radius * force * (u.turning - v.turning).abs(),
                // Pressed on at both ends of the guide.
                PairKind::Slide => force.max(2.0 * f.moment.abs() / friction.guide) * slid(),
                PairKind::Slot => force * rows.sliding(i).abs(),
                // Where pitch circles touch they roll.
                PairKind::Gear if rules.threaded => {
                    // Flanks press and slide aslant, by the angle of the thread.
                    let round = friction.pin_radius * (u.turning - v.turning).abs();
                    force * (round + slid() * slid() / round.max(1e-9))
                }
                PairKind::Gear | PairKind::TwoSlots => 0.0,
            };
    }
    for (n, &jaw) in bones.jaws.iter().enumerate() {
        let velocity = links[jaw].velocity.at(links[jaw].point(bones.tips[n]));
        let work = dot(velocity, bones.inward[n]).abs();
        given += work;
        let passed = passed(sketch, links, forces, jaw, work);
        out.transmission = out.transmission.min(passed);
    }
    let driver = passed(sketch, links, forces, sketch.drive[1], given);
    out.transmission = out.transmission.min(driver);
    out.efficiency = given / (given + lost).max(1e-12);
    out
}

/// The angle whose sine is the work of a link over what the forces at its moving joints could do at their speeds; what holds it in
/// the frame passes nothing on.
fn passed(
    sketch: &PairSketch<'_>,
    links: &[LinkPose],
    forces: &[PairForce],
    link: usize,
    work: f64,
) -> f64 {
    let joints = sketch.rules.joints.iter().zip(forces).enumerate();
    let own = joints.filter(|(i, (joint, _))| {
        joint.is_at(link) && !joint.is_at(sketch.bones.frame) && *i != sketch.input
    });
    let could = own.map(|(_, (_, f))| length(f.force) * length(links[link].velocity.at(f.at)));
    let could: f64 = could.sum();
    (work / could.max(1e-12)).min(1.0).asin().to_degrees()
}

impl PoseRows<'_> {
    /// How fast a pin goes along its slot.
    fn sliding(&self, joint: usize) -> f64 {
        let [pinned, slotted] = self.pin_and_slot(joint);
        let pin = self.links[pinned].point(self.at.points[joint]);
        let along = self.along(slotted, joint);
        let speed = |l: usize| self.links[l].velocity.at(pin);
        dot(along, sub(speed(pinned), speed(slotted)))
    }
}

/// The strokes of a paired structure.
#[derive(Debug)]
pub(crate) struct PairMotion<'a> {
    sketch: &'a PairSketch<'a>,
    walk: Walk<PairEquations<'a>>,
}

impl<'a> PairMotion<'a> {
    /// Of a sketch.
    #[must_use]
    pub(crate) fn new(sketch: &'a PairSketch<'a>) -> PairMotion<'a> {
        PairMotion {
            walk: Walk::new(PairEquations::new(sketch)),
            sketch,
        }
    }
}

impl<'a> StrokeMotion for PairMotion<'a> {
    type Of = PairSketch<'a>;
    type Equations = PairEquations<'a>;

    fn sketch(&self) -> &PairSketch<'a> {
        self.sketch
    }

    fn walk(&self) -> &Walk<PairEquations<'a>> {
        &self.walk
    }

    fn walk_mut(&mut self) -> &mut Walk<PairEquations<'a>> {
        &mut self.walk
    }

    fn place(&mut self, at: &PairPlaces) {
        self.walk.equations.at = Some(at.clone());
    }

    fn pose(&self, _: &PairPlaces, links: &mut [LinkPose]) {
        let walk = &self.walk;
        walk.equations.poses(&walk.x, links);
        for (link, pose) in links.iter_mut().enumerate() {
            let Some(k) = place_of(link, self.sketch.bones.frame) else {
                *pose = LinkPose::AT_REST;
                continue;
            };
            let turning = walk.rates[k + 2] / RADIAN;
            // Of the point that is at the origin now.
            let shift = [walk.rates[k], walk.rates[k + 1]];
            pose.velocity = Velocity {
                turning,
                shift: add_scaled(shift, -turning, quarter(pose.shift)),
            };
        }
    }

    fn forces(&mut self, at: &PairPlaces, links: &[LinkPose]) -> Option<ForceFigures> {
        let forces = forces(self.sketch, at, links)?;
        Some(figures(self.sketch, at, links, &forces))
    }
}
