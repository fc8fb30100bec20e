//! Shards of a long computation that many machines share. A hash of the names of its pieces assigns them to shards.

use sha2::{Digest as _, Sha256};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// A shard of a computation: part `index` of `of`, from 0. In text it is counted from 1: `1/7`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Index of the shard.
    pub index: u64,
    /// Number of shards.
    pub of: u64,
}

/// Error for a shard that does not exist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("write a part as 1/7, the first of seven")]
pub struct NoShard;

impl Shard {
    /// The whole computation.
    pub const WHOLE: Shard = Shard { index: 0, of: 1 };

    /// Returns shard `index` of `of`, counted from 1.
    ///
    /// # Errors
    /// Returns an error if `index` is 0 or exceeds `of`.
    ///
    /// # Examples
    /// ```
    /// use ozols::shard::Shard;
    /// let shards: Vec<Shard> = (1..=3).filter_map(|n| Shard::nth_of(n, 3).ok()).collect();
    /// // Every piece belongs to exactly one shard.
    /// assert_eq!(shards.iter().filter(|s| s.has_piece("a piece")).count(), 1);
    /// ```
    pub fn nth_of(index: u64, of: u64) -> Result<Shard, NoShard> {
        match index.checked_sub(1) {
            Some(index) if index < of => Ok(Shard { index, of }),
            _ => Err(NoShard),
        }
    }

    /// Returns true if a piece with this name belongs to the shard. Every piece belongs to exactly one shard.
    #[must_use]
    pub fn has_piece(self, name: &str) -> bool {
        let digest = Sha256::digest(name);
        let mut first = [0; 8];
        first.copy_from_slice(&digest[8..16]);
        u64::from_be_bytes(first) % self.of.max(1) == self.index
    }
}

impl FromStr for Shard {
    type Err = NoShard;

    fn from_str(text: &str) -> Result<Shard, NoShard> {
        let (index, of) = text.split_once('/').ok_or(NoShard)?;
        let number = |t: &str| t.parse::<u64>().map_err(|_| NoShard);
        Shard::nth_of(number(index)?, number(of)?)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index + 1, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_in_one_part() {
        for of in 1..7 {
            let parts = |name: &str| {
                (0..of)
                    .filter(|&index| Shard { index, of }.has_piece(name))
                    .count()
            };
            assert!((0..100).all(|i| parts(&i.to_string()) == 1));
        }
    }

    #[test]
    fn parts_are_counted_from_one() {
        assert_eq!("2/7".parse(), Ok(Shard { index: 1, of: 7 }));
        assert_eq!(Shard { index: 1, of: 7 }.to_string(), "2/7");
        for wrong in ["0/7", "8/7", "1/0", "7", "a/b", "-1/2", "1/2/3"] {
            assert_eq!(wrong.parse::<Shard>(), Err(NoShard), "{wrong}");
        }
    }
}
