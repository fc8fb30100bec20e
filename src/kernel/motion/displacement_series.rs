//! Rigid displacements along a motion. Their entries are power series of one variable t over a prime field, truncated
//! at an order.
//!
//! # Sources
//! Products of exponentials: Brockett, "Robotic manipulators and the product of exponentials formula" (1984). Their
//! series along a motion: Müller, "Higher-order analysis of kinematic singularities", J. Mechanisms Robotics 8 (2016).

use crate::closure::twist::Twist;
use crate::linalg::modp::{Field, Residue};

/// The coefficients of t⁰, t¹, ... of a number.
pub(crate) type Series = Vec<Residue>;

/// Three rows of a rotation, each followed by its component of the translation.
type Term = [[Residue; 4]; 3];

/// A displacement as a power series; its coefficient of t⁰ is the identity.
#[derive(Debug, Clone)]
pub(crate) struct DisplacementSeries {
    field: Field,
    /// The coefficients of t⁰, t¹, ..., up to the order.
    terms: Vec<Term>,
}

impl DisplacementSeries {
    /// Returns the identity displacement.
    pub(crate) fn identity(field: Field, order: usize) -> Self {
        let mut terms = vec![Term::default(); order];
        if let Some(first) = terms.first_mut() {
            (0..3).for_each(|i| first[i][i] = field.one());
        }
        DisplacementSeries { field, terms }
    }

    /// Returns exp(q(t)·s) for a twist s and a coordinate q with q(0) = 0. This is the sum of the powers of the twist's
    /// matrix, each times that power of q over its factorial.
    ///
    /// # Complexity
    /// O(m³) field operations for the order m.
    pub(crate) fn exp(field: Field, s: &Twist<Residue>, q: &[Residue]) -> Self {
        let order = q.len();
        let mut out = Self::identity(field, order);
        let mut power = out.terms.first().copied().unwrap_or_default();
        let hat = twist_matrix(field, s);
        let mut factor: Series = vec![0; order];
        factor.iter_mut().take(1).for_each(|x| *x = field.one());
        for k in 1..order {
            power = product(field, &power, &hat);
            let part = field.inv(field.from_i64(i64::try_from(k).unwrap_or(i64::MAX)));
            factor = series_product(field, &factor, q);
            factor.iter_mut().for_each(|x| *x = field.mul(*x, part));
            for (term, &x) in out.terms.iter_mut().zip(&factor) {
                add_multiple(field, term, &power, x);
            }
        }
        out
    }

    /// Returns the product of this displacement and another that follows it in the moved frame.
    pub(crate) fn then(&self, next: &Self) -> Self {
        let f = self.field;
        let mut terms = vec![Term::default(); self.terms.len()];
        for (i, a) in self.terms.iter().enumerate() {
            for (j, b) in next.terms.iter().enumerate().take(self.terms.len() - i) {
                let mut of = product(f, a, b);
                // The last row of a displacement has only the coefficient of t⁰.
                if j == 0 {
                    (0..3).for_each(|r| of[r][3] = f.add(of[r][3], a[r][3]));
                }
                add_multiple(f, &mut terms[i + j], &of, f.one());
            }
        }
        DisplacementSeries { field: f, terms }
    }

    /// Returns the inverse displacement.
    pub(crate) fn inverse(&self) -> Self {
        let f = self.field;
        // The transposed rotation, and the translation rotated back by it.
        let turned = |t: &Term| -> Term { [0, 1, 2].map(|i| [t[0][i], t[1][i], t[2][i], 0]) };
        let mut terms: Vec<Term> = self.terms.iter().map(turned).collect();
        for (k, term) in terms.iter_mut().enumerate() {
            for (i, row) in term.iter_mut().enumerate() {
                let products = (0..=k)
                    .flat_map(|d| (0..3).map(move |r| (d, r)))
                    .map(|(d, r)| (self.terms[d][r][i], self.terms[k - d][r][3]));
                row[3] = f.neg(f.sum_of_products(products));
            }
        }
        DisplacementSeries { field: f, terms }
    }

    /// Returns a twist (ω; v) moved by the displacement: (Rω; p × Rω + Rv) for the rotation R and the translation p,
    /// one for each power of t.
    pub(crate) fn carry_twist(&self, s: &Twist<Residue>) -> Vec<Twist<Residue>> {
        let f = self.field;
        let times = |t: &Term, v: &[Residue]| [0, 1, 2].map(|i| f.dot(&t[i][..3], v));
        let turned: Vec<[Residue; 3]> = self.terms.iter().map(|t| times(t, &s[..3])).collect();
        let of = |(k, term): (usize, &Term)| {
            let mut v = times(term, &s[3..]);
            for (shift, w) in self.terms.iter().zip(turned[..=k].iter().rev()) {
                let p = [0, 1, 2].map(|i| shift[i][3]);
                for (i, x) in v.iter_mut().enumerate() {
                    let (a, b) = ((i + 1) % 3, (i + 2) % 3);
                    *x = f.add(*x, f.difference_of_products(p[a], w[b], p[b], w[a]));
                }
            }
            let [a, b, c] = turned[k];
            [a, b, c, v[0], v[1], v[2]]
        };
        self.terms.iter().enumerate().map(of).collect()
    }

    /// Returns the twist whose matrix is the coefficient of t^k. It is a twist if those of t¹ to t^(k-1) vanish.
    pub(crate) fn twist_of_order(&self, k: usize) -> Twist<Residue> {
        self.terms.get(k).map_or([0; 6], twist_of)
    }
}

/// Returns a vector of series times 1, t, t², ..., truncated at its order: the coefficients of t⁰ first, then those of
/// t¹, and so on.
pub(crate) fn shifted_multiples(terms: &[impl AsRef<[Residue]>]) -> Vec<Vec<Residue>> {
    let width = terms.first().map_or(0, |t| t.as_ref().len());
    let shifted = |by: usize| {
        let zeros = std::iter::repeat_n(0, by * width);
        let rest = terms[..terms.len() - by].iter().flat_map(|t| t.as_ref());
        zeros.chain(rest.copied()).collect()
    };
    (0..terms.len()).map(shifted).collect()
}

/// Returns the matrix of a twist (ω; v): the rows of ω's cross product, each with its component of v.
fn twist_matrix(f: Field, s: &Twist<Residue>) -> Term {
    let [x, y, z, u, v, w] = *s;
    [
        [0, f.neg(z), y, u],
        [z, 0, f.neg(x), v],
        [f.neg(y), x, 0, w],
    ]
}

/// Returns the twist of a matrix made by [`hat`].
fn twist_of(t: &Term) -> Twist<Residue> {
    [t[2][1], t[0][2], t[1][0], t[0][3], t[1][3], t[2][3]]
}

/// Returns the product of two matrices whose last rows are zero.
fn product(f: Field, a: &Term, b: &Term) -> Term {
    let entry = |i: usize, j: usize| f.dot(&a[i][..3], &[b[0][j], b[1][j], b[2][j]]);
    [0, 1, 2].map(|i| [0, 1, 2, 3].map(|j| entry(i, j)))
}

/// Adds a multiple of a matrix.
fn add_multiple(f: Field, sum: &mut Term, more: &Term, by: Residue) {
    if by != 0 {
        let (sum, more) = (sum.as_flattened_mut(), more.as_flattened());
        f.add_multiple(sum, by, more);
    }
}

/// Returns the product of two series of one order, truncated there.
fn series_product(f: Field, a: &[Residue], b: &[Residue]) -> Series {
    let of = |k: usize| {
        let pairs = a[..=k].iter().copied().zip(b[..=k].iter().rev().copied());
        f.sum_of_products(pairs)
    };
    (0..a.len()).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::modp::is_prime;

    fn field() -> Field {
        Field::new((1 << 61..).find(|&n| is_prime(n)).unwrap())
    }

    fn of(f: Field, numbers: [i64; 6]) -> Twist<Residue> {
        numbers.map(|x| f.from_i64(x))
    }

    /// Checks a turn about the z axis by q = t: R = 1 + t ẑ + t² ẑ²/2 + ..., so that x turns to (1 - t²/2, t, 0).
    #[test]
    fn a_turn_is_its_taylor_series() {
        let f = field();
        let q = [0, f.one(), 0, 0];
        let turn = DisplacementSeries::exp(f, &of(f, [0, 0, 1, 0, 0, 0]), &q);
        let x = turn.carry_twist(&of(f, [0, 0, 0, 1, 0, 0]));
        let (half, sixth) = (f.inv(f.from_i64(2)), f.inv(f.from_i64(6)));
        let expected = [
            [0, 0, 0, f.one(), 0, 0],
            [0, 0, 0, 0, f.one(), 0],
            [0, 0, 0, f.neg(half), 0, 0],
            [0, 0, 0, 0, f.neg(sixth), 0],
        ];
        assert_eq!(x, expected);
    }

    #[test]
    fn a_displacement_and_its_inverse_cancel() {
        let f = field();
        let q = |a: i64, b: i64| [0, f.from_i64(a), f.from_i64(b), f.from_i64(a - b)];
        let one = DisplacementSeries::exp(f, &of(f, [1, 2, 3, 4, 5, 6]), &q(2, 7));
        let two = DisplacementSeries::exp(f, &of(f, [0, 1, -1, 3, 0, 2]), &q(-1, 3));
        let both = one.then(&two);
        let none = both.then(&both.inverse());
        assert_eq!(none.terms, DisplacementSeries::identity(f, 4).terms);
        // Applying two displacements in turn is the same as applying their product.
        let s = of(f, [3, 1, 4, 1, 5, 9]);
        let second = two.carry_twist(&s);
        let of_one: Vec<_> = second.iter().map(|s| one.carry_twist(s)).collect();
        let sum = |k: usize| -> Twist<Residue> {
            let parts = (0..=k).map(|i| of_one[i][k - i]);
            parts.fold([0; 6], |a, b| std::array::from_fn(|i| f.add(a[i], b[i])))
        };
        assert_eq!(both.carry_twist(&s), [0, 1, 2, 3].map(sum));
    }
}
