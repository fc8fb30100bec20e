//! Numbers in the data of a page.

use serde::{Serialize, Serializer};

/// A number; whole ones without a `.0`, and null where it is none.
#[derive(Clone, Copy)]
pub(super) struct PageNumber(f64);

impl PageNumber {
    /// To five significant digits.
    pub(super) fn measured(x: f64) -> PageNumber {
        PageNumber(format!("{x:.4e}").parse().unwrap_or(f64::NAN))
    }

    /// A cost in thousandths.
    #[allow(clippy::cast_precision_loss, reason = "costs are small")]
    pub(super) fn cost(milli: i64) -> PageNumber {
        PageNumber(milli as f64 / 1000.0)
    }
}

impl Serialize for PageNumber {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[allow(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
        if self.0.fract() == 0.0 && self.0.abs() < 1e15 {
            to.serialize_i64(self.0 as i64)
        } else {
            to.serialize_f64(self.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PageNumber;

    #[test]
    fn numbers_are_short() {
        let of = |x| serde_json::to_string(&PageNumber::measured(x)).unwrap();
        assert_eq!(of(2.0), "2");
        assert_eq!(of(0.022_345_678), "0.022346");
        assert_eq!(of(f64::NAN), "null");
        assert_eq!(
            serde_json::to_string(&PageNumber::cost(12_500)).unwrap(),
            "12.5"
        );
    }
}
