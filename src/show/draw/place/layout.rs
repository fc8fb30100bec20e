//! Layout of the joints of a structural scheme.
//!
//! Links are hyperedges over the joints. A layout starts from several places: the mechanism's own coordinates, Tutte's
//! barycentric drawing with each contour as the outer face, and all joints on a circle. It is relaxed by stress majorization, and
//! those with the least crossings and crowding are polished by annealing.
//!
//! # Sources
//! Gansner, Koren & North, "Graph drawing by stress majorization", GD 2004. Tutte, "How to draw a graph", 1963.

use crate::draw::place::graph::{Graph, Net, build_net, place_hubs};
use crate::draw::place::initial_layout::{self, Start};
use crate::draw::prelude::*;

/// A finished layout; the unit of length is about the length of a bar.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    /// The joints.
    pub(crate) joints: Vec<Point>,
    /// The middle of each link; the free end of a link with one joint.
    pub(crate) hubs: Vec<Point>,
}

/// A layout to choose from.
#[derive(Debug, Clone)]
struct Candidate {
    cost: f64,
    /// The factor of the cost.
    favour: f64,
    joints: Vec<Point>,
}

impl Candidate {
    /// Creates a layout; returns `None` if its cost is not finite.
    fn new(graph: &Graph, mut at: Vec<Point>, start: &Start, favour: f64) -> Option<Candidate> {
        at.truncate(graph.joints);
        let favour = favour * if start.drawn { 0.85 } else { 1.0 };
        let cost = graph.layout_cost(&at) * favour;
        cost.is_finite().then_some(Candidate {
            cost,
            favour,
            joints: at,
        })
    }

    /// Polishes it where it is crowded.
    fn polish_layout(&mut self, graph: &Graph) {
        if !graph.is_violated(&self.joints) {
            return;
        }
        graph.anneal_layout(&mut self.joints);
        // a familiar drawing is worth something, not a crossing
        let favour = if graph.is_violated(&self.joints) {
            1.0
        } else {
            self.favour
        };
        self.cost = graph.layout_cost(&self.joints) * favour;
    }
}

/// The candidates that are polished.
const POLISHED: usize = 5;

/// Finds a layout of the graph. Starts also from the given places of the joints.
pub(crate) fn find_layout(graph: &Graph, hints: &[Vec<Point>]) -> Layout {
    let net = build_net(graph);
    if let Some(joints) = initial_layout::ladder_layout(graph) {
        let hubs = place_hubs(graph, &net, &joints);
        return Layout { joints, hubs };
    }
    let far = path_lengths(&net);
    let nodes = net.edges.len();
    let rounds = (4_000_000 / (nodes * nodes).max(1)).clamp(4, 80);
    let mut candidates: Vec<Candidate> = Vec::new();
    for start in initial_layout::all_starts(graph, &net, hints) {
        let take = |at: &[Point], favour| Candidate::new(graph, at.to_vec(), &start, favour);
        candidates.extend(take(&start.at, 1.0));
        let mut relaxed = start.at.clone();
        for part in 0..4 {
            relax_stress(&mut relaxed, &far, rounds / 4 + 1);
            candidates.extend(take(&relaxed, 1.0 - 1e-3 * f64::from(part)));
        }
    }
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    candidates.truncate(POLISHED);
    for candidate in &mut candidates {
        candidate.polish_layout(graph);
    }
    let best = candidates
        .into_iter()
        .min_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut joints = best.map_or_else(|| vec![[0.0; 2]; graph.joints], |c| c.joints);
    level_layout(graph, &mut joints);
    let hubs = place_hubs(graph, &net, &joints);
    Layout { joints, hubs }
}

/// Lays the longest direction level, with the frame below; a side of the frame where no direction is longer.
fn level_layout(graph: &Graph, at: &mut [Point]) {
    let middle = mean(at.iter().copied());
    at.iter_mut().for_each(|p| *p = sub(*p, middle));
    let sum = |f: &dyn Fn(&Point) -> f64| at.iter().map(f).sum::<f64>();
    let (xx, yy, xy) = (
        sum(&|p| p[0] * p[0]),
        sum(&|p| p[1] * p[1]),
        sum(&|p| p[0] * p[1]),
    );
    let frame: &[usize] = graph.frame.map_or(&[], |l| &graph.links[l]);
    let spread = (xx - yy).hypot(2.0 * xy);
    let angle = match frame {
        _ if spread > 0.15 * (xx + yy) => 0.5 * (2.0 * xy).atan2(xx - yy),
        &[a, b, ..] => {
            let [x, y] = sub(at[b], at[a]);
            y.atan2(x)
        }
        _ => 0.0,
    };
    let (c, s) = (angle.cos(), angle.sin());
    for p in at.iter_mut() {
        *p = [c * p[0] + s * p[1], c * p[1] - s * p[0]];
    }
    let down = mean(frame.iter().map(|&j| at[j]));
    if down[1] < -0.1 {
        at.iter_mut().for_each(|p| p[1] = -p[1]);
    }
}

/// Returns the lengths of the shortest paths between nodes, or a large length if there is no path.
fn path_lengths(net: &Net) -> Vec<Vec<f64>> {
    let n = net.edges.len();
    let apart = 3.0 + (n as f64).sqrt();
    (0..n)
        .map(|from| {
            let mut d = vec![f64::INFINITY; n];
            d[from] = 0.0;
            let mut queue = std::collections::VecDeque::from([from]);
            while let Some(x) = queue.pop_front() {
                for &(y, length) in &net.edges[x] {
                    if d[x] + length < d[y] - 1e-12 {
                        d[y] = d[x] + length;
                        queue.push_back(y);
                    }
                }
            }
            d.iter()
                .map(|&v| if v.is_finite() { v } else { apart })
                .collect()
        })
        .collect()
}

/// Applies stress majorization node by node, with weights 1/d².
fn relax_stress(at: &mut [Point], far: &[Vec<f64>], rounds: usize) {
    for _ in 0..rounds {
        for i in 0..at.len() {
            let (mut sum, mut weights) = ([0.0, 0.0], 0.0);
            for j in (0..at.len()).filter(|&j| j != i) {
                let d = far[i][j].max(1e-3);
                let w = 1.0 / (d * d);
                let apart = sub(at[i], at[j]);
                let length = plane_norm(apart);
                let dir = if length > 1e-9 {
                    scale(apart, 1.0 / length)
                } else {
                    // coincident nodes part in directions of their own
                    let angle = 2.4 * (i * 31 + j) as f64;
                    [angle.cos(), angle.sin()]
                };
                let wish = add(at[j], scale(dir, d));
                sum = add(sum, scale(wish, w));
                weights += w;
            }
            if weights > 0.0 {
                at[i] = scale(sum, 1.0 / weights);
            }
        }
    }
}
