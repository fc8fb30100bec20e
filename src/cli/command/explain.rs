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

pub(crate) fn run(a: &Explain) -> anyhow::Result<Done> {
    let terms = Terms::builtin();
    let word = a.term.join(" ");
    if word.trim().is_empty() {
        let (terms, types) = (
            all(&terms, output::width(None)),
            pair::all(output::width(None)),
        );
        let hint = "ozols explain TERM explains one of them, or a joint type.";
        return output::put(None, format!("{terms}\n\n{types}\n\n{hint}\n"));
    }
    if let Some(joint_type) = JointType::from_name(&pair::word(&word)) {
        return pair::explain(&joint_type, a.output.as_deref());
    }
    if word == "types" {
        return output::put(None, pair::all(output::width(None)) + "\n");
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
    output::put(None, one(&terms, term))
}

fn all(terms: &Terms, width: Option<u16>) -> String {
    let rows = terms.term.iter().map(|t| {
        // Signs and the commonest words come first in the file.
        let also = t.also.iter().take(2).join(", ");
        vec![t.name.clone(), also, t.first_sentence().to_owned()]
    });
    table("term | also | what it is", rows, width)
}

fn one(terms: &Terms, term: &GlossaryTerm) -> String {
    let width = usize::from(output::width(None).unwrap_or(COLUMNS).min(COLUMNS));
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
