//! A gripper for people: whether it holds, with what drive, and why.

use crate::file::read::workload::Workload;
use crate::format::number::significant;
use crate::format::phrase::plural;
use crate::grip::arm_charts::findings;
use crate::grip::clamping::{Hardest, Row, Study, Verdict};
use crate::grip::holding::{Holding, Slip};
use crate::model::grip::{GripSpec, LeverDrive, PartMass, Pivots, Toward};
use crate::statics::transmission::Rates;
use crate::view::layout::fit;
use crate::view::layout::table;
use std::fmt::Write;

/// What a report is made of.
#[derive(Debug, Clone, Copy)]
pub struct Report<'a> {
    /// The file.
    pub file: &'a Workload<GripSpec>,
    /// What was found.
    pub study: &'a Study,
    /// How the drive works on the levers, a row of the study each; empty where not known.
    pub transmission: &'a [Rates],
}

impl Report<'_> {
    /// How the drive works on the levers in one row.
    #[must_use]
    pub fn rates(&self, row: &Row) -> Option<&Rates> {
        let at = self
            .study
            .rows
            .iter()
            .position(|r| r.diameter == row.diameter)?;
        self.transmission.get(at)
    }

    /// Force `[N]`, or moment `[N·m]` of a turning drive, that one drive of both levers takes.
    #[must_use]
    pub fn effort(&self, row: &Row, h: &Holding) -> Option<f64> {
        let coupled = self.file.spec.load.as_ref()?.levers != LeverDrive::Independent;
        let t = self.rates(row).filter(|_| coupled)?;
        Some(
            h.moments
                .iter()
                .zip(&t.rates)
                .map(|(m, r)| m * r)
                .sum::<f64>()
                .max(0.0),
        )
    }
}

/// What stops a part from being held by any forces, in words.
#[must_use]
pub fn slip(s: &Slip) -> String {
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

/// Why the hardest case is not held.
#[must_use]
pub fn reason(h: &Hardest, friction: f64) -> Option<String> {
    match &h.verdict {
        Verdict::Held(_) => None,
        Verdict::Undecided(e) => Some(format!("{}: {e}", h.case)),
        Verdict::Slips(s) => {
            let remedy = if friction == 0.0 {
                "faces without friction cannot stop that; give friction"
            } else {
                "no closing force stops that; use more friction, deeper prisms, or pivots set for this diameter"
            };
            Some(format!("{}: the part {}; {remedy}", h.case, slip(s)))
        }
    }
}

/// The whole report, fitted to a terminal of `width` columns where one is given.
#[must_use]
pub fn grip(r: &Report<'_>, width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, r, width);
    fit(&out, width)
}

fn range(rows: &[&Row], metres: f64, symbol: &str) -> String {
    let d = |r: &Row| significant(r.diameter / metres);
    match rows {
        [] => "nothing".to_owned(),
        [one] => format!("D = {} {symbol}", d(one)),
        [first, .., last] => format!("D = {} to {} {symbol}", d(first), d(last)),
    }
}

fn write(out: &mut String, r: &Report<'_>, width: Option<u16>) -> std::fmt::Result {
    let (spec, metres, symbol) = (
        &r.file.spec,
        r.file.length_unit.metres,
        r.file.length_unit.symbol,
    );
    let length = |x: f64| significant(x / metres);
    let (held, lost): (Vec<&Row>, Vec<&Row>) = r.study.rows.iter().partition(|row| row.holds());
    let loaded = spec.load.is_some();
    let verb = if loaded {
        "holds"
    } else {
        "can hold (no load stated)"
    };
    match (held.is_empty(), lost.is_empty()) {
        (true, _) => write!(
            out,
            "{}: cannot hold {}",
            r.file.name,
            range(&lost, metres, symbol)
        )?,
        (false, true) => write!(
            out,
            "{}: {verb} {}",
            r.file.name,
            range(&held, metres, symbol)
        )?,
        (false, false) => write!(
            out,
            "{}: {verb} {} of {} diameters, not all",
            r.file.name,
            held.len(),
            r.study.rows.len()
        )?,
    }
    if let Some(row) = r.study.hardest() {
        write!(out, "; hardest at {} {symbol}", length(row.diameter))?;
        if let Some(Hardest {
            case,
            verdict: Verdict::Held(h),
            ..
        }) = &row.hardest
        {
            write!(
                out,
                ", {case}: drive moment {} N·m per lever",
                significant(h.drive)
            )?;
            if let (Some(effort), Some(t)) = (r.effort(row, h), r.rates(row)) {
                match t.slides {
                    true => write!(out, ", drive force {} N", significant(effort))?,
                    false => write!(out, ", drive moment {} N·m", significant(effort))?,
                }
            }
        }
    }
    writeln!(out, "\n")?;
    for row in &lost {
        let friction = spec.load.as_ref().map_or(0.0, |l| l.friction);
        let forces = row.hardest.as_ref().and_then(|h| reason(h, friction));
        for reason in row.obstacles.iter().map(ToString::to_string).chain(forces) {
            writeln!(
                out,
                "  D = {} {symbol} cannot be held: {reason}",
                length(row.diameter)
            )?;
        }
    }
    if !lost.is_empty() {
        writeln!(out)?;
    }
    inputs(out, r)?;
    writeln!(out, "\n{}", rows(r, width))?;
    if let Some(text) = r.study.hardest().and_then(|row| contacts(row, width)) {
        writeln!(out, "\n  The four contact forces in that case:\n\n{text}")?;
    }
    let all = findings();
    let held = all.iter().filter(|f| f.holds).count();
    writeln!(
        out,
        "\n  Findings of [Pavlenko & Godunko 2010], on the curves of its figures: {held} of {} confirmed\n",
        all.len()
    )?;
    let lines = all.into_iter().map(|f| {
        vec![
            f.claim.to_owned(),
            if f.holds { "yes" } else { "NO" }.to_owned(),
            f.evidence,
        ]
    });
    writeln!(
        out,
        "{}",
        table(&["finding", "so", "evidence"], lines.collect(), width)
    )
}

fn inputs(out: &mut String, r: &Report<'_>) -> std::fmt::Result {
    let (spec, metres, symbol) = (
        &r.file.spec,
        r.file.length_unit.metres,
        r.file.length_unit.symbol,
    );
    let length = |x: f64| significant(x / metres);
    let pivots = match (spec.pivots, r.study.rows.first()) {
        (Pivots::Nominal, _) | (_, None) => "pivots set for each diameter".to_owned(),
        (Pivots::Fixed(_) | Pivots::FixedForDiameter, Some(row)) => {
            let a = row.gripper.pivot;
            let nominal = r.study.lever.nominal_diameter(a);
            let at = format!("pivots fixed at a = {} {symbol}", length(a.abs()));
            match nominal > 0.0 {
                true => format!("{at}, nominal for D = {} {symbol}", length(nominal)),
                false => format!("{at}, nominal for no diameter"),
            }
        }
    };
    writeln!(
        out,
        "  levers: L = {} {symbol}, α = {}°, γ = {}°; {pivots}",
        length(spec.lever_length),
        significant(spec.prism_angle.to_degrees()),
        significant(spec.mounting_angle.to_degrees()),
    )?;
    let Some(load) = &spec.load else {
        return Ok(());
    };
    let mass = match load.mass {
        PartMass::Constant(m) => format!("{} kg", significant(m)),
        PartMass::Cylinder { density, length: l } => {
            format!(
                "a cylinder of {} kg/m³, {} {symbol} long",
                significant(density),
                length(l)
            )
        }
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

fn rows(r: &Report<'_>, width: Option<u16>) -> String {
    let (metres, symbol) = (r.file.length_unit.metres, r.file.length_unit.symbol);
    let length = |x: f64| significant(x / metres);
    let mut head: Vec<String> = ["D", "l1", "l2"].map(|n| format!("{n}, {symbol}")).to_vec();
    head.extend(["l1/l2".to_owned(), "turn, °".to_owned()]);
    let load = r.file.spec.load.as_ref();
    let loaded = load.is_some();
    let told =
        !r.transmission.is_empty() && load.is_some_and(|l| l.levers != LeverDrive::Independent);
    if loaded {
        head.extend(["mass, kg", "moment per lever, N·m", "both levers, N·m"].map(str::to_owned));
        if told {
            head.push("drive, N".to_owned());
        }
        head.push("hardest case".to_owned());
    } else {
        head.push("held".to_owned());
    }
    let line = |row: &Row| {
        let mut cells = vec![
            length(row.diameter),
            length(row.arms.l1),
            length(row.arms.l2),
        ];
        cells.push(significant(row.arms.l1 / row.arms.l2));
        cells.push(
            row.pose
                .as_ref()
                .map_or_else(|| "-".to_owned(), |p| significant(p.turn.to_degrees())),
        );
        let verdict = row.hardest.as_ref().map(|h| &h.verdict);
        if !loaded {
            cells.push(if row.holds() { "yes" } else { "no" }.to_owned());
            return cells;
        }
        cells.push(significant(row.mass));
        let holding = match verdict {
            Some(Verdict::Held(h)) => Some(h),
            _ => None,
        };
        let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), significant);
        cells.push(number(holding.map(|h| h.drive)));
        cells.push(
            holding.map_or_else(|| "-".to_owned(), |h| h.moments.map(significant).join(", ")),
        );
        if told {
            cells.push(number(holding.and_then(|h| r.effort(row, h))));
        }
        cells.push(
            row.hardest
                .as_ref()
                .map_or_else(|| "cannot be held".to_owned(), |h| h.case.clone()),
        );
        cells
    };
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    table(&head, r.study.rows.iter().map(line).collect(), width)
}

fn contacts(row: &Row, width: Option<u16>) -> Option<String> {
    let (pose, hardest) = (row.pose.as_ref()?, row.hardest.as_ref()?);
    let Verdict::Held(h) = &hardest.verdict else {
        return None;
    };
    let lines = pose.contacts.iter().zip(&h.forces).map(|(c, f)| {
        let friction = if f.normal > 0.0 {
            f.friction() / f.normal
        } else {
            0.0
        };
        vec![
            c.name.to_owned(),
            significant(f.normal),
            significant(f.along),
            significant(f.axial),
            format!("{friction:.3}"),
        ]
    });
    let head = [
        "contact",
        "normal, N",
        "along the face, N",
        "along the part, N",
        "friction/normal",
    ];
    Some(table(&head, lines.collect(), width))
}
