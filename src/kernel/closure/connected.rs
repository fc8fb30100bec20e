//! What groups tie together, directly or through others: joints by the contours and couplings that they share.

use petgraph::unionfind::UnionFind;
use std::collections::BTreeMap;

/// The sets that groups of things tie them into; each ascending, in the order of their first members.
///
/// # Complexity
/// O(n log n) for groups of n things in all.
pub(crate) fn tied<T: Ord + Copy>(groups: impl IntoIterator<Item = Vec<T>>) -> Vec<Vec<T>> {
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
    use super::tied;

    #[test]
    fn groups_are_tied_through_others() {
        let groups = [vec![5, 2], vec![9], vec![], vec![3, 4, 5], vec![7, 9]];
        assert_eq!(tied(groups), [vec![2, 3, 4, 5], vec![7, 9]]);
    }
}
