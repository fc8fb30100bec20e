//! Second axes of options under a symmetry, and images that are off by no more than the digits of rounded coordinates.
//!
//! A file may leave the second axis of a universal joint open. It is then the first of x, y and z that is not along the joint. The image of
//! such an axis under a turn is another direction. In a symmetric redesign the axes are images of each other, so those of the first joint of
//! each group are carried to the others.

use crate::closure::isometry::{Isometry, Spot};
use crate::geom::expr::Expr;
use crate::geom::vector::{Vector, cross, dot, length, scale, sub, to_vector};
use crate::model::mechanism::{Frame, Joint, JointId, JointOption, Mechanism};
use crate::model::rounded::uncertainties;

/// How many half units of the last digit an image may be off: half units of both images, and of the points that give the symmetry.
const UNITS: f64 = 6.0;

/// How far off images may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Allowance {
    /// Distance, in the file's unit of length.
    pub(super) distance: f64,
    /// Angle, in radians.
    pub(super) angle: f64,
}

impl Allowance {
    /// Returns what the digits of a mechanism leave open; `None` if its coordinates do not look rounded.
    pub(super) fn of_digits(written: &Mechanism) -> Option<Allowance> {
        let half = uncertainties(written)?.largest_half_units(written);
        let points = written.joints.iter().map(|j| to_vector(&j.frame.point));
        let far = points.map(length).fold(0.0, f64::max);
        // The axis of a symmetry is known from rounded points, so its direction is off by their digits over their distance.
        let angle = UNITS * (half[1] + half[0] / far.max(f64::MIN_POSITIVE));
        Some(Allowance {
            distance: UNITS * (half[0] + half[1] * far),
            angle,
        })
    }
}

/// A second axis that an option gets.
pub(super) type SecondAxis = (JointId, usize, [Expr; 3]);

/// Returns the second axes of options that make them images of each other, where the file leaves these open.
pub(super) fn carried_axes(
    mechanism: &Mechanism,
    carrier: &Isometry,
    groups: &[Vec<JointId>],
    allowed: Allowance,
) -> Vec<SecondAxis> {
    let mut out = Vec::new();
    for group in groups {
        let first = &mechanism.joints[group[0]];
        for (o, option) in first.options.iter().enumerate() {
            let mut axis = option.frame.reference.clone();
            for &j in &group[1..] {
                axis = carrier.image_of_direction(&axis);
                let joint = &mechanism.joints[j];
                let Some(own) = joint.options.get(o) else {
                    continue;
                };
                let mut frame = own.frame.clone();
                frame.reference.clone_from(&axis);
                let open = is_open(first, option) && is_open(joint, own);
                if open && angle_of_second_axes(&frame, &own.frame) > allowed.angle {
                    out.push((j, o, axis.clone()));
                }
            }
        }
    }
    out
}

/// Returns whether a file leaves the second axis of an option open: the option has one, the joint as built has none, and the axis is the
/// usual one.
fn is_open(joint: &Joint, option: &JointOption) -> bool {
    let along = to_vector(&option.frame.axis);
    let is_across = |axis: &Vector| length(cross(*axis, along)) > 1e-9 * length(along);
    let mut usual = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter();
    let usual = usual.find(is_across);
    option.joint_type.has_second_axis()
        && !joint.joint_type.has_second_axis()
        && usual == Some(to_vector(&option.frame.reference))
}

/// Returns the angle between the second axes of two frames with nearly one axis, either way along them.
fn angle_of_second_axes(one: &Frame, other: &Frame) -> f64 {
    let [a, b] = [one, other].map(|frame| {
        let (axis, reference) = (to_vector(&frame.axis), to_vector(&frame.reference));
        let along = dot(axis, reference) / dot(axis, axis);
        sub(reference, scale(axis, along))
    });
    length(cross(a, b)).atan2(dot(a, b).abs())
}

/// Returns whether every option of each joint has its image at the image of the joint, within what is allowed.
pub(super) fn are_near_images(
    mechanism: &Mechanism,
    carrier: &Isometry,
    image_of: &dyn Fn(JointId) -> JointId,
    allowed: Allowance,
) -> bool {
    mechanism.joint_ids().all(|j| {
        let [from, to] = [j, image_of(j)].map(|j| &mechanism.joints[j]);
        let mut options = from.offered_options().zip(to.offered_options());
        options.all(|(one, other)| {
            let spots = [one, other].map(|o| Spot::from_frame(&o.frame));
            let miss = carrier.miss_of_image(spots[0], &one.joint_type, spots[1]);
            let mut frame = other.frame.clone();
            frame.reference = carrier.image_of_direction(&one.frame.reference);
            let second = if one.joint_type.has_second_axis() {
                angle_of_second_axes(&frame, &other.frame)
            } else {
                0.0
            };
            one.joint_type == other.joint_type
                && miss.distance < allowed.distance
                && miss.angle.max(second) < allowed.angle
        })
    })
}
