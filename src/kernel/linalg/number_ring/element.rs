//! Elements of number rings: coordinates in the basis of monomials.

use crate::linalg::modp::{Field, Residue};
use crate::linalg::{common_denominator, whole_over};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// An element of a ring, as its coordinates without trailing zeros; the default is 0. Equal elements have equal
/// coordinates.
#[derive(Debug, Clone, PartialEq, Eq, Default, Hash)]
pub struct Element(pub(super) Vec<BigRational>);

impl Element {
    /// Creates the element with the given coordinates. O(length).
    #[must_use]
    pub fn new(mut coordinates: Vec<BigRational>) -> Element {
        while coordinates.last().is_some_and(Zero::is_zero) {
            coordinates.pop();
        }
        Element(coordinates)
    }

    /// Creates the element of a rational number. O(1).
    #[must_use]
    pub fn from_rational(value: BigRational) -> Element {
        Element::new(vec![value])
    }

    /// Creates the element of a whole number. O(1).
    #[must_use]
    pub fn from_integer(value: i64) -> Element {
        Element::from_rational(BigRational::from_integer(BigInt::from(value)))
    }

    /// Returns the coordinates, without trailing zeros. O(1).
    #[must_use]
    pub fn coordinates(&self) -> &[BigRational] {
        &self.0
    }

    /// Returns true if the element is 0. O(1).
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the element as a rational number, if it is one. O(1).
    #[must_use]
    pub fn as_rational(&self) -> Option<BigRational> {
        match self.0.as_slice() {
            [] => Some(BigRational::zero()),
            [q] => Some(q.clone()),
            _ => None,
        }
    }

    /// Returns the image under a homomorphism, from the images of the ring's monomials. Returns `None` if the prime
    /// divides a denominator, or if there are too few monomials. O(length).
    #[must_use]
    pub fn image_in(&self, field: Field, monomials: &[Residue]) -> Option<Residue> {
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

    pub(super) fn scale_by(&self, by: &BigRational) -> Element {
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

    /// Returns the least common denominator of the coordinates. See [`common_denominator`].
    #[must_use]
    pub fn denominator(&self) -> BigInt {
        common_denominator(&self.0)
    }

    /// Returns the coordinates times a common multiple of their denominators. O(length).
    #[must_use]
    pub fn integral_coordinates(&self, multiple: &BigInt) -> Vec<BigInt> {
        self.0.iter().map(|q| whole_over(q, multiple)).collect()
    }

    /// Returns the element of integral coordinates over a denominator. O(length) greatest common divisors.
    pub(super) fn from_integral(numerators: Vec<BigInt>, denominator: &BigInt) -> Element {
        let fraction = |n: BigInt| {
            if n.is_zero() {
                BigRational::zero()
            } else {
                BigRational::new(n, denominator.clone())
            }
        };
        Element::new(numerators.into_iter().map(fraction).collect())
    }
}
