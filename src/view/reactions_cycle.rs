//! Joint reactions over a stroke, for people and as data.

use crate::format::number::figure;
use crate::format::phrase::plural;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::reactions::cycle::Cycle;
use crate::statics::reactions::{Choice, NEARLY_SINGULAR, Solution};
use crate::view::layout::table;
use crate::view::reactions_data::{csv_rows, json};
use crate::view::reactions_text::NOTHING;
use crate::view::statics_words::prefix;
use serde_json::{Value, json as value};
use std::fmt::Write;

fn slides(c: &Cycle) -> bool {
    let first = c.drives.first();
    first.is_some_and(|d| matches!(d.1, Freedom::Tx | Freedom::Ty | Freedom::Tz))
}

/// A position as it is shown: degrees, or the file's unit.
fn shown(c: &Cycle, at: f64) -> f64 {
    if slides(c) { at } else { at.to_degrees() }
}

fn solved(c: &Cycle) -> impl Iterator<Item = (f64, &Solution)> {
    c.positions
        .iter()
        .filter_map(|(at, s)| Some((*at, s.as_ref().ok()?)))
}

/// The whole report, fitted to a terminal of `width` columns where one is given.
#[must_use]
pub fn text(m: &Mechanism, state: StateId, c: &Cycle, width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, m, state, c, width);
    out
}

fn write(
    out: &mut String,
    m: &Mechanism,
    state: StateId,
    c: &Cycle,
    width: Option<u16>,
) -> std::fmt::Result {
    let unit = if slides(c) {
        m.length_unit.symbol
    } else {
        "°"
    };
    let at = |x: f64| figure(shown(c, x));
    let all: Vec<(f64, &Solution)> = solved(c).collect();
    let open = all.iter().any(|(_, s)| s.choice == Choice::MinimumNorm);
    writeln!(
        out,
        "{}, state {}: greatest joint reactions over {}{}",
        m.name,
        m.states[state],
        plural(all.len(), "pose"),
        if open {
            ", of minimum norm where redundant constraints leave them open"
        } else {
            ""
        }
    )?;
    let moving = m.loads.drive_speeds.iter().any(|s| *s != 0.0);
    writeln!(
        out,
        "{}\n",
        if moving {
            "Inertia forces of the stated drive speed included; drives at constant speed"
        } else {
            "Drives at rest: no inertia forces; workload.drive_speed adds them"
        }
    )?;
    let Some((_, first)) = all.first() else {
        return writeln!(out, "No pose was reached.");
    };
    let peaks: Vec<_> = (0..first.reactions.len())
        .map(|i| {
            let of = |size: &dyn Fn(&Solution) -> f64| {
                let each = all.iter().map(|(at, s)| (size(s), *at));
                each.max_by(|a, b| a.0.total_cmp(&b.0))
                    .unwrap_or((0.0, 0.0))
            };
            (
                first.reactions[i].joint,
                of(&|s| s.reactions[i].force_size()),
                of(&|s| s.reactions[i].moment_size()),
            )
        })
        .collect();
    let greatest = peaks.iter().map(|p| p.1.0.max(p.2.0)).fold(0.0, f64::max);
    let (scale, prefix) = prefix(greatest);
    // What is left of rounding is nothing.
    let size = |x: f64| {
        if x > NOTHING * greatest {
            figure(x / scale)
        } else {
            "0".to_owned()
        }
    };
    if greatest == 0.0 {
        writeln!(
            out,
            "The loads are nothing here: give links a mass and centre and the [workload] gravity, or forces under [[workload.force]].\n"
        )?;
    }
    let rows = peaks.iter().map(|(j, force, moment)| {
        let joint = &m.joints[*j];
        vec![
            joint.id.clone(),
            joint.joint_type.name().to_owned(),
            size(force.0),
            at(force.1),
            size(moment.0),
            at(moment.1),
        ]
    });
    let (n, nm, place) = (
        format!("|F|, {prefix}N"),
        format!("|M|, {prefix}N·m"),
        format!("at, {unit}"),
    );
    let header = ["joint", "", &n, &place, &nm, &place];
    writeln!(out, "{}\n", table(&header, rows.collect(), width))?;
    for (i, r) in first.reactions.iter().enumerate() {
        let Some((freedom, _)) = r.effort else {
            continue;
        };
        let each: Vec<(f64, f64)> = all
            .iter()
            .filter_map(|(at, s)| Some((s.reactions[i].effort?.1, *at)))
            .collect();
        let least = each.iter().min_by(|a, b| a.0.total_cmp(&b.0));
        let most = each.iter().max_by(|a, b| a.0.total_cmp(&b.0));
        let unit_of = match freedom {
            Freedom::Tx | Freedom::Ty | Freedom::Tz => "N",
            _ => "N·m",
        };
        if let (Some(least), Some(most)) = (least, most) {
            writeln!(
                out,
                "Drive {} holds {}: from {} {unit_of} at {} {unit} to {} {unit_of} at {} {unit}",
                m.joints[r.joint].id,
                freedom.name(),
                figure(least.0),
                at(least.1),
                figure(most.0),
                at(most.1)
            )?;
        }
    }
    let worst = all
        .iter()
        .max_by(|a, b| a.1.condition.total_cmp(&b.1.condition));
    let residual = all.iter().map(|(_, s)| s.residual).fold(0.0, f64::max);
    if let Some((place, s)) = worst {
        writeln!(
            out,
            "Equilibrium: condition up to {} at {} {unit}, residual up to {residual:.0e} of the load",
            figure(s.condition),
            at(*place)
        )?;
        if s.nearly_singular() {
            writeln!(
                out,
                "Warning: nearly singular there (condition above {NEARLY_SINGULAR:.0e}): small errors of manufacture change these reactions much"
            )?;
        }
    }
    for (place, why) in c
        .positions
        .iter()
        .filter_map(|(at, s)| Some((at, s.as_ref().err()?)))
    {
        writeln!(out, "At {} {unit}: {why}", at(*place))?;
    }
    if let Some(place) = c.stopped {
        writeln!(
            out,
            "The stroke could not be followed to {} {unit}; `ozols analyze --stroke` says why",
            at(place)
        )?;
    }
    Ok(())
}

/// Position by position; drive positions in rad or the file's unit.
#[must_use]
pub fn data(m: &Mechanism, state: StateId, c: &Cycle) -> Value {
    let positions = c.positions.iter().map(|(at, s)| match s {
        Ok(s) => {
            let mut found = json(m, state, s);
            found["drive"] = value!(at);
            found
        }
        Err(e) => value!({"drive": at, "error": e.to_string()}),
    });
    value!({
        "mechanism": m.name,
        "state": m.states[state],
        "positions": positions.collect::<Vec<_>>(),
        "stopped": c.stopped,
    })
}

/// One joint and position a line.
#[must_use]
pub fn csv(m: &Mechanism, c: &Cycle) -> String {
    let mut out = String::from("drive,kind,joint,type,Fx,Fy,Fz,F,Mx,My,Mz,M,effort\n");
    for (at, s) in solved(c) {
        for row in csv_rows(m, s) {
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{at},{row}");
        }
    }
    out
}
