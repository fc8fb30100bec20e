//! Rows of a matrix in reduced row echelon form, grown one vector at a time in memory that a thread keeps, and packed.

use crate::linalg::modp::{Field, Residue};
use std::ops::Range;

/// Rows of a matrix in reduced row echelon form: each pivot is one and alone in its column.
#[derive(Default)]
pub(in crate::search) struct Rows {
    pub(super) width: usize,
    pub(super) pivots: Vec<usize>,
    pub(super) data: Vec<Residue>,
}

impl Clone for Rows {
    fn clone(&self) -> Self {
        let mut out = Rows::default();
        out.clone_from(self);
        out
    }

    /// Within the memory that is there already, which the derived one would give away.
    fn clone_from(&mut self, other: &Self) {
        self.width = other.width;
        self.pivots.clone_from(&other.pivots);
        self.data.clone_from(&other.data);
    }
}

impl Rows {
    pub(in crate::search) fn clear(&mut self, width: usize) {
        self.width = width;
        self.pivots.clear();
        self.data.clear();
    }

    /// What tells rows of a width apart: the pivots, as bits, and of each row the numbers that stand in no pivot's column.
    pub(super) fn packed(&self, out: &mut Vec<Residue>) {
        out.clear();
        out.resize(self.width.div_ceil(64), 0);
        self.pivots
            .iter()
            .for_each(|p| out[p / 64] |= 1 << (p % 64));
        for (row, &pivot) in self.data.chunks_exact(self.width.max(1)).zip(&self.pivots) {
            let mut others = self.pivots.iter().copied().peekable();
            for (i, &x) in row.iter().enumerate().skip(pivot) {
                while others.next_if(|&p| p < i).is_some() {}
                if others.peek() != Some(&i) {
                    out.push(x);
                }
            }
        }
    }

    /// The rows that were packed; none where nothing was.
    pub(in crate::search) fn unpack(&mut self, f: Field, width: usize, packed: &[Residue]) {
        let places: Vec<usize> = (0..width).collect();
        self.spread(f, width, &places, packed);
    }

    /// The rows that were packed, each coordinate at its place of those of a width, ascending, and nothing at the others; none where nothing was.
    pub(super) fn spread(&mut self, f: Field, width: usize, places: &[usize], packed: &[Residue]) {
        self.clear(width);
        let (bits, mut numbers) = packed.split_at(places.len().div_ceil(64).min(packed.len()));
        let is_pivot = |i: usize| bits.get(i / 64).is_some_and(|b| b >> (i % 64) & 1 == 1);
        let of = |pivots: bool| (0..places.len()).filter(move |&i| is_pivot(i) == pivots);
        self.pivots.extend(of(true).map(|i| places[i]));
        let others: Vec<usize> = of(false).map(|i| places[i]).collect();
        self.data.resize(self.pivots.len() * width, 0);
        for (row, &pivot) in self.data.chunks_exact_mut(width.max(1)).zip(&self.pivots) {
            row[pivot] = f.one();
            let others = &others[others.partition_point(|&p| p < pivot)..];
            let (own, rest) = numbers.split_at(others.len().min(numbers.len()));
            others.iter().zip(own).for_each(|(&at, &x)| row[at] = x);
            numbers = rest;
        }
    }

    /// Dimension of the span.
    pub(in crate::search) fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Dimension of what the span is in the first coordinates.
    pub(in crate::search) fn rank_before(&self, coordinates: usize) -> usize {
        self.pivots.partition_point(|&p| p < coordinates)
    }

    /// The rows, one after another.
    pub(in crate::search) fn rows(&self) -> impl Iterator<Item = &[Residue]> {
        self.data.chunks_exact(self.width.max(1))
    }

    /// Drops the first coordinates, and the rows that reach them.
    pub(in crate::search) fn drop_first(&mut self, coordinates: usize) {
        let dropped = self.rank_before(coordinates);
        let (width, narrow) = (self.width, self.width - coordinates);
        for r in dropped..self.pivots.len() {
            let row = r * width + coordinates..(r + 1) * width;
            self.data.copy_within(row, (r - dropped) * narrow);
        }
        self.data.truncate((self.pivots.len() - dropped) * narrow);
        self.pivots.drain(..dropped);
        self.pivots.iter_mut().for_each(|p| *p -= coordinates);
        self.width = narrow;
    }

    /// The rows with each coordinate at its place of those of a width, ascending, and nothing at the others.
    pub(super) fn widened(&self, width: usize, places: &[usize]) -> Rows {
        let mut data = vec![0; self.rank() * width];
        for (row, own) in data.chunks_exact_mut(width.max(1)).zip(self.rows()) {
            places.iter().zip(own).for_each(|(&at, &x)| row[at] = x);
        }
        Rows {
            width,
            pivots: self.pivots.iter().map(|&p| places[p]).collect(),
            data,
        }
    }

    /// Drops coordinates in which every row has nothing.
    pub(super) fn drop_empty(&mut self, coordinates: &Range<usize>) {
        let (width, dropped) = (self.width, coordinates.len());
        if dropped == 0 {
            return;
        }
        let (rows, mut end) = (self.pivots.len(), 0);
        for row in (0..rows).map(|r| r * width) {
            let empty = &self.data[row..][coordinates.clone()];
            debug_assert!(empty.iter().all(|&x| x == 0), "nothing is lost");
            let kept = [
                row..row + coordinates.start,
                row + coordinates.end..row + width,
            ];
            for part in kept {
                let len = part.len();
                self.data.copy_within(part, end);
                end += len;
            }
        }
        self.data.truncate(end);
        let after = self.pivots.iter_mut().filter(|p| **p >= coordinates.end);
        after.for_each(|p| *p -= dropped);
        self.width -= dropped;
    }

    /// What two spans have in common.
    ///
    /// # Sources
    /// Zassenhaus' algorithm: each vector of the one beside itself, each of the other beside nothing; rows that start with nothing
    /// have a common vector behind it.
    pub(super) fn meet(&self, arithmetic: &mut Arithmetic, other: &Rows) -> Rows {
        if self.pivots == other.pivots && self.data == other.data {
            return self.clone();
        }
        let mut both = Rows::default();
        both.clear(2 * self.width);
        let mut row = Vec::new();
        for (rows, beside) in [(self, true), (other, false)] {
            for v in rows.rows() {
                row.clear();
                row.extend_from_slice(v);
                row.resize(2 * self.width, 0);
                if beside {
                    row.copy_within(..self.width, self.width);
                }
                both.insert(arithmetic, &mut row);
            }
        }
        both.drop_first(self.width);
        both
    }

    /// Adds a vector, keeping the form; `vector` is used up.
    pub(in crate::search) fn insert(
        &mut self,
        arithmetic: &mut Arithmetic,
        vector: &mut [Residue],
    ) {
        let (f, width) = (arithmetic.field, self.width);
        for (row, &p) in self.data.chunks_exact(width.max(1)).zip(&self.pivots) {
            f.subtract_multiple(&mut vector[p..], &row[p..]);
        }
        let Some(pivot) = vector.iter().position(|&x| x != 0) else {
            return;
        };
        if vector[pivot] != f.one() {
            let scale = arithmetic.inverse(vector[pivot]);
            vector[pivot..]
                .iter_mut()
                .filter(|x| **x != 0)
                .for_each(|x| *x = f.mul(*x, scale));
        }
        for row in self.data.chunks_exact_mut(width) {
            f.subtract_multiple(&mut row[pivot..], &vector[pivot..]);
        }
        let at = self.pivots.partition_point(|&p| p < pivot);
        self.pivots.insert(at, pivot);
        let (start, end) = (at * width, self.data.len());
        self.data.resize(end + width, 0);
        self.data.copy_within(start..end, start + width);
        self.data[start..start + width].copy_from_slice(vector);
    }
}

/// The field with a memory of inverses: one takes as long as a hundred products, and the same few come again and again.
pub(in crate::search) struct Arithmetic {
    pub(super) field: Field,
    inverses: Vec<(Residue, Residue)>,
}

impl Arithmetic {
    pub(in crate::search) fn new(field: Field) -> Self {
        Arithmetic {
            field,
            inverses: vec![(0, 0); 1024],
        }
    }

    fn inverse(&mut self, a: Residue) -> Residue {
        let slot = (a.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 54) as usize;
        if self.inverses[slot].0 != a {
            self.inverses[slot] = (a, self.field.inv(a));
        }
        self.inverses[slot].1
    }
}
