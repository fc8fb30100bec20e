//! Exact arithmetic in rings Q[x_1, ..., x_m] / (relations), a tower of simple extensions of the rationals.
//!
//! Relation i is a monic polynomial in x_i whose coefficients are integral combinations of the monomials in the generators before it. The
//! monomials with every exponent below the degree of its relation are a basis over Q. Products of integral combinations are integral, so
//! multiplication is done on integers, over common denominators.
//!
//! Basis elements are numbered with x_1 running fastest. The ring of the first few generators is then a prefix, and an element is stored
//! as its coordinates without trailing zeros. Rational numbers have at most one coordinate.
//!
//! # Sources
//! Cohen, "A Course in Computational Algebraic Number Theory", ch. 4 (elements as polynomials).

mod element;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::linalg::modp::{Field, Residue};
pub use element::Element;

/// One generator: its relation `x^n + c[n-1] x^(n-1) + ... + c[0] = 0`.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Generator {
    /// Coefficients, lowest first, without the leading 1.
    relation: Vec<Element>,
    /// The coefficients as integers.
    integers: Vec<Vec<BigInt>>,
    /// Dimension over Q of the ring of the generators before this one.
    width: usize,
}

/// A tower of simple extensions of Q.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct NumberRing {
    steps: Vec<Generator>,
}

impl NumberRing {
    /// Creates the ring of rational numbers. O(1).
    #[must_use]
    pub fn rationals() -> NumberRing {
        NumberRing::default()
    }

    /// Returns the ring with one more generator. `relation` lists the coefficients without the leading 1, lowest first. O(length).
    ///
    /// Returns `None` if the relation has no coefficients, if a coefficient is not integral or lies outside the ring so far, or if the
    /// dimension exceeds `usize`.
    #[must_use]
    pub fn adjoin(mut self, relation: Vec<Element>) -> Option<NumberRing> {
        let width = self.dimension();
        let fits = |c: &Element| c.0.len() <= width && c.0.iter().all(BigRational::is_integer);
        if relation.is_empty() || !relation.iter().all(fits) {
            return None;
        }
        width.checked_mul(relation.len())?;
        let numerators = |c: &Element| c.0.iter().map(|q| q.numer().clone()).collect();
        self.steps.push(Generator {
            integers: relation.iter().map(numerators).collect(),
            relation,
            width,
        });
        Some(self)
    }

    /// Returns the dimension over Q, the product of the degrees. O(1).
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.steps.last().map_or(1, |s| s.width * s.relation.len())
    }

    /// Returns the number of generators. O(1).
    #[must_use]
    pub fn generators(&self) -> usize {
        self.steps.len()
    }

    /// Returns the relation of a generator, as in [`NumberRing::adjoin`]. O(1).
    ///
    /// # Panics
    /// Panics if there is no such generator.
    #[must_use]
    pub fn relation(&self, generator: usize) -> &[Element] {
        &self.steps[generator].relation
    }

    /// Returns a generator as an element. O(dimension).
    ///
    /// # Panics
    /// Panics if there is no such generator.
    #[must_use]
    pub fn generator(&self, generator: usize) -> Element {
        let step = &self.steps[generator];
        if step.relation.len() == 1 {
            return self.sub(&Element::default(), &step.relation[0]);
        }
        let mut out = vec![BigRational::zero(); step.width];
        out.push(BigRational::one());
        Element::new(out)
    }

    /// Returns true if an element has no more coordinates than the ring. O(1).
    #[must_use]
    pub fn contains(&self, a: &Element) -> bool {
        a.0.len() <= self.dimension()
    }

    /// Returns the sum. O(dimension).
    #[must_use]
    pub fn add(&self, a: &Element, b: &Element) -> Element {
        combine_entries(a, b, |x, y| *x += y)
    }

    /// Returns the difference. O(dimension).
    #[must_use]
    pub fn sub(&self, a: &Element, b: &Element) -> Element {
        combine_entries(a, b, |x, y| *x -= y)
    }

    /// Returns the product of two elements of the ring. At most O(dimension² · generators) operations on rationals; a rational factor
    /// costs O(dimension).
    ///
    /// # Panics
    /// Panics if a factor has more coordinates than the ring, see [`NumberRing::contains`].
    #[must_use]
    pub fn mul(&self, a: &Element, b: &Element) -> Element {
        if a.is_zero() || b.is_zero() {
            return Element::default();
        }
        match (a.0.as_slice(), b.0.as_slice()) {
            ([q], _) => return b.scale_by(q),
            (_, [q]) => return a.scale_by(q),
            _ => {}
        }
        let [x, y] = [a, b].map(Element::denominator);
        let product =
            self.integral_product(&a.integral_coordinates(&x), &b.integral_coordinates(&y));
        Element::from_integral(product, &(x * y))
    }

    /// Multiplies integral combinations of the monomials, given by their coordinates. Returns the coordinates of the product, possibly
    /// with trailing zeros. At most O(dimension² · generators) operations on integers; an integer factor costs O(dimension).
    ///
    /// # Panics
    /// Panics if a factor has more coordinates than the ring.
    #[must_use]
    pub fn integral_product(&self, a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
        match (a, b) {
            ([], _) | (_, []) => Vec::new(),
            ([n], others) | (others, [n]) => others.iter().map(|x| x * n).collect(),
            _ => {
                let longest = a.len().max(b.len());
                // Up to the last generator that occurs in a factor.
                let last = self.steps.iter().rposition(|s| s.width < longest);
                self.product(last.map_or(0, |i| i + 1), a, b)
            }
        }
    }

    /// Returns the product of integral combinations of the monomials in the first few generators.
    fn product(&self, generators: usize, a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
        let Some(step) = generators.checked_sub(1).map(|g| &self.steps[g]) else {
            return vec![&a[0] * &b[0]];
        };
        let (width, degree) = (step.width, step.relation.len());
        let nonzero = |(_, x): &(usize, &[BigInt])| x.iter().any(|n| !n.is_zero());
        // A polynomial in the last generator, whose coefficients are blocks of `width`.
        let mut out = vec![BigInt::zero(); (2 * degree - 1) * width];
        for (i, x) in a.chunks(width).enumerate().filter(nonzero) {
            for (j, y) in b.chunks(width).enumerate().filter(nonzero) {
                let at = &mut out[(i + j) * width..];
                if width == 1 {
                    at[0] += &x[0] * &y[0];
                } else {
                    let product = self.product(generators - 1, x, y);
                    at.iter_mut().zip(product).for_each(|(o, p)| *o += p);
                }
            }
        }
        // Powers from the degree on are reduced by the relation.
        for k in (degree..2 * degree - 1).rev() {
            let top = out.split_off(k * width);
            if top.iter().all(Zero::is_zero) {
                continue;
            }
            for (j, c) in step.integers.iter().enumerate() {
                let at = &mut out[(k - degree + j) * width..];
                match c.as_slice() {
                    [] => {}
                    [c] => at.iter_mut().zip(&top).for_each(|(o, t)| *o -= t * c),
                    c => {
                        let product = self.product(generators - 1, c, &top);
                        at.iter_mut().zip(product).for_each(|(o, p)| *o -= p);
                    }
                }
            }
        }
        out
    }

    /// Returns the inverse, or `None` if there is none (in a field: of zero). O(1) products per square root, and O(n³)
    /// rational operations for another generator of dimension n.
    #[must_use]
    pub fn inverse(&self, a: &Element) -> Option<Element> {
        match a.0.as_slice() {
            [] => return None,
            [q] => return Some(Element::from_rational(q.recip())),
            _ => {}
        }
        let step = self.steps.iter().rev().find(|s| s.width < a.0.len())?;
        let dimension = step.width * step.relation.len();
        if let [constant, linear] = &step.relation[..]
            && linear.is_zero()
        {
            // (u + v y)(u - v y) = u² - v² y², with y² the opposite of the constant.
            let (u, v) = a.0.split_at(step.width);
            let conjugate = u.iter().cloned().chain(v.iter().map(|q| -q)).collect();
            let [u, v] = [u, v].map(|part| Element::new(part.to_vec()));
            let norm = self.add(&self.mul(&u, &u), &self.mul(&self.mul(&v, &v), constant));
            return Some(self.mul(&Element::new(conjugate), &self.inverse(&norm)?));
        }
        // The combination of the products with the basis elements that is 1.
        let product = |i: usize| {
            let mut element = vec![BigRational::zero(); i + 1];
            element[i] = BigRational::one();
            self.mul(a, &Element(element))
        };
        let products: Vec<Element> = (0..dimension).map(product).collect();
        let row = |r: usize| {
            let own = products.iter().map(|p| p.0.get(r).cloned());
            let one = BigRational::from_integer(i32::from(r == 0).into());
            own.map(Option::unwrap_or_default).chain([one]).collect()
        };
        let mut rows: Vec<Vec<BigRational>> = (0..dimension).map(row).collect();
        for c in 0..dimension {
            let pivot = (c..dimension).find(|&r| !rows[r][c].is_zero())?;
            rows.swap(c, pivot);
            let scale = rows[c][c].recip();
            rows[c].iter_mut().for_each(|x| *x *= &scale);
            let head = rows[c].clone();
            for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != c) {
                let by = row[c].clone();
                row.iter_mut().zip(&head).for_each(|(x, y)| *x -= &by * y);
            }
        }
        let last = |mut row: Vec<BigRational>| row.pop().unwrap_or_default();
        Some(Element::new(rows.into_iter().map(last).collect()))
    }

    /// Returns the values of the basis elements under a homomorphism into a prime field, for the generators with given images. O(length).
    ///
    /// # Panics
    /// Panics if there are more images than generators.
    #[must_use]
    pub fn monomials(&self, field: Field, images: &[Residue]) -> Vec<Residue> {
        let mut out = vec![field.one()];
        for (step, &image) in self.steps[..images.len()].iter().zip(images) {
            let below = out.clone();
            let mut power = field.one();
            for _ in 1..step.relation.len() {
                power = field.mul(power, image);
                out.extend(below.iter().map(|&b| field.mul(b, power)));
            }
        }
        out
    }
}

fn combine_entries(
    a: &Element,
    b: &Element,
    with: impl Fn(&mut BigRational, &BigRational),
) -> Element {
    let mut out = a.0.clone();
    out.resize(a.0.len().max(b.0.len()), BigRational::zero());
    out.iter_mut().zip(&b.0).for_each(|(x, y)| with(x, y));
    Element::new(out)
}

/// Combines coordinates with others, one by one; either list may be shorter. O(length).
pub fn combine_integers(of: &mut Vec<BigInt>, by: Vec<BigInt>, with: impl Fn(&mut BigInt, BigInt)) {
    of.resize(of.len().max(by.len()), BigInt::zero());
    of.iter_mut().zip(by).for_each(|(x, y)| with(x, y));
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Returns Q(c)(y)(z) with c = 2 cos 40deg, y^2 = 2 and z^2 = 3 + c.
    fn ring() -> NumberRing {
        let int = Element::from_integer;
        NumberRing::rationals()
            .adjoin(vec![int(1), int(-3), int(0)])
            .unwrap()
            .adjoin(vec![int(-2), int(0)])
            .unwrap()
            .adjoin(vec![
                Element::new(
                    [-3, -1]
                        .map(|n| BigRational::from_integer(n.into()))
                        .to_vec(),
                ),
                int(0),
            ])
            .unwrap()
    }

    fn value(a: &Element) -> f64 {
        use num_traits::ToPrimitive;
        let c = 2.0 * 40f64.to_radians().cos();
        let (y, z) = (2f64.sqrt(), (3.0 + c).sqrt());
        let powers = [1.0, c, c * c];
        a.coordinates()
            .iter()
            .enumerate()
            .map(|(i, q)| {
                q.to_f64().unwrap()
                    * powers[i % 3]
                    * if i / 3 % 2 == 1 { y } else { 1.0 }
                    * if i / 6 == 1 { z } else { 1.0 }
            })
            .sum()
    }

    fn element() -> impl Strategy<Value = Element> {
        prop::collection::vec((-5i64..6, 1i64..4), 0..=12).prop_map(|v| {
            Element::new(
                v.into_iter()
                    .map(|(n, d)| BigRational::new(n.into(), d.into()))
                    .collect(),
            )
        })
    }

    proptest! {
        #[test]
        fn the_ring_laws_hold_and_values_agree(a in element(), b in element(), c in element()) {
            let r = ring();
            prop_assert_eq!(r.dimension(), 12);
            prop_assert_eq!(r.mul(&a, &b), r.mul(&b, &a));
            prop_assert_eq!(r.mul(&a, &r.mul(&b, &c)), r.mul(&r.mul(&a, &b), &c));
            prop_assert_eq!(r.mul(&a, &r.add(&b, &c)), r.add(&r.mul(&a, &b), &r.mul(&a, &c)));
            prop_assert!((value(&r.mul(&a, &b)) - value(&a) * value(&b)).abs() < 1e-6);
            prop_assert!((value(&r.sub(&a, &b)) - value(&a) + value(&b)).abs() < 1e-9);
            prop_assert_eq!(r.sub(&a, &a), Element::default());
            match r.inverse(&a) {
                Some(i) => prop_assert_eq!(r.mul(&a, &i), Element::from_integer(1)),
                None => prop_assert!(a.is_zero()),
            }
        }
    }

    #[test]
    fn relations_outside_the_ring_are_refused() {
        let long = Element::new(vec![BigRational::one(); 3]);
        assert!(NumberRing::rationals().adjoin(vec![long]).is_none());
        assert!(NumberRing::rationals().adjoin(Vec::new()).is_none());
        let half = Element::from_rational(BigRational::new(1.into(), 2.into()));
        assert!(NumberRing::rationals().adjoin(vec![half]).is_none());
        let r = ring();
        assert!(r.mul(&r.generator(1), &r.generator(1)) == Element::from_integer(2));
    }
}
