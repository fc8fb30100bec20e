//! Accuracy near each failure of the δ-point method, against exact arithmetic.

use super::shears_text;
use crate::common::*;
use ozols::statics::contour_group::pose::GroupPose;
use ozols::statics::contour_group::{delta_point, equilibrium, projective};
use study::{
    DistanceErrors, Failure, GROUPS, at_distance, heaviest_group, push_link, sample_errors,
};

#[path = "../../../benches/failures/exact.rs"]
pub(super) mod exact;
#[allow(dead_code, reason = "the bench studies all distances")]
#[path = "../../../benches/failures/study.rs"]
pub(super) mod study;

fn base() -> GroupPose {
    let at = Stroke {
        from: 3.1,
        to: 3.1,
        steps: 1,
    };
    planar_statics(&read(shears_text()), StateId::FREE, Some(at))
        .unwrap()
        .moments[0]
        .groups[0]
        .pose
        .clone()
}

fn at(failure: Failure, distances: &[f64]) -> Vec<DistanceErrors> {
    sample_errors(&base(), failure, distances, 5, 7)
}

#[test]
fn far_from_every_failure_all_methods_are_right() {
    for failure in Failure::ALL {
        let s = at(failure, &[1.0])[0];
        assert!(
            s.forces.iter().chain(&s.arm).all(|e| *e < 1e-13),
            "{failure:?} {s:?}"
        );
    }
}

/// δ at infinity harms the δ-point method alone.
#[test]
fn parallel_rods_harm_only_the_published_form() {
    let found = at(Failure::ParallelRods, &[1e-3, 1e-9, 1e-15]);
    for s in &found {
        assert!(
            s.forces[1] < 1e-14 && s.forces[2] < 1e-14 && s.condition < 1e3,
            "{s:?}"
        );
    }
    assert!(found[1].forces[0] > 1e-10 && found[2].forces[0] > 1e-5);
    // Exactly parallel: no δ at all, and the projective form does not notice.
    let mut g = base();
    (g.f, g.m) = ([-0.5, 0.0], [-0.5, 1.0]);
    (g.k, g.l) = ([0.25, 0.0], [0.25, 1.5]);
    g.d = [0.125, -1.0];
    let exact = exact::solve_exactly(&g).unwrap();
    assert!(projective::solve_projective(&g).distance_to(&exact, &g) < 1e-14);
    let (published, steps) = delta_point::solve_delta(&g);
    assert!(!steps.delta.iter().all(|c| c.is_finite()));
    assert!(published.distance_to(&exact, &g).is_infinite());
}

/// At a dead point of the group every method loses figures as the condition grows, none much more than another.
#[test]
fn dead_points_harm_every_method_alike() {
    for failure in [Failure::AcrossGuide, Failure::AtDelta] {
        for s in at(failure, &[1e-4, 1e-8, 1e-12]) {
            let bound = 1e3 * s.condition * f64::EPSILON;
            assert!(s.forces.iter().all(|e| *e < bound), "{failure:?} {s:?}");
            assert!(s.condition > 0.1 / s.distance, "{s:?}");
        }
        assert!(exact::solve_exactly(&at_distance(&base(), failure, 1e-12).unwrap()).is_some());
    }
}

/// Without a guide reaction h has no value; the forces and the guide's moment do not care.
#[test]
fn a_vanishing_guide_reaction_harms_only_its_arm() {
    for s in at(Failure::NoGuideReaction, &[1e-6, 1e-12]) {
        assert!(s.forces.iter().all(|e| *e < 1e-14), "{s:?}");
        assert!(
            s.arm
                .iter()
                .all(|e| *e > 1e-18 / s.distance && *e < 1e-13 / s.distance),
            "{s:?}"
        );
    }
}

/// The exact solution on numbers that doubles hold exactly: a group whose reactions are known by hand.
#[test]
fn a_group_solved_by_hand() {
    // Rods straight up from F and K to M and L, D below midway, the guide upright, a load of 8 down on the slider midway.
    let mut g = base();
    g.loads.clear();
    (g.d, g.f, g.k) = ([0.0, 0.0], [-1.0, 1.0], [1.0, 1.0]);
    (g.m, g.l) = ([-1.0, 3.0], [1.0, 3.0]);
    g.guide = [0.0, 1.0];
    push_link(&mut g, 3, [0.0, 4.0], [0.0, -8.0]);
    let exact = exact::solve_exactly(&g).unwrap();
    for r in [
        exact,
        projective::solve_projective(&g),
        equilibrium::solve_equilibrium(&g).unwrap().0,
    ] {
        let near = |v: [f64; 2], w: [f64; 2]| (v[0] - w[0]).abs() + (v[1] - w[1]).abs() < 1e-14;
        // D bears 8 up; each rod is pushed up by 4 at its foot, and down by 4 at its head; the guide bears nothing.
        assert!(near(r.d, [0.0, 8.0]), "{r:?}");
        assert!(near(r.f, [0.0, 4.0]) && near(r.k, [0.0, 4.0]), "{r:?}");
        assert!(near(r.m, [0.0, -4.0]) && near(r.l, [0.0, -4.0]), "{r:?}");
        assert!(r.guide.abs() < 1e-14 && r.guide_moment.abs() < 1e-14);
    }
}

/// How the three methods lose digits near each failure, within a factor of three, as processors round otherwise.
#[test]
fn digits_near_the_failures_are_as_the_guide_says() {
    let shears = built_in("parallel-shears");
    let found = planar_statics(&shears, StateId::FREE, shears.loads.stroke).unwrap();
    let base = heaviest_group(&found).unwrap();
    let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide/kinetostatics.md");
    let guide = fs::read_to_string(guide).unwrap();
    for (row, failure, methods) in [
        ("rods 6, 7 parallel: δ-point", Failure::ParallelRods, 0..1),
        ("D across the guide from δ", Failure::AcrossGuide, 0..3),
        ("D at δ", Failure::AtDelta, 0..3),
        ("no guide reaction: h", Failure::NoGuideReaction, 0..3),
    ] {
        let mut lines = guide.lines();
        let stated = lines
            .find(|l| l.starts_with(&format!("| {row} |")))
            .unwrap();
        let stated = stated.split('|').skip(2).take(3);
        let found = sample_errors(base, failure, &[1.0, 1e-6, 1e-12], GROUPS, 1);
        for (s, stated) in found.iter().zip(stated) {
            let arms = failure == Failure::NoGuideReaction;
            let of = if arms { s.arm } else { s.forces };
            // What is exact to the last bit is drawn at the foot.
            let worst = of[methods.clone()]
                .iter()
                .fold(1e-17, |a: f64, x| a.max(*x));
            let stated: f64 = stated.trim().parse().unwrap();
            assert!(
                (stated / 3.0..3.0 * stated).contains(&worst),
                "{row} at {}: {worst:e}",
                s.distance
            );
        }
    }
}

/// The study is of a pose in which the knives cut, by the file from 165 to 200 degrees of the crank, and not of one in which they do not.
#[test]
fn the_heaviest_group_is_that_of_the_cut() {
    use ozols::statics::kinetostatics::LoadSource;
    use ozols::statics::solve::{Model, SolvedReactions, solve_reactions};
    let m = built_in("parallel-shears");
    let found = solve_reactions(&m, StateId::FREE, m.loads.stroke, Model::Planar).unwrap();
    let SolvedReactions::Planar(found) = found else {
        panic!("it is planar")
    };
    assert_eq!(found.moments.len(), 73);
    let plan = heaviest_group(&found).unwrap();
    let outside = plan
        .loads
        .iter()
        .filter(|l| l.source == LoadSource::External);
    let cut: f64 = outside.map(|l| l.force[0].hypot(l.force[1])).sum();
    near(cut, 500_000.0, 1e-6);
}
