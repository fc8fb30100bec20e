//! `ozols explain`.

mod pair;

use crate::cli::prelude::*;
use crate::format::did_you_mean;
use crate::model::joint_type::JointType;
use crate::terms::{GlossaryTerm, Terms};

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

pub(crate) fn run_explain(a: &Explain) -> anyhow::Result<Done> {
    let terms = Terms::builtin();
    let word = a.term.join(" ");
    if word.trim().is_empty() {
        let (terms, types) = (
            table_of_terms(&terms, output::output_width(None)),
            pair::table_of_types(output::output_width(None)),
        );
        let hint = "ozols explain TERM explains one of them, or a joint type.";
        return output::write_bytes(None, format!("{terms}\n\n{types}\n\n{hint}\n"));
    }
    if let Some(joint_type) = JointType::from_name(&pair::spelled_type(&word)) {
        return pair::explain_type(&joint_type, a.output.as_deref());
    }
    if word == "types" {
        return output::write_bytes(
            None,
            pair::table_of_types(output::output_width(None)) + "\n",
        );
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
        let near = did_you_mean::nearest_words(&word, terms.known_words().chain(types));
        let names = near
            .iter()
            .map(|w| terms.find(w).map_or(*w, |t| t.name.as_str()));
        bail!(
            "no term or joint type {word:?}{}; run `ozols explain` for the list",
            did_you_mean::ask_words(&names.unique().collect_vec())
        )
    };
    output::write_bytes(None, explain_term(&terms, term))
}

fn table_of_terms(terms: &Terms, width: Option<u16>) -> String {
    let rows = terms.term.iter().map(|t| {
        // Signs and the commonest words come first in the file.
        let also = t.also.iter().take(2).join(", ");
        vec![t.name.clone(), also, t.first_sentence().to_owned()]
    });
    text_table("term | also | what it is", rows, width)
}

fn explain_term(terms: &Terms, term: &GlossaryTerm) -> String {
    let width = usize::from(output::output_width(None).unwrap_or(COLUMNS).min(COLUMNS));
    let row = |head: &str, text: &str| {
        let options = textwrap::Options::new(width).subsequent_indent("           ");
        textwrap::fill(&format!("  {head:<8} {text}"), options)
    };
    let about = textwrap::fill(&term.text, width);
    let also = (!term.also.is_empty()).then(|| row("also", &term.also.join(", ")));
    let related = row("related", &term.related.join(", "));
    let see = format!("  see      {}", term.see);
    let sources = term.source.iter();
    let sources = sources.map(|s| row("source", terms.sources.get(s).unwrap_or(s)));
    let rows = also.into_iter().chain([related, see]).chain(sources);
    format!("{}\n\n{about}\n\n{}\n", term.name, rows.format("\n"))
}
