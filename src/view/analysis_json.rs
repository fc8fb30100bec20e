//! An analysis as JSON; the keys are a stable contract.

use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::method::{Answer, MobilityMethod};
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::stress::Verdict;
use crate::view::suggestions::{self, Advice};
use crate::view::words::{self, Shape};
use serde_json::{Value, json};

/// The whole analysis, with what single changes would do in each state.
#[must_use]
pub fn analysis(mechanism: &Mechanism, states: &[StateAnalysis], advice: &[Advice]) -> Value {
    let advised = |(i, s): (usize, &StateAnalysis)| {
        let mut out = state(mechanism, s);
        if let Some(advice) = advice.get(i) {
            out["suggestions"] = suggestions::data(mechanism, s, advice);
        }
        out
    };
    json!({
        "mechanism": mechanism.name,
        "length_unit": mechanism.length_unit.symbol,
        "states": states.iter().enumerate().map(advised).collect::<Vec<_>>(),
    })
}

fn state(mechanism: &Mechanism, s: &StateAnalysis) -> Value {
    let joint = |j: JointId| mechanism.joints[j].id.as_str();
    let per_contour = s.per_contour.iter().map(|c| {
        json!({
            "contour": c.contour.name(mechanism),
            "joints": c.contour.joints.iter().map(|(j, _)| joint(*j)).collect::<Vec<_>>(),
            "redundant": c.redundant,
            "least": c.range.0,
            "greatest": c.range.1,
        })
    });
    let external = s.external.as_ref().map(|e| {
        json!({
            "constraints": e.constraints,
            "actual_mobility": e.actual_mobility,
            "working_mobility": e.working_mobility,
            "lost_mobility": e.lost_mobility,
            "redundant": e.redundant,
            "redundant_by_rank": e.by_rank,
            "agree": e.redundant == e.by_rank,
        })
    });
    let idle = s.idle.iter().map(|i| {
        json!({
            "links": i.links.iter().map(|&l| mechanism.links[l].id.as_str()).collect::<Vec<_>>(),
            "through": i.through.iter().map(|&j| joint(j)).collect::<Vec<_>>(),
            "text": words::idle(mechanism, i),
        })
    });
    let stresses = s.self_stresses.iter().map(|t| {
        let mut value = json!({
            "contours": t.contours.iter().map(|&c| s.per_contour[c].contour.name(mechanism)).collect::<Vec<_>>(),
            "external": t.external,
            "verdict": if t.verdict == Verdict::Harmless { "harmless" } else { "harmful" },
            "joints": t.joints.iter().map(|w| json!({
                "joint": joint(w.joint),
                "moments": axes(w.moments),
                "forces": axes(w.forces),
            })).collect::<Vec<_>>(),
        });
        if !s.per_coupling.is_empty() {
            let names = t.couplings.iter().map(|&q| s.per_coupling[q].name.as_str());
            value["couplings"] = names.collect::<Vec<_>>().into();
        }
        value
    });
    let mut value = json!({
        "state": s.state,
        "links": s.links,
        "joints": s.joints,
        "contours": s.contours,
        "freedoms": s.freedoms,
        "rank": s.rank,
        "mobility": s.mobility,
        "finite_mobility": s.finite.mobility,
        "finite_mobility_known_by": s.finite.word(),
        "finite_mobility_proven": s.finite.is_proven(),
        "working_mobility": s.working_mobility,
        "local_mobility": s.local_mobility,
        "redundant": s.redundant,
        "formula_mobility": s.formula_mobility,
        "per_contour": per_contour.collect::<Vec<_>>(),
        "external": external,
        "idle": idle.collect::<Vec<_>>(),
        "self_stresses": stresses.collect::<Vec<_>>(),
        "left_out": s.left_out.iter().map(|&(j, n)| json!({"joint": joint(j), "freedoms": n})).collect::<Vec<_>>(),
        "method": s.certainty.method(),
        "certainty": s.certainty.describe(),
        "certainty_kind": s.certainty.word(),
        "choice": s.choice,
        "snapped": s.snapped,
        "as_written": s.as_written.map(|rank| json!({
            "rank": rank, "mobility": s.freedoms - rank, "redundant": s.rows - rank,
        })),
    });
    // Where there are couplings only: other mechanisms keep their keys.
    if !s.per_coupling.is_empty() {
        let each = s.per_coupling.iter().map(|c| {
            json!({
                "coupling": c.name,
                "redundant": c.redundant,
                "least": 0,
                "greatest": c.most,
            })
        });
        value["per_coupling"] = each.collect::<Vec<_>>().into();
    }
    // Undecided: the figure above is the least it can be.
    if s.finite.at_most() > s.finite.mobility {
        value["finite_mobility_at_most"] = s.finite.at_most().into();
    }
    value
}

/// A mobility by one method, where that is all there is.
#[must_use]
pub fn by_method(
    mechanism: &Mechanism,
    method: &dyn MobilityMethod,
    answers: &[(StateId, Answer)],
) -> Value {
    let states = answers.iter().map(|(s, answer)| {
        let shape = Shape::of(mechanism, *s);
        json!({
            "state": mechanism.states[*s],
            "links": shape.links,
            "joints": shape.joints,
            "contours": shape.contours,
            "freedoms": shape.freedoms,
            "mobility": answer.mobility,
            "redundant": answer.mobility + shape.rows - shape.freedoms,
            "method": method.name(),
            "certainty": method.guarantee(),
        })
    });
    json!({
        "mechanism": mechanism.name,
        "length_unit": mechanism.length_unit.symbol,
        "states": states.collect::<Vec<_>>(),
    })
}

fn axes(flags: [bool; 3]) -> Vec<&'static str> {
    ["x", "y", "z"]
        .into_iter()
        .zip(flags)
        .filter(|(_, f)| *f)
        .map(|(a, _)| a)
        .collect()
}
