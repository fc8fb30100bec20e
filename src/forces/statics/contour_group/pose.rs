//! The group in one pose: points, guide and loads, and the reactions found there.

use crate::statics::contour_group::ContourGroup;
use crate::statics::kinetostatics::Load;
use crate::statics::planar::{BodyId, PairId};
use crate::statics::pose::{Linkage, Pose, cross, dot, length, minus, quarter_turn};
use crate::statics::{drop_rounding, greatest_abs, rounding_size};
use serde::Serialize;

/// A group in one pose: the input of the methods.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupPose {
    /// D `[m]`.
    pub d: [f64; 2],
    /// F `[m]`.
    pub f: [f64; 2],
    /// K `[m]`.
    pub k: [f64; 2],
    /// M `[m]`.
    pub m: [f64; 2],
    /// L `[m]`.
    pub l: [f64; 2],
    /// Unit direction of the guide; its reaction acts along a quarter turn of it.
    pub guide: [f64; 2],
    /// Loads on 4, 6, 7 and 10; `body` is their number 0 to 3.
    pub loads: Vec<Load>,
}

impl GroupPose {
    /// Creates the group of a mechanism in a pose.
    #[must_use]
    pub fn new(linkage: &Linkage, g: &ContourGroup, pose: &Pose, loads: &[Load]) -> GroupPose {
        let place = |p: PairId| linkage.pair_position(pose, p);
        let number = |b: BodyId| {
            [g.ternary, g.rods[0], g.rods[1], g.slider]
                .iter()
                .position(|&x| x == b)
        };
        let own = loads.iter().filter_map(|l| {
            Some(Load {
                body: number(l.body)?,
                ..*l
            })
        });
        GroupPose {
            d: place(g.d),
            f: place(g.f),
            k: place(g.k),
            m: place(g.m),
            l: place(g.l),
            guide: linkage.slide_direction(pose, g.guide),
            loads: own.collect(),
        }
    }

    /// Returns the reference direction of the guide's reaction.
    #[must_use]
    pub fn guide_normal(&self) -> [f64; 2] {
        quarter_turn(self.guide)
    }

    /// Returns the sum of the forces on a link `[N]`.
    #[must_use]
    pub(crate) fn force_on(&self, link: usize) -> [f64; 2] {
        let own = self.loads.iter().filter(|l| l.body == link);
        own.fold([0.0; 2], |s, l| [s[0] + l.force[0], s[1] + l.force[1]])
    }

    /// Returns the moment of a link's loads about a point `[N·m]`.
    #[must_use]
    pub(crate) fn moment_on(&self, link: usize, about: [f64; 2]) -> f64 {
        let own = self.loads.iter().filter(|l| l.body == link);
        own.map(|l| l.moment_about(about)).sum()
    }
}

/// Reactions of a group.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "UPPERCASE")]
pub struct GroupReactions {
    /// R34, on link 4 at D `[N]`.
    pub d: [f64; 2],
    /// R46, of link 4 on link 6 at F `[N]`.
    pub f: [f64; 2],
    /// R47, of link 4 on link 7 at K `[N]`.
    pub k: [f64; 2],
    /// Reaction of link 10 on link 6 at M `[N]`.
    pub m: [f64; 2],
    /// Reaction of link 10 on link 7 at L `[N]`.
    pub l: [f64; 2],
    /// R_0/10, of the guide on link 10 along [`GroupPose::guide_normal`] `[N]`.
    #[serde(rename = "guide")]
    pub guide: f64,
    /// Moment of the guide's reaction about D `[N·m]`.
    #[serde(rename = "guide_moment_about_D")]
    pub guide_moment: f64,
    /// Arm h of the guide's reaction about D `[m]`: its moment over the reaction; not finite if the reaction vanishes.
    #[serde(rename = "h")]
    pub arm: f64,
}

impl GroupReactions {
    /// Returns the reactions at D, F, K, M, L, then that of the guide as a vector.
    #[must_use]
    pub fn force_vectors(&self, pose: &GroupPose) -> [[f64; 2]; 6] {
        let guide = pose.guide_normal().map(|c| c * self.guide);
        [self.d, self.f, self.k, self.m, self.l, guide]
    }

    /// Returns the reactions with 0 for rounding errors relative to the largest of them. A guide without load has no
    /// arm.
    #[must_use]
    pub(crate) fn without_rounding(&self, pose: &GroupPose) -> GroupReactions {
        // Twelve unknowns in twelve equations.
        let rounding = rounding_size(
            0.0,
            greatest_abs(self.force_vectors(pose).iter().flatten()),
            12,
        );
        let size = [pose.f, pose.k, pose.m, pose.l].map(|p| length(minus(p, pose.d)));
        let bare = |v: [f64; 2]| v.map(|x| drop_rounding(rounding, x));
        let guide = drop_rounding(rounding, self.guide);
        GroupReactions {
            d: bare(self.d),
            f: bare(self.f),
            k: bare(self.k),
            m: bare(self.m),
            l: bare(self.l),
            guide,
            guide_moment: drop_rounding(rounding * greatest_abs(&size), self.guide_moment),
            arm: if guide == 0.0 { f64::NAN } else { self.arm },
        }
    }

    /// Returns the largest difference of any force from another solution's, over the largest force of that solution.
    #[must_use]
    pub fn distance_to(&self, exact: &GroupReactions, pose: &GroupPose) -> f64 {
        let (mine, theirs) = (self.force_vectors(pose), exact.force_vectors(pose));
        let size = |v: [f64; 2]| v[0].hypot(v[1]);
        let greatest = theirs.iter().map(|v| size(*v)).fold(0.0, f64::max);
        let mut worst = 0.0;
        for (a, b) in mine.iter().zip(&theirs) {
            let away = size(minus(*a, *b));
            if away.is_nan() {
                return f64::INFINITY;
            }
            worst = f64::max(worst, away);
        }
        if greatest > 0.0 {
            worst / greatest
        } else {
            worst
        }
    }

    /// Returns the position at which the guide's reaction acts: the distance along the guide from `point`. It is not
    /// finite if the reaction vanishes.
    #[must_use]
    pub fn guide_offset(&self, pose: &GroupPose, point: [f64; 2]) -> f64 {
        // A force N along the normal n at D + a has the moment a × n·N; along the guide u that is a·u N.
        self.arm * cross(pose.guide, pose.guide_normal()) - dot(minus(point, pose.d), pose.guide)
    }
}
