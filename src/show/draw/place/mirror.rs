//! Mirror symmetry of a mechanism as drawn, kept by its scheme.

use crate::draw::place::graph::{Graph, Net};
use crate::svg::plane::{Point, mean, norm, sub};

/// The image of each node under a reflection of y, and whether it is its own.
#[derive(Debug, Clone)]
pub(in crate::draw) struct Mirror(Vec<usize>);

impl Mirror {
    /// The reflection of y that carries the joints onto each other and links onto links, where there is one.
    pub(in crate::draw) fn find(graph: &Graph, net: &Net, joints: &[Point]) -> Option<Mirror> {
        let middle = mean(joints.iter().copied());
        let size = joints
            .iter()
            .map(|&p| norm(sub(p, middle)))
            .fold(0.0, f64::max);
        let image = |j: usize| {
            let flipped = [joints[j][0], 2.0 * middle[1] - joints[j][1]];
            let mut near =
                (0..joints.len()).filter(|&k| norm(sub(joints[k], flipped)) < 1e-4 * size);
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
    pub(in crate::draw) fn apply(&self, at: &mut [Point]) {
        let old = at.to_vec();
        for (i, p) in at.iter_mut().enumerate() {
            let q = old[self.0[i]];
            *p = [(old[i][0] + q[0]) / 2.0, (old[i][1] - q[1]) / 2.0];
        }
    }

    /// The image of a joint.
    pub(in crate::draw) fn image(&self, joint: usize) -> usize {
        self.0[joint]
    }
}
