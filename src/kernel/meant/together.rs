//! Directions turned as little as possible, in units of their errors, so that perpendicular and coplanar ones become
//! exactly so. Each relation is accepted only if all accepted ones still hold within the digits.

use super::directions::Direction;
use crate::geom::vector::{self, Vector, cross, dot, length, unit};
use ozols_dense::{add_scaled, dot as list_dot, norm};

/// A relation of directions.
#[derive(Debug, Clone, Copy)]
enum DirectionRelation {
    Square(usize, usize),
    InPlane(usize, usize, usize),
}

/// Maximum number of directions among which planes are sought.
const MOST: usize = 40;
/// Minimum sine between two directions that define a plane.
const APART: f64 = 0.02;
/// Maximum total turn of the directions for a relation, in errors.
const LIMIT: f64 = 2.0;
/// Remainder of a relation below which it depends on others.
const DEPENDENT: f64 = 1e-6;

impl DirectionRelation {
    /// Returns the deviation, and its change with each direction.
    fn deviation_at(self, units: &[Vector]) -> (f64, Vec<(usize, Vector)>) {
        match self {
            DirectionRelation::Square(i, j) => {
                let (a, b) = (units[i], units[j]);
                (dot(a, b), vec![(i, b), (j, a)])
            }
            DirectionRelation::InPlane(i, j, k) => {
                let (a, b, c) = (units[i], units[j], units[k]);
                let by = vec![(i, cross(b, c)), (j, cross(c, a)), (k, cross(a, b))];
                (dot(a, cross(b, c)), by)
            }
        }
    }
}

/// Turns by which relations hold, in errors: one pair of numbers per direction.
struct Turns<'a> {
    all: &'a [Direction],
    basis: Vec<Vec<f64>>,
    turns: Vec<f64>,
}

impl Turns<'_> {
    fn weighted_row(&self, gradient: &[(usize, Vector)]) -> Vec<f64> {
        let mut a = vec![0.0; 2 * self.all.len()];
        for (d, g) in gradient {
            for (k, (tilt, error)) in self.all[*d].tilts.iter().enumerate() {
                a[2 * d + k] += dot(*g, *tilt) * error;
            }
        }
        a
    }

    fn turned_units(&self) -> Vec<Vector> {
        let turned = |(n, d): (usize, &Direction)| {
            let by = |k: usize| self.turns[2 * n + k] * d.tilts[k].1;
            let v = vector::add_scaled(d.unit, by(0), d.tilts[0].0);
            unit(vector::add_scaled(v, by(1), d.tilts[1].0))
        };
        self.all.iter().enumerate().map(turned).collect()
    }

    /// Makes a row hold that deviates by `residue`. Returns the move in errors, or `None` if it contradicts the others.
    fn accept_row(&mut self, mut a: Vec<f64>, residue: f64) -> Option<f64> {
        let before = norm(&a);
        if before == 0.0 {
            return (residue.abs() < 1e-14).then_some(0.0);
        }
        for _ in 0..2 {
            for b in &self.basis {
                a = add_scaled(&a, -list_dot(&a, b), b);
            }
        }
        let left = norm(&a);
        if left < DEPENDENT * before {
            return (residue.abs() <= 1e-13 + 1e-3 * before).then_some(0.0);
        }
        let step = residue / left;
        a.iter_mut().for_each(|x| *x /= left);
        self.turns = add_scaled(&self.turns, -step, &a);
        self.basis.push(a);
        Some(step.abs())
    }
}

/// Returns the relations that may hold within the errors, those of two directions first, the nearest first.
fn candidate_relations(all: &[Direction]) -> Vec<DirectionRelation> {
    let units: Vec<Vector> = all.iter().map(|d| d.unit).collect();
    let n = all.len();
    let mut out: Vec<(bool, f64, DirectionRelation)> = Vec::new();
    let mut offer = |r: DirectionRelation| {
        let (off, by) = r.deviation_at(&units);
        let errors = by.iter().flat_map(|(d, g)| {
            let tilts = all[*d].tilts;
            tilts.map(|(t, e)| (dot(*g, t) * e).powi(2))
        });
        let error = errors.sum::<f64>().sqrt();
        if off.abs() <= LIMIT * error + 1e-14 {
            let square = matches!(r, DirectionRelation::Square(..));
            out.push((!square, off.abs() / (error + 1e-14), r));
        }
    };
    for i in 0..n {
        for j in 0..i {
            offer(DirectionRelation::Square(i, j));
            if n > MOST || length(cross(units[i], units[j])) < APART {
                continue;
            }
            for k in 0..j {
                let apart = [i, j]
                    .iter()
                    .all(|&m| length(cross(units[m], units[k])) > APART);
                if apart {
                    offer(DirectionRelation::InPlane(i, j, k));
                }
            }
        }
    }
    out.sort_by(|a, b| {
        (a.0, a.1)
            .partial_cmp(&(b.0, b.1))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    out.into_iter().map(|x| x.2).collect()
}

/// Turns directions so that all compatible relations hold. `allowed` says whether the digits allow a direction.
///
/// # Complexity
/// O(d³) relations of d directions, each compared with the accepted ones.
pub(super) fn adjust_together(all: &mut [Direction], allowed: impl Fn(usize, Vector) -> bool) {
    let found = candidate_relations(all);
    let mut turns = Turns {
        all,
        basis: Vec::new(),
        turns: vec![0.0; 2 * all.len()],
    };
    let start: Vec<Vector> = turns.all.iter().map(|d| d.unit).collect();
    let mut taken: Vec<DirectionRelation> = Vec::new();
    for r in found {
        let (before, rows) = (turns.turns.clone(), turns.basis.len());
        let (off, by) = r.deviation_at(&start);
        let row = turns.weighted_row(&by);
        let moved = list_dot(&row, &turns.turns);
        let step = turns.accept_row(row, off + moved);
        let touched: Vec<usize> = (0..start.len())
            .filter(|d| {
                turns.turns[2 * d] != before[2 * d] || turns.turns[2 * d + 1] != before[2 * d + 1]
            })
            .collect();
        let units = turns.turned_units();
        if step.is_some_and(|s| s <= LIMIT) && touched.iter().all(|&d| allowed(d, units[d])) {
            taken.push(r);
        } else {
            turns.turns = before;
            turns.basis.truncate(rows);
        }
    }
    // Newton's method: the relations held linearly so far, and then hold exactly up to rounding.
    for _ in 0..4 {
        let (at, last) = (turns.turned_units(), turns.turns.clone());
        let mut next = Turns {
            all: turns.all,
            basis: Vec::new(),
            turns: vec![0.0; last.len()],
        };
        for r in &taken {
            let (off, by) = r.deviation_at(&at);
            let row = next.weighted_row(&by);
            let (there, here) = (list_dot(&row, &last), list_dot(&row, &next.turns));
            let _ = next.accept_row(row, off - there + here);
        }
        turns = next;
    }
    let units = turns.turned_units();
    for (d, v) in all.iter_mut().zip(units) {
        d.unit = v;
    }
}
