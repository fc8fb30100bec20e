//! The question a search answers, from its arguments.

use super::args::Search as SearchArgs;
use crate::model::mechanism::{JointId, Mechanism};
use crate::search::request::{Request, Symmetry};
use anyhow::{bail, ensure};

pub(super) fn request(mechanism: &Mechanism, a: &SearchArgs) -> anyhow::Result<Request> {
    let state = match (&a.state, a.max_external) {
        (None, None) => None,
        (None, Some(external)) => {
            ensure!(
                mechanism.states.len() > 1,
                "{} has no state besides free",
                mechanism.name
            );
            Some((1, external))
        }
        (Some(name), external) => {
            let Some(s) = mechanism.states.iter().position(|s| s == name) else {
                bail!(
                    "{} has no state {name}; it has: {}",
                    mechanism.name,
                    mechanism.states.join(", ")
                );
            };
            (s > 0).then_some((s, external.unwrap_or(u32::MAX)))
        }
    };
    Ok(Request {
        max_redundant: a.max_redundant,
        state,
        max_mobility: a.max_mobility,
        max_changes: a.max_changes,
        keep_output: !a.allow_output_change,
        symmetry: match (a.symmetric, a.one_per_orbit) {
            (true, _) => Symmetry::SymmetricOnly,
            (_, true) => Symmetry::OnePerOrbit,
            _ => Symmetry::All,
        },
        nodes: a.nodes.clamp(1, u32::MAX as usize / 2),
    })
}

/// Applies --hold, --options, --allow and --forbid.
pub(super) fn restrict(mechanism: &mut Mechanism, a: &SearchArgs) -> anyhow::Result<()> {
    for id in &a.hold {
        let Some(link) = mechanism.link(id) else {
            bail!("--hold: {} has no link {id}", mechanism.name)
        };
        mechanism.search.hold.push(link);
    }
    let known: Vec<String> = mechanism
        .joints
        .iter()
        .flat_map(|j| &j.options)
        .map(|o| o.name.clone())
        .collect();
    let check = |names: &[String], flag: &str| {
        for n in names {
            if !known.contains(n) {
                let mut all = known.clone();
                all.sort();
                all.dedup();
                bail!(
                    "{flag}: no joint of {} has an option named {n}; there are: {}",
                    mechanism.name,
                    all.join(", ")
                );
            }
        }
        Ok(())
    };
    check(&a.options, "--options")?;
    let mut rules: Vec<(JointId, Option<Vec<String>>, bool)> = Vec::new();
    for (list, allow) in [(&a.allow, true), (&a.forbid, false)] {
        let flag = if allow { "--allow" } else { "--forbid" };
        for rule in list {
            let (joint, names) = match rule.split_once('=') {
                Some((j, n)) => (j, Some(n.split(',').map(str::to_owned).collect::<Vec<_>>())),
                None => (rule.as_str(), None),
            };
            let Some(id) = mechanism.joint(joint) else {
                bail!("{flag}: {} has no joint {joint}", mechanism.name)
            };
            ensure!(
                !(allow && names.is_none()),
                "--allow needs names of options: --allow {joint}=revolute,spherical"
            );
            check(names.as_deref().unwrap_or(&[]), flag)?;
            rules.push((id, names, allow));
        }
    }
    for (id, joint) in mechanism.joints.iter_mut().enumerate() {
        let mut place = 0;
        joint.options.retain(|o| {
            place += 1;
            // The present joint stays.
            place == 1
                || (a.options.is_empty() || a.options.contains(&o.name))
                    && rules
                        .iter()
                        .filter(|(j, ..)| *j == id)
                        .all(|(_, names, allow)| {
                            names
                                .as_ref()
                                .is_some_and(|n| n.contains(&o.name) == *allow)
                        })
        });
    }
    Ok(())
}
