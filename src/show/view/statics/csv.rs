//! Statics as CSV, in SI units.

use crate::format::csv::write_table;
use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::contour_group::solutions::GroupMethod;
use crate::statics::cycle::Moment;
use crate::statics::kinetostatics::Reaction;
use crate::view::statics::StaticsData;

const HEADS: &str = "drive,method,joint,from,on,x_m,y_m,fx_N,fy_N,moment_Nm,effort";

/// Returns a line for each drive position, method and joint: every joint by the equilibrium, those of the four-link groups by the
/// other methods too. The force is that on `on`; for sliding joints the moment is about (x, y).
pub fn statics_csv(s: &StaticsData<'_>) -> String {
    let m = s.planar_mechanism();
    let mut rows = Vec::new();
    for x in &s.found.moments {
        let mut add = |method: GroupMethod, on: usize, r: &Reaction| {
            let pair = &m.pairs[r.pair];
            let from = pair.other_body(on).unwrap_or(on);
            let mut row = vec![x.drive.to_string(), method.name().to_owned()];
            let [from, on] = [from, on].map(|b| m.bodies[b].name.clone());
            row.extend([pair.name.clone(), from, on]);
            let numbers = [r.point[0], r.point[1], r.force[0], r.force[1], r.moment];
            row.extend(numbers.map(|v| v.to_string()));
            row.push(r.effort.map_or_else(String::new, |e| e.to_string()));
            rows.push(row);
        };
        for &method in s.methods {
            if method == GroupMethod::Equilibrium {
                let all = x.reactions.iter();
                all.for_each(|r| add(method, m.pairs[r.pair].bodies[1], r));
            }
        }
        for at in 0..x.groups.len() {
            for &method in s.methods {
                if method != GroupMethod::Equilibrium {
                    let all = of_group(s, x, at, method);
                    all.iter().for_each(|(on, r)| add(method, *on, r));
                }
            }
        }
    }
    write_table(&HEADS.split(',').collect::<Vec<_>>(), rows)
}

/// Returns the reactions of the six joints of a four-link group by one method, each with the link acted on.
fn of_group(
    s: &StaticsData<'_>,
    x: &Moment,
    at: usize,
    method: GroupMethod,
) -> Vec<(usize, Reaction)> {
    let (g, l) = (&x.groups[at], &s.found.contour_groups[at].1);
    let Some(r) = g.reactions_by(method) else {
        return Vec::new();
    };
    let pose = &g.pose;
    let guide = s.found.linkage.pair_position(&x.pose, l.guide);
    let places = [
        (l.d, l.ternary, pose.d),
        (l.f, l.rods[0], pose.f),
        (l.k, l.rods[1], pose.k),
        (l.m, l.rods[0], pose.m),
        (l.l, l.rods[1], pose.l),
        (l.guide, l.slider, guide),
    ];
    let each = places.into_iter().zip(r.force_vectors(pose));
    each.map(|((pair, on, point), force)| {
        let is_guide = pair == l.guide;
        let reaction = Reaction {
            pair,
            point,
            force,
            moment: if is_guide {
                guide_moment(&r, pose, guide)
            } else {
                0.0
            },
            effort: None,
        };
        (on, reaction)
    })
    .collect()
}

/// Returns the moment of the guide's reaction about a point.
fn guide_moment(r: &GroupReactions, pose: &GroupPose, about: [f64; 2]) -> f64 {
    let normal = pose.guide_normal().map(|c| c * r.guide);
    let arm = [pose.d[0] - about[0], pose.d[1] - about[1]];
    r.guide_moment + arm[0] * normal[1] - arm[1] * normal[0]
}
