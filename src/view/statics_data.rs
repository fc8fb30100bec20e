//! Statics as JSON and CSV, in SI units.

use crate::statics::assur::{Decomposition, Group};
use crate::statics::contour_group::{GroupPose, GroupReactions};
use crate::statics::cycle::{GroupSolutions, Moment, Statics, Structure};
use crate::statics::planar::{PairId, PlanarMechanism};
use crate::view::statics_words::GroupMethod;
use serde_json::{Value, json};
use std::fmt::Write;

fn names<'a>(s: &'a Statics, pairs: &[PairId]) -> Vec<&'a str> {
    let all = &s.linkage.mechanism.pairs;
    pairs.iter().map(|&p| all[p].name.as_str()).collect()
}

/// Everything found. Forces in N, moments in N·m, lengths in m, drive positions in rad or m; numbers that do not exist are null.
#[must_use]
pub fn json(name: &str, s: &Statics, methods: &[GroupMethod]) -> Value {
    let (m, d) = (&s.linkage.mechanism, &s.decomposition);
    let body = |b: usize| m.bodies[b].name.as_str();
    json!({
        "mechanism": name,
        "drives": names(s, &d.drives),
        "driven": d.driven.iter().map(|&b| body(b)).collect::<Vec<_>>(),
        "class": d.class(),
        "groups": groups(m, d, &s.conditions),
        "positions": s.moments.iter().map(|x| position(s, x, methods)).collect::<Vec<_>>(),
        "stopped": s.dead.as_ref().map(|dead| json!({
            "drive": dead.drive,
            "group": dead.group,
            "condition": dead.condition,
            "pose": m.bodies.iter().zip(&dead.pose).map(|(b, p)| json!({"link": b.name, "placement": p})).collect::<Vec<_>>(),
        })),
    })
}

fn position(s: &Statics, x: &Moment, methods: &[GroupMethod]) -> Value {
    let m = &s.linkage.mechanism;
    let reactions = x.whole.iter().flat_map(|e| &e.reactions).map(|r| {
        let pair = &m.pairs[r.pair];
        json!({
            "joint": pair.name,
            "from": m.bodies[pair.bodies[0]].name,
            "on": m.bodies[pair.bodies[1]].name,
            "point": r.point,
            "force": r.force,
            "moment": r.moment,
            "effort": r.effort,
        })
    });
    let groups = x.groups.iter().map(|g| {
        let found = methods.iter().filter_map(|k| {
            let r = k.of(g)?;
            Some((k.name().to_owned(), method(s, x, g, &r)))
        });
        json!({
            "group": g.group,
            "delta_point": g.steps.delta,
            "l_D_delta": g.steps.l_d_delta,
            "R34_tangential": g.steps.r34_tangential,
            "R34_normal": g.steps.r34_normal,
            "condition": g.equilibrium.map(|e| e.1.condition),
            "residual": g.equilibrium.map(|e| e.1.residual),
            "methods": found.collect::<serde_json::Map<_, _>>(),
        })
    });
    json!({
        "drive": x.instant.drive,
        "reactions": reactions.collect::<Vec<_>>(),
        "condition": x.whole.as_ref().map(|e| e.condition),
        "residual": x.whole.as_ref().map(|e| e.residual),
        "by_groups": x.by_groups.iter().flatten().map(|e| json!({"condition": e.condition, "residual": e.residual})).collect::<Vec<_>>(),
        "drive_power": x.drive_power,
        "load_power": x.load_power,
        "contour_groups": groups.collect::<Vec<_>>(),
    })
}

fn method(s: &Statics, x: &Moment, g: &GroupSolutions, r: &GroupReactions) -> Value {
    let letters = s
        .contour_groups
        .iter()
        .find(|c| c.0 == g.group)
        .map(|c| c.1);
    let offset = letters.map(|l| {
        let guide = s.linkage.place(&x.instant.pose, l.guide);
        r.guide_offset(&g.pose, guide)
    });
    json!({
        "D": r.d, "F": r.f, "K": r.k, "M": r.m, "L": r.l,
        "guide": r.guide, "guide_moment_about_D": r.guide_moment, "h": r.arm, "guide_offset": offset,
    })
}

/// One line a drive position, method and joint: every joint by the equilibrium, those of the four-link groups by the other
/// methods too. The force is that on `on`; for sliding joints the moment is about (x, y).
#[must_use]
pub fn csv(s: &Statics, methods: &[GroupMethod]) -> String {
    let m = &s.linkage.mechanism;
    let mut out = String::from("drive,method,joint,from,on,x_m,y_m,fx_N,fy_N,moment_Nm,effort\n");
    let quoted = |t: &str| {
        if t.contains([',', '"', '\n']) {
            format!("\"{}\"", t.replace('"', "\"\""))
        } else {
            t.to_owned()
        }
    };
    let mut line =
        |drive: f64, method: &str, p: PairId, v: [f64; 5], effort: Option<f64>, turned: bool| {
            let pair = &m.pairs[p];
            let [a, b] = if turned { [1, 0] } else { [0, 1] }
                .map(|e: usize| quoted(&m.bodies[pair.bodies[e]].name));
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "{drive},{method},{},{a},{b},{},{},{},{},{},{}",
                quoted(&pair.name),
                v[0],
                v[1],
                v[2],
                v[3],
                v[4],
                effort.map_or_else(String::new, |e| e.to_string())
            );
        };
    for x in &s.moments {
        let drive = x.instant.drive;
        if methods.contains(&GroupMethod::Equilibrium) {
            for r in x.whole.iter().flat_map(|e| &e.reactions) {
                let v = [r.point[0], r.point[1], r.force[0], r.force[1], r.moment];
                line(drive, "equilibrium", r.pair, v, r.effort, false);
            }
        }
        for (g, (_, l)) in x.groups.iter().zip(&s.contour_groups) {
            for k in methods.iter().filter(|k| **k != GroupMethod::Equilibrium) {
                let Some(r) = k.of(g) else { continue };
                let at = [
                    g.pose.d,
                    g.pose.f,
                    g.pose.k,
                    g.pose.m,
                    g.pose.l,
                    s.linkage.place(&x.instant.pose, l.guide),
                ];
                let pairs = [l.d, l.f, l.k, l.m, l.l, l.guide];
                let on = [
                    l.ternary, l.rods[0], l.rods[1], l.rods[0], l.rods[1], l.slider,
                ];
                for (i, force) in r.forces(&g.pose).into_iter().enumerate() {
                    let moment = if i == 5 {
                        guide_moment(&r, &g.pose, at[5])
                    } else {
                        0.0
                    };
                    let v = [at[i][0], at[i][1], force[0], force[1], moment];
                    line(
                        drive,
                        k.name(),
                        pairs[i],
                        v,
                        None,
                        m.pairs[pairs[i]].bodies[0] == on[i],
                    );
                }
            }
        }
    }
    out
}

/// Moment of the guide's reaction about a point.
fn guide_moment(r: &GroupReactions, pose: &GroupPose, about: [f64; 2]) -> f64 {
    let normal = pose.normal().map(|c| c * r.guide);
    let arm = [pose.d[0] - about[0], pose.d[1] - about[1]];
    r.guide_moment + arm[0] * normal[1] - arm[1] * normal[0]
}

/// The structure under every drive.
#[must_use]
pub fn structures(name: &str, m: &PlanarMechanism, found: &[Structure]) -> Value {
    let one = |x: &Structure| match &x.found {
        Err(e) => json!({"drive": m.pairs[x.drive].name, "error": e.to_string()}),
        Ok((d, conditions)) => json!({
            "drive": m.pairs[x.drive].name,
            "class": d.class(),
            "groups": groups(m, d, conditions),
        }),
    };
    json!({"mechanism": name, "drives": found.iter().map(one).collect::<Vec<_>>()})
}

fn groups(m: &PlanarMechanism, d: &Decomposition, conditions: &[f64]) -> Vec<Value> {
    let pairs =
        |list: &[PairId]| -> Vec<&str> { list.iter().map(|&p| m.pairs[p].name.as_str()).collect() };
    let one = |(i, g): (usize, &Group)| {
        json!({
            "links": g.bodies.iter().map(|&b| m.bodies[b].name.as_str()).collect::<Vec<_>>(),
            "class": g.class.class,
            "order": g.class.order,
            "kind": g.class.to_string(),
            "inner": pairs(&g.inner),
            "outer": pairs(&g.outer),
            "locked": pairs(&g.locked),
            "mobility": g.mobility(),
            "condition": conditions.get(i),
        })
    };
    d.groups.iter().enumerate().map(one).collect()
}
