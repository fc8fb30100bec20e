//! A numbering of variables that does not depend on how the file lists links and joints.
//!
//! Variables are ordered by the freedoms and costs of their choices, then by the links that they join, then by the other joints of these
//! links. Variables that are still equal after this colour refinement are ordered by name. So the numbering does not depend on the order of
//! tables in the file, nor on coordinates.
//!
//! # Sources
//! Refinement of colours: Weisfeiler & Leman, "The reduction of a graph to canonical form" (1968).

use crate::model::mechanism::{LinkId, Mechanism, Role};
use crate::search::question::space::Space;
use std::collections::BTreeMap;

/// Returns the variables in their canonical order.
///
/// # Complexity
/// O(v log v) comparisons of choices, then O((v + n) log n) for each of at most n rounds of refinement.
pub(in crate::search) fn canonical_order(
    mechanism: &Mechanism,
    space: &Space,
    variables: &[usize],
) -> Vec<usize> {
    let effect = |&v: &usize| {
        let choices = &space.variables[v].choices;
        choices
            .iter()
            .map(|c| {
                let freedoms: Vec<usize> = c.spans.iter().map(Vec::len).collect();
                (freedoms, c.cost_milli)
            })
            .collect::<Vec<_>>()
    };
    let joined = |v: usize| {
        let joints = space.variables[v].joints.iter();
        joints.flat_map(|&j| mechanism.joints[j].links)
    };
    let mut colour = class_ranks(variables.iter().map(effect));
    let links: Vec<LinkId> = mechanism.link_ids().collect();
    let role = |&l: &LinkId| match mechanism.links[l].role {
        Role::Frame => 0,
        Role::Output => 1,
        Role::Object => 2,
        Role::Inner => 3,
    };
    let mut of_link = class_ranks(links.iter().map(role));
    let classes = |colours: &[usize]| colours.iter().max().map_or(0, |m| m + 1);
    loop {
        let before = classes(&colour) + classes(&of_link);
        let mut around: BTreeMap<LinkId, Vec<usize>> = BTreeMap::new();
        for (&v, &c) in variables.iter().zip(&colour) {
            joined(v).for_each(|l| around.entry(l).or_default().push(c));
        }
        around.values_mut().for_each(|c| c.sort_unstable());
        of_link = class_ranks(links.iter().map(|l| (of_link[l.index()], around.get(l))));
        let with_links = variables.iter().zip(&colour).map(|(&v, &c)| {
            let mut ends: Vec<usize> = joined(v).map(|l| of_link[l.index()]).collect();
            ends.sort_unstable();
            (c, ends)
        });
        colour = class_ranks(with_links.collect::<Vec<_>>().into_iter());
        if classes(&colour) + classes(&of_link) == before {
            break;
        }
    }
    let name = |v: usize| {
        let joints = space.variables[v].joints.iter();
        joints.map(|&j| &mechanism.joints[j].id).min()
    };
    let mut out: Vec<(usize, usize)> = colour.into_iter().zip(variables.iter().copied()).collect();
    out.sort_by_key(|&(c, v)| (c, name(v)));
    out.into_iter().map(|(_, v)| v).collect()
}

/// Returns the rank of each value among the different values.
fn class_ranks<T: Ord>(values: impl Iterator<Item = T> + Clone) -> Vec<usize> {
    let mut sorted: Vec<T> = values.clone().collect();
    sorted.sort_unstable();
    sorted.dedup();
    values.map(|x| sorted.partition_point(|y| *y < x)).collect()
}
