//! `ozols explain`.

mod pair;

use crate::cli::prelude::*;
use crate::format::did_you_mean;
use crate::model::joint_type::JointType;
use crate::terms::{GlossaryTerm, Terms};
use std::io::Write;

#[derive(Debug, ClapArgs)]
pub(crate) struct Explain {
    /// Term, such as sigma, σ or redundant constraint, or joint type, such as sphere-in-cylinder [default: list all].
    #[arg(value_name = "TERM")]
    term: Vec<String>,
    /// Draw the joint type into this file, as SVG, or as PNG if its name ends in .png (if built with the feature `png`).
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Width of running text, in columns, if the output is not a terminal.
const COLUMNS: u16 = 100;

pub(crate) fn run(a: &Explain) -> anyhow::Result<Done> {
    let terms = Terms::builtin();
    let word = a.term.join(" ");
    if word.trim().is_empty() {
        return output::to(None, |out| {
            writeln!(out, "{}", all(&terms, output::width(None)))?;
            writeln!(out, "\n{}", pair::all(output::width(None)))?;
            writeln!(
                out,
                "\nozols explain TERM explains one of them, or a joint type."
            )?;
            Ok(Done::Found)
        });
    }
    if let Some(joint_type) = JointType::from_name(&pair::word(&word)) {
        return pair::explain(&joint_type, a.output.as_deref());
    }
    if word == "types" {
        return output::to(None, |out| {
            writeln!(out, "{}", pair::all(output::width(None)))?;
            Ok(Done::Found)
        });
    }
    ensure!(
        a.output.is_none(),
        "-o draws a joint type, and {word:?} is not one; they are: {}",
        JointType::NAMED.iter().join(", ")
    );
    let Some(term) = terms.find(&word) else {
        // Several words may stand for one term; each is named once.
        let types = JointType::NAMED.iter().map(JointType::name);
        let trade = JointType::TRADE_NAMES.map(|(name, _)| name);
        let types: Vec<&str> = types.chain(trade).collect();
        let near = did_you_mean::near(&word, terms.words().chain(types));
        let names = near
            .iter()
            .map(|w| terms.find(w).map_or(*w, |t| t.name.as_str()));
        bail!(
            "no term or joint type {word:?}{}; run `ozols explain` for the list",
            did_you_mean::question(&names.unique().collect_vec())
        )
    };
    output::to(None, |out| {
        one(out, &terms, term)?;
        Ok(Done::Found)
    })
}

fn all(terms: &Terms, width: Option<u16>) -> String {
    let rows = terms.term.iter().map(|t| {
        // Signs and the commonest words come first in the file.
        let also = t.also.iter().take(2).join(", ");
        vec![t.name.clone(), also, t.first_sentence().to_owned()]
    });
    table(&["term", "also", "what it is"], rows.collect(), width)
}

fn one(out: &mut dyn Write, terms: &Terms, term: &GlossaryTerm) -> std::io::Result<()> {
    let width = usize::from(output::width(None).unwrap_or(COLUMNS).min(COLUMNS));
    let fill = |text: &str| {
        let options = textwrap::Options::new(width).subsequent_indent("           ");
        textwrap::fill(text, options)
    };
    writeln!(out, "{}\n", term.name)?;
    writeln!(out, "{}\n", textwrap::fill(&term.text, width))?;
    if !term.also.is_empty() {
        writeln!(
            out,
            "{}",
            fill(&format!("  also     {}", term.also.join(", ")))
        )?;
    }
    writeln!(
        out,
        "{}",
        fill(&format!("  related  {}", term.related.join(", ")))
    )?;
    writeln!(out, "  see      {}", term.see)?;
    for s in &term.source {
        let source = terms.sources.get(s).unwrap_or(s);
        writeln!(out, "{}", fill(&format!("  source   {source}")))?;
    }
    Ok(())
}
