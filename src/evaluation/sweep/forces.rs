//! The greatest force of a joint over the stroke, in the free state as built.

use crate::format::number;
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::cycle::Statics;
use crate::statics::reactions::{Cycle, Uniqueness};
use crate::statics::solve::{Model, SolvedReactions, StaticsError, solve};
use crate::sweep::known_or_why::Known;
use serde::{Deserialize, Serialize};

/// The greatest force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Forces {
    /// Its size `[N]`.
    pub peak_force: f64,
    /// The joint.
    pub joint: String,
    /// Position of the first drive since the pose of the file, `[rad]` or the file's unit of length.
    pub drive_position: f64,
    /// The positions that were solved.
    pub positions: usize,
    /// Whether every position of the file's stroke was reached and solved.
    pub complete: bool,
    /// Whether the reactions are the only ones; those of minimum norm otherwise, for redundant constraints leave them open.
    pub unique: bool,
}

/// Whether something loads a mechanism in its free state: forces, or masses that have weight or are moved.
#[must_use]
pub fn is_loaded(m: &Mechanism) -> bool {
    let masses = m.links.iter().any(|l| l.mass.is_some());
    let moved = m.loads.drive_speeds.iter().any(|s| *s != 0.0);
    m.loads.acts_from_outside(StateId::FREE) || (masses && (m.loads.gravity.is_some() || moved))
}

/// A figure rounded to what it is worth, so that a table does not depend on the last bits.
pub(super) fn rounded(x: f64) -> f64 {
    number::rounded(x, 6)
}

/// The greatest joint force under the file's loads; nothing where nothing loads it.
pub(super) fn forces(m: &Mechanism) -> Option<Known<Forces>> {
    is_loaded(m).then(|| Known::of(found(m)))
}

fn found(m: &Mechanism) -> Result<Forces, StaticsError> {
    let answer = solve(m, StateId::FREE, m.loads.stroke, Model::Either)?;
    let complete = answer.complete();
    let (peak, positions, unique) = match &answer {
        SolvedReactions::Planar(found) => in_plane(m, found),
        SolvedReactions::Spatial(found) => in_space(m, found),
    };
    let (force, joint, at) = peak.unwrap_or_default();
    Ok(Forces {
        peak_force: rounded(force),
        joint,
        drive_position: rounded(at),
        positions,
        complete,
        unique,
    })
}

/// Force, joint, position of the drive.
type Peak = (f64, String, f64);

/// The greatest of some forces; the first where several are as great, to eleven digits.
fn greatest<'a>(all: impl Iterator<Item = (f64, &'a str, f64)>) -> Option<Peak> {
    let mut out: Option<Peak> = None;
    for (force, joint, at) in all {
        if out.as_ref().is_none_or(|o| force > o.0 * (1.0 + 1e-11)) {
            out = Some((force, joint.to_owned(), at));
        }
    }
    out
}

fn in_plane(m: &Mechanism, found: &Statics) -> (Option<Peak>, usize, bool) {
    let pairs = &found.linkage.mechanism.pairs;
    let solved = || {
        found
            .moments
            .iter()
            .filter_map(|x| Some((x, x.whole.as_ref()?)))
    };
    let unit = if found.drive_slides() {
        found.linkage.mechanism.metres
    } else {
        1.0
    };
    let forces = solved().flat_map(|(moment, whole)| {
        let each = whole.reactions.iter();
        each.map(move |r| {
            let joint = m.joints[pairs[r.pair].joint].id.as_str();
            let [x, y] = r.force;
            (x.hypot(y), joint, moment.instant.drive / unit)
        })
    });
    (greatest(forces), solved().count(), true)
}

fn in_space(m: &Mechanism, found: &Cycle) -> (Option<Peak>, usize, bool) {
    let solved = || {
        found
            .positions
            .iter()
            .filter_map(|(at, s)| Some((*at, s.as_ref().ok()?)))
    };
    let forces = solved().flat_map(|(at, solution)| {
        let each = solution.reactions.iter();
        each.map(move |r| (r.force_size(), m.joints[r.joint].id.as_str(), at))
    });
    let unique = solved().all(|(_, s)| s.choice == Uniqueness::Unique);
    (greatest(forces), solved().count(), unique)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::text::mechanism_from_str;
    use crate::statics::reactions::Solution;

    fn solution(choice: Uniqueness) -> Solution {
        Solution {
            reactions: Vec::new(),
            couplings: Vec::new(),
            choice,
            self_stresses: Vec::new(),
            coupling_stresses: Vec::new(),
            couplings_open: Vec::new(),
            open: Vec::new(),
            elastic: None,
            elastic_couplings: None,
            contacts: Vec::new(),
            undriven: 0,
            condition: 1.0,
            residual: 0.0,
            size: 1.0,
        }
    }

    /// Forces over a stroke are the only ones where they are at every position.
    #[test]
    fn one_position_that_is_open_leaves_the_stroke_open() {
        use Uniqueness::{MinimumNorm, Unique};
        let text = "name = \"it\"\n[[link]]\nid = \"0\"\nrole = \"frame\"\n[[link]]\nid = \"1\"\n[[joint]]\nid = \"a\"\n\
                    links = [\"0\", \"1\"]\ntype = \"revolute\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]\n";
        let m = mechanism_from_str("it.toml", text).unwrap();
        for (choices, unique) in [
            ([Unique, Unique], true),
            ([Unique, MinimumNorm], false),
            ([MinimumNorm, Unique], false),
            ([MinimumNorm, MinimumNorm], false),
        ] {
            let found = Cycle {
                drives: Vec::new(),
                positions: choices.map(|c| (0.0, Ok(solution(c)))).to_vec(),
                stopped: None,
            };
            let (_, solved, only) = in_space(&m, &found);
            assert_eq!((solved, only), (2, unique), "{choices:?}");
        }
    }
}
