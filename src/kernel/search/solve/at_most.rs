//! A diagram that has every variant, and some that are none, in as few nodes as are wanted: its count is an upper bound.
//!
//! Layers with too many nodes keep those with most paths. The others are merged, those first that reach as many dimensions in the later
//! contours ([`Between`]).

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::Field;
use crate::search::diagram::between::{Between, LEVELS, Passed};
use crate::search::diagram::reduced_rows::Arithmetic;
use crate::search::diagram::redundancy_so_far::{Limits, Redundancy, Spent};
use crate::search::diagram::stage::Stage;
use crate::search::diagram::transition::Worker;
use crate::search::diagram::{DEAD, Diagram, Layer, ShouldCancel};
use crate::search::question::Question;
use crate::search::reduce::lifetimes::Lifetime;
use crate::search::reduce::self_stress_space::SelfStressSpace;
use crate::search::solve::self_stress::{Wanted, flat_stages, self_stress_space};
use hashbrown::HashMap;
use itertools::Itertools;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A diagram with every variant, and how to tell which of its variants are none.
pub(in crate::search) struct AtMost {
    pub(in crate::search) diagram: Diagram,
    field: Field,
    order: Vec<usize>,
    space: SelfStressSpace,
}

/// Returns the maximum number of nodes in a layer, as also limited by memory.
fn layer_width(limits: &Limits, stages: &[Stage<'_>], choices: usize) -> usize {
    let widths = stages.iter().map(|s| s.lanes[0].all.width);
    let numbers = widths.max().unwrap_or(0);
    let each = size_of::<u64>() * 2 * (numbers * numbers / 2 + numbers);
    let bytes = limits.bytes / 4 / (each * choices).max(1);
    (limits.nodes / 100).clamp(64, 4096).min(bytes).max(1)
}

/// Returns the diagram of a question without a searched state, for the variables in an order. Returns `None` if redundant constraints are
/// allowed, or if cancelled.
///
/// # Complexity
/// O(layers · width · choices · s³) field operations for s present self-stresses.
pub(in crate::search) fn at_most(
    question: &Question,
    order: &[usize],
    limits: &Limits,
    wanted: Wanted<'_>,
    cancelled: ShouldCancel<'_>,
) -> Option<AtMost> {
    let field = question.exact.field();
    let space = self_stress_space(question, order, wanted);
    let spent = Spent::within_mechanism(space.lasting);
    if spent.internal() != limits.internal {
        return None;
    }
    let stages = flat_stages(field, order, &space, limits);
    let most = stages.iter().map(|s| s.choices).max().unwrap_or(1);
    let width = layer_width(limits, &stages, most);
    let bounds = boundary_counts(order.len(), &space.contours);
    let mut nodes = vec![(Between::default(), 1.0)];
    let mut layers = Vec::with_capacity(order.len());
    for (stage, bounds) in stages.iter().zip(&bounds) {
        if cancelled() {
            return None;
        }
        let layered = Layered {
            field,
            passed: Passed {
                columns: &stage.lanes[0].all,
                bounds,
            },
        };
        let before = nodes.len();
        let (next, mut edges) = layered.merge_children(&nodes, stage.choices);
        let to = narrow_layer(field, next, width);
        nodes = to.0;
        let alive = edges.iter_mut().filter(|e| **e != DEAD);
        alive.for_each(|e| *e = to.1[*e as usize]);
        layers.push(Layer {
            variable: stage.variable,
            nodes: before,
            choices: stage.choices,
            edges,
        });
    }
    let ends: Vec<Redundancy> = nodes.iter().map(|_| spent.redundancy()).collect();
    Some(AtMost {
        diagram: Diagram::from_layers(layers, ends),
        field,
        order: order.to_vec(),
        space,
    })
}

impl AtMost {
    /// Returns true if a variant of the diagram is an actual variant.
    pub(in crate::search) fn has_variant(&self, choices: &[usize]) -> bool {
        let space = &self.space;
        let contours = space.contours.len();
        let chosen = space.added.iter().zip(&self.order);
        let vectors = chosen.flat_map(|(added, &variable)| &added[choices[variable]]);
        let pivots = Echelon::from_vectors(self.field, vectors).pivots();
        pivots.len() == contours && pivots.iter().all(|&p| p < contours)
    }
}

/// Returns for each stage the number of its coordinates of contours up to each place where some end, from this stage on.
fn boundary_counts(stages: usize, contours: &[Lifetime]) -> Vec<Vec<usize>> {
    let ends: Vec<usize> = contours.iter().map(|c| c.to).dedup().collect();
    let of_stage = |t: usize| {
        let to_come = ends.iter().filter(|&&end| end >= t);
        let live = || contours.iter().filter(|c| c.is_live_at(t));
        let up_to = |end: &usize| live().filter(|c| c.to <= *end).count();
        to_come.map(up_to).collect()
    };
    (0..stages).map(of_stage).collect()
}

/// A child with the numbers that identify it; `None` if it has no completion.
type Named = Option<(Vec<u64>, Between)>;

/// Nodes, and how many ways lead to each.
type Weighed = Vec<(Between, f64)>;

/// The context in which nodes get their children.
struct Layered<'a> {
    field: Field,
    passed: Passed<'a>,
}

impl Layered<'_> {
    /// Returns the children of some nodes, with equal ones merged, and the edges to them.
    fn merge_children(&self, nodes: &Weighed, choices: usize) -> (Weighed, Vec<u32>) {
        let named = |child: Option<Between>| child.map(|c| (c.identity_words(), c));
        let of_node = |(node, _): &(Between, f64)| -> Vec<Named> {
            let children = Worker::with_kept(self.field, |worker| match node.packed_space() {
                Some(packed) => self.exact_children(worker, &packed, choices),
                None => node.child_nodes(&mut worker.arithmetic, &self.passed),
            });
            children.into_iter().map(named).collect()
        };
        let all: Vec<Vec<Named>> = nodes.par_iter().with_min_len(64).map(of_node).collect();
        let mut known: HashMap<Vec<u64>, u32> = HashMap::new();
        let (mut next, mut edges) = (Weighed::new(), Vec::with_capacity(nodes.len() * choices));
        for (children, (_, ways)) in all.into_iter().zip(nodes) {
            for child in children {
                let Some((words, child)) = child else {
                    edges.push(DEAD);
                    continue;
                };
                let number = u32::try_from(next.len()).expect("layers are narrow");
                let to = *known.entry(words).or_insert_with(|| {
                    next.push((child, 0.0));
                    number
                });
                next[to as usize].1 += ways;
                edges.push(to);
            }
        }
        (next, edges)
    }

    /// Returns the children of one space, as the diagram itself has them.
    fn exact_children(
        &self,
        worker: &mut Worker,
        packed: &[u64],
        choices: usize,
    ) -> Vec<Option<Between>> {
        let columns = self.passed.columns;
        let gap = columns.closing;
        let own = usize::from(gap > 0);
        let bounds: Vec<usize> = self.passed.bounds[own..].iter().map(|b| b - gap).collect();
        worker.grow_choices(columns, packed, 0..choices);
        let child = |choice: usize| {
            let rows = worker.rows_of(choice);
            let goes_wrong = rows.starts_behind(columns.contours);
            let alive = !goes_wrong && rows.rank_before(gap) == gap;
            alive.then(|| {
                let mut rows = rows.clone();
                rows.drop_first(gap);
                Between::from_rows(rows, &bounds)
            })
        };
        (0..choices).map(child).collect()
    }
}

/// Returns at most `width` nodes, and the new number of each node.
fn narrow_layer(field: Field, nodes: Weighed, width: usize) -> (Weighed, Vec<u32>) {
    if nodes.len() <= width {
        let same = (0..nodes.len()).map(|i| u32::try_from(i).expect("layers are narrow"));
        let same = same.collect();
        return (nodes, same);
    }
    let mut by_weight: Vec<usize> = (0..nodes.len()).collect();
    by_weight.sort_by(|&a, &b| nodes[b].1.total_cmp(&nodes[a].1).then(a.cmp(&b)));
    let (kept, others) = by_weight.split_at(width / 2);
    let groups = (0..LEVELS).rev().map(|level| {
        let mut groups: BTreeMap<Vec<usize>, Vec<usize>> = BTreeMap::new();
        for &i in others {
            groups
                .entry(nodes[i].0.merge_kind(level))
                .or_default()
                .push(i);
        }
        groups
    });
    let few = |g: &BTreeMap<_, _>| g.len() <= width - width / 2;
    let mut groups = groups.skip_while(|g| !few(g));
    let groups: Vec<Vec<usize>> = match groups.next() {
        Some(groups) => groups.into_values().collect(),
        None => vec![others.to_vec()],
    };
    let groups: Vec<Vec<usize>> = kept.iter().map(|&i| vec![i]).chain(groups).collect();
    let mut to = vec![0; nodes.len()];
    for (number, group) in groups.iter().enumerate() {
        let number = u32::try_from(number).expect("layers are narrow");
        group.iter().for_each(|&i| to[i] = number);
    }
    let together = |group: Vec<usize>| {
        let mut arithmetic = Arithmetic::new(field);
        let (mut whole, mut ways) = nodes[group[0]].clone();
        for &i in &group[1..] {
            whole.join_node(&mut arithmetic, &nodes[i].0);
            ways += nodes[i].1;
        }
        (whole, ways)
    };
    (groups.into_par_iter().map(together).collect(), to)
}
