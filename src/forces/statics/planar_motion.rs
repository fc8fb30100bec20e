//! Positions, velocities and accelerations over a cycle, group by group.
//!
//! Each Assur group is placed by Newton's method on its own equations once the bodies it hangs on are placed. Steps of
//! the drive are halved until the solution follows its tangent and no group's determinant changes sign, so that the
//! assembly of the file is kept; where that fails the group is at a dead point.

use crate::statics::DenseSystem;
use crate::statics::assur::Decomposition;
use crate::statics::planar::{BodyId, PairId, PairKind};
use crate::statics::pose::{Linkage, Pose, Row};

/// Relative size of the last Newton correction.
const CONVERGED: f64 = 1e-13;
/// Newton's method is given up after this many corrections.
const CORRECTIONS: usize = 12;
/// A corrected pose may differ from its tangent by this fraction of the mechanism's size (or radians).
const TRUST: f64 = 0.02;
/// Steps below this fraction of the size (or radians) mean a dead point.
const SMALLEST_STEP: f64 = 1e-9;
/// A group worse conditioned than this is at a dead point.
const WORST: f64 = 1e12;

/// Bodies that are placed together and the pairs that place them; those in `driven` have a drive.
#[derive(Debug, Clone)]
struct Unit {
    /// Index of the group; `None` for the bodies that drives alone place.
    group: Option<usize>,
    bodies: Vec<BodyId>,
    /// Pairs, each with the number of its drive if it is one.
    pairs: Vec<(PairId, Option<usize>)>,
}

/// Where a mechanism is, and how it moves.
#[derive(Debug, Clone)]
pub struct Instant {
    /// Position of the first drive `[rad]` or `[m]`.
    pub drive: f64,
    /// Positions of all drives.
    pub drives: Vec<f64>,
    /// Placement of every body.
    pub pose: Pose,
    /// Its first derivative by time.
    pub velocity: Pose,
    /// Its second derivative by time.
    pub acceleration: Pose,
}

/// A place where a mechanism goes no further.
#[derive(Debug, Clone)]
pub struct DeadPoint {
    /// Position of the first drive `[rad]` or `[m]`.
    pub drive: f64,
    /// The group that stops it, as an index into [`Decomposition::groups`]; `None` for the drives themselves.
    pub group: Option<usize>,
    /// Ratio of the greatest and smallest singular values of that group's equations at the last pose.
    pub condition: f64,
    /// The last pose reached.
    pub pose: Pose,
}

/// A mechanism with drives, ready to move.
#[derive(Debug, Clone)]
pub struct Motion<'a> {
    linkage: &'a Linkage,
    drives: &'a [PairId],
    speeds: Vec<f64>,
    units: Vec<Unit>,
}

impl<'a> Motion<'a> {
    /// Takes a linkage, its decomposition, and the speed of each drive `[rad/s]` or `[m/s]`; those left out stand still.
    #[must_use]
    pub fn new(linkage: &'a Linkage, d: &'a Decomposition, speeds: &[f64]) -> Motion<'a> {
        let number = |p: PairId| (p, d.drives.iter().position(|&x| x == p));
        let unit = |group, bodies: &[BodyId], pairs: Vec<PairId>| Unit {
            group,
            bodies: bodies.to_vec(),
            pairs: pairs.into_iter().map(number).collect(),
        };
        let mut units = vec![unit(None, &d.driven, d.driven_pairs.clone())];
        let groups = d.groups.iter().enumerate();
        units.extend(groups.map(|(i, g)| unit(Some(i), &g.bodies, g.pairs())));
        let speed = |i: usize| speeds.get(i).copied().unwrap_or(0.0);
        Motion {
            linkage,
            drives: &d.drives,
            speeds: (0..d.drives.len()).map(speed).collect(),
            units,
        }
    }

    /// Positions of all drives when the first is at `s`: the others keep step by their speeds.
    #[must_use]
    pub(crate) fn drive_positions(&self, s: f64) -> Vec<f64> {
        let first = self.speeds.first().copied().unwrap_or(0.0);
        let ratio = |i: usize| match (i, first) {
            (0, _) => 1.0,
            (_, v) if v != 0.0 => self.speeds[i] / v,
            _ => 0.0,
        };
        (0..self.speeds.len()).map(|i| s * ratio(i)).collect()
    }

    /// Length scale of the first drive's position: 1 for turns, the mechanism's size for slides.
    fn scale(&self) -> f64 {
        let slides = |p: &PairId| self.linkage.mechanism.pairs[*p].kind == PairKind::Sliding;
        if self.drives.first().is_some_and(slides) {
            self.linkage.size
        } else {
            1.0
        }
    }

    /// The matrix of a unit, angles and angular equations made lengths by the mechanism's size, all in units of it.
    fn system(&self, pose: &Pose, unit: &Unit) -> DenseSystem {
        let (n, size) = (3 * unit.bodies.len(), self.linkage.size);
        let mut rows = Vec::new();
        for &(p, drive) in &unit.pairs {
            let bodies = self.linkage.mechanism.pairs[p].bodies;
            for (k, row) in self
                .linkage
                .rows(pose, p, drive.is_some())
                .iter()
                .enumerate()
            {
                let scale = self.row_scale(p, k);
                let mut out = vec![0.0; n];
                let row: &Row = row;
                for (end, b) in bodies.iter().enumerate() {
                    if let Some(at) = unit.bodies.iter().position(|x| x == b) {
                        for c in 0..3 {
                            let column = if c == 2 { 1.0 / size } else { 1.0 };
                            out[3 * at + c] += row[end][c] * column * scale;
                        }
                    }
                }
                rows.push(out);
            }
        }
        DenseSystem::new(&rows)
    }

    /// 1 for equations of lengths, the size for those of angles.
    fn row_scale(&self, p: PairId, row: usize) -> f64 {
        let angle = match self.linkage.mechanism.pairs[p].kind {
            PairKind::Turning | PairKind::Rigid => row == 2,
            PairKind::Sliding => row == 0,
        };
        if angle { self.linkage.size } else { 1.0 }
    }

    /// Right sides of a unit's equations: `of` gives those of a pair.
    fn right(&self, unit: &Unit, of: impl Fn(PairId, Option<usize>) -> Vec<f64>) -> Vec<f64> {
        let mut out = Vec::new();
        for &(p, drive) in &unit.pairs {
            let values = of(p, drive);
            out.extend(
                values
                    .iter()
                    .enumerate()
                    .map(|(k, v)| v * self.row_scale(p, k)),
            );
        }
        out
    }

    /// Adds a solution of a unit's system to its bodies.
    fn add(&self, to: &mut Pose, unit: &Unit, x: &[f64]) {
        for (at, &b) in unit.bodies.iter().enumerate() {
            to[b][0] += x[3 * at];
            to[b][1] += x[3 * at + 1];
            to[b][2] += x[3 * at + 2] / self.linkage.size;
        }
    }

    /// Moves every unit onto the drive positions by Newton's method; on failure the unit.
    fn correct(&self, pose: &mut Pose, q: &[f64]) -> Result<(), usize> {
        for (u, unit) in self.units.iter().enumerate() {
            let mut done = unit.bodies.is_empty();
            for _ in 0..CORRECTIONS {
                if done {
                    break;
                }
                let gaps = self.right(unit, |p, drive| {
                    let all = self.linkage.gaps(pose, p, drive.map(|i| q[i]));
                    all.into_iter().map(|g| -g).collect()
                });
                let x = self.system(pose, unit).solve(&gaps).ok_or(u)?;
                let step = x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                if step > self.linkage.size {
                    return Err(u);
                }
                self.add(pose, unit, &x);
                done = step <= CONVERGED * self.linkage.size;
            }
            if !done {
                return Err(u);
            }
        }
        Ok(())
    }

    /// Velocities when the drives move at `speeds`; on failure the unit.
    fn velocities(&self, pose: &Pose, speeds: &[f64]) -> Result<Pose, usize> {
        let mut v: Pose = vec![[0.0; 3]; pose.len()];
        for (u, unit) in self.units.iter().enumerate() {
            let right = self.right(unit, |p, drive| {
                let rows = self.linkage.rows(pose, p, drive.is_some());
                let mut out = self.moved(p, &rows, &v);
                if let (Some(i), Some(last)) = (drive, out.last_mut()) {
                    *last += speeds[i];
                }
                out
            });
            let x = self.system(pose, unit).solve(&right).ok_or(u)?;
            self.add(&mut v, unit, &x);
        }
        Ok(v)
    }

    /// Less what bodies placed already contribute to a pair's equations; those not yet placed have zeros.
    fn moved(&self, p: PairId, rows: &[Row], v: &Pose) -> Vec<f64> {
        let bodies = self.linkage.mechanism.pairs[p].bodies;
        let of = |row: &Row| -> f64 {
            let end = |e: usize| -> f64 { (0..3).map(|c| row[e][c] * v[bodies[e]][c]).sum() };
            -(end(0) + end(1))
        };
        rows.iter().map(of).collect()
    }

    /// Accelerations when the drives move at constant speeds; on failure the unit.
    fn accelerations(&self, pose: &Pose, v: &Pose) -> Result<Pose, usize> {
        let mut a: Pose = vec![[0.0; 3]; pose.len()];
        for (u, unit) in self.units.iter().enumerate() {
            let right = self.right(unit, |p, drive| {
                let rows = self.linkage.rows(pose, p, drive.is_some());
                let bends = self.linkage.bends(pose, v, p, drive.is_some());
                let moved = self.moved(p, &rows, &a);
                moved.iter().zip(bends).map(|(m, b)| m + b).collect()
            });
            let x = self.system(pose, unit).solve(&right).ok_or(u)?;
            self.add(&mut a, unit, &x);
        }
        Ok(a)
    }

    /// The full state at a pose whose drives are at the positions for `s`.
    fn instant(&self, s: f64, pose: &Pose) -> Result<Instant, usize> {
        let velocity = self.velocities(pose, &self.speeds)?;
        Ok(Instant {
            drive: s,
            drives: self.drive_positions(s),
            acceleration: self.accelerations(pose, &velocity)?,
            velocity,
            pose: pose.clone(),
        })
    }

    /// Condition of each group's equations at a pose, in order of the groups: ratio of the greatest and smallest
    /// singular values, lengths in units of the mechanism's size.
    #[must_use]
    pub fn conditions(&self, pose: &Pose) -> Vec<f64> {
        let groups = self.units.iter().filter(|u| u.group.is_some());
        groups.map(|u| self.system(pose, u).condition()).collect()
    }

    /// Follows the first drive through `positions`, from the pose of the file, and hands over each.
    ///
    /// # Errors
    /// At a dead point, with the last pose reached.
    ///
    /// # Complexity
    /// O(Σ g³) a step, g bodies in a group.
    pub fn follow(&self, positions: &[f64]) -> (Vec<Instant>, Option<DeadPoint>) {
        let mut pose = self.linkage.home();
        let (mut at, mut out) = (0.0, Vec::new());
        for &to in positions {
            match self.advance(&mut pose, at, to).and_then(|()| {
                let found = self.instant(to, &pose).map_err(|u| (to, u))?;
                // Speeds without bound are no speeds.
                match self.stuck(&pose) {
                    Some(u) => Err((to, u)),
                    None => Ok(found),
                }
            }) {
                Ok(found) => out.push(found),
                Err((drive, unit)) => {
                    let dead = DeadPoint {
                        drive,
                        group: self.units[unit].group,
                        condition: self.system(&pose, &self.units[unit]).condition(),
                        pose,
                    };
                    return (out, Some(dead));
                }
            }
            at = to;
        }
        (out, None)
    }

    /// A unit whose equations are singular to working precision.
    fn stuck(&self, pose: &Pose) -> Option<usize> {
        (0..self.units.len()).find(|&u| self.system(pose, &self.units[u]).condition() > WORST)
    }

    fn signs(&self, pose: &Pose) -> Vec<bool> {
        let sign = |u| self.system(pose, u).is_positive();
        self.units.iter().map(sign).collect()
    }

    /// Takes the first drive from `from` to `to`; on failure how far it came and the unit that stopped it.
    fn advance(&self, pose: &mut Pose, from: f64, to: f64) -> Result<(), (f64, usize)> {
        let (mut at, mut step) = (from, to - from);
        let unit_speed: Vec<f64> = self.drive_positions(1.0);
        let signs = self.signs(pose);
        while at != to {
            let target = if (to - at).abs() <= step.abs() {
                to
            } else {
                at + step
            };
            let tried = self.velocities(pose, &unit_speed).and_then(|v| {
                let mut next = pose.clone();
                for (p, v) in next.iter_mut().zip(&v) {
                    (0..3).for_each(|c| p[c] += v[c] * (target - at));
                }
                let guess = next.clone();
                self.correct(&mut next, &self.drive_positions(target))?;
                match self.strayed(&guess, &next).or_else(|| {
                    let now = self.signs(&next);
                    signs.iter().zip(&now).position(|(a, b)| a != b)
                }) {
                    Some(u) => Err(u),
                    None => Ok(next),
                }
            });
            match tried {
                Ok(next) => {
                    *pose = next;
                    at = target;
                    step *= 2.0;
                }
                Err(unit) => {
                    step = (target - at) / 2.0;
                    if step.abs() < SMALLEST_STEP * self.scale() {
                        return Err((at, unit));
                    }
                }
            }
        }
        Ok(())
    }

    /// The first unit that came to lie far from where its tangent pointed.
    fn strayed(&self, guess: &Pose, found: &Pose) -> Option<usize> {
        let far = |b: BodyId| {
            let d = |c: usize| (guess[b][c] - found[b][c]).abs();
            d(0).max(d(1)) > TRUST * self.linkage.size || d(2) > TRUST
        };
        self.units
            .iter()
            .position(|u| u.bodies.iter().any(|&b| far(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::mechanism::JointId;
    use crate::statics::assur::decompose;
    use crate::statics::planar::{Body, Pair, PlanarMechanism};

    /// A four-bar whose coupler and rocker are a line but for how far their pin is beside it.
    fn four_bar(beside: f64) -> Linkage {
        let body = |name: &str| Body {
            link: None,
            name: name.to_owned(),
        };
        let pair = |(i, bodies, point): (usize, [BodyId; 2], [f64; 2])| Pair {
            joint: JointId::new(i),
            name: i.to_string(),
            bodies,
            kind: PairKind::Turning,
            point,
            along: [1.0, 0.0],
            drive: i == 0,
        };
        let pairs = [
            (0, [0, 1], [0.0, -1.0]),
            (1, [1, 2], [0.0, 0.0]),
            (2, [2, 3], [1.0, beside]),
            (3, [3, 0], [2.0, 0.0]),
        ];
        Linkage::new(PlanarMechanism {
            bodies: ["frame", "crank", "coupler", "rocker"].map(body).to_vec(),
            pairs: pairs.map(pair).to_vec(),
            frame: 0,
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            metres: 1.0,
            unit: "m",
        })
    }

    /// With coupler and rocker in a line the crank goes no further; so near to it that speeds have no digit left, neither.
    #[test]
    fn at_a_dead_point_to_working_precision_there_are_no_speeds() {
        for (beside, dead) in [(0.0, true), (1e-14, true), (1e-9, false), (0.5, false)] {
            let linkage = four_bar(beside);
            let parts = decompose(&linkage.mechanism, &[0]).unwrap();
            let (found, stopped) = Motion::new(&linkage, &parts, &[1.0]).follow(&[0.0]);
            assert_eq!(
                (found.is_empty(), stopped.is_some()),
                (dead, dead),
                "{beside}"
            );
            assert!(stopped.is_none_or(|d| d.group == Some(0)), "{beside}");
        }
    }
}
