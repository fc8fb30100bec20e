//! Where no choice of the options can do: joint types with which one could.

use crate::geom::vector::{Vector, across, cross, dot, length, real, scale, sub, unit};
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Joint, JointId, Mechanism};
use crate::redundancy::duplicate_constraints::held_twice;
use crate::redundancy::release::Release;
use crate::score::outcome::Outcome;
use crate::score::request::unlisted::{fits, is_changeable, types};
use crate::score::request::{Check, JointOptions, List, Request};
use crate::score::run::run;
use crate::search::check::variant_mechanism::realize;
use itertools::Itertools;

/// Nodes that the look at whether they help may take.
const NODES: usize = 100_000;
/// A direction further than this from a span is outside.
const OUTSIDE: f64 = 1e-6;

impl Outcome {
    /// Returns the request with more joint types at some joints, where nothing was found and a search with these finds something:
    /// the cheapest freedoms that remove what is redundant and let nothing move, each in the cheapest type that has it. Where these
    /// find nothing, the cheapest type that does when it is offered at all joints, at the joints where the best variant has it.
    #[must_use]
    pub fn would_help(&self) -> Option<Request> {
        let freed = self.cheapest_freedoms().map(|allow| self.widened(allow));
        freed
            .filter(|wider| self.best_of(wider).is_some())
            .or_else(|| self.one_more_type())
    }

    /// Returns the joint types that free the cheapest duplicate constraints.
    fn cheapest_freedoms(&self) -> Option<Vec<JointOptions>> {
        let m = &self.search.mechanism;
        // What no type has could not be named.
        let free = |r: &Release| match *r {
            Release::Freedom {
                joint,
                slides,
                direction,
            } => {
                !m.joints[joint].drive
                    && one(m, joint, &[FreedMotion { slides, direction }]).is_some()
            }
            Release::Coupling(_) => false,
        };
        let held = held_twice(m, &|_| false, &free, None).ok()?;
        if held.cheapest.is_empty() || held.cheapest.len() < held.range().1 {
            return None;
        }
        let releases = held.cheapest.iter().map(|&i| held.releases[i].1);
        let of = releases.filter_map(|r| match r {
            Release::Freedom {
                joint,
                slides,
                direction,
            } => Some((joint, FreedMotion { slides, direction })),
            Release::Coupling(_) => None,
        });
        of.into_group_map()
            .into_iter()
            .sorted_by_key(|(joint, _)| *joint)
            .map(|(joint, freed)| one(m, joint, &freed))
            .collect()
    }

    /// Returns the request with one more type at the joints where the best variant has it, the cheapest type with which there is one.
    fn one_more_type(&self) -> Option<Request> {
        let m = &self.search.mechanism;
        by_cost().find_map(|t| {
            let changeable = m.joints_with_ids().filter(|(_, j)| is_changeable(j));
            let new = changeable.filter(|(id, j)| {
                let offered = j.joint_type == *t || j.options.iter().any(|o| o.joint_type == *t);
                !offered && fits(m, *id, t)
            });
            let at = |id: JointId| JointOptions {
                joint: m.joints[id].id.clone(),
                names: vec![t.name().to_owned()],
            };
            let joints: Vec<JointId> = new.map(|(id, _)| id).collect();
            if joints.is_empty() {
                return None;
            }
            let everywhere = self.widened(joints.iter().map(|&id| at(id)).collect());
            let best = self.best_of(&everywhere)?;
            let used = joints
                .into_iter()
                .filter(|&id| best.joints[id].joint_type == *t);
            Some(self.widened(used.map(at).collect()))
        })
    }

    /// Returns the request with more joint types at some joints.
    fn widened(&self, allow: Vec<JointOptions>) -> Request {
        let mut wider = self.request.clone();
        if !wider.options.is_empty() {
            let names = allow.iter().flat_map(|a| &a.names).cloned();
            wider.options.extend(names.collect_vec());
        }
        wider.allow.extend(allow);
        wider
    }

    /// Returns the cheapest variant of a wider request, where there is one.
    fn best_of(&self, wider: &Request) -> Option<Mechanism> {
        // What is prepared already is not prepared again.
        let trial = Request {
            hold: Vec::new(),
            unloading: Vec::new(),
            costs: None,
            as_written: true,
            rank: Vec::new(),
            list: List::Top(1),
            check: Check::None,
            poses: 0,
            generic_only: false,
            nodes: NODES.min(wider.nodes),
            ..wider.clone()
        };
        let mut unranked = Mechanism::clone(&self.search.mechanism);
        unranked.ranking = None;
        let found = run(unranked, &trial, &|| false, &mut |_| {}).ok()?;
        let best = found.variants().next()?;
        Some(realize(&found.search, &best.assignment().choices))
    }
}

/// A motion that a joint is to be given.
#[derive(Clone, Copy)]
struct FreedMotion {
    slides: bool,
    direction: Vector,
}

/// The cheapest type that has what a joint is to be given.
fn one(m: &Mechanism, joint: JointId, freed: &[FreedMotion]) -> Option<JointOptions> {
    let here = &m.joints[joint];
    let mut fits =
        by_cost().filter(|t| freed.iter().all(|&f| has(here, t, f)) && fits(m, joint, t));
    Some(JointOptions {
        joint: here.id.clone(),
        names: vec![fits.next()?.name().to_owned()],
    })
}

/// Returns the types that need no more than a joint's own frame, the cheapest first. Contacts at a point or a line come last: they
/// have to be pressed together.
fn by_cost() -> impl Iterator<Item = &'static JointType> {
    let pressed =
        |t: &JointType| matches!(t, JointType::SphereOnPlane | JointType::CylinderOnPlane);
    types().sorted_by_key(move |t| (pressed(t), t.default_cost_milli()))
}

/// Whether a type in a joint's frame turns about, or slides along, a direction.
fn has(joint: &Joint, of: &JointType, freed: FreedMotion) -> bool {
    let z = unit(real(&joint.frame.axis));
    let x = unit(across(real(&joint.frame.reference), z));
    let y = cross(z, x);
    let axes = of
        .freedoms()
        .iter()
        .filter_map(|f| match (f, freed.slides) {
            (Freedom::Rx, false) | (Freedom::Tx, true) => Some(x),
            (Freedom::Ry, false) | (Freedom::Ty, true) => Some(y),
            (Freedom::Rz, false) | (Freedom::Tz, true) => Some(z),
            _ => None,
        });
    let rest = axes.fold(freed.direction, |rest, a| sub(rest, scale(a, dot(rest, a))));
    length(rest) < OUTSIDE
}
