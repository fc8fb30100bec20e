//! A structure whose places are looked for: what is asked of it while they are tried.

use crate::synthesis::bones::Bones;
use crate::synthesis::layout_quality::{LayoutMotion, Looks};
use crate::synthesis::place::Point;
use crate::synthesis::seen_sides::SeenSides;
use crate::synthesis::task::{Limits, beyond};
use crate::synthesis::velocities::Velocity;
use chacha20::ChaCha8Rng;
use std::borrow::Cow;

/// Pitch circles of a larger radius are in the way of other parts, and teeth on smaller ones are few. In millimetres.
const LARGE: f64 = 25.0;
const SMALL: f64 = 8.0;

/// A structure with rules for its places.
pub trait LayoutSketch {
    /// Places of all joints.
    type JointPlaces: Clone;

    /// The points of its links.
    fn bones(&self) -> &Bones;

    /// What it is to be like and to do.
    fn limits(&self) -> &Limits;

    /// Places that cost less are taken without looking for better ones.
    fn good(&self) -> f64;

    /// Where the points are.
    fn points<'p>(&self, at: &'p Self::JointPlaces) -> &'p [Point];

    /// Whether a link turns out of the plane: a screw.
    fn turns_out(&self) -> bool {
        false
    }

    /// The link that has the pin or the block of a joint; none of what has no point on its links.
    fn link_of(&self, _at: &Self::JointPlaces, joint: usize) -> Option<usize> {
        self.bones().joints[joint].map(|[link, _]| link)
    }

    /// Gives every place where a point stands that is at one of them.
    fn each_copy(&self, _point: usize, at: Point, take: &mut dyn FnMut(Point)) {
        take(at);
    }

    /// Gives every pitch circle, by the joint at its centre and its radius in mm, and whether its teeth mesh with what does not belong to
    /// the half of the other jaw.
    fn each_circle(&self, _at: &Self::JointPlaces, _take: &mut dyn FnMut(usize, f64, bool)) {}

    /// All points that are drawn, and whose they are.
    fn drawn<'p>(&'p self, at: &'p Self::JointPlaces) -> (Cow<'p, [Point]>, &'p Bones) {
        (Cow::Borrowed(self.points(at)), self.bones())
    }

    /// How the links move for a unit speed of the driver; `None` where the pose is singular.
    ///
    /// # Complexity
    /// O(n³) for n links.
    fn velocities(&self, at: &Self::JointPlaces) -> Option<Vec<Velocity>>;

    /// Places to begin with.
    fn first_places(&self, random: &mut ChaCha8Rng) -> Self::JointPlaces;

    /// Other places, by how warm the search still is: 1 at first, 0 at its end.
    fn change(&self, at: &mut Self::JointPlaces, warmth: f64, random: &mut ChaCha8Rng);

    /// What places cost, with `moving` their velocities, too; `None` where that is more than `most`, or the pose is singular. What was
    /// seen of other places is known of these where it is the same.
    ///
    /// # Complexity
    /// O(p²) for p points, and O(n³) for n links where velocities are asked for.
    fn penalty(
        &self,
        at: &Self::JointPlaces,
        moving: bool,
        most: f64,
        seen: &mut SeenSides,
    ) -> Option<f64> {
        let (points, bones) = self.drawn(at);
        bones.penalty(&points, most, seen, || {
            let motion = moving.then(|| Some(motion(self, at)?.penalty));
            Some(pitch_penalty(self, at) + motion.unwrap_or(Some(0.0))?)
        })
    }

    /// What breaks the limits as drawn, each break dear.
    ///
    /// # Complexity
    /// O(p²) for p points.
    fn breaks(&self, at: &Self::JointPlaces, seen: &mut SeenSides) -> f64 {
        let (points, bones) = self.drawn(at);
        bones.breaks(&points, self.limits(), seen) + pitch_penalty(self, at)
    }

    /// All figures; `None` where the pose is singular.
    ///
    /// # Complexity
    /// As [`LayoutSketch::penalty`].
    fn looks(&self, at: &Self::JointPlaces) -> Option<Looks> {
        let (points, bones) = self.drawn(at);
        let mut looks = bones.looks(&points, motion(self, at)?)?;
        looks.penalty += pitch_penalty(self, at);
        Some(looks)
    }
}

fn motion<S: LayoutSketch + ?Sized>(sketch: &S, at: &S::JointPlaces) -> Option<LayoutMotion> {
    let least_force = sketch.limits().task.least_force;
    let velocities = sketch.velocities(at)?;
    Some((sketch.bones()).motion(sketch.points(at), &velocities, least_force))
}

/// What pitch circles cost that are large, or too small for teeth.
pub(super) fn pitch_penalty<S: LayoutSketch + ?Sized>(sketch: &S, at: &S::JointPlaces) -> f64 {
    let cost = |r: f64| beyond(r - LARGE, 10.0) + beyond(SMALL - r, 3.0);
    let mut sum = 0.0;
    sketch.each_circle(at, &mut |_, r, _| sum += cost(r));
    sum
}
