//! The loads of a moving planar mechanism and the reactions of its pairs, in its plane. They are those of
//! [`crate::statics::reactions`] along the axes of the plane, with a sliding block for a pin in a slot.

use crate::geom::Reals;
use crate::geom::Scalars;
use crate::geom::vector::add;
use crate::statics::planar::{BodyId, Pair, PairId, PairKind};
use crate::statics::pose::{Linkage, Pose, cross, length, minus};
use crate::statics::reactions::JointReaction;
use crate::statics::reactions::loads::Borne;
pub use crate::statics::reactions::loads::LoadSource;
use crate::statics::{drop_rounding, greatest_abs, over_load};
use serde::Serialize;

/// A force at a point of a body, with a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// The body.
    pub body: BodyId,
    /// Origin of the load.
    pub source: LoadSource,
    /// Its current point of action `[m]`.
    pub point: [f64; 2],
    /// The force `[N]`.
    pub force: [f64; 2],
    /// The additional moment `[N·m]`.
    pub moment: f64,
}

impl Load {
    /// Returns the moment about a point `[N·m]`.
    #[must_use]
    pub(crate) fn moment_about(&self, point: [f64; 2]) -> f64 {
        self.moment + cross(minus(self.point, point), self.force)
    }
}

/// A link with mass at an instant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LinkInertia {
    /// The link.
    #[serde(skip)]
    pub body: BodyId,
    /// Its current mass centre `[m]`.
    pub centre: [f64; 2],
    /// Acceleration of the mass centre `[m/s²]`.
    pub acceleration: [f64; 2],
    /// Angular acceleration `[rad/s²]`.
    pub angular_acceleration: f64,
    /// -m a, at the mass centre `[N]`.
    #[serde(rename = "inertia_force")]
    pub force: [f64; 2],
    /// -I ε `[N·m]`.
    #[serde(rename = "inertia_moment")]
    pub moment: f64,
}

impl LinkInertia {
    /// Returns h_и, the offset from the mass centre at which the inertia force alone is equivalent to force and moment
    /// `[m]`. It is not finite if the mass centre has no acceleration.
    ///
    /// # Sources
    /// `[Bychkov, Dvornikov & Zhukov 2018]`, who offset the force by it.
    #[must_use]
    pub fn inertia_offset(&self) -> f64 {
        self.moment / length(self.force)
    }
}

/// The reaction of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Reaction {
    /// The pair.
    #[serde(skip)]
    pub pair: PairId,
    /// The current position of the pair: its point on the second body `[m]`.
    pub point: [f64; 2],
    /// Force of the first body on the second `[N]`.
    pub force: [f64; 2],
    /// Moment of the first body on the second, about `point` `[N·m]`.
    pub moment: f64,
    /// Torque `[N·m]` or force `[N]` of a drive on the second body; part of `force` and `moment`.
    pub effort: Option<f64>,
}

impl Reaction {
    /// Returns force and moment about a point on one of the two bodies; zero on any other.
    #[must_use]
    pub fn wrench_on(&self, linkage: &Linkage, body: BodyId, about: [f64; 2]) -> [f64; 3] {
        let sign = match linkage.mechanism.pairs[self.pair].bodies {
            [_, b] if b == body => 1.0,
            [a, _] if a == body => -1.0,
            _ => 0.0,
        };
        let moment = self.moment + cross(minus(self.point, about), self.force);
        [self.force[0], self.force[1], moment].map(|x| sign * x)
    }
}

/// Reliability of a solution of the equations of some bodies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Worth {
    /// Ratio of the largest to the smallest singular value, with moments divided by the size of the mechanism or group.
    pub condition: f64,
    /// Largest residual force in an equation, with moments divided by the size, over the largest load.
    pub residual: f64,
}

/// Returns the loads in the plane.
pub(crate) fn planar_loads(linkage: &Linkage, borne: &Borne) -> Vec<Load> {
    let m = &linkage.mechanism;
    let each = borne.loads.iter().filter_map(|x| {
        Some(Load {
            body: m.body_of(x.link)?,
            source: x.source,
            point: m.plane_components(borne.geometry.to_metres(x.point)),
            force: m.plane_components(x.force),
            moment: Reals.dot(m.axes[2], x.moment),
        })
    });
    each.collect()
}

/// Returns the motion of the links with mass in the plane.
pub(crate) fn link_inertias(linkage: &Linkage, borne: &Borne) -> Vec<LinkInertia> {
    let m = &linkage.mechanism;
    let each = borne.masses.iter().filter_map(|x| {
        Some(LinkInertia {
            body: m.body_of(x.link)?,
            centre: m.plane_components(borne.geometry.to_metres(x.centre)),
            acceleration: m.plane_components(x.acceleration),
            angular_acceleration: Reals.dot(m.axes[2], x.angular_acceleration),
            force: m.plane_components(x.force),
            moment: Reals.dot(m.axes[2], x.moment),
        })
    });
    each.collect()
}

/// Returns the reactions of the pairs, given those of the joints, in file order.
pub(crate) fn planar_reactions(
    linkage: &Linkage,
    pose: &Pose,
    joints: &[JointReaction],
) -> Vec<Reaction> {
    let m = &linkage.mechanism;
    let one = |(pair, p): (PairId, &Pair)| {
        let r = joints.iter().find(|r| r.joint == p.joint)?;
        let point = linkage.pair_position(pose, pair);
        let force = m
            .plane_components(r.global_force())
            .map(|x| drop_rounding(r.rounding[0], x));
        let effort = r.effort.filter(|_| p.drive).map(|(_, x)| x);
        let moment = match p.kind {
            PairKind::Turning => effort.unwrap_or(0.0),
            PairKind::Sliding | PairKind::Rigid => {
                let about = cross(minus(m.plane_components(r.point), point), force);
                let moment = Reals.dot(m.axes[2], r.global_moment()) + about;
                drop_rounding(r.rounding[0] * linkage.size, moment)
            }
        };
        Some(Reaction {
            pair,
            point,
            force,
            moment,
            effort,
        })
    };
    m.pairs.iter().enumerate().filter_map(one).collect()
}

/// Returns the reliability of reactions in the equations of some bodies for some of the pairs. Reactions of the other
/// pairs count as loads.
pub(crate) fn solution_worth(
    linkage: &Linkage,
    pose: &Pose,
    (bodies, pairs, drives): (&[BodyId], &[PairId], &[PairId]),
    loads: &[Load],
    reactions: &[Reaction],
) -> Worth {
    let (mut load, mut left_over) = (0.0f64, 0.0f64);
    for &body in bodies {
        let about = [pose[body][0], pose[body][1]];
        let (mut given, mut all) = ([0.0; 3], [0.0; 3]);
        for l in loads.iter().filter(|l| l.body == body) {
            given = add(given, [l.force[0], l.force[1], l.moment_about(about)]);
        }
        for r in reactions {
            let to = if pairs.contains(&r.pair) {
                &mut all
            } else {
                &mut given
            };
            *to = add(*to, r.wrench_on(linkage, body, about));
        }
        all = add(all, given);
        for sum in [&mut given, &mut all] {
            sum[2] /= linkage.size;
        }
        load = load.max(greatest_abs(&given));
        left_over = left_over.max(greatest_abs(&all));
    }
    Worth {
        condition: linkage.equations_condition(pose, bodies, pairs, drives),
        residual: over_load(left_over, load),
    }
}
