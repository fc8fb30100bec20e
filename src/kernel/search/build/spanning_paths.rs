//! Which paths of a tree span, with the vectors of one node, the whole space that both halves reach.
//!
//! What is not spanned yet is told by linear forms that are nothing on all that is. A vector is new where one of these is
//! not nothing on it: at the last edge of a path, where most of the time goes, that is one sum of products. Only where another edge
//! follows are the forms made anew, each less a multiple of the one that was not nothing. One more form has the motion of kept links,
//! too, and is needed where a vector is not new: no combination may move these alone.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::build::completing_sets::{Set, none, put};
use crate::search::build::path_tree::PathTree;

/// Independent linear forms that are nothing on some vectors: one for each coordinate that is no pivot of theirs, which has a one there
/// and further numbers at the pivots.
pub(super) struct Annihilator {
    field: Field,
    pub(super) pivots: Vec<usize>,
    /// The other coordinates.
    pub(super) open: Vec<usize>,
    /// The numbers of each form at the pivots.
    at_pivots: Vec<Residue>,
}

impl Annihilator {
    /// # Complexity
    /// O(n·w²) field operations for n vectors of w numbers.
    pub(super) fn new(
        field: Field,
        vectors: impl IntoIterator<Item = Vec<Residue>>,
        width: usize,
    ) -> Self {
        let span = Echelon::of(field, vectors);
        let (rows, pivots) = (span.reduced(), span.pivots());
        let open: Vec<usize> = (0..width).filter(|at| !pivots.contains(at)).collect();
        let form = |&at: &usize| rows.iter().map(move |row| field.neg(row[at]));
        Annihilator {
            field,
            at_pivots: open.iter().flat_map(form).collect(),
            pivots,
            open,
        }
    }

    /// What the forms are on some vectors, one vector after another.
    pub(super) fn images<'v>(
        &self,
        vectors: impl ExactSizeIterator<Item = &'v [Residue]>,
    ) -> Vec<Residue> {
        let (f, pivots) = (self.field, self.pivots.len());
        let mut out = Vec::with_capacity(vectors.len() * self.open.len());
        let mut there = vec![0; pivots];
        for vector in vectors {
            for (there, &pivot) in there.iter_mut().zip(&self.pivots) {
                *there = vector[pivot];
            }
            for (form, &at) in self.open.iter().enumerate() {
                let form = &self.at_pivots[form * pivots..][..pivots];
                out.push(f.add(vector[at], f.dot(form, &there)));
            }
        }
        out
    }
}

/// The nodes whose path spans, with what `left` leaves, all coordinates but the last, which has the motion of kept links: no combination
/// may have nothing but that, where links are `kept`.
///
/// # Complexity
/// O(e·s·d) field operations for e edges, d coordinates, and s forms left where edges follow; O(e·d) where none do.
pub(super) fn completing(tree: &PathTree, left: &Annihilator, kept: bool) -> Set {
    let mut out = none(tree.node_count());
    let images = left.images(tree.vectors());
    let mut walk = Forms::new(left.field, &images, left.open.len(), kept);
    let missing = walk.missing();
    let mut at = 0;
    while let Some(&item) = tree.items.get(at) {
        walk.back_to(item.depth);
        at = if walk.rank() + item.longest < missing {
            item.end
        } else if item.longest == 0 {
            put(&mut out, tree.nodes(item)[0]);
            item.end
        } else if !walk.follow(item.vector) {
            item.end
        } else if kept || walk.rank() < missing {
            at + 1
        } else {
            tree.nodes(item).iter().for_each(|&n| put(&mut out, n));
            item.end
        };
    }
    out
}

/// The forms that are left after the edges on a path. Each has a number at a coordinate of its own, and further ones only at those
/// coordinates whose forms have ended, one with each new vector.
struct Forms<'a> {
    field: Field,
    /// What edges add.
    vectors: &'a [Residue],
    /// Forms before any vector, one a coordinate; that of the last has the motion of kept links.
    width: usize,
    kept: bool,
    /// New vectors so far, before any edge and after each.
    ranks: Vec<usize>,
    /// For each rank the coordinates of the forms left, and their numbers: at the own coordinate, and at those ended.
    open: Vec<usize>,
    forms: Vec<Residue>,
    /// The coordinates whose forms have ended.
    ended: Vec<usize>,
    /// The ranks whose forms are made are those below this one.
    made: usize,
    /// For each rank the vector that is new, and which form before it is not nothing there.
    new: Vec<(&'a [Residue], usize)>,
    /// The numbers of a vector at a form's coordinates.
    at: Vec<Residue>,
    values: Vec<Residue>,
}

impl<'a> Forms<'a> {
    fn new(field: Field, vectors: &'a [Residue], width: usize, kept: bool) -> Self {
        let mut forms = vec![0; width * width * width];
        forms[..width * width]
            .iter_mut()
            .step_by(width)
            .for_each(|own| *own = field.one());
        Forms {
            field,
            vectors,
            width,
            kept,
            ranks: vec![0],
            open: (0..width * width).map(|i| i % width).collect(),
            forms,
            ended: vec![0; width],
            made: 1,
            new: vec![(&[], 0); width],
            at: vec![0; width],
            values: vec![0; width],
        }
    }

    /// Forms before any vector, but for that with the motion of kept links.
    fn missing(&self) -> usize {
        self.width - 1
    }

    fn rank(&self) -> usize {
        self.ranks[self.ranks.len() - 1]
    }

    /// Goes back to where so many edges were followed.
    fn back_to(&mut self, edges: usize) {
        self.ranks.truncate(edges + 1);
    }

    /// What a form of a rank is on a vector whose numbers at ended coordinates are there.
    #[inline]
    fn value(&mut self, rank: usize, form: usize, vector: &[Residue]) -> Residue {
        let place = rank * self.width + form;
        self.at[0] = vector[self.open[place]];
        let numbers = &self.forms[place * self.width..][..=rank];
        self.field.dot(numbers, &self.at[..=rank])
    }

    /// Takes a vector's numbers at the coordinates that have ended before a rank.
    fn take(&mut self, rank: usize, vector: &[Residue]) {
        for (at, &ended) in self.at[1..].iter_mut().zip(&self.ended[..rank]) {
            *at = vector[ended];
        }
    }

    /// Follows an edge that adds a vector; whether nothing moves kept links alone.
    fn follow(&mut self, vector: usize) -> bool {
        let rank = self.rank();
        let vector = &self.vectors[vector * self.width..][..self.width];
        // What the node spans by itself is so after any edges.
        if vector[..self.missing()].iter().all(|&x| x == 0) {
            self.ranks.push(rank);
            return !self.kept || vector[self.missing()] == 0;
        }
        if self.made == rank {
            self.make(rank);
        }
        self.take(rank, vector);
        let left = self.missing() - rank;
        if let Some(form) = (0..left).find(|&form| self.value(rank, form, vector) != 0) {
            self.ranks.push(rank + 1);
            self.new[rank + 1] = (vector, form);
            self.made = rank + 1;
            return true;
        }
        self.ranks.push(rank);
        !self.kept || self.value(rank, left, vector) == 0
    }

    /// Makes the forms of a rank from those of the one before.
    fn make(&mut self, rank: usize) {
        let (f, width, before) = (self.field, self.width, rank - 1);
        let (vector, ended) = self.new[rank];
        self.take(before, vector);
        let forms = width - before;
        for form in 0..forms {
            self.values[form] = self.value(before, form, vector);
        }
        self.ended[before] = self.open[before * width + ended];
        let (old, new) = self.forms.split_at_mut(rank * width * width);
        let old = &old[before * width * width..];
        let less = &old[ended * width..][..rank];
        let others = (0..forms).filter(|&form| form != ended);
        for (to, form) in others.enumerate() {
            self.open[rank * width + to] = self.open[before * width + form];
            let [value, of_ended] = [self.values[form], self.values[ended]];
            let (old, new) = (&old[form * width..][..rank], &mut new[to * width..]);
            if value == 0 {
                new[..rank].copy_from_slice(old);
                new[rank] = 0;
                continue;
            }
            // A multiple of the form less one of the ended, so that nothing is left of the vector.
            new[0] = f.mul(of_ended, old[0]);
            for ((x, &own), &less) in new[1..rank].iter_mut().zip(&old[1..]).zip(&less[1..]) {
                *x = f.cross(of_ended, own, value, less);
            }
            new[rank] = f.neg(f.mul(value, less[0]));
        }
        self.made = rank + 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::modp::is_prime;
    use crate::search::build::completing_sets::has;
    use crate::search::build::path_tree::Vectors;

    /// Paths drawn from a few vectors, so that many begin alike and some vectors are not new, against one elimination for each: those
    /// of the tree as it is drawn, and of the bases of its paths.
    #[test]
    fn paths_complete_a_node_where_whole_eliminations_say_so() {
        let f = Field::new((1u64 << 61..).find(|&n| is_prime(n)).unwrap());
        let mut state = 1u64;
        let mut number = |below: u64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) % below
        };
        // Two coordinates that the node does not reach, four that it does, and that of kept links.
        let [beyond, shared] = [2, 4];
        let mut met = [0; 2];
        for _ in 0..60 {
            let kept = number(2) == 1;
            let mut vector = |first: usize| -> Vec<Residue> {
                let width = beyond + shared + 1;
                let number = |i: usize| match i {
                    i if i < first || (i == width - 1 && !kept) => 0,
                    _ => f.from_i64(i64::try_from(number(3)).unwrap() - 1),
                };
                (0..width).map(number).collect()
            };
            let few: Vec<Vec<Residue>> =
                (0..9).map(|i| vector(if i < 3 { 0 } else { 2 })).collect();
            let own = [vector(beyond), vector(beyond)];
            let some = |node: usize| -> Vec<usize> {
                let is_in = |i: &usize| (node * 7 + i * i).is_multiple_of(3) || node == i + 20;
                (0..few.len()).filter(is_in).collect()
            };
            let whole = |node: usize| {
                let mut all = Echelon::new(f);
                own.iter()
                    .chain(some(node).iter().map(|&v| &few[v]))
                    .for_each(|v| {
                        all.insert(v);
                    });
                all.pivots()
            };
            let paths: Vec<_> = (0..40).map(some).collect();
            // What is told of the node is that it moves no kept link alone, as no path does.
            let ends = beyond + shared;
            let alone = |vectors: Vec<&Vec<Residue>>| {
                let mut span = Echelon::new(f);
                vectors.into_iter().for_each(|v| {
                    span.insert(v);
                });
                span.pivots().contains(&ends)
            };
            if alone(own.iter().collect())
                || paths
                    .iter()
                    .any(|p| alone(p.iter().map(|&v| &few[v]).collect()))
            {
                continue;
            }
            let vectors = Vectors {
                field: f,
                beyond,
                all: few.clone(),
            };
            let tree = PathTree::new(&vectors, &paths);
            let rows = own.iter().map(|v| v[beyond..].to_vec());
            let left = Annihilator::new(f, rows, shared + 1);
            for tree in [PathTree::of_bases(f, &tree.bases(f)), tree] {
                let found = completing(&tree, &left, kept);
                for node in 0..paths.len() {
                    let pivots = whole(node);
                    let reached = (beyond..ends).all(|p| pivots.contains(&p));
                    let expected = reached && !pivots.contains(&ends);
                    assert_eq!(has(&found, node), expected, "{node} {pivots:?}");
                    met[usize::from(expected)] += 1;
                }
            }
        }
        assert!(met.iter().all(|&n| n > 100), "{met:?}");
    }
}
