//! Linear relations solved exactly: free coordinates keep decimals, the others follow.

use super::number::Rational3;
use super::row::PointEquation;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// A pivot is at least this part of the largest.
const LARGE: f64 = 0.2;
/// Multiplications of words after which it is given up: about a second. Numbers grow long where many relations of no pattern
/// lean on each other.
const WORK: u64 = 200_000_000;

fn bits(x: &BigRational) -> u64 {
    x.numer().bits() + x.denom().bits()
}

/// Word multiplications of a product of two numbers, and of its reduction.
fn work(a: &BigRational, b: &BigRational) -> u64 {
    let words = (bits(a) + bits(b)) / 64 + 1;
    words * words
}

/// Points that fulfil rows exactly; none where rows contradict each other, or numbers grow too long. `value` gives what a coordinate is where it is free, `fixed` whether it must stay.
///
/// # Complexity
/// O(r² w) operations on rationals for r rows of w coordinates.
pub(super) fn solve(
    rows: &[PointEquation],
    normals: &[Rational3],
    points: usize,
    value: impl Fn(usize, usize) -> BigRational,
    fixed: impl Fn(usize, usize) -> bool,
) -> Option<Vec<Rational3>> {
    // Each equation: coordinate -> coefficient, with a constant, solved for its pivot.
    let mut solved: Vec<(usize, BTreeMap<usize, BigRational>, BigRational)> = Vec::new();
    let mut pivot_of: BTreeMap<usize, usize> = BTreeMap::new();
    // Short normals first: what is along an axis of the frame takes one coordinate for another.
    let width = |r: &&PointEquation| -> u64 {
        let n = &normals[r.normal];
        n.iter()
            .map(|x| if x.is_zero() { 0 } else { bits(x) })
            .sum()
    };
    let mut rows: Vec<&PointEquation> = rows.iter().collect();
    rows.sort_by_key(width);
    let mut spent = 0;
    for row in rows {
        if spent > WORK {
            return None;
        }
        let mut of: BTreeMap<usize, BigRational> = BTreeMap::new();
        let mut constant = BigRational::zero();
        for &(p, c) in &row.terms {
            for (k, n) in normals[row.normal].iter().enumerate() {
                if n.is_zero() {
                    continue;
                }
                let by = n * BigRational::from_integer(c.into());
                if fixed(p, k) {
                    constant += by * value(p, k);
                } else {
                    *of.entry(3 * p + k).or_insert_with(BigRational::zero) += by;
                }
            }
        }
        // Put in what is solved: no solved equation has another's pivot.
        let known: Vec<usize> = of
            .keys()
            .copied()
            .filter(|v| pivot_of.contains_key(v))
            .collect();
        for v in known {
            let Some(by) = of.remove(&v) else { continue };
            let (_, eq, c) = &solved[pivot_of[&v]];
            for (w, x) in eq {
                spent += work(&by, x);
                let entry = of.entry(*w).or_insert_with(BigRational::zero);
                *entry -= &by * x;
            }
            constant -= &by * c;
        }
        of.retain(|_, x| !x.is_zero());
        let size = |x: &BigRational| x.abs().to_f64().unwrap_or(0.0);
        // Of those large enough the shortest, so that numbers stay short.
        let largest = of.values().map(size).fold(0.0, f64::max);
        let short = of
            .iter()
            .filter(|x| size(x.1) >= LARGE * largest)
            .min_by_key(|x| bits(x.1));
        let Some(pivot) = short.map(|(v, _)| *v) else {
            if constant.is_zero() {
                continue;
            }
            return None;
        };
        let by = of.remove(&pivot)?;
        // pivot + Σ of + constant = 0
        of.values_mut().for_each(|x| *x /= &by);
        constant /= &by;
        for (_, eq, c) in &mut solved {
            if spent > WORK {
                return None;
            }
            let Some(by) = eq.remove(&pivot) else {
                continue;
            };
            for (w, x) in &of {
                spent += work(&by, x);
                let entry = eq.entry(*w).or_insert_with(BigRational::zero);
                *entry -= &by * x;
            }
            *c -= &by * &constant;
            eq.retain(|_, x| !x.is_zero());
        }
        pivot_of.insert(pivot, solved.len());
        solved.push((pivot, of, constant));
    }
    let mut out: Vec<Rational3> = (0..points)
        .map(|p| [0, 1, 2].map(|k| value(p, k)))
        .collect();
    for (pivot, eq, constant) in &solved {
        let mut x = -constant.clone();
        for (v, by) in eq {
            x -= by * value(v / 3, v % 3);
        }
        out[pivot / 3][pivot % 3] = x;
    }
    Some(out)
}
