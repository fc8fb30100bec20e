//! `ozols catalog find`.

use super::look::open;
use crate::catalog::find::entries;
use crate::catalog::neighbours::{Neighbours, neighbours};
use crate::cli::done::Done;
use crate::cli::option::load;
use crate::cli::option::named::File;
use crate::cli::terminal::output;
use crate::synthesis::recognize::recognize;
use crate::view::catalog::find::{FoundData, InCatalogue, found_text};
use anyhow::Context;
use clap::{Args as ClapArgs, ValueHint};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Find {
    #[command(flatten)]
    file: File,
    /// A catalogue to look for it in.
    #[arg(long = "in", value_name = "CATALOGUE", value_hint = ValueHint::FilePath)]
    within: Option<PathBuf>,
    /// JSON instead of text.
    #[arg(long)]
    json: bool,
    /// Write to a file instead of standard output.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: Option<PathBuf>,
}

pub(super) fn find(a: &Find) -> anyhow::Result<Done> {
    let m = load::mechanism(&a.file)?;
    let found = recognize(&m).with_context(|| {
        format!(
            "{}: not a structure of two jaws, or of three, that links, hinges, slides, gears and slots make",
            a.file.file
        )
    })?;
    let store = a.within.as_deref().map(open).transpose()?;
    let part = found.structure.essential_links();
    let essential = found.structure.part(&part);
    let known = store.map(|s| -> anyhow::Result<InCatalogue> {
        let whole = found.whole.part(&found.whole.essential_links());
        Ok(InCatalogue {
            entries: entries(&s, &whole, found.made_as)?,
            // Three sides that are alike are not compared.
            neighbours: if found.sides() == 3 {
                Neighbours::default()
            } else {
                neighbours(&s, &essential)?
            },
        })
    });
    let data = FoundData::new(&found, &part, known.transpose()?);
    let path = a.output.as_deref();
    output::to(path, |out| {
        if a.json {
            output::json(out, &data)?;
        } else {
            write!(out, "{}", found_text(&m.name, &data, output::width(path)))?;
        }
        Ok(if data.is_known() {
            Done::Found
        } else {
            Done::Nothing
        })
    })
}
