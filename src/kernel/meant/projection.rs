//! Points moved as little as possible, in units of their errors, so that linear relations hold. Each relation is
//! accepted only if all accepted ones still hold with every coordinate within its digits.
//!
//! Most relations follow from a few others, and most hold as written. The accepted rows are kept in reduced echelon
//! form, which has few entries. The orthonormal directions, which have many, are computed only when points must be
//! moved.

use super::relations::Relation;
use super::solve::PointEquation;
use crate::geom::vector::{Vector, dot, sub};

/// Outcome for a relation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Taken {
    /// It holds now, but did not before.
    New,
    /// It follows from others.
    Implied,
    /// It cannot hold with the others within the digits.
    Refused,
}

/// Maximum number of rounds of alternating projections.
const ROUNDS: usize = 64;
/// Overrelaxation of each projection to the box.
const BEYOND: f64 = 1.6;
/// Distance from the box at which the rounds stop, in errors.
const SLACK: f64 = 0.01;
/// Share of a relation below which it depends on others.
const DEPENDENT: f64 = 1e-7;
/// Deviation within which a row holds without a move, in errors.
const HOLDS: f64 = 1e-7;
/// The relative rounding error of a sum of numbers that cancel.
const ROUND_OFF: f64 = 1e-12;

/// Coordinates, in errors, with their coefficients; ascending, without zeros.
type Sparse = Vec<(usize, f64)>;

/// Points during the solution of the relations.
pub(super) struct Projection<'a> {
    start: Vec<Vector>,
    pub(super) points: Vec<Vector>,
    /// Error of each point, in each coordinate of the frame; 0 if it must stay.
    errors: &'a [Vector],
    /// The displacement of a point within its digits that is nearest to a requested one.
    clipped: &'a dyn Fn(usize, Vector) -> Vector,
    /// Orthonormal directions that the first rows determine, in errors. A direction is empty if only rounding errors
    /// were left of it.
    basis: Vec<Sparse>,
    /// For each coordinate that the rows determine, its expression in the free coordinates.
    told: Vec<Option<Sparse>>,
    /// The entries of `told` before the relation under test, which may still be refused.
    before: Vec<(usize, Option<Sparse>)>,
    /// Independent relations accepted.
    pub(super) rows: Vec<PointEquation>,
    /// Sum of squares of moves, in errors.
    pub(super) square: f64,
}

impl<'a> Projection<'a> {
    pub(super) fn new(
        points: Vec<Vector>,
        errors: &'a [Vector],
        clipped: &'a dyn Fn(usize, Vector) -> Vector,
    ) -> Projection<'a> {
        Projection {
            start: points.clone(),
            told: vec![None; 3 * points.len()],
            before: Vec::new(),
            points,
            errors,
            clipped,
            basis: Vec::new(),
            rows: Vec::new(),
            square: 0.0,
        }
    }

    /// Returns the deviation of a row from zero, a length times coefficients.
    pub(super) fn row_residue(&self, row: &PointEquation, normals: &[Vector]) -> f64 {
        let n = normals[row.normal];
        let first = self.points[row.terms[0].0];
        // Differences from the first point avoid the cancellation of large numbers.
        row.terms
            .iter()
            .map(|&(p, c)| f64::from(c) * dot(n, sub(self.points[p], first)))
            .sum()
    }

    /// Returns true if the accepted rows determine small moves of points in these directions.
    pub(super) fn implies_moves(&self, gradients: &[(usize, Vector)]) -> bool {
        let a = self.weight_direction(gradients.iter().copied());
        sparse_norm(&self.free_of(&a)) <= 1e-6 * sparse_norm(&a)
    }

    /// Accepts the relations that hold together within the digits, retrying the refused ones at the end. Returns them
    /// with their outcomes.
    pub(super) fn take_all(
        &mut self,
        found: Vec<Relation>,
        normals: &[Vector],
    ) -> Vec<(Relation, Taken)> {
        let each = |r: Relation| {
            let became = self.take_rows(&r.rows, normals);
            (r, became, self.rows.len())
        };
        let mut out: Vec<(Relation, Taken, usize)> = found.into_iter().map(each).collect();
        // A relation that was too far off may be near now that others hold.
        for (r, became, rows) in &mut out {
            if *became == Taken::Refused && *rows < self.rows.len() {
                *became = self.take_rows(&r.rows, normals);
            }
        }
        out.into_iter().map(|(r, became, _)| (r, became)).collect()
    }

    /// Accepts all of some rows, or none of them.
    pub(super) fn take_rows(&mut self, rows: &[PointEquation], normals: &[Vector]) -> Taken {
        // The accepted rows determine most rows: no point must be moved to see whether they hold.
        let told: Vec<Option<bool>> = rows.iter().map(|r| self.is_told(r, normals)).collect();
        if told.contains(&Some(false)) {
            return Taken::Refused;
        }
        if !told.contains(&None) {
            return Taken::Implied;
        }
        let most = largest_move(rows.len()).powi(2);
        let (points, taken, square) = (self.points.clone(), self.rows.len(), self.square);
        let mut moved = 0.0;
        for row in rows {
            moved += self.accept_row(row, normals, most).unwrap_or(f64::INFINITY);
            if moved > most {
                break;
            }
        }
        let touched = self.rows.len() > taken;
        let by_chance = self.square <= most_by_chance(self.rows.len());
        let is_taken =
            moved <= most && (!touched || (by_chance && self.relax_into_digits(normals)));
        let changed = std::mem::take(&mut self.before);
        if is_taken {
            return if touched { Taken::New } else { Taken::Implied };
        }
        for (i, of) in changed.into_iter().rev() {
            self.told[i] = of;
        }
        self.points = points;
        self.basis.truncate(taken);
        self.rows.truncate(taken);
        self.square = square;
        Taken::Refused
    }

    /// Moves points to where the digits of all allow it, keeping the accepted rows. Returns false if they stop getting
    /// nearer.
    ///
    /// Alternating projections: to the box of the digits, and back to where all rows hold.
    fn relax_into_digits(&mut self, normals: &[Vector]) -> bool {
        let mut last = f64::INFINITY;
        for round in 0..ROUNDS {
            let mut by = vec![0.0; 3 * self.points.len()];
            let mut over: f64 = 0.0;
            for (p, point) in self.points.iter().enumerate() {
                let moved = sub(*point, self.start[p]);
                if moved == [0.0; 3] {
                    continue;
                }
                let to = (self.clipped)(p, moved);
                for k in 0..3 {
                    if self.errors[p][k] > 0.0 {
                        let back = (to[k] - moved[k]) / self.errors[p][k];
                        by[3 * p + k] = BEYOND * back;
                        over = over.max(back.abs());
                    }
                }
            }
            if over <= SLACK {
                return true;
            }
            if round % 8 == 7 {
                if over > 0.9 * last {
                    return false;
                }
                last = over;
            }
            self.make_basis(normals);
            self.subtract_decided(&mut by);
            for (p, point) in self.points.iter_mut().enumerate() {
                for k in 0..3 {
                    point[k] += by[3 * p + k] * self.errors[p][k];
                }
            }
        }
        false
    }

    /// Returns the directions of points in errors, without the coordinates that must not change.
    fn weight_direction(&self, of: impl IntoIterator<Item = (usize, Vector)>) -> Sparse {
        let each = of.into_iter().flat_map(|(p, g)| {
            let by = |k: usize| (3 * p + k, g[k] * self.errors[p][k]);
            [0, 1, 2].map(by)
        });
        add_terms(each.filter(|x| x.1 != 0.0).collect())
    }

    /// Returns the gradient of a row in errors.
    fn row_gradient(&self, row: &PointEquation, normals: &[Vector]) -> Sparse {
        let n = normals[row.normal];
        let terms = row.terms.iter();
        self.weight_direction(terms.map(|&(p, c)| (p, n.map(|x| f64::from(c) * x))))
    }

    /// Returns the remainder of a direction in the free coordinates.
    fn free_of(&self, a: &[(usize, f64)]) -> Sparse {
        let mut out = Sparse::new();
        for &(i, x) in a {
            match &self.told[i] {
                Some(of) => out.extend(of.iter().map(|&(j, y)| (j, x * y))),
                None => out.push((i, x)),
            }
        }
        add_terms(out)
    }

    /// Eliminates one free coordinate by a new independent row, given its gradient in the free coordinates.
    fn eliminate_row(&mut self, free: &[(usize, f64)]) {
        let largest = free.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let Some(&(pivot, by)) = largest else {
            return;
        };
        let others = free.iter().filter(|x| x.0 != pivot);
        let is: Sparse = others.map(|&(i, x)| (i, -x / by)).collect();
        for i in 0..self.told.len() {
            let of = self.told[i].as_ref();
            let Some(of) = of.filter(|of| of.binary_search_by_key(&pivot, |x| x.0).is_ok()) else {
                continue;
            };
            let mut next = Sparse::with_capacity(of.len() + is.len());
            for &(j, x) in of {
                if j == pivot {
                    next.extend(is.iter().map(|&(k, y)| (k, x * y)));
                } else {
                    next.push((j, x));
                }
            }
            self.before.push((i, self.told[i].replace(add_terms(next))));
        }
        self.before.push((pivot, self.told[pivot].replace(is)));
    }

    /// Returns whether a row holds, or `None` if the accepted rows do not determine it.
    fn is_told(&self, row: &PointEquation, normals: &[Vector]) -> Option<bool> {
        let a = self.row_gradient(row, normals);
        let before = sparse_norm(&a);
        is_dependent(before, &self.free_of(&a)).then(|| self.row_holds(row, normals, before))
    }

    /// Returns true if a row of the given size holds, except for rounding errors.
    fn row_holds(&self, row: &PointEquation, normals: &[Vector], size: f64) -> bool {
        let farthest = |p: usize| self.points[p].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let terms = row.terms.iter();
        let scale: f64 = terms.map(|&(p, c)| f64::from(c.abs()) * farthest(p)).sum();
        self.row_residue(row, normals).abs() <= 1e-14 * scale + 1e-5 * size
    }

    /// Computes the directions of the rows that have none yet.
    fn make_basis(&mut self, normals: &[Vector]) {
        while let Some(row) = self.rows.get(self.basis.len()) {
            let a = self.row_gradient(row, normals);
            let mut across = self.across_basis(&a);
            let left = sparse_norm(&across);
            if left < DEPENDENT * sparse_norm(&a) {
                across.clear();
            }
            across.iter_mut().for_each(|x| x.1 /= left);
            self.basis.push(across);
        }
    }

    /// Returns a direction without its parts along the determined directions.
    fn across_basis(&self, a: &[(usize, f64)]) -> Sparse {
        let mut out = vec![0.0; 3 * self.points.len()];
        a.iter().for_each(|&(i, x)| out[i] = x);
        for _ in 0..2 {
            self.subtract_decided(&mut out);
        }
        out.into_iter().enumerate().filter(|x| x.1 != 0.0).collect()
    }

    fn subtract_decided(&self, a: &mut [f64]) {
        for b in &self.basis {
            let part: f64 = b.iter().map(|&(i, y)| a[i] * y).sum();
            if part != 0.0 {
                b.iter().for_each(|&(i, y)| a[i] -= part * y);
            }
        }
    }

    /// Accepts one row and returns the square of the move. Returns `None` if the row contradicts the accepted ones, or
    /// certainly requires more than `most`.
    fn accept_row(&mut self, row: &PointEquation, normals: &[Vector], most: f64) -> Option<f64> {
        let a = self.row_gradient(row, normals);
        let (before, free) = (sparse_norm(&a), self.free_of(&a));
        if is_dependent(before, &free) {
            return self.row_holds(row, normals, before).then_some(0.0);
        }
        let residue = self.row_residue(row, normals);
        // The part across the determined directions is no longer than the part in the free coordinates.
        if (residue / sparse_norm(&free)).powi(2) > most {
            return None;
        }
        let mut step = 0.0;
        if residue.abs() > HOLDS * before {
            self.make_basis(normals);
            let mut across = self.across_basis(&a);
            let left = sparse_norm(&across);
            if left < DEPENDENT * before {
                return self.row_holds(row, normals, before).then_some(0.0);
            }
            step = residue / left;
            for (i, x) in &mut across {
                *x /= left;
                let (p, k) = (*i / 3, *i % 3);
                self.points[p][k] -= step * *x * self.errors[p][k];
            }
            self.basis.push(across);
        }
        self.rows.push(row.clone());
        self.eliminate_row(&free);
        self.square += step * step;
        Some(step * step)
    }
}

/// Returns true if other rows determine a row of the given size: only rounding errors are left of it in the free
/// coordinates.
fn is_dependent(size: f64, free: &[(usize, f64)]) -> bool {
    size == 0.0 || sparse_norm(free) < DEPENDENT * size
}

/// Adds up the coefficients of each coordinate, and omits those that cancel except for rounding errors.
fn add_terms(mut terms: Sparse) -> Sparse {
    terms.sort_unstable_by_key(|x| x.0);
    let mut out = Sparse::with_capacity(terms.len());
    for of in terms.chunk_by(|a, b| a.0 == b.0) {
        let sum: f64 = of.iter().map(|x| x.1).sum();
        let largest = of.iter().fold(0.0, |m: f64, x| m.max(x.1.abs()));
        if sum.abs() > ROUND_OFF * largest {
            out.push((of[0].0, sum));
        }
    }
    out
}

/// Returns the largest move for a relation of `rows` rows, in errors. With more rows, one is more likely to be far off.
fn largest_move(rows: usize) -> f64 {
    let n = rows as f64;
    (3.0 + 1.5 * n).sqrt()
}

/// Returns the largest sum of squared moves for `rows` rows, in errors, that rounding can explain: on average a third
/// each. One relation may be far off by chance, but not many.
fn most_by_chance(rows: usize) -> f64 {
    /// Number of standard deviations.
    const FAR: f64 = 6.0;
    let n = rows as f64;
    n / 3.0 + FAR * (2.0 * n / 9.0).sqrt()
}

fn sparse_norm(a: &[(usize, f64)]) -> f64 {
    a.iter().map(|x| x.1 * x.1).sum::<f64>().sqrt()
}
