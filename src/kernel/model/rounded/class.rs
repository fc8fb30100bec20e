//! Inference of how the decimals of one kind, lengths or directions, were written.

use crate::geom::expr::{Digits, End, Expr, WrittenNumber, half_of};
use num_traits::One;
use std::collections::BTreeMap;

/// Number of significant digits from which on lengths may have been rounded.
pub const LONG_LENGTH: usize = 4;
/// Number of significant digits from which on components of directions may have been rounded.
pub const LONG_DIRECTION: usize = 3;

/// Number of long decimals without a trailing zero that cannot be a coincidence.
const MANY: usize = 10;
/// Factor on the unit of one decimal in ten if trailing zeros are dropped.
const LOST: f64 = 10.5;
/// Minimum share of the long decimals, one in this many, for a number of places to count as the rounding. Fewer have
/// lost zeros.
const SHARE: usize = 5;
/// Number of significant digits below which a direction of decimals may have been chosen.
const FEW: usize = 3;

/// Kind of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum NumberKind {
    /// A length.
    Length,
    /// A component of a direction.
    Direction,
}

impl NumberKind {
    /// Returns the minimum number of significant digits of a long number.
    fn least_digits(self) -> usize {
        match self {
            NumberKind::Length => LONG_LENGTH,
            NumberKind::Direction => LONG_DIRECTION,
        }
    }

    /// Returns the minimum number of significant digits of a long number of a vector. Unless a direction was chosen, its
    /// decimals count as long with any number of digits.
    pub(super) fn least_digits_of(self, v: &[Expr]) -> usize {
        match self {
            NumberKind::Direction if is_rounded(v) => 1,
            _ => self.least_digits(),
        }
    }
}

/// The numbers of a kind as written, with equal ones counted once.
#[derive(Debug, Default)]
pub(super) struct NumberClass {
    /// Places of the long decimals, and of all with digits after the point, by size of the number.
    long: BTreeMap<u64, i32>,
    decimals: BTreeMap<u64, i32>,
    /// Whether any has a trailing zero.
    zeros: bool,
    /// Whether any is a whole number other than 0.
    whole: bool,
    /// Half the most common unit.
    most: Option<f64>,
}

impl NumberClass {
    /// Adds the numbers of a vector, or a single number.
    pub(super) fn see_vector(&mut self, v: &[Expr], kind: NumberKind) {
        let least = kind.least_digits_of(v);
        v.iter().for_each(|e| self.see_number(e, least));
    }

    /// Adds a number that is long from `least` significant digits on.
    fn see_number(&mut self, e: &Expr, least: usize) {
        let size = e.to_f64().abs();
        let digits = match e.written() {
            WrittenNumber::Decimal(digits) if digits.end != End::Float => digits,
            WrittenNumber::Decimal(_) | WrittenNumber::Whole => {
                self.whole |= size != 0.0;
                return;
            }
            WrittenNumber::No | WrittenNumber::Stated(_) => return,
        };
        self.zeros |= digits.end == End::Zero;
        // Among equal numbers, the one with the most digits is the most informative.
        let put = |map: &mut BTreeMap<u64, i32>| {
            let places = map.entry(size.to_bits()).or_insert(digits.places);
            *places = digits.places.max(*places);
        };
        put(&mut self.decimals);
        if digits.significant >= least {
            put(&mut self.long);
        }
    }

    /// Returns true if any decimal is long.
    pub(super) fn is_long(&self) -> bool {
        !self.long.is_empty()
    }

    /// Returns half the most common unit: of the long decimals, or of all if none is long. If two units are equally
    /// common, the finer one counts.
    pub(super) fn commonest_half_unit(&self) -> Option<f64> {
        self.most
    }

    /// Returns the class after all numbers are added, with the most common unit computed.
    pub(super) fn with_commonest(mut self) -> NumberClass {
        self.most = self.count_units();
        self
    }

    fn count_units(&self) -> Option<f64> {
        let of = if self.is_long() {
            &self.long
        } else {
            &self.decimals
        };
        let mut count = BTreeMap::<i32, usize>::new();
        for places in of.values() {
            *count.entry(*places).or_default() += 1;
        }
        let most = count.into_iter().max_by_key(|&(places, n)| (n, places));
        most.map(|(places, _)| half_of(places))
    }

    /// Returns true if its writer drops trailing zeros.
    fn drops_zeros(&self) -> bool {
        !self.zeros && self.long.len() >= MANY
    }

    /// Returns half the unit of a decimal of a vector, which is that of its last digit. A short decimal was chosen, and
    /// one in a vector with a finer one may have lost zeros. These have the most common unit.
    fn decimal_half_unit(&self, digits: Digits, of: &[Expr], kind: NumberKind) -> f64 {
        let (plain, factor) = (half_of(digits.places), digits.factor());
        let Some(most) = self.commonest_half_unit() else {
            return if digits.end == End::Float {
                0.0
            } else {
                digits.half
            };
        };
        if digits.end == End::Float {
            return most * factor;
        }
        if self.zeros || plain <= most {
            return digits.half;
        }
        let long = |d: &Digits| d.significant >= kind.least_digits();
        let all = of.iter().filter_map(digits_of).filter(long);
        let finest = all.clone().map(|d| half_of(d.places));
        let finest = finest.fold(f64::INFINITY, f64::min);
        let own = long(&digits) && {
            let lost = plain <= LOST * most && self.drops_zeros();
            // Long decimals that all have at most this many places were rounded together, and so were those as short as
            // many others.
            let together = all.count() > 1 && finest > most;
            together || self.is_common(digits.places) || (kind == NumberKind::Direction && !lost)
        };
        match kind {
            _ if own => digits.half,
            // A direction is written with one number of places.
            NumberKind::Direction if finest.is_finite() => finest * factor,
            _ => plain.min(most) * factor,
        }
    }

    /// Returns true if a fifth of the long decimals have this many places.
    fn is_common(&self, places: i32) -> bool {
        let as_short = self.long.values().filter(|p| **p == places).count();
        as_short * SHARE >= self.long.len()
    }

    /// Returns half the unit of a coordinate of a point, or of a length by itself. `turned` means that directions are
    /// decimals.
    pub(super) fn length_half_unit(&self, e: &Expr, of: &[Expr], turned: bool) -> f64 {
        let whole = |factor: f64| match self.commonest_half_unit() {
            None if turned && self.whole => 0.5 * factor,
            Some(most) if e.to_f64() != 0.0 => most * factor,
            _ => 0.0,
        };
        match e.written() {
            WrittenNumber::No => 0.0,
            WrittenNumber::Stated(half) => half,
            WrittenNumber::Whole => whole(1.0),
            WrittenNumber::Decimal(digits)
                if digits.end == End::Float && self.decimals.is_empty() =>
            {
                whole(digits.factor())
            }
            WrittenNumber::Decimal(digits) => {
                self.decimal_half_unit(digits, of, NumberKind::Length)
            }
        }
    }

    /// Returns half the unit of a long decimal, or 0 for a shorter one, which was chosen.
    pub(super) fn of_long(&self, e: &Expr, kind: NumberKind) -> f64 {
        match e.written() {
            WrittenNumber::Decimal(d)
                if d.significant >= kind.least_digits() && d.end != End::Float =>
            {
                self.decimal_half_unit(d, std::slice::from_ref(e), kind)
            }
            _ => 0.0,
        }
    }

    /// Returns half the units of the components of a direction, or of a quaternion.
    pub(super) fn direction_half_units(&self, v: &[Expr]) -> Vec<f64> {
        let chosen = !self.drops_zeros() && is_chosen(v);
        let half = |e: &Expr| match e.written() {
            WrittenNumber::No | WrittenNumber::Whole => 0.0,
            WrittenNumber::Stated(half) => half,
            WrittenNumber::Decimal(_) if chosen => 0.0,
            WrittenNumber::Decimal(digits) => {
                self.decimal_half_unit(digits, v, NumberKind::Direction)
            }
        };
        v.iter().map(half).collect()
    }
}

fn digits_of(e: &Expr) -> Option<Digits> {
    match e.written() {
        WrittenNumber::Decimal(digits) if digits.end != End::Float => Some(digits),
        _ => None,
    }
}

/// Returns true if a direction is rounded, judging by its components together: at least two of them are decimals, and
/// they were not chosen.
fn is_rounded(v: &[Expr]) -> bool {
    v.iter().filter(|e| digits_of(e).is_some()).count() > 1 && !is_chosen(v)
}

/// Returns true if a direction of short decimals was chosen by a person. It has length 1 exactly, as (0.6, 0.8, 0), or
/// is not rounded from one of length 1, as (1.5, 2, 0).
fn is_chosen(v: &[Expr]) -> bool {
    let short = |e: &Expr| digits_of(e).is_none_or(|d| d.significant < FEW);
    if !v.iter().all(short) {
        return false;
    }
    // An author who writes sqrt(3)/2 next to a half knows both exactly.
    let calculated = |e: &Expr| e.written() == WrittenNumber::No && e.to_f64() != 0.0;
    if v.iter().any(calculated) {
        return true;
    }
    let square = v.iter().fold(Expr::from(0), |sum, e| sum + e * e);
    if square.rational_ref().is_some_and(One::is_one) {
        return true;
    }
    let halves = v.iter().filter_map(|e| Some((e, digits_of(e)?.half)));
    let off: f64 = halves
        .map(|(e, half)| 2.0 * e.to_f64().abs() * half + half * half)
        .sum();
    (square.to_f64() - 1.0).abs() > off
}
