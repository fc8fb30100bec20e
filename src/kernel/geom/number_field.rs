//! The real number field that exact expressions generate, in characteristic 0.
//!
//! This uses the classification of [`super::exact`], with N a multiple of 4 and of every angle's denominator. The field
//! is Q(c)(roots) with c = 2 cos(2π/N) of degree φ(N)/2. Roots of primes that divide N are Gauss sums in c, and all
//! other roots are adjoined, each of degree 2.
//!
//! # Sources
//! Ireland & Rosen, "A Classical Introduction to Modern Number Theory", ch. 6 (quadratic Gauss sums).

pub(crate) mod splitting;

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::One;

use super::Scalars;
use super::exact::ExactError;
use super::exact::eval::{self, Target};
use super::exact::plan::{PrimePlan, cosine_relation};
use super::exact::radical::{Radical, prime_factors};
use super::expr::Expr;
use crate::linalg::number_ring::{Element, NumberRing};

/// Maximum degree of a field over the rationals.
pub const MAX_DEGREE: u64 = 64;

/// Reason why expressions have no number field to compute in.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NumberFieldError {
    /// The roots and angles could not be classified.
    #[error(transparent)]
    Exact(#[from] ExactError),
    /// The degree exceeds [`MAX_DEGREE`].
    #[error(
        "the roots and angles generate a number field of degree {degree}, over the limit of 64; use fewer of them"
    )]
    DegreeTooLarge {
        /// The degree, saturating.
        degree: u64,
    },
}

/// The number field of some expressions.
#[derive(Debug, Clone)]
pub struct NumberField {
    ring: NumberRing,
    /// N
    order: u64,
    /// Primes are 1 modulo this multiple of N to split the field, as far as that is known to help.
    modulus: u64,
    /// 2 cos(2πk/N) for k < N
    cosines: Vec<Element>,
    roots: BTreeMap<u64, Element>,
    radicals: BTreeMap<BigRational, Radical>,
    /// Nested radicands with their roots.
    nested: Vec<(Element, Element)>,
}

impl NumberField {
    /// Creates the field that some expressions generate. O(N · degree) for the cosines, in addition to the
    /// classification of [`super::exact::ExactField::for_expressions`].
    ///
    /// # Errors
    /// Returns a [`NumberFieldError`] if the roots are not resolved or the degree is too large.
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// use ozols::geom::number_field::NumberField;
    /// let sum: Expr = "sqrt(2) + sqrt(3)".parse()?;
    /// assert_eq!(NumberField::for_expressions([&sum])?.ring().dimension(), 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn for_expressions<'a>(
        exprs: impl IntoIterator<Item = &'a Expr>,
    ) -> Result<NumberField, NumberFieldError> {
        let exprs: Vec<&Expr> = exprs.into_iter().collect();
        let plan = PrimePlan::new(&exprs)?;
        let half = prime_factors(plan.order)
            .iter()
            .fold(plan.order, |phi, (q, _)| phi / q * (q - 1))
            / 2;
        let roots = u32::try_from(plan.free_roots.len() + plan.nested.len()).unwrap_or(u32::MAX);
        let degree = half.saturating_mul(2u64.saturating_pow(roots));
        if degree > MAX_DEGREE {
            return Err(NumberFieldError::DegreeTooLarge { degree });
        }
        let mut field = NumberField {
            ring: NumberRing::rationals(),
            order: plan.order,
            modulus: plan.modulus.max(4),
            cosines: Vec::new(),
            roots: BTreeMap::new(),
            radicals: plan.radicals,
            nested: Vec::new(),
        };
        let outside = || ExactError::NotInField {
            expression: "a relation".to_owned(),
        };
        let mut c = Element::default();
        if half > 1 {
            let relation = cosine_relation(field.order).ok_or_else(outside)?;
            field.ring = field.ring.adjoin(relation).ok_or_else(outside)?;
            c = field.ring.generator(0);
        }
        field.cosines = vec![Element::from_integer(2), c.clone()];
        while (field.cosines.len() as u64) < field.order {
            let k = field.cosines.len();
            let next = field.ring.mul(&c, &field.cosines[k - 1]);
            let next = field.ring.sub(&next, &field.cosines[k - 2]);
            field.cosines.push(next);
        }
        for &q in &plan.inner_roots {
            let root = field.gauss_sum(q);
            field.roots.insert(q, root);
        }
        for &q in &plan.free_roots {
            let radicand = Element::from_rational(BigRational::from_integer(BigInt::from(q)));
            let root = field.adjoin_root(&radicand).ok_or_else(outside)?;
            field.roots.insert(q, root);
        }
        for inner in &plan.nested {
            let radicand = eval::eval_in(&field, inner)?;
            let root = field.adjoin_root(&radicand).ok_or_else(outside)?;
            field.nested.push((radicand, root));
        }
        Ok(field)
    }

    /// Adjoins y with y² = d² · radicand, with d chosen to make that integral; the root is y/d.
    fn adjoin_root(&mut self, radicand: &Element) -> Option<Element> {
        let below = radicand.coordinates().iter();
        let d = below.fold(BigInt::one(), |d, q| d.lcm(q.denom()));
        let square = Element::from_rational(BigRational::from_integer(-(&d * &d)));
        let constant = self.ring.mul(radicand, &square);
        self.ring = std::mem::take(&mut self.ring).adjoin(vec![constant, Element::default()])?;
        let y = self.ring.generator(self.ring.generators() - 1);
        let scale = Element::from_rational(BigRational::new(BigInt::one(), d));
        Some(self.ring.mul(&y, &scale))
    }

    /// Returns the positive root of a prime that divides N (as 8 does if the prime is 2).
    fn gauss_sum(&self, q: u64) -> Element {
        let half = BigRational::new(1.into(), 2.into());
        if q == 2 {
            return self.cosine_of_turns(self.order / 8).clone();
        }
        let turn = self.order / q;
        let shift = if q % 4 == 1 { 0 } else { self.order / 4 * 3 };
        let mut sum = Element::default();
        for a in 1..q {
            let term = self.cosine_of_turns(a * turn + shift);
            sum = if is_square(a, q) {
                self.ring.add(&sum, term)
            } else {
                self.ring.sub(&sum, term)
            };
        }
        self.ring.mul(&sum, &Element::from_rational(half))
    }

    /// Returns 2 cos(2πk/N).
    fn cosine_of_turns(&self, k: u64) -> &Element {
        let at = usize::try_from(k % self.order).unwrap_or(0);
        &self.cosines[at]
    }

    /// Returns the ring the field is computed in. O(1).
    #[must_use]
    pub fn ring(&self) -> &NumberRing {
        &self.ring
    }

    /// Returns N if the first generator of the ring is 2 cos(2π/N), or `None` if all cosines are rational. O(1).
    ///
    /// # Examples
    /// ```
    /// use ozols::geom::expr::Expr;
    /// use ozols::geom::number_field::NumberField;
    /// let [seventh, root]: [Expr; 2] = ["cos(360deg/7)".parse()?, "sqrt(2)".parse()?];
    /// assert_eq!(NumberField::for_expressions([&seventh])?.cosine_order(), Some(28)); // 4 · 7
    /// assert_eq!(NumberField::for_expressions([&root])?.cosine_order(), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn cosine_order(&self) -> Option<u64> {
        (self.first_root() == 1).then_some(self.order)
    }

    /// Returns the index of the first generator that is a root.
    fn first_root(&self) -> usize {
        usize::from(self.cosines[1].coordinates().len() > 1)
    }
}

/// Returns true if a is a square modulo an odd prime that is small enough for products of residues.
fn is_square(a: u64, q: u64) -> bool {
    (1..=q / 2).any(|x| x * x % q == a)
}

impl Target for NumberField {
    fn rational(&self, r: &BigRational) -> Option<Element> {
        Some(Element::from_rational(r.clone()))
    }
    fn inverse(&self, a: &Element) -> Option<Element> {
        self.ring.inverse(a)
    }
    fn twice_cos_sin(&self, k: u64, n: u64) -> Option<[Element; 2]> {
        if !self.order.is_multiple_of(n) {
            return None;
        }
        let at = self.order / n * k;
        // sin x = cos(x - 1/4 turn)
        let sine = self.cosine_of_turns(at + self.order / 4 * 3);
        Some([self.cosine_of_turns(at).clone(), sine.clone()])
    }
    fn prime_root(&self, q: u64) -> Option<Element> {
        self.roots.get(&q).cloned()
    }
    fn nested_root(&self, radicand: &Element) -> Option<Element> {
        let mut known = self.nested.iter();
        known.find(|(a, _)| a == radicand).map(|(_, r)| r.clone())
    }
    fn radicals(&self) -> &BTreeMap<BigRational, Radical> {
        &self.radicals
    }
}

impl Scalars for NumberField {
    type Number = Element;

    fn eval(&self, expr: &Expr) -> Result<Element, ExactError> {
        eval::eval_in(self, expr)
    }
    fn add(&self, a: Element, b: Element) -> Element {
        self.ring.add(&a, &b)
    }
    fn sub(&self, a: Element, b: Element) -> Element {
        self.ring.sub(&a, &b)
    }
    fn mul(&self, a: Element, b: Element) -> Element {
        self.ring.mul(&a, &b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::exact::ExactField;
    use crate::linalg::modp::Residue;
    use proptest::prelude::*;

    fn field(texts: &[&str]) -> (NumberField, Vec<Expr>) {
        let exprs: Vec<Expr> = texts.iter().map(|t| t.parse().unwrap()).collect();
        (NumberField::for_expressions(&exprs).unwrap(), exprs)
    }

    #[test]
    fn identities_vanish_and_near_misses_do_not() {
        let pairs = [
            ("cos(36deg)-(1+sqrt(5))/4", 4),
            ("sqrt(2)*sqrt(3)-sqrt(6)", 4),
            ("cos(pi/8)^2-(2+sqrt(2))/4", 4),
            ("sin(60deg)-sqrt(3)/2", 2),
            ("tan(15deg)-(2-sqrt(3))", 4),
            ("cot(75deg)-(2-sqrt(3))", 4),
            ("cos(360deg/7)+cos(720deg/7)+cos(1080deg/7)+1/2", 6),
            (
                "2*sin(360deg/7)+2*sin(720deg/7)-2*sin(1080deg/7)-sqrt(7)",
                6,
            ),
            ("sqrt(10-2*sqrt(5))-4*sin(36deg)", 4),
            ("sqrt(2+sqrt(2))*sqrt(2-sqrt(2))-sqrt(2)", 4),
            ("sqrt(1+sqrt(3))^2-1-sqrt(3)", 4),
            (
                "1/(sqrt(2)+sqrt(3)+cos(36deg))*(sqrt(2)+sqrt(3)+cos(36deg))-1",
                16,
            ),
            ("cos(360deg/11)-cos(3600deg/11)", 10),
            (
                "sqrt(11)*sqrt(13)*cos(360deg/143)-cos(360deg/143)*sqrt(143)",
                120,
            ),
        ];
        for (text, degree) in pairs {
            if degree > MAX_DEGREE {
                let e: Expr = text.parse().unwrap();
                let made = NumberField::for_expressions([&e]);
                assert!(matches!(
                    made,
                    Err(NumberFieldError::DegreeTooLarge { degree: d }) if d == degree
                ));
                continue;
            }
            let off = format!("{text}+1/1000");
            let (f, exprs) = field(&[text, &off]);
            assert_eq!(f.ring().dimension() as u64, degree, "{text}");
            assert!(Scalars::eval(&f, &exprs[0]).unwrap().is_zero(), "{text}");
            let rest = Scalars::eval(&f, &exprs[1]).unwrap();
            assert_eq!(
                rest.as_rational(),
                Some(BigRational::new(1.into(), 1000.into()))
            );
        }
    }

    /// Returns the real values of the generators.
    fn values(f: &NumberField) -> Vec<f64> {
        let mut out = Vec::new();
        if f.cosine_order().is_some() {
            out.push(2.0 * (std::f64::consts::TAU / f.order as f64).cos());
        }
        while out.len() < f.ring().generators() {
            let radicand = -real(f, &f.ring().relation(out.len())[0], &out);
            out.push(radicand.sqrt());
        }
        out
    }

    fn real(f: &NumberField, a: &Element, generators: &[f64]) -> f64 {
        use num_traits::ToPrimitive;
        let mut monomials = vec![1.0];
        for (g, x) in generators.iter().enumerate() {
            let below = monomials.clone();
            for k in 1..f.ring().relation(g).len() {
                monomials.extend(below.iter().map(|m| m * x.powi(k as i32)));
            }
        }
        let terms = a.coordinates().iter().zip(&monomials);
        terms.map(|(q, m)| q.to_f64().unwrap() * m).sum()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn numbers_are_what_the_expressions_say(
            n in prop::sample::select(vec![1u64, 3, 5, 7, 8, 9, 12, 15, 16, 20]),
            k in 1i64..20,
            q in 2i64..30,
            nested in any::<bool>(),
            d in 1i64..9,
        ) {
            let under = if nested { format!("sqrt(37/{d}+sqrt({q}))") } else { format!("sqrt({q})") };
            let text = format!(
                "({d}/7-sin({k}*360deg/{n})*{under})^3/(2*sqrt({d})+cos({k}*360deg/{n})+{under})-cos(360deg/{n})*sqrt(5)"
            );
            let e: Expr = text.parse().unwrap();
            // Degrees over the limit, and nested roots that lie in the field already, are not tested here.
            if let Ok(f) = NumberField::for_expressions([&e]) {
                let value = Scalars::eval(&f, &e).unwrap();
                let (is, should) = (real(&f, &value, &values(&f)), e.to_f64());
                prop_assert!((is - should).abs() < 1e-6 * (1.0 + should.abs()), "{} {} {}", text, is, should);
            }
        }
    }

    #[test]
    fn every_inner_root_squares_to_its_prime_and_is_positive() {
        for q in [2u64, 3, 5, 7, 11, 13, 17, 19] {
            let order = if q == 2 { 8 } else { 4 * q };
            let (f, exprs) = field(&[&format!("cos(360deg/{order})"), &format!("sqrt({q})")]);
            let root = Scalars::eval(&f, &exprs[1]).unwrap();
            let q = Element::from_integer(q as i64);
            assert_eq!(f.ring().mul(&root, &root), q);
            // Under the identity, c is 2 cos(2π/N).
            use num_traits::ToPrimitive;
            let c = 2.0 * (std::f64::consts::TAU / order as f64).cos();
            let value: f64 = root
                .coordinates()
                .iter()
                .rev()
                .fold(0.0, |v, x| v * c + x.to_f64().unwrap());
            assert!(value > 0.0);
        }
    }

    #[test]
    fn homomorphisms_carry_the_relations_and_agree_with_the_exact_field() {
        let texts = ["cos(36deg)", "sqrt(3)", "sqrt(1+sqrt(3))"];
        let (f, exprs) = field(&texts);
        assert_eq!(f.ring().dimension(), 16);
        assert_eq!(f.witnesses().unwrap().len(), 2);
        let split = f.splittings().next().unwrap();
        assert_eq!(split.homomorphisms.len(), 16);
        let p = split.field;
        for images in &split.homomorphisms {
            let monomials = f.ring().monomials(p, images);
            for e in &exprs[1..] {
                let x = Scalars::eval(&f, e).unwrap();
                let square = f.ring().mul(&x, &x).image_in(p, &monomials).unwrap();
                let image = x.image_in(p, &monomials).unwrap();
                assert_eq!(p.mul(image, image), square);
            }
        }
        // Some homomorphism of the field is the one of the exact field.
        let exact = ExactField::for_expressions(&exprs, 0).unwrap();
        let p = exact.field();
        let split = f.split_at(p);
        if let Some(split) = split {
            let values: Vec<Residue> = exprs.iter().map(|e| exact.eval(e).unwrap()).collect();
            assert!(split.homomorphisms.iter().any(|images| {
                let monomials = f.ring().monomials(p, images);
                exprs
                    .iter()
                    .zip(&values)
                    .all(|(e, v)| Scalars::eval(&f, e).unwrap().image_in(p, &monomials) == Some(*v))
            }));
        }
    }
}
