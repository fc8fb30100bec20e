//! Joint forces of a gripper at a pose of the stroke, and their figures. Each jaw holds the part with 1 N, without friction.

use crate::chains::PairKind;
use crate::geom::vector::{add_scaled, dot, length, sub};
use crate::synthesis::equations::elimination::SmallSystem;
use crate::synthesis::equations::place_of;
use crate::synthesis::equations::rows::{PoseRows, TeethSeen, Term};
use crate::synthesis::places::Places;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::stroke::forces::{ForceFigures, JointForce};
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::stroke::walk::RADIAN;

/// Solves the action of each joint from the equilibrium of every moving link, with the links at these poses. `None` if there is not exactly
/// one solution.
///
/// # Complexity
/// O(n³) for n links.
pub(in crate::synthesis) fn joint_forces(
    sketch: &Sketch<'_>,
    at: &Places,
    links: &[LinkPose],
) -> Option<Vec<JointForce>> {
    let (bones, rules) = (&sketch.bones, &sketch.rules);
    let rows = PoseRows { rules, at, links };
    let size = 3 * (links.len() - 1);
    let mut balance = Equilibrium {
        system: SmallSystem::new(size, 1),
        frame: bones.frame,
    };
    // A column for each row of the joints: its action on the links for 1 N.
    let mut own: Vec<(usize, usize, JointForce)> = Vec::with_capacity(size);
    let mut column = 0;
    for (joint, j) in rules.joints.iter().enumerate() {
        rows.joint_rows(joint, TeethSeen::Force, &mut |_, terms| {
            balance.add_row(column, terms);
            let on_second = terms.iter().filter(|t| t.link == j.links[1]);
            let unit = |t: &Term| JointForce {
                force: t.force,
                at: t.at,
                moment: t.moment * RADIAN,
            };
            own.extend(on_second.map(|t| (joint, column, unit(t))));
            column += 1;
        });
    }
    let (_, drive) = rows.drive_row(sketch.input, sketch.drive);
    balance.add_row(column, &drive);
    for (n, &jaw) in bones.jaws.iter().enumerate() {
        // The part pushes outward, and the joint forces balance it.
        let tip = links[jaw].moved_point(bones.tips[n]);
        balance.add_row(size, &[Term::force(jaw, bones.inward[n], tip)]);
    }
    let mut system = balance.system;
    system.solve_all()?;
    let mut joints = vec![JointForce::default(); rules.joints.len()];
    for (joint, column, unit) in own {
        let size = system.get(column, 0);
        let sum = &mut joints[joint];
        sum.at = unit.at;
        sum.moment += size * unit.moment;
        sum.force = add_scaled(sum.force, size, unit.force);
    }
    Some(joints)
}

/// Equilibrium of every moving link: a column for each unknown force or moment, and one for the known ones.
struct Equilibrium {
    system: SmallSystem,
    frame: usize,
}

impl Equilibrium {
    /// Adds the action of a row on its links; moments are forces at the arm [`RADIAN`].
    fn add_row(&mut self, column: usize, terms: &[Term]) {
        for term in terms {
            let Some(row) = place_of(term.link, self.frame) else {
                continue;
            };
            for (k, x) in term.force_about([0.0; 2]).into_iter().enumerate() {
                self.system.add_entry(row + k, column, x);
            }
        }
    }
}

/// Returns the figures of the joint forces, with the velocities of the links for a millimetre of the width.
pub(in crate::synthesis) fn force_figures(
    sketch: &Sketch<'_>,
    at: &Places,
    links: &[LinkPose],
    forces: &[JointForce],
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
        let slid = || length(sub(v.velocity_at(f.at), u.velocity_at(f.at)));
        lost += friction.coefficient
            * match joint.pair {
                PairKind::Hinge => friction.pin_radius * force * (u.turning - v.turning).abs(),
                // The block presses at both ends of the guide.
                PairKind::Slide => force.max(2.0 * f.moment.abs() / friction.guide) * slid(),
                PairKind::Slot => force * rows.sliding_speed(i).abs(),
                // Pitch circles roll at their contact point.
                PairKind::Gear if rules.threaded => {
                    // Flanks press and slide at the lead angle of the thread.
                    let round = friction.pin_radius * (u.turning - v.turning).abs();
                    force * (round + slid() * slid() / round.max(1e-9))
                }
                PairKind::Gear | PairKind::TwoSlots => 0.0,
            };
    }
    for (n, &jaw) in bones.jaws.iter().enumerate() {
        let velocity = links[jaw]
            .velocity
            .velocity_at(links[jaw].moved_point(bones.tips[n]));
        let work = dot(velocity, bones.inward[n]).abs();
        given += work;
        let passed = passed_angle(sketch, links, forces, jaw, work);
        out.transmission = out.transmission.min(passed);
    }
    let driver = passed_angle(sketch, links, forces, sketch.drive[1], given);
    out.transmission = out.transmission.min(driver);
    out.efficiency = given / (given + lost).max(1e-12);
    out
}

/// Returns the angle whose sine is the work of a link over the greatest work of the forces at its moving joints at their speeds. Joints to
/// the frame are left aside, since they transmit no work.
fn passed_angle(
    sketch: &Sketch<'_>,
    links: &[LinkPose],
    forces: &[JointForce],
    link: usize,
    work: f64,
) -> f64 {
    let joints = sketch.rules.joints.iter().zip(forces).enumerate();
    let own = joints.filter(|(i, (joint, _))| {
        joint.is_at(link) && !joint.is_at(sketch.bones.frame) && *i != sketch.input
    });
    let could =
        own.map(|(_, (_, f))| length(f.force) * length(links[link].velocity.velocity_at(f.at)));
    let could: f64 = could.sum();
    (work / could.max(1e-12)).min(1.0).asin().to_degrees()
}

impl PoseRows<'_> {
    /// Returns the speed of a pin along its slot.
    fn sliding_speed(&self, joint: usize) -> f64 {
        let [pinned, slotted] = self.pin_and_slot(joint);
        let pin = self.links[pinned].moved_point(self.at.points[joint]);
        let along = self.line_direction(slotted, joint);
        let speed = |l: usize| self.links[l].velocity.velocity_at(pin);
        dot(along, sub(speed(pinned), speed(slotted)))
    }
}
