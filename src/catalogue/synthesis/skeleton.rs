//! What of a structure does not depend on where its pins are, gathered once for the many places that are tried.

use crate::chains::layout_symmetry::Input;
use crate::synthesis::bones::{BonePlan, Bones};
use crate::synthesis::rules::Rules;
use crate::synthesis::stroke::closure::Closure;
use crate::synthesis::structure::Structure;
use crate::synthesis::task::{Limits, room_round_part};
use crate::synthesis::velocities::Contours;

/// A structure with the rules of its pins.
#[derive(Debug)]
pub struct Skeleton<'a> {
    /// The structure.
    pub structure: &'a Structure,
    /// Which pins may be moved.
    pub rules: Rules,
    /// The points of its links: pins in the order of the chain's joints, then the tips.
    pub bones: Bones,
    /// What its velocities need.
    pub contours: Contours,
    /// What its stroke needs.
    pub closure: Closure,
    /// What it is to be like and to do.
    pub limits: Limits,
}

impl<'a> Skeleton<'a> {
    /// Of a structure.
    #[must_use]
    pub fn new(structure: &'a Structure, rules: Rules, limits: Limits) -> Skeleton<'a> {
        let r = &structure.roles;
        let tips = structure.tips(&limits.task);
        let ends = |pin: usize| match rules.pins[pin] {
            // The block of a drive that slides is on the driver.
            _ if pin == rules.input => Some([r.driver, r.frame]),
            (u, v) => Some([u, v]),
        };
        let plan = BonePlan {
            frame: r.frame,
            driver: r.driver,
            jaws: &r.jaws,
            joints: (0..rules.pins.len()).map(ends).collect(),
            follows: (0..rules.pins.len()).map(|i| rules.follows(i)).collect(),
            tips: tips.iter().map(|t| t.real()).collect(),
            turns: structure.form.input == Input::Turn,
            hinged: (r.jaws.iter().map(|&j| structure.chain.joined(r.frame, j))).collect(),
            round: room_round_part(r.jaws.len(), structure.form.symmetry),
            wished: limits.task.distances(),
            cylinder: None,
            together: Vec::new(),
        };
        let bones = Bones::new(structure.chain.links(), plan, |_| true);
        let contours = Contours::new(structure);
        Skeleton {
            structure,
            closure: Closure::new(&contours, bones.apart()),
            bones,
            contours,
            limits,
            rules,
        }
    }
}
