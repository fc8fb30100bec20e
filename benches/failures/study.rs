//! Loss of accuracy of the three methods for the four-link group as its geometry approaches each configuration in which
//! they fail.
//!
//! The reference is exact: the same doubles solved in rational arithmetic. Every distance is tested on several groups
//! that differ by small random shifts of their points, and the median error is reported.

use super::exact::solve_exactly;
use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use ozols::statics::contour_group::equilibrium::solve_equilibrium;
use ozols::statics::contour_group::pose::{GroupPose, GroupReactions};
use ozols::statics::contour_group::{delta_point, projective};
use ozols::statics::cycle::Statics;
use ozols::statics::kinetostatics::{Load, LoadSource};
use ozols::statics::pose::{cross, length, minus, plus, quarter_turn};
use rayon::prelude::*;

/// Number of groups tested at each distance in [`study_failures`].
pub(crate) const GROUPS: usize = 9;

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

    /// Returns a word for files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Failure::ParallelRods => "parallel-rods",
            Failure::AcrossGuide => "across-guide",
            Failure::AtDelta => "at-delta",
            Failure::NoGuideReaction => "no-guide-reaction",
        }
    }
}

/// Returns the first four-link group with a closed contour, in the pose in which external forces load it most.
pub(crate) fn heaviest_group(found: &Statics) -> Option<&GroupPose> {
    let weight = |g: &&GroupPose| -> f64 {
        let outside = g.loads.iter().filter(|l| l.source == LoadSource::External);
        outside.map(|l| l.force[0].hypot(l.force[1])).sum()
    };
    let first = found.moments.iter().filter_map(|x| x.groups.first());
    let poses = first.map(|g| &g.pose);
    poses.max_by(|a, b| weight(a).total_cmp(&weight(b)))
}

/// A measure of each method: δ-point, projective, equilibrium.
pub(crate) type ByMethod = [f64; 3];

/// Errors at one distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DistanceErrors {
    /// The distance from the failure.
    pub distance: f64,
    /// Largest error of a reaction over the largest reaction.
    pub forces: ByMethod,
    /// Relative error of the arm h.
    pub arm: ByMethod,
    /// Condition number of the equilibrium equations.
    pub condition: f64,
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
            let normal = g.guide_normal();
            push_link(&mut g, 3, base.m, normal.map(|c| c * off));
        }
    }
    Some(g)
}

/// Adds a force on a link.
pub(crate) fn push_link(g: &mut GroupPose, link: usize, point: [f64; 2], force: [f64; 2]) {
    g.loads.push(Load {
        body: link,
        source: LoadSource::External,
        point,
        force,
        moment: 0.0,
    });
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

/// Returns the median errors near every failure at distances 1 down to 1e-15, each for [`GROUPS`] groups near `base`.
pub(crate) fn study_failures(base: &GroupPose, seed: u64) -> Vec<(Failure, Vec<DistanceErrors>)> {
    let distances = failure_distances();
    Failure::ALL
        .par_iter()
        .map(|&f| (f, sample_errors(base, f, &distances, GROUPS, seed)))
        .collect()
}

/// Returns distances 1 down to 1e-15, four per decade.
fn failure_distances() -> Vec<f64> {
    (0..=60).map(|i| 10f64.powf(-f64::from(i) / 4.0)).collect()
}
