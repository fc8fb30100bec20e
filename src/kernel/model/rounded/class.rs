//! What the decimals of one kind, lengths or directions, say together of how they were written.

use crate::geom::expr::{Digits, End, Expr, WrittenNumber, half_of};
use num_traits::One;
use std::collections::BTreeMap;

/// Lengths with so many significant digits may have been rounded.
pub const LONG_LENGTH: usize = 4;
/// Components of directions with so many may.
pub const LONG_DIRECTION: usize = 3;

/// So many long decimals without a trailing zero are no chance.
const MANY: usize = 10;
/// A zero that is left out at the end of one decimal in ten makes its unit so much coarser.
const LOST: f64 = 10.5;
/// One in so many of the long decimals have a number of places that they are rounded to; fewer have lost zeros.
const SHARE: usize = 5;
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

impl NumberKind {
    /// How many significant digits a long one has.
    fn least(self) -> usize {
        match self {
            NumberKind::Length => LONG_LENGTH,
            NumberKind::Direction => LONG_DIRECTION,
        }
    }
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
        self.see_from(e, kind.least());
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

    /// Half the unit of a decimal of a vector, that of its own last digit; but a short one was chosen, and one that a finer vector
    /// has beside it may have lost zeros: these have the unit of most.
    fn decimal(&self, digits: Digits, of: &[Expr], kind: NumberKind) -> f64 {
        let (plain, factor) = (half_of(digits.places), digits.factor());
        let Some(most) = self.commonest() else {
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
        let long = |d: &Digits| d.significant >= kind.least();
        let all = of.iter().filter_map(digits_of).filter(long);
        let finest = all.clone().map(|d| half_of(d.places));
        let finest = finest.fold(f64::INFINITY, f64::min);
        let own = long(&digits) && {
            let lost = plain <= LOST * most && self.drops_zeros();
            // Long decimals that are all as short as this were rounded together, and so were those that many are as short as.
            let together = all.count() > 1 && finest > most;
            together || self.is_common(digits.places) || (kind == NumberKind::Direction && !lost)
        };
        match kind {
            _ if own => digits.half,
            // One direction is written with one number of places.
            NumberKind::Direction if finest.is_finite() => finest * factor,
            _ => plain.min(most) * factor,
        }
    }

    /// Whether a fifth of the long decimals have so many places.
    fn is_common(&self, places: i32) -> bool {
        let as_short = self.long.values().filter(|p| **p == places).count();
        as_short * SHARE >= self.long.len()
    }

    /// Half the units of the coordinates of a point, or of one length; `turned` where directions are decimals.
    pub(super) fn lengths(&self, v: &[Expr], turned: bool) -> Vec<f64> {
        v.iter().map(|e| self.length(e, v, turned)).collect()
    }

    fn length(&self, e: &Expr, of: &[Expr], turned: bool) -> f64 {
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
            WrittenNumber::Decimal(digits) => self.decimal(digits, of, NumberKind::Length),
        }
    }

    /// Half the unit of a long decimal; 0 of what is shorter, which was chosen.
    pub(super) fn of_long(&self, e: &Expr, kind: NumberKind) -> f64 {
        match e.written() {
            WrittenNumber::Decimal(d) if d.significant >= kind.least() && d.end != End::Float => {
                self.decimal(d, std::slice::from_ref(e), kind)
            }
            _ => 0.0,
        }
    }

    /// Half the units of the components of a direction, or of a quaternion.
    pub(super) fn direction(&self, v: &[Expr]) -> Vec<f64> {
        let chosen = !self.drops_zeros() && is_chosen(v);
        let half = |e: &Expr| match e.written() {
            WrittenNumber::No | WrittenNumber::Whole => 0.0,
            WrittenNumber::Stated(half) => half,
            WrittenNumber::Decimal(_) if chosen => 0.0,
            WrittenNumber::Decimal(digits) => self.decimal(digits, v, NumberKind::Direction),
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
