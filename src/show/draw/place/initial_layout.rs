//! First places for the joints of a scheme.

use crate::draw::place::graph::{Graph, Net, place_hubs};
use crate::draw::prelude::*;
use itertools::Itertools;
use std::cmp::Reverse;

/// Where to begin.
#[derive(Debug)]
pub(crate) struct Start {
    /// The nodes.
    pub(crate) at: Vec<Point>,
    /// Whether it is how the mechanism is drawn in its file.
    pub(crate) drawn: bool,
}

/// Returns every initial layout.
pub(crate) fn all_starts(graph: &Graph, net: &Net, hints: &[Vec<Point>]) -> Vec<Start> {
    let hints = hints.iter().filter(|h| h.len() == graph.joints);
    let drawn = hints.filter_map(|hint| {
        let at = with_hubs(graph, net, &fit_hint(graph, hint)?);
        Some(Start { at, drawn: true })
    });
    let contours = graph.contours.iter().filter(|c| c.len() > 2);
    let outer = contours.sorted_by_key(|c| Reverse(c.len())).take(6);
    let all: Vec<usize> = (0..graph.joints).collect();
    let on_circle = outer.chain([&all]).map(|contour| Start {
        at: tutte_layout(net, contour),
        drawn: false,
    });
    drawn.chain(on_circle).collect()
}

/// Returns places scaled so that links have about the usual length. `None` if they cannot be scaled.
fn fit_hint(graph: &Graph, hint: &[Point]) -> Option<Vec<Point>> {
    let (mut sum, mut count) = (0.0, 0.0f64);
    for of in &graph.links {
        for (i, &a) in of.iter().enumerate() {
            for &b in &of[i + 1..] {
                sum += plane_norm(sub(hint[a], hint[b]));
                count += 1.0;
            }
        }
    }
    let usual = sum / count.max(1.0);
    (usual.is_finite() && usual > 1e-12)
        .then(|| hint.iter().map(|&p| scale(p, 1.3 / usual)).collect())
}

/// Returns the places of all nodes, from those of the joints.
fn with_hubs(graph: &Graph, net: &Net, joints: &[Point]) -> Vec<Point> {
    let hubs = place_hubs(graph, net, joints).into_iter().zip(&net.hub);
    let hubs = hubs.filter(|(_, hub)| hub.is_some()).map(|(at, _)| at);
    joints.iter().copied().chain(hubs).collect()
}

/// Returns Tutte's drawing: a contour on a circle, and every other node in the middle of its neighbours.
fn tutte_layout(net: &Net, contour: &[usize]) -> Vec<Point> {
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

/// Returns the layout of two links above each other with legs of one kind between them, as in parallel manipulators. The
/// legs are side by side, and the frame is below. Such a layout needs no search.
pub(crate) fn ladder_layout(graph: &Graph) -> Option<Vec<Point>> {
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
        .map(|&j| follow_chain(graph, above, j, &mut seen))
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

/// Returns the joints on a path of bars that starts at a link.
fn follow_chain(graph: &Graph, from: usize, joint: usize, seen: &mut [bool]) -> Vec<usize> {
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
