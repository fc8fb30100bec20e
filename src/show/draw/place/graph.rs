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

/// Returns the middles of links. Bars between the same two joints bow in different directions, and free ends point outward.
pub(crate) fn place_hubs(graph: &Graph, net: &Net, joints: &[Point]) -> Vec<Point> {
    let middle = mean(joints.iter().copied());
    let mut out: Vec<Point> = Vec::new();
    for (l, of) in graph.links.iter().enumerate() {
        let centre = mean(of.iter().map(|&j| joints[j]));
        out.push(match (of.len(), net.hub[l]) {
            (1, _) => {
                // away from the other link of the joint
                let others = graph.links.iter().enumerate();
                let other = others
                    .filter(|(m, o)| *m != l && o.contains(&of[0]))
                    .flat_map(|(_, o)| o.iter().filter(|&&j| j != of[0]))
                    .map(|&j| joints[j]);
                let from = mean(other);
                let away = if from == [0.0; 2] && joints.len() == 1 {
                    [1.0, 0.0]
                } else {
                    sub(centre, if joints.len() > 2 { middle } else { from })
                };
                let twin =
                    out.iter().any(|h| plane_norm(sub(*h, centre)) < 0.8) && joints.len() == 1;
                let side = if twin { -1.0 } else { 1.0 };
                add(centre, scale(unit(away), side * 0.75))
            }
            (2, Some(_)) => {
                let along = unit(sub(joints[of[1]], joints[of[0]]));
                let ends = [of[0].min(of[1]), of[0].max(of[1])];
                let twins = graph.links[..l]
                    .iter()
                    .filter(|o| o.len() == 2 && ends.iter().all(|e| o.contains(e)))
                    .count();
                let bow = 0.42 * if twins % 2 == 0 { 1.0 } else { -1.0 } * (1 + twins / 2) as f64;
                let mut turn = if of[0] == ends[0] { bow } else { -bow };
                let mut polygons = graph.links.iter().filter(|o| o.len() > 2);
                if let Some(p) = polygons.find(|o| of.iter().all(|j| o.contains(j))) {
                    // away from the polygon it lies along
                    let from = sub(centre, mean(p.iter().map(|&j| joints[j])));
                    turn = turn.abs().max(0.5) * dot(from, [-along[1], along[0]]).signum();
                }
                add(centre, [-along[1] * turn, along[0] * turn])
            }
            _ => centre,
        });
    }
    out
}
