//! STUB
use num_rational::BigRational;
#[derive(Debug, Clone)]
pub struct Expr(pub BigRational);
impl From<i64> for Expr { fn from(x: i64) -> Self { Expr(BigRational::from_integer(x.into())) } }
impl Expr { pub fn to_f64(&self) -> f64 { num_traits::ToPrimitive::to_f64(&self.0).unwrap_or(f64::NAN) } }
