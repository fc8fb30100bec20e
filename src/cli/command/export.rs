//! `ozols export`.

use crate::cli::command::import::description;
use crate::cli::command::types::changed;
use crate::cli::done::Done;
use crate::cli::option::global::Global;
use crate::cli::option::load;
use crate::cli::option::named::File;
use crate::cli::option::request::Which;
use crate::cli::option::variant;
use crate::cli::option::variant::{Chosen, tell};
use crate::cli::terminal::output;
use crate::cli::terminal::progress::note;
use crate::model::mechanism::Mechanism;
use crate::redundancy::release::Release;
use crate::robots;
use crate::robots::formats::{self, Format, FormattedFile};
use crate::view::lint::words;
use crate::view::terminal::layout::fit;
use anyhow::ensure;
use clap::Args as ClapArgs;
use clap::builder::{PossibleValue, PossibleValuesParser};
use std::path::PathBuf;

/// The format that holds exact numbers.
const TOML: &str = "toml";

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Export {
    #[command(flatten)]
    file: File,
    /// The format.
    #[arg(long, value_parser = written())]
    to: String,
    #[command(flatten)]
    chosen: Chosen,
    /// The state that the search takes in besides the free one.
    #[arg(long, value_name = "STATE", requires = "chosen")]
    state: Option<String>,
    #[command(flatten)]
    which: Which,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

fn written() -> PossibleValuesParser {
    let value = |f: &'static Format| PossibleValue::new(f.word).help(f.about);
    PossibleValuesParser::new(formats::written().map(value))
}

pub(in crate::cli) fn run(_: &Global, a: &Export) -> anyhow::Result<Done> {
    if formats::is_own(&a.to) {
        return own(a);
    }
    let (mut m, left_behind) = load::with_what_is_left_behind(&a.file)?;
    let request = a.chosen.of(a.which.request(a.state.as_deref())?);
    if let Some(k) = a.chosen.place() {
        m = variant::kth(m, request, k, |v| v.mechanism())?;
    } else if request.snap.is_some() || a.to == TOML {
        // Other formats hold decimals, in which the two are one.
        m = request.meant(&m, &mut note)?;
    }
    let text = text(&m, &a.to, left_behind)?;
    output::to(a.output.as_deref(), |out| {
        write!(out, "{text}")?;
        Ok(Done::Found)
    })
}

/// An assembly of a CAD program, in its own document: with the joint types of what is chosen.
fn own(a: &Export) -> anyhow::Result<Done> {
    let imported = description(a.file.file.path(), &a.file.loops.options()?)?;
    ensure!(
        imported.format.word == a.to,
        "--to {} writes a document of {} with other joint types; {} is none",
        a.to,
        formats::written()
            .find(|f| f.word == a.to)
            .map_or("", |f| f.name),
        a.file.file
    );
    let m = &imported.mechanism;
    let request = a.chosen.of(a.which.request(a.state.as_deref())?);
    let releases = match a.chosen.place() {
        Some(k) => changed(m, request, k, tell)?.releases,
        None => Vec::new(),
    };
    let told: Vec<(Release, String)> = releases.into_iter().map(|r| (r, words(m, &r))).collect();
    let written = robots::fix(&imported, &told)?;
    output::to(a.output.as_deref(), |out| {
        out.write_all(&written)?;
        Ok(Done::Found)
    })
}

/// A mechanism in a format; what is lost is said, after what was left behind before.
pub(in crate::cli) fn text(
    m: &Mechanism,
    to: &str,
    left_behind: Option<String>,
) -> anyhow::Result<String> {
    let FormattedFile { text, told } = formats::export(m, to)?;
    let told = left_behind.into_iter().chain(told);
    let told: String = told.map(|t| format!("  {t}\n")).collect();
    if !told.is_empty() {
        let all = format!("{} as {to}:\n{told}", m.name);
        output::note(&fit(&all, output::error_width()));
    }
    Ok(text)
}
