//! The δ-point method in homogeneous coordinates.
//!
//! A force is its line of action, (fx, fy, moment about the origin). A point is (x, y, w), at infinity if w = 0. The
//! moment about a point is w·m - (x, y) × f. About a point at infinity it is the force's component perpendicular to
//! that direction. So δ may go to infinity. The normal forces of the rods come from moments about points of the other
//! rod instead of a force plan, which parallel rods do not close.
//!
//! # Sources
//! `[Bychkov, Dvornikov & Zhukov 2018]` for the method; R. S. Ball, "A Treatise on the Theory of Screws", 1900, for
//! forces as lines.

use crate::geom::vector::{add, sub};
use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::pose::{cross, dot, minus, plus, quarter_turn};

/// A force with its line: (fx, fy, moment about the origin).
type Line = [f64; 3];

/// A point (x, y, w).
type Point = [f64; 3];

fn force_at(point: [f64; 2], force: [f64; 2]) -> Line {
    [force[0], force[1], cross(point, force)]
}

fn sum_lines(lines: impl IntoIterator<Item = Line>) -> Line {
    lines.into_iter().fold([0.0; 3], add)
}

fn finite_point(p: [f64; 2]) -> Point {
    [p[0], p[1], 1.0]
}

/// Returns the intersection of two lines.
fn meet_lines(a: Line, b: Line) -> Point {
    [
        a[0] * b[2] - b[0] * a[2],
        a[1] * b[2] - b[1] * a[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Returns the moment of a force about a point, times its w.
fn moment_about(about: Point, l: Line) -> f64 {
    about[2] * l[2] - (about[0] * l[1] - about[1] * l[0])
}

/// Returns the reactions of a group by the δ-point method in homogeneous coordinates. They are not finite, or
/// worthless, if D lies on the line through δ along the guide's normal, or D is at δ. The same holds for the arm h, but
/// not for the guide's moment, if R_0/10 vanishes.
///
/// # Complexity
/// O(number of loads).
#[must_use]
pub fn solve_projective(g: &GroupPose) -> GroupReactions {
    // An origin within the group keeps moments small.
    let points = [g.d, g.f, g.k, g.m, g.l];
    let middle = points.iter().fold([0.0; 2], |s, p| plus(s, 0.2, *p));
    let [d, f, k, m, l] = points.map(|p| minus(p, middle));
    let load = |link: usize| -> Line {
        let force = g.force_on(link);
        [force[0], force[1], g.moment_on(link, middle)]
    };
    let (to_f, to_k) = (minus(f, m), minus(k, l));
    // Tangential parts, on link 6 at F and on link 7 at K.
    let tangential = |link: usize, foot: [f64; 2], rod: [f64; 2], head: [f64; 2]| {
        let part = -moment_about(finite_point(foot), load(link)) / dot(rod, rod);
        force_at(head, quarter_turn(rod).map(|c| c * part))
    };
    let on6 = tangential(1, m, to_f, f);
    let on7 = tangential(2, l, to_k, k);
    let (line6, line7) = (force_at(m, to_f), force_at(l, to_k));
    let delta = meet_lines(line6, line7);
    // Moments of link 4 about δ give R34 perpendicular to the direction from D to δ.
    let on4 = sub(sub(load(0), on6), on7);
    let along = plus([delta[0], delta[1]], -delta[2], d);
    let part = moment_about(delta, on4) / dot(along, along);
    let across = quarter_turn(along).map(|c| c * part);
    // Forces of the whole group perpendicular to the guide's normal, then along it.
    let loads = sum_lines((0..4).map(load));
    let known = plus([loads[0], loads[1]], 1.0, across);
    let normal = g.guide_normal();
    let r34 = plus(across, -cross(normal, known) / cross(normal, along), along);
    let guide = -dot(plus([loads[0], loads[1]], 1.0, r34), normal) / dot(normal, normal);
    // Moments of the group about D.
    let guide_moment = -moment_about(finite_point(d), loads);
    // Moments of link 4 about a point of one rod's line give the other rod.
    let on4 = sum_lines([on4, force_at(d, r34)]);
    let along_rod = |line: Line, ends: [[f64; 2]; 2]| {
        let arm = |p: &[f64; 2]| moment_about(finite_point(*p), line);
        let [a, b] = ends;
        let best = if arm(&a).abs() >= arm(&b).abs() { a } else { b };
        -moment_about(finite_point(best), on4) / arm(&best)
    };
    let (s6, s7) = (along_rod(line6, [k, l]), along_rod(line7, [f, m]));
    let f = plus([on6[0], on6[1]], -s6, to_f);
    let k = plus([on7[0], on7[1]], -s7, to_k);
    GroupReactions {
        d: r34,
        f,
        k,
        m: plus(g.force_on(1), 1.0, f).map(|c| -c),
        l: plus(g.force_on(2), 1.0, k).map(|c| -c),
        guide,
        guide_moment,
        arm: guide_moment / guide,
    }
}
