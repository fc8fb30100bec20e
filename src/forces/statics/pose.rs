//! Poses of a planar mechanism and the equations its pairs put on them.
//!
//! A body is placed by where its origin (the mean of its pairs' points) is and how far it has turned since the pose of
//! the file: (x, y, θ). Velocities and accelerations are the derivatives of these three.

use crate::geom::vector::turned;
pub use crate::geom::vector::{
    add_scaled as plus, cross_plane as cross, dot, norm as length, quarter, sub as minus,
};
use crate::statics::planar::{BodyId, Pair, PairId, PairKind, PlanarMechanism};

/// (x `[m]`, y `[m]`, θ `[rad]`) of a body, or derivatives of it.
pub type Placement = [f64; 3];

/// One equation of a pair: its coefficients on the first and second body's (x, y, θ).
pub type Row = [[f64; 3]; 2];

/// Where every body is.
pub type Pose = Vec<Placement>;

/// A planar mechanism with the origins of its bodies.
#[derive(Debug, Clone)]
pub struct Linkage {
    /// The mechanism.
    pub mechanism: PlanarMechanism,
    /// Origin of each body at the pose of the file.
    pub origins: Vec<[f64; 2]>,
    /// A length that is typical of it `[m]`: the greatest distance of a pair from the middle of all; 1 where all
    /// coincide. Makes moments comparable with forces.
    pub size: f64,
}

/// What a pair's points and directions are in a pose.
#[derive(Debug, Clone, Copy)]
struct Now {
    /// From the origins of the two bodies to the pair's point on them.
    arms: [[f64; 2]; 2],
    /// From the point on the first body to the point on the second.
    gap: [f64; 2],
    /// Direction of sliding, with the first body.
    along: [f64; 2],
}

impl Linkage {
    /// Takes a mechanism.
    #[must_use]
    pub fn new(mechanism: PlanarMechanism) -> Linkage {
        let mean = |points: &[[f64; 2]]| {
            #[allow(clippy::cast_precision_loss, reason = "a few thousand at most")]
            let n = points.len().max(1) as f64;
            let sum = points.iter().fold([0.0; 2], |s, p| plus(s, 1.0, *p));
            sum.map(|c| c / n)
        };
        let of = |b: BodyId| -> Vec<[f64; 2]> {
            let pairs = mechanism.pairs.iter().filter(|p| p.bodies.contains(&b));
            pairs.map(|p| p.point).collect()
        };
        let mut origins: Vec<[f64; 2]> =
            (0..mechanism.bodies.len()).map(|b| mean(&of(b))).collect();
        origins[mechanism.frame] = [0.0; 2];
        let all: Vec<[f64; 2]> = mechanism.pairs.iter().map(|p| p.point).collect();
        let middle = mean(&all);
        let far = all
            .iter()
            .map(|p| length(minus(*p, middle)))
            .fold(0.0, f64::max);
        Linkage {
            mechanism,
            origins,
            size: if far > 0.0 { far } else { 1.0 },
        }
    }

    /// The pose of the file.
    #[must_use]
    pub fn home(&self) -> Pose {
        self.origins.iter().map(|o| [o[0], o[1], 0.0]).collect()
    }

    /// Where a body's point is that the file puts at `point`.
    #[must_use]
    pub fn point(&self, pose: &Pose, body: BodyId, point: [f64; 2]) -> [f64; 2] {
        let [x, y, angle] = pose[body];
        plus([x, y], 1.0, turned(minus(point, self.origins[body]), angle))
    }

    /// Velocity of a body's point.
    #[must_use]
    pub fn velocity(&self, pose: &Pose, v: &Pose, body: BodyId, point: [f64; 2]) -> [f64; 2] {
        let arm = minus(
            self.point(pose, body, point),
            [pose[body][0], pose[body][1]],
        );
        plus([v[body][0], v[body][1]], v[body][2], quarter(arm))
    }

    /// Acceleration of a body's point.
    #[must_use]
    pub fn acceleration(
        &self,
        pose: &Pose,
        v: &Pose,
        a: &Pose,
        body: BodyId,
        point: [f64; 2],
    ) -> [f64; 2] {
        let arm = minus(
            self.point(pose, body, point),
            [pose[body][0], pose[body][1]],
        );
        let turning = plus([a[body][0], a[body][1]], a[body][2], quarter(arm));
        plus(turning, -v[body][2] * v[body][2], arm)
    }

    /// Direction of a sliding pair in a pose.
    #[must_use]
    pub fn along(&self, pose: &Pose, pair: PairId) -> [f64; 2] {
        let p = &self.mechanism.pairs[pair];
        turned(p.along, pose[p.bodies[0]][2])
    }

    /// Where a pair is in a pose: its point on the second body.
    #[must_use]
    pub fn place(&self, pose: &Pose, pair: PairId) -> [f64; 2] {
        let p = &self.mechanism.pairs[pair];
        self.point(pose, p.bodies[1], p.point)
    }

    fn now(&self, pose: &Pose, pair: &Pair) -> Now {
        let arms = pair.bodies.map(|b| {
            let at = self.point(pose, b, pair.point);
            minus(at, [pose[b][0], pose[b][1]])
        });
        let [a, b] = pair.bodies.map(|b| self.point(pose, b, pair.point));
        Now {
            arms,
            gap: minus(b, a),
            along: turned(pair.along, pose[pair.bodies[0]][2]),
        }
    }

    /// Position of a drive in a pose: the turn about the plane's normal `[rad]`, or the slide `[m]`, of the second body
    /// against the first.
    #[must_use]
    pub fn drive_position(&self, pose: &Pose, pair: PairId) -> f64 {
        let p = &self.mechanism.pairs[pair];
        match p.kind {
            PairKind::Sliding => {
                let now = self.now(pose, p);
                dot(now.along, now.gap)
            }
            PairKind::Turning | PairKind::Rigid => pose[p.bodies[1]][2] - pose[p.bodies[0]][2],
        }
    }

    /// How far a pair's equations are from holding: two lengths, or for sliding pairs and rigid ones a length or two
    /// and an angle; with `drive`, the drive's own equation last.
    #[must_use]
    pub fn gaps(&self, pose: &Pose, pair: PairId, drive: Option<f64>) -> Vec<f64> {
        let p = &self.mechanism.pairs[pair];
        let now = self.now(pose, p);
        let turn = pose[p.bodies[1]][2] - pose[p.bodies[0]][2];
        let mut out = match p.kind {
            PairKind::Turning => now.gap.to_vec(),
            PairKind::Sliding => vec![turn, dot(quarter(now.along), now.gap)],
            PairKind::Rigid => vec![now.gap[0], now.gap[1], turn],
        };
        if let Some(q) = drive {
            out.push(self.drive_position(pose, pair) - q);
        }
        out
    }

    /// Derivatives of [`Linkage::gaps`] by the placements of the two bodies.
    #[must_use]
    pub fn rows(&self, pose: &Pose, pair: PairId, drive: bool) -> Vec<Row> {
        let p = &self.mechanism.pairs[pair];
        let now = self.now(pose, p);
        let turn: Row = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
        // The derivative of (a direction of the space)·gap.
        let fixed = |n: [f64; 2]| -> Row {
            let [a, b] = now.arms.map(|r| dot(n, quarter(r)));
            [[-n[0], -n[1], -a], [n[0], n[1], b]]
        };
        // The direction turns with the first body.
        let carried = |n: [f64; 2]| -> Row {
            let [mut a, b] = fixed(n);
            a[2] += dot(quarter(n), now.gap);
            [a, b]
        };
        let mut out = match p.kind {
            PairKind::Turning => vec![fixed([1.0, 0.0]), fixed([0.0, 1.0])],
            PairKind::Sliding => vec![turn, carried(quarter(now.along))],
            PairKind::Rigid => vec![fixed([1.0, 0.0]), fixed([0.0, 1.0]), turn],
        };
        match (drive, p.kind) {
            (true, PairKind::Sliding) => out.push(carried(now.along)),
            (true, PairKind::Turning) => out.push(turn),
            _ => {}
        }
        out
    }

    /// What [`Linkage::rows`] times the accelerations comes to, less the drive's own acceleration.
    #[must_use]
    pub(crate) fn bends(&self, pose: &Pose, v: &Pose, pair: PairId, drive: bool) -> Vec<f64> {
        let p = &self.mechanism.pairs[pair];
        let now = self.now(pose, p);
        let [w0, w1] = p.bodies.map(|b| v[b][2]);
        let [r0, r1] = now.arms;
        let inward = minus(r1.map(|c| c * w1 * w1), r0.map(|c| c * w0 * w0));
        let [v0, v1] = [0, 1].map(|e| {
            let b = v[p.bodies[e]];
            plus([b[0], b[1]], b[2], quarter(now.arms[e]))
        });
        let opening = minus(v1, v0);
        let carried = |n: [f64; 2]| {
            dot(n, inward) - 2.0 * w0 * dot(quarter(n), opening) + w0 * w0 * dot(n, now.gap)
        };
        let mut out = match p.kind {
            PairKind::Turning => inward.to_vec(),
            PairKind::Sliding => vec![0.0, carried(quarter(now.along))],
            PairKind::Rigid => vec![inward[0], inward[1], 0.0],
        };
        match (drive, p.kind) {
            (true, PairKind::Sliding) => out.push(carried(now.along)),
            (true, PairKind::Turning) => out.push(0.0),
            _ => {}
        }
        out
    }
}
