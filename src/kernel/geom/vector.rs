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

/// Returns `a + b`.
#[must_use]
pub fn add<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// Returns `a - b`.
#[must_use]
pub fn sub<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// Returns `s·a`.
#[must_use]
pub fn scale<const N: usize>(a: [f64; N], s: f64) -> [f64; N] {
    a.map(|x| x * s)
}

/// Returns `a + s·b`.
#[must_use]
pub fn add_scaled<const N: usize>(a: [f64; N], s: f64, b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + s * b[i])
}

/// Returns the scalar product.
#[must_use]
pub fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Returns the vector product.
///
/// # Examples
/// ```
/// use ozols::geom::vector::{X, Y, Z, cross};
/// assert_eq!(cross(X, Y), Z);
/// ```
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Returns the vector product in the plane, its component along the normal: the moment of force `b` at arm `a`.
///
/// # Examples
/// ```
/// use ozols::geom::vector::cross_plane;
/// // 10 N upwards at an arm of 2 m.
/// assert_eq!(cross_plane([2.0, 0.0], [0.0, 10.0]), 20.0);
/// ```
#[must_use]
pub fn cross_plane(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Returns a vector of the plane after a quarter turn.
#[must_use]
pub fn quarter_turn(v: [f64; 2]) -> [f64; 2] {
    [-v[1], v[0]]
}

/// Returns a vector of the plane after a turn `[rad]`.
#[must_use]
pub fn rotate_plane([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y]
}

/// Returns the length.
#[must_use]
pub fn length<const N: usize>(a: [f64; N]) -> f64 {
    dot(a, a).sqrt()
}

/// Returns the length of a vector of the plane, rounded once.
#[must_use]
pub fn plane_norm(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

/// Returns the sides of the bounding box of points of the plane, or negative infinity if there are none.
#[must_use]
pub fn box_sides(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| {
        let all = points.iter().map(|p| p[k]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    })
}

/// Returns the unit vector, which is not finite if there is none.
///
/// # Examples
/// ```
/// use ozols::geom::vector::unit;
/// assert_eq!(unit([3.0, 4.0]), [0.6, 0.8]);
/// ```
#[must_use]
pub fn unit<const N: usize>(a: [f64; N]) -> [f64; N] {
    let size = length(a);
    a.map(|x| x / size)
}

/// Returns a vector without its part along a unit vector.
///
/// # Examples
/// ```
/// use ozols::geom::vector::{X, across};
/// assert_eq!(across([3.0, 4.0, 0.0], X), [0.0, 4.0, 0.0]);
/// ```
#[must_use]
pub fn across(v: Vector, along: Vector) -> Vector {
    let part = dot(v, along);
    std::array::from_fn(|i| v[i] - part * along[i])
}

/// Converts a vector of the file to double precision.
#[must_use]
pub fn to_vector(v: &[Expr; 3]) -> Vector {
    v.each_ref().map(Expr::to_f64)
}
