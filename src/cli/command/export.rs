//! `ozols export`.

use crate::cli::command::types::changed;
use crate::cli::option::reading::{Reading, description};
use crate::cli::option::request::Which;
use crate::cli::option::variant;
use crate::cli::option::variant::{Chosen, tell};
use crate::cli::prelude::*;
use crate::redundancy::release::Release;
use crate::robots::formats::{self, Format, FormattedFile};
use crate::robots::{self, Imported};
use crate::view::lint::words;
use clap::builder::{PossibleValue, PossibleValuesParser};

/// The formats of the mechanism file: TOML, which holds exact numbers, and the same as JSON.
const TOML: &str = "toml";
const JSON: &str = "json";

#[derive(Debug, ClapArgs)]
pub(crate) struct Export {
    /// A path, `-`, or the name of a built-in mechanism. A robot description (URDF, MJCF or SDF, by its root element) or CAD
    /// assembly (FreeCAD's .FCStd, OndselSolver's .asmt) is read according to the options below.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: Named,
    #[command(flatten)]
    reading: Reading,
    /// Output format.
    #[arg(long, value_parser = written())]
    to: String,
    #[command(flatten)]
    chosen: Chosen,
    /// State that the search includes in addition to the free one.
    #[arg(long, value_name = "STATE", requires = "chosen")]
    state: Option<String>,
    #[command(flatten)]
    which: Which,
    #[command(flatten)]
    out: ToFile,
}

fn written() -> PossibleValuesParser {
    let value = |f: &'static Format| PossibleValue::new(f.word).help(f.about);
    PossibleValuesParser::new(formats::written().map(value))
}

pub(crate) fn run(_: &Global, a: &Export) -> anyhow::Result<Done> {
    if formats::is_own(&a.to) {
        return own(a);
    }
    let request = a.chosen.of(a.which.request(a.state.as_deref())?);
    let imported = imported(a)?;
    if let Some(imported) = &imported
        && a.chosen.place().is_none()
        && [TOML, JSON].contains(&a.to.as_str())
    {
        return mechanism_file(a, imported);
    }
    let (mut m, left_behind) = match imported {
        Some(imported) => {
            load::tell_doubts(&a.file, &imported);
            (imported.mechanism, imported.report.left_behind())
        }
        None => (load::written(&a.file)?, None),
    };
    if let Some(k) = a.chosen.place() {
        m = variant::kth(m, request, k, |v| v.mechanism())?;
    } else if a.to == TOML {
        // Other formats hold decimals, in which the two are one.
        m = request.meant(&m, &mut note)?;
    }
    let text = text(&m, &a.to, left_behind)?;
    a.out.put(text)
}

/// Returns the robot description or CAD assembly that FILE names. `None` if FILE is neither.
fn imported(a: &Export) -> anyhow::Result<Option<Imported>> {
    if load::is_described(&a.file)? {
        return Ok(Some(description(a.file.path(), &a.reading.options()?)?));
    }
    let flags = a.reading.flags();
    let flag = flags.split(' ').next().unwrap_or_default();
    ensure!(
        flag.is_empty(),
        "{flag} is for robot descriptions, and {} is not one; give a URDF, MJCF or SDF file, or omit {flag}",
        a.file
    );
    Ok(None)
}

/// Writes the mechanism file of a description, with comments on what was merged and approximated, and says what was mapped and
/// dropped.
fn mechanism_file(a: &Export, imported: &Imported) -> anyhow::Result<Done> {
    let width = output::error_width();
    output::note(&fit(&imported.report.text(&a.file), width));
    a.out.put(if a.to == TOML {
        imported.toml()?
    } else {
        format!("{:#}\n", imported.file.json())
    })?;
    if let Some(path) = a.out.path() {
        let file = path.display().to_string();
        let steps = [
            ("analyze", "its mobility and redundant constraints"),
            ("search", "the redesigns that remove those"),
        ];
        let steps = steps.map(|(command, gives)| NextCommand::new(command, &file, "", gives));
        output::note(&next_commands::text(&steps, output::error_width()));
    }
    Ok(Done::Found)
}

/// Writes an assembly of a CAD program in its own format, with the joint types of the chosen variant.
fn own(a: &Export) -> anyhow::Result<Done> {
    let imported = description(a.file.path(), &a.reading.options()?)?;
    ensure!(
        imported.format.word == a.to,
        "--to {} writes a document of {} with other joint types; {} is not one",
        a.to,
        formats::written()
            .find(|f| f.word == a.to)
            .map_or("", |f| f.name),
        a.file
    );
    let m = &imported.mechanism;
    let request = a.chosen.of(a.which.request(a.state.as_deref())?);
    let releases = match a.chosen.place() {
        Some(k) => changed(m, request, k, tell)?.releases,
        None => Vec::new(),
    };
    let told: Vec<(Release, String)> = releases.into_iter().map(|r| (r, words(m, &r))).collect();
    let written = robots::fix(&imported, &told)?;
    a.out.put(written)
}

/// Converts a mechanism to a format and reports what is lost, after the notes of the import.
pub(crate) fn text(m: &Mechanism, to: &str, left_behind: Option<String>) -> anyhow::Result<String> {
    let FormattedFile { text, told } = formats::export(m, to)?;
    let told = left_behind.into_iter().chain(told);
    let told: String = told.map(|t| format!("  {t}\n")).collect();
    if !told.is_empty() {
        let all = format!("{} as {to}:\n{told}", m.name);
        output::note(&fit(&all, output::error_width()));
    }
    Ok(text)
}
