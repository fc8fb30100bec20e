//! Sides to look from: those that are asked for by name, and those that are chosen from.

use crate::draw::prelude::*;
use crate::geom::vector::{cross, length as norm};

/// The requested direction of view of a kinematic scheme. The program chooses the rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sight {
    /// The direction from the mechanism to the reader, of any length but zero.
    pub toward: Option<Vector>,
    /// The upward direction on paper, as far as it is across the direction of view; z by default.
    pub up: Option<Vector>,
}

/// Points and axes nearer than this to a plane, relative to the size of the whole, lie in it: files of robots have some
/// six digits.
pub(super) const FLAT: f64 = 1e-5;

/// A side to look from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View {
    /// To the right on paper.
    pub(crate) right: Vector,
    /// Up on paper.
    pub(crate) up: Vector,
    /// Towards the reader.
    pub(crate) toward: Vector,
    /// Its name.
    pub(crate) name: &'static str,
    /// Along an axis of the coordinates.
    pub(super) axis: bool,
}

impl View {
    /// Returns a vector on paper, where y goes down.
    pub(crate) fn flat_vector(&self, v: Vector) -> Point {
        [dot(self.right, v), -dot(self.up, v)]
    }
}

impl Sight {
    /// Returns the requested view, if there is one.
    pub(super) fn asked_view(&self) -> Option<View> {
        let toward = unit_or(self.toward?, [0.0, 0.0, 1.0]);
        let mut all = all_views().into_iter();
        if let Some(view) = all.find(|v| norm(sub(v.toward, toward)) < FLAT) {
            return Some(self.turned_view(view));
        }
        let equal = |x: &f64| (x.abs() - toward[0].abs()).abs() < FLAT;
        let name = if toward.iter().all(equal) {
            "isometric"
        } else {
            "seen from the side asked for"
        };
        Some(self.turned_view(upright_view(toward, name)))
    }

    /// Returns a view with the requested direction upwards.
    pub(super) fn turned_view(&self, view: View) -> View {
        let Some(up) = self.up else { return view };
        let right = cross(up, view.toward);
        if norm(right) <= FLAT * norm(up) {
            return view;
        }
        let right = unit_or(right, view.right);
        View {
            right,
            up: cross(view.toward, right),
            ..view
        }
    }
}

/// Returns the available views.
pub(super) fn all_views() -> Vec<View> {
    let axes = [
        ("seen along z", X, Y, Z),
        ("seen along y", X, Z, scale(Y, -1.0)),
        ("seen along x", Y, Z, X),
    ];
    let along = |(name, right, up, toward)| View {
        right,
        up,
        toward,
        name,
        axis: true,
    };
    let mut out: Vec<View> = axes.map(along).to_vec();
    let iso = (1.0f64 / 3.0).sqrt().asin().to_degrees();
    let slanted = [(45.0, iso), (-45.0, iso), (135.0, iso), (-135.0, iso)];
    let turns = (0..24).map(|n| 15.0 * f64::from(n) - 172.5);
    let others = turns.flat_map(|turn| [16.0, 28.0, 42.0, 58.0].map(|height| (turn, height)));
    for (n, (azimuth, height)) in slanted.into_iter().chain(others).enumerate() {
        let (a, h): (f64, f64) = (f64::to_radians(azimuth), f64::to_radians(height));
        let toward = [a.cos() * h.cos(), a.sin() * h.cos(), h.sin()];
        let name = if n < 4 {
            "isometric"
        } else {
            "seen at an angle"
        };
        out.push(upright_view(toward, name));
    }
    out
}

/// Returns the view along z.
pub(crate) fn along_z() -> View {
    all_views()[0]
}

/// Towards a direction, with z going up, or y where the direction is z.
fn upright_view(toward: Vector, name: &'static str) -> View {
    let right = unit_or(cross(Z, toward), scale(X, toward[2].signum()));
    View {
        right,
        up: cross(toward, right),
        toward,
        name,
        axis: false,
    }
}

/// Returns the view along a normal, from the side of the isometric views.
pub(super) fn face_on(normal: Vector) -> View {
    let mut all = all_views().into_iter();
    if let Some(view) = all.find(|v| v.axis && norm(cross(v.toward, normal)) < FLAT) {
        return view;
    }
    let side = dot(normal, [1.0, -1.1, 1.2]);
    upright_view(scale(normal, side.signum()), "seen face-on")
}

pub(super) fn unit_or(a: Vector, or: Vector) -> Vector {
    let length = norm(a);
    if length > 1e-300 && length.is_finite() {
        scale(a, 1.0 / length)
    } else {
        or
    }
}
