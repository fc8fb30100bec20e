//! First places of a structure, and other places next to them.

use crate::chains::PairKind;
use crate::geom::vector::{length, sub};
use crate::synthesis::place::Point;
use crate::synthesis::place::direction::{self, WholeDirection};
use crate::synthesis::places::{Places, Teeth};
use crate::synthesis::rules::Rule;
use crate::synthesis::sketch::Sketch;
use crate::synthesis::sketch::bones::Bones;
use crate::synthesis::task::outward_vectors;
use crate::synthesis::{random_below, random_normal, random_unit};
use chacha20::ChaCha8Rng;
use std::borrow::Cow;
use std::ops::RangeInclusive;

/// A layout that costs less than this is accepted without a search for a better one.
const GOOD: f64 = 1.0;
/// The same bound for structures that have only hinges.
const GOOD_HINGES: f64 = 4.0;
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

impl Sketch<'_> {
    /// Returns the jaw that a joint guides in the frame, by its index among the jaws. Such jaws slide straight to the part, as real ones
    /// do.
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
                let outward = outward_vectors(self.bones.jaws.len(), 1);
                WholeDirection::ACROSS.turned_by_thirds(outward[jaw].thirds)
            }
            None => WholeDirection::number(random_below(direction::ALL, random)),
        }
    }

    fn first_teeth(&self, joint: usize, random: &mut ChaCha8Rng) -> Teeth {
        match self.rules.meshes[joint] {
            Some(_) if self.rules.threaded => {
                Teeth::Thread(LEADS[random_below(LEADS.len(), random)])
            }
            Some(mesh) if mesh.rack => {
                #[allow(clippy::cast_possible_truncation, reason = "small")]
                #[allow(clippy::cast_possible_wrap, reason = "small")]
                let diameter = 16 + random_below(30, random) as i32;
                Teeth::Rack(if random_unit(random) < 0.5 {
                    diameter
                } else {
                    -diameter
                })
            }
            _ => Teeth::Gears([1, 1]),
        }
    }

    /// Tries other teeth of a gear pair.
    fn change_teeth(teeth: &mut Teeth, warmth: f64, random: &mut ChaCha8Rng) {
        *teeth = match *teeth {
            Teeth::Gears(_) => Teeth::Gears(RATIOS[random_below(RATIOS.len(), random)]),
            Teeth::Thread(_) => Teeth::Thread(LEADS[random_below(LEADS.len(), random)]),
            Teeth::Rack(diameter) if random_unit(random) < 0.1 => Teeth::Rack(-diameter),
            Teeth::Rack(diameter) => {
                #[allow(clippy::cast_possible_truncation, reason = "some millimetres")]
                let by = ((2.0 + 16.0 * warmth) * random_normal(random)).round() as i32;
                let now = (diameter.abs() + by).clamp(*DIAMETERS.start(), *DIAMETERS.end());
                Teeth::Rack(diameter.signum() * now)
            }
        };
    }

    /// Returns the link that has the pin or the block of a joint; `None` for a joint that has no point on its links.
    pub(in crate::synthesis) fn link_of(&self, at: &Places, joint: usize) -> Option<usize> {
        match self.rules.joints[joint].pair {
            PairKind::Slot => Some(at.pinned[joint]),
            _ => self.bones.joints[joint].map(|[link, _]| link),
        }
    }

    /// Calls `take` with every place of a point: on one side, or on all sides of three.
    pub(in crate::synthesis) fn each_copy(
        &self,
        point: usize,
        at: Point,
        take: &mut dyn FnMut(Point),
    ) {
        match &self.around {
            None => take(at),
            Some(around) => around.each_place(point, at, take),
        }
    }

    /// Calls `take` with every pitch circle: the joint at its centre, its radius in mm, and a flag. The flag is false if its gear meshes
    /// with one in the half of the other jaw.
    pub(in crate::synthesis) fn each_circle(
        &self,
        at: &Places,
        take: &mut dyn FnMut(usize, f64, bool),
    ) {
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

    /// Returns the cost below which places are taken without a search for better ones.
    pub(in crate::synthesis) fn good_cost(&self) -> f64 {
        if self.structure.form.hinges {
            GOOD_HINGES
        } else {
            GOOD
        }
    }

    /// Returns all points that are drawn, and the bones that they belong to.
    pub(in crate::synthesis) fn drawn_points<'p>(
        &'p self,
        at: &'p Places,
    ) -> (Cow<'p, [Point]>, &'p Bones) {
        match &self.around {
            None => (Cow::Borrowed(&at.points), &self.bones),
            Some(around) => (Cow::Owned(around.all_points(&at.points)), &around.bones),
        }
    }

    /// Returns places to begin with.
    #[must_use]
    pub fn first_places(&self, random: &mut ChaCha8Rng) -> Places {
        let joints: Vec<[usize; 2]> = self.rules.joints.iter().map(|j| j.links).collect();
        if self.structure.form.hinges {
            let points = self.bones.first_places(joints, random);
            let mut at = Places::of_hinges(points);
            self.rules.settle_joints(&mut at);
            return at;
        }
        let all = 0..joints.len();
        let mut at = Places {
            pinned: joints
                .iter()
                .map(|links| links[usize::from(random_unit(random) < 0.5)])
                .collect(),
            points: self.bones.first_places(joints, random),
            along: all
                .clone()
                .map(|j| self.first_direction(j, random))
                .collect(),
            teeth: all.map(|j| self.first_teeth(j, random)).collect(),
        };
        self.rules.settle_joints(&mut at);
        at
    }

    /// Moves places at random, by how warm the search still is: 1 at first, 0 at its end.
    pub(in crate::synthesis) fn change_places(
        &self,
        at: &mut Places,
        warmth: f64,
        random: &mut ChaCha8Rng,
    ) {
        let number = random_below(self.movable.len().max(1), random);
        let Some(&joint) = self.movable.get(number) else {
            return;
        };
        let pair = self.rules.joints[joint].pair;
        let turns = match (pair, self.rules.rules[joint]) {
            _ if self.structure.form.hinges => false,
            (PairKind::Slide | PairKind::Slot, Rule::Own(along)) => along.is_none(),
            (PairKind::Slide | PairKind::Slot, _) => self.guided_jaw(joint).is_none(),
            _ => false,
        };
        if pair == PairKind::Gear {
            Sketch::change_teeth(&mut at.teeth[joint], warmth, random);
        } else if turns && random_unit(random) < 0.4 {
            #[allow(clippy::cast_possible_truncation, reason = "a few")]
            let by = ((1.0 + 6.0 * warmth) * random_normal(random)).round() as isize;
            at.along[joint] = at.along[joint].turn_by(by);
        } else if pair == PairKind::Slot && random_unit(random) < 0.1 {
            let [u, v] = self.rules.joints[joint].links;
            at.pinned[joint] = if at.pinned[joint] == u { v } else { u };
        } else {
            let reach = 2.0 + 18.0 * warmth;
            let on_line = matches!(self.rules.rules[joint], Rule::OnLine | Rule::Own(_));
            let moving = if on_line && self.structure.form.hinges {
                1
            } else {
                2
            };
            for x in &mut at.points[joint][..moving] {
                *x = (*x + reach * random_normal(random)).round();
            }
        }
        self.rules.settle_joints(at);
    }
}

#[cfg(test)]
mod tests {
    use crate::synthesis::random_for;
    use crate::synthesis::sketch::each_classic;
    use crate::synthesis::sketch::seen_sides::SeenSides;

    /// Places that cost more than the bound have no cost, whether joints or pitch circles cause it.
    #[test]
    fn places_are_never_dearer_than_is_wanted() {
        let mut geared = 0;
        each_classic(|name, sketch| {
            let mut seen = SeenSides::default();
            for start in 0..20 {
                let at = sketch.first_places(&mut random_for(name, 1, start));
                for motion in [0.0, 2.5] {
                    let mut within =
                        |most: f64| sketch.place_penalty(&at, most, &mut seen, || Some(motion));
                    let cost = within(f64::INFINITY).unwrap();
                    assert_eq!(within(cost), Some(cost));
                    let less = cost - 1e-6 * cost.max(1.0);
                    assert_eq!(within(less), None, "{name}");
                }
                geared += usize::from(sketch.pitch_penalty(&at) > 0.0);
            }
        });
        assert!(geared > 20, "{geared}");
    }
}
