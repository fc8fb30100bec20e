//! Intersection numbers on a product of lines, one for each freedom: sums of products of classes h with h² = 0.

/// Maximum number of freedoms.
pub(super) const MOST: usize = 64;
/// Maximum number of terms of a class.
const TERMS: usize = 100_000;

/// The two arcs of a contour, each a set of freedoms.
#[derive(Debug, Clone)]
pub(super) struct Arcs {
    one: Vec<usize>,
    other: Vec<usize>,
}

impl Arcs {
    pub(super) fn new(one: Vec<usize>, other: Vec<usize>) -> Arcs {
        Arcs { one, other }
    }

    /// Returns the number of freedoms in both arcs.
    pub(super) fn count(&self) -> usize {
        self.one.len() + self.other.len()
    }

    fn set(&self) -> u64 {
        let all = self.one.iter().chain(&self.other);
        all.fold(0, |set, &v| set | 1 << v)
    }
}

/// A class: the multiplicity of each product of different h, by their sets.
#[derive(Debug, Clone)]
pub(super) struct Class(Vec<(u64, usize)>);

impl Class {
    pub(super) fn one() -> Class {
        Class(vec![(0, 1)])
    }

    /// Merges equal products and adds their multiplicities.
    fn collected(mut terms: Vec<(u64, usize)>) -> Class {
        terms.sort_unstable_by_key(|t| t.0);
        terms.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 = kept.1.saturating_add(next.1);
            }
            same
        });
        Class(terms)
    }

    /// Multiplies by a sum of h.
    fn times(&self, sum: &[usize]) -> Class {
        let mut terms = Vec::with_capacity(self.0.len() * sum.len());
        for &(set, often) in &self.0 {
            let others = sum.iter().filter(|&&v| set >> v & 1 == 0);
            terms.extend(others.map(|&v| (set | 1 << v, often)));
        }
        Class::collected(terms)
    }

    /// Multiplies by Σ S^i T^j over i + j = n, with S and T the sums over two arcs. Returns `None` if the result has
    /// too many terms.
    pub(super) fn times_all(self, arcs: &Arcs, n: usize) -> Option<Class> {
        // With P_n that product, P_n = S P_(n - 1) + T^n P_0.
        let mut other = self.clone();
        let mut all = self;
        for _ in 0..n {
            other = other.times(&arcs.other);
            all = Class::collected([all.times(&arcs.one).0, other.0.clone()].concat());
            if all.0.len() > TERMS {
                return None;
            }
        }
        Some(all)
    }

    /// Removes the products that lack more than `cut` freedoms of no later arc.
    pub(super) fn without_lost<'a>(
        mut self,
        later: impl Iterator<Item = &'a Arcs>,
        freedoms: usize,
        cut: usize,
    ) -> Class {
        let open = later.fold(0, |set, arcs| set | arcs.set());
        let gone = everything(freedoms) & !open;
        self.0
            .retain(|(set, _)| (gone & !set).count_ones() as usize <= cut);
        self
    }

    /// Returns the number of points in common with `cut` general classes of all h, or `None` if it is too large.
    pub(super) fn number(&self, freedoms: usize, cut: usize) -> Option<usize> {
        let missing = |set: u64| (everything(freedoms) & !set).count_ones() as usize;
        let terms = self.0.iter().filter(|(set, _)| missing(*set) == cut);
        let sum = terms.fold(0usize, |sum, (_, often)| sum.saturating_add(*often));
        let ways = (1..=cut).fold(sum, usize::saturating_mul);
        (ways < usize::MAX).then_some(ways)
    }
}

fn everything(freedoms: usize) -> u64 {
    u64::MAX >> (64 - freedoms.max(1))
}

#[cfg(test)]
mod tests {
    use super::{Arcs, Class};

    /// Two arcs of n hinges each, closed by as many equations as they have: n! n!.
    #[test]
    fn numbers_by_hand() {
        for (n, expected) in [(1, 1), (2, 4), (3, 36), (4, 576)] {
            let arcs = Arcs::new((0..n).collect(), (n..2 * n).collect());
            let class = Class::one().times_all(&arcs, 2 * n).unwrap();
            assert_eq!(class.number(2 * n, 0), Some(expected));
        }
        // A curve of four hinges cut by the sum of all t: (S² T + S T²)(S + T) = 2 S² T², and S² = T² = 2 of two h each.
        let arcs = Arcs::new(vec![0, 1], vec![2, 3]);
        let class = Class::one().times_all(&arcs, 3).unwrap();
        assert_eq!(class.number(4, 1), Some(8));
        let none = class.without_lost(std::iter::empty(), 4, 0);
        assert_eq!(none.number(4, 1), Some(0));
    }
}
