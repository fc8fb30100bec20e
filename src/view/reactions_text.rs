//! Joint reactions for people.

use crate::format::number::figure;
use crate::format::phrase::plural;
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::reactions::{Choice, JointReaction, NEARLY_SINGULAR, Solution};
use crate::view::layout::fit;
use crate::view::layout::table;
use crate::view::statics_words::prefix;
use std::fmt::Write;

/// Self-stresses told at most.
const STRESSES: usize = 12;

/// Whether the freedom of a drive is a shift, so that its effort is a force.
fn slides(freedom: Freedom) -> bool {
    matches!(freedom, Freedom::Tx | Freedom::Ty | Freedom::Tz)
}

/// What a component is next to: below this fraction of the greatest it is rounding.
pub(super) const NOTHING: f64 = 1e-12;

fn reactions(m: &Mechanism, list: &[JointReaction], size: f64, width: Option<u16>) -> String {
    let greatest = list
        .iter()
        .map(|r| r.force_size().max(r.moment_size() / size))
        .fold(0.0, f64::max);
    let (unit, prefix) = prefix(greatest);
    let show = |x: f64, least: f64| {
        if x.abs() <= least {
            "0".to_owned()
        } else {
            figure(x / unit)
        }
    };
    let rows = list.iter().map(|r| {
        let joint = &m.joints[r.joint];
        let (force, moment) = (NOTHING * greatest, NOTHING * greatest * size);
        let mut row = vec![joint.id.clone(), joint.joint_type.name().to_owned()];
        row.extend(r.force.map(|x| show(x, force)));
        row.push(show(r.force_size(), force));
        row.extend(r.moment.map(|x| show(x, moment)));
        row.push(show(r.moment_size(), moment));
        row
    });
    let (n, nm) = (format!("|F|, {prefix}N"), format!("|M|, {prefix}N·m"));
    let header = ["joint", "", "Fx", "Fy", "Fz", &n, "Mx", "My", "Mz", &nm];
    table(&header, rows.collect(), width)
}

/// The whole report, fitted to a terminal of `width` columns where one is given; `pose` in words.
#[must_use]
pub fn solution(
    m: &Mechanism,
    state: StateId,
    pose: &str,
    s: &Solution,
    width: Option<u16>,
) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write_solution(&mut out, m, state, pose, s, width);
    fit(&out, width)
}

fn write_solution(
    out: &mut String,
    m: &Mechanism,
    state: StateId,
    pose: &str,
    s: &Solution,
    width: Option<u16>,
) -> std::fmt::Result {
    let open = s.self_stresses.len();
    let what = match s.choice {
        Choice::Unique => "the only ones in equilibrium".to_owned(),
        Choice::MinimumNorm => format!(
            "of minimum norm among a family with {}: Σ |F|² + |M|²/ℓ² least, ℓ = {} m",
            if open == 1 {
                "1 self-stress".to_owned()
            } else {
                format!("{open} self-stresses")
            },
            figure(s.size)
        ),
    };
    writeln!(
        out,
        "{}, state {}, {pose}: joint reactions, {what}",
        m.name, m.states[state]
    )?;
    writeln!(
        out,
        "First link on second, in the joint's own frame (z its axis), moments about its point\n"
    )?;
    let loads = &m.loads;
    if loads.drive_speeds.iter().any(|s| *s != 0.0) {
        writeln!(out, "Inertia forces of the stated drive speed included\n")?;
    }
    let no_mass = m.links.iter().all(|l| l.mass.is_none()) || loads.gravity.is_none();
    if no_mass && loads.forces.is_empty() && loads.moments.is_empty() {
        writeln!(
            out,
            "The file states no loads: give links a mass and centre and the [workload] gravity, or forces under [[workload.force]].\n"
        )?;
    }
    writeln!(out, "{}\n", reactions(m, &s.reactions, s.size, width))?;
    for r in &s.reactions {
        if let Some((freedom, effort)) = r.effort {
            let (what, unit) = if slides(freedom) {
                ("force", "N")
            } else {
                ("torque", "N·m")
            };
            writeln!(
                out,
                "Drive {} holds {}: {what} {} {unit}",
                m.joints[r.joint].id,
                freedom.name(),
                figure(effort)
            )?;
        }
    }
    if s.undriven > 0 {
        writeln!(
            out,
            "{} left with the drives held, on which the loads do no work",
            plural(s.undriven, "freedom")
        )?;
    }
    writeln!(
        out,
        "Equilibrium: condition {}, residual {:.0e} of the load",
        figure(s.condition),
        s.residual
    )?;
    if s.nearly_singular() {
        writeln!(
            out,
            "Warning: nearly singular (condition above {NEARLY_SINGULAR:.0e}): small errors of manufacture change these reactions much"
        )?;
    }
    if open > 0 {
        writeln!(
            out,
            "\nRedundant constraints leave these reactions open: any multiples of the {open} {} may be added",
            if open == 1 {
                "self-stress"
            } else {
                "self-stresses"
            }
        )?;
        for (i, stress) in s.self_stresses.iter().take(STRESSES).enumerate() {
            let loaded = stress
                .iter()
                .filter(|r| r.force_size() > 1e-9 || r.moment_size() > 1e-9 * s.size);
            let names: Vec<&str> = loaded.map(|r| m.joints[r.joint].id.as_str()).collect();
            writeln!(out, "  {}: {}", i + 1, names.join(", "))?;
        }
        if open > STRESSES {
            writeln!(out, "  and {} more", open - STRESSES)?;
        }
    }
    match &s.elastic {
        Some(list) => {
            let askew = match loads.misalignments.len() {
                0 => "no misalignment".to_owned(),
                n => plural(n, "misalignment"),
            };
            writeln!(
                out,
                "\nReactions of elastic joints of the stated stiffness, {askew}\n\n{}",
                reactions(m, list, s.size, width)
            )?;
        }
        None if open > 0 => writeln!(
            out,
            "State [workload.stiffness.default] linear and angular, and [[workload.misalignment]], to see which of them arises."
        )?,
        None if !loads.misalignments.is_empty() => writeln!(
            out,
            "Misalignments cause no reactions here: the mechanism is determinate and assembles without strain."
        )?,
        None => {}
    }
    Ok(())
}
