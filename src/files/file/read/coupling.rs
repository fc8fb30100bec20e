//! Couplings of joints from their entries.

use crate::closure::coupling::{coupling_coefficient, in_plane};
use crate::file::prelude::*;
use crate::file::read::resolve::contains_rates;
use crate::file::unknown_word;
use crate::geom::exact::ExactField;
use crate::model::joint_type::CoupledFreedom;

/// Reads the couplings, and removes from coupled joints the options that cannot be coupled in the same way.
pub(crate) fn read_couplings(file: &MechanismFile, mechanism: &mut Parts, out: &Findings) {
    for (at, entry) in out.key("coupling").each_entry(&file.coupling) {
        let joints = at.key("joints");
        let ends = joints.each_entry(&entry.joints);
        let ends = ends
            .filter_map(|(at, word)| read_end(mechanism, word, &at))
            .collect_vec();
        let before = out.problem_count();
        let ratio = at.key("ratio").read_coordinate(&entry.ratio);
        if out.problem_count() == before && ratio.to_f64() == 0.0 {
            at.key("ratio").add_problem("the ratio of a coupling is zero, which would lock the second joint; give another ratio, or make that joint fixed");
        }
        let &[a, b] = ends.as_slice() else { continue };
        let [first, second] = [a, b].map(|e| &mechanism.joints[e.joint].id);
        let twice = |c: &Coupling| c.ends == [a, b] || c.ends == [b, a];
        let [i, j] = [a, b].map(|e| &mechanism.joints[e.joint]);
        if a.joint == b.joint {
            joints.add_problem(format!(
                "joint \"{first}\" is coupled with itself; name two joints (for a rotation and a translation that are coupled use a helical joint)"
            ));
        } else if i.states != j.states {
            joints.add_problem(format!(
                "joints \"{first}\" and \"{second}\" are coupled but are not present in the same states; give both the same state"
            ));
        } else if mechanism.couplings.iter().any(twice) {
            joints.add_problem(format!(
                "joints \"{first}\" and \"{second}\" are coupled twice; keep one of the couplings"
            ));
        } else {
            let (ends, gear) = ([a, b], entry.gear);
            let coupling = Coupling { ends, ratio, gear };
            if ExactField::for_expressions([&coupling_coefficient(mechanism, &coupling)], 0)
                .is_err()
            {
                at.add_problem(format!(
                    "the ratio of the axes' lengths of joints \"{first}\" and \"{second}\" has no exact value; give both an axis of length 1"
                ));
            } else {
                mechanism.couplings.push(coupling);
            }
        }
    }
    check_options(file, mechanism, out);
}

/// Returns a freedom by the name of its joint, or joint:freedom.
fn read_end(mechanism: &Parts, word: &str, at: &Place<'_>) -> Option<CoupledFreedom> {
    let whole = mechanism.joint_named(word).map(|j| (j, None));
    let parts = || {
        let (id, freedom) = word.rsplit_once(':')?;
        Some((mechanism.joint_named(id)?, Some(freedom)))
    };
    let Some((joint, freedom)) = whole.or_else(parts) else {
        at.unknown_joint(mechanism, word);
        return None;
    };
    let found = freedom_of(mechanism, joint, freedom);
    found.map_err(|problem| at.add_problem(problem)).ok()
}

/// Returns the freedom that a word names, or the only one of its joint.
fn freedom_of(m: &Parts, j: JointId, word: Option<&str>) -> Result<CoupledFreedom, ProblemKind> {
    let named = &m.joints[j];
    let (id, t) = (&named.id, &named.joint_type);
    let coupled = t.freedoms().iter().copied();
    let coupled = coupled.filter(|&f| is_definite(t, f) && in_plane(m, j, f));
    let coupled: Vec<Freedom> = coupled.collect();
    let known = || coupled.iter().map(|f| format!("{id}:{}", f.name()));
    let freedom = match (word, t.freedoms(), coupled.as_slice()) {
        (_, _, []) => {
            return Err(format!(
                "joint \"{id}\" of type {} has no freedom that can be coupled; couple translations and rotations about one axis (a spherical joint has no single axis)",
                t.name()
            )
            .into());
        }
        (None, [only], _) => *only,
        (None, ..) => {
            return Err(format!(
                "joint \"{id}\" has several freedoms; name the coupled one: {}",
                known().join(", ")
            )
            .into());
        }
        (Some(word), ..) => match coupled.iter().find(|f| f.name() == word) {
            Some(f) => *f,
            None => {
                let word = format!("{id}:{word}");
                return Err(unknown_word("freedom to couple", &word, known()));
            }
        },
    };
    Ok(CoupledFreedom { joint: j, freedom })
}

/// Returns true if a freedom has a coordinate. A spherical joint's rotation about one of its axes has none, because the three
/// rotations do not commute.
fn is_definite(t: &JointType, freedom: Freedom) -> bool {
    let turns = [Freedom::Rx, Freedom::Ry, Freedom::Rz];
    !turns.contains(&freedom) || !turns.iter().all(|f| t.freedoms().contains(f))
}

/// Removes options that lack the coupled freedom, or have it about another axis. In a joint's own list that is a problem.
fn check_options(file: &MechanismFile, mechanism: &mut Parts, out: &Findings) {
    for j in mechanism.joint_ids() {
        let coupled = coupled_freedoms(mechanism, j);
        if coupled.is_empty() {
            continue;
        }
        let joint = &mut mechanism.joints[j];
        let present = joint.options[0].clone();
        let at = out.key("joint").entry_at(j.index()).key("options");
        joint.options.retain(|o| {
            let keeps = keeps_coupled(o, &present, &coupled);
            if !keeps && file.joint[j].options.is_some() {
                at.add_problem(format!(
                    "option \"{}\" of joint \"{}\" does not keep the coupled freedom about the same axis; remove it",
                    o.name, joint.id
                ));
            }
            keeps
        });
    }
}

/// Returns the freedoms of a joint that are coupled.
#[must_use]
pub fn coupled_freedoms(mechanism: &Parts, j: JointId) -> Vec<Freedom> {
    let couplings = mechanism.couplings.iter();
    let own = couplings.filter_map(|c| c.end_at(j).map(|e| c.ends[e].freedom));
    own.unique().collect()
}

/// Returns true if an option allows every motion of the original joint with the same rates of the coupled freedoms, or if none is
/// coupled.
#[must_use]
pub fn keeps_coupled(option: &JointOption, present: &JointOption, coupled: &[Freedom]) -> bool {
    if coupled.is_empty() {
        return true;
    }
    let has = |f: &Freedom| {
        option.joint_type.freedoms().contains(f) && is_definite(&option.joint_type, *f)
    };
    coupled.iter().all(has) && contains_rates(option, present, coupled).unwrap_or(false)
}
