//! Parallel layers in which the links of a layout pass each other. Links that overlap somewhere on the stroke are in different layers. No
//! pin passes a layer between its links in which another link lies over it.
//!
//! The frame is a plate behind all links, or one behind and one in front. A link is the hull of its points: a bar or a plate with room for
//! a pin all around. Wheels and the flanks of slots are omitted. If a link lies over a tip, pads in front of all layers hold the part, and
//! nothing may be in front of the pads.

use crate::geom::vector::{length, sub};
use crate::synthesis::place::Point;
use crate::synthesis::sketch::bones::Bones;
use crate::synthesis::sketch::seen_sides::{LinkSide, ON, crosses, lies_over, set_bits};
use itertools::Itertools;
use std::cmp::{Reverse, max, min};
use std::fmt;

/// Links as bits.
type Links = u32;

/// Overlaps over a stroke, seen along the pins.
#[derive(Debug, Clone)]
pub struct Meetings {
    /// Per link, the links that it overlaps somewhere; joined links overlap at their pin. The frame is behind all, and overlaps none.
    overlaps: Vec<Links>,
    /// Per joint, the links that lie over it somewhere, without its own links.
    over: Vec<Links>,
    /// Per jaw, the links that lie over its tip somewhere, without jaws.
    over_tips: Vec<Links>,
}

/// Whether a layout can be built of parts that do not collide.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Stacking {
    /// It can be built, with the fewest layers.
    Planes {
        /// Number of layers, including those of the frame.
        planes: usize,
        /// The layer of each link, from the back; 0 for the frame.
        of_link: Vec<usize>,
        /// Whether the frame also has a plate in front, in the last layer.
        in_front: bool,
    },
    /// Parts collide in every assignment of layers.
    Meets,
    /// Not evaluated, since the layout represents several images of its links.
    NotAsked,
}

impl Stacking {
    /// Returns true if there are such layers.
    #[must_use]
    pub fn is_known(&self) -> bool {
        matches!(self, Stacking::Planes { .. })
    }
}

/// The links of each layer from the back, and the frame in the layers of its plates: "0 | 1 3 | 2 4".
impl fmt::Display for Stacking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stacking::Planes {
            planes,
            of_link,
            in_front,
        } = self
        else {
            return Ok(());
        };
        let of = |plane: usize| {
            let plate = if *in_front && plane + 1 == *planes {
                0
            } else {
                plane
            };
            of_link.iter().positions(move |at| *at == plate).join(" ")
        };
        write!(f, "{}", (0..*planes).map(of).format(" | "))
    }
}

impl Meetings {
    /// Creates the overlaps of a layout at rest.
    #[must_use]
    pub fn new(bones: &Bones) -> Meetings {
        let mut out = Meetings {
            overlaps: vec![0; bones.of_link.len()],
            over: vec![0; bones.joints.len()],
            over_tips: vec![0; bones.jaws.len()],
        };
        for &[u, v] in bones.joints.iter().flatten() {
            if u != bones.frame && v != bones.frame {
                out.overlap(u, v);
            }
        }
        out
    }

    fn overlap(&mut self, l: usize, m: usize) {
        self.overlaps[l] |= 1 << m;
        self.overlaps[m] |= 1 << l;
    }

    /// Takes a pose with these points.
    ///
    /// # Complexity
    /// O(p²) for p points.
    pub fn take_pose(&mut self, bones: &Bones, at: &[Point]) {
        let mut sides = Vec::new();
        bones.link_sides(at, &mut sides);
        let pins = bones.joints.len();
        for (i, x) in sides.iter().enumerate() {
            for y in &sides[..i] {
                let known = x.link == y.link || self.overlaps[x.link] >> y.link & 1 == 1;
                if !known && !touch_at_tips(x, y, at, pins) && crosses(x.places(at), y.places(at)) {
                    self.overlap(x.link, y.link);
                }
            }
        }
        for (p, &place) in at.iter().enumerate() {
            let of: Links = match p.checked_sub(pins) {
                None => bones.joints[p]
                    .iter()
                    .flatten()
                    .fold(0, |of, l| of | 1 << l),
                Some(tip) => 1 << bones.jaws[tip],
            };
            let moving = of & !(1 << bones.frame);
            for sides in sides.chunk_by(|x, y| x.link == y.link) {
                let link = sides[0].link;
                // The contact point of pitch circles is on no link.
                let apart = of != 0 && of >> link & 1 == 0;
                if !apart || !lies_over(sides, at, place) {
                    continue;
                }
                // A link on the same axis passes it in a separate layer.
                if bones.of_link[link]
                    .iter()
                    .any(|&q| bones.together[p] >> q & 1 == 1)
                {
                    set_bits(moving).for_each(|own| self.overlap(own, link));
                    continue;
                }
                if let Some(tip) = p.checked_sub(pins) {
                    if !bones.jaws.contains(&link) {
                        self.over_tips[tip] |= 1 << link;
                        self.overlap(bones.jaws[tip], link);
                    }
                    continue;
                }
                self.over[p] |= 1 << link;
                set_bits(moving).for_each(|own| self.overlap(own, link));
            }
        }
    }

    /// Returns the fewest layers in which nothing collides.
    ///
    /// # Complexity
    /// O(n!) for n links in the worst case; usually links find their layers one after another.
    #[must_use]
    pub fn fewest_planes(&self, bones: &Bones) -> Stacking {
        let links = bones.of_link.len();
        let way = |(planes, in_front)| {
            let of_link = self.in_planes(bones, planes, in_front)?;
            Some(Stacking::Planes {
                planes,
                of_link,
                in_front,
            })
        };
        // If the links pass in few layers, they also pass with a layer for each.
        let most = [(links, false), (links + 1, true)];
        if most.into_iter().find_map(way).is_none() {
            return Stacking::Meets;
        }
        let ways = (2..=links + 1).flat_map(|planes| [false, true].map(|front| (planes, front)));
        let mut found = ways.filter(|(planes, front)| planes - usize::from(*front) <= links);
        found.find_map(way).unwrap_or(Stacking::Meets)
    }

    /// Returns the layer of each link for this number of layers, including those of the frame.
    fn in_planes(&self, bones: &Bones, planes: usize, in_front: bool) -> Option<Vec<usize>> {
        let links = bones.of_link.len();
        if in_front && self.over_tips.iter().any(|over| *over != 0) {
            return None;
        }
        let mut rest: Vec<usize> = (0..links).filter(|l| *l != bones.frame).collect();
        rest.sort_by_key(|&l| Reverse(self.overlaps[l].count_ones()));
        let mut of_link = vec![None; links];
        of_link[bones.frame] = Some(0);
        let mut stack = Stack {
            meetings: self,
            bones,
            moving: planes - 1 - usize::from(in_front),
            in_front,
            of_link,
        };
        let fits = stack.fill(&rest);
        fits.then(|| stack.of_link.into_iter().flatten().collect())
    }
}

/// Returns true if two sides end at tips that are near each other: jaws that have closed.
fn touch_at_tips(x: &LinkSide, y: &LinkSide, at: &[Point], pins: usize) -> bool {
    let tip = |side: &LinkSide| side.ends.into_iter().find(|p| *p >= pins);
    let both = tip(x).zip(tip(y));
    both.is_some_and(|(a, b)| length(sub(at[a], at[b])) < ON)
}

/// Assignment of links to layers, one after another.
struct Stack<'a> {
    meetings: &'a Meetings,
    bones: &'a Bones,
    /// Number of layers of moving links, from 1 on.
    moving: usize,
    in_front: bool,
    of_link: Vec<Option<usize>>,
}

impl Stack<'_> {
    /// Assigns layers to the remaining links. Returns false if that is impossible.
    fn fill(&mut self, rest: &[usize]) -> bool {
        let Some((&link, rest)) = rest.split_first() else {
            return true;
        };
        for plane in 1..=self.moving {
            self.of_link[link] = Some(plane);
            if self.is_free(link, plane) && self.pins_pass() && self.pads_pass() && self.fill(rest)
            {
                return true;
            }
        }
        self.of_link[link] = None;
        false
    }

    /// Returns true if a layer has no link that overlaps a link.
    fn is_free(&self, link: usize, plane: usize) -> bool {
        let others = self.of_link.iter().enumerate();
        others
            .filter(|(l, at)| *l != link && **at == Some(plane))
            .all(|(l, _)| self.meetings.overlaps[link] >> l & 1 == 0)
    }

    /// Returns true if no pin has another link over it between the layers of its links.
    fn pins_pass(&self) -> bool {
        let joints = self.bones.joints.iter().zip(&self.meetings.over);
        joints.filter(|(_, over)| **over != 0).all(|(ends, &over)| {
            let Some([Some(a), Some(b)]) = ends.map(|ends| ends.map(|l| self.of_link[l])) else {
                return true;
            };
            let frame = ends.is_some_and(|ends| ends.contains(&self.bones.frame));
            let behind = self.nothing_between(min(a, b), max(a, b), over);
            let front = frame && self.in_front;
            behind || front && self.nothing_between(max(a, b), self.moving + 1, over)
        })
    }

    /// Returns true if no link that lies over a tip is in front of its jaw.
    fn pads_pass(&self) -> bool {
        let jaws = self.bones.jaws.iter().zip(&self.meetings.over_tips);
        let mut at = jaws.filter_map(|(&jaw, &over)| Some((self.of_link[jaw]?, over)));
        at.all(|(jaw, over)| self.nothing_between(jaw, usize::MAX, over))
    }

    fn nothing_between(&self, back: usize, front: usize, over: Links) -> bool {
        let at = self.of_link.iter().enumerate();
        let mut over = at.filter(|(l, _)| over >> l & 1 == 1);
        !over.any(|(_, at)| at.is_some_and(|at| back < at && at < front))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use itertools::Itertools;
    use proptest::prelude::*;

    /// A four-bar with another link on its coupler and its second crank.
    const JOINTS: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 3], [3, 0], [2, 4], [4, 3]];

    fn bones() -> Bones {
        let bones = Bones {
            frame: 0,
            driver: 1,
            jaws: vec![2, 3],
            joints: JOINTS.map(Some).to_vec(),
            follows: vec![false; 6],
            tips: vec![[0.0, 1.0], [0.0, -1.0]],
            turns: true,
            hinged: vec![false, true],
            round: None,
            wished: [14.0, 25.0],
            ..Bones::default()
        };
        bones.joined(5, &[], None, |_| true)
    }

    /// Finds the fewest layers by trying all, including those of the frame. A front plate counts only if some pin needs it.
    fn by_trying(
        overlaps: &[[usize; 2]],
        over: &[(usize, usize)],
        over_tips: &[(usize, usize)],
    ) -> Option<(usize, bool)> {
        let fits = |at: &[usize], front: bool| {
            let apart = |&[l, m]: &[usize; 2]| at[l] != at[m];
            let joined = JOINTS.iter().filter(|ends| !ends.contains(&0));
            let free = |lo: usize, hi: usize, p: usize| {
                over.iter()
                    .all(|&(q, l)| q != p || at[l] <= lo || at[l] >= hi)
            };
            let last = at.iter().max().unwrap() + 1;
            over_tips.iter().all(|&(jaw, l)| at[l] < at[2 + jaw])
                && (over_tips.is_empty() || !front)
                && joined.chain(overlaps).all(apart)
                && JOINTS.iter().enumerate().all(|(p, ends)| {
                    let [a, b] = ends.map(|l| at[l]);
                    free(a.min(b), a.max(b), p)
                        || front && ends.contains(&0) && free(a.max(b), last, p)
                })
        };
        (2..=6)
            .flat_map(|planes| [(planes, false), (planes, true)])
            .find(|&(planes, front)| {
                let moving = planes - 1 - usize::from(front);
                (0..4)
                    .map(|_| 1..=moving)
                    .multi_cartesian_product()
                    .any(|moving| fits(&[vec![0], moving].concat(), front))
            })
    }

    proptest! {
        #[test]
        fn the_fewest_planes_are_those_found_by_trying_all(
            overlaps in prop::collection::vec((1usize..5, 1usize..5), 0..5),
            over in prop::collection::vec((0usize..6, 1usize..5), 0..7),
            over_tips in prop::collection::vec((0usize..2, prop::sample::select(vec![1usize, 4])), 0..3),
        ) {
            let over: Vec<(usize, usize)> =
                over.into_iter().filter(|(p, l)| !JOINTS[*p].contains(l)).collect();
            // What lies over a pin overlaps its links, and what lies over a tip the jaw.
            let at_pins = over.iter().flat_map(|&(p, l)| JOINTS[p].map(|own| (own, l)));
            let at_tips = over_tips.iter().map(|&(jaw, l)| (2 + jaw, l));
            let overlaps: Vec<[usize; 2]> = overlaps
                .into_iter()
                .chain(at_pins)
                .chain(at_tips)
                .filter(|(l, m)| l != m && *l != 0)
                .map(|(l, m)| [l, m])
                .collect();
            let bones = bones();
            let mut met = Meetings::new(&bones);
            overlaps.iter().for_each(|&[l, m]| met.overlap(l, m));
            over.iter().for_each(|&(p, l)| met.over[p] |= 1 << l);
            over_tips.iter().for_each(|&(jaw, l)| met.over_tips[jaw] |= 1 << l);
            let found = match met.fewest_planes(&bones) {
                Stacking::Planes { planes, in_front, .. } => Some((planes, in_front)),
                Stacking::Meets | Stacking::NotAsked => None,
            };
            prop_assert_eq!(found, by_trying(&overlaps, &over, &over_tips));
        }
    }
}
