//! Statics as CSV, in SI units.

use crate::format::csv::table;
use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::contour_group::solutions::GroupMethod;
use crate::statics::cycle::Moment;
use crate::statics::kinetostatics;
use crate::view::statics::{Reaction, StaticsData};

/// One line a drive position, method and joint: every joint by the equilibrium, those of the four-link groups by the other
/// methods too. The force is that on `on`; for sliding joints the moment is about (x, y).
#[must_use]
pub fn csv(s: &StaticsData<'_>) -> String {
    let mut rows = Vec::new();
    for (position, x) in s.positions.iter().zip(&s.found.moments) {
        let mut add = |method: GroupMethod, r: &Reaction| {
            let mut row = vec![position.drive.to_string(), method.name().to_owned()];
            row.extend([r.joint, r.from, r.on].map(str::to_owned));
            let passed = r.passed;
            let [[x, y], [fx, fy]] = [passed.point, passed.force];
            row.extend([x, y, fx, fy, passed.moment].map(|v| v.to_string()));
            row.push(passed.effort.map_or_else(String::new, |e| e.to_string()));
            rows.push(row);
        };
        if s.methods.contains(&GroupMethod::Equilibrium) {
            let all = position.reactions.iter();
            all.for_each(|r| add(GroupMethod::Equilibrium, r));
        }
        for at in 0..x.groups.len() {
            for method in s.methods {
                if *method != GroupMethod::Equilibrium {
                    let all = of_group(s, x, at, *method);
                    all.iter().for_each(|r| add(*method, r));
                }
            }
        }
    }
    let heads = [
        "drive",
        "method",
        "joint",
        "from",
        "on",
        "x_m",
        "y_m",
        "fx_N",
        "fy_N",
        "moment_Nm",
        "effort",
    ];
    table(&heads, rows)
}

/// What the six joints of a four-link group pass on by one method.
fn of_group<'a>(
    s: &StaticsData<'a>,
    x: &Moment,
    at: usize,
    method: GroupMethod,
) -> Vec<Reaction<'a>> {
    let (linkage, g, l) = (
        &s.found.linkage,
        &x.groups[at],
        &s.found.contour_groups[at].1,
    );
    let Some(r) = g.by(method) else {
        return Vec::new();
    };
    let pose = &g.pose;
    let guide = linkage.place(&x.pose, l.guide);
    let places = [
        (l.d, l.ternary, pose.d),
        (l.f, l.rods[0], pose.f),
        (l.k, l.rods[1], pose.k),
        (l.m, l.rods[0], pose.m),
        (l.l, l.rods[1], pose.l),
        (l.guide, l.slider, guide),
    ];
    let each = places.into_iter().zip(r.forces(pose));
    each.map(|((pair, on, point), force)| {
        let pair_of = &linkage.mechanism.pairs[pair];
        let other = pair_of.other(on).unwrap_or(on);
        let name = |b: usize| linkage.mechanism.bodies[b].name.as_str();
        Reaction {
            joint: &pair_of.name,
            from: name(other),
            on: name(on),
            passed: kinetostatics::Reaction {
                pair,
                point,
                force,
                moment: if pair == l.guide {
                    guide_moment(&r, pose, guide)
                } else {
                    0.0
                },
                effort: None,
            },
        }
    })
    .collect()
}

/// Moment of the guide's reaction about a point.
fn guide_moment(r: &GroupReactions, pose: &GroupPose, about: [f64; 2]) -> f64 {
    let normal = pose.normal().map(|c| c * r.guide);
    let arm = [pose.d[0] - about[0], pose.d[1] - about[1]];
    r.guide_moment + arm[0] * normal[1] - arm[1] * normal[0]
}
