//! Joint reactions as JSON and CSV.

use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::reactions::{Choice, JointReaction, Solution};
use serde_json::{Value, json};

fn reactions(m: &Mechanism, list: &[JointReaction]) -> Vec<Value> {
    let one = |r: &JointReaction| {
        let joint = &m.joints[r.joint];
        json!({
            "joint": joint.id,
            "type": joint.joint_type.name(),
            "links": joint.links.map(|l| m.links[l].id.as_str()),
            "point": r.point,
            "axes": {"x": r.axes[0], "y": r.axes[1], "z": r.axes[2]},
            "force": r.force,
            "moment": r.moment,
            "force_magnitude": r.force_size(),
            "moment_magnitude": r.moment_size(),
            "global_force": r.global_force(),
            "global_moment": r.global_moment(),
            "drive": r.effort.map(|(f, x)| json!({"freedom": f.name(), "effort": x})),
        })
    };
    list.iter().map(one).collect()
}

/// Forces in N, moments in N·m about the joints' points `[m]`, each first link on second, in the joint's own frame.
#[must_use]
pub fn json(m: &Mechanism, state: StateId, s: &Solution) -> Value {
    json!({
        "mechanism": m.name,
        "state": m.states[state],
        "unique": s.choice == Choice::Unique,
        "choice": match s.choice {
            Choice::Unique => "unique",
            Choice::MinimumNorm => "minimum-norm",
        },
        "size": s.size,
        "condition": s.condition,
        "nearly_singular": s.nearly_singular(),
        "residual": s.residual,
        "undriven": s.undriven,
        "reactions": reactions(m, &s.reactions),
        "self_stresses": s.self_stresses.iter().map(|x| reactions(m, x)).collect::<Vec<_>>(),
        "elastic": s.elastic.as_ref().map(|x| reactions(m, x)),
    })
}

/// One joint a line.
#[must_use]
pub fn csv(m: &Mechanism, s: &Solution) -> String {
    let head = String::from("kind,joint,type,Fx,Fy,Fz,F,Mx,My,Mz,M,effort\n");
    csv_rows(m, s)
        .into_iter()
        .fold(head, |out, row| out + &row + "\n")
}

/// The lines without their head.
pub(super) fn csv_rows(m: &Mechanism, s: &Solution) -> Vec<String> {
    let quoted = |text: &str| {
        if text.contains([',', '"', '\n', '\r']) {
            format!("\"{}\"", text.replace('"', "\"\""))
        } else {
            text.to_owned()
        }
    };
    let mut out = Vec::new();
    let kind = match s.choice {
        Choice::Unique => "unique",
        Choice::MinimumNorm => "minimum-norm",
    };
    let lists = [(kind, Some(&s.reactions)), ("elastic", s.elastic.as_ref())];
    for (kind, list) in lists {
        for r in list.into_iter().flatten() {
            let joint = &m.joints[r.joint];
            let mut row = vec![
                kind.to_owned(),
                quoted(&joint.id),
                joint.joint_type.name().to_owned(),
            ];
            row.extend(r.force.map(|x| x.to_string()));
            row.push(r.force_size().to_string());
            row.extend(r.moment.map(|x| x.to_string()));
            row.push(r.moment_size().to_string());
            row.push(r.effort.map_or(String::new(), |(_, x)| x.to_string()));
            out.push(row.join(","));
        }
    }
    out
}
