//! The equations of [Bychkov, Dvornikov & Zhukov 2018] one by one, against reactions found in exact arithmetic.

use super::shears_text;
use crate::common::*;
use ozols::statics::contour_group::pose::GroupPose;
use ozols::statics::pose::{cross, dot, length, minus, plus, quarter_turn};

/// Moment of the loads on one link about a point: ΣF l + ΣM.
fn moment(g: &GroupPose, link: usize, about: [f64; 2]) -> f64 {
    let own = g.loads.iter().filter(|l| l.body == link);
    own.map(|l| l.moment + cross(minus(l.point, about), l.force))
        .sum()
}

fn force(g: &GroupPose, link: usize) -> [f64; 2] {
    let own = g.loads.iter().filter(|l| l.body == link);
    own.fold([0.0; 2], |s, l| plus(s, 1.0, l.force))
}

/// Links 4, 6, 7, 10 over the cycle, both groups: each printed equation gives the component that exact arithmetic gives.
#[test]
fn each_equation_gives_its_component() {
    let stroke = Stroke {
        from: 0.0,
        to: TAU,
        steps: 24,
    };
    let s = planar_statics(&read(shears_text()), StateId::FREE, Some(stroke)).unwrap();
    let mut tried = 0;
    for g in s.moments.iter().flat_map(|m| &m.groups) {
        let (p, steps) = (&g.pose, &g.steps);
        let exact = super::stability::exact::solve_exactly(p).unwrap();
        let greatest = [exact.d, exact.f, exact.k, exact.m, exact.l]
            .iter()
            .map(|v| length(*v))
            .fold(exact.guide.abs(), f64::max);
        let near = |a: f64, b: f64, what: &str| {
            assert!((a - b).abs() < 1e-9 * greatest, "{what}: {a} {b}");
        };
        let (e6, e7) = (unit(minus(p.f, p.m)), unit(minus(p.k, p.l)));
        // R46^τ = (F_и6 l_и6M + G6 l_G6M)/l_FM, against the part of the reaction at F across the rod; R47^τ alike.
        let r46 = -moment(p, 1, p.m) / length(minus(p.f, p.m));
        near(r46, dot(exact.f, quarter_turn(e6)), "R46^τ");
        near(r46, steps.r46_tangential, "R46^τ");
        let r47 = -moment(p, 2, p.l) / length(minus(p.k, p.l));
        near(r47, dot(exact.k, quarter_turn(e7)), "R47^τ");
        near(r47, steps.r47_tangential, "R47^τ");
        // δ lies on both rods.
        let delta = steps.delta;
        let far = length(minus(delta, p.m)).max(1.0);
        assert!(cross(minus(delta, p.m), e6).abs() < 1e-9 * far);
        assert!(cross(minus(delta, p.l), e7).abs() < 1e-9 * far);
        // R34^τ = (G4 l_G4δ + F_и4 l_и4δ + R64^τ l_Fδ + R74^τ l_Kδ)/l_Dδ.
        let from_delta = minus(p.d, delta);
        let e = unit(from_delta);
        near(length(from_delta), steps.l_d_delta, "l_Dδ");
        let r64 = quarter_turn(e6).map(|x| -r46 * x);
        let r74 = quarter_turn(e7).map(|x| -r47 * x);
        let all =
            moment(p, 0, delta) + cross(minus(p.f, delta), r64) + cross(minus(p.k, delta), r74);
        let r34 = -all / length(from_delta);
        near(r34, dot(exact.d, quarter_turn(e)), "R34^τ");
        near(r34, steps.r34_tangential, "R34^τ");
        // The force plan of the group: R34^n along Dδ, and R_0/10 across the guide.
        near(steps.r34_normal, dot(exact.d, e), "R34^n");
        let across = quarter_turn(p.guide);
        let sum = (0..4).fold(exact.d, |s, link| plus(s, 1.0, force(p, link)));
        near(-dot(sum, across), exact.guide, "R_0/10");
        near(dot(sum, p.guide), 0.0, "along the guide");
        // Moments about D: h of R_0/10.
        let about_d: f64 = (0..4).map(|link| moment(p, link, p.d)).sum();
        assert!(
            (about_d + steps.arm * exact.guide).abs() < 1e-9 * greatest * (1.0 + steps.arm.abs())
        );
        // Force plans of links 7 and 6.
        for (link, near_end, far_end) in [(2, exact.k, exact.l), (1, exact.f, exact.m)] {
            let left = plus(plus(force(p, link), 1.0, near_end), 1.0, far_end);
            near(length(left), 0.0, "force plan of a rod");
        }
        tried += 1;
    }
    assert_eq!(tried, 50);
}
