//! Statics of a planar mechanism as JSON, text, CSV and charts. SI units; the keys of JSON are a stable contract, and numbers
//! that do not exist are null.

use crate::statics::assur::{Decomposition, Group};
use crate::statics::contour_group::ContourGroup;
use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::contour_group::solutions::{GroupMethod, GroupSolutions};
use crate::statics::cycle::{DeadPoint, DrivenStructure, Moment, Statics};
use crate::statics::kinetostatics::{LinkInertia, Reaction};
use crate::statics::planar::{BodyId, PairId, PlanarMechanism};
use crate::view::prelude::*;

pub mod charts;
pub mod text;
pub mod told;

/// A mechanism's reactions over its cycle.
#[derive(Debug)]
pub struct StaticsData<'a> {
    /// The mechanism.
    pub of: &'a Mechanism,
    /// Its reactions.
    pub found: &'a Statics,
    /// The methods asked for.
    pub methods: &'a [GroupMethod],
}

/// The structure of a mechanism under every possible drive, those at the frame first.
#[derive(Debug)]
pub struct Structures<'a> {
    /// Name of the mechanism.
    pub mechanism: &'a str,
    /// It in its plane.
    pub planar: &'a PlanarMechanism,
    /// The structure under each drive.
    pub found: &'a [DrivenStructure],
}

fn link_names<'a>(m: &'a PlanarMechanism, list: &[BodyId]) -> Vec<&'a str> {
    list.iter().map(|&b| m.bodies[b].name.as_str()).collect()
}

fn joint_names<'a>(m: &'a PlanarMechanism, list: &[PairId]) -> Vec<&'a str> {
    list.iter().map(|&p| m.pairs[p].name.as_str()).collect()
}

fn groups_json(m: &PlanarMechanism, d: &Decomposition, conditions: &[f64]) -> Value {
    let one = |(i, g): (usize, &Group)| {
        json!({
            "links": link_names(m, &g.bodies),
            "class": g.class.class,
            "order": g.class.order,
            "kind": g.class.to_string(),
            "inner": joint_names(m, &g.inner),
            "outer": joint_names(m, &g.outer),
            "locked": joint_names(m, &g.locked),
            "mobility": g.mobility(),
            "condition": conditions.get(i),
        })
    };
    d.groups.iter().enumerate().map(one).collect()
}

impl Structures<'_> {
    /// Returns the structures as data.
    pub fn json(&self) -> Value {
        let m = self.planar;
        let one = |x: &DrivenStructure| {
            let found = match &x.found {
                Ok((d, conditions)) => {
                    json!({ "class": d.highest_class(), "groups": groups_json(m, d, conditions) })
                }
                Err(e) => json!({ "error": e.to_string() }),
            };
            join_objects([json!({ "drive": m.pairs[x.drive].name }), found])
        };
        let drives: Value = self.found.iter().map(one).collect();
        json!({ "mechanism": self.mechanism, "drives": drives })
    }
}

impl<'a> StaticsData<'a> {
    /// Returns the mechanism in its plane.
    fn planar_mechanism(&self) -> &'a PlanarMechanism {
        &self.found.linkage.mechanism
    }

    /// Returns a short name of a group: "4-6-7-10".
    fn group_name(&self, group: usize) -> String {
        let links = link_names(
            self.planar_mechanism(),
            &self.found.decomposition.groups[group].bodies,
        );
        links.join("-").replace(' ', "-")
    }

    /// Returns a position of the first drive in the unit of texts.
    fn shown_position(&self, drive: f64) -> f64 {
        if self.found.drive_slides() {
            drive / self.planar_mechanism().metres
        } else {
            drive.to_degrees()
        }
    }

    /// Returns the unit of positions in texts: degrees, or the file's length unit.
    fn unit(&self) -> &'static str {
        if self.found.drive_slides() {
            self.planar_mechanism().unit
        } else {
            "deg"
        }
    }

    /// Returns a position of the first drive with its unit.
    fn format_place(&self, drive: f64) -> String {
        format!(
            "{} {}",
            five_digits(self.shown_position(drive)),
            self.unit()
        )
    }

    /// Returns all of it as data.
    pub fn json(&self) -> Value {
        let (m, s) = (self.planar_mechanism(), self.found);
        let d = &s.decomposition;
        json!({
            "mechanism": self.of.name,
            "drives": joint_names(m, &d.drives),
            "driven": link_names(m, &d.driven),
            "class": d.highest_class(),
            "groups": groups_json(m, d, &s.conditions),
            "positions": s.moments.iter().map(|x| self.position_json(x)).collect::<Value>(),
            "stopped": s.dead.as_ref().map(|x| self.stopped_json(x)),
            "claims": claims_about(&self.of.claims, Topic::Statics),
        })
    }

    fn stopped_json(&self, dead: &DeadPoint) -> Value {
        let bodies = self.planar_mechanism().bodies.iter().zip(&dead.pose);
        let placed = bodies.map(|(b, p)| json!({ "link": b.name, "placement": p }));
        json!({
            "drive": dead.drive,
            "group": dead.group,
            "condition": dead.condition,
            // x `[m]`, y `[m]` and turn `[rad]` of each link.
            "pose": placed.collect::<Value>(),
        })
    }

    fn position_json(&self, x: &Moment) -> Value {
        let m = self.planar_mechanism();
        let reaction = |r: &Reaction| {
            let [from, on] = m.pairs[r.pair].bodies.map(|b| &m.bodies[b].name);
            let joint = json!({ "joint": m.pairs[r.pair].name, "from": from, "on": on });
            join_objects([joint, json!(r)])
        };
        let link = |i: &LinkInertia| {
            let name = json!({ "link": m.bodies[i.body].name });
            join_objects([name, json!(i), json!({ "offset": i.inertia_offset() })])
        };
        let groups = x.groups.iter().zip(&self.found.contour_groups);
        let groups = groups.map(|(g, (_, letters))| self.contour_group(x, g, letters));
        let reactions: Value = x.reactions.iter().map(reaction).collect();
        join_objects([
            // Of the first drive since the pose of the file, `[rad]` or `[m]`.
            json!({ "drive": x.drive, "reactions": reactions }),
            json!(x.worth),
            json!({
                // Drives last.
                "by_groups": x.by_groups,
                "drive_power": x.drive_power,
                "load_power": x.load_power,
                "contour_groups": groups.collect::<Value>(),
                "links": x.links.iter().map(link).collect::<Value>(),
            }),
        ])
    }

    /// Returns a four-link group with a closed contour by every method asked for.
    fn contour_group(&self, x: &Moment, g: &GroupSolutions, letters: &ContourGroup) -> Value {
        let guide = self.found.linkage.pair_position(&x.pose, letters.guide);
        let by = |k: &GroupMethod| {
            let r = g.reactions_by(*k)?;
            // Where the guide's reaction acts along it, from the joint's point `[m]`.
            let offset = json!({ "guide_offset": r.guide_offset(&g.pose, guide) });
            Some((k.name(), join_objects([json!(r), offset])))
        };
        join_objects([
            json!({ "group": g.group }),
            json!(g.steps),
            json!({
                "condition": g.equilibrium.map(|e| e.1.condition),
                "residual": g.equilibrium.map(|e| e.1.residual),
                "methods": self.methods.iter().filter_map(by).collect::<Value>(),
            }),
        ])
    }
}

/// Returns the six reactions of a group by name: their magnitudes, and the guide's with its sign.
fn magnitudes(r: &GroupReactions, pose: &GroupPose) -> [(&'static str, f64); 6] {
    let mut out = ["D", "F", "K", "M", "L", "guide"].map(|name| (name, r.guide));
    for (one, force) in out[..5].iter_mut().zip(r.force_vectors(pose)) {
        one.1 = vector_size(force);
    }
    out
}

fn vector_size(v: [f64; 2]) -> f64 {
    v[0].hypot(v[1])
}

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
