//! Poses of a planar mechanism and the equations of its pairs.
//!
//! The position of a body is (x, y, θ): its origin, the mean of its pairs' points, and its turn since the pose of the file.

use crate::geom::vector::rotate_plane;
pub use crate::geom::vector::{
    add_scaled as plus, cross_plane as cross, dot, plane_norm as length, quarter_turn, sub as minus,
};
use crate::motion::pose as motion;
use crate::statics::planar::{BodyId, Pair, PairId, PairKind, PlanarMechanism};
use crate::statics::{condition_number, mean_point};
use ozols_dense::Matrix;

/// (x `[m]`, y `[m]`, θ `[rad]`) of a body.
pub type Placement = [f64; 3];

/// One equation of a pair: its coefficients on the first and second body's (x, y, θ).
pub type Row = [[f64; 3]; 2];

/// Position of every body.
pub type Pose = Vec<Placement>;

/// A planar mechanism with the origins of its bodies.
#[derive(Debug, Clone)]
pub struct Linkage {
    /// The mechanism.
    pub mechanism: PlanarMechanism,
    /// Origin of each body at the pose of the file.
    pub origins: Vec<[f64; 2]>,
    /// A typical length `[m]`: the largest distance of a pair from the middle of all; 1 if all coincide. It makes
    /// moments comparable with forces.
    pub size: f64,
}

/// Points and directions of a pair in a pose.
#[derive(Debug, Clone, Copy)]
struct Now {
    /// Vectors from the origins of the two bodies to the pair's point on them.
    arms: [[f64; 2]; 2],
    /// Vector from the point on the first body to the point on the second.
    gap: [f64; 2],
    /// Direction of sliding, fixed to the first body.
    along: [f64; 2],
}

impl Linkage {
    /// Creates the linkage of a mechanism.
    #[must_use]
    pub fn new(mechanism: PlanarMechanism) -> Linkage {
        let of = |b: BodyId| -> Vec<[f64; 2]> {
            let pairs = mechanism.pairs.iter().filter(|p| p.bodies.contains(&b));
            pairs.map(|p| p.point).collect()
        };
        let mut origins: Vec<[f64; 2]> = (0..mechanism.bodies.len())
            .map(|b| mean_point(&of(b)))
            .collect();
        origins[mechanism.frame] = [0.0; 2];
        let all: Vec<[f64; 2]> = mechanism.pairs.iter().map(|p| p.point).collect();
        let middle = mean_point(&all);
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

    /// Returns the pose of the file.
    #[must_use]
    pub fn home_pose(&self) -> Pose {
        self.origins.iter().map(|o| [o[0], o[1], 0.0]).collect()
    }

    /// Returns the position of a body's point that is at `point` in the file.
    #[must_use]
    pub fn point_at(&self, pose: &Pose, body: BodyId, point: [f64; 2]) -> [f64; 2] {
        let [x, y, angle] = pose[body];
        plus(
            [x, y],
            1.0,
            rotate_plane(minus(point, self.origins[body]), angle),
        )
    }

    /// Returns the direction of a sliding pair in a pose.
    #[must_use]
    pub fn slide_direction(&self, pose: &Pose, pair: PairId) -> [f64; 2] {
        let p = &self.mechanism.pairs[pair];
        rotate_plane(p.along, pose[p.bodies[0]][2])
    }

    /// Returns the position of a pair in a pose: its point on the second body.
    ///
    /// # Examples
    /// ```
    /// use ozols::{model::mechanism::StateId, statics::{planar::PlanarMechanism, pose::Linkage}};
    /// let planar = PlanarMechanism::new(&ozols::built_in("four-bar")?, StateId::FREE)?;
    /// let linkage = Linkage::new(planar);
    /// let [x, y] = linkage.pair_position(&linkage.home_pose(), 2);
    /// assert!((x - 0.080).hypot(y - 0.090) < 1e-12); // Drawn at (80, 90) mm.
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn pair_position(&self, pose: &Pose, pair: PairId) -> [f64; 2] {
        let p = &self.mechanism.pairs[pair];
        self.point_at(pose, p.bodies[1], p.point)
    }

    fn pair_now(&self, pose: &Pose, pair: &Pair) -> Now {
        let arms = pair.bodies.map(|b| {
            let at = self.point_at(pose, b, pair.point);
            minus(at, [pose[b][0], pose[b][1]])
        });
        let [a, b] = pair.bodies.map(|b| self.point_at(pose, b, pair.point));
        Now {
            arms,
            gap: minus(b, a),
            along: rotate_plane(pair.along, pose[pair.bodies[0]][2]),
        }
    }

    /// Returns the derivatives of the equations of a pair with respect to the placements of the two bodies. There are
    /// two lengths, or a length and an angle, and with `drive` the equation of the drive last.
    #[must_use]
    pub fn pair_rows(&self, pose: &Pose, pair: PairId, drive: bool) -> Vec<Row> {
        let p = &self.mechanism.pairs[pair];
        let now = self.pair_now(pose, p);
        let turn: Row = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
        // The derivative of (a fixed direction)·gap.
        let fixed = |n: [f64; 2]| -> Row {
            let [a, b] = now.arms.map(|r| dot(n, quarter_turn(r)));
            [[-n[0], -n[1], -a], [n[0], n[1], b]]
        };
        // The direction turns with the first body.
        let carried = |n: [f64; 2]| -> Row {
            let [mut a, b] = fixed(n);
            a[2] += dot(quarter_turn(n), now.gap);
            [a, b]
        };
        let mut out = match p.kind {
            PairKind::Turning => vec![fixed([1.0, 0.0]), fixed([0.0, 1.0])],
            PairKind::Sliding => vec![turn, carried(quarter_turn(now.along))],
            PairKind::Rigid => vec![fixed([1.0, 0.0]), fixed([0.0, 1.0]), turn],
        };
        match (drive, p.kind) {
            (true, PairKind::Sliding) => out.push(carried(now.along)),
            (true, PairKind::Turning) => out.push(turn),
            _ => {}
        }
        out
    }

    /// Returns the positions of the bodies for links moved from the pose of the file as in `pose`, and turned by these
    /// angles.
    pub(crate) fn place_bodies(&self, pose: &motion::Pose, turns: &[f64]) -> Pose {
        let m = &self.mechanism;
        let mut out = self.home_pose();
        for (b, body) in m.bodies.iter().enumerate() {
            let Some(link) = body.link else { continue };
            let [x, y] = self.origins[b];
            let point = [0, 1, 2].map(|i| (x * m.axes[0][i] + y * m.axes[1][i]) / m.metres);
            let [x, y] = m.to_plane(pose.carry_point(&pose.links, link, point));
            out[b] = [x, y, turns[link]];
        }
        // A block moves with the pin of the first link, and turns with the slot of the second.
        for pin_slot in m.pairs.windows(2) {
            let ([pin, block], [of, slot]) = (pin_slot[0].bodies, pin_slot[1].bodies);
            if block == of && m.bodies[block].link.is_none() {
                let [x, y] = self.point_at(&out, pin, pin_slot[0].point);
                out[block] = [x, y, out[slot][2]];
            }
        }
        out
    }

    /// Returns the ratio of the largest to the smallest singular value of the equations of some bodies for the pairs
    /// that position them. Angles and angular equations are converted to lengths by the mechanism's size. The
    /// equilibrium of the bodies has the transposed equations.
    #[must_use]
    pub(crate) fn equations_condition(
        &self,
        pose: &Pose,
        bodies: &[BodyId],
        pairs: &[PairId],
        drives: &[PairId],
    ) -> f64 {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for &p in pairs {
            let pair = &self.mechanism.pairs[p];
            for row in self.pair_rows(pose, p, drives.contains(&p)) {
                let is_angle = row[1][..2] == [0.0; 2];
                let scale = if is_angle { self.size } else { 1.0 };
                let mut out = vec![0.0; 3 * bodies.len()];
                for (end, b) in pair.bodies.iter().enumerate() {
                    if let Some(at) = bodies.iter().position(|x| x == b) {
                        let [x, y, turn] = row[end].map(|c| c * scale);
                        out[3 * at..3 * at + 3].copy_from_slice(&[x, y, turn / self.size]);
                    }
                }
                rows.push(out);
            }
        }
        condition_number(&Matrix::from_fn(rows.len(), 3 * bodies.len(), |r, c| {
            rows[r][c]
        }))
    }
}
