//! Statics of a planar mechanism as JSON, text, CSV and charts. SI units; the keys of JSON are a stable contract, and numbers
//! that do not exist are null.

pub mod charts;
pub mod csv;
pub mod force_plans;
pub mod text;
pub mod told;

use crate::model::claim::Topic;
use crate::statics::assur::{Decomposition, Group};
use crate::statics::contour_group::ContourGroup;
use crate::statics::contour_group::pose::{GroupPose, GroupReactions};
use crate::statics::contour_group::solutions::{GroupMethod, GroupSolutions};
use crate::statics::cycle::{DeadPoint, DrivenStructure, Moment, Statics};
use crate::statics::kinetostatics::{LinkInertia, Reaction};
use crate::statics::planar::{BodyId, PairId, PlanarMechanism};
use crate::view::claims::claims_about;
use crate::view::prelude::*;

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
