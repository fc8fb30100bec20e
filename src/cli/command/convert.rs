//! `ozols convert`.

use crate::api;
use crate::cli::command::import::{Reading, description};
use crate::cli::done::Done;
use crate::cli::terminal::output;
use crate::robots::Options;
use crate::robots::convert::{Converted, LoopClosure, Target, Wanted, convert, figures};
use crate::view::robots::convert::{self as view, Files};
use crate::view::terminal::layout::fit;
use anyhow::{Context, bail, ensure};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args as ClapArgs, ValueEnum, ValueHint};
use itertools::Itertools;
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ReportFormat {
    Text,
    Json,
}

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Convert {
    /// A robot description: URDF, MJCF or SDF.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    #[command(flatten)]
    reading: Reading,
    /// The file to write; its ending says the format. Beside FILE, so that its meshes are found.
    #[arg(long, short, value_name = "OUT")]
    output: PathBuf,
    /// The format to write.
    #[arg(long, value_parser = targets())]
    to: Option<String>,
    /// How loops close (repeatable): auto, as-given, connect, universal, cylinder, hinge, two-points, line or weld for all, or
    /// NAME=WORD for one. `auto` takes what holds nothing twice and lets nothing else move, and says what each would do.
    #[arg(long, value_name = "[NAME=]WORD")]
    closure: Vec<String>,
    /// The report on standard output.
    #[arg(long, value_enum, default_value = "text")]
    format: ReportFormat,
}

fn targets() -> PossibleValuesParser {
    let value = |(word, _, about): &(&'static str, Target, &'static str)| {
        PossibleValue::new(*word).help(*about)
    };
    PossibleValuesParser::new(Target::ALL.iter().map(value))
}

pub(in crate::cli) fn run(a: &Convert) -> anyhow::Result<Done> {
    let (word, target) = target(a)?;
    let wanted = wanted(&a.closure)?;
    let options = a.reading.options()?;
    let imported = description(&a.file, &options)?;
    output::kept::apart(&a.output)?;
    let converted = convert(&imported, target, &wanted)?;
    let beside = converted
        .beside
        .as_ref()
        .map(|_| a.output.with_extension("yaml"));
    let names = [
        Some(a.file.as_path()),
        Some(a.output.as_path()),
        beside.as_deref(),
    ];
    let [from, to, beside_name] = names.map(|p| p.map(|p| p.display().to_string()));
    let files = Files {
        from: from.as_deref().unwrap_or(""),
        to: to.as_deref().unwrap_or(""),
        beside: beside_name.as_deref(),
        target: word,
    };
    if let Some(path) = &beside {
        output::kept::apart(path)?;
    }
    let asked = wanted.all == Some(None) || wanted.each.iter().any(|e| e.1.is_none());
    let left = converted.figures.is_none_or(|f| f.1 > 0);
    let written = !(asked && left);
    if written {
        again(a, &options, &converted)?;
        if let (Some(path), Some(text)) = (&beside, &converted.beside) {
            put(path, text)?;
        }
        put(&a.output, &converted.text)?;
    }
    let conversion = Conversion {
        converted: &converted,
        files,
        written,
        asked,
    };
    conversion.write(a.format)
}

/// What is told on standard output.
struct Conversion<'a> {
    converted: &'a Converted,
    files: Files<'a>,
    /// Whether the file was written.
    written: bool,
    /// Whether the closures were left to choose.
    asked: bool,
}

impl Conversion<'_> {
    fn write(&self, format: ReportFormat) -> anyhow::Result<Done> {
        let width = output::width(None);
        let Conversion {
            converted,
            files,
            written,
            asked,
        } = *self;
        output::to(None, |out| {
            match format {
                ReportFormat::Json => {
                    let mut report = view::json(converted, files);
                    report["written"] = written.into();
                    output::json(out, &report)?;
                }
                ReportFormat::Text => {
                    if written {
                        write!(out, "{}", fit(&view::text(converted, files, width), width))?;
                    } else {
                        let what = "no closure of its loops holds nothing twice and lets nothing else move; nothing is written (--closure NAME=WORD takes one of these)";
                        write!(out, "{}", fit(&format!("{}: {what}\n", files.from), width))?;
                    }
                    if asked {
                        write!(out, "{}", view::closures(&converted.closures, width))?;
                    }
                }
            }
            Ok(if written { Done::Found } else { Done::Nothing })
        })
    }
}

fn put(path: &Path, text: &str) -> anyhow::Result<()> {
    output::to(Some(path), |out| {
        out.write_all(text.as_bytes())?;
        Ok(Done::Found)
    })?;
    Ok(())
}

/// The format asked for, or that of the ending.
fn target(a: &Convert) -> anyhow::Result<(&'static str, Target)> {
    ensure!(
        a.output != Path::new("-"),
        "-o -: name a file, the report goes to standard output"
    );
    if let Some(word) = &a.to {
        let found = Target::ALL.iter().find(|t| t.0 == word);
        return found.map(|t| (t.0, t.1)).context("unknown format");
    }
    let ending = a
        .output
        .extension()
        .map_or(String::new(), |e| e.to_string_lossy().into_owned());
    let found = Target::of_ending(&ending);
    let found = found.and_then(|t| Target::ALL.iter().find(|x| x.1 == t));
    found.map(|t| (t.0, t.1)).with_context(|| {
        let words = Target::ALL.iter().map(|t| t.0).join(", ");
        format!(
            "{}: the ending says no format; name it .xml, .sdf or .urdf, or say --to {words}",
            a.output.display()
        )
    })
}

/// What is asked of the closures.
fn wanted(words: &[String]) -> anyhow::Result<Wanted> {
    let mut out = Wanted::default();
    for given in words {
        let (name, word) = match given.rsplit_once('=') {
            Some((name, word)) => (Some(name), word),
            None => (None, given.as_str()),
        };
        let closure = match word {
            "auto" => None,
            w => match LoopClosure::ALL.iter().find(|c| c.0 == w) {
                Some(c) => Some(c.1),
                None => bail!(
                    "--closure {given}: there is no such closure; known: auto, {}",
                    LoopClosure::ALL.iter().map(|c| c.0).join(", ")
                ),
            },
        };
        match name {
            Some(n) => out.each.push((n.to_owned(), closure)),
            None => out.all = Some(closure),
        }
    }
    Ok(out)
}

/// Reads what is to be written again: its W and σ have to be what they were.
fn again(a: &Convert, options: &Options, c: &Converted) -> anyhow::Result<()> {
    let beside = c
        .beside
        .as_ref()
        .filter(|b| !b.starts_with("closed_loop: []"));
    let options = Options {
        loops: beside.map(|text| ("loops.yaml".to_owned(), text.clone().into_bytes())),
        pose: c.pose.clone(),
        open: options.open,
        outputs: Vec::new(),
        ..Options::default()
    };
    let again = api::description_of(&a.file, c.text.as_bytes(), &options).context(
        "what would be written cannot be read again; nothing is written; report this with the file",
    )?;
    let (Some((w, sigma)), Some(found)) = (c.figures, figures(&again.mechanism)) else {
        return Ok(());
    };
    // Without a coupling W is another, as is told.
    ensure!(
        c.lost.coupling_rows > 0 || found == (w, sigma + c.repeated),
        "read again, what would be written has W = {}, σ = {} where W = {w}, σ = {} was to be; nothing is written",
        found.0,
        found.1,
        sigma + c.repeated
    );
    Ok(())
}
