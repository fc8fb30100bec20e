//! Finite mobility by going there: the dimension of the set of closed poses round a pose.
//!
//! Steps are taken along instantaneous motions and closed again by Newton's method. Where the pose is a regular point of
//! the motion the correction shrinks with the square of the step, in every direction, and the rank of J stays. Where it is
//! not (a branching pose, a dead point, a shaky pose), the poses landed on away from it are examined in the same way:
//! the mobility is the largest found near by. Poses from which nothing but the same pose is reached are shaky; with motions
//! left over (idle turns, say), the dimension is that of the displacements found.
//!
//! Numeric: nothing is proven, and the certainty says so. Random directions come from a fixed seed.

use crate::motion::pose::{FLAT, Pose};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use faer::Mat;

/// Length of a trial step: radians, and fractions of the mechanism's size.
const STEP: f64 = 0.02;
/// Steps used to look for poses away from a singular one.
const REACH: [f64; 2] = [0.1, 0.03];
/// A step that ends closer to the start than this share of itself has come back.
const BACK: f64 = 0.05;
/// Displacements with a smaller share in a direction do not span it.
const SPAN: f64 = 0.05;
/// Steps shrink by this from one singular pose to the next.
const NEARER: f64 = 0.1;
/// How often a singular pose may lead to further singular poses.
const DEPTH: usize = 3;

/// What following the motion found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Traced {
    /// The largest dimension of a motion through poses at or next to the pose.
    pub mobility: usize,
    /// Poses closed on the way.
    pub poses: usize,
    /// Whether the pose itself is a regular one.
    pub regular: bool,
}

/// The dimension of the closed poses at and near `pose`, none where a budget of closed poses runs out.
///
/// # Complexity
/// About 4 W closings of O((6k)² f) each at a regular pose, and some hundred at a singular one.
#[must_use]
pub fn mobility(pose: &Pose, budget: usize) -> Option<Traced> {
    let mut search = Search {
        random: ChaCha8Rng::seed_from_u64(1),
        poses: 0,
        budget,
    };
    let (mobility, regular) = search.dimension(pose, 0)?;
    Some(Traced {
        mobility,
        poses: search.poses,
        regular,
    })
}

/// Null space of J at a pose: `f - rank` orthonormal columns.
#[must_use]
pub fn motions(pose: &Pose) -> Mat<f64> {
    let f = pose.columns.len();
    if pose.rows() == 0 {
        return Mat::identity(f, f);
    }
    let jacobian = pose.jacobian(&vec![0.0; f]);
    let Ok(svd) = jacobian.svd() else {
        return Mat::zeros(f, 0);
    };
    let values = svd.S().column_vector();
    let largest = if values.nrows() > 0 { values[0] } else { 0.0 };
    let rank = (0..values.nrows())
        .filter(|&i| values[i] > FLAT * largest.max(1.0))
        .count();
    svd.V().subcols(rank, f - rank).to_owned()
}

struct Search {
    random: ChaCha8Rng,
    poses: usize,
    budget: usize,
}

fn norm(x: impl IntoIterator<Item = f64>) -> f64 {
    x.into_iter().map(|x| x * x).sum::<f64>().sqrt()
}

impl Search {
    /// A random unit vector in the span of some columns.
    fn direction(&mut self, span: &Mat<f64>) -> Vec<f64> {
        // A sum of twelve uniform numbers is near enough to normal, the same on every machine.
        let weights: Vec<f64> = (0..span.ncols())
            .map(|_| {
                (0..12)
                    .map(|_| f64::from(self.random.next_u32()) / f64::from(u32::MAX) - 0.5)
                    .sum()
            })
            .collect();
        let v: Vec<f64> = (0..span.nrows())
            .map(|r| (0..span.ncols()).map(|c| span[(r, c)] * weights[c]).sum())
            .collect();
        let size = norm(v.iter().copied());
        v.into_iter().map(|x| x / size).collect()
    }

    /// Closes the pose after a step; `None` in the outer option for an exhausted budget.
    fn land(&mut self, pose: &Pose, direction: &[f64], step: f64) -> Option<Option<Vec<f64>>> {
        if self.poses >= self.budget {
            return None;
        }
        self.poses += 1;
        Some(
            pose.close(direction.iter().map(|x| x * step).collect(), &[])
                .ok(),
        )
    }

    /// Whether steps in random directions of `span` need corrections of second order only.
    fn smooth(&mut self, pose: &Pose, span: &Mat<f64>, scale: f64) -> Option<bool> {
        let first = STEP * scale;
        for _ in 0..(span.ncols() + 2).min(8) {
            let d = self.direction(span);
            let mut corrections = [0.0; 2];
            for (correction, step) in corrections.iter_mut().zip([first, first / 4.0]) {
                let Some(q) = self.land(pose, &d, step)? else {
                    return Some(false);
                };
                *correction = norm(q.iter().zip(&d).map(|(q, d)| q - step * d));
            }
            // 16 for a quadratic, 4 where the direction is not that of a motion.
            // Errors of the coordinates alone make some correction, whatever the step.
            let least = if pose.accuracy() > 0.0 {
                first / 1e3
            } else {
                1e-9
            };
            if corrections[0] > least && corrections[1] > corrections[0] / 8.0 {
                return Some(false);
            }
            if corrections[0] > first / 2.0 {
                return Some(false);
            }
        }
        Some(true)
    }

    fn dimension(&mut self, pose: &Pose, depth: usize) -> Option<(usize, bool)> {
        // Ever closer to the pose, or the other branches would be met again.
        let scale = NEARER.powi(i32::try_from(depth).unwrap_or(0));
        let span = motions(pose);
        let free = span.ncols();
        if free == 0 || self.smooth(pose, &span, scale)? {
            return Some((free, true));
        }
        // A singular pose: go elsewhere, and remember where one can go.
        let mut landed: Vec<(usize, Vec<f64>, f64)> = Vec::new();
        for n in 0..(2 * free + 10) {
            let d = self.direction(&span);
            let step = scale * REACH[n % REACH.len()];
            let Some(q) = self.land(pose, &d, step)? else {
                continue;
            };
            if norm(q.iter().copied()) > BACK * step {
                let there = pose.moved(&q);
                let gap = norm(pose.gaps(&q));
                landed.push((motions(&there).ncols(), q, gap));
            }
        }
        // The cleanest first: poses on one branch close to the last digit, poses between two branches do not.
        landed.sort_by(|a, b| a.2.total_cmp(&b.2));
        let mut best = 0;
        // Elsewhere with fewer instantaneous motions: the best of the poses of each kind.
        let mut kinds: Vec<usize> = landed
            .iter()
            .map(|(m, ..)| *m)
            .filter(|&m| m < free)
            .collect();
        kinds.sort_unstable();
        kinds.dedup();
        if depth < DEPTH {
            for kind in kinds.iter().rev().take(3) {
                for (_, q, _) in landed.iter().filter(|(m, ..)| m == kind).take(2) {
                    let there = pose.moved(q);
                    best = best.max(self.dimension(&there, depth + 1)?.0);
                }
            }
        }
        let same: Vec<&Vec<f64>> = landed
            .iter()
            .filter(|(m, ..)| *m >= free)
            .map(|(_, q, _)| q)
            .collect();
        if same.is_empty() {
            return Some((best, false));
        }
        // Nothing changes along the motion: J is short of rank all along it, and the displacements tell its dimension.
        let part: Mat<f64> = Mat::from_fn(free, same.len(), |i, j| {
            let q = same[j];
            let size = norm(q.iter().copied());
            let along = q.iter().enumerate().map(|(r, x)| span[(r, i)] * x);
            along.sum::<f64>() / size
        });
        let Ok(svd) = part.svd() else {
            return Some((best, false));
        };
        let values = svd.S().column_vector();
        let dimension = (0..values.nrows())
            .filter(|&i| values[i] > SPAN * values[0])
            .count();
        let reached = &span * svd.U().subcols(0, dimension);
        if dimension <= best || self.smooth(pose, &reached, scale)? {
            return Some((best.max(dimension), false));
        }
        if depth < DEPTH {
            for q in same.iter().take(6) {
                // A motion of as many dimensions as there are instantaneous ones would have been smooth here.
                if best + 1 >= free {
                    break;
                }
                let there = pose.moved(q);
                best = best.max(self.dimension(&there, depth + 1)?.0);
            }
        }
        Some((best, false))
    }
}
