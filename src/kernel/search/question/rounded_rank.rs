//! Ranks of matrices whose numbers were rounded: what singular values decide, and what they do not.
//!
//! By Weyl's inequality, rounding moves no singular value further than it moved the matrix. Values above that bound are not zero. Values
//! below it may be zero, and are treated as zero only if there is a wide gap.

/// Singular values below this are zero in double precision, relative to the largest.
const ROUND_OFF: f64 = 1e-11;
/// Values this many times the tolerance are there in truth: a variant's joints may feel rounding more than the present ones.
const NEAR: f64 = 4.0;
/// The ratio that separates zeros disturbed by rounding from nonzero values.
const GAP: f64 = 1e3;
/// If the meaning of the digits is not decided, values below this fraction of the largest may be zero.
const LEFT_OVER: f64 = 1e-4;

/// The accuracy of the numbers of a matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Digits {
    /// What rounding can do to a singular value, relative to the largest.
    pub tolerance: f64,
    /// Whether even the rank of the present mechanism is not decided. Then small values are neither zero nor nonzero.
    pub undecided: bool,
}

/// A rank, or a range of ranks that the digits do not decide between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankRange {
    /// The least it can be.
    pub least: usize,
    /// The most it can be.
    pub most: usize,
    /// The smallest singular value above the tolerance, over the largest; 1 if there is none.
    pub kept: f64,
    /// The largest singular value below the tolerance, over the largest; 0 if there is none.
    pub dropped: f64,
}

impl RankRange {
    /// The rank of a matrix of no rows or columns, or of zeros.
    const NONE: RankRange = RankRange {
        least: 0,
        most: 0,
        kept: 1.0,
        dropped: 0.0,
    };

    /// Creates the range from singular values in descending order.
    ///
    /// # Complexity
    /// O(values).
    #[must_use]
    pub fn from_values(values: &[f64], digits: Digits) -> RankRange {
        let Some(largest) = values.first().copied().filter(|s| *s > 0.0) else {
            return RankRange::NONE;
        };
        let above = |bound: f64| values.iter().filter(|v| **v > bound * largest).count();
        let relative = |i: usize| values.get(i).map(|v| v / largest);
        let rank = above(digits.tolerance);
        let kept = rank.checked_sub(1).and_then(relative).unwrap_or(1.0);
        let dropped = relative(rank).unwrap_or(0.0);
        let left_over = if digits.undecided { LEFT_OVER } else { 0.0 };
        let trusted = left_over.max(NEAR * digits.tolerance);
        let wide = !digits.undecided && kept >= GAP * dropped;
        let clear = dropped <= ROUND_OFF || wide;
        let least_real = if digits.undecided { 0.0 } else { dropped / GAP };
        RankRange {
            least: above(trusted),
            most: if clear {
                rank
            } else {
                above(ROUND_OFF.max(least_real))
            },
            kept,
            dropped,
        }
    }

    /// Returns true if the digits decide the rank.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.least == self.most
    }

    /// Returns true if the rank is possible.
    #[must_use]
    pub(crate) fn allows_rank(&self, rank: usize) -> bool {
        (self.least..=self.most).contains(&rank)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(values: &[f64], tolerance: f64, undecided: bool) -> (usize, usize) {
        let digits = Digits {
            tolerance,
            undecided,
        };
        let r = RankRange::from_values(values, digits);
        (r.least, r.most)
    }

    #[test]
    fn a_wide_gap_decides_and_a_narrow_one_does_not() {
        // Zeros disturbed by rounding to six decimals.
        assert_eq!(range(&[2.0, 0.1, 1e-6, 3e-7], 1e-5, false), (2, 2));
        // The same in three decimals: 0.02 and 0.002 may be anything.
        assert_eq!(range(&[2.0, 0.1, 0.002, 0.0], 0.01, false), (2, 3));
        // Above what rounding can do: there in truth, whatever the gap.
        assert_eq!(range(&[1.0, 1e-4, 0.0], 1e-5, false), (2, 2));
        // Just above it.
        assert_eq!(range(&[1.0, 2e-5, 0.0], 1e-5, false), (1, 2));
        // Left over from six decimals, or there, of twelve.
        assert_eq!(range(&[1.0, 0.5, 1e-6], 1e-9, true), (2, 3));
        assert_eq!(range(&[1.0, 0.5, 1e-6], 1e-5, true), (2, 3));
        assert_eq!(range(&[0.0, 0.0], 1e-9, false), (0, 0));
        assert_eq!(range(&[], 1e-9, false), (0, 0));
    }
}
