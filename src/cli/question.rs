//! The question a search answers, from its arguments.

use super::args::{Asked, POOL, Question};
use super::output;
use crate::model::measured::{Measured, looks_measured};
use crate::model::mechanism::{JointId, Mechanism, StateId};
use crate::rank::measured::Verdicts;
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::rank::snap::snap;
use crate::redundancy::analysis::exact_field;
use crate::search::request::{Request, Symmetry};
use crate::view::next::word;
use anyhow::{bail, ensure};

/// Why a geometry looks measured, with the verdicts on it; `None` where it looks exact.
type Looks = Option<(Measured, Vec<Verdicts>)>;

/// Makes a mechanism ready, snapped and with the options that are allowed.
pub(super) fn ready(mechanism: &mut Mechanism, a: &Question) -> anyhow::Result<()> {
    if let Some(tolerance) = a.snap {
        ensure!(
            tolerance > 0.0 && tolerance < 1.0,
            "--snap must be between 0 and 1"
        );
        let snapped = snap(mechanism, tolerance);
        for moved in &snapped.moved {
            output::note(&format!("snapped: {moved}\n"));
        }
        *mechanism = snapped.mechanism;
    }
    restrict(mechanism, a)
}

/// What is asked of a mechanism that is ready, and why its geometry looks measured, where it does. `named` is the state
/// that --max-external is about.
pub(super) fn ask(
    mechanism: &Mechanism,
    a: &Question,
    named: Option<&str>,
) -> anyhow::Result<(Request, Looks)> {
    let state = state(mechanism, a, named)?;
    let measured = measured(mechanism, state.map(|(s, _)| s), a.as_written)?;
    let tolerance = measured
        .as_ref()
        .map_or(DEFAULT_TOLERANCE, |(m, _)| m.tolerance());
    let request = Request {
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
        tolerance,
    };
    Ok((request, measured))
}

/// The state that takes part, the named one or the first besides free, with the external redundancy allowed there.
pub(super) fn state(
    mechanism: &Mechanism,
    a: &Question,
    named: Option<&str>,
) -> anyhow::Result<Option<(StateId, u32)>> {
    Ok(match (named, a.max_external) {
        (None, None) => None,
        (None, Some(external)) => {
            ensure!(
                mechanism.states.len() > 1,
                "{} has no state besides free",
                mechanism.name
            );
            Some((StateId::new(1), external))
        }
        (Some(name), external) => {
            let Some(s) = mechanism.state(name) else {
                bail!(
                    "{} has no state {name}; it has: {}",
                    mechanism.name,
                    mechanism.states.join(", ")
                );
            };
            (s != StateId::FREE).then_some((s, external.unwrap_or(u32::MAX)))
        }
    })
}

/// Whether the geometry looks measured, and if so what exact and tolerant ranks say of the mechanism as it is. Where
/// they differ the search is refused, unless the file is to be taken as written.
fn measured(
    mechanism: &Mechanism,
    state: Option<StateId>,
    as_written: bool,
) -> anyhow::Result<Looks> {
    let Some(why) = looks_measured(mechanism) else {
        return Ok(None);
    };
    let fields = [exact_field(mechanism, 0)?, exact_field(mechanism, 1)?];
    let states = std::iter::once(StateId::FREE).chain(state);
    let verdicts = states
        .map(|s| Verdicts::new(&fields, mechanism, s, why.tolerance()))
        .collect::<Result<Vec<_>, _>>()?;
    let name = &mechanism.name;
    let cure = "round the coordinates, write expressions such as sqrt(3)/2, or snap them with --snap TOLERANCE";
    let Some(v) = verdicts.iter().find(|v| !v.agree()) else {
        eprintln!(
            "warning: the coordinates of {name} look measured ({why}). Exact and tolerant ranks agree on it as it is, \
             but the search takes every digit at its word; {cure}"
        );
        return Ok(Some((why, verdicts)));
    };
    let (exact, near) = (v.figures(v.exact), v.figures(v.numeric.rank));
    let differ = format!(
        "the coordinates of {name} look measured ({why}), and that matters: as written, state {} has W = {}, σ = {}; \
         to within {:.0e} it has W = {}, σ = {} (smallest singular value kept {:.1e}, largest dropped {:.1e}). \
         Exact ranks take rounding errors for real misalignments",
        v.state,
        exact.0,
        exact.1,
        why.tolerance(),
        near.0,
        near.1,
        v.numeric.kept,
        v.numeric.dropped
    );
    ensure!(
        as_written,
        "{differ}; {cure}, or search the file --as-written"
    );
    eprintln!("warning: {differ}; {cure}");
    Ok(Some((why, verdicts)))
}

/// Applies --hold, --options, --allow and --forbid.
fn restrict(mechanism: &mut Mechanism, a: &Question) -> anyhow::Result<()> {
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
    for (id, joint) in mechanism.joint_ids().zip(&mut mechanism.joints) {
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

/// The flags that make a search's list what it is, as they are typed: those of `draw` and `export` are the same.
pub(super) fn flags(mechanism: &Mechanism, s: &Asked) -> String {
    let a = &s.question;
    let mut out: Vec<String> = Vec::new();
    let mut put = |flag: &str, value: Option<String>| {
        out.push(format!("--{flag}"));
        out.extend(value.map(|v| word(&v)));
    };
    let number = |n: u32| Some(n.to_string());
    if a.max_redundant > 0 {
        put("max-redundant", number(a.max_redundant));
    }
    if let Ok(Some((state, external))) = state(mechanism, a, s.state.as_deref()) {
        put("max-external", number(external));
        if s.state.is_some() {
            put("state", Some(mechanism.states[state].clone()));
        }
    }
    if let Some(w) = a.max_mobility {
        put("max-mobility", Some(w.to_string()));
    }
    if let Some(c) = a.max_changes {
        put("max-changes", number(c));
    }
    if !a.rank.is_empty() {
        put("rank", Some(a.rank.join(",")));
    }
    if a.pool != POOL {
        put("pool", Some(a.pool.to_string()));
    }
    for id in &a.hold {
        put("hold", Some(id.clone()));
    }
    if !a.options.is_empty() {
        put("options", Some(a.options.join(",")));
    }
    for (flag, rules) in [("allow", &a.allow), ("forbid", &a.forbid)] {
        for rule in rules {
            put(flag, Some(rule.clone()));
        }
    }
    for (flag, on) in [
        ("allow-output-change", a.allow_output_change),
        ("symmetric", a.symmetric),
        ("one-per-orbit", a.one_per_orbit),
        ("as-written", a.as_written),
    ] {
        if on {
            put(flag, None);
        }
    }
    if let Some(t) = a.snap {
        put("snap", Some(t.to_string()));
    }
    out.join(" ")
}
