//! Numbers, tables and wrenches in words.

use crate::closure::matrix::Closure;
use crate::geom::scalars::Reals;
use crate::model::mechanism::{Mechanism, Mode, StateId};
use crate::redundancy::idle::Idle;
use crate::redundancy::stress::JointWrench;
use itertools::Itertools;

/// Which components a wrench has: "moments about x and y, force along z".
#[must_use]
pub fn wrench(w: &JointWrench) -> String {
    let axes = |flags: [bool; 3]| {
        ["x", "y", "z"]
            .into_iter()
            .zip(flags)
            .filter(|(_, f)| *f)
            .map(|(a, _)| a)
            .collect_vec()
    };
    let part = |one: &str, many: &str, flags: [bool; 3]| {
        let names = axes(flags);
        match names.as_slice() {
            [] => None,
            [a] => Some(format!("{one} {a}")),
            [head @ .., last] => Some(format!("{many} {} and {last}", head.join(", "))),
        }
    };
    part("moment about", "moments about", w.moments)
        .into_iter()
        .chain(part("force along", "forces along", w.forces))
        .join(", ")
}

/// Idle motions in words, those that read alike told once.
#[must_use]
pub fn idle_list(mechanism: &Mechanism, motions: &[Idle]) -> Vec<String> {
    let alike = motions
        .iter()
        .map(|m| idle(mechanism, m))
        .dedup_with_count();
    alike
        .map(|(n, text)| {
            if n == 1 {
                text
            } else {
                format!("{text}, in {n} independent ways")
            }
        })
        .collect()
}

/// What an idle motion is: "link 5 spins about the line through 4-5 and 5-1".
#[must_use]
pub fn idle(mechanism: &Mechanism, motion: &Idle) -> String {
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
    match (motion.links.len(), joints.as_slice()) {
        (1, []) if motion.turns => {
            format!("link {names} turns about a line through none of its joints")
        }
        (1, []) => format!("link {names} slides"),
        (1, [one]) => format!("link {names} spins about a line through {one}"),
        (1, many) => format!(
            "link {names} spins about the line through {}",
            many.join(" and ")
        ),
        _ => format!("links {names} move together"),
    }
}

/// The numbers of a structure that need no rank.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// n.
    pub links: i64,
    /// p.
    pub joints: i64,
    /// k.
    pub contours: i64,
    /// f, in the plane those of the plane.
    pub freedoms: i64,
    /// 6k, or 3k in the plane, and one for each coupling.
    pub rows: i64,
}

impl Shape {
    /// The numbers of a state.
    #[must_use]
    pub fn of(mechanism: &Mechanism, state: StateId) -> Shape {
        let mut links: Vec<_> = mechanism
            .joints_in(state)
            .flat_map(|j| mechanism.joints[j].links)
            .collect();
        links.sort_unstable();
        links.dedup();
        let int = |x: usize| i64::try_from(x).unwrap_or(i64::MAX);
        let (links, joints) = (int(links.len()), int(mechanism.joints_in(state).count()));
        let contours = joints + 1 - links;
        let dim = if matches!(mechanism.mode, Mode::Planar { .. }) {
            3
        } else {
            6
        };
        let freedoms = match Closure::new(&Reals, mechanism, state) {
            Ok(closure) => int(closure.columns.len()),
            Err(_) => 0,
        };
        Shape {
            links,
            joints,
            contours,
            freedoms,
            rows: dim * contours + int(mechanism.couplings_in(state).count()),
        }
    }
}
