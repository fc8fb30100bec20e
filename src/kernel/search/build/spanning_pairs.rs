//! Which nodes of the back half complete one of the front, pair by pair.
//!
//! Together both must span all coordinates of contours that they reach. Linear forms describe what the front does not span:
//! they are zero on all that it spans. The rows of a node of the back are taken one after another. A row is new if one of
//! the forms is not zero on it. The others are then changed so that they are zero there. Nodes whose bases have the same
//! beginning are examined together, so most pairs take one sum of products. One more form includes the motion of kept links.
//! It must be zero on each row that is not new, because no combination may move only kept links.

use crate::linalg::echelon::Echelon;
use crate::linalg::modp::{Field, Residue};
use crate::search::build::completing_sets::{Set, add_node, empty_set};
use hashbrown::HashMap;

/// A node of the back, with its rows as numbers of vectors.
type Rows = (Vec<usize>, usize);

/// The bases of the nodes of the back, sorted so that equal beginnings are adjacent.
pub(super) struct Bases {
    field: Field,
    vectors: Vec<Vec<Residue>>,
    nodes: Vec<Rows>,
    /// Whether the last number of a vector is a motion of kept links.
    keeps: bool,
}

impl Bases {
    /// Takes a reduced basis of each node, with a number of kept links behind the coordinates of contours.
    pub(super) fn new(field: Field, bases: &[Vec<Vec<Residue>>], keeps: bool) -> Bases {
        let mut known: HashMap<&[Residue], usize> = HashMap::new();
        let mut vectors = Vec::new();
        let mut number = |row| {
            *known.entry(row).or_insert_with_key(|row: &&[Residue]| {
                vectors.push(row.to_vec());
                vectors.len() - 1
            })
        };
        // The last rows have few numbers that are not zero, so that more bases have them in common.
        let mut all: Vec<Vec<usize>> = Vec::with_capacity(bases.len());
        for rows in bases {
            all.push(rows.iter().rev().map(|row| number(&row[..])).collect());
        }
        let mut nodes: Vec<Rows> = all.into_iter().zip(0..).collect();
        nodes.sort_by(|(a, _), (b, _)| (a.len(), a).cmp(&(b.len(), b)));
        Bases {
            field,
            vectors,
            nodes,
            keeps,
        }
    }

    /// Returns the nodes that complete a node of the front, which has these rows in `width` coordinates.
    ///
    /// # Complexity
    /// O(e·d) field operations for e different beginnings of bases and d coordinates that the node does not span. O(e·d²) if
    /// most rows are not the last ones.
    pub(super) fn completing_nodes(&self, rows: &[Vec<Residue>], width: usize) -> Set {
        let span = Echelon::from_vectors(self.field, rows);
        let (rows, pivots) = (span.reduced_rows(), span.pivots());
        let open: Vec<usize> = (0..width).filter(|at| !pivots.contains(at)).collect();
        let at_pivots = open
            .iter()
            .flat_map(|&at| rows.iter().map(move |row| self.field.neg(row[at])));
        let at_pivots: Vec<Residue> = at_pivots.collect();
        let mut images = Vec::with_capacity(self.vectors.len() * open.len());
        let mut there = Vec::with_capacity(pivots.len());
        for vector in &self.vectors {
            there.clear();
            there.extend(pivots.iter().map(|&p| vector[p]));
            images.extend(open.iter().enumerate().map(|(form, &at)| {
                let form = &at_pivots[form * pivots.len()..][..pivots.len()];
                self.field.add(vector[at], self.field.dot(form, &there))
            }));
        }
        let mut forms = vec![0; open.len() * open.len()];
        let own = forms.iter_mut().step_by(open.len() + 1);
        own.for_each(|own| *own = self.field.one());
        let mut walk = Walk {
            of: self,
            images,
            width: open.len(),
            found: empty_set(self.nodes.len()),
        };
        for alike in self.nodes.chunk_by(|(a, _), (b, _)| a.len() == b.len()) {
            walk.follow_rows(alike, 0, &forms);
        }
        walk.found
    }
}

/// The nodes that complete one of the front, as far as they are found.
struct Walk<'a> {
    of: &'a Bases,
    /// The forms of the front on each vector.
    images: Vec<Residue>,
    /// Forms of the front, that with the motion of kept links the last.
    width: usize,
    found: Set,
}

impl Walk<'_> {
    /// Follows bases of one length from a row on, all with the same rows before it. `forms` are those that are zero on these rows.
    fn follow_rows(&mut self, nodes: &[Rows], row: usize, forms: &[Residue]) {
        let missing = forms.len() / self.width - 1;
        let rows = nodes[0].0.len();
        if rows - row < missing {
            return;
        }
        if row == rows || missing == 0 && !self.of.keeps {
            self.put(nodes);
            return;
        }
        for alike in nodes.chunk_by(|(a, _), (b, _)| a[row] == b[row]) {
            let image = alike[0].0[row] * self.width;
            let image = image..image + self.width;
            let value = |form: usize| {
                let form = &forms[form * self.width..][..self.width];
                self.of.field.dot(form, &self.images[image.clone()])
            };
            match (0..missing).find(|&form| value(form) != 0) {
                // Kept links would move alone.
                None if self.of.keeps && value(missing) != 0 => {}
                None => self.follow_rows(alike, row + 1, forms),
                // Nothing is left to be spanned, or to be moved by further rows.
                Some(_) if missing == 1 && (row + 1 == rows || !self.of.keeps) => self.put(alike),
                Some(own) => {
                    let left = self.eliminate_form(forms, own, &self.images[image]);
                    self.follow_rows(alike, row + 1, &left);
                }
            }
        }
    }

    /// Returns the other forms, each with a multiple of one taken off so that it is zero on a vector.
    fn eliminate_form(&self, forms: &[Residue], own: usize, image: &[Residue]) -> Vec<Residue> {
        let f = self.of.field;
        let by = &forms[own * self.width..][..self.width];
        let scale = f.dot(by, image);
        let mut left = Vec::with_capacity(forms.len() - self.width);
        for (number, form) in forms.chunks_exact(self.width).enumerate() {
            let value = f.dot(form, image);
            if number == own {
                continue;
            }
            if value == 0 {
                left.extend_from_slice(form);
            } else {
                let both = form.iter().zip(by);
                left.extend(both.map(|(&x, &y)| f.sub(f.mul(scale, x), f.mul(value, y))));
            }
        }
        left
    }

    /// Puts nodes to those found.
    fn put(&mut self, nodes: &[Rows]) {
        for &(_, node) in nodes {
            add_node(&mut self.found, node);
        }
    }
}
