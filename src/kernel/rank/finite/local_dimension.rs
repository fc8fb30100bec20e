//! Finite mobility by following the motion: the numerical dimension of the set of closed poses around a pose.
//!
//! At a regular pose every instantaneous motion extends. A step along it closes with only transverse corrections, even at a distance at
//! which shaky poses have clear gaps. At a singular pose the set of closed poses is locally a cone over its section with a small sphere
//! [Milnor 1968]. So branches are sought on the sphere. Starts come from the tangent cone (`tangent_cone`). A closed pose on a sphere
//! counts only if it can be followed from sphere to sphere, inwards to the pose and outwards again.
//!
//! A pose that closes nearby may still be shaky if the gap is a high power of the path length. So a motion counts only if it continues
//! much farther (`continuation`). Each branch is examined in the same way at its far end. The largest dimension of the branches is the
//! local dimension [Wampler, Hauenstein & Sommese 2011]. The result is numeric and is marked as such: nothing is proven. Random
//! directions come from a fixed seed.

pub(in crate::rank::finite) mod continuation;

use crate::motion::close::Newton;
use crate::motion::pose::Pose;
use crate::rank::finite::tangent_cone::{self, Flat, Quadrics};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use ozols_dense::{Matrix, difference, dot, norm, svd};

/// Lengths of trial steps at a pose that may be regular: radians, and fractions of the mechanism's size.
const STEPS: [f64; 3] = [0.2, 0.08, 0.03];
/// Spheres from which branches are followed.
const SPHERES: [f64; 3] = [0.1, 0.03, 0.25];
/// Ratio of one sphere's radius to the previous one.
const INWARD: f64 = 0.7;
/// Radii of the innermost and the outermost sphere.
const FOLLOWED: std::ops::Range<f64> = 0.012..0.3;
/// Number of branches followed from one singular pose.
const BRANCHES: usize = 12;
/// Minimum share of a displacement in a direction for it to span that direction.
const SPAN: f64 = 0.1;
/// Depth to which singular poses may lead to further singular poses.
const DEPTH: usize = 2;
/// Maximum number of Newton steps per pose.
const NEWTON: usize = 50;

/// Result of following the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Traced {
    /// The largest dimension of a motion through poses at or next to the pose.
    pub mobility: usize,
    /// The largest dimension that is not excluded.
    pub at_most: usize,
    /// Number of poses closed.
    pub poses: usize,
    /// Whether the pose itself is regular.
    pub regular: bool,
}

/// Returns the dimension of the closed poses at and near `pose`, or `None` if the budget of closures runs out. `motions` is the
/// instantaneous mobility. `shaky` means that some of it is only infinitesimal.
///
/// # Complexity
/// About W closures of O((6k)² f) each at a regular pose, and a few hundred at a singular one.
#[must_use]
pub fn mobility_by_following(
    pose: &Pose,
    motions: usize,
    shaky: bool,
    budget: usize,
) -> Option<Traced> {
    let mut search = DimensionSearch {
        random: ChaCha8Rng::seed_from_u64(1),
        poses: 0,
        budget,
    };
    let found = search.dimension_at(pose, Some(motions), shaky, 1.0, 0)?;
    Some(Traced {
        poses: search.poses,
        ..found
    })
}

/// Returns the null space of J at a pose: `f - rank` orthonormal columns.
#[must_use]
pub fn null_space_of(pose: &Pose) -> Matrix {
    Flat::new(pose, None).kernel
}

impl Traced {
    fn exactly(dimension: usize, regular: bool) -> Traced {
        Traced {
            regular,
            ..Traced::between(dimension, dimension)
        }
    }

    fn between(mobility: usize, at_most: usize) -> Traced {
        Traced {
            mobility,
            at_most,
            poses: 0,
            regular: false,
        }
    }
}

/// Additional equations next to those of the contours: their values and rows at some coordinates.
type Beside<'a> = &'a dyn Fn(&[f64]) -> Vec<(f64, Vec<f64>)>;

struct DimensionSearch {
    random: ChaCha8Rng,
    poses: usize,
    budget: usize,
}

impl DimensionSearch {
    /// Returns a random unit vector.
    fn random_direction(&mut self, n: usize) -> Vec<f64> {
        // A sum of twelve uniform numbers is close enough to normal, and the same on every machine.
        let mut uniform = || f64::from(self.random.next_u32()) / f64::from(u32::MAX) - 0.5;
        let v: Vec<f64> = (0..n).map(|_| (0..12).map(|_| uniform()).sum()).collect();
        let size = norm(&v).max(1e-9);
        v.into_iter().map(|x| x / size).collect()
    }

    /// Returns coordinates near `q` that satisfy all equations best, with the remaining gap. Returns `None` if the budget is spent.
    fn close_near(
        &mut self,
        pose: &Pose,
        q: Vec<f64>,
        beside: Beside<'_>,
    ) -> Option<(Vec<f64>, f64)> {
        if self.poses >= self.budget {
            return None;
        }
        self.poses += 1;
        let stops = |gaps: &[f64]| match *gaps {
            [.., before, gap] => {
                let earlier = gaps.len().checked_sub(11).map(|i| gaps[i]);
                let stuck = earlier.is_some_and(|earlier| gap > 0.7 * earlier);
                stuck || (gap < pose.closed_tolerance() && gap > 0.1 * before)
            }
            _ => false,
        };
        let (q, gap, _) = pose.close_by_newton(
            q,
            &Newton {
                hold: &[],
                beside,
                steps: NEWTON,
                longest: 0.3,
                most: f64::INFINITY,
                stops: &stops,
            },
        );
        Some((q, gap))
    }

    /// Returns whether motions in random directions of some orthonormal columns extend to a distance, or `None` if that is unclear. With
    /// `apart`, each of them has to continue, as required next to a pose where some motion is stopped.
    fn motions_extend(
        &mut self,
        pose: &Pose,
        span: &Matrix,
        scale: f64,
        apart: bool,
    ) -> Option<Option<bool>> {
        let n = span.ncols();
        let mut open = None;
        for step in STEPS.map(|s| s * scale) {
            let mut all = true;
            for _ in 0..(n + 1).min(4) {
                let x = self.random_direction(n);
                let q = span
                    .combine_columns(&x)
                    .into_iter()
                    .map(|v| v * step)
                    .collect();
                let beside = |q: &[f64]| -> Vec<(f64, Vec<f64>)> {
                    (0..n)
                        .map(|c| {
                            let row = span.col(c);
                            (dot(row, q) - step * x[c], row.to_vec())
                        })
                        .collect()
                };
                let (_, gap) = self.close_near(pose, q, &beside)?;
                if gap > pose.closed_tolerance() {
                    all = false;
                    open = Some(gap);
                    break;
                }
            }
            if all {
                // A gap this small at the longer step can vanish at the shorter one only by a high order.
                if open.is_some_and(|gap| gap <= 1e5 * pose.closed_tolerance()) {
                    return Some(Some(false));
                }
                // Nearby, motions that are stopped by a high order close, too.
                return Some(self.all_go_on(pose, span, apart)?.then_some(true));
            }
        }
        Some(
            open.is_some_and(|gap| gap > 30.0 * pose.closed_tolerance())
                .then_some(false),
        )
    }

    /// Returns a closed pose at a distance from this one, near `q`.
    fn on_sphere(&mut self, pose: &Pose, q: &[f64], radius: f64) -> Option<Option<Vec<f64>>> {
        let size = norm(q).max(1e-300);
        let start = q.iter().map(|x| x * radius / size).collect();
        let beside = |q: &[f64]| -> Vec<(f64, Vec<f64>)> {
            let size = norm(q).max(1e-300);
            vec![(size - radius, q.iter().map(|x| x / size).collect())]
        };
        let (q, gap) = self.close_near(pose, start, &beside)?;
        Some((gap < pose.closed_tolerance()).then_some(q))
    }

    /// Returns the branch that begins in a direction, if there is one.
    fn find_branch(
        &mut self,
        pose: &Pose,
        direction: &[f64],
        scale: f64,
    ) -> Option<Option<Branch>> {
        for radius in SPHERES.map(|s| s * scale) {
            let Some(first) = self.on_sphere(pose, direction, radius)? else {
                continue;
            };
            // The branch must be the same on every sphere inwards to the pose.
            let (mut near, mut r, mut joined) = (first.clone(), radius, true);
            while r * INWARD > FOLLOWED.start * scale {
                r *= INWARD;
                match self.on_sphere(pose, &near, r)? {
                    Some(next) if nearly_parallel(&near, &next) => near = next,
                    _ => {
                        joined = false;
                        break;
                    }
                }
            }
            if !joined {
                continue;
            }
            let (mut far, mut r) = (first, radius);
            while r / INWARD < FOLLOWED.end * scale {
                r /= INWARD;
                match self.on_sphere(pose, &far, r)? {
                    Some(next) if nearly_parallel(&far, &next) => far = next,
                    _ => break,
                }
            }
            return Some(Some(Branch { near, far }));
        }
        Some(None)
    }

    /// Returns the dimensions at a pose. `shaky` means that not all instantaneous motions are known to extend.
    fn dimension_at(
        &mut self,
        pose: &Pose,
        motions: Option<usize>,
        shaky: bool,
        scale: f64,
        depth: usize,
    ) -> Option<Traced> {
        let flat = Flat::new(pose, motions);
        let n = flat.kernel.ncols();
        if n == 0 {
            return Some(Traced {
                regular: flat.clear,
                ..Traced::between(0, usize::from(!flat.clear))
            });
        }
        if !shaky {
            match self.motions_extend(pose, &flat.kernel, scale, depth > 0)? {
                Some(true) => return Some(Traced::exactly(n, true)),
                Some(false) => {}
                None => return Some(Traced::between(0, n)),
            }
        }
        // Not every motion extends, so at most a hypersurface does.
        let at_most = n - 1;
        if n == 1 {
            return Some(Traced::exactly(0, false));
        }
        let quadrics = Quadrics::new(pose, &flat);
        if quadrics.is_definite() {
            return Some(Traced::exactly(0, false));
        }
        let starts = (0..80).map(|_| self.random_direction(n)).collect();
        let seeds = tangent_cone::find_zeros(
            &quadrics,
            tangent_cone::sparse_motions(&flat.kernel),
            starts,
        );
        let mut directions = tangent_cone::choose_zeros(&quadrics, &seeds, BRANCHES);
        if quadrics.is_empty() || directions.len() < 4 {
            directions.extend((0..8).map(|_| self.random_direction(n)));
        }
        let sampled = if quadrics.is_empty() {
            at_most
        } else {
            quadrics.cone_dimension(&seeds).min(at_most)
        };
        let from = self.along_branches(pose, &flat, &directions, scale, depth);
        let to = if self.poses < self.budget {
            sampled.max(from)
        } else {
            at_most
        };
        Some(Traced::between(from, to))
    }

    /// Returns the largest dimension found along branches in some directions, as far as the budget allows.
    fn along_branches(
        &mut self,
        pose: &Pose,
        flat: &Flat,
        directions: &[Vec<f64>],
        scale: f64,
        depth: usize,
    ) -> usize {
        let n = flat.kernel.ncols();
        let (mut best, mut same) = (0, Vec::new());
        for x in directions {
            if best + 1 == n {
                return best;
            }
            let start = flat.kernel.combine_columns(x);
            let opposite: Vec<f64> = start.iter().map(|x| -x).collect();
            let found = match self.find_branch(pose, &start, scale) {
                Some(None) => self.find_branch(pose, &opposite, scale),
                found => found,
            };
            let Some(Some(branch)) = found else { continue };
            // A curve through the pose is a motion if it continues.
            if best == 0 {
                if self.goes_on(pose, &branch.far, &branch.direction_onward(), 1) != Some(true) {
                    continue;
                }
                best = 1;
            }
            let there = pose.moved_to(&branch.far);
            let motions = Flat::new(&there, None).kernel.ncols();
            if motions >= n {
                same.push(branch);
            } else if motions > best && depth < DEPTH {
                let distance = (norm(&branch.far) * 0.5).min(scale);
                let found = self.dimension_at(&there, None, false, distance, depth + 1);
                best = best.max(found.map_or(0, |f| f.mobility));
            }
        }
        if same.is_empty() || best + 1 == n {
            return best;
        }
        // J is rank-deficient all along the motion, and the displacements determine its dimension.
        let part = Matrix::from_fn(pose.columns.len(), same.len(), |r, c| {
            same[c].near[r] / norm(&same[c].near).max(1e-300)
        });
        if let Some(svd) = svd(&part) {
            let d = svd.rank(SPAN);
            let reached = svd.u.cols(0..d);
            if d < n
                && d > best
                && self.motions_extend(pose, &reached, scale, true) == Some(Some(true))
            {
                return d;
            }
        }
        if depth < DEPTH {
            for branch in same.iter().take(3) {
                let distance = (norm(&branch.far) * 0.5).min(scale);
                let there = pose.moved_to(&branch.far);
                let found = self.dimension_at(&there, None, true, distance, depth + 1);
                best = best.max(found.map_or(0, |f| f.mobility));
            }
        }
        best.min(n - 1)
    }
}

/// A curve of closed poses from a pose: coordinates close to the pose and far from it.
struct Branch {
    near: Vec<f64>,
    far: Vec<f64>,
}

impl Branch {
    /// Returns the direction from the near coordinates to the far ones.
    fn direction_onward(&self) -> Vec<f64> {
        difference(&self.far, &self.near)
    }
}

/// Returns true if two coordinates lie in nearly the same direction.
fn nearly_parallel(a: &[f64], b: &[f64]) -> bool {
    dot(a, b) > 0.9 * norm(a) * norm(b)
}

#[cfg(test)]
mod tests {
    use super::nearly_parallel;

    #[test]
    fn branches_join_where_they_go_nearly_the_same_way() {
        let along = [1.0, 0.0];
        let cases = [
            ([0.1, 0.0], true),
            ([1.0, 0.4], true),
            ([1.0, 0.6], false),
            ([0.0, 1.0], false),
            ([-1.0, 0.0], false),
        ];
        for (other, joins) in cases {
            assert_eq!(nearly_parallel(&along, &other), joins, "{other:?}");
        }
    }
}
