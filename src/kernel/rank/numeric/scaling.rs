//! J in floating point, either unscaled or scaled so that the unit of length and the length of axes do not matter.

use crate::closure::Closure;
use crate::geom::Reals;
use ozols_dense::{Matrix, norm};

/// Returns the unscaled J: 6k × f, lengths in the file's unit, about the global origin.
#[must_use]
pub(crate) fn as_it_stands(closure: &Closure<f64>) -> Matrix {
    let columns = closure.dense_columns(&Reals);
    Matrix::from_fn(closure.rows(), columns.len(), |r, c| columns[c][r])
}

/// Scaling of J.
#[derive(Debug, Clone)]
pub struct Scaling {
    /// Reference point of the twists, in space.
    middle: Option<[f64; 3]>,
    /// Number of components of a twist.
    components: usize,
    /// Divisor of lengths.
    length: f64,
    /// Divisors of columns, applied afterwards.
    columns: Vec<f64>,
}

impl Scaling {
    /// Computes the scaling of a J: about the middle of the joints, with columns of unit length. Lengths are divided by
    /// half the diagonal of the joints' bounding box, or by the longest translation of a unit turn (such as a long
    /// pitch).
    #[must_use]
    pub fn of_closure(closure: &Closure<f64>) -> Scaling {
        let turns = closure.dim / 2;
        let mut scaling = Scaling {
            middle: closure
                .extent
                .filter(|_| closure.dim == 6)
                .map(|e| e.middle),
            components: closure.dim,
            length: closure.extent.map_or(1.0, |e| e.length),
            columns: Vec::new(),
        };
        let arm = closure
            .columns
            .iter()
            .map(|c| {
                let t = scaling.about_middle(&c.twist);
                (norm(&t[..turns]), norm(&t[turns..]))
            })
            .filter(|(turn, _)| *turn > 0.0)
            .map(|(turn, shift)| shift / turn)
            .fold(0.0, f64::max);
        scaling.length = scaling.length.max(arm);
        scaling.columns = closure
            .columns
            .iter()
            .map(|c| {
                let size = norm(&scaling.length_of(&c.twist));
                if size > 0.0 { size } else { 1.0 }
            })
            .collect();
        scaling
    }

    /// Returns the divisor of lengths.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Returns a twist about the middle.
    fn about_middle(&self, twist: &[f64]) -> Vec<f64> {
        let mut t = twist.to_vec();
        if let (Some(c), [w0, w1, w2, v0, v1, v2]) = (self.middle, t.as_mut_slice()) {
            // v + ω × c
            *v0 += *w1 * c[2] - *w2 * c[1];
            *v1 += *w2 * c[0] - *w0 * c[2];
            *v2 += *w0 * c[1] - *w1 * c[0];
        }
        t
    }

    fn length_of(&self, twist: &[f64]) -> Vec<f64> {
        let mut t = self.about_middle(twist);
        let turns = t.len() / 2;
        t[turns..].iter_mut().for_each(|x| *x /= self.length);
        t
    }

    /// Scales a twist of any joint to unit length, with the numbers after it.
    pub fn scale_to_unit(&self, column: &mut [f64]) {
        // Six components, or three in a plane; entries of couplings follow them.
        let twist = self.length_of(&column[..self.components]);
        let size = norm(&twist);
        column[..twist.len()].copy_from_slice(&twist);
        if size > 0.0 {
            column.iter_mut().for_each(|x| *x /= size);
        }
    }

    /// Returns a twist of column `c`, scaled like J.
    #[must_use]
    pub fn scale_column(&self, c: usize, twist: &[f64]) -> Vec<f64> {
        let mut t = self.length_of(twist);
        t.iter_mut().for_each(|x| *x /= self.columns[c]);
        t
    }
}

/// Returns J about the middle of the mechanism, with lengths relative to its size and columns of unit length.
#[must_use]
pub fn scaled_matrix(closure: &Closure<f64>) -> Matrix {
    let scaling = Scaling::of_closure(closure);
    let columns: Vec<Vec<f64>> = closure
        .columns
        .iter()
        .enumerate()
        .map(|(c, column)| scaling.scale_column(c, &column.twist))
        .collect();
    let mut matrix = Matrix::from_fn(closure.rows(), columns.len(), |r, c| {
        let contour = closure.contours.get(r / closure.dim);
        match contour.and_then(|k| k.direction_of(closure.columns[c].joint)) {
            None => 0.0,
            Some(true) => columns[c][r % closure.dim],
            Some(false) => -columns[c][r % closure.dim],
        }
    });
    // Rows of couplings refer to the speeds of the scaled columns, which have unit length.
    for (r, coupling) in (closure.contour_rows()..).zip(&closure.couplings) {
        let entries = coupling
            .entries
            .each_ref()
            .map(|(c, x)| (*c, x / scaling.columns[*c]));
        let size = entries[0].1.hypot(entries[1].1);
        for (c, x) in entries {
            matrix[(r, c)] = x / size;
        }
    }
    matrix
}

/// A numeric rank with the gap it is based on.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct NumericRank {
    /// Number of values above the tolerance.
    pub rank: usize,
    /// The smallest kept value over the largest; 1 if no value is kept.
    pub kept: f64,
    /// The largest dropped value over the largest; 0 if no value is dropped.
    pub dropped: f64,
}

/// Returns the rank that values (of any order and sign) have at a relative tolerance.
///
/// # Examples
/// ```
/// use ozols::rank::numeric::scaling::rank_of_values;
/// let found = rank_of_values(vec![4.0, 2.0, 1e-15], 1e-9);
/// assert_eq!((found.rank, found.kept), (2, 0.5));
/// ```
#[must_use]
pub fn rank_of_values(mut values: Vec<f64>, tolerance: f64) -> NumericRank {
    values.iter_mut().for_each(|v| *v = v.abs());
    values.sort_by(|a, b| b.total_cmp(a));
    let largest = values.first().copied().unwrap_or(0.0);
    let rank = if largest > 0.0 {
        values.iter().filter(|&&v| v > tolerance * largest).count()
    } else {
        0
    };
    let relative = |i: usize| values.get(i).map(|v| v / largest);
    NumericRank {
        rank,
        kept: rank.checked_sub(1).and_then(relative).unwrap_or(1.0),
        dropped: relative(rank).filter(|_| largest > 0.0).unwrap_or(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::vector::cross;

    /// A turn about an axis through c has v = c × ω at the origin and zero at c, for any direction of the axis.
    #[test]
    fn a_turn_about_the_middle_leaves_it_where_it_is() {
        let c = [2.0, 3.0, 5.0];
        let scaling = Scaling {
            middle: Some(c),
            components: 6,
            length: 1.0,
            columns: Vec::new(),
        };
        for w in [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [1.0, -2.0, 4.0],
        ] {
            let found = scaling.about_middle(&[w, cross(c, w)].concat());
            assert_eq!(found, [w, [0.0; 3]].concat());
        }
    }
}
