//! Loss of accuracy of the three methods for the four-link group as its geometry approaches each configuration in which
//! they fail.
//!
//! The reference is exact: the same doubles solved in rational arithmetic. Every distance is tested on several groups
//! that differ by small random shifts of their points, and the median error is reported.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};
use ozols::statics::contour_group::equilibrium::solve_equilibrium;
use ozols::statics::contour_group::pose::{GroupPose, GroupReactions};
use ozols::statics::contour_group::{delta_point, projective};
use ozols::statics::pose::{cross, length, minus, plus, quarter_turn};

/// Returns the reactions in rational arithmetic, with every number of the pose taken exactly, then rounded; `None` if the
/// equations are singular or a number is not finite. Unknowns are the forces at D, F, K, M, L, the guide's and its moment about D.
pub(crate) fn solve_exactly(g: &GroupPose) -> Option<GroupReactions> {
    // For each joint the link that bears the force, and the one that bears its opposite.
    let ends = [(0, 9), (1, 0), (2, 0), (1, 3), (2, 3)];
    let exact = |x: f64| BigRational::from_float(x);
    let vector = |v: [f64; 2]| Some([exact(v[0])?, exact(v[1])?]);
    let mut rows = vec![vec![BigRational::zero(); 13]; 12];
    let mut add = |link: usize, column: usize, at: &[BigRational; 2], force: [BigRational; 2]| {
        if link > 3 {
            return;
        }
        let [x, y] = force;
        rows[3 * link + 2][column] += &at[0] * &y - &at[1] * &x;
        rows[3 * link][column] += x;
        rows[3 * link + 1][column] += y;
    };
    let (zero, one) = (BigRational::zero(), exact(1.0)?);
    for (j, (point, (on, from))) in [g.d, g.f, g.k, g.m, g.l].into_iter().zip(ends).enumerate() {
        let at = vector(point)?;
        for (link, sign) in [(on, one.clone()), (from, -one.clone())] {
            add(link, 2 * j, &at, [sign.clone(), zero.clone()]);
            add(link, 2 * j + 1, &at, [zero.clone(), sign]);
        }
    }
    add(3, 10, &vector(g.d)?, vector(g.guide_normal())?);
    for load in &g.loads {
        add(
            load.body,
            12,
            &vector(load.point)?,
            vector(load.force)?.map(|c| -c),
        );
    }
    for load in &g.loads {
        rows[3 * load.body + 2][12] -= exact(load.moment)?;
    }
    rows[11][11] = one;
    for c in 0..12 {
        let pivot = (c..12).find(|&r| !rows[r][c].is_zero())?;
        rows.swap(c, pivot);
        let top: Vec<BigRational> = rows[c].iter().map(|x| x / &rows[c][c]).collect();
        for (r, row) in rows
            .iter_mut()
            .enumerate()
            .filter(|(_, row)| !row[c].is_zero())
        {
            let factor = if r == c { continue } else { row[c].clone() };
            for (x, t) in row.iter_mut().zip(&top).skip(c) {
                *x -= &factor * t;
            }
        }
        rows[c] = top;
    }
    let x = |i: usize| rows[i][12].to_f64().unwrap_or(f64::NAN);
    let at = |j: usize| [x(2 * j), x(2 * j + 1)];
    let arm = (!rows[10][12].is_zero()).then(|| (&rows[11][12] / &rows[10][12]).to_f64());
    Some(GroupReactions {
        d: at(0),
        f: at(1),
        k: at(2),
        m: at(3),
        l: at(4),
        guide: x(10),
        guide_moment: x(11),
        arm: arm.flatten().unwrap_or(f64::INFINITY),
    })
}

/// Configurations in which the δ-point method fails. `[Bychkov, Dvornikov & Zhukov 2018]`
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Failure {
    /// Rods 6 and 7 are parallel: δ is at infinity. The distance is their angle `[rad]`.
    ParallelRods,
    /// D lies on the line through δ along the guide's normal: R34^n and R_0/10 are parallel, and the group moves. The
    /// distance is the angle between Dδ and the normal `[rad]`.
    AcrossGuide,
    /// D is at δ. The distance is the ratio of l_Dδ to its original value.
    AtDelta,
    /// The guide has no load: h is undefined. The distance is the ratio of R_0/10 to its original value.
    NoGuideReaction,
}

impl Failure {
    /// All four configurations.
    pub(crate) const ALL: [Failure; 4] = [
        Failure::ParallelRods,
        Failure::AcrossGuide,
        Failure::AtDelta,
        Failure::NoGuideReaction,
    ];
}

/// A measure of each method: δ-point, projective, equilibrium.
pub(crate) type ByMethod = [f64; 3];

/// Errors at one distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DistanceErrors {
    /// The distance from the failure.
    pub(crate) distance: f64,
    /// Largest error of a reaction over the largest reaction.
    pub(crate) forces: ByMethod,
    /// Relative error of the arm h.
    pub(crate) arm: ByMethod,
    /// Condition number of the equilibrium equations.
    pub(crate) condition: f64,
}

fn turn_vector(v: [f64; 2], angle: f64) -> [f64; 2] {
    plus(v.map(|c| c * angle.cos()), angle.sin(), quarter_turn(v))
}

fn delta_point(g: &GroupPose) -> [f64; 2] {
    let (u, v) = (minus(g.f, g.m), minus(g.k, g.l));
    plus(g.m, cross(minus(g.l, g.m), v) / cross(u, v), u)
}

/// Returns a group at a distance from a failure. At distance 1 it has the size of `base`. Returns `None` if `base` has
/// no exact solution.
pub(crate) fn at_distance(base: &GroupPose, failure: Failure, distance: f64) -> Option<GroupPose> {
    let mut g = base.clone();
    let delta = delta_point(base);
    match failure {
        Failure::ParallelRods => {
            let (rod6, rod7) = (minus(g.m, g.f), minus(g.l, g.k));
            let sense = if cross(rod6, rod7) < 0.0 { -1.0 } else { 1.0 };
            let scale = length(rod7) / length(rod6);
            g.l = plus(g.k, scale, turn_vector(rod6, sense * distance));
        }
        Failure::AcrossGuide => {
            let from = minus(g.d, delta);
            let along = plus(
                g.guide_normal().map(|c| c * distance.cos()),
                distance.sin(),
                g.guide,
            );
            g.d = plus(delta, length(from), along);
        }
        Failure::AtDelta => g.d = plus(delta, distance, minus(g.d, delta)),
        Failure::NoGuideReaction => {
            let off = solve_exactly(base)?.guide * (1.0 - distance);
            g.push(3, g.m, g.guide_normal().map(|c| c * off));
        }
    }
    Some(g)
}

fn relative_error(found: f64, exact: f64) -> f64 {
    let error = (found - exact).abs() / exact.abs();
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Returns the errors of the three methods on one group, or `None` if its equilibrium is singular.
fn method_errors(g: &GroupPose, distance: f64) -> Option<DistanceErrors> {
    let reference = solve_exactly(g)?;
    let by_lu = solve_equilibrium(g);
    let found: [Option<GroupReactions>; 3] = [
        Some(delta_point::solve_delta(g).0),
        Some(projective::solve_projective(g)),
        by_lu.map(|x| x.0),
    ];
    let measure = |f: &dyn Fn(GroupReactions) -> f64| found.map(|r| r.map_or(f64::INFINITY, f));
    Some(DistanceErrors {
        distance,
        forces: measure(&|r| r.distance_to(&reference, g)),
        arm: measure(&|r| relative_error(r.arm, reference.arm)),
        condition: by_lu.map_or(f64::INFINITY, |x| x.1.condition),
    })
}

fn shift_points(base: &GroupPose, rng: &mut ChaCha8Rng) -> GroupPose {
    let size = length(minus(base.f, base.d));
    let mut g = base.clone();
    for p in [&mut g.d, &mut g.f, &mut g.k, &mut g.m, &mut g.l] {
        for c in p {
            let unit = (rng.next_u32() >> 1) as f64 / f64::from(1u32 << 31) - 0.5;
            *c += 1e-2 * size * unit;
        }
    }
    g
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Returns the median errors at each distance over some groups near `base`.
///
/// # Complexity
/// O(distances · groups) exact solutions.
pub(crate) fn sample_errors(
    base: &GroupPose,
    failure: Failure,
    distances: &[f64],
    groups: usize,
    seed: u64,
) -> Vec<DistanceErrors> {
    let mut out = Vec::new();
    for &distance in distances {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let all: Vec<DistanceErrors> = (0..groups)
            .filter_map(|_| at_distance(&shift_points(base, &mut rng), failure, distance))
            .filter_map(|g| method_errors(&g, distance))
            .collect();
        let of = |f: &dyn Fn(&DistanceErrors) -> f64| median(all.iter().map(f).collect());
        out.push(DistanceErrors {
            distance,
            forces: [0, 1, 2].map(|k| of(&|s| s.forces[k])),
            arm: [0, 1, 2].map(|k| of(&|s| s.arm[k])),
            condition: of(&|s| s.condition),
        });
    }
    out
}
