//! Names and units shared by the statics reports.

use crate::statics::assur::Decomposition;
use crate::statics::contour_group::{GroupPose, GroupReactions};
use crate::statics::cycle::{GroupSolutions, Statics};
use crate::statics::planar::{BodyId, PairId, PlanarMechanism};
use itertools::Itertools;

/// A method for the four-link group with a closed contour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GroupMethod {
    /// The δ-point method.
    Delta,
    /// Its projective form.
    Projective,
    /// The equilibrium equations.
    Equilibrium,
}

impl GroupMethod {
    /// All three, in the order of the documentation.
    pub const ALL: [GroupMethod; 3] = [
        GroupMethod::Delta,
        GroupMethod::Projective,
        GroupMethod::Equilibrium,
    ];

    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            GroupMethod::Delta => "delta",
            GroupMethod::Projective => "projective",
            GroupMethod::Equilibrium => "equilibrium",
        }
    }

    /// Its solution of a group.
    #[must_use]
    pub fn of(self, g: &GroupSolutions) -> Option<GroupReactions> {
        match self {
            GroupMethod::Delta => Some(g.delta),
            GroupMethod::Projective => Some(g.projective),
            GroupMethod::Equilibrium => g.equilibrium.map(|(r, _)| r),
        }
    }
}

/// Greatest difference of any two methods' forces, over the greatest force; `None` with fewer than two.
#[must_use]
pub fn disagreement(g: &GroupSolutions, methods: &[GroupMethod]) -> Option<f64> {
    let found = methods.iter().filter_map(|m| m.of(g)).collect_vec();
    let pairs = found.iter().tuple_combinations();
    pairs
        .map(|(a, b)| a.distance(b, &g.pose))
        .max_by(f64::total_cmp)
}

/// Names of bodies: "4, 6, 7, 10".
#[must_use]
pub fn bodies(m: &PlanarMechanism, list: &[BodyId]) -> String {
    list.iter().map(|&b| m.bodies[b].name.as_str()).join(", ")
}

/// Names of pairs: "3-4, 4-6".
#[must_use]
pub fn pairs(m: &PlanarMechanism, list: &[PairId]) -> String {
    list.iter().map(|&p| m.pairs[p].name.as_str()).join(", ")
}

/// A short name of a group: "4-6-7-10".
#[must_use]
pub fn group(m: &PlanarMechanism, d: &Decomposition, index: usize) -> String {
    let names = d.groups[index].bodies.iter();
    names.map(|&b| m.bodies[b].name.replace(' ', "-")).join("-")
}

/// Position of the first drive for people: degrees, or the file's length unit.
#[must_use]
pub fn drive_position(s: &Statics, value: f64) -> f64 {
    if s.drive_slides() {
        value / s.linkage.mechanism.metres
    } else {
        value.to_degrees()
    }
}

/// Degrees, or the file's length unit.
#[must_use]
pub fn drive_unit(s: &Statics) -> &'static str {
    if s.drive_slides() {
        s.linkage.mechanism.unit
    } else {
        "deg"
    }
}

/// Thousands of newtons and the like: the factor to divide by and the prefix, for values up to `greatest`.
#[must_use]
pub fn prefix(greatest: f64) -> (f64, &'static str) {
    match greatest {
        x if x >= 1e7 => (1e6, "M"),
        x if x >= 1e4 => (1e3, "k"),
        _ => (1.0, ""),
    }
}

/// The six reactions of a group by name, as magnitudes, the guide's with its sign.
#[must_use]
pub fn magnitudes(r: &GroupReactions, pose: &GroupPose) -> [(&'static str, f64); 6] {
    let [d, f, k, m, l, _] = r.forces(pose).map(|v| v[0].hypot(v[1]));
    [
        ("D", d),
        ("F", f),
        ("K", k),
        ("M", m),
        ("L", l),
        ("guide", r.guide),
    ]
}
