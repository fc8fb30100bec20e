//! Coordinates as the designer writes them, kept exact.

/// An exact real number: rationals, square roots, cosines of rational angles.
#[derive(Debug, Clone)]
pub struct Expr;
