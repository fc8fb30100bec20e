//! Joint reactions in one pose for people.

use crate::statics::reactions::NEARLY_SINGULAR;
use crate::view::prelude::*;
use crate::view::reactions::{JointForces, ObjectContact, Reactions, couplings};
use std::fmt::Write;

/// The remedy for a file that states no loads.
pub(super) const ADD_LOADS: &str =
    "give links a mass and centre and the [workload] gravity, or forces under [[workload.force]]";

/// What misalignments do where no redundant constraint is left.
pub(crate) const NO_STRAIN: &str = "Misalignments cause no reactions here: the mechanism is determinate and assembles without strain.";

/// Returns the sentence on a file that states no loads, but perhaps misalignments.
pub(crate) fn no_loads(misalignments: usize) -> String {
    let only = match misalignments {
        0 => String::new(),
        n => format!(" but {}", plural(n, "misalignment")),
    };
    format!("The file states no loads{only}: {ADD_LOADS}.")
}

/// Self-stresses told at most.
const STRESSES: usize = 12;

fn joints(list: &[JointForces<'_>], size: f64, width: Option<u16>) -> String {
    let greatest = list
        .iter()
        .map(|r| r.force_magnitude.max(r.moment_magnitude / size))
        .fold(0.0, f64::max);
    let (unit, prefix) = prefix(greatest);
    let rows = list.iter().map(|r| {
        let mut row = [r.joint, r.kind].map(str::to_owned).to_vec();
        for (vector, magnitude) in [
            (r.reaction.force, r.force_magnitude),
            (r.reaction.moment, r.moment_magnitude),
        ] {
            row.extend(vector.map(|x| figure(x / unit)));
            row.push(figure(magnitude / unit));
        }
        row
    });
    let (n, nm) = (format!("|F|, {prefix}N"), format!("|M|, {prefix}N·m"));
    let header = ["joint", "", "Fx", "Fy", "Fz", &n, "Mx", "My", "Mz", &nm];
    table(&header, rows.collect(), width)
}

/// What the faces on objects are asked to do.
fn contacts(list: &[ObjectContact<'_>], width: Option<u16>) -> String {
    let greatest = list.iter().map(|c| c.force.normal.abs().max(c.force.along));
    let greatest = greatest.fold(0.0, f64::max);
    let (unit, prefix) = prefix(greatest);
    let show = |x: f64| figure(x / unit);
    let stated = |x: Option<f64>| x.map_or_else(|| "not stated".to_owned(), significant);
    let rows = list.iter().map(|c| {
        let force = c.force;
        let mut row = [c.contact, c.touch].map(str::to_owned).to_vec();
        row.extend([
            show(force.normal),
            show(force.along),
            stated(force.friction),
        ]);
        row.extend([show(force.tilting), stated(force.radius)]);
        row
    });
    let head = [
        "contact".to_owned(),
        String::new(),
        format!("normal, {prefix}N"),
        format!("along the face, {prefix}N"),
        "friction".to_owned(),
        format!("tilting, {prefix}N·m"),
        "face radius, m".to_owned(),
    ];
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    table(&head, rows.collect(), width)
}

/// Says first where contacts are asked for what faces cannot do.
fn refuted(out: &mut String, s: &Reactions<'_>) -> std::fmt::Result {
    let bad: Vec<&ObjectContact> = s.contacts.iter().filter(|c| !c.holds()).collect();
    for c in &bad {
        let (unit, prefix) = prefix(c.force.normal.abs().max(c.force.along));
        let force = |x: f64| format!("{} {prefix}N", significant(x / unit));
        let limit = |x: Option<f64>| x.map_or_else(String::new, significant);
        let what = match c.touch {
            "pulls" => format!("would pull with {}", force(-c.force.normal)),
            "slips" => format!(
                "would need friction of {} under {}, more than the coefficient {} gives",
                force(c.force.along),
                force(c.force.normal),
                limit(c.force.friction)
            ),
            _ => format!(
                "would need its pressure beyond the face's radius of {} m",
                limit(c.force.radius)
            ),
        };
        writeln!(out, "NOT AS CONTACTS ACT: {} {what}", c.contact)?;
    }
    if !bad.is_empty() {
        let way = if s.unique {
            "no other reactions are in equilibrium, so the object is not held"
        } else {
            "--unilateral solves with contacts that only push"
        };
        writeln!(out, "  contacts are taken as joints here; {way}")?;
    }
    Ok(())
}

/// Which components the choice within the family is about.
fn left_open(s: &Reactions<'_>) -> String {
    let mut alike: Vec<(&[&str], Vec<&str>)> = Vec::new();
    for r in s.reactions.iter().filter(|r| !r.open.is_empty()) {
        match alike.iter_mut().find(|(open, _)| *open == r.open) {
            Some((_, joints)) => joints.push(r.joint),
            None => alike.push((&r.open, vec![r.joint])),
        }
    }
    let each = alike
        .iter()
        .map(|(open, joints)| format!("{} of {}", list(open), list(joints)));
    let mut each: Vec<String> = each.collect();
    let passed = s.couplings.iter().filter(|c| c.open);
    let passed: Vec<&str> = passed.map(|c| c.coupling.as_str()).collect();
    if !passed.is_empty() {
        each.push(format!("what {} pass", list(&passed)));
    }
    format!(
        "Left open by the self-stresses: {}; all else is the same in the whole family",
        each.join("; ")
    )
}

/// The report, fitted to a terminal of `width` columns where one is given; `pose` in words.
#[must_use]
pub fn reactions(s: &Reactions<'_>, pose: &str, width: Option<u16>) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut out, s, pose, width);
    fit(&out, width)
}

fn write(out: &mut String, s: &Reactions<'_>, pose: &str, width: Option<u16>) -> std::fmt::Result {
    head(out, s, pose)?;
    refuted(out, s)?;
    writeln!(
        out,
        "First link on second, in the joint's own frame (z its axis), moments about its point\n"
    )?;
    if !s.unique {
        writeln!(out, "{}\n", left_open(s))?;
    }
    of_loads(out, s)?;
    writeln!(out, "{}\n", joints(&s.reactions, s.size, width))?;
    if !s.contacts.is_empty() {
        writeln!(out, "{}\n", contacts(&s.contacts, width))?;
    }
    couplings::text(out, &s.couplings, width)?;
    drives(out, s)?;
    equilibrium(out, s)?;
    if !s.self_stresses.is_empty() {
        family(out, s)?;
    }
    elastic(out, s, width)
}

/// What a number of self-stresses is called.
fn stresses(n: usize) -> &'static str {
    if n == 1 {
        "self-stress"
    } else {
        "self-stresses"
    }
}

/// Which reactions these are, and whether numbers decide it.
fn head(out: &mut String, s: &Reactions<'_>, pose: &str) -> std::fmt::Result {
    let open = s.self_stresses.len();
    let what = if s.unique {
        "the only ones in equilibrium".to_owned()
    } else if s.choice == "pushing" {
        format!(
            "of minimum norm among those in which contacts only push: Σ |F|² + |M|²/ℓ² least, ℓ = {} m",
            figure(s.size)
        )
    } else {
        format!(
            "of minimum norm among a family with {open} {}: Σ |F|² + |M|²/ℓ² least, ℓ = {} m",
            stresses(open),
            figure(s.size)
        )
    };
    writeln!(
        out,
        "{}, state {}, {pose}: joint reactions, {what}",
        s.mechanism, s.state
    )?;
    if let Some(n) = s.exact_self_stresses {
        writeln!(
            out,
            "NOT DECIDED BY NUMBERS: in exact geometry there are {}, and the difference is below what singular values tell from zero; look for points or axes that are nearly alike",
            if n == 1 {
                "1 self-stress".to_owned()
            } else {
                format!("{n} self-stresses")
            }
        )?;
    }
    Ok(())
}

/// What the reactions answer to, where it is not what a reader would expect.
fn of_loads(out: &mut String, s: &Reactions<'_>) -> std::fmt::Result {
    let (m, loads) = (s.of, &s.of.loads);
    if loads.drive_speeds.iter().any(|s| *s != 0.0) {
        writeln!(out, "Inertia forces of the stated drive speed included\n")?;
    }
    let accelerated = loads.gravity.is_some() || loads.drive_speeds.iter().any(|s| *s != 0.0);
    let no_mass = m.links.iter().all(|l| l.mass.is_none()) || !accelerated;
    let outside = m
        .state(s.state)
        .is_some_and(|state| loads.acts_from_outside(state));
    if no_mass && !outside {
        writeln!(out, "{}\n", no_loads(loads.misalignments.len()))?;
    }
    Ok(())
}

/// What the drives must do.
fn drives(out: &mut String, s: &Reactions<'_>) -> std::fmt::Result {
    for r in &s.reactions {
        let Some(d) = &r.drive else { continue };
        let (what, unit) = if d.slides {
            ("force", "N")
        } else {
            ("torque", "N·m")
        };
        writeln!(
            out,
            "Drive {} holds {}: {what} {} {unit}",
            r.joint,
            d.freedom,
            figure(d.effort)
        )?;
    }
    Ok(())
}

/// How well the equations are solved.
fn equilibrium(out: &mut String, s: &Reactions<'_>) -> std::fmt::Result {
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
    if s.nearly_singular {
        writeln!(
            out,
            "Warning: nearly singular (condition above {NEARLY_SINGULAR:.0e}): small errors of manufacture change these reactions much"
        )?;
    }
    Ok(())
}

/// The self-stresses that may be added, by the joints each loads.
fn family(out: &mut String, s: &Reactions<'_>) -> std::fmt::Result {
    let open = s.self_stresses.len();
    writeln!(
        out,
        "\nRedundant constraints leave these reactions open: any multiples of the {open} {} may be added{}",
        stresses(open),
        if s.choice == "pushing" {
            " with which contacts still push"
        } else {
            ""
        }
    )?;
    let both = s.self_stresses.iter().zip(&s.coupling_stresses);
    for (i, (stress, coupled)) in both.take(STRESSES).enumerate() {
        let loaded = stress
            .iter()
            .filter(|r| r.force_magnitude > 1e-9 || r.moment_magnitude > 1e-9 * s.size);
        let coupled = couplings::loaded(coupled, s.size);
        let names: Vec<&str> = loaded.map(|r| r.joint).chain(coupled).collect();
        writeln!(out, "  {}: {}", i + 1, names.join(", "))?;
    }
    if open > STRESSES {
        writeln!(out, "  and {} more", open - STRESSES)?;
    }
    Ok(())
}

/// Which of the family elastic joints choose, or what to state to see it.
fn elastic(out: &mut String, s: &Reactions<'_>, width: Option<u16>) -> std::fmt::Result {
    let (open, loads) = (s.self_stresses.len(), &s.of.loads);
    match &s.elastic {
        Some(list) => {
            let askew = match loads.misalignments.len() {
                0 => "no misalignment".to_owned(),
                n => plural(n, "misalignment"),
            };
            writeln!(
                out,
                "\nReactions of elastic joints of the stated stiffness, {askew}\n\n{}",
                joints(list, s.size, width)
            )?;
            couplings::elastic(out, s.elastic_couplings.as_deref().unwrap_or_default())
        }
        None if open > 0 && s.choice != "pushing" => writeln!(
            out,
            "State [workload.stiffness.default] linear and angular, and [[workload.misalignment]], to see which of them arises."
        ),
        None if open == 0 && !loads.misalignments.is_empty() => writeln!(out, "{NO_STRAIN}"),
        None => Ok(()),
    }
}
