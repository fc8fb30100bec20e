//! A gripper as JSON, in SI units; the keys are a stable contract.

use crate::grip::arm_charts::findings;
use crate::grip::clamping::{Row, Verdict};
use crate::statics::transmission::Rates;
use crate::view::grip_text::{Report, reason};
use serde_json::{Value, json};

/// The whole report.
#[must_use]
pub fn grip(r: &Report<'_>) -> Value {
    let spec = &r.file.spec;
    json!({
        "mechanism": r.file.name,
        "units": "SI; angles in radians",
        "lever": {
            "length": spec.lever_length,
            "prism_angle": spec.prism_angle,
            "mounting_angle": spec.mounting_angle,
        },
        "holds": r.study.holds(),
        "hardest": r.study.hardest().map(|row| row_json(r, row)),
        "diameters": r.study.rows.iter().map(|row| row_json(r, row)).collect::<Vec<_>>(),
        "transmission": r.study.hardest().or(r.study.rows.first()).and_then(|row| r.rates(row)).map(rates),
        "findings": findings().iter().map(|f| json!({
            "claim": f.claim,
            "holds": f.holds,
            "evidence": f.evidence,
        })).collect::<Vec<_>>(),
    })
}

fn rates(t: &Rates) -> Value {
    json!({ "drive": if t.slides { "slides" } else { "turns" }, "rates": t.rates })
}

fn row_json(r: &Report<'_>, row: &Row) -> Value {
    let friction = r.file.spec.load.as_ref().map_or(0.0, |l| l.friction);
    let hardest = row.hardest.as_ref().map(|h| {
        let held = match &h.verdict {
            Verdict::Held(held) => Some(held),
            Verdict::Slips(_) | Verdict::Undecided(_) => None,
        };
        let forces = held.zip(row.pose.as_ref()).map(|(held, pose)| {
            let each = pose.contacts.iter().zip(&held.forces);
            each.map(|(c, f)| {
                json!({
                    "contact": c.name,
                    "point": c.point,
                    "normal_direction": c.normal,
                    "normal": f.normal,
                    "along_face": f.along,
                    "along_part": f.axial,
                })
            })
            .collect::<Vec<_>>()
        });
        json!({
            "case": h.case,
            "force": h.load.force,
            "moment": h.load.moment,
            "held": held.is_some(),
            "drive_moment_per_lever": held.map(|h| h.drive),
            "lower_bound": held.map(|h| h.lower_bound),
            "lever_moments": held.map(|h| h.moments),
            "drive_effort": held.and_then(|h| r.effort(row, h)),
            "contacts": forces,
            "reason": reason(h, friction),
        })
    });
    json!({
        "diameter": row.diameter,
        "pivot_distance": row.gripper.pivot.abs(),
        "levers_cross": row.gripper.pivot < 0.0,
        "l11": row.arms.l11, "l12": row.arms.l12, "l1": row.arms.l1,
        "l21": row.arms.l21, "l22": row.arms.l22, "l2": row.arms.l2,
        "turn": row.pose.as_ref().map(|p| p.turn),
        "centre": row.pose.as_ref().map(|p| p.centre),
        "obstacles": row.obstacles.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "mass": row.mass,
        "transmission": r.rates(row).map(rates),
        "holds": row.holds(),
        "load": hardest,
    })
}
