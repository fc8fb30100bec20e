//! Crossings of links, and pins on links that they are no part of, while places are tried: only what has moved is looked at again.

use crate::geom::vector::{cross_plane, dot, sub};
use crate::synthesis::bones::Bones;
use crate::synthesis::layout_quality::{LinkSide, ON, beyond, distance};
use crate::synthesis::point::Point;

/// A side as the points lie about it, a bit for each.
#[derive(Debug, Clone, Copy)]
struct SideSeen {
    link: usize,
    ends: u32,
    /// Those on one axis with its ends, these among them.
    at_ends: u32,
    /// Those on its left.
    left: u32,
    /// Those on it, besides those at its ends.
    near: u32,
}

impl SideSeen {
    fn new(side: &LinkSide, at: &[Point], together: &[u32]) -> SideSeen {
        let nothing = SideSeen {
            link: side.link,
            ends: 1 << side.ends[0] | 1 << side.ends[1],
            at_ends: side.ends.iter().fold(0, |bits, &i| bits | together[i]),
            left: 0,
            near: 0,
        };
        nothing.again(side, at, 0..at.len())
    }

    /// With some points looked at again.
    fn again(
        mut self,
        side: &LinkSide,
        at: &[Point],
        moved: impl Iterator<Item = usize>,
    ) -> SideSeen {
        let [a, b] = side.of(at);
        let along = sub(b, a);
        // So far from the line through both, by the area of the triangle.
        let strip = ON * ON * dot(along, along).max(1e-9);
        for p in moved {
            let area = cross_plane(along, sub(at[p], a));
            let bit = 1 << p;
            self.left = self.left & !bit | u32::from(area > 0.0) << p;
            self.near &= !bit;
            let may_be = area * area < strip && self.at_ends & bit == 0;
            if may_be && distance(at[p], [a, b]) < ON {
                self.near |= bit;
            }
        }
        self
    }

    /// Whether two sides of different links cross that end at no place in common.
    fn crosses(&self, other: &SideSeen) -> bool {
        let parts = |left: u32, ends: u32| (left & ends != 0) & (left & ends != ends);
        let apart = (self.link != other.link) & (self.at_ends & other.ends == 0);
        // All is looked at, which takes less than to choose.
        apart & parts(self.left, other.ends) & parts(other.left, self.ends)
    }
}

/// Places that were looked at, with the sides of their links.
#[derive(Debug, Default)]
struct SeenPlaces {
    at: Vec<Point>,
    sides: Vec<(LinkSide, SideSeen)>,
}

impl SeenPlaces {
    /// The points that are elsewhere now, as bits.
    fn moved(&self, at: &[Point]) -> u32 {
        if self.at.len() != at.len() {
            return u32::MAX;
        }
        let both = self.at.iter().zip(at).enumerate();
        both.fold(0, |bits, (p, (was, is))| bits | u32::from(was != is) << p)
    }
}

/// The places that were looked at last, and those before them: where a try is refused, the next begins from these.
#[derive(Debug, Default)]
pub struct SeenSides {
    seen: [SeenPlaces; 2],
    sides: Vec<LinkSide>,
}

impl SeenSides {
    /// Crossings of links and pins on links that they are no part of, and what they and splinters cost; `None` where that is more
    /// than `most` beside what else they cost.
    ///
    /// # Complexity
    /// O(s·(s + m) + p·c) for s sides, of which c have moved, and p points, of which m have.
    pub(super) fn crossings(
        &mut self,
        bones: &Bones,
        at: &[Point],
        besides: f64,
        most: f64,
    ) -> Option<(usize, f64)> {
        self.look(bones, at);
        let [now, _] = &self.seen;
        let (mut count, mut penalty, mut cost) = (0, 0.0, 0.0);
        for (i, (side, seen)) in now.sides.iter().enumerate() {
            let before = now.sides[..i].iter();
            count += before.filter(|(_, other)| seen.crosses(other)).count();
            // Where pitch circles touch is on no link.
            let mut near = seen.near & !bones.touching;
            while near != 0 {
                let p = near.trailing_zeros();
                near &= near - 1;
                // A point of the link itself makes it a splinter, which is no crossing.
                count += usize::from(bones.members[side.link] >> p & 1 == 0);
                penalty += beyond(ON - distance(at[p as usize], side.of(at)), ON);
            }
            #[allow(clippy::cast_precision_loss, reason = "a few")]
            let all = count as f64;
            cost = penalty + 1.5 * all;
            if besides + cost > most {
                return None;
            }
        }
        Some((count, cost))
    }

    /// Puts places first, with what is known of those of both that are more like them.
    fn look(&mut self, bones: &Bones, at: &[Point]) {
        let moved = self.seen.each_ref().map(|seen| seen.moved(at));
        let [first, second] = moved.map(u32::count_ones);
        if second >= first {
            self.seen.swap(0, 1);
        }
        let moved = moved[usize::from(second < first)];
        let [now, known] = &mut self.seen;
        bones.sides(at, &mut self.sides);
        now.at.clear();
        now.at.extend_from_slice(at);
        now.sides.clear();
        let sides = self.sides.iter().enumerate().map(|(i, side)| {
            let known = known
                .sides
                .get(i)
                .filter(|(was, seen)| was == side && seen.ends & moved == 0);
            let seen = match known {
                Some((_, seen)) => seen.again(side, at, bits(moved)),
                None => SideSeen::new(side, at, &bones.together),
            };
            (*side, seen)
        });
        now.sides.extend(sides);
    }
}

/// The places of the bits that are set.
fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let first = (set != 0).then(|| set.trailing_zeros() as usize);
        set &= set.wrapping_sub(1);
        first
    })
}
