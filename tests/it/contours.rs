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
fn least_total(links: usize, edges: &[(usize, usize)]) -> usize {
    let mut cycles: Vec<u32> = (1u32..1 << edges.len())
        .filter(|set| {
            let chosen: Vec<_> = (0..edges.len())
                .filter(|i| set >> i & 1 == 1)
                .map(|i| edges[i])
                .collect();
            let degree = |l: usize| chosen.iter().filter(|(a, b)| *a == l || *b == l).count();
            let used: Vec<usize> = (0..links).filter(|&l| degree(l) > 0).collect();
            let mut reached = vec![used[0]];
            for _ in 0..links {
                for (a, b) in &chosen {
                    if reached.contains(a) != reached.contains(b) {
                        reached.push(if reached.contains(a) { *b } else { *a });
                    }
                }
            }
            used.iter().all(|&l| degree(l) == 2) && used.iter().all(|l| reached.contains(l))
        })
        .collect();
    cycles.sort_by_key(|c| c.count_ones());
    let (mut basis, mut total): (Vec<u32>, u32) = (Vec::new(), 0);
    for cycle in cycles {
        let reduced = basis.iter().fold(cycle, |c, b| c.min(c ^ b));
        if reduced != 0 {
            basis.push(reduced);
            basis.sort_unstable_by(|a, b| b.cmp(a));
            total += cycle.count_ones();
        }
    }
    total as usize
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
        prop_assert_eq!(basis.iter().map(|c| c.joints.len()).sum::<usize>(), least_total(links, &edges));
    }
}

/// What `ozols list` tells of a state is what an analysis finds.
#[test]
fn figures_told_at_once_are_those_of_the_analysis() {
    for name in ozols::builtin::names() {
        let m = built_in(name);
        if m.joints.len() > 30 {
            continue;
        }
        let found = state_figures(&m, StateId::FREE).unwrap();
        let whole = analyse_states(&m, &[StateId::FREE], Method::Modular).unwrap();
        let whole = &whole[0];
        assert_eq!(
            [found.links, found.joints, found.contours, found.freedoms],
            [whole.links, whole.joints, whole.contours, whole.freedoms],
            "{name}"
        );
        assert_eq!(
            (found.mobility, found.redundant),
            (whole.mobility, whole.redundant),
            "{name}"
        );
    }
    // A four-bar of hinges: one contour, four freedoms of rank three.
    let bar = state_figures(&built_in("four-bar"), StateId::FREE).unwrap();
    assert_eq!((bar.contours, bar.freedoms), (1, 4));
    assert_eq!((bar.mobility, bar.redundant), (1, 3));
    // Malyshev's formula: six for each of three moving links, less five at each of four hinges.
    let bar = built_in("four-bar");
    let found = analyse_states(&bar, &[StateId::FREE], Method::Modular).unwrap();
    assert_eq!(found[0].formula_mobility, 6 * 3 - 5 * 4);
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
