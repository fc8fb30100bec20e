//! The graph of a structural scheme: links are hyperedges over the joints.

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
