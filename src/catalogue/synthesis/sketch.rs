//! Sketches: the properties of a structure that do not depend on the places of its joints, gathered once for many trials of places. A
//! sketch also computes the cost of places.

pub(crate) mod bones;
pub mod layout_quality;
mod moves;
pub(crate) mod seen_sides;

use crate::chains::chain::Joint;
use crate::chains::{Input, PairKind, Symmetry};
use crate::synthesis::equations::velocities::Contours;
use crate::synthesis::place::Point;
use crate::synthesis::places::Places;
use crate::synthesis::rules::{Rule, Rules};
use crate::synthesis::sketch::bones::Bones;
use crate::synthesis::sketch::layout_quality::{LayoutMotion, Looks};
use crate::synthesis::sketch::seen_sides::SeenSides;
use crate::synthesis::stroke::closure::Closure;
use crate::synthesis::stroke::pose::LinkPose;
use crate::synthesis::structure::Structure;
use crate::synthesis::structure::threefold::{Around, SIDES};
use crate::synthesis::task::{Limits, beyond_limit, room_round_part};

/// A structure with the rules of its joints.
#[derive(Debug)]
pub struct Sketch<'a> {
    /// The structure.
    pub structure: &'a Structure,
    /// The rules for the places of joints.
    pub rules: Rules,
    /// The points of its links.
    pub bones: Bones,
    /// The joints that may be placed.
    pub(super) movable: Vec<usize>,
    /// The driven joint.
    pub input: usize,
    /// The link against which the driver moves, and the driver.
    pub drive: [usize; 2],
    /// Limits and task of the layout.
    pub limits: Limits,
    /// Contours, and their closure, if the structure has only hinges: turns are the only unknowns then.
    pub(super) contours: Option<Contours>,
    pub(super) closure: Option<Closure>,
    /// All sides, if there are three in one plane.
    pub(super) around: Option<Around>,
    /// Opening direction of each tip, as [`Bones::apart_vectors`].
    pub(super) apart: Vec<Point>,
    /// All links as drawn.
    pub(super) at_rest: Vec<LinkPose>,
}

impl<'a> Sketch<'a> {
    /// Gathers the properties of a structure.
    #[must_use]
    pub fn new(structure: &'a Structure, rules: Rules, limits: Limits) -> Sketch<'a> {
        let (chain, roles) = (&structure.structure.chain, &structure.structure.roles);
        let drive = roles.drive_links();
        let pinned = |link: usize| {
            let mut own = rules.joints.iter().filter(|j| j.is_at(link));
            own.all(|j| j.pair == PairKind::Hinge)
        };
        let point = |(j, &block): (&Joint, &usize)| {
            let [u, v] = j.links;
            let links = if block == u { [u, v] } else { [v, u] };
            (j.pair != PairKind::Gear).then_some(links)
        };
        let hinged = |&jaw: &usize| chain.pair_between(roles.frame, jaw) == Some(PairKind::Hinge);
        let free = |r: &Rule| *r == Rule::Free;
        let turned = structure.form.symmetry == Symmetry::HalfTurn;
        let rows = rules.rules.iter().enumerate();
        let own = rows.filter(|(_, r)| turned && matches!(r, Rule::Own(_)));
        let central = own.fold(0, |bits, (i, _)| bits | 1u32 << i);
        let shared = rules
            .image_pairs()
            .filter(|(of, _)| rules.rules[*of] == Rule::OnLine);
        let shared = shared.map(|(of, image)| 1u32 << of | 1 << image);
        let shared: Vec<u32> = shared.chain((central > 0).then_some(central)).collect();
        let cylinder = structure.structure.input_slides() && drive[0] != roles.frame;
        let mut bones = Bones {
            frame: roles.frame,
            driver: drive[1],
            jaws: roles.jaws.clone(),
            joints: rules.joints.iter().zip(&rules.blocks).map(point).collect(),
            follows: rules.rules.iter().map(|r| !free(r)).collect(),
            tips: (structure.tip_places(&limits.task).iter().map(|t| t.real())).collect(),
            turns: structure.drive_input() == Input::Turn,
            hinged: roles.jaws.iter().map(hinged).collect(),
            round: room_round_part(roles.jaws.len(), structure.form.symmetry),
            wished: limits.task.wished_distances(),
            ..Bones::default()
        }
        .joined(chain.links(), &shared, cylinder.then_some(drive), pinned);
        let at_input = |j: &Joint| j.links == roles.input;
        if structure.sides.is_some() {
            bones.sides = SIDES;
        }
        let contours = structure.form.hinges.then(|| Contours::new(structure));
        Sketch {
            around: (structure.sides.is_some() && !structure.is_axial())
                .then(|| Around::new(structure, &rules, &bones)),
            closure: contours
                .as_ref()
                .map(|c| Closure::new(c, bones.apart_vectors())),
            contours,
            apart: bones.apart_vectors(),
            bones,
            input: rules.joints.iter().position(at_input).unwrap_or(0),
            at_rest: vec![LinkPose::AT_REST; chain.links()],
            movable: rules.movable_joints().collect(),
            structure,
            rules,
            drive,
            limits,
        }
    }
}

/// The radius of the largest wheel without a cost, in millimetres.
const LARGE: f64 = 25.0;
/// The radius of the smallest pinion without a cost, in millimetres.
const SMALL: f64 = 8.0;

impl Sketch<'_> {
    /// Returns the cost of places, including that of their `motion`. `None` if it is more than `most`, or if the motion has none.
    ///
    /// # Complexity
    /// That of the new crossings, and of the motion.
    #[must_use]
    pub(in crate::synthesis) fn place_penalty(
        &self,
        at: &Places,
        most: f64,
        seen: &mut SeenSides,
        motion: impl FnOnce() -> Option<f64>,
    ) -> Option<f64> {
        let (points, bones) = self.drawn_points(at);
        bones.place_penalty(&points, most, seen, || {
            Some(self.pitch_penalty(at) + motion()?)
        })
    }

    /// Returns the cost of the limits that places break in the drawn pose, for a search that asks for no more.
    #[must_use]
    pub fn broken_cost(&self, at: &Places, seen: &mut SeenSides) -> f64 {
        let (points, bones) = self.drawn_points(at);
        bones.broken_limits(&points, &self.limits, seen) + self.pitch_penalty(at)
    }

    /// Returns the figures of the drawn pose with this motion.
    ///
    /// # Complexity
    /// That of all crossings.
    pub(super) fn drawn_figures(&self, at: &Places, motion: LayoutMotion) -> Option<Looks> {
        let (points, bones) = self.drawn_points(at);
        let mut looks = bones.drawn_figures(&points, motion)?;
        looks.penalty += self.pitch_penalty(at);
        Some(looks)
    }

    /// Returns the cost of pitch circles that are too large or too small.
    pub(super) fn pitch_penalty(&self, at: &Places) -> f64 {
        let cost = |r: f64| beyond_limit(r - LARGE, 10.0) + beyond_limit(SMALL - r, 3.0);
        let mut sum = 0.0;
        self.each_circle(at, &mut |_, r, _| sum += cost(r));
        sum
    }
}

/// Calls `take` with the sketch of each well-known structure that has rules, and with its name.
#[cfg(test)]
pub(in crate::synthesis) fn each_classic(mut take: impl FnMut(&str, &Sketch<'_>)) {
    use crate::chains::classics::known_classics;
    use crate::synthesis::layout::most_symmetric;
    for classic in known_classics() {
        let paired = most_symmetric(&classic.structure).unwrap();
        let lay = paired.symmetry_lays().swap_remove(0);
        if let Ok(rules) = Rules::new(&paired, &lay) {
            take(&classic.id, &Sketch::new(&paired, rules, Limits::default()));
        }
    }
}
