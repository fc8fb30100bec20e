//! The contour basis is a minimum cycle basis: against a greedy choice among all cycles of small graphs.

use ozols::closure::contour::contour_basis;
use ozols::import::text::mechanism_from_str;
use proptest::prelude::*;

/// A mechanism whose graph has these edges; joints are all alike, only the graph matters.
fn text(links: usize, edges: &[(usize, usize)]) -> String {
    let mut out = String::from("name = \"graph\"\n");
    for l in 0..links {
        let role = match l {
            0 => "role = \"frame\"\n",
            1 => "role = \"output\"\n",
            _ => "",
        };
        out += &format!("[[link]]\nid = \"{l}\"\n{role}");
    }
    for (i, (a, b)) in edges.iter().enumerate() {
        out += &format!(
            "[[joint]]\nid = \"j{i}\"\nlinks = [\"{a}\", \"{b}\"]\ntype = \"spherical\"\npoint = [{i}, 0, 0]\n"
        );
    }
    out
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
        let m = mechanism_from_str("graph.toml", &text(links, &edges)).unwrap();
        let basis = contour_basis(&m, 0);
        prop_assert_eq!(basis.len(), edges.len() + 1 - links);
        prop_assert_eq!(basis.iter().map(|c| c.joints.len()).sum::<usize>(), least_total(links, &edges));
    }
}
