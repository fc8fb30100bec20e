//! What the decimals of one kind, lengths or directions, say together of how they were written.

use super::long::{LONG_DIRECTION, LONG_LENGTH};
use crate::geom::expr::{Digits, End, Expr, WrittenNumber, half_of};
use num_traits::One;
use std::collections::BTreeMap;

/// So many long decimals without a trailing zero are no chance.
const MANY: usize = 10;
/// A direction of decimals with fewer significant digits may have been chosen.
const FEW: usize = 3;

/// What a number is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum NumberKind {
    /// A length.
    Length,
    /// A component of a direction.
    Direction,
}

/// The numbers of a kind as they are written, equal ones once.
#[derive(Debug, Default)]
pub(super) struct NumberClass {
    /// Places of the decimals that are long, and of all that have digits behind the point, by size of the number.
    long: BTreeMap<u64, i32>,
    decimals: BTreeMap<u64, i32>,
    /// Whether any shows a trailing zero.
    zeros: bool,
    /// Whether any is a whole number other than 0.
    whole: bool,
    /// Half the unit that most have.
    most: Option<f64>,
}

impl NumberClass {
    /// Takes in a direction: where it is not chosen, its decimals count as long however few digits they have.
    pub(super) fn see_direction(&mut self, v: &[Expr]) {
        let least = if is_rounded(v) { 1 } else { LONG_DIRECTION };
        v.iter().for_each(|e| self.see_from(e, least));
    }

    /// Takes in a number.
    pub(super) fn see(&mut self, e: &Expr, kind: NumberKind) {
        let least = match kind {
            NumberKind::Length => LONG_LENGTH,
            NumberKind::Direction => LONG_DIRECTION,
        };
        self.see_from(e, least);
    }

    /// Takes in a number that is long from so many significant digits on.
    fn see_from(&mut self, e: &Expr, least: usize) {
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
        // Of equal numbers the one with the most digits says most.
        let put = |map: &mut BTreeMap<u64, i32>| {
            let places = map.entry(size.to_bits()).or_insert(digits.places);
            *places = digits.places.max(*places);
        };
        put(&mut self.decimals);
        if digits.significant >= least {
            put(&mut self.long);
        }
    }

    /// Whether any decimal is long.
    pub(super) fn is_long(&self) -> bool {
        !self.long.is_empty()
    }

    /// Whether any number is whole, and not 0.
    pub(super) fn has_whole(&self) -> bool {
        self.whole
    }

    /// Half the unit that most have: of the long ones, or of all where none is; the finer one of two that are as common.
    pub(super) fn commonest(&self) -> Option<f64> {
        self.most
    }

    /// The same, when all numbers are taken in.
    pub(super) fn counted(mut self) -> NumberClass {
        self.most = self.count();
        self
    }

    fn count(&self) -> Option<f64> {
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

    /// Whether its writer leaves out zeros at the end.
    fn drops_zeros(&self) -> bool {
        !self.zeros && self.long.len() >= MANY
    }

    /// Half the unit of a decimal.
    pub(super) fn decimal(&self, digits: Digits) -> f64 {
        let (plain, factor) = (half_of(digits.places), digits.factor());
        match self.commonest() {
            Some(most) if digits.end == End::Float => most * factor,
            // What is shorter than most was chosen, or has lost zeros.
            Some(most) if !self.zeros => plain.min(most) * factor,
            _ if digits.end == End::Float => 0.0,
            _ => digits.half,
        }
    }

    /// Half the unit of a length; `turned` where directions are decimals.
    pub(super) fn length(&self, e: &Expr, turned: bool) -> f64 {
        let whole = |factor: f64| match self.commonest() {
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
            WrittenNumber::Decimal(digits) => self.decimal(digits),
        }
    }

    /// Half the units of the components of a direction, or of a quaternion.
    pub(super) fn direction(&self, v: &[Expr]) -> Vec<f64> {
        let chosen = !self.drops_zeros() && is_chosen(v);
        // One direction is written with one number of places.
        let finest = v.iter().filter_map(digits_of);
        let finest = finest.map(|d| d.half).fold(f64::INFINITY, f64::min);
        let half = |e: &Expr| match e.written() {
            WrittenNumber::No | WrittenNumber::Whole => 0.0,
            WrittenNumber::Stated(half) => half,
            WrittenNumber::Decimal(_) if chosen => 0.0,
            WrittenNumber::Decimal(digits) => {
                let half = self.decimal(digits);
                if self.zeros { half } else { half.min(finest) }
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

/// Whether a direction is rounded, by what its components are together: two of them decimals at least, and not chosen.
pub(super) fn is_rounded(v: &[Expr]) -> bool {
    v.iter().filter(|e| digits_of(e).is_some()).count() > 1 && !is_chosen(v)
}

/// Whether a direction of short decimals is as somebody chose it: of length 1 exactly, as (0.6, 0.8, 0) is, or not rounded from
/// one of length 1, as (1.5, 2, 0).
fn is_chosen(v: &[Expr]) -> bool {
    let short = |e: &Expr| digits_of(e).is_none_or(|d| d.significant < FEW);
    if !v.iter().all(short) {
        return false;
    }
    // Who writes sqrt(3)/2 beside a half knows both.
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
