//! `ozols explain`.

use super::{Done, near, output};
use crate::terms::{Term, Terms};
use crate::view::layout::table;
use anyhow::bail;
use clap::Args as ClapArgs;
use itertools::Itertools;
use std::io::Write;

#[derive(Debug, ClapArgs)]
pub(super) struct Explain {
    /// The term, such as sigma, σ, or redundant constraint; all terms where left out.
    #[arg(value_name = "TERM")]
    term: Vec<String>,
}

/// Columns of running text where the output is no terminal.
const COLUMNS: u16 = 100;

pub(super) fn run(a: &Explain) -> anyhow::Result<Done> {
    let terms = Terms::builtin();
    let word = a.term.join(" ");
    if word.trim().is_empty() {
        return output::to(None, |out| {
            writeln!(out, "{}", all(&terms, output::width(None)))?;
            writeln!(out, "\nozols explain TERM says more of one.")?;
            Ok(Done::Found)
        });
    }
    let Some(term) = terms.find(&word) else {
        // Several words may stand for one term; each is named once.
        let near = near::near(&word, terms.words());
        let names = near
            .iter()
            .filter_map(|w| terms.find(w))
            .map(|t| t.name.as_str());
        bail!(
            "no term {word:?}{} (`ozols explain` lists all)",
            near::question(&names.unique().collect_vec())
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

fn one(out: &mut dyn Write, terms: &Terms, term: &Term) -> std::io::Result<()> {
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
