//! `ozols statics` of a mechanism that grips: the part cut free, its contact forces on the jaws.

use super::args::{Statics, StaticsFormat, StaticsMethod};
use super::{Done, output, reactions};
use crate::grip::clamping::{Row, Verdict};
use crate::grip::jaw_loads::Gripping;
use crate::model::grip::{LeverDrive, Transmission};
use crate::statics::cycle::statics_at;
use crate::statics::reactions::Reactions;
use crate::statics::reactions::drives::driven;
use crate::statics::reactions::geometry::Geometry;
use crate::statics::transmission::rates;
use crate::view::statics_words::GroupMethod;
use crate::view::{clamped, reactions_data, reactions_text, statics_data, statics_text};
use anyhow::{Context, ensure};

/// The diameter asked for, or the hardest.
fn chosen<'g>(g: &'g Gripping, a: &Statics) -> anyhow::Result<Option<&'g Row>> {
    let Some(diameter) = a.diameter else {
        return Ok(g.study.hardest());
    };
    let unit = g.mechanism.length_unit;
    let near = |r: &&Row| (r.diameter / unit.metres - diameter).abs() < 1e-6 * diameter.abs();
    let found = g.study.rows.iter().find(near);
    let known = || {
        let all = g.study.rows.iter().take(30);
        let all = all.map(|r| crate::format::number::significant(r.diameter / unit.metres));
        all.collect::<Vec<_>>().join(", ")
    };
    let row = found.with_context(|| {
        format!(
            "--diameter {diameter} {} is not one of the diameters of [workload.grip]: {}",
            unit.symbol,
            known()
        )
    })?;
    Ok(Some(row).filter(|r| r.holds()))
}

/// Force, or moment of a turning drive, that the grip asks of one drive of both levers, and whether it is a force.
fn effort(g: &Gripping, row: &Row, pose: &crate::motion::pose::Pose) -> Option<(f64, bool)> {
    let spec = g.mechanism.loads.grip.as_ref()?;
    let (Transmission::Joints(joints), Verdict::Held(h)) =
        (spec.transmission, &row.hardest.as_ref()?.verdict)
    else {
        return None;
    };
    if spec.load.as_ref()?.levers == LeverDrive::Independent {
        return None;
    }
    let t = rates(&g.mechanism, pose, &joints).ok()?;
    let sum: f64 = h.moments.iter().zip(&t.rates).map(|(m, r)| m * r).sum();
    Some((sum.max(0.0), t.slides))
}

pub(super) fn run(g: &Gripping, a: &Statics) -> anyhow::Result<Done> {
    for (given, flag) in [
        (a.stroke.is_some(), "--stroke"),
        (a.svg.is_some(), "--svg"),
        (a.stability, "--stability"),
    ] {
        ensure!(
            !given,
            "{flag} needs a motion, and the levers stand still round the part; --diameter picks another part"
        );
    }
    ensure!(
        !matches!(a.method, StaticsMethod::Delta | StaticsMethod::Projective),
        "joints round a part are solved by equilibrium alone; use --method equilibrium"
    );
    let Some(row) = chosen(g, a)? else {
        return not_held(g, a);
    };
    let fit = g.fit(row)?;
    let Some(loads) = g.loads(row) else {
        return not_held(g, a);
    };
    let mut m = g.mechanism.clone();
    m.loads = loads;
    let effort = effort(g, row, &fit.pose);
    let data = || clamped::json(g, row, &fit, effort.map(|e| e.0));
    let head = |flat: bool, width| clamped::text(g, row, effort, flat, width);
    let one_drive = m.joints.iter().filter(|j| j.drive).count() == 1;
    if !a.spatial && one_drive {
        match statics_at(&m, g.state, &[fit.drive]) {
            Err(e) if reactions::takes(&e, a) => {}
            found => {
                let found = found?;
                let methods = &GroupMethod::ALL;
                return output::to(a.output.as_deref(), |out| {
                    match a.format {
                        StaticsFormat::Json => {
                            let mut value = statics_data::json(&m.name, &found, methods);
                            value["state"] = m.states[g.state].as_str().into();
                            value["grip"] = data();
                            writeln!(out, "{value:#}")?;
                        }
                        StaticsFormat::Csv => {
                            write!(out, "{}", statics_data::csv(&found, methods))?;
                        }
                        StaticsFormat::Text => {
                            let width = output::width(a.output.as_deref());
                            write!(out, "{}", head(true, width))?;
                            let text = statics_text::statics(&m.name, &found, methods, width);
                            write!(out, "{text}")?;
                        }
                    }
                    Ok(Done::Found)
                });
            }
        }
    }
    let home = crate::motion::pose::Pose::of_file(&m, g.state)?;
    let drives = driven(&m, &Geometry::new(&m, g.state, &home)?)?;
    let found = Reactions::at(&m, g.state, &m.loads, &fit.pose, fit.drive, &drives)?;
    output::to(a.output.as_deref(), |out| {
        match a.format {
            StaticsFormat::Json => {
                let mut value = reactions_data::json(&m, g.state, &found);
                value["grip"] = data();
                writeln!(out, "{value:#}")?;
            }
            StaticsFormat::Csv => write!(out, "{}", reactions_data::csv(&m, &found))?,
            StaticsFormat::Text => {
                let width = output::width(a.output.as_deref());
                let pose = clamped::pose(&m, row);
                write!(out, "{}", head(false, width))?;
                let text = reactions_text::solution(&m, g.state, &pose, &found, width);
                write!(out, "{text}")?;
            }
        }
        Ok(Done::Found)
    })
}

/// Says why there are no forces: exit code 1.
fn not_held(g: &Gripping, a: &Statics) -> anyhow::Result<Done> {
    let m = &g.mechanism;
    output::to(a.output.as_deref(), |out| {
        let lost = g.study.rows.iter().filter(|r| !r.holds());
        match a.format {
            StaticsFormat::Json => {
                let reasons: Vec<String> = lost
                    .map(|r| clamped::not_held(m, r).trim().to_owned())
                    .collect();
                let value = serde_json::json!({
                    "mechanism": m.name, "state": m.states[g.state], "held": false, "reasons": reasons,
                });
                writeln!(out, "{value:#}")?;
            }
            StaticsFormat::Csv | StaticsFormat::Text => {
                writeln!(
                    out,
                    "{}, state {}: the part cannot be held, so no contact forces load the jaws",
                    m.name, m.states[g.state]
                )?;
                for row in lost {
                    write!(out, "{}", clamped::not_held(m, row))?;
                }
            }
        }
        Ok(Done::Nothing)
    })
}
