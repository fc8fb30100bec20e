//! The contour basis is a minimum cycle basis: against a greedy choice among all cycles of small graphs.

use crate::common::*;
mod shares;

use ozols::closure::contour::{closed_walk, contour_basis};

/// A mechanism whose graph has these edges; joints are all alike, only the graph matters.
fn text(links: usize, edges: &[(usize, usize)]) -> String {
    let mark = |l: usize| format!("{l}{}", if l == 1 { "*" } else { "" });
    let joint =
        |(i, (a, b)): (usize, &(usize, usize))| format!("j{i} | {a} {b} | spherical | {i}, 0, 0");
    let joints = edges.iter().enumerate().map(joint).join("\n");
    write_mechanism("name = \"graph\"", &(0..links).map(mark).join(" "), &joints)
}

/// Total length of a minimum cycle basis: all simple cycles as edge sets, shortest first, kept while independent.
fn least_total(m: &Mechanism) -> usize {
    let edges = |c: &Vec<JointId>| c.iter().map(|j| 1u32 << j.index()).sum::<u32>();
    let cycles = simple_cycles(m, StateId::FREE);
    let (mut basis, mut total): (Vec<u32>, usize) = (Vec::new(), 0);
    for cycle in cycles.iter().sorted_by_key(|c| c.len()) {
        let reduced = basis.iter().fold(edges(cycle), |c, b| c.min(c ^ b));
        if reduced != 0 {
            basis.push(reduced);
            basis.sort_unstable_by(|a, b| b.cmp(a));
            total += cycle.len();
        }
    }
    total
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]
    #[test]
    fn contours_are_a_minimum_cycle_basis(
        links in 3usize..7,
        tree in proptest::collection::vec(any::<prop::sample::Index>(), 6),
        more in proptest::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..6),
    ) {
        let mut edges: Vec<(usize, usize)> = (1..links).map(|l| (tree[l - 1].index(l), l)).collect();
        edges.extend(more.iter().map(|(a, b)| (a.index(links), b.index(links))).filter(|(a, b)| a != b));
        let m = read(&text(links, &edges));
        let basis = contour_basis(&m, StateId::FREE);
        prop_assert_eq!(basis.len(), edges.len() + 1 - links);
        // Each begins at its first joint in the file.
        prop_assert!(basis.iter().all(|c| c.joints.iter().min() == c.joints.first()));
        prop_assert_eq!(basis.iter().map(|c| c.joints.len()).sum::<usize>(), least_total(&m));
    }
}

/// Two double edges that meet in one link are two contours, and no walk of one.
#[test]
fn a_walk_comes_through_a_link_once() {
    let m = read(&text(3, &[(0, 1), (1, 0), (0, 2), (2, 0)]));
    let joints: Vec<JointId> = m.joint_ids().collect();
    assert!(closed_walk(&m, &joints).is_none());
    assert!(closed_walk(&m, &joints[..2]).is_some() && closed_walk(&m, &joints[2..]).is_some());
}

/// A contour that the file names is in the basis, though shorter ones would do.
#[test]
fn contours_that_are_named_are_taken_first() {
    let edges = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)];
    let named = text(4, &edges) + "[[contour]]\njoints = [\"j0\", \"j1\", \"j2\", \"j3\"]\n";
    for (text, longest) in [(text(4, &edges), 3), (named, 4)] {
        let m = read(&text);
        let basis = contour_basis(&m, StateId::FREE);
        assert_eq!(basis.len(), 2);
        assert_eq!(basis.iter().map(|c| c.joints.len()).max(), Some(longest));
    }
}
