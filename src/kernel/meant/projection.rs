//! Points moved as little as may be, in errors of their digits, so that linear relations hold; each relation is taken only if all
//! taken so far still hold with no coordinate moved by more than its digits allow.

use super::relations::Relation;
use super::solve::PointEquation;
use crate::geom::vector::{Vector, dot, sub};

/// What became of a relation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Taken {
    /// It holds now, and did not before.
    New,
    /// It follows from others.
    Implied,
    /// It cannot hold with the others within the digits.
    Refused,
}

/// Rounds of alternating projections,
const ROUNDS: usize = 64;
/// each further than to the box, for speed,
const BEYOND: f64 = 1.6;
/// until no coordinate is so much outside, in errors.
const SLACK: f64 = 0.01;
/// A relation is told by others where so little of it is left.
const DEPENDENT: f64 = 1e-7;

/// Points on the way to where relations hold.
pub(super) struct Projection<'a> {
    start: Vec<Vector>,
    pub(super) points: Vec<Vector>,
    /// Error of each point, in each coordinate of the frame; 0 where it must stay.
    errors: &'a [Vector],
    /// The displacement of a point that its digits allow, nearest to one that is wished for.
    clipped: &'a dyn Fn(usize, Vector) -> Vector,
    /// Orthonormal directions that are decided, in errors.
    basis: Vec<Vec<f64>>,
    /// Independent relations taken.
    pub(super) rows: Vec<PointEquation>,
    /// Sum of squares of moves, in errors.
    pub(super) square: f64,
    /// Moves may be larger by this than those of relations usually are.
    pub(super) bold: f64,
}

impl<'a> Projection<'a> {
    pub(super) fn new(
        points: Vec<Vector>,
        errors: &'a [Vector],
        clipped: &'a dyn Fn(usize, Vector) -> Vector,
    ) -> Projection<'a> {
        Projection {
            start: points.clone(),
            points,
            errors,
            clipped,
            basis: Vec::new(),
            rows: Vec::new(),
            square: 0.0,
            bold: 1.0,
        }
    }

    /// How far a row is from holding, a length times coefficients.
    pub(super) fn residue(&self, row: &PointEquation, normals: &[Vector]) -> f64 {
        let n = normals[row.normal];
        let first = self.points[row.terms[0].0];
        // Differences from the first point, so that nothing large cancels.
        row.terms
            .iter()
            .map(|&(p, c)| f64::from(c) * dot(n, sub(self.points[p], first)))
            .sum()
    }

    /// Whether small moves of points in these directions are decided by what is taken.
    pub(super) fn implies(&self, gradients: &[(usize, Vector)]) -> bool {
        let mut a: Vec<(usize, f64)> = Vec::with_capacity(3 * gradients.len());
        for (p, g) in gradients {
            for (k, (g, error)) in g.iter().zip(self.errors[*p]).enumerate() {
                let (at, by) = (3 * p + k, g * error);
                match a.iter_mut().find(|x| x.0 == at) {
                    Some(x) => x.1 += by,
                    None => a.push((at, by)),
                }
            }
        }
        let square: f64 = a.iter().map(|x| x.1 * x.1).sum();
        // The basis is orthonormal, so what is left is what its parts leave of the square.
        let parts = self
            .basis
            .iter()
            .map(|b| a.iter().map(|(at, x)| x * b[*at]).sum::<f64>());
        let left = square - parts.map(|p| p * p).sum::<f64>();
        left <= 1e-12 * square
    }

    /// The move that a row asks for now, in errors; none where it is decided by what is taken.
    pub(super) fn asks(&self, row: &PointEquation, normals: &[Vector]) -> Option<f64> {
        let (a, before) = self.across(row, normals);
        let left = norm(&a);
        (left > DEPENDENT * before && before > 0.0)
            .then(|| (self.residue(row, normals) / left).abs())
    }

    /// Takes the relations that hold together within the digits, those refused once more at the end; gives those with what
    /// became of them.
    pub(super) fn take_all(
        &mut self,
        found: Vec<Relation>,
        normals: &[Vector],
    ) -> Vec<(Relation, Taken)> {
        let each = |r: Relation| {
            let became = self.take(&r.rows, normals);
            (r, became)
        };
        let mut out: Vec<(Relation, Taken)> = found.into_iter().map(each).collect();
        // What was too far may be near now that others hold.
        for (r, became) in &mut out {
            if *became == Taken::Refused {
                *became = self.take(&r.rows, normals);
            }
        }
        out
    }

    /// Takes rows all together or not at all.
    pub(super) fn take(&mut self, rows: &[PointEquation], normals: &[Vector]) -> Taken {
        let limit = self.bold * limit(rows.len());
        let (points, basis, taken, square) = (
            self.points.clone(),
            self.basis.len(),
            self.rows.len(),
            self.square,
        );
        let mut moved = 0.0;
        for row in rows {
            match self.put(row, normals) {
                Some(by) => moved += by,
                None => {
                    moved = f64::INFINITY;
                    break;
                }
            }
        }
        let touched = self.rows.len() > taken;
        let by_chance = self.square <= self.bold.powi(2) * most_by_chance(self.rows.len());
        if moved <= limit * limit && (!touched || (by_chance && self.relax())) {
            return if touched { Taken::New } else { Taken::Implied };
        }
        self.points = points;
        self.basis.truncate(basis);
        self.rows.truncate(taken);
        self.square = square;
        Taken::Refused
    }

    /// Moves points, what is taken kept, to where the digits of all allow it; false where they get no nearer to that.
    ///
    /// Alternating projections: to the box of the digits, and back to where all rows hold.
    fn relax(&mut self) -> bool {
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
            for b in &self.basis {
                let part: f64 = by.iter().zip(b).map(|(x, y)| x * y).sum();
                if part != 0.0 {
                    by.iter_mut().zip(b).for_each(|(x, y)| *x -= part * y);
                }
            }
            for (p, point) in self.points.iter_mut().enumerate() {
                for k in 0..3 {
                    point[k] += by[3 * p + k] * self.errors[p][k];
                }
            }
        }
        false
    }

    /// A row in errors, without what is decided, and how large it was with it.
    fn across(&self, row: &PointEquation, normals: &[Vector]) -> (Vec<f64>, f64) {
        let n = normals[row.normal];
        let mut a = vec![0.0; 3 * self.points.len()];
        for &(p, c) in &row.terms {
            for k in 0..3 {
                a[3 * p + k] += f64::from(c) * n[k] * self.errors[p][k];
            }
        }
        let before = norm(&a);
        for _ in 0..2 {
            for b in &self.basis {
                let part: f64 = a.iter().zip(b).map(|(x, y)| x * y).sum();
                if part != 0.0 {
                    a.iter_mut().zip(b).for_each(|(x, y)| *x -= part * y);
                }
            }
        }
        (a, before)
    }

    /// Puts one row, and gives the square of the move; none where it contradicts those taken.
    fn put(&mut self, row: &PointEquation, normals: &[Vector]) -> Option<f64> {
        let (mut a, before) = self.across(row, normals);
        let residue = self.residue(row, normals);
        let scale: f64 = row
            .terms
            .iter()
            .map(|&(p, c)| {
                f64::from(c.abs()) * self.points[p].iter().fold(0.0, |m: f64, x| m.max(x.abs()))
            })
            .sum();
        let round_off = 1e-14 * scale;
        if before == 0.0 {
            return (residue.abs() <= round_off).then_some(0.0);
        }
        let left = norm(&a);
        if left < DEPENDENT * before {
            // Of what follows from others nothing is left but rounding.
            return (residue.abs() <= round_off + 1e-5 * before).then_some(0.0);
        }
        let step = residue / left;
        a.iter_mut().for_each(|x| *x /= left);
        for (p, point) in self.points.iter_mut().enumerate() {
            for k in 0..3 {
                point[k] -= step * a[3 * p + k] * self.errors[p][k];
            }
        }
        self.basis.push(a);
        self.rows.push(row.clone());
        self.square += step * step;
        Some(step * step)
    }
}

/// The largest move for a relation of so many rows, in errors: of more rows the chance is larger that one is far.
fn limit(rows: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "rows are three at most")]
    let n = rows as f64;
    (3.0 + 1.5 * n).sqrt()
}

/// What the squares of moves for so many rows add up to at most, in errors, where rounding made them: a third each on average.
/// One relation may be far by chance, but not many.
fn most_by_chance(rows: usize) -> f64 {
    /// Standard deviations.
    const FAR: f64 = 6.0;
    #[allow(clippy::cast_precision_loss, reason = "rows are few")]
    let n = rows as f64;
    n / 3.0 + FAR * (2.0 * n / 9.0).sqrt()
}

fn norm(a: &[f64]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}
