//! A scene as it is meant: points and directions, exact.

use super::number::Rational3;
use super::relations::RelationKind;

/// A scene as it is meant.
#[derive(Debug, Clone)]
pub struct MeantScene {
    /// Its points, exact, in the file's frame.
    pub points: Vec<Rational3>,
    /// The same in a frame of the scene's own.
    pub(super) inside: Vec<Rational3>,
    /// Its directions, exact, of any length.
    pub rays: Vec<Rational3>,
    /// For each ray, which direction it has: parallel ones have one.
    pub cluster: Vec<usize>,
    /// The independent relations taken, and the points of each.
    pub relations: Vec<(RelationKind, Vec<usize>)>,
    /// The largest move of a coordinate, in halves of its last digit.
    pub moved: f64,
}
