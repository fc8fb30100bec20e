//! `ozols analyze`.

use super::args::{Analyze, AnalyzeFormat, Args, RankMethod};
use super::{Done, load, output, verify};
use crate::redundancy::analysis::{Method, analyse};
use crate::report::{analysis_json, analysis_text};
use anyhow::bail;

pub(super) fn run(_: &Args, a: &Analyze) -> anyhow::Result<Done> {
    let mut mechanism = load::mechanism(&a.file.file)?;
    if a.planar {
        load::put_in_plane(&mut mechanism);
    }
    let states: Vec<usize> = match (
        a.state.as_str(),
        mechanism.states.iter().position(|s| *s == a.state),
    ) {
        (_, Some(s)) => vec![s],
        ("all", None) => (0..mechanism.states.len()).collect(),
        (other, None) => bail!(
            "{} has no state {other}; it has: {}",
            mechanism.name,
            mechanism.states.join(", ")
        ),
    };
    let method = match a.method {
        RankMethod::Auto | RankMethod::Modular => Method::Modular,
        RankMethod::Svd if a.tolerance > 0.0 && a.tolerance < 1.0 => Method::Svd {
            tolerance: a.tolerance,
        },
        RankMethod::Svd => bail!("--tolerance must be between 0 and 1"),
    };
    let found = analyse(&mechanism, &states, method)?;
    if let Some(path) = &a.certificate {
        verify::write(path, &mechanism, &states)?;
    }
    output::to(a.output.as_deref(), |out| {
        match a.format {
            AnalyzeFormat::Json => {
                writeln!(out, "{:#}", analysis_json::analysis(&mechanism, &found))?
            }
            AnalyzeFormat::Text => {
                write!(
                    out,
                    "{}",
                    analysis_text::analysis(&mechanism, &found, output::width(a.output.as_deref()))
                )?;
            }
        }
        Ok(Done::Found)
    })
}
