//! `ozols export`.

use crate::cli::option::reading::{Reading, import_description};
use crate::cli::option::request::Which;
use crate::cli::option::variant;
use crate::cli::option::variant::Chosen;
use crate::cli::prelude::*;
use crate::robots::formats::{self, Format, FormattedFile};
use crate::robots::{Imported, KINEMATICS};
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
    #[arg(long, value_parser = parse_format())]
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

fn parse_format() -> PossibleValuesParser {
    let value = |f: &'static Format| PossibleValue::new(f.word).help(f.about);
    PossibleValuesParser::new(formats::writable_formats().map(value))
}

pub(crate) fn run_export(_: &Global, a: &Export) -> anyhow::Result<Done> {
    let request = a.chosen.list_request(a.which.request(a.state.as_deref())?);
    let imported = import_file(a)?;
    if let Some(imported) = &imported
        && a.chosen.list_place().is_none()
        && [TOML, JSON].contains(&a.to.as_str())
    {
        return mechanism_file(a, imported);
    }
    let (mut m, left_behind) = match imported {
        Some(imported) => {
            load::tell_doubts(&a.file, &imported);
            (imported.mechanism, Some(KINEMATICS))
        }
        None => (load::load_written(&a.file)?, None),
    };
    if let Some(k) = a.chosen.list_place() {
        m = variant::with_variant(m, request, k, |v| v.as_mechanism())?;
    } else if a.to == TOML {
        // Other formats hold decimals, in which the two are one.
        m = request.meant_mechanism(&m, &mut print_line)?;
    }
    let text = export_text(&m, &a.to, left_behind)?;
    a.out.write_all_of(text)
}

/// Returns the robot description or CAD assembly that FILE names. `None` if FILE is neither.
fn import_file(a: &Export) -> anyhow::Result<Option<Imported>> {
    if load::is_described(&a.file)? {
        return Ok(Some(import_description(
            a.file.path(),
            &a.reading.import_options()?,
        )?));
    }
    let flags = a.reading.typed_flags();
    let flag = flags.split(' ').next().unwrap_or_default();
    ensure!(flag.is_empty(), load::unsuited_option(flag, &a.file));
    Ok(None)
}

/// Writes the mechanism file of a description, and reports on standard error what was moved, approximated and omitted.
fn mechanism_file(a: &Export, imported: &Imported) -> anyhow::Result<Done> {
    let width = output::error_width();
    output::print_note(&fit_lines(&imported.report.text(&a.file), width));
    a.out.write_all_of(if a.to == TOML {
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
        output::print_note(&next_commands::steps_text(&steps, output::error_width()));
    }
    Ok(Done::Found)
}

/// Converts a mechanism to a format and reports what is lost, after the notes of the import.
pub(crate) fn export_text(
    m: &Mechanism,
    to: &str,
    left_behind: Option<&str>,
) -> anyhow::Result<String> {
    let FormattedFile { text, told } = formats::export(m, to)?;
    let told = left_behind.map(str::to_owned).into_iter().chain(told);
    let told: String = told.map(|t| format!("  {t}\n")).collect();
    if !told.is_empty() {
        let all = format!("{} as {to}:\n{told}", m.name);
        output::print_note(&fit_lines(&all, output::error_width()));
    }
    Ok(text)
}
