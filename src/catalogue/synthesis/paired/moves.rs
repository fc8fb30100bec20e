//! Places of a paired structure to begin with, others beside them, and what they cost.

use crate::chains::pairs::PairKind;
use crate::geom::vector::{length, sub};
use crate::synthesis::bones::Bones;
use crate::synthesis::paired::direction::{self, WholeDirection};
use crate::synthesis::paired::equations::velocities;
use crate::synthesis::paired::rules::PairRule;
use crate::synthesis::paired::sketch::PairSketch;
use crate::synthesis::paired::{PairPlaces, Teeth};
use crate::synthesis::place::Point;
use crate::synthesis::sketch::LayoutSketch;
use crate::synthesis::task::{Limits, outward};
use crate::synthesis::velocities::Velocity;
use crate::synthesis::{bell, below, unit};
use chacha20::ChaCha8Rng;
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// A layout that costs less than this is taken without looking for a better one.
const GOOD: f64 = 1.0;
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
/// Leads of screws that may turn by themselves, in millimetres a turn.
const LEADS: [i32; 6] = [4, 5, 6, 8, 10, 12];
/// Pitch diameters of pinions, in millimetres.
const DIAMETERS: RangeInclusive<i32> = 10..=80;

impl PairSketch<'_> {
    /// The jaw that a joint guides in the frame, by its place among the jaws: such jaws slide straight to the part, as those do that
    /// are made.
    fn guided_jaw(&self, joint: usize) -> Option<usize> {
        let joint = &self.rules.joints[joint];
        if joint.pair != PairKind::Slide || !joint.is_at(self.bones.frame) {
            return None;
        }
        self.bones.jaws.iter().position(|&j| joint.is_at(j))
    }

    fn first_direction(&self, joint: usize, random: &mut ChaCha8Rng) -> WholeDirection {
        match self.guided_jaw(joint) {
            Some(jaw) => {
                let outward = outward(self.bones.jaws.len(), 1);
                WholeDirection::ACROSS.turned_by_thirds(outward[jaw].thirds)
            }
            None => WholeDirection::number(below(direction::ALL, random)),
        }
    }

    fn first_teeth(&self, joint: usize, random: &mut ChaCha8Rng) -> Teeth {
        match self.rules.meshes[joint] {
            Some(_) if self.rules.threaded => Teeth::Thread(LEADS[below(LEADS.len(), random)]),
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

    /// Changes the teeth of a gear pair.
    fn change_teeth(teeth: &mut Teeth, warmth: f64, random: &mut ChaCha8Rng) {
        *teeth = match *teeth {
            Teeth::Gears(_) => Teeth::Gears(RATIOS[below(RATIOS.len(), random)]),
            Teeth::Thread(_) => Teeth::Thread(LEADS[below(LEADS.len(), random)]),
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

impl LayoutSketch for PairSketch<'_> {
    type JointPlaces = PairPlaces;

    fn bones(&self) -> &Bones {
        &self.bones
    }

    fn limits(&self) -> &Limits {
        &self.limits
    }

    fn turns_out(&self) -> bool {
        self.rules.threaded
    }

    fn link_of(&self, at: &PairPlaces, joint: usize) -> Option<usize> {
        match self.rules.joints[joint].pair {
            PairKind::Slot => Some(at.pinned[joint]),
            _ => self.bones.joints[joint].map(|[link, _]| link),
        }
    }

    fn each_copy(&self, point: usize, at: Point, take: &mut dyn FnMut(Point)) {
        match &self.around {
            None => take(at),
            Some(around) => around.each(point, at, take),
        }
    }

    fn each_circle(&self, at: &PairPlaces, take: &mut dyn FnMut(usize, f64, bool)) {
        let meshes = self.rules.meshes.iter().enumerate();
        if self.rules.threaded {
            return;
        }
        for (pitch, mesh) in meshes.filter_map(|(i, m)| Some((at.points[i], (*m)?))) {
            let turning = if mesh.rack { 1 } else { 2 };
            let [a, b] = mesh.held.map(|j| self.bones.halves[j]);
            for j in mesh.held.into_iter().take(turning) {
                take(j, length(sub(at.points[j], pitch)), a * b >= 0.0);
            }
        }
    }

    fn good(&self) -> f64 {
        GOOD
    }

    fn points<'p>(&self, at: &'p PairPlaces) -> &'p [Point] {
        &at.points
    }

    fn drawn<'p>(&'p self, at: &'p PairPlaces) -> (Cow<'p, [Point]>, &'p Bones) {
        match &self.around {
            None => (Cow::Borrowed(&at.points), &self.bones),
            Some(around) => (Cow::Owned(around.points(&at.points)), &around.bones),
        }
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
            (PairKind::Slide | PairKind::Slot, _) => self.guided_jaw(joint).is_none(),
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

    fn velocities(&self, at: &PairPlaces) -> Option<Vec<Velocity>> {
        velocities(self, at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthesis::paired::sketch::each_classic;
    use crate::synthesis::random;
    use crate::synthesis::seen_sides::SeenSides;
    use crate::synthesis::sketch::pitch_penalty;

    /// Places that cost more than is wanted have no cost, whatever of it makes them dear: pitch circles, too.
    #[test]
    fn places_are_never_dearer_than_is_wanted() {
        let mut geared = 0;
        each_classic(|name, sketch| {
            let mut seen = SeenSides::default();
            for start in 0..20 {
                let at = sketch.first_places(&mut random(name, 1, start));
                for moving in [false, true] {
                    let Some(cost) = sketch.penalty(&at, moving, f64::INFINITY, &mut seen) else {
                        continue;
                    };
                    assert_eq!(sketch.penalty(&at, moving, cost, &mut seen), Some(cost));
                    let less = cost - 1e-6 * cost.max(1.0);
                    assert_eq!(sketch.penalty(&at, moving, less, &mut seen), None, "{name}");
                }
                geared += usize::from(pitch_penalty(sketch, &at) > 0.0);
            }
        });
        assert!(geared > 20, "{geared}");
    }
}
