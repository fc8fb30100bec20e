//! In which order to choose: contours should close early and few links stay live.
//!
//! The size of a layer is foretold from the live links of each component: an open chain has at most as many states as
//! combinations, a closed contour few. A beam search over orders minimises the foretold work. A bad guess costs time,
//! never correctness.

use crate::model::mechanism::{JointId, LinkId, Mechanism};
use crate::search::space::Space;
use std::collections::{BTreeMap, BTreeSet};

/// Orders kept at each length.
const BEAM: usize = 8;
/// Base-2 logarithm of the states of one relative motion in an open chain, and in a closed contour; both read off
/// diagrams of the ten-link gripper.
const OPEN: f64 = 9.0;
const CLOSED: f64 = 4.5;

#[derive(Clone)]
struct Partial {
    order: Vec<usize>,
    done: BTreeSet<usize>,
    /// Live links of each component, with the base-2 logarithm of its states.
    components: Vec<(Vec<LinkId>, f64)>,
    work: f64,
}

/// An order of the given variables, foretold to need little work.
///
/// # Complexity
/// O(v · b · BEAM) trial steps for v variables and b of them adjacent to the chosen part.
#[must_use]
pub fn variable_order(
    mechanism: &Mechanism,
    space: &Space,
    variables: &[usize],
    pinned: &[LinkId],
) -> Vec<usize> {
    let joints: Vec<JointId> = variables
        .iter()
        .flat_map(|&v| space.variables[v].joints.iter().copied())
        .collect();
    let mut degree: BTreeMap<LinkId, usize> = BTreeMap::new();
    for &j in &joints {
        for l in mechanism.joints[j].links {
            *degree.entry(l).or_insert(0) += 1;
        }
    }
    let start = Partial {
        order: Vec::new(),
        done: BTreeSet::new(),
        components: Vec::new(),
        work: 0.0,
    };
    let mut beam = vec![start];
    for _ in 0..variables.len() {
        let mut next: BTreeMap<BTreeSet<usize>, Partial> = BTreeMap::new();
        for partial in &beam {
            for &v in &candidates(mechanism, space, variables, partial) {
                let grown = grow(mechanism, space, partial, v, pinned, &degree);
                match next.get(&grown.done) {
                    Some(known) if known.work <= grown.work => {}
                    _ => {
                        next.insert(grown.done.clone(), grown);
                    }
                }
            }
        }
        beam = next.into_values().collect();
        beam.sort_by(|a, b| {
            a.work
                .total_cmp(&b.work)
                .then_with(|| a.order.cmp(&b.order))
        });
        beam.truncate(BEAM);
    }
    beam.into_iter()
        .next()
        .map_or_else(|| variables.to_vec(), |p| p.order)
}

/// Variables that touch a live link; all of them where none does.
fn candidates(
    mechanism: &Mechanism,
    space: &Space,
    variables: &[usize],
    partial: &Partial,
) -> Vec<usize> {
    let left: Vec<usize> = variables
        .iter()
        .copied()
        .filter(|v| !partial.done.contains(v))
        .collect();
    let near: Vec<usize> = left
        .iter()
        .copied()
        .filter(|&v| {
            let mut links = space.variables[v]
                .joints
                .iter()
                .flat_map(|&j| mechanism.joints[j].links);
            links.any(|l| partial.components.iter().any(|(c, _)| c.contains(&l)))
        })
        .collect();
    if near.is_empty() { left } else { near }
}

fn grow(
    mechanism: &Mechanism,
    space: &Space,
    partial: &Partial,
    v: usize,
    pinned: &[LinkId],
    degree: &BTreeMap<LinkId, usize>,
) -> Partial {
    let mut p = partial.clone();
    p.order.push(v);
    p.done.insert(v);
    let variable = &space.variables[v];
    #[allow(clippy::cast_precision_loss, reason = "a guess of a logarithm")]
    let mut choices = (variable.motions as f64).log2();
    // States of the other components multiply the work.
    let others = |p: &Partial, but: usize| -> f64 {
        p.components
            .iter()
            .enumerate()
            .filter(|(i, _)| *i != but)
            .map(|(_, (_, s))| s)
            .sum()
    };
    for &j in &variable.joints {
        let links = mechanism.joints[j].links;
        let home = |p: &mut Partial, l: LinkId| {
            p.components
                .iter()
                .position(|(c, _)| c.contains(&l))
                .unwrap_or_else(|| {
                    p.components.push((vec![l], 0.0));
                    p.components.len() - 1
                })
        };
        let (a, b) = (home(&mut p, links[0]), home(&mut p, links[1]));
        let closing = a == b;
        if !closing {
            let (moved, states) = p.components[b].clone();
            p.components[a].0.extend(moved);
            p.components[a].1 += states;
            p.components.remove(b);
        }
        let a = if b < a { a - 1 } else { a };
        p.components[a].1 += choices;
        // The second joint of a mirrored pair repeats the choice of the first.
        choices = 0.0;
        let (outside, inside) = (others(&p, a), p.components[a].1);
        p.work += (outside + inside).exp2();
        let live = |l: LinkId| {
            // A finished output adds next to nothing: its motion is collapsed to good or bad.
            pinned.contains(&l) || {
                let used = p.done.iter().flat_map(|&v| &space.variables[v].joints);
                used.filter(|&&j| mechanism.joints[j].links.contains(&l))
                    .count()
                    < degree.get(&l).copied().unwrap_or(0)
            }
        };
        let links: Vec<LinkId> = p.components[a]
            .0
            .iter()
            .copied()
            .filter(|&l| live(l))
            .collect();
        #[allow(clippy::cast_precision_loss, reason = "a guess of a logarithm")]
        let pairs = links.len().saturating_sub(1) as f64;
        let cap = pairs * if closing { CLOSED } else { OPEN };
        p.components[a] = (links, inside.min(cap));
        p.components.retain(|(c, _)| !c.is_empty());
    }
    p
}
