//! Sets of the nodes of one half that complete those of the other, and what is left of the vectors of the one modulo the other's.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use hashbrown::HashMap;
use rayon::prelude::*;

/// A set of nodes of one half.
pub(in crate::search) type Set = Box<[u64]>;

/// Whether a node is in a set.
pub(in crate::search) fn has(set: &Set, node: usize) -> bool {
    set[node / 64] >> (node % 64) & 1 == 1
}

/// The set of no node of so many.
pub(in crate::search) fn none(nodes: usize) -> Set {
    vec![0; nodes.div_ceil(64)].into_boxed_slice()
}

/// Puts a node into a set.
pub(in crate::search) fn put(set: &mut Set, node: usize) {
    set[node / 64] |= 1 << (node % 64);
}

/// A set of some of so many nodes.
pub(in crate::search) fn set(nodes: usize, mut is_in: impl FnMut(usize) -> bool) -> Set {
    let mut out = none(nodes);
    (0..nodes)
        .filter(|&n| is_in(n))
        .for_each(|n| put(&mut out, n));
    out
}

/// Nodes looked at before it is asked whether all is cancelled, and told how many are done.
const BATCH: usize = 512;

/// For each of so many nodes, which nodes of the other half complete it; none where it is cancelled.
pub(in crate::search) fn completed(
    nodes: usize,
    completing: impl Fn(usize) -> Set + Sync,
    cancelled: &(dyn Fn() -> bool + Sync),
    told: &mut dyn FnMut(usize),
) -> Option<Vec<Set>> {
    let mut sets = Vec::with_capacity(nodes);
    for start in (0..nodes).step_by(BATCH) {
        if cancelled() {
            return None;
        }
        told(start);
        let batch = start..(start + BATCH).min(nodes);
        sets.par_extend(batch.into_par_iter().map(&completing));
    }
    Some(sets)
}

/// Bases of the spaces of a half's nodes: many have vectors in common.
#[derive(Default)]
pub(in crate::search) struct Bases {
    /// The different vectors of all bases.
    rows: Vec<Vec<Residue>>,
    /// The basis of each node.
    pub(in crate::search) of_node: Vec<Vec<usize>>,
    /// The nodes, those whose bases begin alike side by side, each with how many vectors its basis has in common with the one before.
    sorted: Vec<(usize, usize)>,
}

impl Bases {
    /// Of the spaces that some vectors span, node by node.
    pub(in crate::search) fn new(
        field: Field,
        spaces: impl Iterator<Item = Vec<Vec<Residue>>>,
    ) -> Bases {
        let mut known: HashMap<Vec<Residue>, usize> = HashMap::new();
        let mut out = Bases::default();
        for vectors in spaces {
            let number = |row: Vec<Residue>| {
                *known.entry(row).or_insert_with_key(|row| {
                    out.rows.push(row.clone());
                    out.rows.len() - 1
                })
            };
            // The last ones have few numbers that are not nothing, so that more bases have them in common.
            let basis = span(field, &vectors).reduced();
            let basis = basis.into_iter().rev().map(number).collect();
            out.of_node.push(basis);
        }
        let mut order: Vec<usize> = (0..out.of_node.len()).collect();
        order.sort_by(|&a, &b| out.of_node[a].cmp(&out.of_node[b]));
        let mut before: &[usize] = &[];
        let sorted = order.into_iter().map(|node| {
            let basis = &out.of_node[node];
            let alike = basis.iter().zip(before).take_while(|(a, b)| a == b).count();
            before = basis;
            (node, alike)
        });
        out.sorted = sorted.collect();
        out
    }

    /// The rank of each node's basis among `images` of the vectors: none where a combination of it has nothing in the first `free`
    /// coordinates and is not nothing. Where it cannot be `enough`, it may be less than it is.
    ///
    /// # Complexity
    /// O(n·r·w) for n nodes, ranks r and images of w numbers, less where bases begin alike.
    pub(in crate::search) fn ranks(
        &self,
        images: &Images,
        free: usize,
        enough: usize,
        mut found: impl FnMut(usize, Option<usize>),
    ) {
        let mut eliminated = Eliminated::new(images, free);
        for &(node, alike) in &self.sorted {
            let basis = &self.of_node[node];
            eliminated.truncate(alike);
            while let Some(&row) = basis.get(eliminated.steps.len()) {
                let left = basis.len() - eliminated.steps.len();
                if eliminated.rank().is_none_or(|r| r + left < enough) {
                    break;
                }
                eliminated.push(row);
            }
            found(node, eliminated.rank());
        }
    }
}

/// Images of vectors, one after another.
pub(in crate::search) struct Images {
    field: Field,
    width: usize,
    numbers: Vec<Residue>,
}

/// Rows eliminated one after another, without a division.
struct Eliminated<'a> {
    images: &'a Images,
    free: usize,
    /// What is left of each row.
    rows: Vec<Residue>,
    /// Of each, where it starts, if anything is left, and the rank so far.
    steps: Vec<(Option<usize>, Option<usize>)>,
}

impl<'a> Eliminated<'a> {
    fn new(images: &'a Images, free: usize) -> Self {
        Eliminated {
            images,
            free,
            rows: Vec::new(),
            steps: Vec::new(),
        }
    }

    fn truncate(&mut self, rows: usize) {
        self.steps.truncate(rows);
        self.rows.truncate(self.steps.len() * self.images.width);
    }

    fn rank(&self) -> Option<usize> {
        self.steps.last().map_or(Some(0), |s| s.1)
    }

    fn push(&mut self, row: usize) {
        let (f, width) = (self.images.field, self.images.width);
        let start = self.rows.len();
        let image = row * width..(row + 1) * width;
        self.rows.extend_from_slice(&self.images.numbers[image]);
        let (before, new) = self.rows.split_at_mut(start);
        for (row, (pivot, _)) in before.chunks_exact(width.max(1)).zip(&self.steps) {
            let Some(pivot) = *pivot else { continue };
            let head = new[pivot];
            if head != 0 {
                for (x, &y) in new.iter_mut().zip(row) {
                    *x = f.cross(row[pivot], *x, head, y);
                }
            }
        }
        let pivot = new.iter().position(|&x| x != 0);
        let rank = match pivot {
            None => self.rank(),
            Some(p) if p < self.free => self.rank().map(|r| r + 1),
            Some(_) => None,
        };
        self.steps.push((pivot, rank));
    }
}

pub(in crate::search) fn span(field: Field, vectors: &[Vec<Residue>]) -> Echelon {
    let mut out = Echelon::new(field);
    vectors.iter().for_each(|v| {
        out.insert(v);
    });
    out
}

/// Vectors up to those of a space.
pub(in crate::search) struct Quotient {
    field: Field,
    /// A reduced basis of the space.
    pub(in crate::search) rows: Vec<Vec<Residue>>,
    pivots: Vec<usize>,
    /// The coordinates that are left.
    open: Vec<usize>,
}

impl Quotient {
    pub(in crate::search) fn new(
        field: Field,
        vectors: Vec<Vec<Residue>>,
        width: usize,
    ) -> Quotient {
        let span = span(field, &vectors);
        let (rows, pivots) = (span.reduced(), span.pivots());
        let open = (0..width).filter(|i| !pivots.contains(i)).collect();
        Quotient {
            field,
            rows,
            pivots,
            open,
        }
    }

    /// What is left of the vectors of some bases.
    pub(in crate::search) fn images(&self, of: &Bases) -> Images {
        let f = self.field;
        // What a vector loses in each coordinate that is left, for what it has at each pivot.
        let column = |&at: &usize| self.rows.iter().map(move |row| f.neg(row[at]));
        let lost: Vec<Residue> = self.open.iter().flat_map(column).collect();
        let each = self.rows.len();
        let mut numbers = Vec::with_capacity(of.rows.len() * self.open.len());
        let mut heads = Vec::with_capacity(each);
        for v in &of.rows {
            heads.clear();
            heads.extend(self.pivots.iter().map(|&p| v[p]));
            for (i, &at) in self.open.iter().enumerate() {
                let own = std::iter::once((v[at], f.one()));
                let others = heads.iter().zip(&lost[i * each..(i + 1) * each]);
                let products = others.map(|(&x, &y)| (x, y));
                numbers.push(f.sum_of_products(own.chain(products)));
            }
        }
        Images {
            field: f,
            width: self.open.len(),
            numbers,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::modp::is_prime;

    /// Bases drawn from a few vectors, so that many begin alike, against one elimination for each.
    #[test]
    fn ranks_are_those_of_whole_eliminations() {
        let f = Field::new((1u64 << 61..).find(|&n| is_prime(n)).unwrap());
        let mut state = 1u64;
        let mut number = |below: u64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) % below
        };
        let (width, free) = (6, 4);
        let mut vector = || -> Vec<Residue> {
            let number = |_| f.from_i64(i64::try_from(number(3)).unwrap() - 1);
            (0..width).map(number).collect()
        };
        let few: Vec<Vec<Residue>> = (0..9).map(|_| vector()).collect();
        let own = [vector(), vector()];
        let some = |node: usize| {
            let is_in = |i: &usize| (node * 7 + i * i).is_multiple_of(3);
            (0..few.len())
                .filter(is_in)
                .map(|i| few[i].clone())
                .collect::<Vec<_>>()
        };
        let bases = Bases::new(f, (0..40).map(some));
        let whole = Quotient::new(f, own.to_vec(), width);
        assert_eq!(whole.rows.len(), 2);
        let (mut met, mut found) = ([0; 2], 0);
        // The coordinates that are left of the first four, before the others.
        let free = free - whole.pivots.iter().filter(|&&p| p < free).count();
        bases.ranks(&whole.images(&bases), free, 0, |node, rank| {
            let mut all = span(f, &own);
            some(node).iter().for_each(|v| {
                all.insert(v);
            });
            // In nothing but the last coordinates is what has its pivot there.
            let mut new = all.pivots();
            new.retain(|p| !whole.pivots.contains(p));
            let expected = new.iter().all(|&p| p < 4).then_some(new.len());
            assert_eq!(rank, expected, "{node}");
            met[usize::from(rank.is_some())] += 1;
            found += 1;
        });
        assert_eq!(found, 40);
        assert!(met.iter().all(|&n| n > 3), "{met:?}");
    }
}
