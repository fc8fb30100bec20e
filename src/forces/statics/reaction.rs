//! The reaction of a pair of a planar linkage.

use crate::statics::planar::{BodyId, PairId, PairKind};
use crate::statics::pose::Linkage;
use crate::statics::pose::{cross, minus};
use crate::statics::rounding::without;
use serde::Serialize;

/// What a pair passes on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Reaction {
    /// The pair.
    #[serde(skip)]
    pub pair: PairId,
    /// Where the pair is now: its point on the second body `[m]`.
    pub point: [f64; 2],
    /// Force of the first body on the second `[N]`.
    pub force: [f64; 2],
    /// Moment of the first body on the second, about `point` `[N·m]`.
    pub moment: f64,
    /// Torque `[N·m]` or force `[N]` of a drive on the second body; part of `force` and `moment`.
    pub effort: Option<f64>,
}

impl Reaction {
    /// Returns the reaction with 0 for what is at most `least` `[N]`, moments divided by the mechanism's size.
    pub(crate) fn without(mut self, least: f64, linkage: &Linkage) -> Reaction {
        let turns = linkage.mechanism.pairs[self.pair].kind == PairKind::Turning;
        let [of_force, of_moment] = [least, least * linkage.size].map(|x| move |y| without(x, y));
        (self.force, self.moment) = (self.force.map(of_force), of_moment(self.moment));
        self.effort = if turns {
            self.effort.map(of_moment)
        } else {
            self.effort.map(of_force)
        };
        self
    }

    /// Force and moment about a point on one of the two bodies; zero on any other.
    #[must_use]
    pub fn on(&self, linkage: &Linkage, body: BodyId, about: [f64; 2]) -> [f64; 3] {
        let sign = match linkage.mechanism.pairs[self.pair].bodies {
            [_, b] if b == body => 1.0,
            [a, _] if a == body => -1.0,
            _ => 0.0,
        };
        let moment = self.moment + cross(minus(self.point, about), self.force);
        [self.force[0], self.force[1], moment].map(|x| sign * x)
    }
}
