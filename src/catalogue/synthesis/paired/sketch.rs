//! What of a paired structure does not depend on where its joints are, gathered once for the many places that are tried.

use crate::chains::layout_symmetry::{Input, Symmetry};
use crate::chains::pairs::chain::Joint;
use crate::chains::pairs::kind::PairKind;
use crate::geom::vector::{length, sub};
use crate::synthesis::annealing::{bell, unit};
use crate::synthesis::bones::{Bones, Plan};
use crate::synthesis::layout_quality::{Looks, beyond};
use crate::synthesis::limits::Limits;
use crate::synthesis::paired::direction::{self, Direction};
use crate::synthesis::paired::equations::velocities;
use crate::synthesis::paired::places::{PairPlaces, Teeth};
use crate::synthesis::paired::rules::{PairRule, PairRules};
use crate::synthesis::paired::structure::PairedStructure;
use crate::synthesis::point::Point;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::stroke::pose::LinkPose;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::Rng;
use std::ops::RangeInclusive;

/// How far ahead the tips of jaws in front are, in millimetres.
const REACH: f64 = 120.0;
/// Pitch radii of two gears, in a ratio.
const RATIOS: [[i32; 2]; 9] = [
    [1, 1],
    [1, 1],
    [2, 3],
    [3, 2],
    [1, 2],
    [2, 1],
    [3, 4],
    [4, 3],
    [1, 3],
];
/// Pitch circles of a larger radius are in the way of other parts, and teeth on smaller ones are few. In millimetres.
const LARGE: f64 = 25.0;
const SMALL: f64 = 8.0;
/// Pitch diameters of pinions, in millimetres.
const DIAMETERS: RangeInclusive<i32> = 10..=80;

/// A paired structure with the rules of its joints.
#[derive(Debug)]
pub struct PairSketch<'a> {
    /// The structure.
    pub paired: &'a PairedStructure,
    /// Which joints may be placed.
    pub rules: PairRules,
    /// The points of its links.
    pub bones: Bones,
    /// The driven joint.
    pub input: usize,
    /// The link against which the driver moves, and the driver.
    pub drive: [usize; 2],
    /// What it is to be like and to do.
    pub limits: Limits,
    /// All links as drawn.
    pub(super) at_rest: Vec<LinkPose>,
}

/// A number below another.
#[allow(clippy::cast_possible_truncation, reason = "the remainder is an index")]
fn below(n: usize, random: &mut ChaCha8Rng) -> usize {
    (random.next_u64() % n as u64) as usize
}

/// Where the tips of the jaws are drawn, in millimetres: ahead, or on both sides of the middle.
pub(super) fn tips(symmetry: Symmetry, limits: &Limits) -> [Point; 2] {
    let half = f64::from(limits.task.half_opening());
    let ahead = match symmetry {
        Symmetry::HalfTurn => 0.0,
        _ => REACH,
    };
    [[ahead, half], [ahead, -half]]
}

impl<'a> PairSketch<'a> {
    /// Of a structure.
    #[must_use]
    pub fn new(paired: &'a PairedStructure, rules: PairRules, limits: Limits) -> PairSketch<'a> {
        let (chain, roles) = (&paired.structure.chain, &paired.structure.roles);
        let drive = paired.drive();
        let pinned = |link: usize| {
            let mut own = rules.joints.iter().filter(|j| j.is_at(link));
            own.all(|j| j.pair == PairKind::Hinge)
        };
        let point = |j: &Joint| (j.pair != PairKind::Gear).then_some(j.links);
        let hinged = |&jaw: &usize| chain.between(roles.frame, jaw) == Some(PairKind::Hinge);
        let free = |r: &PairRule| *r == PairRule::Free;
        let plan = Plan {
            frame: roles.frame,
            driver: drive[1],
            jaws: &roles.jaws,
            joints: rules.joints.iter().map(point).collect(),
            follows: rules.rules.iter().map(|r| !free(r)).collect(),
            tips: tips(paired.form.symmetry, &limits).to_vec(),
            turns: paired.input() == Input::Turn,
            hinged: roles.jaws.iter().map(hinged).collect(),
            round: (paired.form.symmetry == Symmetry::HalfTurn).then_some(0.0),
        };
        let at_input = |j: &Joint| j.links == roles.input;
        PairSketch {
            bones: Bones::new(chain.links(), plan, pinned),
            input: rules.joints.iter().position(at_input).unwrap_or(0),
            at_rest: vec![LinkPose::AT_REST; chain.links()],
            paired,
            rules,
            drive,
            limits,
        }
    }

    /// Whether a joint guides a jaw in the frame: such jaws slide straight across, as those do that are made.
    fn guides_jaw(&self, joint: usize) -> bool {
        let joint = &self.rules.joints[joint];
        let jaw = self.bones.jaws.iter().any(|&j| joint.is_at(j));
        joint.pair == PairKind::Slide && jaw && joint.is_at(self.bones.frame)
    }

    fn first_direction(&self, joint: usize, random: &mut ChaCha8Rng) -> Direction {
        if self.guides_jaw(joint) {
            return Direction::ACROSS;
        }
        Direction::number(below(direction::ALL, random))
    }

    fn first_teeth(&self, joint: usize, random: &mut ChaCha8Rng) -> Teeth {
        match self.rules.meshes[joint] {
            Some(mesh) if mesh.rack => {
                #[allow(clippy::cast_possible_truncation, reason = "small")]
                #[allow(clippy::cast_possible_wrap, reason = "small")]
                let diameter = 16 + below(30, random) as i32;
                Teeth::Rack(if unit(random) < 0.5 {
                    diameter
                } else {
                    -diameter
                })
            }
            _ => Teeth::Gears([1, 1]),
        }
    }

    /// What pitch circles cost that are large, or too small for teeth.
    fn pitch_penalty(&self, at: &PairPlaces) -> f64 {
        let meshes = self.rules.meshes.iter().enumerate();
        let circles = meshes.filter_map(|(i, m)| Some((at.points[i], (*m)?)));
        let radii = circles.flat_map(|(pitch, mesh)| {
            let turning = if mesh.rack { 1 } else { 2 };
            let held = mesh.held.into_iter().take(turning);
            held.map(move |j| length(sub(at.points[j], pitch)))
        });
        let cost = |r: f64| beyond(r - LARGE, 10.0) + beyond(SMALL - r, 3.0);
        radii.map(cost).sum()
    }

    /// Changes the teeth of a gear pair.
    fn change_teeth(teeth: &mut Teeth, warmth: f64, random: &mut ChaCha8Rng) {
        *teeth = match *teeth {
            Teeth::Gears(_) => Teeth::Gears(RATIOS[below(RATIOS.len(), random)]),
            Teeth::Rack(diameter) if unit(random) < 0.1 => Teeth::Rack(-diameter),
            Teeth::Rack(diameter) => {
                #[allow(clippy::cast_possible_truncation, reason = "some millimetres")]
                let by = ((2.0 + 16.0 * warmth) * bell(random)).round() as i32;
                let now = (diameter.abs() + by).clamp(*DIAMETERS.start(), *DIAMETERS.end());
                Teeth::Rack(diameter.signum() * now)
            }
        };
    }
}

impl Sketch for PairSketch<'_> {
    type Places = PairPlaces;

    fn bones(&self) -> &Bones {
        &self.bones
    }

    fn limits(&self) -> &Limits {
        &self.limits
    }

    fn points<'p>(&self, at: &'p PairPlaces) -> &'p [Point] {
        &at.points
    }

    fn first_places(&self, random: &mut ChaCha8Rng) -> PairPlaces {
        let joints: Vec<[usize; 2]> = self.rules.joints.iter().map(|j| j.links).collect();
        let all = 0..joints.len();
        let mut at = PairPlaces {
            pinned: joints
                .iter()
                .map(|links| links[usize::from(unit(random) < 0.5)])
                .collect(),
            points: self.bones.first_places(joints, random),
            along: all
                .clone()
                .map(|j| self.first_direction(j, random))
                .collect(),
            teeth: all.map(|j| self.first_teeth(j, random)).collect(),
        };
        self.rules.settle(&mut at);
        at
    }

    fn change(&self, at: &mut PairPlaces, warmth: f64, random: &mut ChaCha8Rng) {
        let movable = self.rules.movable().count();
        let Some(joint) = self.rules.movable().nth(below(movable.max(1), random)) else {
            return;
        };
        let pair = self.rules.joints[joint].pair;
        let turns = match (pair, self.rules.rules[joint]) {
            (PairKind::Slide | PairKind::Slot, PairRule::Own(along)) => along.is_none(),
            (PairKind::Slide | PairKind::Slot, _) => !self.guides_jaw(joint),
            _ => false,
        };
        if pair == PairKind::Gear {
            PairSketch::change_teeth(&mut at.teeth[joint], warmth, random);
        } else if turns && unit(random) < 0.4 {
            #[allow(clippy::cast_possible_truncation, reason = "a few")]
            let by = ((1.0 + 6.0 * warmth) * bell(random)).round() as isize;
            at.along[joint] = at.along[joint].turned(by);
        } else if pair == PairKind::Slot && unit(random) < 0.1 {
            let [u, v] = self.rules.joints[joint].links;
            at.pinned[joint] = if at.pinned[joint] == u { v } else { u };
        } else {
            let reach = 2.0 + 18.0 * warmth;
            let moved = at.points[joint].map(|x| x + reach * bell(random));
            at.points[joint] = moved.map(f64::round);
        }
        self.rules.settle(at);
    }

    fn penalty(&self, at: &PairPlaces, moving: bool, most: f64) -> Option<f64> {
        let sum = self.bones.penalty(&at.points, most)? + self.pitch_penalty(at);
        if !moving {
            return Some(sum);
        }
        let motion = self.bones.motion(&at.points, &velocities(self, at)?);
        Some(sum + motion.penalty).filter(|sum| *sum <= most)
    }

    fn looks(&self, at: &PairPlaces) -> Option<Looks> {
        let motion = self.bones.motion(&at.points, &velocities(self, at)?);
        let mut looks = self.bones.looks(&at.points, motion)?;
        looks.penalty += self.pitch_penalty(at);
        Some(looks)
    }
}
