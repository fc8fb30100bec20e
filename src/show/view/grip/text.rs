//! A gripper for people: whether it holds, with what drive, and why.

use crate::grip::clamping::DiameterRow;
use crate::grip::contact::TouchingPose;
use crate::grip::holding::Holding;
use crate::model::claim::Topic;
use crate::model::grip::{LeverDrive, PartMass, Pivots, Toward};
use crate::view::claims;
use crate::view::grip::{GripReport, reasons};
use crate::view::prelude::*;
use std::fmt::Write;

/// The report, fitted to a terminal of `width` columns where one is given.
#[must_use]
pub fn grip(g: &GripReport<'_>, width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, g, width);
    fit(&out, width)
}

/// A length in the file's unit, with its symbol.
fn length(g: &GripReport<'_>, x: f64) -> String {
    g.file.length_unit.words(x)
}

fn range(g: &GripReport<'_>, rows: &[&DiameterRow]) -> String {
    let d = |r: &DiameterRow| length(g, r.diameter);
    match rows {
        [] => "nothing".to_owned(),
        [one] => format!("D = {}", d(one)),
        [first, .., last] => {
            let from = significant(first.diameter / g.file.length_unit.metres);
            format!("D = {from} to {}", d(last))
        }
    }
}

fn write(out: &mut String, g: &GripReport<'_>, width: Option<u16>) -> std::fmt::Result {
    let rows = &g.found.study.rows;
    let (held, lost): (Vec<_>, Vec<_>) = rows.iter().partition(|d| d.holds());
    verdict(out, g, &held, &lost)?;
    for d in &lost {
        for reason in reasons(d, g.friction()) {
            let at = length(g, d.diameter);
            writeln!(out, "  D = {at} cannot be held: {reason}")?;
        }
    }
    if !lost.is_empty() {
        writeln!(out)?;
    }
    inputs(out, g)?;
    writeln!(out, "\n{}", diameters(g, width))?;
    writeln!(
        out,
        "\n  The arms and their parts, l1 = l11 + l12 and l2 = l21 - l22:\n\n{}",
        parts(g, width)
    )?;
    let hardest = g.hardest().map(|at| &rows[at]);
    let held = hardest.and_then(|d| Some((d.hardest.as_ref()?.held()?, d.pose.as_ref()?)));
    if let Some((held, pose)) = held {
        writeln!(
            out,
            "\n  The four contact forces in that case:\n\n{}",
            contacts(held, pose, g.friction(), width)
        )?;
    }
    if let Some(motion) = &g.motion {
        write!(out, "{}", motion.text(width))?;
    }
    write!(
        out,
        "{}",
        claims::text(&claims::about(&g.file.claims, Topic::Grip), width)
    )
}

/// What can be held, and what the hardest of it takes.
fn verdict(
    out: &mut String,
    g: &GripReport<'_>,
    held: &[&DiameterRow],
    lost: &[&DiameterRow],
) -> std::fmt::Result {
    let name = &g.file.name;
    // The forces found can balance the load; others may arise, and the safety factor is for those.
    let verb = if g.file.spec.load.is_some() {
        "can hold"
    } else {
        "can hold (no load stated)"
    };
    match (held.is_empty(), lost.is_empty()) {
        (true, _) => write!(out, "{name}: cannot hold {}", range(g, lost))?,
        (false, true) => write!(out, "{name}: {verb} {}", range(g, held))?,
        (false, false) => write!(
            out,
            "{name}: {verb} {} of {} diameters, not all",
            held.len(),
            g.found.study.rows.len()
        )?,
    }
    let hardest = g.hardest().map(|at| (at, &g.found.study.rows[at]));
    if let Some((at, d, load)) = hardest.and_then(|(at, d)| Some((at, d, d.hardest.as_ref()?))) {
        write!(out, "; hardest at {}", length(g, d.diameter))?;
        if let Some(moment) = d.drive() {
            let moment = significant(moment);
            write!(out, ", {}: drive moment {moment} N·m per lever", load.case)?;
        }
        if let (Some(effort), Some(t)) = (g.effort(at), g.rates(at)) {
            write!(out, ", {}", effort_of_drive(effort, t.slides))?;
        }
    }
    writeln!(out, "\n")
}

/// What one drive of both levers takes: a force where it slides, a moment where it turns.
pub(super) fn effort_of_drive(effort: f64, slides: bool) -> String {
    if slides {
        format!("drive force {} N", significant(effort))
    } else {
        format!("drive moment {} N·m", significant(effort))
    }
}

/// Where the pivots are.
fn pivots(g: &GripReport<'_>) -> String {
    match (g.file.spec.pivots, g.found.study.rows.first()) {
        (Pivots::Nominal, _) | (_, None) => "pivots set for each diameter".to_owned(),
        (Pivots::Fixed(_) | Pivots::FixedForDiameter, Some(d)) => {
            let pivot = d.gripper.pivot;
            let nominal = g.found.study.lever.nominal_diameter(pivot);
            let at = format!("pivots fixed at a = {}", length(g, pivot.abs()));
            if nominal > 0.0 {
                format!("{at}, nominal for D = {}", length(g, nominal))
            } else {
                format!("{at}, nominal for no diameter")
            }
        }
    }
}

fn inputs(out: &mut String, g: &GripReport<'_>) -> std::fmt::Result {
    let spec = &g.file.spec;
    writeln!(
        out,
        "  levers: L = {}, α = {}°, γ = {}°; {}",
        length(g, spec.lever_length),
        significant(spec.prism_angle.to_degrees()),
        significant(spec.mounting_angle.to_degrees()),
        pivots(g)
    )?;
    let Some(load) = &spec.load else {
        return Ok(());
    };
    let mass = match load.mass {
        PartMass::Constant(m) => format!("{} kg", significant(m)),
        PartMass::Cylinder { density, length: l } => format!(
            "a cylinder of {} kg/m³, {} long",
            significant(density),
            length(g, l)
        ),
    };
    let gravity = match load.gravity {
        Toward::Any(g) => format!("gravity {} m/s² in any direction", significant(g)),
        Toward::Fixed(g) => format!("gravity ({}) m/s²", g.map(significant).join(", ")),
    };
    let levers = match load.levers {
        LeverDrive::Coupled => {
            "both levers turned by one drive (the moment per lever is the mean of the two)"
        }
        LeverDrive::Equal => "the same moment on both levers",
        LeverDrive::Independent => {
            "a drive for each lever (the moment per lever is the greater of the two)"
        }
    };
    writeln!(
        out,
        "  load: {mass}, {gravity}, {}, friction {}, safety factor {}",
        plural(load.accelerations.len(), "acceleration"),
        significant(load.friction),
        significant(load.safety)
    )?;
    writeln!(out, "  drive: {levers}")?;
    writeln!(
        out,
        "  friction cones are exact; a case of any direction is the worst of 26 directions, refined"
    )
}

fn diameters(g: &GripReport<'_>, width: Option<u16>) -> String {
    let symbol = g.file.length_unit.symbol;
    let mut head: Vec<String> = ["D", "l1", "l2"].map(|n| format!("{n}, {symbol}")).to_vec();
    head.extend(["l1/l2".to_owned(), "turn, °".to_owned()]);
    let load = g.file.spec.load.as_ref();
    let one_drive = g.rates(g.hardest().unwrap_or(0)).is_some()
        && load.is_some_and(|l| l.levers != LeverDrive::Independent);
    if load.is_some() {
        head.extend(["mass, kg", "moment per lever, N·m", "both levers, N·m"].map(str::to_owned));
        if one_drive {
            head.push("drive, N".to_owned());
        }
        head.push("hardest case".to_owned());
    } else {
        head.push("held".to_owned());
    }
    let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), significant);
    let line = |(at, d): (usize, &DiameterRow)| {
        let mut cells = [d.diameter, d.arms.l1, d.arms.l2]
            .map(|x| significant(x / g.file.length_unit.metres))
            .to_vec();
        cells.push(significant(d.arms.l1 / d.arms.l2));
        cells.push(number(d.pose.as_ref().map(|p| p.turn.to_degrees())));
        if load.is_none() {
            cells.push(if d.holds() { "yes" } else { "no" }.to_owned());
            return cells;
        }
        cells.push(significant(d.mass));
        let hardest = d.hardest.as_ref();
        cells.push(number(d.drive()));
        let both = hardest.and_then(|l| Some(l.held()?.moments));
        cells.push(both.map_or_else(|| "-".to_owned(), |m| m.map(significant).join(", ")));
        if one_drive {
            cells.push(number(g.effort(at)));
        }
        cells.push(hardest.map_or("cannot be held", |l| &l.case).to_owned());
        cells
    };
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let rows = g.found.study.rows.iter().enumerate();
    table(&head, rows.map(line).collect(), width)
}

/// Each arm as the part of the lever and the part of the prism.
fn parts(g: &GripReport<'_>, width: Option<u16>) -> String {
    let symbol = g.file.length_unit.symbol;
    let head = ["D", "l11", "l12", "l1", "l21", "l22", "l2"].map(|n| format!("{n}, {symbol}"));
    let line = |d: &DiameterRow| {
        let a = d.arms;
        let all = [d.diameter, a.l11, a.l12, a.l1, a.l21, a.l22, a.l2];
        all.map(|x| significant(x / g.file.length_unit.metres))
            .to_vec()
    };
    let rows = g.found.study.rows.iter().map(line).collect();
    table(&head.each_ref().map(String::as_str), rows, width)
}

/// A ratio to three decimals, rounded down where that would go beyond its limit.
fn at_most(ratio: f64, limit: f64) -> String {
    let text = format!("{ratio:.3}");
    let beyond = text.parse::<f64>().is_ok_and(|shown| shown > limit);
    if beyond {
        format!("{:.3}", (1000.0 * limit).floor() / 1000.0)
    } else {
        text
    }
}

fn contacts(held: &Holding, pose: &TouchingPose, limit: f64, width: Option<u16>) -> String {
    let rows = pose.contacts.iter().zip(&held.forces).map(|(c, f)| {
        let mut cells = vec![c.name.to_owned()];
        cells.extend([f.normal, f.along, f.axial].map(significant));
        // A face that does not press has no friction.
        let friction = (f.normal > 0.0).then(|| f.along.hypot(f.axial) / f.normal);
        cells.push(friction.map_or_else(|| "-".to_owned(), |f| at_most(f, limit)));
        cells
    });
    let head = [
        "contact",
        "normal, N",
        "along the face, N",
        "along the part, N",
        "friction/normal",
    ];
    table(&head, rows.collect(), width)
}
