//! The answer of a search in the format asked for.

use super::args::{Search as SearchArgs, SearchFormat};
use super::{output, question};
use crate::format::number::cost;
use crate::model::mechanism::JointId;
use crate::search::certify::{Certified, Summary};
use crate::search::relax::Relaxation;
use crate::search::request::Search;
use crate::view::layout::fit;
use crate::view::search_json::{self, Found};
use crate::view::search_text;
use crate::view::{next, ranking};
use num_bigint::BigUint;
use num_traits::Zero;
use std::io::Write;

/// Variants a table holds at most.
const BLOCK: usize = 1000;

/// What was given.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Given {
    /// Whether the giving was interrupted.
    pub(super) interrupted: bool,
    /// Lucky variants left out.
    pub(super) dropped: usize,
}

/// Calls a writer with each variant and its position.
pub(super) type Giver<'a> =
    dyn FnMut(&mut dyn FnMut(usize, Certified) -> anyhow::Result<()>) -> anyhow::Result<Given> + 'a;

pub(super) fn write_found(
    out: &mut dyn Write,
    a: &SearchArgs,
    found: &Found<'_>,
    eased: &[(Relaxation, BigUint)],
    give: &mut Giver<'_>,
) -> anyhow::Result<()> {
    let search = found.search;
    let mut summary = Summary::default();
    match a.format {
        SearchFormat::Text => {
            let width = output::width(a.output.as_deref());
            write!(out, "{}", search_text::counts(found, width))?;
            let what = match &found.ranking {
                Some(p) => ranking::head(p),
                None if a.sample.is_some() => "drawn at random".to_owned(),
                None => "cheapest first".to_owned(),
            };
            // A table is laid out as a whole, so a long list is given as several.
            let (mut block, mut given): (Vec<Certified>, usize) = (Vec::new(), 0);
            let mut put = |out: &mut dyn Write, block: &mut Vec<Certified>| -> anyhow::Result<()> {
                let head = if given == 0 {
                    fit(&format!("\n  {what}:\n"), width)
                } else {
                    String::new()
                };
                writeln!(
                    out,
                    "{head}{}",
                    search_text::variants(found, block, given + 1, width)
                )?;
                given += block.len();
                block.clear();
                Ok(())
            };
            let mut notes = Vec::new();
            let whole = give(&mut |i, v| {
                summary.add(&v);
                notes.extend(search_text::note(&v, i));
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
            summary.dropped = whole.dropped;
            write!(out, "{}", search_text::notes(&summary, &notes, width))?;
            if let Some(p) = &found.ranking {
                let notes = ranking::notes(search.mechanism, p);
                write!(out, "{}", fit(&notes, width))?;
            }
            if whole.interrupted {
                writeln!(out, "\n  interrupted after {given} variants")?;
            }
            let flags = question::flags(search.mechanism, &a.asked);
            // Numbers of a sample, or of a list with some left out, mean nothing to other commands.
            let listed = if a.sample.is_some() { 0 } else { given };
            let steps = match a.asked.generic_only {
                true => Vec::new(),
                false => search_text::next(found, listed, eased, &a.file.file, &flags),
            };
            write!(out, "{}", next::text(&steps, width))?;
        }
        SearchFormat::Json => {
            let header = serde_json::Value::Object(search_json::header(found));
            // Variants stream: the closing brace of the header waits for them.
            let text = format!("{header:#}");
            let open = text.strip_suffix("\n}").unwrap_or(&text);
            write!(out, "{open},\n  \"variants\": [")?;
            let whole = give(&mut |i, v| {
                summary.add(&v);
                let comma = if i == 1 { "" } else { "," };
                write!(out, "{comma}\n    {}", search_json::variant(found, &v, i))?;
                Ok(())
            })?;
            summary.dropped = whole.dropped;
            let mut tail = search_json::tail(&summary, !whole.interrupted);
            if found.admissible.total.is_zero() {
                tail.insert("relaxations".to_owned(), search_json::eased(eased));
            }
            let text = format!("{:#}", serde_json::Value::Object(tail));
            let rest = text.strip_prefix("{\n").unwrap_or(&text);
            writeln!(out, "\n  ],\n{rest}")?;
        }
        SearchFormat::Jsonl => {
            give(&mut |i, v| Ok(writeln!(out, "{}", search_json::variant(found, &v, i))?))?;
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
            write!(
                out,
                "{},{},conditioning,agree,lucky",
                heads.join(","),
                names.join(",")
            )?;
            match &found.ranking {
                Some(_) => writeln!(
                    out,
                    ",by_cost,peak_force,peak_moment,singular_ratio,output_error,idle,total,front"
                )?,
                None => writeln!(out)?,
            }
            give(&mut |i, certified| {
                let v = &certified.variant;
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
                match certified.second.opinion() {
                    Some(o) => write!(out, ",{:e},{}", o.conditioning, o.agree)?,
                    None => write!(out, ",,")?,
                }
                let lucky = certified.stroke.and_then(|s| s.lucky());
                write!(out, ",{}", lucky.map_or(String::new(), |l| l.to_string()))?;
                if let Some(p) = &found.ranking {
                    match p.of(v) {
                        Some((_, r)) => write!(
                            out,
                            ",{},{},{},{},{},{},{},{}",
                            r.by_cost,
                            r.scores.force.utilisation,
                            r.scores.moment.utilisation,
                            r.scores.conditioning,
                            r.scores.output_error,
                            r.scores.idle,
                            r.total.map_or(String::new(), |x| x.to_string()),
                            r.front.map_or(String::new(), |x| x.to_string())
                        )?,
                        None => write!(out, ",,,,,,,,")?,
                    }
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
