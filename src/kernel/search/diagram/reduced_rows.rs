//! Rows of a matrix in reduced row echelon form, grown one vector at a time in memory that a thread keeps, and packed.

use crate::linalg::modp::{Field, Residue};

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

    /// Copies into the existing memory, which the derived implementation would release.
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

    /// Appends the rows that are zero in the first coordinates, without these: the pivots as bits, and of each row the numbers outside of
    /// pivots' columns. Different spans append different words.
    pub(super) fn pack_beyond(&self, first: usize, out: &mut Vec<Residue>) {
        let dropped = self.rank_before(first);
        let pivots = &self.pivots[dropped..];
        let start = out.len();
        out.resize(start + (self.width - first).div_ceil(64), 0);
        out.reserve(pivots.len() * (self.width - first - pivots.len()));
        for p in pivots.iter().map(|p| p - first) {
            out[start + p / 64] |= 1 << (p % 64);
        }
        for (r, pivot) in pivots.iter().enumerate() {
            let row = &self.data[(dropped + r) * self.width..][..self.width];
            let mut from = pivot + 1;
            for &to in pivots[r + 1..].iter().chain([&self.width]) {
                // Most pivots follow one another.
                if from < to {
                    out.extend_from_slice(&row[from..to]);
                }
                from = to + 1;
            }
        }
    }

    /// Returns the rows packed alone.
    pub(in crate::search) fn to_packed(&self) -> Vec<Residue> {
        let mut out = Vec::new();
        self.pack_beyond(0, &mut out);
        out
    }

    /// Takes the rows of a width that were packed.
    pub(in crate::search) fn unpack_rows(
        &mut self,
        arithmetic: &mut Arithmetic,
        width: usize,
        packed: &[Residue],
    ) {
        let places: Vec<usize> = (0..width).collect();
        self.unpack_spread(arithmetic, width, &places, packed);
    }

    /// Reads packed rows, and puts each coordinate at its place among `width` ones. There are no rows if nothing was packed, as before the
    /// first variable of a part.
    pub(in crate::search) fn unpack_spread(
        &mut self,
        arithmetic: &mut Arithmetic,
        width: usize,
        places: &[usize],
        packed: &[Residue],
    ) {
        self.clear(width);
        if packed.is_empty() {
            return;
        }
        let (bits, mut numbers) = packed.split_at(places.len().div_ceil(64));
        let is_pivot = |i: usize| bits[i / 64] >> (i % 64) & 1 == 1;
        let (mut pivots, mut others) = (Vec::with_capacity(width), Vec::with_capacity(width));
        for i in 0..places.len() {
            let of = if is_pivot(i) {
                &mut pivots
            } else {
                &mut others
            };
            of.push(i);
        }
        self.data.resize(pivots.len() * width, 0);
        let rows = self.data.chunks_exact_mut(width.max(1)).zip(&pivots);
        for (before, (row, &pivot)) in rows.enumerate() {
            row[places[pivot]] = arithmetic.field.one();
            let others = &others[pivot - before..];
            let (own, rest) = numbers.split_at(others.len());
            others
                .iter()
                .zip(own)
                .for_each(|(&i, &x)| row[places[i]] = x);
            numbers = rest;
        }
        if places.is_sorted() {
            self.pivots.extend(pivots.iter().map(|&i| places[i]));
            return;
        }
        // The form of the rows depends on the order of the coordinates.
        let mut rows = std::mem::take(&mut self.data);
        for row in rows.chunks_exact_mut(width) {
            self.insert(arithmetic, row);
        }
    }

    /// Returns the dimension of the span.
    pub(in crate::search) fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Returns the dimension of the span's projection on the first coordinates.
    pub(in crate::search) fn rank_before(&self, coordinates: usize) -> usize {
        self.pivots.partition_point(|&p| p < coordinates)
    }

    /// Returns true if some vector of the span is zero in the first coordinates.
    pub(in crate::search) fn starts_behind(&self, coordinates: usize) -> bool {
        self.pivots.last().is_some_and(|&p| p >= coordinates)
    }

    /// Returns the rows, one after another.
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

    /// Returns the rows in a larger width. Each coordinate moves to its place in `places`, ascending, and the others are
    /// zero.
    pub(super) fn widen_to(&self, width: usize, places: &[usize]) -> Rows {
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

    /// Returns the intersection of two spans.
    ///
    /// # Sources
    /// Zassenhaus' algorithm: rows (a, a) of the first space and (b, 0) of the second one are reduced. Rows that start with zeros contain a
    /// basis of the intersection.
    pub(super) fn intersect_with(&self, arithmetic: &mut Arithmetic, other: &Rows) -> Rows {
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
        if let Some(pivot) = self.reduce_vector(arithmetic.field, vector) {
            self.insert_reduced(arithmetic, vector, pivot, 0);
        }
    }

    /// Subtracts from a vector its part along the pivots. Returns its first coordinate that is left; `None` if it was in the span.
    pub(super) fn reduce_vector(&self, f: Field, vector: &mut [Residue]) -> Option<usize> {
        for (r, &p) in self.pivots.iter().enumerate() {
            if vector[p] != 0 {
                let row = &self.data[r * self.width..][..self.width];
                f.subtract_multiple(&mut vector[p..], &row[p..]);
            }
        }
        vector.iter().position(|&x| x != 0)
    }

    /// Adds a reduced vector that starts at `pivot`. Rows that start before column `from` are not changed: they are in echelon form, and
    /// the others in reduced form, which is enough if the first `from` columns are dropped next.
    pub(super) fn insert_reduced(
        &mut self,
        arithmetic: &mut Arithmetic,
        vector: &mut [Residue],
        pivot: usize,
        from: usize,
    ) {
        let (f, width) = (arithmetic.field, self.width);
        if vector[pivot] != f.one() {
            let scale = arithmetic.cached_inverse(vector[pivot]);
            let others = vector[pivot..].iter_mut().filter(|x| **x != 0);
            others.for_each(|x| *x = f.mul(*x, scale));
        }
        let at = self.rank_before(pivot);
        // Rows behind start after the pivot.
        for r in self.rank_before(from)..at {
            if self.data[r * width + pivot] != 0 {
                let row = &mut self.data[r * width..][..width];
                f.subtract_multiple(&mut row[pivot..], &vector[pivot..]);
            }
        }
        self.pivots.insert(at, pivot);
        let (start, end) = (at * width, self.data.len());
        self.data.resize(end + width, 0);
        self.data.copy_within(start..end, start + width);
        self.data[start..start + width].copy_from_slice(vector);
    }
}

/// The field with a cache of inverses: an inverse takes as long as a hundred products, and few different ones occur.
pub(in crate::search) struct Arithmetic {
    pub(super) field: Field,
    inverses: Vec<(Residue, Residue)>,
}

impl Arithmetic {
    pub(in crate::search) fn new(field: Field) -> Self {
        Arithmetic {
            field,
            inverses: Vec::new(),
        }
    }

    fn cached_inverse(&mut self, a: Residue) -> Residue {
        // Many are made only to read rows, and need no inverse.
        if self.inverses.is_empty() {
            self.inverses.resize(1024, (0, 0));
        }
        let slot = (a.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 54) as usize;
        if self.inverses[slot].0 != a {
            self.inverses[slot] = (a, self.field.inv(a));
        }
        self.inverses[slot].1
    }
}
