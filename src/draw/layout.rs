//! Where the joints of a structural scheme go.
//!
//! Links are hyperedges over the joints. A layout starts from several places (the mechanism's own coordinates, Tutte's
//! barycentric drawing with each contour as the outer face, branches on a circle with the chains between them bundled,
//! scattered points), is relaxed by stress majorization, and the one with the least crossings and crowding is polished.
//!
//! # Sources
//! Gansner, Koren & North, "Graph drawing by stress majorization", GD 2004. Tutte, "How to draw a graph", 1963.

use super::initial_layout::{self, Start};
use super::layout_penalty::Crowding;
use super::mirror::Mirror;
pub(super) use crate::geom::vector::{add, cross_plane as cross, dot, norm, scale, sub};

/// A point of the picture; y goes down.
pub(super) type Point = [f64; 2];

/// Links as lists of joints, and the contours that should be empty.
#[derive(Debug)]
pub(super) struct Graph {
    /// The joints of each link.
    pub(super) links: Vec<Vec<usize>>,
    /// How many joints there are.
    pub(super) joints: usize,
    /// The link that is the frame.
    pub(super) frame: Option<usize>,
    /// The joints of each contour, in order.
    pub(super) contours: Vec<Vec<usize>>,
}

/// A finished layout; the unit of length is about the length of a bar.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// The joints.
    pub(super) joints: Vec<Point>,
    /// The middle of each link; the free end of a link with one joint.
    pub(super) hubs: Vec<Point>,
}

/// The nodes of the graph that is relaxed: the joints, then a hub for each link that is not a plain bar.
#[derive(Debug)]
pub(super) struct Net {
    pub(super) hub: Vec<Option<usize>>,
    pub(super) edges: Vec<Vec<(usize, f64)>>,
}

/// Links with more joints or a shared pair of joints need a hub of their own.
pub(super) fn net(graph: &Graph) -> Net {
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
        let radius = radius(joints.len());
        for &j in joints {
            edges[h].push((j, radius));
            edges[j].push((h, radius));
        }
        hub.push(Some(h));
    }
    Net { hub, edges }
}

/// The distance of a link's joints from its middle.
pub(super) fn radius(joints: usize) -> f64 {
    match joints {
        0 | 1 => 0.75,
        2 => 0.8,
        3 => 0.62,
        m => 0.46 / (std::f64::consts::PI / m as f64).sin(),
    }
}

/// A layout to choose from.
#[derive(Debug, Clone)]
struct Candidate {
    cost: f64,
    /// What the cost is multiplied with.
    favour: f64,
    mirror: Option<Mirror>,
    joints: Vec<Point>,
}

/// A layout of the graph, starting also from the places given for the joints.
pub(super) fn layout(graph: &Graph, hints: &[Vec<Point>]) -> Layout {
    let net = net(graph);
    if let Some(joints) = initial_layout::ladder(graph) {
        let hubs = hubs(graph, &net, &joints);
        return Layout { joints, hubs };
    }
    let crowding = Crowding::new(graph);
    let far = distances(&net);
    let nodes = net.edges.len();
    let rounds = (4_000_000 / (nodes * nodes).max(1)).clamp(4, 80);
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut take = |mut at: Vec<Point>, start: &Start, favour: f64| {
        match &start.mirror {
            Some(mirror) => mirror.apply(&mut at),
            None => centre(&mut at),
        }
        let favour = favour * if start.drawn { 0.85 } else { 1.0 };
        let favour = favour * if start.mirror.is_some() { 0.75 } else { 1.0 };
        let cost = crowding.cost(&at[..graph.joints]) * favour;
        if cost.is_finite() {
            candidates.push(Candidate {
                cost,
                favour,
                mirror: start.mirror.clone(),
                joints: at[..graph.joints].to_vec(),
            });
        }
    };
    for start in initial_layout::all(graph, &net, hints) {
        take(start.at.clone(), &start, 1.0);
        let mut relaxed = start.at.clone();
        for part in 0..4 {
            relax(&mut relaxed, &far, rounds / 4 + 1);
            take(relaxed.clone(), &start, 1.0 - 1e-3 * f64::from(part));
        }
    }
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    // the best symmetric ones have their chance, whatever they cost before they are polished
    let symmetric = candidates.iter().filter(|c| c.mirror.is_some());
    let symmetric: Vec<Candidate> = symmetric.take(2).cloned().collect();
    candidates.truncate(5);
    candidates.extend(symmetric);
    let mut best: Option<Candidate> = None;
    for mut c in candidates {
        if crowding.violated(&c.joints) {
            crowding.polish(&mut c.joints, c.mirror.as_ref());
            // a symmetric or familiar drawing is worth something, not a crossing
            let favour = if crowding.violated(&c.joints) {
                1.0
            } else {
                c.favour
            };
            c.cost = crowding.cost(&c.joints) * favour;
        }
        if best.as_ref().is_none_or(|b| c.cost < b.cost) {
            best = Some(c);
        }
    }
    let joints = best.map_or_else(
        || vec![[0.0; 2]; graph.joints],
        |mut c| {
            if c.mirror.is_none() {
                level(graph, &mut c.joints);
            }
            c.joints
        },
    );
    let hubs = hubs(graph, &net, &joints);
    Layout { joints, hubs }
}

/// Lays the longest direction level, if there is one, with the frame below.
fn level(graph: &Graph, at: &mut [Point]) {
    centre(at);
    let sum = |f: &dyn Fn(&Point) -> f64| at.iter().map(f).sum::<f64>();
    let (xx, yy, xy) = (
        sum(&|p| p[0] * p[0]),
        sum(&|p| p[1] * p[1]),
        sum(&|p| p[0] * p[1]),
    );
    let spread = (xx - yy).hypot(2.0 * xy);
    if spread > 0.15 * (xx + yy) {
        let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
        let (c, s) = (angle.cos(), angle.sin());
        at.iter_mut()
            .for_each(|p| *p = [c * p[0] + s * p[1], c * p[1] - s * p[0]]);
    }
    let frame = graph.frame.and_then(|l| graph.links.get(l));
    let down = mean(frame.into_iter().flatten().map(|&j| at[j]));
    if down[1] < -0.1 {
        at.iter_mut().for_each(|p| p[1] = -p[1]);
    }
}

/// The middles of links; of bars between the same two joints, each bows its own way; loose ends point outward.
fn hubs(graph: &Graph, net: &Net, joints: &[Point]) -> Vec<Point> {
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
                let twin = out.iter().any(|h| norm(sub(*h, centre)) < 0.8) && joints.len() == 1;
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

/// Lengths of the shortest paths between nodes; far where there is none.
fn distances(net: &Net) -> Vec<Vec<f64>> {
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

/// Stress majorization, node by node, with weights 1/d².
fn relax(at: &mut [Point], far: &[Vec<f64>], rounds: usize) {
    for _ in 0..rounds {
        for i in 0..at.len() {
            let (mut sum, mut weights) = ([0.0, 0.0], 0.0);
            for j in (0..at.len()).filter(|&j| j != i) {
                let d = far[i][j].max(1e-3);
                let w = 1.0 / (d * d);
                let apart = sub(at[i], at[j]);
                let length = norm(apart);
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

fn centre(at: &mut [Point]) {
    let middle = mean(at.iter().copied());
    at.iter_mut().for_each(|p| *p = sub(*p, middle));
}

/// The mean of some points; the origin if there are none.
pub(super) fn mean(points: impl Iterator<Item = Point>) -> Point {
    let (mut sum, mut n) = ([0.0, 0.0], 0.0f64);
    for p in points {
        sum = add(sum, p);
        n += 1.0;
    }
    scale(sum, 1.0 / n.max(1.0))
}

/// The direction of a vector; across where it has none.
pub(super) fn unit(a: Point) -> Point {
    let length = norm(a);
    if length > 1e-12 {
        scale(a, 1.0 / length)
    } else {
        [1.0, 0.0]
    }
}

/// The distance of a point from a segment.
pub(super) fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    let along = sub(b, a);
    let length = dot(along, along);
    let t = if length > 1e-18 {
        (dot(sub(p, a), along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    norm(sub(p, add(a, scale(along, t))))
}

/// Whether two segments cross, ends not counted.
pub(super) fn segments_cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p, q, r| cross(sub(q, p), sub(r, p));
    side(a, b, c) * side(a, b, d) < -1e-15 && side(c, d, a) * side(c, d, b) < -1e-15
}

/// The area of a polygon.
pub(super) fn area(polygon: &[Point]) -> f64 {
    let n = polygon.len();
    let twice: f64 = (0..n)
        .map(|i| cross(polygon[i], polygon[(i + 1) % n]))
        .sum();
    twice.abs() / 2.0
}

/// Whether a point is inside a polygon (even-odd).
pub(super) fn inside(p: Point, polygon: &[Point]) -> bool {
    let mut odd = false;
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        if (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        {
            odd = !odd;
        }
    }
    odd
}

/// The joints of a link in order round their middle.
pub(super) fn ring(of: &[usize], joints: &[Point]) -> Vec<usize> {
    let centre = mean(of.iter().map(|&j| joints[j]));
    let mut ring = of.to_vec();
    // in a row: there, and straight back
    let far = |from: Point| {
        let far = of.iter().map(|&j| sub(joints[j], from));
        far.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))
            .unwrap_or([0.0; 2])
    };
    let along = unit(far(centre));
    let off = of
        .iter()
        .map(|&j| cross(along, sub(joints[j], centre)).abs());
    if off.fold(0.0, f64::max) <= 0.02 * norm(far(centre)) {
        ring.sort_by(|&a, &b| dot(along, joints[a]).total_cmp(&dot(along, joints[b])));
    } else if ring.len() > 2 {
        ring.sort_by(|&a, &b| {
            let angle = |j: usize| (joints[j][1] - centre[1]).atan2(joints[j][0] - centre[0]);
            angle(a).total_cmp(&angle(b))
        });
    }
    ring
}
