//! One homomorphism from the numbers of expressions into a prime field.

use super::eval::{self, Target};
use super::radical::{ExactError, Radical};
use crate::geom::Scalars;
use crate::geom::expr::Expr;
use crate::linalg::modp::{Field, Residue};
use num_rational::BigRational;
use std::collections::BTreeMap;

/// A homomorphism from the number field of some expressions into F_p.
#[derive(Debug, Clone)]
pub struct ExactField {
    pub(super) field: Field,
    /// N
    pub(super) order: u64,
    /// A primitive N-th root of unity.
    pub(super) zeta: Residue,
    pub(super) roots: BTreeMap<u64, Residue>,
    pub(super) radicals: BTreeMap<BigRational, Radical>,
    /// Radicands of the nested roots with the chosen root.
    pub(super) nested: Vec<(Residue, Residue)>,
}

impl Target for ExactField {
    fn rational(&self, r: &BigRational) -> Option<Residue> {
        self.field.from_rational(r)
    }
    fn inverse(&self, a: &Residue) -> Option<Residue> {
        (*a != 0).then(|| self.field.inv(*a))
    }
    fn twice_cos_sin(&self, k: u64, n: u64) -> Option<[Residue; 2]> {
        if !self.order.is_multiple_of(n) {
            return None;
        }
        let f = self.field;
        let z = f.pow(self.zeta, self.order / n * k);
        let w = f.inv(z);
        let inverse_i = f.pow(self.zeta, self.order / 4 * 3);
        Some([f.add(z, w), f.mul(f.sub(z, w), inverse_i)])
    }
    fn prime_root(&self, q: u64) -> Option<Residue> {
        self.roots.get(&q).copied()
    }
    fn nested_root(&self, radicand: &Residue) -> Option<Residue> {
        let mut known = self.nested.iter();
        known.find(|(a, _)| a == radicand).map(|&(_, root)| root)
    }
    fn radicals(&self) -> &BTreeMap<BigRational, Radical> {
        &self.radicals
    }
}

impl Scalars for ExactField {
    type Number = Residue;

    fn eval(&self, expr: &Expr) -> Result<Residue, ExactError> {
        eval::eval_in(self, expr)
    }
    #[inline]
    fn add(&self, a: Residue, b: Residue) -> Residue {
        self.field().add(a, b)
    }
    #[inline]
    fn sub(&self, a: Residue, b: Residue) -> Residue {
        self.field().sub(a, b)
    }
    #[inline]
    fn mul(&self, a: Residue, b: Residue) -> Residue {
        self.field().mul(a, b)
    }
}
