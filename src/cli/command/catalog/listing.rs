//! How lists and counts of chains are asked for and written.

use super::format::CatalogFormat;
use crate::cli::done::Done;
use crate::cli::terminal::output;
use crate::format::csv::records;
use anyhow::ensure;
use clap::{Args as ClapArgs, ValueHint};
use serde::Serialize;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(super) struct Listing {
    /// Mobility of the chains, all of whose joints have one freedom.
    #[arg(long, value_name = "W", default_value_t = 1)]
    pub(super) mobility: usize,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: CatalogFormat,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: Option<PathBuf>,
}

impl Listing {
    /// Refuses chains of several motions where `option` is about those of one.
    pub(super) fn is_of_one_motion(&self, option: &str) -> anyhow::Result<()> {
        ensure!(
            self.mobility == 1,
            "{option} counts chains of one motion: leave --mobility out"
        );
        Ok(())
    }

    /// Writes what was found, one row each, or as `text` for a terminal of some width.
    pub(super) fn give<T: Serialize>(
        &self,
        all: &[T],
        text: impl Fn(&[T], Option<u16>) -> String,
    ) -> anyhow::Result<Done> {
        let path = self.output.as_deref();
        output::to(path, |out| {
            match self.format {
                CatalogFormat::Text => write!(out, "{}", text(all, output::width(path)))?,
                CatalogFormat::Json => output::json(out, &all)?,
                CatalogFormat::Csv => write!(out, "{}", records(all))?,
            }
            Ok(Done::Found)
        })
    }
}
