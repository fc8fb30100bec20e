//! What idle motions and faults of the drives are, in words.

use crate::redundancy::local_mobility::Idle;
use crate::redundancy::motion::DriveFault;
use crate::view::prelude::*;

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
