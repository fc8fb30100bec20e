//! What a grip loads its mechanism with, for people and as data.

use crate::format::number::significant;
use crate::grip::clamping::{Hardest, Row, Verdict};
use crate::grip::jaw_loads::{Fit, Gripping};
use crate::model::mechanism::Mechanism;
use crate::view::grip_text::reason;
use crate::view::layout::table;
use serde_json::{Value, json};
use std::fmt::Write;

fn friction(m: &Mechanism) -> f64 {
    let load = m.loads.grip.as_ref().and_then(|g| g.load.as_ref());
    load.map_or(0.0, |l| l.friction)
}

fn safety(m: &Mechanism) -> f64 {
    let load = m.loads.grip.as_ref().and_then(|g| g.load.as_ref());
    load.map_or(1.0, |l| l.safety)
}

fn diameter(m: &Mechanism, row: &Row) -> String {
    let unit = m.length_unit;
    format!(
        "D = {} {}",
        significant(row.diameter / unit.metres),
        unit.symbol
    )
}

/// The pose in a few words.
#[must_use]
pub fn pose(m: &Mechanism, row: &Row) -> String {
    format!("round a part of {}", diameter(m, row))
}

/// The case that loads the mechanism: "D = 50 mm, acceleration (5, 0, 0) m/s², safety factor 1.5".
#[must_use]
pub fn case(m: &Mechanism, row: &Row) -> String {
    let words = row.hardest.as_ref().map_or("", |h| h.case.as_str());
    format!(
        "{}, {words}, safety factor {}",
        diameter(m, row),
        significant(safety(m))
    )
}

/// Every reason why a part is not held, one a line.
#[must_use]
pub fn not_held(m: &Mechanism, row: &Row) -> String {
    let forces = row.hardest.as_ref().and_then(|h| reason(h, friction(m)));
    let mut out = String::new();
    for why in row.obstacles.iter().map(ToString::to_string).chain(forces) {
        // Writing to a string cannot fail.
        let _ = writeln!(out, "  {} cannot be held: {why}", diameter(m, row));
    }
    out
}

/// The loads from the grip, fitted to a terminal of `width` columns where one is given; `flat` where forces across the
/// plane of motion are left out.
#[must_use]
pub fn text(
    g: &Gripping,
    row: &Row,
    effort: Option<(f64, bool)>,
    flat: bool,
    width: Option<u16>,
) -> String {
    let m = &g.mechanism;
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, g, row, effort, flat, width);
    for other in g.study.rows.iter().filter(|r| !r.holds()) {
        out.push_str(&not_held(m, other));
    }
    out
}

fn write(
    out: &mut String,
    g: &Gripping,
    row: &Row,
    effort: Option<(f64, bool)>,
    flat: bool,
    width: Option<u16>,
) -> std::fmt::Result {
    let m = &g.mechanism;
    let Some(Hardest {
        verdict: Verdict::Held(h),
        ..
    }) = &row.hardest
    else {
        return Ok(());
    };
    let choice = match g.study.hardest() {
        Some(hardest) if hardest.diameter == row.diameter => "the worst case",
        _ => "the worst case of this diameter",
    };
    writeln!(
        out,
        "{}, state {}: the part is cut free, and the jaws bear the contact forces of {choice} (`ozols grip`):",
        m.name, m.states[g.state]
    )?;
    writeln!(out, "{}", case(m, row))?;
    write!(out, "The grip asks {} N·m per lever", significant(h.drive))?;
    match effort {
        Some((force, true)) => write!(out, ", drive force {} N", significant(force))?,
        Some((moment, false)) => write!(out, ", drive moment {} N·m", significant(moment))?,
        None => {}
    }
    writeln!(
        out,
        "; its drive below bears that and the loads of the links\n"
    )?;
    let rows = g
        .contacts
        .iter()
        .enumerate()
        .zip(&h.forces)
        .map(|((i, &j), f)| {
            vec![
                m.joints[j].id.clone(),
                m.links[g.levers[i / 2]].id.clone(),
                significant(f.normal),
                significant(f.along),
                significant(f.axial),
            ]
        });
    let head = [
        "contact",
        "jaw",
        "normal, N",
        "along the face, N",
        "along the part, N",
    ];
    writeln!(out, "{}\n", table(&head, rows.collect(), width))?;
    let axial = h.forces.iter().any(|f| f.axial.abs() > 1e-6 * f.normal);
    if flat && axial {
        writeln!(
            out,
            "Forces along the part are across the plane of motion and left out below; --spatial takes them.\n"
        )?;
    }
    Ok(())
}

/// The same as data: forces in N on the part, in the grip's own axes.
#[must_use]
pub fn json(g: &Gripping, row: &Row, fit: &Fit, effort: Option<f64>) -> Value {
    let m = &g.mechanism;
    let hardest = row.hardest.as_ref();
    let held = hardest.and_then(|h| match &h.verdict {
        Verdict::Held(held) => Some(held),
        Verdict::Slips(_) | Verdict::Undecided(_) => None,
    });
    let forces = held.map(|h| {
        let each = g.contacts.iter().enumerate().zip(&h.forces);
        each.map(|((i, &j), f)| {
            json!({
                "contact": m.joints[j].id,
                "jaw": m.links[g.levers[i / 2]].id,
                "normal": f.normal,
                "along_face": f.along,
                "along_part": f.axial,
            })
        })
        .collect::<Vec<_>>()
    });
    json!({
        "diameter": row.diameter,
        "case": hardest.map(|h| h.case.as_str()),
        "pull": hardest.map(|h| h.pull),
        "safety": safety(m),
        "drive_position": fit.drive,
        "drive_moment_per_lever": held.map(|h| h.drive),
        "lever_moments": held.map(|h| h.moments),
        "drive_effort": effort,
        "contacts": forces,
    })
}
