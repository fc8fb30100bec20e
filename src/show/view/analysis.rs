//! An analysis as JSON, as text and on the page; the keys of JSON are a stable contract.

use crate::geom::expr::PI_DIGITS;
use crate::rank::reduce::axis_names::Direction;
use crate::rank::reduce::sufficient_rows::{LeastRows, Motions};
use crate::redundancy::analysis::{ContourShare, CouplingShare, External, StateAnalysis};
use crate::redundancy::link_motion::LinkMotion;
use crate::redundancy::local_mobility::Idle;
use crate::redundancy::stress::{JointWrench, SelfStress, StressVerdict};
use crate::view::analysis::suggestions::Advice;
use crate::view::prelude::*;
use crate::view::stroke::StrokeData;

pub mod link_motions;
pub mod mechanism;
pub mod mobility;
pub mod suggestions;
pub(crate) mod text;

/// The analysis of a mechanism.
#[derive(Debug)]
pub struct Analysis<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its states.
    pub states: Vec<State<'a>>,
    /// The figures over a stroke, where one was asked for.
    pub stroke: Option<StrokeData<'a>>,
}

/// One state.
#[derive(Debug)]
pub struct State<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its analysis.
    pub found: &'a StateAnalysis,
    /// The motions of other links than the outputs that were asked about.
    pub asked: Vec<LinkMotion>,
    /// Effects of single changes, if they were asked for.
    pub advice: Option<&'a Advice>,
}

impl<'a> Analysis<'a> {
    /// Creates the analysis from what `found` reports of a mechanism. `advice` has an entry for each of its states, or none.
    pub fn new(
        mechanism: &'a Mechanism,
        found: &'a [StateAnalysis],
        advice: &'a [Advice],
    ) -> Analysis<'a> {
        let states = found.iter().enumerate().map(|(i, found)| State {
            mechanism,
            found,
            asked: Vec::new(),
            advice: advice.get(i),
        });
        Analysis {
            mechanism,
            states: states.collect(),
            stroke: None,
        }
    }

    /// Returns all of it as data.
    ///
    /// # Examples
    /// ```
    /// use ozols::view::analysis::Analysis;
    /// let gripper = ozols::built_in("gripper-10")?;
    /// let found = ozols::analyze(&gripper)?;
    /// let json = Analysis::new(&gripper, &found, &[]).json();
    /// assert_eq!((&json["states"][0]["mobility"], &json["states"][0]["redundant"]), (&1.into(), &11.into()));
    /// # Ok::<(), ozols::Error>(())
    /// ```
    pub fn json(&self) -> Value {
        let m = self.mechanism;
        json!({
            "mechanism": m.name,
            "length_unit": m.length_unit.symbol,
            // The certainty of each state counts them.
            "assumptions": m.assumed,
            "states": self.states.iter().map(State::json).collect::<Value>(),
            "stroke": self.stroke.as_ref().map(StrokeData::json),
            "claims": claims_about(&m.claims, Topic::Structure),
        })
    }
}

impl State<'_> {
    /// Returns the motions of the outputs, then of links that were asked about.
    fn all_motions(&self) -> Vec<LinkMotion> {
        // Coordinates that were analysed have values.
        let mut all = self
            .found
            .output_motions(self.mechanism)
            .unwrap_or_default();
        all.extend(self.asked.iter().cloned());
        all
    }

    /// Returns how sure the figures are; a file with π is not exact.
    pub(crate) fn certainty(&self) -> String {
        let (m, s) = (self.mechanism, self.found);
        let words = s.certainty.describe();
        let sure = match (s.as_written.is_some(), m.has_pi()) {
            (true, _) => format!("as meant: {words}"),
            (false, true) => {
                let digits = format!("pi to {PI_DIGITS} decimals, all else exact");
                words.replacen("exact geometry", &digits, 1)
            }
            (false, false) => words,
        };
        as_read(m, sure)
    }

    /// Returns the finite mobility, or `None` if it is undecided.
    pub(crate) fn finite_mobility(&self) -> Option<usize> {
        let finite = &self.found.finite;
        (!finite.is_undecided()).then_some(finite.mobility)
    }

    fn joint_name(&self, joint: JointId) -> &str {
        &self.mechanism.joints[joint].id
    }

    fn json(&self) -> Value {
        let (m, s) = (self.mechanism, self.found);
        let most = s.at_most();
        let fault = |d| {
            let (kind, joint, text) = link_motions::drive_fault(m, d);
            json!({ "kind": kind, "joint": joint, "text": text })
        };
        let left_out = |&(j, freedoms): &(JointId, usize)| json!({ "joint": self.joint_name(j), "freedoms": freedoms });
        let motions = self.all_motions();
        json!({
            "state": s.state,
            "links": s.links,
            "joints": s.joints,
            "contours": s.contours,
            "freedoms": s.freedoms,
            "rank": s.rank,
            "mobility": s.mobility,
            // The most it can be, where rounded coordinates leave that undecided.
            "mobility_at_most": most.map(|(w, _)| w),
            "finite_mobility": self.finite_mobility(),
            "finite_mobility_at_least": s.finite.mobility,
            "finite_mobility_at_most": s.finite.at_most(),
            "finite_mobility_known_by": s.finite.as_word(),
            "finite_mobility_proven": s.finite.is_proven() && m.assumed.is_empty(),
            "working_mobility": s.working_mobility,
            "local_mobility": s.local_mobility,
            "drives": s.drives.iter().map(fault).collect::<Value>(),
            "redundant": s.redundant,
            "gogu": self.gogu_symbols().map(|[m, n, s, t]| json!({ "M": m, "N": n, "S": s, "T": t })),
            "redundant_at_most": most.map(|(_, sigma)| sigma),
            "formula_mobility": s.formula_mobility,
            "least_rows": least_rows(m, s),
            "per_contour": s.per_contour.iter().map(|c| self.contour_json(c)).collect::<Value>(),
            "external": s.external.as_ref().map(external_json),
            "motions": motions.iter().map(|of| link_motions::motion_json(m, of)).collect::<Value>(),
            "idle": s.idle.iter().map(|i| self.idle_json(i)).collect::<Value>(),
            "self_stresses": s.self_stresses.iter().map(|t| self.self_stress(t)).collect::<Value>(),
            "left_out": s.left_out.iter().map(left_out).collect::<Value>(),
            "method": s.method,
            "certainty": self.certainty(),
            "certainty_kind": certainty_kind(m, s.certainty.as_word()),
            // As text: they are beyond what a double holds.
            "primes": s.certainty.primes().map(|p| p.map(|p| p.to_string())),
            "choice": s.choice,
            "snapped": s.snapped,
            "as_written": s.as_written.map(|rank| json!({
                "rank": rank,
                "mobility": s.freedoms - rank,
                "redundant": s.rows - rank,
            })),
            "per_coupling": s.per_coupling.iter().map(coupling_json).collect::<Value>(),
            "suggestions": self.advice.map(|advice| suggestions::advice_json(m, s, advice)),
        })
    }

    /// Returns the share of a contour as JSON. The ranges are over all orders of these contours, and over all bases that
    /// contain one.
    fn contour_json(&self, c: &ContourShare) -> Value {
        let joints = c.contour.joints.iter().map(|(j, _)| self.joint_name(*j));
        json!({
            "contour": c.contour.name(self.mechanism),
            "joints": joints.collect::<Value>(),
            "redundant": c.redundant,
            "least": c.range.0,
            "greatest": c.range.1,
            "greatest_over_bases": c.over_bases.0,
            // What no basis exceeds, where that is more than is known to be reached.
            "greatest_over_bases_at_most": Some(c.over_bases.1).filter(|&m| m > c.over_bases.0),
        })
    }

    fn idle_json(&self, i: &Idle) -> Value {
        let link = |&l: &LinkId| self.mechanism.links[l].id.as_str();
        json!({
            "links": i.links.iter().map(link).collect::<Value>(),
            // Joints that move, if the links do not move as one body.
            "moving": i.moving.iter().map(|&j| self.joint_name(j)).collect::<Value>(),
            // Joints whose points it leaves at rest.
            "through": i.through.iter().map(|&j| self.joint_name(j)).collect::<Value>(),
            "text": link_motions::describe_idle(self.mechanism, i),
        })
    }

    fn self_stress(&self, t: &SelfStress) -> Value {
        let wrench = |w: &JointWrench| {
            json!({
                "joint": self.joint_name(w.joint),
                "moments": axis_names(w.moments),
                "forces": axis_names(w.forces),
                "text": self.wrench_words(t, w),
                // Its part of Σ |f|² + |m|²/ℓ² over the joints; nothing where that was not computed.
                "share": w.borne.as_ref().map(|b| b.energy_share()),
            })
        };
        json!({
            "contours": self.contours_of(t),
            "external": t.external,
            "verdict": harm_word(t),
            "joints": t.joints.iter().map(wrench).collect::<Value>(),
            // In mechanisms that have any.
            "couplings": (!self.found.per_coupling.is_empty()).then(|| self.couplings_of(t)),
        })
    }

    /// Returns the contours that pass a self-stress round.
    fn contours_of(&self, t: &SelfStress) -> Vec<String> {
        let contours = t
            .contours
            .iter()
            .map(|&c| &self.found.per_contour[c].contour);
        contours.map(|c| c.name(self.mechanism)).collect()
    }

    /// Returns the couplings that pass it on.
    fn couplings_of(&self, t: &SelfStress) -> Vec<&str> {
        let couplings = t.couplings.iter();
        couplings
            .map(|&q| self.found.per_coupling[q].name.as_str())
            .collect()
    }
}

/// Returns "harmless" or "harmful".
fn harm_word(t: &SelfStress) -> &'static str {
    match t.verdict {
        StressVerdict::Harmless => "harmless",
        StressVerdict::Harmful => "harmful",
    }
}

/// Returns the names of global axes.
fn axis_names(flags: [bool; 3]) -> Vec<&'static str> {
    let named = ["x", "y", "z"].into_iter().zip(flags);
    named.filter(|(_, there)| *there).map(|(a, _)| a).collect()
}

/// Returns whether the formula and the ranks say the same of what a state adds.
fn ranks_agree(e: &External) -> bool {
    e.redundant == e.by_rank
}

fn external_json(e: &External) -> Value {
    join_objects([json!(e), json!({ "agree": ranks_agree(e) })])
}

fn coupling_json(c: &CouplingShare) -> Value {
    json!({ "coupling": c.name, "redundant": c.redundant, "least": 0, "greatest": c.most })
}

/// Returns the rows of the closure equations that are enough for their rank, of some contours for some motions. Empty if all rows are
/// needed, or if rounded coordinates do not decide the rank.
fn least_rows(mechanism: &Mechanism, s: &StateAnalysis) -> Value {
    let found = s.least_rows.as_ref().filter(|l| !LeastRows::is_all(l));
    let Some(found) = found.filter(|_| s.at_most().is_none()) else {
        return json!([]);
    };
    let blocks = found.blocks.iter().filter(|b| !b.contours.is_empty());
    let parts = blocks.flat_map(|b| {
        let name = |&c: &usize| s.per_contour.get(c).map(|c| c.contour.name(mechanism));
        let contours = b.contours.iter().filter_map(name).collect_vec();
        b.parts.iter().map(move |part| {
            let normal = |d: &Option<Direction>| d.map(|d| d.describe_direction(mechanism));
            let (motions, of) = match &part.motions {
                Motions::All => ("any", None),
                Motions::Group(name) => ("group", Some(name.clone())),
                Motions::InPlane(d) => ("in plane", normal(d)),
                Motions::OutOfPlane(d) => ("out of plane", normal(d)),
            };
            json!({
                "contours": contours,
                // `any`, `group`, `in plane` or `out of plane`.
                "motions": motions,
                // The group with its dimension, or the plane's normal.
                "of": of,
                "rows": part.rows,
                "rows_in_all": part.of,
                "rank": part.rank,
                "redundant": part.count_redundant(),
            })
        })
    });
    parts.collect()
}
