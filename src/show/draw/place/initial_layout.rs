//! First places for the joints of a scheme.

use crate::draw::place::Dice;
use crate::draw::place::graph::{Graph, Mirror, Net};
use crate::svg::plane::{Point, add, mean, norm, scale, sub};
use std::f64::consts::TAU;

/// Where to begin.
#[derive(Debug)]
pub(in crate::draw) struct Start {
    /// The nodes.
    pub(in crate::draw) at: Vec<Point>,
    /// Whether it is how the mechanism is drawn in its file.
    pub(in crate::draw) drawn: bool,
    /// Its symmetry, if it has one.
    pub(in crate::draw) mirror: Option<Mirror>,
}

/// Every start.
pub(in crate::draw) fn all(graph: &Graph, net: &Net, hints: &[Vec<Point>]) -> Vec<Start> {
    let mut out = Vec::new();
    let plain = |at| Start {
        at,
        drawn: false,
        mirror: None,
    };
    for hint in hints.iter().filter(|h| h.len() == graph.joints) {
        if let Some(fitted) = fitted(graph, hint) {
            let at = with_hubs(graph, net, &fitted);
            if let Some(mirror) = Mirror::find(graph, net, &fitted) {
                out.push(Start {
                    at: at.clone(),
                    drawn: true,
                    mirror: Some(mirror),
                });
            }
            out.push(Start {
                at,
                drawn: true,
                mirror: None,
            });
        }
    }
    let few = graph.joints <= 120;
    let mut roots: Vec<usize> = (0..graph.links.len()).collect();
    roots.sort_by_key(|&l| (std::cmp::Reverse(graph.links[l].len()), l));
    for root in roots.into_iter().take(3) {
        out.push(plain(layers(graph, net, root)));
    }
    let mut outer: Vec<&Vec<usize>> = graph.contours.iter().filter(|c| c.len() > 2).collect();
    outer.sort_by_key(|c| std::cmp::Reverse(c.len()));
    for contour in outer.into_iter().take(if few { 6 } else { 1 }) {
        out.push(plain(tutte(net, contour)));
    }
    for turn in 0..if few { 10 } else { 2 } {
        out.push(plain(bundles(graph, net, turn)));
    }
    let mut dice = Dice::new(7);
    for _ in 0..if few { 6 } else { 1 } {
        let reach = (net.edges.len() as f64).sqrt();
        let scatter = |_: &Vec<(usize, f64)>| [reach * dice.signed(), reach * dice.signed()];
        out.push(plain(net.edges.iter().map(scatter).collect()));
    }
    out
}

/// Places scaled so that links have about the usual length; `None` where they cannot be.
fn fitted(graph: &Graph, hint: &[Point]) -> Option<Vec<Point>> {
    let (mut sum, mut count) = (0.0, 0.0f64);
    for of in &graph.links {
        for (i, &a) in of.iter().enumerate() {
            for &b in &of[i + 1..] {
                sum += norm(sub(hint[a], hint[b]));
                count += 1.0;
            }
        }
    }
    let usual = sum / count.max(1.0);
    (usual.is_finite() && usual > 1e-12)
        .then(|| hint.iter().map(|&p| scale(p, 1.3 / usual)).collect())
}

fn with_hubs(graph: &Graph, net: &Net, joints: &[Point]) -> Vec<Point> {
    let mut at = joints.to_vec();
    for (of, hub) in graph.links.iter().zip(&net.hub) {
        if hub.is_some() {
            let middle = mean(of.iter().map(|&j| joints[j]));
            let from = mean(joints.iter().copied());
            let out = if of.len() == 1 {
                scale(sub(middle, from), 0.3)
            } else {
                [0.0, 0.0]
            };
            at.push(add(middle, out));
        }
    }
    at
}

/// Links by their distance from one of them, each layer in the order of what it hangs on.
fn layers(graph: &Graph, net: &Net, root: usize) -> Vec<Point> {
    let links = graph.links.len();
    let mut layers = Layers::around(graph, root);
    let x = layers.untangled();
    let place = |n: usize| [1.0 * x[n], 0.62 * layers.depth[n] as f64];
    let mut at: Vec<Point> = (0..graph.joints).map(|j| place(links + j)).collect();
    // a link alone in its layer is round on the side of the others
    for l in (0..links).filter(|&l| layers.rows[layers.depth[l]].len() == 1) {
        let of = &graph.links[l];
        let wide = of.iter().map(|&j| x[links + j].abs()).fold(1e-9, f64::max);
        for &j in of {
            let away = (at[j][1] - place(l)[1]).signum();
            at[j][1] += 0.3 * away * (1.0 - (x[links + j] / wide).powi(2)) * wide.min(2.0);
        }
    }
    at.extend((0..links).filter(|&l| net.hub[l].is_some()).map(place));
    at
}

/// Links and joints in turn, by their distance from a link: link l is l, joint j is links + j.
struct Layers {
    /// The links of each joint and the joints of each link.
    near: Vec<Vec<usize>>,
    depth: Vec<usize>,
    /// What is in each layer, from left to right.
    rows: Vec<Vec<usize>>,
}

impl Layers {
    /// In the order a breadth-first search finds them.
    fn around(graph: &Graph, root: usize) -> Layers {
        let links = graph.links.len();
        let mut near: Vec<Vec<usize>> = vec![Vec::new(); links + graph.joints];
        for (l, of) in graph.links.iter().enumerate() {
            for &j in of {
                near[l].push(links + j);
                near[links + j].push(l);
            }
        }
        let mut depth: Vec<Option<usize>> = vec![None; near.len()];
        let mut rows: Vec<Vec<usize>> = Vec::new();
        for from in std::iter::once(root).chain(0..near.len()) {
            if depth[from].is_some() {
                continue;
            }
            depth[from] = Some(0);
            let mut queue = std::collections::VecDeque::from([from]);
            while let Some(x) = queue.pop_front() {
                let d = depth[x].unwrap_or(0);
                if rows.len() <= d {
                    rows.push(Vec::new());
                }
                rows[d].push(x);
                for &y in &near[x] {
                    if depth[y].is_none() {
                        depth[y] = Some(d + 1);
                        queue.push_back(y);
                    }
                }
            }
        }
        let depth = depth.into_iter().map(|d| d.unwrap_or(0));
        Layers {
            depth: depth.collect(),
            near,
            rows,
        }
    }

    /// Orders each layer by the middles of what hangs on it, and tells how far to the right each of them then is.
    fn untangled(&mut self) -> Vec<f64> {
        let Layers { near, rows, .. } = self;
        let mut x = vec![0.0; near.len()];
        let spread = |row: &[usize], x: &mut [f64]| {
            for (i, &n) in row.iter().enumerate() {
                x[n] = i as f64 - (row.len() as f64 - 1.0) / 2.0;
            }
        };
        rows.iter().for_each(|row| spread(row, &mut x));
        for sweep in 0..8 {
            for i in 0..rows.len() {
                let r = if sweep % 2 == 0 {
                    i
                } else {
                    rows.len() - 1 - i
                };
                let mut keyed: Vec<(f64, usize)> = rows[r]
                    .iter()
                    .map(|&n| {
                        let beside = near[n].iter().map(|&m| [x[m], 0.0]);
                        (mean(beside)[0], n)
                    })
                    .collect();
                keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
                rows[r] = keyed.into_iter().map(|(_, n)| n).collect();
                spread(&rows[r], &mut x);
            }
        }
        x
    }
}

/// Tutte's drawing: a contour on a circle, every other node in the middle of its neighbours.
fn tutte(net: &Net, contour: &[usize]) -> Vec<Point> {
    let n = net.edges.len();
    let radius = (n as f64).sqrt() * 0.9;
    let mut at = vec![[0.0, 0.0]; n];
    let mut fixed = vec![false; n];
    for (i, &j) in contour.iter().enumerate() {
        let angle = TAU * i as f64 / contour.len() as f64;
        at[j] = [radius * angle.cos(), radius * angle.sin()];
        fixed[j] = true;
    }
    // hubs between two joints of the contour belong to the circle as well
    for &hub in net.hub.iter().flatten() {
        let on: Vec<Point> = net.edges[hub]
            .iter()
            .filter(|(j, _)| contour.contains(j))
            .map(|&(j, _)| at[j])
            .collect();
        if on.len() > 1 {
            at[hub] = mean(on.into_iter());
            fixed[hub] = true;
        }
    }
    for _ in 0..200 {
        for i in (0..n).filter(|&i| !fixed[i]) {
            if !net.edges[i].is_empty() {
                at[i] = mean(net.edges[i].iter().map(|&(j, _)| at[j]));
            }
        }
    }
    // what lies in one place is parted a little
    for (i, p) in at.iter_mut().enumerate() {
        let angle = 2.4 * i as f64;
        *p = add(*p, [0.02 * angle.cos(), 0.02 * angle.sin()]);
    }
    at
}

/// Links with three and more joints on a circle, the chains between them as bundles of arcs.
fn bundles(graph: &Graph, net: &Net, turn: u64) -> Vec<Point> {
    let branches: Vec<usize> = (0..graph.links.len())
        .filter(|&l| graph.links[l].len() > 2)
        .collect();
    let mut dice = Dice::new(turn + 100);
    let mut order = branches.clone();
    if turn > 0 {
        for i in (1..order.len()).rev() {
            order.swap(i, dice.below(i + 1));
        }
    }
    let chains = chains(graph, &branches);
    let long = chains.iter().map(Vec::len).max().unwrap_or(1) as f64;
    let radius = (0.5 * (long + 1.0)).max(0.35 * order.len() as f64 + 0.5);
    let mut at = vec![[0.0, 0.0]; net.edges.len()];
    let mut place = vec![[0.0, 0.0]; graph.links.len()];
    for (i, &l) in order.iter().enumerate() {
        let angle = TAU * (i as f64 / order.len() as f64 + 0.25);
        place[l] = [radius * angle.cos(), radius * angle.sin()];
        if let Some(h) = net.hub[l] {
            at[h] = place[l];
        }
    }
    let ends: Vec<[usize; 2]> = chains.iter().map(|c| branch_ends(graph, c)).collect();
    for (c, chain) in chains.iter().enumerate() {
        let offset = 1.1 * beside_twins(&ends, c);
        for (&j, p) in chain.iter().zip(arc(&place, ends[c], offset, chain.len())) {
            at[j] = p;
        }
    }
    if branches.is_empty() {
        ring(graph, &mut at);
    }
    for (l, of) in graph.links.iter().enumerate() {
        if let Some(h) = net.hub[l].filter(|_| of.len() < 3) {
            let middle = mean(of.iter().map(|&j| at[j]));
            at[h] = add(middle, [0.3 * dice.signed(), 0.3 * dice.signed()]);
        }
    }
    at
}

/// The chains that go out from links with three and more joints, each once.
fn chains(graph: &Graph, branches: &[usize]) -> Vec<Vec<usize>> {
    let mut chains: Vec<Vec<usize>> = Vec::new();
    let mut seen = vec![false; graph.joints];
    for &l in branches {
        for &j in &graph.links[l] {
            if !seen[j] {
                chains.push(chain(graph, l, j, &mut seen));
            }
        }
    }
    chains
}

/// How far a chain is from the middle of those between the same two links.
fn beside_twins(ends: &[[usize; 2]], c: usize) -> f64 {
    let same: Vec<usize> = (0..ends.len())
        .filter(|&d| ends[d] == ends[c] || ends[d] == [ends[c][1], ends[c][0]])
        .collect();
    let mine = same.iter().position(|&d| d == c).unwrap_or(0) as f64;
    mine - (same.len() as f64 - 1.0) / 2.0
}

/// The places of so many joints on an arc between two links; all arcs between the same links bow as seen from the same end.
fn arc(
    place: &[Point],
    ends: [usize; 2],
    offset: f64,
    joints: usize,
) -> impl Iterator<Item = Point> + use<> {
    let (mut a, mut b) = (place[ends[0]], place[ends[1]]);
    let flip = ends[0] > ends[1];
    if ends[0] == ends[1] {
        // a loop from a link to itself goes outward
        b = add(b, scale(b, 0.8));
    }
    if flip {
        std::mem::swap(&mut a, &mut b);
    }
    let along = sub(b, a);
    let across = [-along[1], along[0]];
    let across = scale(across, 1.0 / norm(across).max(1e-9));
    (0..joints).map(move |i| {
        let t = (i + 1) as f64 / (joints + 1) as f64;
        let t = if flip { 1.0 - t } else { t };
        let bow = offset * (0.35 + 0.65 * (std::f64::consts::PI * t).sin());
        add(add(a, scale(along, t)), scale(across, bow))
    })
}

/// All joints on a circle, in the order of the first contour.
fn ring(graph: &Graph, at: &mut [Point]) {
    let radius = 0.19 * graph.joints as f64;
    let ring = graph.contours.first().cloned().unwrap_or_default();
    for (j, p) in at.iter_mut().enumerate().take(graph.joints) {
        let i = ring.iter().position(|&r| r == j).unwrap_or(j);
        let angle = TAU * (i as f64 + 0.5) / graph.joints.max(1) as f64 + TAU / 4.0;
        *p = [radius * angle.cos(), radius * angle.sin()];
    }
}

/// Two links above each other and legs of one kind between them, as parallel manipulators have: the legs stand side by
/// side, the frame is below. There is nothing to search for then.
pub(in crate::draw) fn ladder(graph: &Graph) -> Option<Vec<Point>> {
    let mut branches = (0..graph.links.len()).filter(|&l| graph.links[l].len() > 2);
    let (mut above, mut below) = (branches.next()?, branches.next()?);
    if branches.next().is_some() {
        return None;
    }
    if graph.frame == Some(above) {
        (above, below) = (below, above);
    }
    let mut seen = vec![false; graph.joints];
    let legs: Vec<Vec<usize>> = graph.links[above]
        .iter()
        .map(|&j| chain(graph, above, j, &mut seen))
        .collect();
    let long = legs.first()?.len();
    let alike = legs.iter().all(|leg| leg.len() == long);
    let whole = seen.iter().all(|&s| s) && legs.len() == graph.links[below].len();
    if !alike || !whole || long < 2 {
        return None;
    }
    let mut at = vec![[0.0; 2]; graph.joints];
    let middle = (legs.len() as f64 - 1.0) / 2.0;
    for (i, leg) in legs.iter().enumerate() {
        let x = i as f64 - middle;
        // longest at the ends, so that both links are polygons with the legs on one side
        let half = 0.5 * (long as f64 - 1.0) + 0.3 * (x / middle).powi(2);
        for (n, &j) in leg.iter().enumerate() {
            let t = 2.0 * n as f64 / (long as f64 - 1.0) - 1.0;
            at[j] = [x, half * t];
        }
    }
    Some(at)
}

/// The joints from a link on through bars.
fn chain(graph: &Graph, from: usize, joint: usize, seen: &mut [bool]) -> Vec<usize> {
    let (mut at, mut j, mut out) = (from, joint, Vec::new());
    loop {
        seen[j] = true;
        out.push(j);
        let next = (0..graph.links.len()).find(|&l| l != at && graph.links[l].contains(&j));
        let Some(next) = next.filter(|&l| graph.links[l].len() == 2) else {
            return out;
        };
        let Some(&on) = graph.links[next].iter().find(|&&k| k != j && !seen[k]) else {
            return out;
        };
        (at, j) = (next, on);
    }
}

/// The links with three and more joints at the ends of a chain.
fn branch_ends(graph: &Graph, chain: &[usize]) -> [usize; 2] {
    let end = |j: Option<&usize>, last: bool| {
        let mut of = (0..graph.links.len())
            .filter(|&l| graph.links[l].len() > 2 && j.is_some_and(|j| graph.links[l].contains(j)));
        let first = of.next();
        if last && chain.len() == 1 {
            of.next().or(first)
        } else {
            first
        }
    };
    let a = end(chain.first(), false).unwrap_or(0);
    [a, end(chain.last(), true).unwrap_or(a)]
}
