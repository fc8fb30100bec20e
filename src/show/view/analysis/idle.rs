//! What idle motions are, in words.

use crate::model::mechanism::Mechanism;
use crate::redundancy::local_mobility::Idle;
use itertools::Itertools;

/// "link 5 spins about the line through 4-5 and 5-1".
#[must_use]
pub(crate) fn words(mechanism: &Mechanism, motion: &Idle) -> String {
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
    let along = motion
        .direction
        .map_or_else(String::new, |d| format!(" along {}", d.words(mechanism)));
    match (motion.links.len(), joints.as_slice()) {
        (1, []) if motion.turns => {
            format!("link {names} turns about a line{along}, through none of its joints")
        }
        (1, []) => format!("link {names} slides{along}"),
        (1, [one]) => format!("link {names} spins about a line{along} through {one}"),
        (1, many) => format!(
            "link {names} spins about the line through {}",
            many.join(" and ")
        ),
        _ => format!("links {names} move together"),
    }
}

/// Neighbours that read alike told once, with how often.
#[must_use]
pub(crate) fn told_once(motions: impl Iterator<Item = String>) -> Vec<String> {
    let alike = motions.dedup_with_count();
    alike
        .map(|(n, text)| match n {
            1 => text,
            n => format!("{text}, in {n} independent ways"),
        })
        .collect()
}
