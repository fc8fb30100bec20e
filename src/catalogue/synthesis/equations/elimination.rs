//! Small systems of equations solved in place, without a new matrix for each.

/// Number of entries of a row that are processed at once.
const LANES: usize = 4;
/// Number of right sides that are solved at once.
const PAIR: usize = 2;

/// A square matrix with right sides.
#[derive(Debug, Clone, Default)]
pub struct SmallSystem {
    size: usize,
    sides: usize,
    /// Row stride: a multiple of [`LANES`], padded with zeros.
    width: usize,
    entries: Vec<f64>,
}

impl SmallSystem {
    /// Creates a system of `size` unknowns and `sides` right sides, all zero.
    #[must_use]
    pub fn new(size: usize, sides: usize) -> SmallSystem {
        let width = (size + sides.next_multiple_of(PAIR)).next_multiple_of(LANES);
        SmallSystem {
            size,
            sides,
            width,
            entries: vec![0.0; size * width],
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds to an entry. The columns of the right sides follow those of the unknowns.
    pub fn add_entry(&mut self, row: usize, column: usize, value: f64) {
        self.entries[row * self.width + column] += value;
    }

    /// Returns the value of an unknown for a right side. Before the system is solved, returns the entry of the right side in that row.
    #[must_use]
    pub fn get(&self, unknown: usize, side: usize) -> f64 {
        self.entries[unknown * self.width + self.size + side]
    }

    /// Returns the largest absolute value of an entry.
    fn largest_entry(&self) -> f64 {
        let mut most = [0.0_f64; LANES];
        let (all, _) = self.entries.as_chunks::<LANES>();
        for four in all {
            for (m, x) in most.iter_mut().zip(four) {
                *m = if x.abs() > *m { x.abs() } else { *m };
            }
        }
        most.into_iter().fold(0.0, f64::max)
    }

    /// Brings the rows to triangular form, and returns the sign of the determinant.
    fn eliminate_below(&mut self) -> Option<f64> {
        let (n, w) = (self.size, self.width);
        let least = 1e-12 * self.largest_entry();
        let mut sign = 1.0;
        for c in 0..n {
            // For non-negative numbers the order of the bits is the order of the values.
            let bits = |r: &usize| self.entries[r * w + c].abs().to_bits();
            let pivot = (c..n).max_by_key(bits)?;
            let size = self.entries[pivot * w + c].abs();
            if size <= least || !size.is_finite() {
                return None;
            }
            if pivot != c {
                sign = -sign;
                let (before, from) = self.entries.split_at_mut(pivot * w);
                before[c * w..][..w].swap_with_slice(&mut from[..w]);
            }
            let (above, below) = self.entries.split_at_mut((c + 1) * w);
            let own = &above[c * w..];
            sign *= own[c].signum();
            // Entries before the next column are not read again, and may change with their neighbours. Few lanes are unrolled.
            let reduce = match (w - (c + 1) / LANES * LANES) / LANES {
                1 => reduce_rows::<1>,
                2 => reduce_rows::<2>,
                3 => reduce_rows::<3>,
                _ => reduce_rows::<0>,
            };
            reduce(own, below, c);
        }
        Some(sign)
    }

    /// Solves for all right sides by elimination with partial pivoting, and returns the sign of the determinant. `None` if a pivot is
    /// negligible compared with the largest entry.
    ///
    /// # Complexity
    /// O(n³) for n unknowns.
    pub fn solve_all(&mut self) -> Option<f64> {
        let sign = self.eliminate_below()?;
        let (n, w) = (self.size, self.width);
        for side in (n..n + self.sides).step_by(PAIR) {
            for c in (0..n).rev() {
                let (above, own) = self.entries.split_at_mut(c * w);
                let found: [f64; PAIR] = std::array::from_fn(|k| own[side + k] / own[c]);
                own[side..side + PAIR].copy_from_slice(&found);
                for row in above.chunks_exact_mut(w) {
                    let factor = row[c];
                    let right = &mut row[side..side + PAIR];
                    (right[0], right[1]) =
                        (right[0] - factor * found[0], right[1] - factor * found[1]);
                }
            }
        }
        Some(sign)
    }
}

/// Subtracts multiples of a pivot's row from the rows below, so that its column `c` is zero there. `N` is the number of lanes from the next
/// column on, or 0 for any.
fn reduce_rows<const N: usize>(own: &[f64], below: &mut [f64], c: usize) {
    let begin = (c + 1) / LANES * LANES;
    let inverse = 1.0 / own[c];
    let (lanes, _) = own[begin..].as_chunks::<LANES>();
    let count = if N == 0 { lanes.len() } else { N };
    let lanes = &lanes[..count];
    for row in below.chunks_exact_mut(own.len()) {
        if row[c] != 0.0 {
            let factor = row[c] * inverse;
            let (row, _) = row[begin..].as_chunks_mut::<LANES>();
            for (x, o) in row[..count].iter_mut().zip(lanes) {
                *x = std::array::from_fn(|k| x[k] - factor * o[k]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::SmallSystem;

    /// 2x + y = 3 and 5, 4x - y = 9 and 1: by hand (2, -1) and (1, 3); the determinant is -6.
    #[test]
    fn both_sides_are_solved_and_the_sign_told() {
        let mut rows = SmallSystem::new(2, 2);
        let all = [[2.0, 1.0, 3.0, 5.0], [4.0, -1.0, 9.0, 1.0]];
        for (r, row) in all.iter().enumerate() {
            for (c, x) in row.iter().enumerate() {
                rows.add_entry(r, c, *x);
            }
        }
        assert_eq!(rows.solve_all(), Some(-1.0));
        let found = [0, 1].map(|side| [0, 1].map(|x| rows.get(x, side)));
        assert_eq!(found, [[2.0, -1.0], [1.0, 3.0]]);
        rows.clear();
        assert_eq!(rows.solve_all(), None);
    }
}
