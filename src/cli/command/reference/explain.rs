//! `ozols explain`.

use crate::cli::prelude::*;
use crate::format::{did_you_mean, format_cost};
use crate::model::joint_type::{Freedom, JointType};
use crate::terms::{GlossaryTerm, PairWords, Terms};

#[derive(Debug, ClapArgs)]
pub(crate) struct Explain {
    /// Term, such as sigma, σ or redundant constraint, or joint type, such as sphere-in-cylinder [default: list all].
    #[arg(value_name = "TERM")]
    term: Vec<String>,
}

/// Width of running text, in columns, if the output is not a terminal.
const COLUMNS: u16 = 100;

pub(crate) fn run_explain(a: &Explain) -> anyhow::Result<Done> {
    let terms = Terms::builtin();
    let word = a.term.join(" ");
    if word.trim().is_empty() {
        let (terms, types) = (
            table_of_terms(&terms, output::output_width(None)),
            table_of_types(output::output_width(None)),
        );
        let hint = "ozols explain TERM explains one of them, or a joint type.";
        return output::write_bytes(None, format!("{terms}\n\n{types}\n\n{hint}\n"));
    }
    if let Some(joint_type) = JointType::from_name(&spelled_type(&word)) {
        return explain_type(&joint_type);
    }
    if word == "types" {
        return output::write_bytes(None, table_of_types(output::output_width(None)) + "\n");
    }
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
    let row = |head: &str, text: &str| fill_row(head, 9, text, width);
    let about = textwrap::fill(&term.text, width);
    let also = (!term.also.is_empty()).then(|| row("also", &term.also.join(", ")));
    let related = row("related", &term.related.join(", "));
    let see = format!("  see      {}", term.see);
    let sources = term.source.iter();
    let sources = sources.map(|s| row("source", terms.sources.get(s).unwrap_or(s)));
    let rows = also.into_iter().chain([related, see]).chain(sources);
    format!("{}\n\n{about}\n\n{}\n", term.name, rows.format("\n"))
}

/// Returns a text after its head, which takes `room` columns, broken into lines of some width.
fn fill_row(head: &str, room: usize, text: &str, width: usize) -> String {
    let indent = " ".repeat(room + 2);
    let options = textwrap::Options::new(width).subsequent_indent(&indent);
    textwrap::fill(&format!("  {head:<room$}{text}"), options)
}

/// Returns the name of a joint type as files spell it.
fn spelled_type(typed: &str) -> String {
    typed.trim().to_lowercase().replace(['_', ' '], "-")
}

/// Returns a table of all joint types, one row each.
fn table_of_types(width: Option<u16>) -> String {
    let words = PairWords::builtin();
    let rows = JointType::NAMED.iter().map(|t| {
        let freedoms = t.freedoms().iter().map(|f| f.name()).join(" ");
        let made_as = words.get(t.name()).and_then(|w| w.hardware.first());
        let (also, cost) = (
            t.trade_names().join(", "),
            format_cost(t.default_cost_milli()),
        );
        let made_as = made_as.map_or("", String::as_str);
        row_cells([
            &t.name(),
            &also,
            &t.class_numeral(),
            &freedoms,
            &cost,
            &made_as,
        ])
    });
    let head = "joint type | also | class | freedoms | cost | made as";
    text_table(head, rows, width)
}

/// Explains one joint type.
fn explain_type(of: &JointType) -> anyhow::Result<Done> {
    let words = PairWords::builtin();
    let Some(w) = words.get(of.name()) else {
        return Ok(Done::Nothing);
    };
    let width = usize::from(output::output_width(None).unwrap_or(COLUMNS).min(COLUMNS));
    let needs = !w.reference.starts_with("does not matter");
    let (name, about) = (of.name(), textwrap::fill(&w.about, width));
    let figures = type_figures(of, w, width).join("\n");
    let mut out = format!(
        "{name}\n\n{about}\n\n{figures}\n\n{}\n",
        toml_example(of, needs)
    );
    if needs {
        let guess = "Without a reference, x is the first of the global axes that is not along z, which may not be what you want.";
        out += &format!("\n{}\n", textwrap::fill(guess, width));
    }
    output::write_bytes(None, out)
}

/// Returns freedoms, class, axes, cost and hardware, a paragraph each.
fn type_figures(of: &JointType, w: &PairWords, width: usize) -> Vec<String> {
    let row = |head: &str, text: &str| fill_row(head, 11, text, width);
    let freedoms = match of.freedoms() {
        [] => "none".to_owned(),
        list => list
            .iter()
            .map(|f| format!("{} {}", f.name(), freedom_meaning(*f)))
            .join(", "),
    };
    let constraints = count_noun(6 - of.freedoms().len(), "constraint");
    let class = format!("{} ({constraints})", of.class_numeral());
    let cost = format!(
        "{} by default, in units of one revolute joint; [search.costs] of a file or --costs sets others (`ozols show costs`)",
        format_cost(of.default_cost_milli())
    );
    let also = of.trade_names().join(", ");
    let also = (!also.is_empty()).then(|| row("also", &also));
    let figures = [
        row("freedoms", &freedoms),
        row("class", &class),
        row("axis z", &w.axis),
        row("reference x", &w.reference),
        row("cost", &cost),
        row("made as", &w.hardware.join("; ")),
    ];
    also.into_iter().chain(figures).collect()
}

/// Returns an example of the joint type as TOML.
fn toml_example(of: &JointType, needs_reference: bool) -> String {
    let screws = of.freedoms().contains(&Freedom::Screw);
    let own = if screws { "\nlead = 5" } else { "" };
    let reference = if needs_reference {
        "\nreference = [1, 0, 0]"
    } else {
        ""
    };
    format!(
        "[[joint]]\nid = \"1-2\"\nlinks = [\"1\", \"2\"]\ntype = \"{}\"\npoint = [0, 0, 0]\naxis = [0, 0, 1]{reference}{own}",
        of.name()
    )
}

/// Describes a freedom in words.
fn freedom_meaning(f: Freedom) -> &'static str {
    match f {
        Freedom::Rx => "(turn about x)",
        Freedom::Ry => "(turn about y)",
        Freedom::Rz => "(turn about z)",
        Freedom::Tx => "(shift along x)",
        Freedom::Ty => "(shift along y)",
        Freedom::Tz => "(shift along z)",
        Freedom::Screw => "(turn about z with a shift along it)",
    }
}
