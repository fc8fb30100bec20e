//! A torsional drive as JSON, in SI units; the keys are a stable contract.

use crate::drive::driving::{CamDesign, DampingFrom, Design, Driving};
use crate::drive::programme::{Endurance, Event, Ran};
use crate::drive::swing::End;
use crate::drive::torsion::{CamSpring, Sizing, decrement};
use crate::file::read::workload::Workload;
use crate::model::drive::DriveSpec;
use serde_json::{Value, json};

/// The whole report.
#[must_use]
pub fn drive(file: &Workload<DriveSpec>, found: &Driving) -> Value {
    let spec = &file.spec;
    json!({
        "mechanism": file.name,
        "units": "SI; angles in radians",
        "half_swing": spec.twist,
        "period": spec.period,
        "inertias": spec.inertias,
        "complete": found.design.as_ref().is_some_and(|d| d.run.complete()),
        "sizing": sizing(&found.sizing),
        "design": found.design.as_ref().map(|d| design(spec, d)),
    })
}

fn sizing(s: &Sizing) -> Value {
    json!({
        "trials": s.trials.iter().map(|t| json!({
            "length": t.bar.length,
            "diameter": t.bar.diameter,
            "allowable_twist": t.allowable_twist,
            "strong": t.strong,
            "fits": t.fits,
        })).collect::<Vec<_>>(),
        "remedies": s.remedy.map(|r| json!({
            "length_above": r.length,
            "allowable_stress_above": r.allowable_stress,
            "period_above": r.period,
            "half_swing_below": r.twist,
            "inertia_below": r.inertia,
        })),
    })
}

fn spring(s: &CamSpring) -> Value {
    json!({ "rate": s.rate, "stroke": s.stroke, "mounting_coefficient": s.mounting, "energy": s.energy() })
}

fn design(spec: &DriveSpec, d: &Design) -> Value {
    json!({
        "length": d.bar.length,
        "diameter": d.bar.diameter,
        "stiffness": d.stiffness,
        "stress": d.bar.stress(spec.twist),
        "damping": {
            "viscous": d.damping.viscous,
            "coulomb": d.damping.coulomb,
            "from": match d.damping_from {
                DampingFrom::Stated => "file",
                DampingFrom::MissingAngle => "missing_angle",
                DampingFrom::None => "none",
            },
        },
        "missing_angle": d.missing,
        "decrement": decrement(spec.twist, spec.twist - d.missing),
        "friction_energy": d.friction_energy,
        "needed_feed": d.needed_feed,
        "feed": d.feed,
        "cam": d.cam.as_ref().map(|CamDesign { spring: s, needed }| json!({
            "spring": spring(s),
            "needed": needed.as_ref().map(spring),
        })),
        "motions": d.motions.map(|m| json!({
            "angular_acceleration": m.angular_acceleration,
            "angular_speed": m.angular_speed,
            "acceleration": m.acceleration,
        })),
        "endurance": match d.endurance {
            Endurance::Lasts { missing } => json!({ "lasts": true, "missing": missing }),
            Endurance::Drifts { missing } => json!({ "lasts": Value::Null, "missing": missing }),
            Endurance::Fails { after } => json!({ "lasts": false, "after": after }),
        },
        "latched": d.run.latched,
        "wanted": d.run.wanted,
        "programme": d.run.steps.iter().map(step).collect::<Vec<_>>(),
    })
}

fn step(s: &Ran) -> Value {
    let Event::Swing { disc, swing } = &s.event else {
        return json!({ "start": s.start, "duration": s.duration, "angles": s.angles, "swing": Value::Null });
    };
    let (end, missing) = match swing.end {
        End::Latched { .. } => ("latched", 0.0),
        End::Caught { missing } => ("caught", missing),
        End::Missed { missing } => ("missed", missing),
        End::Stuck => ("stuck", 0.0),
    };
    let b = &swing.balance;
    json!({
        "start": s.start,
        "duration": s.duration,
        "angles": s.angles,
        "swing": {
            "disc": disc + 1,
            "end": end,
            "missing": missing,
            "energy": {
                "initial": b.initial,
                "fed": b.fed,
                "coulomb": b.coulomb,
                "viscous": b.viscous,
                "impact": b.impact,
                "stored": b.stored,
                "residual": b.residual(),
            },
        },
    })
}
