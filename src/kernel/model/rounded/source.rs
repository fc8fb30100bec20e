//! Accuracy of numbers calculated from those of another file.

use super::class::{NumberClass, NumberKind};
use crate::geom::expr::Expr;
use ozols_dense::norm;

/// The numbers from which positions are calculated, as written.
#[derive(Debug, Default)]
pub struct Sources {
    /// Lengths.
    pub lengths: Vec<Expr>,
    /// Directions and quaternions.
    pub directions: Vec<Vec<Expr>>,
    /// Angles in radians.
    pub angles: Vec<Expr>,
}

/// The largest half units of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Largest {
    /// Half unit of lengths.
    pub length: f64,
    /// Half unit of directions of length 1.
    pub direction: f64,
    /// Half unit of turns, in radians.
    pub turn: f64,
}

impl Sources {
    /// Returns the largest half units of long decimals, by the rules of [`uncertainties`](super::uncertainties), or
    /// `None` if there are none.
    pub fn largest_half_units(&self) -> Option<Largest> {
        let (mut lengths, mut directions) = (NumberClass::default(), NumberClass::default());
        lengths.see_vector(&self.lengths, NumberKind::Length);
        let angles = self.angles.iter().map(std::slice::from_ref);
        for v in self.directions.iter().map(Vec::as_slice).chain(angles) {
            directions.see_vector(v, NumberKind::Direction);
        }
        let [lengths, directions] = [lengths, directions].map(NumberClass::with_commonest);
        if !lengths.is_long() && !directions.is_long() {
            return None;
        }
        let largest = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, f64::max);
        let turn = |e: &Expr| directions.of_long(e, NumberKind::Direction);
        let of = |v: &Vec<Expr>| {
            let real: Vec<f64> = v.iter().map(Expr::to_f64).collect();
            let norm = norm(&real);
            let halves = directions.direction_half_units(v);
            let most = halves.into_iter().fold(0.0, f64::max);
            if norm > 0.0 { most / norm } else { 0.0 }
        };
        // Quaternions rotate frames.
        let quaternions = self.directions.iter().filter(|v| v.len() == 4);
        Some(Largest {
            length: largest(
                &mut self
                    .lengths
                    .iter()
                    .map(|e| lengths.of_long(e, NumberKind::Length)),
            ),
            direction: largest(&mut self.directions.iter().map(of)),
            turn: largest(&mut self.angles.iter().map(turn).chain(quaternions.map(of))),
        })
    }
}
