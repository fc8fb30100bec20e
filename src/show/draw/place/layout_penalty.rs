//! How bad a layout is, and small moves that make it better.

use crate::draw::place::graph::{Graph, joint_ring, link_radius};
use crate::draw::prelude::*;
use crate::svg::plane::{are_apart, polygon_area, segments_cross, sides_of};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

/// Joints nearer than this are too near.
const JOINTS: f64 = 0.62;
/// A joint nearer to a foreign link than this is too near.
const CLEAR: f64 = 0.36;

impl Graph {
    /// Returns the cost of a whole layout.
    pub(crate) fn layout_cost(&self, at: &[Point]) -> f64 {
        let rings = self.link_rings(at);
        let links: f64 = (0..rings.len())
            .map(|l| self.shape_cost(&rings[l], at) + self.strangers_cost(l, &rings, at))
            .sum();
        let mut pairs = 0.0;
        for (l, m) in near_pairs(&rings, at) {
            pairs += self.crossing_cost(&rings[l], &rings[m], at);
        }
        let mut joints = 0.0;
        for i in 0..at.len() {
            for j in 0..i {
                joints += nearness_cost(at[i], at[j]);
            }
        }
        links + pairs + joints + self.full_contours(at)
    }

    /// Returns true if any parts cross or crowd each other.
    pub(crate) fn is_violated(&self, at: &[Point]) -> bool {
        let rings = self.link_rings(at);
        let mut pairs = near_pairs(&rings, at);
        (0..rings.len()).any(|l| self.strangers_cost(l, &rings, at) > 0.05)
            || pairs.any(|(l, m)| self.crossing_cost(&rings[l], &rings[m], at) > 0.0)
            || (0..at.len()).any(|i| (0..i).any(|j| nearness_cost(at[i], at[j]) > 0.2))
    }

    /// Returns the joints of each link in order around their middle.
    pub(crate) fn link_rings(&self, at: &[Point]) -> Vec<Vec<usize>> {
        let rings = self.links.iter().map(|of| joint_ring(of, at));
        rings.collect()
    }

    /// Returns the cost of bars of unusual length and polygons of unusual size.
    fn shape_cost(&self, ring: &[usize], at: &[Point]) -> f64 {
        let m = ring.len();
        if m < 2 {
            return 0.0;
        }
        let wish = match m {
            2 => 1.15,
            3 => 1.1,
            m => 2.0 * link_radius(m) * (std::f64::consts::PI / m as f64).sin(),
        };
        let mut sum: f64 = sides_of(ring)
            .map(|(a, b)| {
                let off = plane_norm(sub(at[a], at[b])) - wish;
                0.4 * off * off * if m > 3 { 0.4 } else { 1.0 }
            })
            .sum();
        if m > 2 {
            // flat or hollow corners
            for i in 0..m {
                let (a, b, c) = (ring[i], ring[(i + 1) % m], ring[(i + 2) % m]);
                let turn = cross(sub(at[b], at[a]), sub(at[c], at[b]));
                let least = if m == 3 { 0.45 } else { 0.0 };
                if turn < least {
                    sum += 1.5 * (least - turn).min(1.5) + if turn < -0.02 { 3.0 } else { 0.0 };
                }
            }
        }
        sum
    }

    /// Returns the cost of other links' joints near or on a link.
    fn strangers_cost(&self, l: usize, rings: &[Vec<usize>], at: &[Point]) -> f64 {
        let own = &self.links[l];
        let polygon: Vec<Point> = rings[l].iter().map(|&j| at[j]).collect();
        let [low, high] = ring_span(&rings[l], at);
        (0..at.len())
            .filter(|&j| !is_beyond(at[j], low, high) && !own.contains(&j))
            .map(|j| self.stranger_cost(at[j], &rings[l], &polygon, at))
            .sum()
    }

    fn stranger_cost(&self, p: Point, ring: &[usize], polygon: &[Point], at: &[Point]) -> f64 {
        let mut sum = 0.0;
        for (a, b) in sides_of(ring) {
            if is_beyond(p, at[a], at[b]) {
                continue;
            }
            let d = to_segment(p, at[a], at[b]);
            if d < CLEAR {
                sum += 6.0 * ((CLEAR - d) / CLEAR).powi(2);
            }
        }
        if polygon.len() > 2 && is_inside(p, polygon) {
            sum += 14.0;
        }
        sum
    }

    /// Crossings of two links.
    fn crossing_cost(&self, one: &[usize], other: &[usize], at: &[Point]) -> f64 {
        let mut sum = 0.0;
        for (a, b) in sides_of(one) {
            for (c, d) in sides_of(other) {
                if a != c
                    && a != d
                    && b != c
                    && b != d
                    && !are_apart([at[a], at[b]], [at[c], at[d]])
                    && segments_cross(at[a], at[b], at[c], at[d])
                {
                    sum += 10.0;
                }
            }
        }
        sum
    }

    /// Returns the cost of foreign joints inside contours.
    fn full_contours(&self, at: &[Point]) -> f64 {
        self.contours
            .iter()
            .map(|contour| {
                let polygon: Vec<Point> = contour.iter().map(|&j| at[j]).collect();
                let within = (0..at.len())
                    .filter(|j| !contour.contains(j) && is_inside(at[*j], &polygon))
                    .count();
                let c = mean(polygon.iter().copied());
                let round: f64 = polygon
                    .iter()
                    .map(|&p| plane_norm(sub(p, c)))
                    .fold(0.0, f64::max);
                // a tint must be seen
                let small = (0.6 - polygon_area(&polygon)).max(0.0);
                0.5 * within as f64 + 2.0 * small + if round < 0.5 { 1.0 } else { 0.0 }
            })
            .sum()
    }

    /// Anneals the layout by moves of single joints. The result is the same for the same graph.
    pub(crate) fn anneal_layout(&self, at: &mut Vec<Point>) {
        let n = at.len();
        if n < 2 {
            return;
        }
        let sides: usize = self.links.iter().map(Vec::len).sum();
        let moves = (3_000_000 / (8 * (sides + n)).max(1)).clamp(200, 6000);
        let mut random = ChaCha8Rng::seed_from_u64(n as u64);
        let mut unit = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let mut now = at.clone();
        let mut cost = self.layout_cost(at);
        let mut least = cost;
        for step in 0..moves {
            let cool = 1.0 - step as f64 / moves as f64;
            let j = ((unit() * n as f64) as usize).min(n - 1);
            let reach = 1.6 * cool * cool + 0.05;
            let old = now[j];
            let by = [unit(), unit()].map(|x| reach * (2.0 * x - 1.0));
            now[j] = add(now[j], by);
            let after = self.layout_cost(&now);
            let gain = cost - after;
            if gain < 0.0 && unit() > (gain / (1.2 * cool * cool + 1e-9)).exp() {
                now[j] = old;
                continue;
            }
            cost = after;
            if cost < least {
                least = cost;
                at.clone_from(&now);
            }
        }
    }
}

/// Returns the least and the greatest coordinates of a ring.
fn ring_span(ring: &[usize], at: &[Point]) -> [Point; 2] {
    let all = ring.iter().map(|&j| at[j]);
    let none = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    all.fold(none, |[low, high], p| {
        [
            [low[0].min(p[0]), low[1].min(p[1])],
            [high[0].max(p[0]), high[1].max(p[1])],
        ]
    })
}

/// Returns the pairs of rings that may meet, each with the earlier ring.
fn near_pairs(rings: &[Vec<usize>], at: &[Point]) -> impl Iterator<Item = (usize, usize)> {
    let spans: Vec<[Point; 2]> = rings.iter().map(|r| ring_span(r, at)).collect();
    let pairs = (0..rings.len()).flat_map(|l| (0..l).map(move |m| (l, m)));
    pairs.filter(move |&(l, m)| !are_apart(spans[l], spans[m]))
}

/// Returns true if one coordinate alone shows that a place is too far from a segment to crowd it.
fn is_beyond(p: Point, a: Point, b: Point) -> bool {
    (0..2).any(|k| p[k] < a[k].min(b[k]) - CLEAR || p[k] > a[k].max(b[k]) + CLEAR)
}

fn nearness_cost(a: Point, b: Point) -> f64 {
    if (0..2).any(|k| (a[k] - b[k]).abs() >= JOINTS) {
        return 0.0;
    }
    let d = plane_norm(sub(a, b));
    if d < JOINTS {
        12.0 * ((JOINTS - d) / JOINTS).powi(2)
    } else {
        0.0
    }
}
