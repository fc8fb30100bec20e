//! The motions of links and the wrenches of joints, in words and as data.

use crate::geom::vector::{Vector, add, cross, dot, length, scale, to_vector, unit};
use crate::redundancy::link_motion::LinkMotion;
use crate::redundancy::local_mobility::Idle;
use crate::redundancy::motion::DriveFault;
use crate::redundancy::stress_loads::Borne;
use crate::view::prelude::*;

/// A component of a direction, or a part of a length, below this is rounding.
const ROUNDING: f64 = 1e-6;

/// Returns the motion of a link relative to another one as data; the twists (ω; v) are about the origin, in the file's unit of length.
pub(super) fn motion_json(m: &Mechanism, of: &LinkMotion) -> Value {
    json!({
        "link": m.links[of.link].id,
        "relative_to": m.links[of.relative_to].id,
        "dimension": of.dimension(),
        "text": describe_motion(m, of),
        "twists": of.motion_twists().into_iter().map(|t| t.map(round_noise)).collect::<Vec<_>>(),
    })
}

/// Returns the line about it: "p relative to 0 (in this pose): three translations".
pub(super) fn motion_line(m: &Mechanism, of: &LinkMotion) -> String {
    let [link, to] = [of.link, of.relative_to].map(|l| &m.links[l].id);
    format!(
        "{link} relative to {to} (in this pose): {}",
        describe_motion(m, of)
    )
}

/// Returns a motion in words: "three translations and rotation about z".
fn describe_motion(mechanism: &Mechanism, of: &LinkMotion) -> String {
    if of.dimension() == 6 {
        return "every motion".to_owned();
    }
    let slides = match of.slides[..] {
        [] => None,
        [s] => Some(format!("translation along {}", format_direction(s))),
        [a, b] => Some(format!(
            "two translations, square to {}",
            format_direction(cross(a, b))
        )),
        _ => Some("three translations".to_owned()),
    };
    let parts: Vec<String> = slides
        .into_iter()
        .chain(describe_turns(mechanism, of))
        .collect();
    match parts.len() {
        0 => "none, it rests".to_owned(),
        _ => parts.join(" and "),
    }
}

/// Returns the rotations and screw motions in words.
fn describe_turns(mechanism: &Mechanism, of: &LinkMotion) -> Option<String> {
    let unit = mechanism.length_unit.symbol;
    let at = |p: Vector| format!("through {} {unit}", format_point(p));
    Some(match (&of.turns[..], of.meet) {
        ([], _) => return None,
        ([t], _) => {
            let along = format_direction(t.axis);
            // Translations across the axis move it anywhere.
            let somewhere = of.slides.len() >= 2;
            let place = if somewhere {
                String::new()
            } else {
                format!(" {}", at(t.point))
            };
            if t.lead == 0.0 {
                format!("rotation about {along}{place}")
            } else {
                format!(
                    "screw motion along {along}{place}, lead {} {unit}",
                    format_number(t.lead)
                )
            }
        }
        ([a, b], Some(p)) => {
            let across = format_direction(cross(a.axis, b.axis));
            format!("two rotations with axes {}, square to {across}", at(p))
        }
        (_, Some(p)) => format!("three rotations, all axes {}", at(p)),
        ([a, b], None) => {
            let across = format_direction(cross(a.axis, b.axis));
            format!("two rotations with axes square to {across}")
        }
        _ => "three rotations".to_owned(),
    })
}

/// Returns the wrench of a joint in words, as motions are named: "moment about x", "force along z through (0, 1, 0) m", or "wrench along
/// z, pitch 2 m". A line without a place goes through the joint's point. The moment is in units of force times `size`, a length in the
/// file's unit.
pub(super) fn describe_wrench(m: &Mechanism, joint: JointId, borne: &Borne, size: f64) -> String {
    let Borne { force, moment } = *borne;
    if length(force) < ROUNDING * length(moment) {
        return format!("moment about {}", format_direction(unit(moment)));
    }
    let axis = unit(force);
    let arm = scale(moment, size / length(force));
    let (off, pitch) = (cross(axis, arm), dot(axis, arm));
    let unit = m.length_unit.symbol;
    let place = if length(off) < ROUNDING * size {
        String::new()
    } else {
        let point = add(to_vector(&m.joints[joint].frame.point), off);
        format!(" through {} {unit}", format_point(point))
    };
    let along = format_direction(axis);
    if pitch.abs() < ROUNDING * size {
        format!("force along {along}{place}")
    } else {
        format!(
            "wrench along {along}{place}, pitch {} {unit}",
            format_number(pitch)
        )
    }
}

/// Returns a number without its rounding.
fn round_noise(x: f64) -> f64 {
    let near = x.round();
    if (x - near).abs() < ROUNDING {
        near + 0.0
    } else {
        x
    }
}

/// Returns a number to four decimals, without zeros at its end.
fn format_number(x: f64) -> String {
    ((x * 1e4).round() / 1e4 + 0.0).to_string()
}

/// Returns a direction, either way along it: "z", "(0.6, 0.8, 0)".
fn format_direction(d: Vector) -> String {
    let d = d.map(round_noise);
    let first = d.iter().find(|x| **x != 0.0).copied().unwrap_or(1.0);
    let d = d.map(|x| round_noise(x * first.signum()));
    match d {
        [1.0, 0.0, 0.0] => "x".to_owned(),
        [0.0, 1.0, 0.0] => "y".to_owned(),
        [0.0, 0.0, 1.0] => "z".to_owned(),
        _ => format_point(d),
    }
}

/// Returns three numbers in brackets.
fn format_point(p: Vector) -> String {
    let [x, y, z] = p.map(format_number);
    format!("({x}, {y}, {z})")
}

/// Returns an idle motion in words: "link 5 spins about the line through 4-5 and 5-1".
pub(crate) fn describe_idle(mechanism: &Mechanism, motion: &Idle) -> String {
    let names = motion
        .links
        .iter()
        .map(|&l| mechanism.links[l].id.as_str())
        .join(", ");
    let joints = motion
        .through
        .iter()
        .map(|&j| mechanism.joints[j].id.as_str())
        .collect_vec();
    let along = motion.direction.map_or_else(String::new, |d| {
        format!(" along {}", d.describe_direction(mechanism))
    });
    if !motion.as_one {
        let moving = motion.moving.iter();
        let moving = moving.map(|&j| mechanism.joints[j].id.as_str()).join(", ");
        return format!("links {names} move together, in joints {moving}");
    }
    let (what, s) = match motion.links.len() {
        1 => (format!("link {names}"), "s"),
        _ => (format!("links {names} as one body"), ""),
    };
    match joints.as_slice() {
        [] if motion.turns => {
            format!("{what} turn{s} about a line{along}, through none of its joints")
        }
        [] => format!("{what} slide{s}{along}"),
        [one] => format!("{what} spin{s} about a line{along} through {one}"),
        many => format!(
            "{what} spin{s} about the line through {}",
            many.join(" and ")
        ),
    }
}

/// Merges neighbours with the same text, with their number.
pub(crate) fn told_once(motions: impl Iterator<Item = String>) -> Vec<String> {
    let alike = motions.dedup_with_count();
    alike
        .map(|(n, text)| match n {
            1 => text,
            n => format!("{text}, in {n} independent ways"),
        })
        .collect()
}

/// Returns a fault of the drives: `immobile`, `surplus`, `dependent`, `locked` or `dead-point`, the joint of a locked drive, and all that
/// in words.
pub fn drive_fault<'a>(
    mechanism: &'a Mechanism,
    fault: &DriveFault,
) -> (&'static str, Option<&'a str>, String) {
    match *fault {
        DriveFault::Immobile => {
            let text = "the mechanism is driven and cannot move".to_owned();
            ("immobile", None, text)
        }
        DriveFault::Surplus { drives, mobility } => {
            let freedom = plural_of(&mobility.to_string(), "degree");
            let text = format!(
                "{} for {freedom} of freedom: more drives than degrees of freedom work against each other",
                count_noun(drives, "drive")
            );
            ("surplus", None, text)
        }
        DriveFault::Dependent {
            drives,
            independent,
        } => {
            let text = format!(
                "{drives} drives move and {independent} of their speeds can be chosen in this pose: the drives work against each other"
            );
            ("dependent", None, text)
        }
        DriveFault::Locked(joint) => {
            let id = mechanism.joints[joint].id.as_str();
            let text = format!("drive {id} is locked: it cannot move in this pose");
            ("locked", Some(id), text)
        }
        DriveFault::DeadPoint => {
            let text =
                "dead point: the outputs stand still to first order while a drive moves".to_owned();
            ("dead-point", None, text)
        }
    }
}
