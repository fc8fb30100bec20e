//! Vectors of the plane and of space in double precision, as arrays.

use crate::geom::expr::Expr;

/// A vector in space.
pub type Vector = [f64; 3];

/// The three axes.
pub const X: Vector = [1.0, 0.0, 0.0];
/// See [`X`].
pub const Y: Vector = [0.0, 1.0, 0.0];
/// See [`X`].
pub const Z: Vector = [0.0, 0.0, 1.0];

/// `a + b`.
#[must_use]
pub fn add<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// `a - b`.
#[must_use]
pub fn sub<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// `s·a`.
#[must_use]
pub fn scale<const N: usize>(a: [f64; N], s: f64) -> [f64; N] {
    a.map(|x| x * s)
}

/// `a + s·b`.
#[must_use]
pub fn add_scaled<const N: usize>(a: [f64; N], s: f64, b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + s * b[i])
}

/// Scalar product.
#[must_use]
pub fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Vector product.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Vector product in the plane, its component along the normal: the moment of force `b` at arm `a`.
#[must_use]
pub fn cross_plane(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// A vector of the plane after a quarter turn.
#[must_use]
pub fn quarter(v: [f64; 2]) -> [f64; 2] {
    [-v[1], v[0]]
}

/// A vector of the plane after a turn `[rad]`.
#[must_use]
pub fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

/// Length.
#[must_use]
pub fn length<const N: usize>(a: [f64; N]) -> f64 {
    dot(a, a).sqrt()
}

/// Length of a vector of the plane, rounded once.
#[must_use]
pub fn norm(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

/// The sides of the box round points of the plane; infinite below zero where there are none.
#[must_use]
pub fn sides(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| {
        let all = points.iter().map(|p| p[k]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    })
}

/// The unit vector; not finite where there is none.
#[must_use]
pub fn unit<const N: usize>(a: [f64; N]) -> [f64; N] {
    let size = length(a);
    a.map(|x| x / size)
}

/// What is left of a vector without its part along a unit vector.
#[must_use]
pub fn across(v: Vector, along: Vector) -> Vector {
    let part = dot(v, along);
    std::array::from_fn(|i| v[i] - part * along[i])
}

/// A vector of the file in double precision.
#[must_use]
pub fn real(v: &[Expr; 3]) -> Vector {
    v.each_ref().map(Expr::to_f64)
}
