//! Exact solution of linear relations: free coordinates keep decimals, the others follow.

/// Minimum size of a pivot, as a share of the largest.
const LARGE: f64 = 0.2;
/// Number of operations on words after which the solution is abandoned: a second or two. Numbers grow long if many
/// relations without a pattern depend on each other.
const WORK: u64 = 2_500_000_000;

fn bit_length(x: &BigRational) -> u64 {
    x.numer().bits() + x.denom().bits()
}

fn word_count(x: &BigInt) -> u64 {
    x.bits() / 64 + 1
}

/// Σ coefficient · coordinate + constant = 0 in whole numbers. Fractions would be reduced at every step, which takes
/// most of the time.
struct Equation {
    of: BTreeMap<usize, BigInt>,
    constant: BigInt,
}

impl Equation {
    fn all_numbers(&self) -> impl Iterator<Item = &BigInt> {
        self.of.values().chain([&self.constant])
    }

    fn change_each(&mut self, change: impl Fn(&mut BigInt)) {
        self.of
            .values_mut()
            .chain([&mut self.constant])
            .for_each(change);
    }

    /// Adds a multiple of another equation. Returns the number of operations on words.
    fn add(&mut self, by: &BigInt, other: &Equation) -> u64 {
        let mut spent = 0;
        for (&v, x) in &other.of {
            spent += word_count(by) * word_count(x) + 1;
            *self.of.entry(v).or_default() += by * x;
        }
        self.constant += by * &other.constant;
        self.of.retain(|_, x| !x.is_zero());
        spent
    }

    /// Divides by the common factor of all numbers. Returns the number of operations on words.
    fn divide_common(&mut self) -> u64 {
        let mut spent = 0;
        let mut shared = BigInt::zero();
        let mut all: Vec<&BigInt> = self.all_numbers().filter(|x| !x.is_zero()).collect();
        // The common factor is no longer than the shortest number.
        all.sort_by_key(|x| x.bits());
        for x in all {
            if shared.is_one() {
                break;
            }
            // The remainder is no longer than the common factor, which is soon short. So one long divisor is computed,
            // not one for each number.
            let rest = if shared.is_zero() {
                x.abs()
            } else {
                x % &shared
            };
            spent += 64 * word_count(&rest) * word_count(&rest);
            shared = shared.gcd(&rest);
        }
        if !shared.is_zero() && !shared.is_one() {
            self.change_each(|x| *x /= &shared);
        }
        spent
    }
}

/// An equation that determines one coordinate, which occurs in no other solved equation.
struct Solved {
    pivot: usize,
    equation: Equation,
}

impl Solved {
    /// Returns the coefficient of the coordinate.
    fn pivot_coefficient(&self) -> &BigInt {
        &self.equation.of[&self.pivot]
    }
}

/// The equations of rows for coordinates, solved one after another.
#[derive(Default)]
struct Solution {
    solved: Vec<Solved>,
    /// The index of the solved equation with each pivot coordinate.
    by_pivot: BTreeMap<usize, usize>,
    /// Number of operations on words.
    spent: u64,
}

impl Solution {
    /// Substitutes the solved coordinates. Returns the factor by which the numbers of the row are multiplied.
    fn put_in(&mut self, row: &mut Equation) -> BigInt {
        let by_pivot = &self.by_pivot;
        let known = row.of.keys().filter_map(|v| by_pivot.get(v));
        let known: Vec<&Solved> = known.map(|&i| &self.solved[i]).collect();
        let times = known.iter().fold(BigInt::one(), |t, s| {
            common_multiple(t, &s.pivot_coefficient().abs())
        });
        if !times.is_one() {
            row.change_each(|x| *x *= &times);
        }
        for s in known {
            let by = -(&row.of[&s.pivot] / s.pivot_coefficient());
            self.spent += row.add(&by, &s.equation);
        }
        times
    }

    /// Solves a row for one of its coordinates; `count` is the factor of its numbers.
    fn solve_row(&mut self, mut row: Equation, mut count: BigInt) -> Option<()> {
        count *= self.put_in(&mut row);
        let Some(pivot) = choose_pivot(&row, &count) else {
            return row.constant.is_zero().then_some(());
        };
        self.spent += row.divide_common();
        let unit = &row.of[&pivot];
        for s in &mut self.solved {
            if self.spent > WORK {
                return None;
            }
            let Some(by) = s.equation.of.get(&pivot) else {
                continue;
            };
            let shared = unit.gcd(by);
            let (times, by) = (unit / &shared, -(by / &shared));
            s.equation.change_each(|x| *x *= &times);
            self.spent += s.equation.add(&by, &row) + s.equation.divide_common();
        }
        self.by_pivot.insert(pivot, self.solved.len());
        self.solved.push(Solved {
            pivot,
            equation: row,
        });
        Some(())
    }
}

/// Returns the pivot: among large enough coordinates the one with the shortest number, so that numbers stay short.
fn choose_pivot(row: &Equation, count: &BigInt) -> Option<usize> {
    let longest = row.of.values().map(BigInt::bits).max()?;
    // Doubles cover about a thousand bits; only the sizes close to the largest matter.
    let beyond = longest.saturating_sub(512);
    let size = |x: &BigInt| (x.abs() >> beyond).to_f64().unwrap_or(0.0);
    let largest = row.of.values().map(size).fold(0.0, f64::max);
    let large = row.of.iter().filter(|x| size(x.1) >= LARGE * largest);
    let length = |x: &BigInt| bit_length(&BigRational::new(x.clone(), count.clone()));
    large.min_by_key(|x| length(x.1)).map(|(v, _)| *v)
}

/// Returns a row without the `fixed` coordinates, and the factor of its numbers.
fn integral_equation(
    row: &PointEquation,
    normals: &[Rational3],
    value: impl Fn(usize, usize) -> BigRational,
    fixed: impl Fn(usize, usize) -> bool,
) -> (Equation, BigInt) {
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
    let count = common_denominator(of.values().chain([&constant]));
    let constant = whole_over(&constant, &count);
    let of = of.iter().filter(|x| !x.1.is_zero());
    let of = of.map(|(&v, x)| (v, whole_over(x, &count))).collect();
    (Equation { of, constant }, count)
}

/// Returns points that satisfy rows exactly, or `None` if rows contradict each other or numbers grow too long. `value`
/// gives a coordinate if it is free, `fixed` whether it must stay.
///
/// # Complexity
/// O(r² w) operations on whole numbers for r rows of w coordinates.
pub(super) fn solve_rows(
    rows: &[PointEquation],
    normals: &[Rational3],
    points: usize,
    value: impl Fn(usize, usize) -> BigRational,
    fixed: impl Fn(usize, usize) -> bool,
) -> Option<Vec<Rational3>> {
    // Short normals come first: a row along an axis of the frame replaces one coordinate by another.
    let width = |r: &&PointEquation| -> u64 {
        let n = &normals[r.normal];
        n.iter()
            .map(|x| if x.is_zero() { 0 } else { bit_length(x) })
            .sum()
    };
    let mut rows: Vec<&PointEquation> = rows.iter().collect();
    rows.sort_by_key(width);
    let mut solution = Solution::default();
    for row in rows {
        let (row, count) = integral_equation(row, normals, &value, &fixed);
        solution.solve_row(row, count)?;
    }
    let mut out: Vec<Rational3> = (0..points)
        .map(|p| [0, 1, 2].map(|k| value(p, k)))
        .collect();
    for s in &solution.solved {
        let others = s.equation.of.iter().filter(|x| *x.0 != s.pivot);
        // All numbers are over one denominator, reduced once.
        let terms: Vec<(&BigInt, &BigRational)> =
            others.map(|(v, by)| (by, &out[v / 3][v % 3])).collect();
        let denom = common_denominator(terms.iter().map(|t| t.1));
        let sum: BigInt = terms.iter().map(|t| t.0 * whole_over(t.1, &denom)).sum();
        let sum = sum + &s.equation.constant * &denom;
        out[s.pivot / 3][s.pivot % 3] = BigRational::new(-sum, denom * s.pivot_coefficient());
    }
    Some(out)
}

#[cfg(test)]
mod tests;

use super::number::Rational3;
use crate::linalg::{common_denominator, common_multiple, whole_over};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;

/// Σ coefficient · normal · point = 0, with coefficients that add up to zero.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PointEquation {
    /// Points with their coefficients.
    pub(crate) terms: Vec<(usize, i32)>,
    /// Index of the normal.
    pub(crate) normal: usize,
}

impl PointEquation {
    /// Creates an equation with the coefficients of each point added up, without those that cancel.
    pub(crate) fn sum(terms: &[(usize, i32)], normal: usize) -> PointEquation {
        let mut sum = BTreeMap::new();
        for &(point, c) in terms {
            *sum.entry(point).or_insert(0) += c;
        }
        PointEquation {
            terms: sum.into_iter().filter(|t| t.1 != 0).collect(),
            normal,
        }
    }
}
