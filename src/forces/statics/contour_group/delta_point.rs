//! The δ-point method for the four-link group with a closed contour, step by step as published.
//!
//! # Sources
//! `[Bychkov, Dvornikov & Zhukov 2018]`, equations for links 4, 6, 7, 10. DIFFERENCE: the moment of an inertia force is added as a couple.
//! The source offsets the force by h = M/F, which has no value for a link that turns about its mass centre.

use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::pose::{cross, dot, length, minus, plus, quarter_turn};
use serde::Serialize;

/// Intermediate results of the method; lengths `[m]`, forces `[N]`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DeltaSteps {
    /// δ, the intersection of the lines of rods 6 and 7; not finite if they are parallel `[m]`.
    #[serde(rename = "delta_point")]
    pub delta: [f64; 2],
    /// l_Dδ `[m]`.
    #[serde(rename = "l_D_delta")]
    pub l_d_delta: f64,
    /// R46^τ, at F, a quarter turn on from the direction M to F `[N]`.
    #[serde(rename = "R46_tangential")]
    pub r46_tangential: f64,
    /// R47^τ, at K, a quarter turn on from the direction L to K `[N]`.
    #[serde(rename = "R47_tangential")]
    pub r47_tangential: f64,
    /// R34^τ, at D, a quarter turn on from the direction δ to D `[N]`.
    #[serde(rename = "R34_tangential")]
    pub r34_tangential: f64,
    /// R34^n, at D, in the direction δ to D `[N]`.
    #[serde(rename = "R34_normal")]
    pub r34_normal: f64,
    /// h, the arm of R_0/10 about D `[m]`.
    #[serde(skip)]
    pub arm: f64,
}

fn unit_vector(v: [f64; 2]) -> [f64; 2] {
    let l = length(v);
    v.map(|c| c / l)
}

/// Returns the two coefficients with a·u + b·v + w = 0: the force plan of two known directions.
fn force_plan(u: [f64; 2], v: [f64; 2], w: [f64; 2]) -> [f64; 2] {
    let area = cross(u, v);
    [-cross(w, v) / area, -cross(u, w) / area]
}

/// Returns the reactions of a group by the δ-point method. They are not finite, or worthless, in three cases: rods 6 and 7 are parallel, D
/// lies on the line through δ along the guide's normal, or D is at δ. The same holds for the arm h if R_0/10 vanishes.
///
/// # Complexity
/// O(number of loads).
#[must_use]
pub fn solve_delta(g: &GroupPose) -> (GroupReactions, DeltaSteps) {
    // Moments of link 6 about M and of link 7 about L.
    let (to_f, to_k) = (minus(g.f, g.m), minus(g.k, g.l));
    let (e6, e7) = (unit_vector(to_f), unit_vector(to_k));
    let r46_tangential = -g.moment_on(1, g.m) / length(to_f);
    let r47_tangential = -g.moment_on(2, g.l) / length(to_k);
    // δ lies on both rods' lines.
    let t = cross(minus(g.l, g.m), e7) / cross(e6, e7);
    let delta = plus(g.m, t, e6);
    // Moments of link 4 about δ: the normal parts of R64 and R74 pass through it.
    let from_delta = minus(g.d, delta);
    let l_d_delta = length(from_delta);
    let e = unit_vector(from_delta);
    let l_f_delta = dot(minus(g.f, delta), e6);
    let l_k_delta = dot(minus(g.k, delta), e7);
    let moment = g.moment_on(0, delta) - r46_tangential * l_f_delta - r47_tangential * l_k_delta;
    let r34_tangential = -moment / l_d_delta;
    // Force plan of the group.
    let loads = (0..4).fold([0.0; 2], |s, link| plus(s, 1.0, g.force_on(link)));
    let known = plus(loads, r34_tangential, quarter_turn(e));
    let [r34_normal, guide] = force_plan(e, g.guide_normal(), known);
    let d = plus(quarter_turn(e).map(|c| c * r34_tangential), r34_normal, e);
    // Moments of the group about D.
    let about_d: f64 = (0..4).map(|link| g.moment_on(link, g.d)).sum();
    let arm = -about_d / guide;
    // Force plan of link 4.
    let known = plus(
        plus(d, 1.0, g.force_on(0)),
        -r46_tangential,
        quarter_turn(e6),
    );
    let known = plus(known, -r47_tangential, quarter_turn(e7));
    let [r64_normal, r74_normal] = force_plan(e6, e7, known);
    let f = plus(
        quarter_turn(e6).map(|c| c * r46_tangential),
        -r64_normal,
        e6,
    );
    let k = plus(
        quarter_turn(e7).map(|c| c * r47_tangential),
        -r74_normal,
        e7,
    );
    // Force plans of links 7 and 6.
    let l = plus(g.force_on(2), 1.0, k).map(|c| -c);
    let m = plus(g.force_on(1), 1.0, f).map(|c| -c);
    let reactions = GroupReactions {
        d,
        f,
        k,
        m,
        l,
        guide,
        guide_moment: arm * guide,
        arm,
    };
    let steps = DeltaSteps {
        r46_tangential,
        r47_tangential,
        delta,
        l_d_delta,
        r34_tangential,
        r34_normal,
        arm,
    };
    (reactions, steps)
}
