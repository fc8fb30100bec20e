//! Exact arithmetic in rings Q[x_1, ..., x_m] / (monic relations), a tower of simple extensions of the rationals.
//!
//! Relation i is a monic polynomial in x_i whose coefficients lie in the ring of the generators before it, so that
//! the monomials with every exponent below its degree are a basis over Q. Basis elements are numbered with x_1 running
//! fastest: the ring of the first few generators is then a prefix, and an element is kept as its coordinates without
//! trailing zeros. Rational numbers have one coordinate at most.
//!
//! # Sources
//! Cohen, "A Course in Computational Algebraic Number Theory", ch. 4 (elements as polynomials).

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::linalg::modp::{Field, Residue};

/// An element of a [`NumberRing`], as its coordinates without trailing zeros; the default is 0. Equal elements have equal
/// coordinates.
#[derive(Debug, Clone, PartialEq, Eq, Default, Hash)]
pub struct Element(Vec<BigRational>);

impl Element {
    /// The element with the given coordinates. O(length).
    #[must_use]
    pub fn new(mut coordinates: Vec<BigRational>) -> Element {
        while coordinates.last().is_some_and(Zero::is_zero) {
            coordinates.pop();
        }
        Element(coordinates)
    }

    /// A rational number. O(1).
    #[must_use]
    pub fn rational(value: BigRational) -> Element {
        Element::new(vec![value])
    }

    /// A whole number. O(1).
    #[must_use]
    pub fn integer(value: i64) -> Element {
        Element::rational(BigRational::from_integer(BigInt::from(value)))
    }

    /// The coordinates, without trailing zeros. O(1).
    #[must_use]
    pub fn coordinates(&self) -> &[BigRational] {
        &self.0
    }

    /// Whether this is 0. O(1).
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The rational this is, if it is one. O(1).
    #[must_use]
    pub fn as_rational(&self) -> Option<BigRational> {
        match self.0.as_slice() {
            [] => Some(BigRational::zero()),
            [q] => Some(q.clone()),
            _ => None,
        }
    }

    /// The image under a homomorphism, from [`NumberRing::monomials`]; `None` where the prime divides a denominator, or
    /// the monomials are too few. O(length).
    #[must_use]
    pub fn image(&self, field: Field, monomials: &[Residue]) -> Option<Residue> {
        if self.0.len() > monomials.len() {
            return None;
        }
        self.0
            .iter()
            .zip(monomials)
            .filter(|(q, _)| !q.is_zero())
            .try_fold(field.zero(), |sum, (q, &m)| {
                Some(field.add(sum, field.mul(field.from_rational(q)?, m)))
            })
    }

    fn scaled(&self, by: &BigRational) -> Element {
        if by.is_zero() {
            return Element::default();
        }
        if by.is_one() {
            return self.clone();
        }
        let times = |q: &BigRational| {
            if q.is_zero() {
                BigRational::zero()
            } else {
                q * by
            }
        };
        Element(self.0.iter().map(times).collect())
    }

    /// `self += other · x^k`, for a generator `x` whose powers are `width` coordinates apart.
    fn accumulate(&mut self, other: &Element, offset: usize) {
        if other.is_zero() {
            return;
        }
        let needed = offset + other.0.len();
        if self.0.len() < needed {
            self.0.resize(needed, BigRational::zero());
        }
        for (a, b) in self.0[offset..].iter_mut().zip(&other.0) {
            if !b.is_zero() {
                *a += b;
            }
        }
    }
}

/// One generator: its relation `x^n + c[n-1] x^(n-1) + ... + c[0] = 0`.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Step {
    /// Coefficients, lowest first, the leading 1 left out.
    relation: Vec<Element>,
    /// Dimension over Q of the ring of the generators before this one.
    width: usize,
}

/// A tower of simple extensions of Q.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct NumberRing {
    steps: Vec<Step>,
}

impl NumberRing {
    /// The rational numbers. O(1).
    #[must_use]
    pub fn rationals() -> NumberRing {
        NumberRing::default()
    }

    /// The ring with one more generator, or `None` where the relation has no coefficients, one that lies outside the
    /// ring so far, or a dimension beyond `usize`. `relation` lists the coefficients, lowest first, the leading 1 left
    /// out. O(length).
    #[must_use]
    pub fn adjoin(mut self, relation: Vec<Element>) -> Option<NumberRing> {
        let width = self.dimension();
        if relation.is_empty() || relation.iter().any(|c| c.0.len() > width) {
            return None;
        }
        width.checked_mul(relation.len())?;
        self.steps.push(Step { relation, width });
        Some(self)
    }

    /// Dimension over Q, the product of the degrees. O(1).
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.steps.last().map_or(1, |s| s.width * s.relation.len())
    }

    /// Number of generators. O(1).
    #[must_use]
    pub fn generators(&self) -> usize {
        self.steps.len()
    }

    /// The relation of a generator, as in [`NumberRing::adjoin`]. O(1).
    ///
    /// # Panics
    /// Where there is no such generator.
    #[must_use]
    pub fn relation(&self, generator: usize) -> &[Element] {
        &self.steps[generator].relation
    }

    /// A generator as an element. O(dimension).
    ///
    /// # Panics
    /// Where there is no such generator.
    #[must_use]
    pub fn generator(&self, generator: usize) -> Element {
        let step = &self.steps[generator];
        if step.relation.len() == 1 {
            return self.sub(&Element::default(), &step.relation[0]);
        }
        let mut out = Element::default();
        out.accumulate(&Element::integer(1), step.width);
        out
    }

    /// Whether an element has no more coordinates than the ring. O(1).
    #[must_use]
    pub fn contains(&self, a: &Element) -> bool {
        a.0.len() <= self.dimension()
    }

    /// Sum. O(dimension).
    #[must_use]
    pub fn add(&self, a: &Element, b: &Element) -> Element {
        let mut out = a.0.clone();
        out.resize(a.0.len().max(b.0.len()), BigRational::zero());
        for (x, y) in out.iter_mut().zip(&b.0) {
            *x += y;
        }
        Element::new(out)
    }

    /// Difference. O(dimension).
    #[must_use]
    pub fn sub(&self, a: &Element, b: &Element) -> Element {
        let mut out = a.0.clone();
        out.resize(a.0.len().max(b.0.len()), BigRational::zero());
        for (x, y) in out.iter_mut().zip(&b.0) {
            *x -= y;
        }
        Element::new(out)
    }

    /// Product of two elements of the ring. O(dimension² · generators) operations on rationals at most; a rational
    /// factor costs O(dimension).
    #[must_use]
    pub fn mul(&self, a: &Element, b: &Element) -> Element {
        if a.is_zero() || b.is_zero() {
            return Element::default();
        }
        match (a.0.as_slice(), b.0.as_slice()) {
            ([q], _) => return b.scaled(q),
            (_, [q]) => return a.scaled(q),
            _ => {}
        }
        let longest = a.0.len().max(b.0.len());
        // The last generator that occurs in a factor; there is one, as both are longer than a rational.
        let Some(step) = self.steps.iter().rposition(|s| s.width < longest) else {
            return Element::default();
        };
        let width = self.steps[step].width;
        let (x, y) = (blocks(a, width), blocks(b, width));
        let mut product = vec![Element::default(); x.len() + y.len() - 1];
        for (i, p) in x.iter().enumerate().filter(|(_, p)| !p.is_zero()) {
            for (j, q) in y.iter().enumerate().filter(|(_, q)| !q.is_zero()) {
                product[i + j].accumulate(&self.mul(p, q), 0);
            }
        }
        self.reduced(product, step)
    }

    /// A polynomial in the generator of a step, brought below its degree by its relation.
    fn reduced(&self, mut polynomial: Vec<Element>, step: usize) -> Element {
        let Step { relation, width } = &self.steps[step];
        let degree = relation.len();
        while polynomial.len() > degree {
            let Some(top) = polynomial.pop() else { break };
            let top = Element::new(top.0);
            if top.is_zero() {
                continue;
            }
            let low = polynomial.len() - degree;
            for (c, at) in relation.iter().zip(&mut polynomial[low..]) {
                *at = self.sub(at, &self.mul(c, &top));
            }
        }
        let mut out = Element::default();
        for (i, c) in polynomial.into_iter().enumerate() {
            out.accumulate(&Element::new(c.0), i * width);
        }
        Element::new(out.0)
    }

    /// The inverse, or `None` where there is none (in a field: of zero). By Euclid's algorithm on polynomials over the
    /// ring below: O(degree²) operations there a generator.
    #[must_use]
    pub fn inverse(&self, a: &Element) -> Option<Element> {
        match a.0.as_slice() {
            [] => return None,
            [q] => return Some(Element::rational(q.recip())),
            _ => {}
        }
        let step = self.steps.iter().rposition(|s| s.width < a.0.len())?;
        let Step { relation, width } = &self.steps[step];
        let mut modulus = relation.clone();
        modulus.push(Element::integer(1));
        // Invariant: r ≡ t · a modulo the relation.
        let (mut r0, mut r1) = (modulus, blocks(a, *width));
        let (mut t0, mut t1) = (Vec::new(), vec![Element::integer(1)]);
        while r1.len() > 1 {
            let (quotient, rest) = self.divided(r0, &r1)?;
            let t = self.poly_sub(t0, &self.poly_mul(&quotient, &t1));
            (r0, r1) = (r1, rest);
            (t0, t1) = (t1, t);
        }
        let scale = self.inverse(r1.first()?)?;
        let scaled = t1.iter().map(|c| self.mul(c, &scale)).collect();
        Some(self.reduced(scaled, step))
    }

    /// Values of the basis elements under a homomorphism into a prime field, of those made of the generators whose
    /// images are given. O(length).
    ///
    /// # Panics
    /// Where more images are given than there are generators.
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

    fn poly_mul(&self, a: &[Element], b: &[Element]) -> Vec<Element> {
        let mut out = vec![Element::default(); (a.len() + b.len()).saturating_sub(1)];
        for (i, p) in a.iter().enumerate() {
            for (j, q) in b.iter().enumerate() {
                out[i + j] = self.add(&out[i + j], &self.mul(p, q));
            }
        }
        out
    }

    fn poly_sub(&self, mut a: Vec<Element>, b: &[Element]) -> Vec<Element> {
        a.resize(a.len().max(b.len()), Element::default());
        for (x, y) in a.iter_mut().zip(b) {
            *x = self.sub(x, y);
        }
        trimmed(a)
    }

    /// Quotient and remainder of polynomials; `None` where the divisor's leading coefficient has no inverse.
    fn divided(&self, a: Vec<Element>, b: &[Element]) -> Option<(Vec<Element>, Vec<Element>)> {
        let lead = self.inverse(b.last()?)?;
        let mut rest = trimmed(a);
        let mut quotient = vec![Element::default(); (rest.len() + 1).saturating_sub(b.len())];
        while rest.len() >= b.len() {
            let low = rest.len() - b.len();
            let q = self.mul(rest.last()?, &lead);
            for (x, y) in rest[low..].iter_mut().zip(b) {
                *x = self.sub(x, &self.mul(&q, y));
            }
            quotient[low] = q;
            rest.pop();
            rest = trimmed(rest);
        }
        Some((quotient, rest))
    }
}

/// The coefficients of an element as a polynomial in a generator whose powers are `width` coordinates apart.
fn blocks(a: &Element, width: usize) -> Vec<Element> {
    a.0.chunks(width)
        .map(|c| Element::new(c.to_vec()))
        .collect()
}

fn trimmed(mut polynomial: Vec<Element>) -> Vec<Element> {
    while polynomial.last().is_some_and(Element::is_zero) {
        polynomial.pop();
    }
    polynomial
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Q(c)(y)(z) with c = 2 cos 40deg, y^2 = 2 and z^2 = 3 + c.
    fn ring() -> NumberRing {
        let int = Element::integer;
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
                Some(i) => prop_assert_eq!(r.mul(&a, &i), Element::integer(1)),
                None => prop_assert!(a.is_zero()),
            }
        }
    }

    #[test]
    fn relations_outside_the_ring_are_refused() {
        let long = Element::new(vec![BigRational::one(); 3]);
        assert!(NumberRing::rationals().adjoin(vec![long]).is_none());
        assert!(NumberRing::rationals().adjoin(Vec::new()).is_none());
        let r = ring();
        assert!(r.mul(&r.generator(1), &r.generator(1)) == Element::integer(2));
    }
}
