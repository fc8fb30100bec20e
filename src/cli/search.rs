//! `ozols search`.

use super::args::{Args, Search as SearchArgs, SearchFormat, SearchMethod};
use super::{Done, load, output, progress};
use crate::model::mechanism::{JointId, Mechanism};
use crate::redundancy::analysis::exact_field;
use crate::report::search_json::{self, Found};
use crate::report::search_text;
use crate::report::words::cost;
use crate::search::best::Variant;
use crate::search::request::{Request, Search, Symmetry};
use anyhow::{Context, bail, ensure};
use num_traits::Zero;
use std::collections::BTreeMap;
use std::io::Write;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Variants a table holds at most.
const BLOCK: usize = 1000;
/// Brute force looks at no more variants than this.
const BRUTE_LIMIT: u64 = 1 << 32;

pub(super) fn run(args: &Args, a: &SearchArgs) -> anyhow::Result<Done> {
    let mut mechanism = load::mechanism(&a.file.file)?;
    restrict(&mut mechanism, a)?;
    let request = request(&mechanism, a)?;
    let search = Search::new(exact_field(&mechanism, 0)?, &mechanism, request)?;
    if a.method == SearchMethod::Brute {
        return brute(&search, a);
    }
    let stop = Arc::new(AtomicBool::new(false));
    let flag = stop.clone();
    // A second Ctrl-C ends the program at once.
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::SeqCst) {
            std::process::exit(130);
        }
    })
    .context("cannot watch for Ctrl-C")?;
    let cancelled = || stop.load(Ordering::Relaxed);
    let mut bar = progress::Bar::new(args.quiet);
    let diagrams = search.build(&cancelled, &mut |p| bar.show(p));
    bar.clear();
    // What was found so far is still given; another Ctrl-C stops the giving.
    stop.store(false, Ordering::SeqCst);
    let mut determinate = search.counts(&diagrams.determinate, false);
    let mut admissible = search.counts(&diagrams.admissible, true);
    if a.one_per_orbit {
        (determinate, admissible) = search.orbits((determinate, admissible), &cancelled)?;
    }
    let by_cost = if a.format == SearchFormat::Json && !a.one_per_orbit {
        search.counts_by_cost(&diagrams.admissible)
    } else {
        BTreeMap::new()
    };
    let found = Found {
        search: &search,
        determinate,
        admissible,
        by_cost,
        diagrams: Some((&diagrams.determinate, &diagrams.admissible)),
        stop: diagrams.stop().word(),
    };
    output::to(a.output.as_deref(), |out| {
        let mut given = 0;
        let mut give =
            |write: &mut dyn FnMut(usize, Variant) -> anyhow::Result<()>| -> anyhow::Result<bool> {
                let mut failed = None;
                let mut visit = |v: Variant| {
                    given += 1;
                    match write(given, v) {
                        Ok(()) if cancelled() => ControlFlow::Break(()),
                        Ok(()) => ControlFlow::Continue(()),
                        Err(e) => {
                            failed = Some(e);
                            ControlFlow::Break(())
                        }
                    }
                };
                match a.sample {
                    Some(n) => {
                        for v in search.sample(&diagrams, n, args.seed) {
                            if visit(v).is_break() {
                                break;
                            }
                        }
                    }
                    None if a.count => {}
                    None => search.cheapest(
                        &diagrams,
                        if a.all { usize::MAX / 4 } else { a.top },
                        visit,
                    ),
                }
                failed.map_or(Ok(cancelled()), Err)
            };
        write_found(out, a, &found, &mut give)?;
        Ok(if found.admissible.total.is_zero() {
            Done::Nothing
        } else {
            Done::Found
        })
    })
}

/// Calls a writer with each variant and its position; true where it was interrupted.
type Giver<'a> =
    dyn FnMut(&mut dyn FnMut(usize, Variant) -> anyhow::Result<()>) -> anyhow::Result<bool> + 'a;

fn write_found(
    out: &mut dyn Write,
    a: &SearchArgs,
    found: &Found<'_>,
    give: &mut Giver<'_>,
) -> anyhow::Result<()> {
    let search = found.search;
    match a.format {
        SearchFormat::Text => {
            let width = output::width(a.output.as_deref());
            write!(out, "{}", search_text::counts(found, width))?;
            let what = if a.sample.is_some() {
                "drawn at random"
            } else {
                "cheapest first"
            };
            // A table is laid out as a whole, so a long list is given as several.
            let (mut block, mut given): (Vec<Variant>, usize) = (Vec::new(), 0);
            let mut put = |out: &mut dyn Write, block: &mut Vec<Variant>| -> anyhow::Result<()> {
                let head = if given == 0 {
                    format!("\n  {what}:\n")
                } else {
                    String::new()
                };
                writeln!(
                    out,
                    "{head}{}",
                    search_text::variants(search, block, given + 1, width)
                )?;
                given += block.len();
                block.clear();
                Ok(())
            };
            let interrupted = give(&mut |_, v| {
                block.push(v);
                if block.len() == BLOCK {
                    put(out, &mut block)
                } else {
                    Ok(())
                }
            })?;
            if !block.is_empty() {
                put(out, &mut block)?;
            }
            if interrupted {
                writeln!(out, "\n  interrupted after {given} variants")?;
            }
        }
        SearchFormat::Json => {
            let header = serde_json::Value::Object(search_json::header(found));
            // Variants stream: the closing brace of the header waits for them.
            let text = format!("{header:#}");
            let open = text.strip_suffix("\n}").unwrap_or(&text);
            write!(out, "{open},\n  \"variants\": [")?;
            let interrupted = give(&mut |i, v| {
                let comma = if i == 1 { "" } else { "," };
                write!(out, "{comma}\n    {}", search_json::variant(search, &v, i))?;
                Ok(())
            })?;
            writeln!(out, "\n  ],\n  \"variants_complete\": {}\n}}", !interrupted)?;
        }
        SearchFormat::Jsonl => {
            give(&mut |i, v| Ok(writeln!(out, "{}", search_json::variant(search, &v, i))?))?;
        }
        SearchFormat::Csv => {
            let joints: Vec<(usize, usize, JointId)> = columns(search);
            let names: Vec<String> = joints
                .iter()
                .map(|&(_, _, j)| quoted(&search.mechanism.joints[j].id))
                .collect();
            let heads = [
                "position",
                "cost",
                "mobility",
                "redundant",
                "external_redundant",
                "changes",
            ];
            writeln!(out, "{},{}", heads.join(","), names.join(","))?;
            give(&mut |i, v| {
                let k = v.key;
                write!(
                    out,
                    "{i},{},{},{},",
                    cost(search.steps.milli(k.cost())),
                    search.mobility(k),
                    k.internal()
                )?;
                if search.request.state.is_some() {
                    write!(out, "{}", k.external())?;
                }
                write!(out, ",{}", k.changes())?;
                for &(variable, _, j) in &joints {
                    let choice = &search.space.variables[variable].choices[v.choices[variable]];
                    write!(
                        out,
                        ",{}",
                        quoted(&crate::search::space::choice_name(
                            search.mechanism,
                            j,
                            choice
                        ))
                    )?;
                }
                Ok(writeln!(out)?)
            })?;
        }
    }
    Ok(())
}

/// The joints that have a choice, in file order: (variable, place in it, joint).
fn columns(search: &Search<'_>) -> Vec<(usize, usize, JointId)> {
    let mut out = Vec::new();
    for (v, variable) in search
        .space
        .variables
        .iter()
        .enumerate()
        .filter(|(_, v)| v.choices.len() > 1)
    {
        out.extend(variable.joints.iter().enumerate().map(|(i, &j)| (v, i, j)));
    }
    out.sort_by_key(|&(_, _, j)| j);
    out
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

fn brute(search: &Search<'_>, a: &SearchArgs) -> anyhow::Result<Done> {
    let size = search.size();
    ensure!(
        size <= BRUTE_LIMIT.into(),
        "{size} variants are too many for brute force; use --method diagram, or fewer --options"
    );
    let (determinate, admissible) = search.brute();
    let found = Found {
        search,
        determinate,
        admissible,
        by_cost: BTreeMap::new(),
        diagrams: None,
        stop: "exhausted",
    };
    output::to(a.output.as_deref(), |out| {
        write_found(out, a, &found, &mut |_| Ok(false))?;
        Ok(if found.admissible.total.is_zero() {
            Done::Nothing
        } else {
            Done::Found
        })
    })
}

fn request(mechanism: &Mechanism, a: &SearchArgs) -> anyhow::Result<Request> {
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
fn restrict(mechanism: &mut Mechanism, a: &SearchArgs) -> anyhow::Result<()> {
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
