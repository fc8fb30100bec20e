//! Small systems of equations solved in place, without a new matrix for each.

/// Number of entries that are processed at once.
const LANES: usize = 4;

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
        let width = (size + sides).next_multiple_of(LANES);
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

    /// Solves for all right sides by elimination with partial pivoting, and returns the sign of the determinant. `None` if a pivot is
    /// negligible compared with the largest entry.
    ///
    /// # Complexity
    /// O(n³) for n unknowns.
    pub fn solve_all(&mut self) -> Option<f64> {
        let least = 1e-12 * self.largest_entry();
        let (rows, n, sides) = (&mut self.entries[..], self.size, self.sides);
        // A constant width unrolls the loops over rows; these are the widths of structures of up to ten links with only hinges.
        match self.width {
            4 => eliminate(rows, 4, n, sides, least),
            8 => eliminate(rows, 8, n, sides, least),
            12 => eliminate(rows, 12, n, sides, least),
            width => eliminate(rows, width, n, sides, least),
        }
    }
}

/// Solves `n` rows of `w` numbers, with `sides` right sides from column `n` on, if no pivot is at most `least`.
#[inline(always)]
fn eliminate(rows: &mut [f64], w: usize, n: usize, sides: usize, least: f64) -> Option<f64> {
    let mut sign = 1.0;
    for c in 0..n {
        // For non-negative numbers the order of the bits is the order of the values.
        let pivot = (c..n).max_by_key(|r| rows[r * w + c].abs().to_bits())?;
        let size = rows[pivot * w + c].abs();
        if size <= least || !size.is_finite() {
            return None;
        }
        let (above, below) = rows.split_at_mut((c + 1) * w);
        let own = &mut above[c * w..][..w];
        if pivot != c {
            sign = -sign;
            own.swap_with_slice(&mut below[(pivot - c - 1) * w..][..w]);
        }
        sign *= own[c].signum();
        let inverse = 1.0 / own[c];
        for row in below.chunks_exact_mut(w) {
            subtract_row(row, own, c, row[c] * inverse);
        }
    }
    for c in (0..n).rev() {
        let (above, own) = rows.split_at_mut(c * w);
        let own = &mut own[..w];
        for side in n..n + sides {
            own[side] /= own[c];
        }
        own[c] = 1.0;
        for row in above.chunks_exact_mut(w) {
            subtract_row(row, own, c, row[c]);
        }
    }
    Some(sign)
}

/// Subtracts a multiple of another row, so that column `c` is zero.
#[inline(always)]
fn subtract_row(row: &mut [f64], other: &[f64], c: usize, factor: f64) {
    if factor != 0.0 {
        for (x, o) in row.iter_mut().zip(other) {
            *x -= factor * o;
        }
        row[c] = 0.0;
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
