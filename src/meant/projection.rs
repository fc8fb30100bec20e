//! Points moved as little as may be, in errors of their digits, so that linear relations hold; each relation is taken only if all
//! taken so far still hold with no coordinate moved by more than its digits allow.

use super::relations::Relation;
use crate::geom::vector::{Vector, dot};

/// Σ coefficient · normal · point = 0, the coefficients adding up to zero.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Points with their coefficients.
    pub(super) terms: Vec<(usize, i32)>,
    /// Which of the normals.
    pub(super) normal: usize,
}

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

/// A relation is told by others where so little of it is left.
const DEPENDENT: f64 = 1e-7;

/// Points on the way to where relations hold.
pub(super) struct Projection<'a> {
    start: Vec<Vector>,
    pub(super) points: Vec<Vector>,
    /// Error of each point, in each coordinate of the frame; 0 where it must stay.
    errors: &'a [Vector],
    /// Whether a displacement of a point is within its digits.
    allowed: &'a dyn Fn(usize, Vector) -> bool,
    /// Orthonormal directions that are decided, in errors.
    basis: Vec<Vec<f64>>,
    /// Independent relations taken.
    pub(super) rows: Vec<Row>,
    /// Sum of squares of moves, in errors.
    pub(super) square: f64,
    /// Moves may be larger by this than those of relations usually are.
    pub(super) bold: f64,
}

impl<'a> Projection<'a> {
    pub(super) fn new(
        points: Vec<Vector>,
        errors: &'a [Vector],
        allowed: &'a dyn Fn(usize, Vector) -> bool,
    ) -> Projection<'a> {
        Projection {
            start: points.clone(),
            points,
            errors,
            allowed,
            basis: Vec::new(),
            rows: Vec::new(),
            square: 0.0,
            bold: 1.0,
        }
    }

    /// How far a row is from holding, a length times coefficients.
    pub(super) fn residue(&self, row: &Row, normals: &[Vector]) -> f64 {
        let n = normals[row.normal];
        let first = self.points[row.terms[0].0];
        // Differences from the first point, so that nothing large cancels.
        row.terms
            .iter()
            .map(|&(p, c)| f64::from(c) * dot(n, crate::geom::vector::sub(self.points[p], first)))
            .sum()
    }

    /// Whether small moves of points in these directions are decided by what is taken.
    pub(super) fn implies(&self, gradients: &[(usize, Vector)]) -> bool {
        let mut a: Vec<(usize, f64)> = Vec::with_capacity(3 * gradients.len());
        for (p, g) in gradients {
            for k in 0..3 {
                let (at, by) = (3 * p + k, g[k] * self.errors[*p][k]);
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
    pub(super) fn asks(&self, row: &Row, normals: &[Vector]) -> Option<f64> {
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
    pub(super) fn take(&mut self, rows: &[Row], normals: &[Vector]) -> Taken {
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
        let fits = moved <= limit * limit
            && (!touched
                || (0..self.points.len()).all(|p| {
                    let by = crate::geom::vector::sub(self.points[p], self.start[p]);
                    by == [0.0; 3] || (self.allowed)(p, by)
                }));
        if fits {
            return if touched { Taken::New } else { Taken::Implied };
        }
        self.points = points;
        self.basis.truncate(basis);
        self.rows.truncate(taken);
        self.square = square;
        Taken::Refused
    }

    /// A row in errors, without what is decided, and how large it was with it.
    fn across(&self, row: &Row, normals: &[Vector]) -> (Vec<f64>, f64) {
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
    fn put(&mut self, row: &Row, normals: &[Vector]) -> Option<f64> {
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
    (3.5 + 2.0 * n).sqrt()
}

fn norm(a: &[f64]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}
