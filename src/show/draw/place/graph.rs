//! The graph of a structural scheme: links are hyperedges over the joints. If the drawn mechanism has a mirror
//! symmetry, so has its scheme.

use crate::draw::prelude::*;

/// Links as lists of joints, and the contours that should be empty.
#[derive(Debug)]
pub(crate) struct Graph {
    /// The joints of each link.
    pub(crate) links: Vec<Vec<usize>>,
    /// How many joints there are.
    pub(crate) joints: usize,
    /// The link that is the frame.
    pub(crate) frame: Option<usize>,
    /// The joints of each contour, in order.
    pub(crate) contours: Vec<Vec<usize>>,
}

/// The nodes of the graph that is relaxed: the joints, then a hub for each link that is not a plain bar.
#[derive(Debug)]
pub(crate) struct Net {
    pub(crate) hub: Vec<Option<usize>>,
    pub(crate) edges: Vec<Vec<(usize, f64)>>,
}

/// Returns the graph with a hub for each link that has more than two joints or shares a pair of joints.
pub(crate) fn build_net(graph: &Graph) -> Net {
    let mut edges = vec![Vec::new(); graph.joints];
    let mut hub = Vec::new();
    for (l, joints) in graph.links.iter().enumerate() {
        let twin = joints.len() == 2
            && graph
                .links
                .iter()
                .enumerate()
                .any(|(m, other)| m != l && joints.iter().all(|j| other.contains(j)));
        if joints.len() == 2 && !twin {
            let (a, b) = (joints[0], joints[1]);
            edges[a].push((b, 1.15));
            edges[b].push((a, 1.15));
            hub.push(None);
            continue;
        }
        let h = edges.len();
        edges.push(Vec::new());
        let radius = link_radius(joints.len());
        for &j in joints {
            edges[h].push((j, radius));
            edges[j].push((h, radius));
        }
        hub.push(Some(h));
    }
    Net { hub, edges }
}

/// Returns the distance of a link's joints from its middle.
pub(crate) fn link_radius(joints: usize) -> f64 {
    match joints {
        0 | 1 => 0.75,
        2 => 0.8,
        3 => 0.62,
        m => 0.46 / (std::f64::consts::PI / m as f64).sin(),
    }
}

/// Returns the joints of a link in order around their middle.
pub(crate) fn joint_ring(of: &[usize], joints: &[Point]) -> Vec<usize> {
    let centre = mean(of.iter().map(|&j| joints[j]));
    let mut ring = of.to_vec();
    // in a row: there, and straight back
    let far = |from: Point| {
        let far = of.iter().map(|&j| sub(joints[j], from));
        far.max_by(|a, b| plane_norm(*a).total_cmp(&plane_norm(*b)))
            .unwrap_or([0.0; 2])
    };
    let along = unit(far(centre));
    let off = of
        .iter()
        .map(|&j| cross(along, sub(joints[j], centre)).abs());
    if off.fold(0.0, f64::max) <= 0.02 * plane_norm(far(centre)) {
        ring.sort_by(|&a, &b| dot(along, joints[a]).total_cmp(&dot(along, joints[b])));
    } else if ring.len() > 2 {
        ring.sort_by(|&a, &b| {
            let angle = |j: usize| (joints[j][1] - centre[1]).atan2(joints[j][0] - centre[0]);
            angle(a).total_cmp(&angle(b))
        });
    }
    ring
}

/// The image of each node under a reflection of y, and whether it is its own.
#[derive(Debug, Clone)]
pub(crate) struct Mirror(Vec<usize>);

impl Mirror {
    /// Returns the reflection of y that maps joints to joints and links to links, or `None` if there is none.
    pub(crate) fn find_mirror(graph: &Graph, net: &Net, joints: &[Point]) -> Option<Mirror> {
        let middle = mean(joints.iter().copied());
        let size = joints
            .iter()
            .map(|&p| plane_norm(sub(p, middle)))
            .fold(0.0, f64::max);
        let image = |j: usize| {
            let flipped = [joints[j][0], 2.0 * middle[1] - joints[j][1]];
            let mut near =
                (0..joints.len()).filter(|&k| plane_norm(sub(joints[k], flipped)) < 1e-4 * size);
            near.next().filter(|_| near.next().is_none())
        };
        let of: Vec<usize> = (0..joints.len()).map(image).collect::<Option<_>>()?;
        if of.iter().enumerate().all(|(j, &k)| j == k) {
            return None;
        }
        let mut all: Vec<usize> = of.clone();
        all.resize(net.edges.len(), 0);
        for (l, joints) in graph.links.iter().enumerate() {
            let mut wanted: Vec<usize> = joints.iter().map(|&j| of[j]).collect();
            wanted.sort_unstable();
            let twin = graph.links.iter().position(|other| {
                let mut other = other.clone();
                other.sort_unstable();
                other == wanted
            })?;
            if let (Some(h), Some(g)) = (net.hub[l], net.hub[twin]) {
                all[h] = g;
            }
        }
        Some(Mirror(all))
    }

    /// Makes places symmetric about the axis of x.
    pub(crate) fn make_symmetric(&self, at: &mut [Point]) {
        let old = at.to_vec();
        for (i, p) in at.iter_mut().enumerate() {
            let q = old[self.0[i]];
            *p = [(old[i][0] + q[0]) / 2.0, (old[i][1] - q[1]) / 2.0];
        }
    }

    /// Returns the image of a joint.
    pub(crate) fn image_of(&self, joint: usize) -> usize {
        self.0[joint]
    }
}

/// Numbers that look random and are the same each time.
#[derive(Debug)]
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Dice {
        Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d)
    }

    /// Returns a uniform random number in 0..1.
    pub(crate) fn random_unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a uniform random number in -1..1.
    pub(crate) fn random_signed(&mut self) -> f64 {
        2.0 * self.random_unit() - 1.0
    }

    /// Returns a uniform random number in 0..n.
    pub(crate) fn random_below(&mut self, n: usize) -> usize {
        ((self.random_unit() * n as f64) as usize).min(n.saturating_sub(1))
    }
}
