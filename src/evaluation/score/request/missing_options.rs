//! Joint types that would help if a search finds nothing.

use crate::geom::vector::{Vector, across, cross, dot, length, scale, sub, to_vector, unit};
use crate::model::joint_type::{Freedom, JointType};
use crate::model::mechanism::{Joint, JointId, Mechanism};
use crate::redundancy::duplicate_constraints::held_twice;
use crate::redundancy::release::Release;
use crate::score::outcome::Outcome;
use crate::score::request::unlisted::{framed_types, type_fits};
use crate::score::request::{Check, JointOptions, List, Request};
use crate::score::run::run;
use itertools::Itertools;

/// Node budget of the search that tests whether they help.
const NODES: usize = 100_000;
/// A direction further than this from a span is outside.
const OUTSIDE: f64 = 1e-6;

impl Outcome {
    /// Returns the request with more joint types at some joints, if nothing was found and a search with these types finds a variant. The
    /// types are the cheapest ones with the cheapest freedoms that remove redundant constraints and add no motion.
    pub fn would_help(&self) -> Option<Request> {
        let wider = self.widen_request(self.cheapest_freedoms()?);
        self.finds_variant(&wider).then_some(wider)
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
                    && cheapest_type(m, joint, &[FreedMotion { slides, direction }]).is_some()
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
            .map(|(joint, freed)| cheapest_type(m, joint, &freed))
            .collect()
    }

    /// Returns the request with more joint types: at all joints if it names types for all, else at the given joints.
    fn widen_request(&self, allow: Vec<JointOptions>) -> Request {
        let mut wider = self.request.clone();
        if wider.options.is_empty() {
            wider.allow.extend(allow);
        } else {
            let more = allow.into_iter().flat_map(|a| a.names);
            wider.options = wider.options.into_iter().chain(more).unique().collect();
        }
        wider
    }

    /// Returns whether a wider request finds a variant.
    fn finds_variant(&self, wider: &Request) -> bool {
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
            nodes: NODES.min(wider.nodes),
            ..wider.clone()
        };
        let mut unranked = Mechanism::clone(&self.search.mechanism);
        unranked.edit().ranking = None;
        run(unranked, &trial, &|| false, &mut |_| {})
            .is_ok_and(|found| found.variants().next().is_some())
    }
}

/// A motion that a joint is to be given.
#[derive(Clone, Copy)]
struct FreedMotion {
    slides: bool,
    direction: Vector,
}

/// Returns the cheapest type that has the motions that a joint needs.
fn cheapest_type(m: &Mechanism, joint: JointId, freed: &[FreedMotion]) -> Option<JointOptions> {
    let here = &m.joints[joint];
    // A contact at a point or a line has to be pressed together.
    let pressed =
        |t: &JointType| matches!(t, JointType::SphereOnPlane | JointType::CylinderOnPlane);
    let cheap = framed_types().sorted_by_key(|t| (pressed(t), t.default_cost_milli()));
    let mut fits =
        cheap.filter(|t| freed.iter().all(|&f| has_motion(here, t, f)) && type_fits(m, joint, t));
    Some(JointOptions {
        joint: here.id.clone(),
        names: vec![fits.next()?.name().to_owned()],
    })
}

/// Returns whether a type in a joint's frame turns about, or slides along, a direction.
fn has_motion(joint: &Joint, of: &JointType, freed: FreedMotion) -> bool {
    let z = unit(to_vector(&joint.frame.axis));
    let x = unit(across(to_vector(&joint.frame.reference), z));
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
