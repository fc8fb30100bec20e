//! All Assur groups of 2, 4 and 6 links, found among all ways to join that many links.

use crate::common::*;
use ozols::statics::planar::{Body, Pair, PairKind};

/// Links 1 to n with these inner pairs, and so many pairs of each link to the frame.
fn group(n: usize, inner: &[(usize, usize)], outer: &[usize]) -> PlanarMechanism {
    let body = |i: usize| Body {
        link: Some(LinkId::new(i)),
        name: i.to_string(),
    };
    let pair = |(i, (a, b)): (usize, (usize, usize))| Pair {
        joint: JointId::new(i),
        name: format!("{a}-{b}.{i}"),
        bodies: [a, b],
        kind: PairKind::Turning,
        point: [0.0; 2],
        along: [0.0; 2],
        drive: false,
    };
    let to_frame = outer
        .iter()
        .enumerate()
        .flat_map(|(v, &k)| vec![(0, v + 1); k]);
    let inner = inner.iter().map(|&(a, b)| (a + 1, b + 1));
    PlanarMechanism {
        bodies: (0..=n).map(body).collect(),
        pairs: inner.chain(to_frame).enumerate().map(pair).collect(),
        frame: 0,
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        metres: 1.0,
        unit: "m",
    }
}

/// Whether some links but not all are rigid among themselves: such a chain counts as one link.
fn has_rigid_part(n: usize, inner: &[(usize, usize)]) -> bool {
    (0u32..1 << n).filter(|s| s.count_ones() >= 2).any(|s| {
        let inside = inner
            .iter()
            .filter(|(a, b)| s >> a & 1 == 1 && s >> b & 1 == 1)
            .count();
        3 * (s.count_ones() as usize - 1) <= 2 * inside
    })
}

/// The least among all renumberings.
fn canonical(
    n: usize,
    inner: &[(usize, usize)],
    outer: &[usize],
) -> (Vec<usize>, Vec<(usize, usize)>) {
    let renumbered = (0..n).permutations(n).map(|to| {
        let mut degrees = vec![0; n];
        (0..n).for_each(|v| degrees[to[v]] = outer[v]);
        let edge = |&(a, b): &(usize, usize)| (to[a].min(to[b]), to[a].max(to[b]));
        (degrees, inner.iter().map(edge).sorted().collect_vec())
    });
    renumbered.min().unwrap()
}

/// Groups of n links by class and order.
fn all(n: usize) -> BTreeMap<(usize, usize), usize> {
    let places = (0..n).tuple_combinations::<(usize, usize)>().collect_vec();
    let mut seen = BTreeSet::new();
    let mut out = BTreeMap::new();
    let pairs = 3 * n / 2;
    for edges in n - 1..pairs - 1 {
        for inner in places.iter().copied().combinations(edges) {
            if has_rigid_part(n, &inner) {
                continue;
            }
            let degree = |v: usize| inner.iter().filter(|(a, b)| *a == v || *b == v).count();
            let inside = (0..n).map(degree).collect_vec();
            // At most one pair of a link to the frame, else it is at rest.
            for hung in (0..n).combinations(pairs - edges) {
                let outer = (0..n).map(|v| usize::from(hung.contains(&v))).collect_vec();
                if (0..n).any(|v| inside[v] + outer[v] < 2) {
                    continue;
                }
                // Numbered by descending degree most copies look alike before the search for the least.
                let key = |v: usize| (inside[v], outer[v]);
                if !(1..n).all(|v| key(v - 1) >= key(v)) {
                    continue;
                }
                let Ok(d) = decompose_groups(&group(n, &inner, &outer), &[]) else {
                    continue;
                };
                if d.groups.len() == 1 && seen.insert(canonical(n, &inner, &outer)) {
                    let class = &d.groups[0].class;
                    *out.entry((class.class, class.order)).or_insert(0) += 1;
                }
            }
        }
    }
    out
}

/// There are 1, 2 and 10 (E. E. Peisakh, classification of planar Assur groups, 2007; P. Huang, H. Ding, Mechanism and Machine
/// Theory 145, 2020). Of four links there are class III, order 3, and class IV, order 2.
#[test]
fn there_are_one_two_and_ten_groups_of_two_four_and_six_links() {
    assert_eq!(all(2), BTreeMap::from([((2, 2), 1)]));
    assert_eq!(all(4), BTreeMap::from([((3, 3), 1), ((4, 2), 1)]));
    let six = all(6);
    assert_eq!(six.values().sum::<usize>(), 10, "{six:?}");
    // How they fall into classes and orders is our own count, kept against change.
    let known = [
        ((3, 4), 1),
        ((4, 2), 2),
        ((4, 3), 3),
        ((5, 2), 2),
        ((5, 3), 1),
        ((6, 3), 1),
    ];
    assert_eq!(six, BTreeMap::from(known));
}
