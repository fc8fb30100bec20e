//! Figures by which a layout is judged: its drawing and its motion.

use crate::geom::vector::{cross_plane, dot, length, sub};
use crate::synthesis::equations::velocities::Velocity;
use crate::synthesis::place::Point;
use crate::synthesis::sketch::bones::Bones;
use crate::synthesis::sketch::seen_sides::{LinkSide, SeenSides};
use crate::synthesis::task::{Limits, beyond_limit};

/// Cost of a broken limit, if only limits and one figure count.
pub(in crate::synthesis) const DEAR: f64 = 50.0;
/// Links longer than this are long, and links shorter than `SHORT` are short. In millimetres.
const LONG: f64 = 75.0;
const SHORT: f64 = 18.0;
/// Figures of a layout at the pose it is drawn in.
#[derive(Debug, Clone, PartialEq)]
pub struct Looks {
    /// Number of crossings of links, and of pins on links that they do not belong to.
    pub crossings: usize,
    /// Ratio of the longest to the shortest distance of two pins of a link, without the frame.
    pub ratio: f64,
    /// Speed at which the opening shrinks for a unit of the drive: millimetres per millimetre or radian.
    pub closing: f64,
    /// Velocity of each tip as the jaws close, for a unit of the drive.
    pub tips: Vec<Point>,
    /// Cost of the places, 0 at best.
    pub penalty: f64,
}

impl Looks {
    /// Returns true if the drawing keeps the limits. More crossings are accepted if the links pass each other in separate layers.
    pub(in crate::synthesis) fn keep_limits(&self, limits: &Limits, passes: bool) -> bool {
        self.ratio <= limits.ratio && (self.crossings <= limits.crossings || passes)
    }
}

/// Pins whose coordinates differ by less than this are nearly in line.
const ALIGNED: f64 = 2.5;

/// Figures of the motion of a layout.
pub(in crate::synthesis) struct LayoutMotion {
    closing: f64,
    tips: Vec<Point>,
    pub(in crate::synthesis) penalty: f64,
}

/// Figures of points: pins, then tips.
impl Bones {
    /// Returns the cost of places, including the `besides` cost, such as that of their motion. `None` if it is more than `most`, or if the
    /// pose is singular. Every part only adds to the cost, so the slowest part comes last.
    ///
    /// # Complexity
    /// O(p²) for p points.
    pub(in crate::synthesis) fn place_penalty(
        &self,
        at: &[Point],
        most: f64,
        seen: &mut SeenSides,
        besides: impl FnOnce() -> Option<f64>,
    ) -> Option<f64> {
        let cheap = |sum: f64| (sum <= most).then_some(sum);
        let sum = cheap(self.places(at) + self.length_cost(at))?;
        let sum = cheap(sum + self.spacing_cost(at))?;
        let sum = cheap(sum + besides()?)?;
        cheap(sum + seen.crossing_cost(self, at).1)
    }

    /// Returns all figures of the drawn pose.
    ///
    /// # Complexity
    /// As [`Bones::place_penalty`].
    pub(in crate::synthesis) fn drawn_figures(
        &self,
        at: &[Point],
        motion: LayoutMotion,
    ) -> Option<Looks> {
        let mut seen = SeenSides::default();
        Some(Looks {
            crossings: seen.crossing_cost(self, at).0,
            ratio: self.link_ratio(at),
            penalty: self.place_penalty(at, f64::INFINITY, &mut seen, || Some(motion.penalty))?,
            closing: motion.closing,
            tips: motion.tips,
        })
    }

    /// Returns the cost of points that are too near to each other, and of pins in line.
    fn spacing_cost(&self, at: &[Point]) -> f64 {
        let [near, _] = self.wished;
        let mut penalty = 0.0;
        for (i, a) in at.iter().enumerate() {
            for (j, b) in at[..i].iter().enumerate() {
                let apart = sub(*a, *b);
                let square = dot(apart, apart);
                if square < near * near && !self.are_together(i, j) {
                    penalty += 4.0 * beyond_limit(near - square.sqrt(), near);
                }
                // Pins level with each other, or right above each other, have an axis in common. This special place costs redesigns.
                let in_line = apart.iter().any(|x| x.abs() < ALIGNED);
                if in_line && i < self.joints.len() && !self.follows[i] && !self.follows[j] {
                    penalty += apart
                        .iter()
                        .map(|x| 0.5 * beyond_limit(ALIGNED - x.abs(), ALIGNED))
                        .sum::<f64>();
                }
            }
        }
        penalty
    }

    /// Returns true if two points are on one axis by rule.
    fn are_together(&self, i: usize, j: usize) -> bool {
        self.together[i] >> j & 1 == 1
    }

    /// Returns the squared lengths of all links.
    fn square_lengths(&self, at: &[Point]) -> impl Iterator<Item = f64> {
        self.spans.iter().map(|&[a, b]| {
            let apart = sub(at[a], at[b]);
            dot(apart, apart)
        })
    }

    /// Returns the ratio of the longest to the shortest link.
    fn link_ratio(&self, at: &[Point]) -> f64 {
        let longest = self.square_lengths(at).fold(0.0, f64::max);
        let shortest = self.square_lengths(at).fold(f64::INFINITY, f64::min);
        longest.sqrt() / shortest.sqrt()
    }

    /// Returns the cost of long and short links.
    fn length_cost(&self, at: &[Point]) -> f64 {
        let mut penalty = 0.0;
        for square in self.square_lengths(at) {
            if !(SHORT * SHORT..LONG * LONG).contains(&square) {
                let d = square.sqrt();
                penalty += beyond_limit(d - LONG, 25.0) + beyond_limit(SHORT - d, 10.0);
            }
        }
        penalty
    }

    /// Writes the sides of all moving links to `out`, link by link.
    pub(in crate::synthesis) fn link_sides(&self, at: &[Point], out: &mut Vec<LinkSide>) {
        out.clear();
        let moving = self.of_link.iter().enumerate();
        for (link, points) in moving.filter(|(l, _)| *l != self.frame) {
            let side = |ends| LinkSide { link, ends };
            match points[..] {
                [a, b] => out.push(side([a, b])),
                [a, b, c] => out.extend([[a, b], [b, c], [c, a]].map(side)),
                _ => out.extend(convex_hull(points, at).map(side)),
            }
        }
    }

    /// Returns the cost of the positions: frame behind, jaws in front, pins next to the middle; or all of them around the part.
    fn places(&self, at: &[Point]) -> f64 {
        let (pins, tips) = at.split_at(self.joints.len());
        if let Some(within) = self.round {
            let pin = |p: &Point| {
                let far = length(*p);
                beyond_limit(far - 80.0, 25.0) + beyond_limit(within - far, 10.0)
            };
            return pins.iter().map(pin).sum();
        }
        let mut penalty = 0.0;
        for &i in &self.of_link[self.frame] {
            penalty += beyond_limit(at[i][0] - 50.0, 25.0) + beyond_limit(-at[i][0], 25.0);
        }
        let foremost = self.front_distance() - self.wished[1];
        for [x, y] in pins {
            // Only the tips may be in the region of the part.
            penalty += beyond_limit(x - foremost, 10.0);
            penalty += beyond_limit(y.abs() - 60.0, 25.0) + beyond_limit(-x, 25.0);
        }
        for (&jaw, tip) in self.jaws.iter().zip(tips) {
            for &i in &self.of_link[jaw] {
                let [x, y] = at[i];
                penalty +=
                    beyond_limit(30.0 - x, 25.0) + 0.3 * beyond_limit(-tip[1].signum() * y, 25.0);
            }
        }
        penalty
    }

    /// Returns how far ahead the tips are drawn.
    fn front_distance(&self) -> f64 {
        let tips = self.tips.iter().map(|t| t[0]);
        tips.fold(f64::INFINITY, f64::min)
    }

    /// Returns how far the tips are drawn ahead of all joints; infinite if the part is not ahead.
    pub(in crate::synthesis) fn tip_reach(&self, at: &[Point]) -> f64 {
        if self.round.is_some() {
            return f64::INFINITY;
        }
        let joints = at.iter().zip(&self.joints);
        let ahead = joints.filter(|(_, ends)| ends.is_some()).map(|(p, _)| p[0]);
        self.front_distance() - ahead.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the cost of the limits that are broken as drawn, with a high cost for each; wishes do not count.
    ///
    /// # Complexity
    /// As [`Bones::place_penalty`].
    pub(in crate::synthesis) fn broken_limits(
        &self,
        at: &[Point],
        limits: &Limits,
        seen: &mut SeenSides,
    ) -> f64 {
        let ratio = self.link_ratio(at);
        let (count, crossings) = seen.crossing_cost(self, at);
        let over = count.saturating_sub(limits.crossings);
        #[allow(clippy::cast_precision_loss, reason = "a few")]
        let over = over as f64;
        DEAR * (beyond_limit((ratio / limits.ratio).ln(), 0.1) + over) + 0.01 * crossings
    }

    /// Returns the figures of the motion for a unit speed of the driver, with their cost if each jaw needs a least force. `velocity_of` gives
    /// the velocity of a link.
    pub(in crate::synthesis) fn motion_cost(
        &self,
        at: &[Point],
        velocity_of: impl Fn(usize) -> Velocity,
        least_force: f64,
    ) -> LayoutMotion {
        let jaws = self.jaws.iter().zip(&self.tips);
        let mut tips: Vec<Point> = jaws
            .map(|(&j, tip)| velocity_of(j).velocity_at(*tip))
            .collect();
        let closing = tips.iter().zip(&self.inward).map(|(v, i)| dot(*v, *i));
        let (sum, all) = (
            closing.clone().sum::<f64>(),
            tips.iter().map(|v| length(*v)).sum::<f64>(),
        );
        let slowest = closing.clone().map(f64::abs).fold(f64::INFINITY, f64::min);
        let fastest = closing.clone().map(f64::abs).fold(0.0, f64::max);
        // If one jaw opens, it moves ahead of the other.
        let closes = closing.clone().all(|c| c * sum > 0.0);
        #[allow(clippy::cast_precision_loss, reason = "two or three")]
        let pairs = tips.len() as f64 / 2.0;
        let straightness = if closes {
            sum.abs() / all.max(1e-12)
        } else {
            0.0
        };
        tips.iter_mut().flatten().for_each(|x| *x *= sum.signum());
        let mut out = LayoutMotion {
            closing: sum.abs() / pairs,
            tips,
            penalty: 0.0,
        };
        let even = (fastest / slowest.max(1e-9 * fastest)).max(1.0).ln();
        out.penalty +=
            8.0 * beyond_limit(0.8 - straightness, 0.8) + 0.5 * beyond_limit(even - 0.5, 1.0);
        // The drive: a millimetre for half to four millimetres of closing, a radian for 15 to 120; less if the force requires it.
        let unit = if self.turns { 30.0 } else { 1.0 };
        let wanted = match least_force {
            0.0 => 1.5,
            asked => (0.7 * self.jaw_force(1.0) / asked / unit).min(1.5),
        };
        let drive = out.closing / unit;
        out.penalty += beyond_limit((drive.max(1e-9) / wanted).ln().abs() - 0.9, 0.5).min(20.0);
        let turning = (0..self.of_link.len()).map(|l| velocity_of(l).turning.abs());
        let turning = turning.fold(0.0, f64::max);
        out.penalty += beyond_limit(turning * 40.0 / out.closing.max(1e-9) - 2.0, 1.5).min(20.0);
        let rods = self.rods.iter();
        let sines = rods.map(|(l, ends)| transmission_sine(&velocity_of(*l), ends.map(|i| at[i])));
        out.penalty += beyond_limit(40.0 - angle_degrees(sines.fold(1.0, f64::min)), 20.0);
        out
    }
}

/// Returns the angle of up to 90° with this sine, in degrees.
pub(in crate::synthesis) fn angle_degrees(sine: f64) -> f64 {
    sine.asin().to_degrees()
}

/// Returns the sine of the transmission angle of a rod: between the rod and the normal to the velocity of its faster end.
pub(in crate::synthesis) fn transmission_sine(velocity: &Velocity, [a, b]: [Point; 2]) -> f64 {
    let along = sub(b, a);
    let (va, vb) = (velocity.velocity_at(a), velocity.velocity_at(b));
    let speed = length(va).max(length(vb));
    // Along the rod both ends are equally fast. A rod from the frame does not pull: its end moves across it.
    let least = length(va).min(length(vb));
    if least < 1e-6 * speed.max(1e-9) {
        return 1.0;
    }
    let sine = (dot(va, along) / length(along).max(1e-9) / speed.max(1e-12)).abs();
    sine.min(1.0)
}

/// Returns the edges of the convex hull of points, by their numbers.
fn convex_hull<'a>(points: &'a [usize], at: &'a [Point]) -> impl Iterator<Item = [usize; 2]> + 'a {
    let pairs = points.iter().flat_map(move |&a| {
        let others = points.iter().filter(move |&&b| b != a);
        others.map(move |&b| [a, b])
    });
    // All other points are on the left: an edge of the hull, counterclockwise.
    pairs.filter(move |&[a, b]| {
        let left = |c: usize| cross_plane(sub(at[b], at[a]), sub(at[c], at[a])) > 0.0;
        points.iter().all(|&c| c == a || c == b || left(c))
    })
}
