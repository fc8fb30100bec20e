//! STUB
use crate::geom::expr::Expr;
use crate::linalg::modp::{Field, Residue};
#[derive(Debug, Clone)]
pub struct ExactField(Field);
#[derive(Debug, thiserror::Error)]
#[error("x")]
pub struct ExactError;
impl ExactField {
    pub fn for_expressions<'a>(_e: impl IntoIterator<Item = &'a Expr>, nth: usize) -> Result<Self, ExactError> {
        Ok(ExactField(Field::new(((1u64 << 61) + 1..).step_by(2).filter(|&n| crate::linalg::modp::is_prime(n)).nth(nth).unwrap())))
    }
    pub fn field(&self) -> Field { self.0 }
    pub fn eval(&self, e: &Expr) -> Result<Residue, ExactError> { Ok(self.0.from_rational(&e.0).unwrap()) }
}
