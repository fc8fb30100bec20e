//! `ozols import`.

use super::args::{Args, Import, ImportFormat};
use super::{Done, load, output};
use crate::robots::{self, Options};
use crate::view::layout::fit;
use crate::view::next::{self, Step};
use anyhow::{Context, bail};
use std::path::Path;

/// Largest robot description and file beside it, in bytes.
const MAX_BYTES: u64 = 64 << 20;

pub(super) fn run(args: &Args, a: &Import) -> anyhow::Result<Done> {
    let mut options = Options {
        floating: a.floating,
        assemble: a.assemble,
        open: a.open,
        frame: a.frame.clone(),
        outputs: a.working_link.clone(),
        ..Options::default()
    };
    for p in &a.pose {
        options.pose.push(pose(p)?);
    }
    if let Some(path) = &a.loops {
        let bytes = load::bytes(path, MAX_BYTES)?;
        options.loops = Some((path.display().to_string(), bytes));
    }
    let imported = description(Path::new(&a.file), &options)?;
    if !args.quiet {
        let width = output::error_width();
        output::note(&fit(&imported.report.text(&a.file), width));
    }
    output::to(a.output.as_deref(), |out| {
        match a.format {
            ImportFormat::Toml => write!(out, "{}", imported.toml()?)?,
            ImportFormat::Json => writeln!(out, "{:#}", imported.file.json())?,
        }
        Ok(Done::Found)
    })?;
    if let (Some(path), false) = (&a.output, args.quiet) {
        let file = path.display().to_string();
        let steps = [
            ("analyze", "its mobility and redundant constraints"),
            ("search", "the redesigns that remove those"),
        ];
        let steps = steps.map(|(command, gives)| Step::new(command, &file, "", gives));
        output::note(&next::text(&steps, output::error_width()));
    }
    Ok(Done::Found)
}

fn pose(text: &str) -> anyhow::Result<(String, Vec<f64>)> {
    let bad = || {
        format!(
            "--pose {text}: write joint=value, in radians or metres, with commas between several"
        )
    };
    let (joint, values) = text.rsplit_once('=').with_context(bad)?;
    let values = values
        .split(',')
        .map(|v| v.trim().parse::<f64>())
        .collect::<Result<Vec<_>, _>>()
        .with_context(bad)?;
    Ok((joint.to_owned(), values))
}

/// Imports a description; files it includes are read from its folder and nowhere else.
pub(super) fn description(path: &Path, options: &Options) -> anyhow::Result<robots::Imported> {
    let name = path.display().to_string();
    if !path.is_file() {
        bail!("{name} is not a file; give the path of a URDF, MJCF or SDF file");
    }
    let bytes = load::bytes(path, MAX_BYTES)?;
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let folder = std::fs::canonicalize(folder).with_context(|| format!("cannot read {name}"))?;
    let read = |inner: &str| {
        let inside = std::fs::canonicalize(folder.join(inner))?;
        if !inside.starts_with(&folder) {
            return Err(std::io::Error::other(
                "it is outside the folder of the file",
            ));
        }
        load::bytes_of(&inside, MAX_BYTES)
    };
    Ok(robots::import(&name, &bytes, &read, options)?)
}
