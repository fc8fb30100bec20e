//! A gripper over its diameters: what was found of it, from which text, JSON and charts are made. SI units, angles in radians; the
//! keys are a stable contract.

use crate::file::read::workload::WorkloadFile;
use crate::grip::arm_curves::{Varied, arm_curve};
use crate::grip::clamping::{DiameterRow, Hardest};
use crate::grip::contact::TouchingPose;
use crate::grip::holding::{Holding, HoldingOutcome, Slip};
use crate::grip::lever_arm::Arms;
use crate::grip::{Grip, drive_effort};
use crate::model::grip::GripSpec;
use crate::statics::transmission::Rates;
use crate::view::grip::motion::GripMotion;
use crate::view::prelude::*;

pub mod clamped;
pub mod motion;
pub mod text;

/// The holding ability of a gripper.
#[derive(Debug)]
pub struct GripReport<'a> {
    /// The file, for its units and inputs.
    pub file: &'a WorkloadFile<GripSpec>,
    /// Its study.
    pub found: &'a Grip,
    /// The clamping along a motion, if one was asked for.
    pub motion: Option<GripMotion>,
}

impl<'a> GripReport<'a> {
    /// Returns the place of the diameter that takes the greatest drive moment.
    fn hardest_place(&self) -> Option<usize> {
        let (rows, hardest) = (&self.found.study.rows, self.found.study.hardest_row()?);
        rows.iter().position(|r| r.diameter == hardest.diameter)
    }

    /// Returns how the drive works on the levers at a diameter.
    fn rates_at(&self, at: usize) -> Option<&'a Rates> {
        self.found.transmission.get(at)
    }

    fn load_friction(&self) -> f64 {
        self.file.spec.load.as_ref().map_or(0.0, |l| l.friction)
    }

    /// Returns what one drive of both levers takes at a diameter, `[N]` or `[N·m]`.
    fn drive_effort(&self, at: usize) -> Option<f64> {
        let held = self.found.study.rows[at].hardest.as_ref()?.held_forces()?;
        drive_effort(
            self.file.spec.load.as_ref()?.levers,
            held,
            self.rates_at(at)?,
        )
    }

    /// Returns whether every diameter is held in every case, and at every step of the motion.
    pub fn holds(&self) -> bool {
        self.found.study.holds_all() && self.motion.as_ref().is_none_or(GripMotion::holds)
    }

    /// Returns all of it as data.
    pub fn json(&self) -> Value {
        let (study, hardest) = (&self.found.study, self.hardest_place());
        json!({
            "mechanism": self.file.name,
            "units": "SI; angles in radians",
            "lever": study.lever,
            "holds": study.holds_all(),
            "hardest": hardest.map(|at| self.diameter_json(at)),
            "diameters": (0..study.rows.len()).map(|at| self.diameter_json(at)).collect::<Value>(),
            // At the hardest diameter, or the first.
            "transmission": self.rates_at(hardest.unwrap_or(0)).map(transmission_json),
            "motion": self.motion.as_ref().map(GripMotion::json),
            "claims": claims_about(&self.file.claims, Topic::Grip),
        })
    }

    fn diameter_json(&self, at: usize) -> Value {
        let row = &self.found.study.rows[at];
        let pose = row.pose.as_ref();
        let first = json!({
            "diameter": row.diameter,
            // Of the pivots from the gripper's axis.
            "pivot_distance": row.gripper.pivot.abs(),
            "levers_cross": row.gripper.pivot < 0.0,
        });
        let rest = json!({
            // How far the upper lever has turned, where it reaches.
            "turn": pose.map(|p| p.turn),
            "centre": pose.map(|p| p.centre),
            "obstacles": row.obstacles.iter().map(ToString::to_string).collect::<Value>(),
            "mass": row.mass,
            "transmission": self.rates_at(at).map(transmission_json),
            "holds": row.is_held(),
            "load": row.hardest.as_ref().map(|h| self.load_json(at, h)),
        });
        join_objects([first, json!(row.arms), rest])
    }

    /// Returns the hardest case of a diameter. It has the load on the part with its safety factor, and the least drive
    /// moment per lever that holds the part.
    fn load_json(&self, at: usize, h: &Hardest) -> Value {
        let held = h.held_forces();
        let pose = self.found.study.rows[at].pose.as_ref();
        json!({
            "case": h.case,
            "force": h.load.force,
            "moment": h.load.moment,
            "held": held.is_some(),
            "drive_moment_per_lever": held.map(|h| h.drive),
            "lower_bound": held.map(|h| h.lower_bound),
            "lever_moments": held.map(|h| h.moments),
            "drive_effort": self.drive_effort(at),
            "contacts": held.zip(pose).map(|(held, pose)| contacts_json(held, pose)),
            "reason": hold_reason(h, self.load_friction()),
        })
    }
}

/// Returns the transmission of a drive to two levers: the turn of each per travel of the drive, `[rad/m]` or `[1]`.
fn transmission_json(r: &Rates) -> Value {
    json!({ "drive": if r.slides { "slides" } else { "turns" }, "rates": r.rates })
}

/// Returns the contacts and their forces on the part.
fn contacts_json(held: &Holding, pose: &TouchingPose) -> Value {
    let each = pose.contacts.iter().zip(&held.forces);
    let one = each.map(|(c, force)| {
        // The normal is that of the face, towards the part.
        let place = json!({ "contact": c.name, "point": c.point, "normal_direction": c.normal });
        join_objects([place, json!(force)])
    });
    one.collect()
}

/// Returns every reason why a diameter is not held.
fn all_reasons(row: &DiameterRow, friction: f64) -> impl Iterator<Item = String> {
    let forces = row.hardest.as_ref().and_then(|h| hold_reason(h, friction));
    row.obstacles.iter().map(ToString::to_string).chain(forces)
}

/// Describes the motion in which a part slips.
fn describe_slip(s: &Slip) -> String {
    let names = [
        "slides outwards (x)",
        "slides across the jaws (y)",
        "slides along its axis (z)",
        "turns about x",
        "turns about y",
        "turns about its axis (z)",
    ];
    let inwards = "slides inwards (-x)";
    let parts: Vec<f64> = s.velocity.into_iter().chain(s.rotation).collect();
    let most = parts.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let told = parts
        .iter()
        .zip(names)
        .enumerate()
        .filter(|(_, (x, _))| x.abs() > 0.2 * most);
    let told = told.map(|(i, (x, n))| if i == 0 && *x < 0.0 { inwards } else { n });
    told.collect::<Vec<_>>().join(" and ")
}

/// Returns the reason why the hardest case is not held.
fn hold_reason(h: &Hardest, friction: f64) -> Option<String> {
    match &h.verdict {
        Ok(HoldingOutcome::Held(_)) => None,
        Err(e) => Some(format!("{}: {e}", h.case)),
        Ok(HoldingOutcome::Slips(s)) => {
            let remedy = if friction == 0.0 {
                "faces without friction cannot stop that; give friction"
            } else {
                "no closing force stops that; use more friction, deeper prisms, or pivots set for this diameter"
            };
            Some(format!(
                "{}: the part {}; {remedy}",
                h.case,
                describe_slip(s)
            ))
        }
    }
}

/// Returns every chart with the name of its file.
pub fn grip_charts(g: &GripReport<'_>) -> Vec<(String, Chart)> {
    let (metres, symbol) = (g.file.length_unit.metres, g.file.length_unit.symbol);
    let series = |name: &str, style, y: &dyn Fn(&DiameterRow) -> Option<f64>| Series {
        name: name.to_owned(),
        points: g
            .found
            .study
            .rows
            .iter()
            .filter_map(|d| Some((d.diameter / metres, y(d)?)))
            .collect(),
        style,
    };
    let held = |d: &DiameterRow, arm: f64| d.obstacles.is_empty().then_some(arm / metres);
    let mut out = vec![(
        "arms".to_owned(),
        Chart {
            title: format!("{}: arms of the clamping forces", g.file.name),
            subtitle: "Points: what the jaws can hold.".to_owned(),
            x: Axis::linear(format!("D, {symbol}")),
            y: Axis::linear(format!("arm, {symbol}")),
            series: vec![
                series("l1", Style::Line, &|d| Some(d.arms.l1 / metres)),
                series("l2", Style::Line, &|d| Some(d.arms.l2 / metres)),
                series("held, l1", Style::Points, &|d| held(d, d.arms.l1)),
                series("held, l2", Style::Points, &|d| held(d, d.arms.l2)),
            ],
        },
    )];
    out.extend(Varied::ALL.map(|v| arms_over(g, v)));
    if g.file.spec.load.is_some() {
        out.push((
            "drive-moment".to_owned(),
            Chart {
                title: format!("{}: least drive moment per lever", g.file.name),
                subtitle: "In the hardest case of each diameter.".to_owned(),
                x: Axis::linear(format!("D, {symbol}")),
                y: Axis::linear("moment, N·m"),
                series: vec![series(
                    "drive moment",
                    Style::Line,
                    &DiameterRow::drive_moment,
                )],
            },
        ));
    }
    out.extend(
        g.motion
            .as_ref()
            .map(|m| ("motion".to_owned(), m.chart(&g.file.name))),
    );
    out
}

/// Returns the arms over one figure of the levers, for the smallest, the nominal and the largest part. For the nominal part,
/// adds the terms that make up the arms.
fn arms_over(g: &GripReport<'_>, varied: Varied) -> (String, Chart) {
    type Part = (&'static str, fn(&Arms) -> f64);
    const WHOLE: [Part; 2] = [("l1", |a| a.l1), ("l2", |a| a.l2)];
    const PARTS: [Part; 3] = [
        ("l11", |a| a.l11),
        ("l12 = l22", |a| a.l12),
        ("l21", |a| a.l21),
    ];
    let (spec, unit) = (&g.file.spec, g.file.length_unit);
    let (name, what, label, scale) = match varied {
        Varied::LeverLength => ("length", "L", format!("L, {}", unit.symbol), unit.metres),
        Varied::PrismAngle => ("prism-angle", "α", "α, °".to_owned(), 1f64.to_radians()),
        Varied::MountingAngle => ("mounting-angle", "γ", "γ, °".to_owned(), 1f64.to_radians()),
    };
    let all = &spec.diameters;
    let mut diameters: Vec<f64> = all.first().into_iter().chain(all.last()).copied().collect();
    diameters.push(spec.diameter);
    diameters.sort_by(f64::total_cmp);
    diameters.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * *b);
    let mut series = Vec::new();
    for diameter in diameters {
        let curve = arm_curve(spec, varied, diameter);
        let own = (diameter - spec.diameter).abs() <= 1e-9 * diameter;
        let parts = PARTS.iter().filter(|_| own).map(|p| (p, Style::Dashed));
        for (&(arm, of), style) in WHOLE.iter().map(|w| (w, Style::Line)).chain(parts) {
            // What cannot be held breaks the line.
            let y = |a: &Option<Arms>| a.as_ref().map_or(f64::NAN, |a| of(a) / unit.metres);
            series.push(Series {
                name: format!("{arm}, D = {}", four_digits(diameter / unit.metres)),
                points: curve.iter().map(|(x, a)| (x / scale, y(a))).collect(),
                style,
            });
        }
    }
    let chart = Chart {
        title: format!("{}: arms of the clamping forces over {what}", g.file.name),
        subtitle: "All else as stated; where such a gripper can hold the part.".to_owned(),
        x: Axis::linear(label),
        y: Axis::linear(format!("arm, {}", unit.symbol)),
        series,
    };
    (format!("arms-over-{name}"), chart)
}
