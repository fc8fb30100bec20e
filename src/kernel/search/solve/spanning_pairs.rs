//! Which nodes of the back half complete one of the front, pair by pair.
//!
//! Together both must span all coordinates of contours that they reach. Linear forms describe what the front does not span:
//! they are zero on all that it spans. The rows of a node of the back are taken one after another. A row is new if one of
//! the forms is not zero on it. The others are then changed so that they are zero there. Nodes whose bases have the same
//! beginning are examined together, so most pairs take one sum of products. One more form includes the motion of kept links.
//! It must be zero on each row that is not new, because no combination may move only kept links.

use crate::linalg::modp::{Field, Residue};
use crate::search::diagram::node_sets::{Set, add_node, empty_set};
use hashbrown::HashMap;
use std::ops::Range;

/// A row that bases with the same rows before it have in common, in a list where it is followed by all rows that come after it in one of
/// these bases.
#[derive(Clone, Copy)]
struct Item {
    /// The number of the row among all different ones.
    vector: usize,
    /// The index of the item after all those that follow this row.
    end: usize,
    /// The number of bases that are complete before this item.
    first: usize,
}

/// The bases of the nodes of the back, sorted so that equal beginnings are one.
pub(super) struct Bases {
    field: Field,
    /// The different rows, one after another, each of `width` numbers.
    vectors: Vec<Residue>,
    width: usize,
    items: Vec<Item>,
    /// For each number of rows of a basis, where its items end.
    lengths: Vec<(usize, usize)>,
    /// The nodes in the order of their bases.
    nodes: Vec<usize>,
    /// Whether the last number of a vector is a motion of kept links.
    keeps: bool,
    /// Whether each node spans all coordinates of contours together with each node of the front.
    spanned: bool,
}

impl Bases {
    /// Takes a reduced basis of each node, with a number of kept links behind the coordinates of contours.
    pub(super) fn new<'b>(
        field: Field,
        bases: impl IntoIterator<Item = &'b [Vec<Residue>]>,
        keeps: bool,
        spanned: bool,
    ) -> Bases {
        let mut known: HashMap<&[Residue], usize> = HashMap::new();
        let mut vectors = Vec::new();
        let mut number = |row| {
            let next = known.len();
            *known.entry(row).or_insert_with_key(|row: &&[Residue]| {
                vectors.extend_from_slice(row);
                next
            })
        };
        // The last rows have few numbers that are not zero, so that more bases have them in common.
        let (mut numbers, mut counts, mut width) = (Vec::new(), Vec::new(), 0);
        for rows in bases {
            width = rows.first().map_or(width, Vec::len);
            numbers.extend(rows.iter().rev().map(|row| number(&row[..])));
            counts.push(rows.len());
        }
        let mut left = &numbers[..];
        let own = counts.iter().enumerate().map(|(node, &count)| {
            let (own, others) = left.split_at(count);
            left = others;
            (own, node)
        });
        let mut all: Vec<(&[usize], usize)> = own.collect();
        all.sort_unstable_by_key(|&(own, node)| (own.len(), own, node));
        let mut out = Bases {
            field,
            width,
            vectors,
            items: Vec::new(),
            lengths: Vec::new(),
            nodes: all.iter().map(|(_, node)| *node).collect(),
            keeps,
            spanned,
        };
        let mut first = 0;
        for alike in all.chunk_by(|(a, _), (b, _)| a.len() == b.len()) {
            out.push_items(alike, 0, first);
            out.lengths.push((alike[0].0.len(), out.items.len()));
            first += alike.len();
        }
        out
    }

    /// Appends the items of bases with the same rows before row `at`, the first of which is number `first`.
    fn push_items(&mut self, bases: &[(&[usize], usize)], at: usize, mut first: usize) {
        if bases[0].0.len() == at {
            return;
        }
        for alike in bases.chunk_by(|(a, _), (b, _)| a[at] == b[at]) {
            let item = self.items.len();
            self.items.push(Item {
                vector: alike[0].0[at],
                end: 0,
                first,
            });
            self.push_items(alike, at + 1, first);
            self.items[item].end = self.items.len();
            first += alike.len();
        }
    }

    /// Returns the nodes that complete a node of the front, on which these forms are zero. `memory` may come from an earlier walk.
    ///
    /// # Complexity
    /// O(e·w) field operations for e different beginnings of bases and w coordinates. O(e·w²) if most rows are not the last ones.
    pub(super) fn completing_nodes(&self, front: &ZeroForms, memory: &mut WalkMemory) -> Set {
        let (width, open) = (front.width, front.count);
        let forms = &front.numbers;
        // What the forms are on a vector has fewer numbers than the vector, but takes as long as some items.
        let vectors = self.vectors.chunks_exact(self.width.max(1));
        let sparse = vectors.len() * open < 2 * self.items.len();
        let WalkMemory { images, levels } = memory;
        levels.resize_with(levels.len().max(open), Forms::default);
        let levels = &mut levels[..open];
        for (rank, level) in levels.iter_mut().enumerate() {
            level.resize_to(open, rank, if sparse { rank + 1 } else { width }, sparse);
        }
        let (vectors, width) = if sparse {
            images.clear();
            for v in vectors {
                let forms = forms.chunks_exact(width);
                images.extend(forms.map(|form| self.field.dot(form, v)));
            }
            levels[0].numbers.fill(self.field.one());
            (&images[..], open)
        } else {
            levels[0].numbers.clone_from(forms);
            (&self.vectors[..], width)
        };
        let mut walk = Walk {
            of: self,
            vectors,
            width,
            levels,
            found: empty_set(self.nodes.len()),
        };
        let mut start = 0;
        for &(rows, end) in &self.lengths {
            if rows > 0 {
                walk.follow_rows(start..end, rows, 0);
            } else if open == 1 {
                // The front spans everything, and what has no rows adds nothing.
                walk.add_nodes(0, 0);
            }
            start = end;
        }
        walk.found
    }
}

/// The linear forms that are zero on the rows of a node of the front.
pub(super) struct ZeroForms {
    /// Number of coordinates.
    width: usize,
    /// Number of forms.
    count: usize,
    /// The numbers of the forms, one after another.
    numbers: Vec<Residue>,
}

impl ZeroForms {
    /// Returns the forms for a reduced basis in `width` coordinates.
    ///
    /// # Complexity
    /// O(w²) field operations for w coordinates.
    pub(super) fn new(field: Field, rows: &[Vec<Residue>], width: usize) -> ZeroForms {
        let pivots = rows
            .iter()
            .filter_map(|row| row.iter().position(|&x| x != 0));
        let pivots: Vec<usize> = pivots.collect();
        let open: Vec<usize> = (0..width).filter(|at| !pivots.contains(at)).collect();
        let mut numbers = vec![0; open.len() * width];
        for (form, &at) in numbers.chunks_exact_mut(width).zip(&open) {
            form[at] = field.one();
            for (&pivot, row) in pivots.iter().zip(rows) {
                form[pivot] = field.neg(row[at]);
            }
        }
        ZeroForms {
            width,
            count: open.len(),
            numbers,
        }
    }
}

/// Memory that one walk leaves to the next.
#[derive(Default)]
pub(super) struct WalkMemory {
    images: Vec<Residue>,
    levels: Vec<Forms>,
}

/// The linear forms that are zero on the front and on some rows of rank r.
#[derive(Default)]
struct Forms {
    /// Empty if forms have numbers at all coordinates. Otherwise the coordinates: first r whose forms have ended, one with each row that was
    /// new, then one of each form. A form has numbers at its own and at those that have ended.
    order: Vec<usize>,
    /// The numbers of the forms, one after another.
    numbers: Vec<Residue>,
    /// How many numbers a form has.
    each: usize,
}

impl Forms {
    /// Makes room for the forms of a rank, of `forms` before any row, with some numbers each. If they are `sparse`, each has a coordinate
    /// before any row.
    fn resize_to(&mut self, forms: usize, rank: usize, each: usize, sparse: bool) {
        self.order.clear();
        self.order.extend(0..if sparse { forms } else { 0 });
        self.numbers.resize((forms - rank) * each, 0);
        self.each = each;
    }

    /// Returns what a form is on a vector.
    #[inline]
    fn value(&self, f: Field, form: usize, vector: &[Residue]) -> Residue {
        let numbers = &self.numbers[form * self.each..][..self.each];
        if self.order.is_empty() {
            return f.dot(numbers, vector);
        }
        let (ended, own) = self.order.split_at(self.each - 1);
        let own = vector[own[form]];
        if ended.is_empty() {
            // Before any row it is one number of the vector.
            return own;
        }
        let product = |i: usize| match i {
            0 => (numbers[0], own),
            i => (numbers[i], vector[ended[i - 1]]),
        };
        f.sum_of_products((0..self.each).map(product))
    }
}

/// The nodes that complete one of the front, as far as they are found.
struct Walk<'a> {
    of: &'a Bases,
    /// The vectors, or what the forms before any row are on them; each of `width` numbers.
    vectors: &'a [Residue],
    width: usize,
    /// The forms for each rank of the rows that are followed; that with the motion of kept links is the last.
    levels: &'a mut [Forms],
    found: Set,
}

impl Walk<'_> {
    /// Follows the rows of some items, with `left` rows to the end of each basis. The rows before have a rank, and the forms of that rank
    /// are zero on them.
    fn follow_rows(&mut self, items: Range<usize>, left: usize, rank: usize) {
        let (f, keeps, width) = (self.of.field, self.of.keeps, self.width);
        let missing = self.levels.len() - 1 - rank;
        if left < missing {
            return;
        }
        if left == missing && self.of.spanned {
            // All rows that are left are new.
            return self.add_nodes(self.of.items[items.start].first, items.end);
        }
        let mut at = items.start;
        while at < items.end {
            let Item { vector, end, first } = self.of.items[at];
            let below = at + 1..end;
            at = end;
            let row = &self.vectors[vector * width..][..width];
            let value = |form: usize| self.levels[rank].value(f, form, row);
            match (0..missing).find(|&form| value(form) != 0) {
                // The rows that are left span too little.
                None if left == missing => {}
                // Kept links would move alone.
                None if keeps && value(missing) != 0 => {}
                None if below.is_empty() || missing == 0 && !keeps => self.add_nodes(first, end),
                None => self.follow_rows(below, left - 1, rank),
                // Nothing is left to be spanned, or to be moved by further rows.
                Some(_) if missing == 1 && (below.is_empty() || !keeps) => {
                    self.add_nodes(first, end);
                }
                Some(ended) => {
                    self.eliminate_form(rank, ended, vector);
                    self.follow_rows(below, left - 1, rank + 1);
                }
            }
        }
    }

    /// Makes the forms of the next rank, which are zero on a vector as well: those of a rank without one, each a multiple of itself less a
    /// multiple of that one.
    fn eliminate_form(&mut self, rank: usize, ended: usize, vector: usize) {
        let f = self.of.field;
        let row = &self.vectors[vector * self.width..][..self.width];
        let (before, after) = self.levels.split_at_mut(rank + 1);
        let (old, new) = (&before[rank], &mut after[0]);
        let less = &old.numbers[ended * old.each..][..old.each];
        let scale = old.value(f, ended, row);
        let forms = old.numbers.chunks_exact(old.each).enumerate();
        let others = forms.filter(|(form, _)| *form != ended);
        for ((form, own), to) in others.zip(new.numbers.chunks_exact_mut(new.each)) {
            let value = old.value(f, form, row);
            for (to, (&own, &less)) in to.iter_mut().zip(own.iter().zip(less)) {
                *to = f.difference_of_products(scale, own, value, less);
            }
            if new.each > old.each {
                // Each has its first number at a coordinate of its own.
                to[0] = f.mul(scale, own[0]);
                to[old.each] = f.neg(f.mul(value, less[0]));
            }
        }
        if !new.order.is_empty() {
            new.order.copy_from_slice(&old.order);
            new.order[rank..=rank + ended].rotate_right(1);
        }
    }

    /// Adds the nodes of the bases whose first rows are items from one that begins with basis `first` to before `end`.
    fn add_nodes(&mut self, first: usize, end: usize) {
        let behind = self.of.items.get(end).map(|item| item.first);
        for &node in &self.of.nodes[first..behind.unwrap_or(self.of.nodes.len())] {
            add_node(&mut self.found, node);
        }
    }
}
