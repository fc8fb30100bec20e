//! Sides of links, their crossings, and pins on links that they do not belong to. The search evaluates these for many places, and only
//! moved points are evaluated again.

use crate::geom::vector::{cross_plane, dot, length, sub};
use crate::synthesis::place::Point;
use crate::synthesis::sketch::bones::Bones;
use crate::synthesis::task::beyond_limit;
use itertools::Itertools;

/// A pin nearer than this to a foreign link lies on it, in mm.
pub(crate) const ON: f64 = 6.0;

/// Smallest distance of a pin from the opposite side of the same link, in mm. Below it the link is a splinter.
const SPLINTER: f64 = 10.0;

/// Maximum number of sides.
const MOST_SIDES: usize = 64;
/// Number of sides that are processed at once.
const LANES: usize = 8;

/// The cost of a pin within a plate that it does not belong to.
const WITHIN: f64 = 3.0;

/// The additional cost of a crossing between plates of two jaws, which no designer would build.
const JAWS_CROSS: f64 = 6.0;

pub(crate) fn crosses([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side = |p: Point, q: Point, r: Point| cross_plane(sub(q, p), sub(r, p)) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

pub(crate) fn side_distance(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (along, to) = (sub(b, a), sub(p, a));
    let t = (dot(to, along) / dot(along, along).max(1e-9)).clamp(0.0, 1.0);
    length(sub(to, along.map(|x| x * t)))
}

/// A side of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LinkSide {
    pub(crate) link: usize,
    /// The points at its ends.
    pub(crate) ends: [usize; 2],
}

impl LinkSide {
    /// Returns the places of its ends.
    pub(crate) fn places(&self, at: &[Point]) -> [Point; 2] {
        self.ends.map(|i| at[i])
    }
}

/// Returns true if a link with these sides, a bar or a plate, lies over a point.
pub(crate) fn lies_over(sides: &[LinkSide], at: &[Point], point: Point) -> bool {
    let area = |side: &LinkSide| {
        let [a, b] = side.places(at);
        cross_plane(sub(b, a), sub(point, a))
    };
    let left = |side: &LinkSide| area(side) > 0.0;
    let near = |side: &LinkSide| {
        let ends = side.places(at);
        let along = sub(ends[1], ends[0]);
        // Most points are far from the line through both ends.
        let far = area(side).powi(2) > 1.01 * ON.powi(2) * dot(along, along);
        !far && side_distance(point, ends) < ON
    };
    let within = sides.len() > 2 && sides.iter().map(left).all_equal();
    within || sides.iter().any(near)
}

/// A side with the positions of all points relative to it, a bit for each.
#[derive(Debug, Clone, Copy)]
struct SideSeen {
    side: LinkSide,
    ends: u32,
    /// Points on one axis with its ends, including the ends.
    at_ends: u32,
    /// Points on its left.
    left: u32,
    /// Points on it, except for those at its ends.
    near: u32,
    /// Number of these points that do not belong to the link, and the cost of all of them.
    foreign: u32,
    penalty: f64,
    /// The sides that it crosses, as bits: the links of 32 points have at most 64 sides.
    crossed: u64,
    /// The sides that it could cross: those of other links without a common end.
    apart: u64,
}

impl SideSeen {
    fn new(side: LinkSide, together: &[u32]) -> SideSeen {
        SideSeen {
            side,
            ends: 1 << side.ends[0] | 1 << side.ends[1],
            at_ends: side.ends.iter().fold(0, |bits, &i| bits | together[i]),
            left: 0,
            near: 0,
            foreign: 0,
            penalty: 0.0,
            crossed: 0,
            apart: 0,
        }
    }

    /// Evaluates the points that have moved, or all points if an end of the side has moved.
    fn look_again(&mut self, bones: &Bones, at: &[Point], moved: u32) {
        let [a, b] = self.side.places(at);
        let along = sub(b, a);
        let members = bones.members[self.side.link];
        let reach = |p: usize| if members >> p & 1 == 1 { SPLINTER } else { ON };
        // Squared distance from the line through both ends, by the area of the triangle.
        let square = dot(along, along).max(1e-9);
        let [on, splinter] = [ON, SPLINTER].map(|reach| reach.powi(2) * square);
        let (mut looked_at, was_near) = (moved, self.near);
        if self.ends & moved != 0 {
            looked_at = u32::MAX;
            let (mut left, mut near, mut nearer) = (0, 0, 0);
            for p in at.iter().rev() {
                let area = cross_plane(along, sub(*p, a));
                left = left << 1 | u32::from(area > 0.0);
                near = near << 1 | u32::from(area * area < splinter);
                nearer = nearer << 1 | u32::from(area * area < on);
            }
            (self.left, self.near) = (left, near & members | nearer & !members);
        } else {
            for p in set_bits(moved) {
                let (area, bit) = (cross_plane(along, sub(at[p], a)), 1 << p);
                let least = if members & bit == 0 { on } else { splinter };
                self.left = self.left & !bit | u32::from(area > 0.0) << p;
                self.near = self.near & !bit | u32::from(area * area < least) << p;
            }
        }
        self.near &= !self.at_ends;
        for p in set_bits(self.near & looked_at) {
            self.near ^= u32::from(side_distance(at[p], [a, b]) >= reach(p)) << p;
        }
        if (self.near | was_near) & looked_at != 0 {
            // The contact point of pitch circles is on no link. A point of the link itself makes the link a splinter, which does not count
            // as a crossing.
            let near = self.near & !bones.touching;
            self.foreign = (near & !members).count_ones();
            let cost = |p: usize| beyond_limit(reach(p) - side_distance(at[p], [a, b]), reach(p));
            self.penalty = set_bits(near).map(cost).sum();
        }
    }

    /// Returns the sides that it crosses, given the points on the left of each side, and the ends of each.
    fn sides_crossed(&self, left: &[u32], ends: &[u32]) -> u64 {
        let parts = |left: u32, ends: u32| (left & ends != 0) & (left & ends != ends);
        let (left, _) = left.as_chunks::<LANES>();
        let (ends, _) = ends.as_chunks::<LANES>();
        let all = left.iter().zip(ends).rev().fold(0, |all, (left, ends)| {
            // Evaluating all conditions is faster than branching.
            let cross = |k: usize| parts(self.left, ends[k]) & parts(left[k], self.ends);
            let bits: [u32; LANES] = std::array::from_fn(|k| u32::from(cross(k)) << k);
            all << LANES | u64::from(bits.iter().fold(0, |some, bit| some | bit))
        });
        all & self.apart
    }
}

/// Evaluated places with the sides of their links.
#[derive(Debug, Default)]
struct SeenPlaces {
    at: Vec<Point>,
    sides: Vec<SideSeen>,
}

impl SeenPlaces {
    /// Returns the points that have moved, as bits.
    fn moved_points(&self, at: &[Point]) -> u32 {
        if self.at.len() != at.len() {
            return u32::MAX;
        }
        let both = self.at.iter().zip(at).enumerate();
        // Words are compared faster than numbers.
        let words = |place: &Point| place.map(f64::to_bits);
        both.fold(0, |bits, (p, (was, is))| {
            bits | u32::from(words(was) != words(is)) << p
        })
    }

    /// Updates the sides for new places, from which the points in `moved` differ.
    fn look(&mut self, bones: &Bones, at: &[Point], moved: u32) {
        let mut again = 0_u64;
        for (i, seen) in self.sides.iter_mut().enumerate() {
            seen.look_again(bones, at, moved);
            again |= u64::from(seen.ends & moved != 0) << i;
        }
        let (mut left, mut ends) = ([0; MOST_SIDES], [0; MOST_SIDES]);
        for (i, seen) in self.sides.iter().enumerate() {
            (left[i], ends[i]) = (seen.left, seen.ends);
        }
        let count = self.sides.len().next_multiple_of(LANES);
        // If neither of two sides has moved, their crossing is unchanged.
        while again != 0 {
            let i = again.trailing_zeros() as usize;
            again &= again - 1;
            let crossed = self.sides[i].sides_crossed(&left[..count], &ends[..count]);
            let mut changed = self.sides[i].crossed ^ crossed;
            self.sides[i].crossed = crossed;
            while changed != 0 {
                self.sides[changed.trailing_zeros() as usize].crossed ^= 1 << i;
                changed &= changed - 1;
            }
        }
        self.at.clear();
        self.at.extend_from_slice(at);
    }
}

/// The last two evaluated places. If a move is rejected, the next one starts from the earlier places.
#[derive(Debug, Default)]
pub struct SeenSides {
    seen: [SeenPlaces; 2],
    sides: Vec<LinkSide>,
}

impl SeenSides {
    /// Returns the number of crossings of links and of pins on foreign links, and their cost together with that of splinters.
    ///
    /// # Complexity
    /// O(s·(c + m) + p·c) for s sides, of which c have moved, and p points, of which m have.
    pub(in crate::synthesis) fn crossing_cost(
        &mut self,
        bones: &Bones,
        at: &[Point],
    ) -> (usize, f64) {
        let moved = self.seen.each_ref().map(|seen| seen.moved_points(at));
        let nearer = usize::from(moved[1].count_ones() < moved[0].count_ones());
        self.seen.swap(1, nearer);
        let (moved, [now, known]) = (moved[nearer], &mut self.seen);
        // The sides of links with many points depend on the places of these.
        let mut same = moved & bones.hulled == 0 && !known.sides.is_empty();
        if !same {
            bones.link_sides(at, &mut self.sides);
            let sides = known.sides.iter().map(|seen| seen.side);
            same = sides.eq(self.sides.iter().copied());
        }
        now.sides.clear();
        if same {
            now.sides.extend_from_slice(&known.sides);
            now.look(bones, at, moved);
        } else {
            let sides = self.sides.iter();
            let afresh = sides.map(|side| SideSeen::new(*side, &bones.together));
            now.sides.extend(afresh);
            for i in 0..now.sides.len() {
                let own = now.sides[i];
                let apart =
                    |s: &SideSeen| s.side.link != own.side.link && own.at_ends & s.ends == 0;
                let all = now.sides.iter().rev();
                now.sides[i].apart = all.fold(0, |bits, s| bits << 1 | u64::from(apart(s)));
            }
            now.look(bones, at, u32::MAX);
        }
        let sides = now.sides.iter();
        let crossed: u32 = sides.clone().map(|s| s.crossed.count_ones()).sum();
        let foreign: u32 = sides.clone().map(|s| s.foreign).sum();
        // Both sides record a crossing.
        let count = crossed / 2 + foreign;
        let penalty: f64 = sides.clone().map(|s| s.penalty).sum();
        let between_jaws = match crossed {
            0 => 0,
            _ => jaw_crossings(bones, &now.sides),
        };
        let costs = 1.5 * f64::from(count)
            + JAWS_CROSS * f64::from(between_jaws)
            + WITHIN * f64::from(pins_within(bones, &now.sides, at));
        (count as usize, penalty + costs)
    }
}

/// Returns the number of pins within plates that they do not belong to.
fn pins_within(bones: &Bones, sides: &[SideSeen], at: &[Point]) -> u32 {
    let pins = ((1 << bones.joints.len()) - 1) & !bones.touching;
    let plates = sides.chunk_by(|x, y| x.side.link == y.side.link);
    // Every corner of an outline ends two sides. A bar has none, nor has a plate with three pins in line.
    let has_outline = |plate: &&[SideSeen]| plate.iter().fold(0, |odd, s| odd ^ s.ends) == 0;
    let plates = plates.filter(has_outline).filter(|plate| {
        // Three pins in line have no side that turns.
        let [along, next] = [0, 1].map(|i| {
            let [a, b] = plate[i].side.places(at);
            sub(b, a)
        });
        plate.len() > 3 || cross_plane(along, next) != 0.0
    });
    let within = plates.map(|plate| {
        let of = |bits: fn(&SideSeen) -> u32| plate.iter().map(bits);
        let all_left = of(|s| s.left).fold(u32::MAX, |all, left| all & left);
        let any_left = of(|s| s.left).fold(0, |any, left| any | left);
        // A pin that is near to a side has a cost already.
        let known = of(|s| s.at_ends | s.near).fold(0, |any, own| any | own);
        let other = pins & !known & !bones.members[plate[0].side.link];
        ((all_left | !any_left) & other).count_ones()
    });
    within.sum()
}

/// Returns the number of crossings of sides of different jaws.
fn jaw_crossings(bones: &Bones, sides: &[SideSeen]) -> u32 {
    let is_of_jaw = |s: &SideSeen| bones.jaws.contains(&s.side.link);
    let of_jaws = sides.iter().enumerate().filter(|(_, s)| is_of_jaw(s));
    let of_jaws = of_jaws.fold(0, |all, (i, _)| all | 1 << i);
    let crossed = sides.iter().filter(|s| is_of_jaw(s));
    let crossed = crossed.map(|s| (s.crossed & of_jaws).count_ones());
    // Both sides record a crossing.
    crossed.sum::<u32>() / 2
}

/// Returns the indices of the bits that are set.
pub(crate) fn set_bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let first = (set != 0).then(|| set.trailing_zeros() as usize);
        set &= set.wrapping_sub(1);
        first
    })
}

#[cfg(test)]
mod tests {
    use super::{
        LinkSide, ON, SeenSides, SideSeen, crosses, lies_over, pins_within, side_distance,
    };
    use crate::synthesis::sketch::each_classic;
    use crate::synthesis::{random_below, random_for, random_unit};
    use itertools::Itertools;

    /// Moves accepted and rejected in any order give the same result as a new evaluation: only moved points are evaluated again.
    #[test]
    fn what_was_seen_of_other_places_is_what_is_seen_afresh() {
        each_classic(|name, sketch| {
            let mut random = random_for(name, 2, 0);
            let (mut at, mut seen) = (sketch.first_places(&mut random), SeenSides::default());
            for _ in 0..200 {
                let before = at.clone();
                sketch.change_places(&mut at, 0.5, &mut random);
                let cost = |seen: &mut SeenSides| {
                    sketch.place_penalty(&at, f64::INFINITY, seen, || Some(0.0))
                };
                let afresh = cost(&mut SeenSides::default());
                assert_eq!(cost(&mut seen), afresh, "{name}");
                if random_below(2, &mut random) == 0 {
                    at = before;
                }
            }
        });
    }

    /// The slow twin tests each pair of sides by the places of their ends.
    #[test]
    fn sides_cross_as_their_ends_say() {
        each_classic(|name, sketch| {
            let mut random = random_for(name, 4, 0);
            let (at, mut seen) = (sketch.first_places(&mut random), SeenSides::default());
            let (at, bones) = sketch.drawn_points(&at);
            seen.crossing_cost(bones, &at);
            let sides = seen.seen[0].sides.iter().enumerate();
            for ((i, x), (j, y)) in sides.tuple_combinations() {
                let apart = x.side.link != y.side.link && x.at_ends & y.ends == 0;
                let cross = apart && crosses(x.side.places(&at), y.side.places(&at));
                assert_eq!(
                    [x.crossed >> j & 1, y.crossed >> i & 1],
                    [u64::from(cross); 2]
                );
            }
        });
    }

    /// The slow twin computes the distance from each side.
    #[test]
    fn a_link_lies_over_points_that_are_near() {
        let mut random = random_for("bar", 5, 0);
        let mut place = || [0, 1].map(|_| 40.0 * random_unit(&mut random));
        let counts = (0..2000).map(|_| {
            let at = [place(), place()];
            let bar = [0, 1].map(|end| LinkSide {
                link: 0,
                ends: [end, 1 - end],
            });
            let point = place();
            let near = side_distance(point, at) < ON;
            assert_eq!(lies_over(&bar[..1], &at, point), near);
            near
        });
        assert!((200..1800).contains(&counts.filter(|near| *near).count()));
    }

    /// A line to the right of a pin within a plate crosses its outline an odd number of times.
    #[test]
    fn pins_within_plates_are_those_that_rays_find() {
        let mut found = 0;
        each_classic(|name, sketch| {
            let mut random = random_for(name, 3, 0);
            for _ in 0..40 {
                let (at, mut seen) = (sketch.first_places(&mut random), SeenSides::default());
                let (at, bones) = sketch.drawn_points(&at);
                seen.crossing_cost(bones, &at);
                let sides = &seen.seen[0].sides;
                let is_within = |plate: &[SideSeen], p: usize| {
                    let [x, y] = at[p];
                    let right = plate.iter().filter(|s| {
                        let [a, b] = s.side.places(&at);
                        let there = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
                        (a[1] > y) != (b[1] > y) && there > x
                    });
                    // On whole millimetres a pin may be exactly so far from a side.
                    let near = |s: &SideSeen| {
                        let far = side_distance(at[p], s.side.places(&at));
                        s.at_ends >> p & 1 == 1 || far < ON - 1e-9
                    };
                    right.count() % 2 == 1 && !plate.iter().any(near)
                };
                let mut count = 0;
                for plate in sides.chunk_by(|x, y| x.side.link == y.side.link) {
                    let link = plate[0].side.link;
                    let ends = plate.iter().flat_map(|s| s.side.ends);
                    if ends.counts().values().any(|times| *times != 2) {
                        continue;
                    }
                    let others = (0..bones.joints.len())
                        .filter(|p| bones.joints[*p].is_some_and(|links| !links.contains(&link)));
                    count += others.filter(|&p| is_within(plate, p)).count();
                }
                assert_eq!(pins_within(bones, sides, &at) as usize, count, "{name}");
                found += count;
            }
        });
        assert!(found > 50, "{found}");
    }
}
