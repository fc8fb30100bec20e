//! Breadth-first spanning trees of the links of a mechanism and of any graph. Also the sets that groups connect,
//! directly or through others, as joints are connected by shared contours and couplings.

use crate::model::mechanism::{JointId, LinkId, Mechanism, StateId};
use petgraph::unionfind::UnionFind;
use std::collections::{BTreeMap, VecDeque};

/// A node reached from an earlier one. By default nodes are links and edges are joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TreeStep<N = LinkId, E = JointId> {
    /// The node reached.
    pub link: N,
    /// The node it is reached from.
    pub from: N,
    /// The edge between the two.
    pub joint: E,
    /// Whether the node reached is the second end of the edge.
    pub forward: bool,
}

/// Returns the spanning tree of the links that a state's joints connect with the frame. Every link comes after its
/// parent.
///
/// # Complexity
/// O(n + m) for n links, m joints.
///
/// # Examples
/// ```
/// use ozols::closure::tree::spanning_tree;
/// use ozols::model::mechanism::StateId;
/// // Every link but the frame; the one joint more than steps closes the loop.
/// let four_bar = ozols::built_in("four-bar")?;
/// assert_eq!(spanning_tree(&four_bar, StateId::FREE).len(), 3);
/// # Ok::<(), ozols::Error>(())
/// ```
#[must_use]
pub fn spanning_tree(mechanism: &Mechanism, state: StateId) -> Vec<TreeStep> {
    let joints: Vec<JointId> = mechanism.joints_in(state).collect();
    let ends = joints
        .iter()
        .map(|&j| mechanism.joints[j].links.map(LinkId::index));
    let (_, steps) = spanning_forest(
        mechanism.links.len(),
        ends,
        |_| false,
        [mechanism.frame_link().index()],
    );
    let named = |s: TreeStep<usize, usize>| TreeStep {
        link: LinkId::new(s.link),
        from: LinkId::new(s.from),
        joint: joints[s.joint],
        forward: s.forward,
    };
    steps.into_iter().map(named).collect()
}

/// Returns the joints on a shortest path from the frame to a link, with their direction of passage. Empty if there is
/// no path.
///
/// # Complexity
/// O(n + m) for n links, m joints.
#[must_use]
pub(crate) fn path_from_frame(
    mechanism: &Mechanism,
    state: StateId,
    link: LinkId,
) -> Vec<(JointId, bool)> {
    path_in(&spanning_tree(mechanism, state), link)
}

/// Returns the path in a known spanning tree, as `path_from_frame` does.
///
/// # Complexity
/// O(n) for n links.
pub(crate) fn path_in(tree: &[TreeStep], link: LinkId) -> Vec<(JointId, bool)> {
    let (mut path, mut at) = (Vec::new(), link);
    // Every step comes after the one that leads to its start.
    for s in tree.iter().rev() {
        if s.link == at {
            path.push((s.joint, s.forward));
            at = s.from;
        }
    }
    path.reverse();
    path
}

/// Returns the roots and steps of a spanning forest, with a tree from each of the `starts` that no earlier one reaches.
/// Edges marked `late` are used only if no other edge leads further.
///
/// # Complexity
/// O(n + m) for n nodes, m edges.
///
/// # Examples
/// ```
/// use ozols::closure::tree::spanning_forest;
/// // A triangle and a separate edge.
/// let edges = [[0, 1], [1, 2], [2, 0], [3, 4]];
/// let (roots, steps) = spanning_forest(5, edges, |_| false, 0..5);
/// assert_eq!((roots, steps.len()), (vec![0, 3], 3));
/// ```
pub fn spanning_forest(
    nodes: usize,
    edges: impl IntoIterator<Item = [usize; 2]>,
    late: impl Fn(usize) -> bool,
    starts: impl IntoIterator<Item = usize>,
) -> (Vec<usize>, Vec<TreeStep<usize, usize>>) {
    let mut at: Vec<Vec<(usize, usize, bool)>> = vec![Vec::new(); nodes];
    for (e, [a, b]) in edges.into_iter().enumerate() {
        at[a].push((e, b, true));
        at[b].push((e, a, false));
    }
    let (mut roots, mut steps) = (Vec::new(), Vec::new());
    let mut reached = vec![false; nodes];
    for start in starts {
        if std::mem::replace(&mut reached[start], true) {
            continue;
        }
        roots.push(start);
        let (mut queue, mut waiting) = (VecDeque::from([start]), VecDeque::new());
        loop {
            let mut next = Vec::new();
            if let Some(from) = queue.pop_front() {
                for &(joint, link, forward) in &at[from] {
                    let step = TreeStep {
                        link,
                        from,
                        joint,
                        forward,
                    };
                    if late(joint) {
                        waiting.push_back(step);
                    } else {
                        next.push(step);
                    }
                }
            } else if let Some(step) = waiting.pop_front() {
                next.push(step);
            } else {
                break;
            }
            for step in next {
                if !std::mem::replace(&mut reached[step.link], true) {
                    steps.push(step);
                    queue.push_back(step.link);
                }
            }
        }
    }
    (roots, steps)
}

/// Returns the sets that groups connect, each ascending, in the order of their first members.
///
/// # Complexity
/// O(n log n) for groups with n members in all.
pub(crate) fn connected_sets<T: Ord + Copy>(
    groups: impl IntoIterator<Item = Vec<T>>,
) -> Vec<Vec<T>> {
    let groups: Vec<Vec<T>> = groups.into_iter().collect();
    let mut number: BTreeMap<T, usize> = groups.iter().flatten().map(|&t| (t, 0)).collect();
    number.values_mut().zip(0..).for_each(|(n, i)| *n = i);
    let mut sets = UnionFind::new(number.len());
    for pair in groups.iter().flat_map(|g| g.windows(2)) {
        sets.union(number[&pair[0]], number[&pair[1]]);
    }
    let mut out: BTreeMap<usize, Vec<T>> = BTreeMap::new();
    for (&t, &n) in &number {
        out.entry(sets.find(n)).or_default().push(t);
    }
    let mut out: Vec<Vec<T>> = out.into_values().collect();
    out.sort_unstable();
    out
}

#[cfg(test)]
mod tests {
    use super::connected_sets;
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_forest_spans(edges in prop::collection::vec([0..8usize, 0..8usize], 0..16), split in 0..16usize) {
            let (roots, steps) = spanning_forest(8, edges.iter().copied(), |e| e >= split, 0..8);
            // Each tree has one step fewer than nodes, and there are as many trees as components.
            prop_assert_eq!(roots.len() + steps.len(), 8);
            let mut sets = petgraph::unionfind::UnionFind::<usize>::new(8);
            let merged = edges.iter().filter(|[a, b]| sets.union(*a, *b)).count();
            prop_assert_eq!(steps.len(), merged);
            let mut reached = roots;
            for s in &steps {
                prop_assert!(reached.contains(&s.from) && !reached.contains(&s.link));
                let ends = if s.forward { [s.from, s.link] } else { [s.link, s.from] };
                prop_assert_eq!(edges[s.joint], ends);
                reached.push(s.link);
            }
        }
    }

    #[test]
    fn early_edges_come_first() {
        // With 0-1 late and 0-2 and 2-1 early, node 1 is reached by the longer path.
        let (_, steps) = spanning_forest(3, [[0, 1], [0, 2], [2, 1]], |e| e == 0, [0]);
        assert_eq!(steps.iter().map(|s| s.joint).collect::<Vec<_>>(), [1, 2]);
    }

    #[test]
    fn groups_are_tied_through_others() {
        let groups = [vec![5, 2], vec![9], vec![], vec![3, 4, 5], vec![7, 9]];
        assert_eq!(connected_sets(groups), [vec![2, 3, 4, 5], vec![7, 9]]);
    }
}
