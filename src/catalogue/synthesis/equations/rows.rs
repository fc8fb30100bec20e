//! Constraint rows of each joint of a paired gripper at a pose. Each row is a wrench that does no work.
//!
//! A row is a sum of forces times point velocities, and moments times angular velocities. The same numbers are the forces by which the
//! joint acts. A hinge or a slide has two rows; a slot, a gear pair or the drive has one.

use crate::chains::PairKind;
use crate::geom::vector::{cross_plane, dot, quarter_turn, scale, sub, unit};
use crate::synthesis::place::Point;
use crate::synthesis::places::{Places, Teeth};
use crate::synthesis::rules::{Mesh, Rules};
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::stroke::walk::RADIAN;

/// Term of a row for a link.
#[derive(Debug, Clone, Copy)]
pub(in crate::synthesis) struct Term {
    pub(in crate::synthesis) link: usize,
    /// A force on the link, and its point of action.
    pub(in crate::synthesis) force: Point,
    pub(in crate::synthesis) at: Point,
    /// A moment on the link, as a force at the arm of [`RADIAN`].
    pub(in crate::synthesis) moment: f64,
}

impl Term {
    pub(in crate::synthesis) fn force(link: usize, force: Point, at: Point) -> Term {
        Term {
            link,
            force,
            at,
            moment: 0.0,
        }
    }

    /// Returns its force, and its moment about a point as a force at the arm of [`RADIAN`].
    pub(in crate::synthesis) fn force_about(&self, point: Point) -> [f64; 3] {
        let moment = cross_plane(sub(self.at, point), self.force);
        [self.force[0], self.force[1], moment / RADIAN + self.moment]
    }

    fn moment(link: usize, moment: f64) -> Term {
        Term {
            link,
            force: [0.0; 2],
            at: [0.0; 2],
            moment,
        }
    }
}

/// Form of the row of teeth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::synthesis) enum TeethSeen {
    /// A ratio of turns relative to the carrier, which holds over any travel.
    Ratio,
    /// A force at the contact point of the pitch circles, as it loads the hinges.
    Force,
}

/// The rows of all joints at places, with the links at poses.
#[derive(Clone, Copy)]
pub(in crate::synthesis) struct PoseRows<'a> {
    pub(in crate::synthesis) rules: &'a Rules,
    pub(in crate::synthesis) at: &'a Places,
    pub(in crate::synthesis) links: &'a [LinkPose],
}

/// Visitor of a row: its error in millimetres, and its terms.
type Visit<'v> = &'v mut dyn FnMut(f64, &[Term]);

impl PoseRows<'_> {
    fn on(&self, link: usize, joint: usize) -> Point {
        self.links[link].moved_point(self.at.points[joint])
    }

    /// Returns the direction of a slide or a slot that is fixed to a link.
    pub(in crate::synthesis) fn line_direction(&self, link: usize, joint: usize) -> Point {
        self.links[link].turned_direction(self.at.along[joint].real())
    }

    /// Returns the turn of a link relative to another.
    fn relative_turn(&self, [of, against]: [usize; 2]) -> f64 {
        self.links[of].angle - self.links[against].angle
    }

    /// Visits the rows of every joint, in order.
    pub(in crate::synthesis) fn each_joint(&self, seen: TeethSeen, visit: Visit<'_>) {
        for joint in 0..self.rules.joints.len() {
            self.joint_rows(joint, seen, visit);
        }
    }

    /// Visits the rows of a joint.
    pub(in crate::synthesis) fn joint_rows(&self, joint: usize, seen: TeethSeen, visit: Visit<'_>) {
        let [u, v] = self.rules.joints[joint].links;
        match (self.rules.joints[joint].pair, self.rules.meshes[joint]) {
            (PairKind::Hinge, _) => {
                let [a, b] = [u, v].map(|l| self.on(l, joint));
                let apart = sub(b, a);
                for (k, along) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                    let back = scale(along, -1.0);
                    visit(
                        apart[k],
                        &[Term::force(v, along, b), Term::force(u, back, a)],
                    );
                }
            }
            (PairKind::Slide, _) => {
                let turn = RADIAN * self.relative_turn([v, u]);
                visit(turn, &[Term::moment(v, 1.0), Term::moment(u, -1.0)]);
                self.line_row(self.block_and_guide(joint), joint, visit);
            }
            (PairKind::Slot, _) => self.line_row(self.pin_and_slot(joint), joint, visit),
            (PairKind::Gear, Some(mesh)) => match seen {
                TeethSeen::Ratio => self.ratio(joint, &mesh, visit),
                TeethSeen::Force => self.teeth(joint, &mesh, visit),
            },
            // Two slots are two joints here.
            (PairKind::Gear, None) | (PairKind::TwoSlots, _) => {}
        }
    }

    /// Returns the link with the block of a slide, and the link with the guide.
    fn block_and_guide(&self, joint: usize) -> [usize; 2] {
        self.with_other(joint, self.rules.blocks[joint])
    }

    /// Returns the link with the pin of a slot, and the link with the slot.
    pub(in crate::synthesis) fn pin_and_slot(&self, joint: usize) -> [usize; 2] {
        self.with_other(joint, self.at.pinned[joint])
    }

    /// Returns a link of a joint, then the other.
    fn with_other(&self, joint: usize, link: usize) -> [usize; 2] {
        let [u, v] = self.rules.joints[joint].links;
        [link, if link == u { v } else { u }]
    }

    /// Visits the row that keeps a point of the first link on a line of the second.
    fn line_row(&self, [pinned, slotted]: [usize; 2], joint: usize, visit: Visit<'_>) {
        let normal = quarter_turn(self.line_direction(slotted, joint));
        let pin = self.on(pinned, joint);
        let off = dot(normal, sub(pin, self.on(slotted, joint)));
        let back = scale(normal, -1.0);
        visit(
            off,
            &[
                Term::force(pinned, normal, pin),
                Term::force(slotted, back, pin),
            ],
        );
    }

    fn ratio(&self, joint: usize, mesh: &Mesh, visit: Visit<'_>) {
        let ratio = self.at.teeth[joint].gear_ratio();
        let ([first, second], carrier) = (mesh.gears, mesh.carrier);
        let turned = self.relative_turn([first, carrier]);
        if mesh.rack {
            let guide = mesh.held[1];
            let along = self.line_direction(carrier, guide);
            let on = self.on(second, guide);
            let gone = dot(along, sub(on, self.on(carrier, guide)));
            let arm = ratio / RADIAN;
            visit(
                gone - ratio * turned,
                &[
                    Term::force(second, along, on),
                    Term::force(carrier, scale(along, -1.0), on),
                    Term::moment(first, -arm),
                    Term::moment(carrier, arm),
                ],
            );
        } else {
            let off = self.relative_turn([second, carrier]) - ratio * turned;
            visit(
                RADIAN * off,
                &[
                    Term::moment(second, 1.0),
                    Term::moment(first, -ratio),
                    Term::moment(carrier, ratio - 1.0),
                ],
            );
        }
    }

    /// Returns the contact point of the pitch circles of a gear pair, and the direction of the force between the teeth.
    fn pitch_contact(&self, joint: usize, mesh: &Mesh) -> [Point; 2] {
        let centres @ [a, b] = mesh.held.map(|j| self.on(mesh.carrier, j));
        let along = self.line_direction(mesh.carrier, mesh.held[1]);
        let presses = if mesh.rack {
            along
        } else {
            quarter_turn(unit(sub(b, a)))
        };
        [self.at.teeth[joint].pitch_point(centres, along), presses]
    }

    fn teeth(&self, joint: usize, mesh: &Mesh, visit: Visit<'_>) {
        let [at, along] = self.pitch_contact(joint, mesh);
        let [first, second] = mesh.gears;
        let back = scale(along, -1.0);
        let forces = [Term::force(first, along, at), Term::force(second, back, at)];
        if let Teeth::Thread(_) = self.at.teeth[joint] {
            // A nut pushes along the screw, and turns it.
            let arm = self.at.teeth[joint].gear_ratio() / RADIAN;
            let turns = [Term::moment(first, arm), Term::moment(mesh.carrier, -arm)];
            visit(0.0, &[forces, turns].concat());
        } else {
            visit(0.0, &forces);
        }
    }

    /// Returns the travel of the drive, in mm or rad, and the row of its speed.
    pub(in crate::synthesis) fn drive_row(
        &self,
        joint: usize,
        [base, driver]: [usize; 2],
    ) -> (f64, [Term; 2]) {
        if self.rules.joints[joint].pair == PairKind::Slide {
            let along = self.line_direction(base, joint);
            let on = self.on(driver, joint);
            let gone = dot(along, sub(on, self.on(base, joint)));
            let back = Term::force(base, scale(along, -1.0), on);
            (gone, [Term::force(driver, along, on), back])
        } else {
            let arm = 1.0 / RADIAN;
            let terms = [Term::moment(driver, arm), Term::moment(base, -arm)];
            (self.relative_turn([driver, base]), terms)
        }
    }
}
