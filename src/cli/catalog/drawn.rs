//! `ozols catalog search`.

use super::super::args::Args;
use super::super::progress::Bar;
use super::super::{Done, interrupt, load};
use super::built::built;
use crate::builtin;
use crate::catalog::drawn::{drawn, id};
use crate::catalog::spec::Spec;
use crate::catalog::store::Store;
use anyhow::{Context, ensure};
use clap::{Args as ClapArgs, ValueHint};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Search {
    /// Mechanism files, robot files, or names of built-in mechanisms. Each is searched with its own options and workload.
    #[arg(value_hint = ValueHint::FilePath)]
    files: Vec<String>,
    /// All built-in grippers, too.
    #[arg(long)]
    grippers: bool,
    /// Ideas kept of each.
    #[arg(long, value_name = "K", default_value_t = Spec::default().ideas)]
    ideas: usize,
    /// The database; where it is there already, it is added to.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: PathBuf,
}

pub(super) fn search(args: &Args, a: &Search) -> anyhow::Result<Done> {
    let mut files = a.files.clone();
    if a.grippers {
        files.extend(builtin::grippers().into_iter().map(str::to_owned));
    }
    ensure!(
        !files.is_empty(),
        "nothing to search: name a FILE, or all built-in grippers by --grippers"
    );
    // A wrong file is told before any is searched.
    let mechanisms: Vec<_> = files
        .iter()
        .map(|f| load::mechanism(f).with_context(|| f.clone()))
        .collect::<anyhow::Result<_>>()?;
    let mut store = Store::writable(&a.output)?;
    let mut added = 0;
    interrupt::be_patient();
    let mut bar = Bar::new(args.quiet);
    for (i, (file, mechanism)) in files.iter().zip(mechanisms).enumerate() {
        if interrupt::pending() {
            break;
        }
        let id = id(&mechanism).with_context(|| file.clone())?;
        if !store.has_drawn(&id, a.ideas)? {
            let row = drawn(mechanism, a.ideas, Spec::default().nodes);
            store.add_drawn(&row.with_context(|| file.clone())?)?;
            added += 1;
        }
        bar.step("mechanisms", i + 1, files.len());
    }
    bar.clear();
    let path = a.output.display();
    let interrupted =
        interrupt::pending().then(|| format!("the same command carries on with {path}."));
    built(&store, &a.output, (added, "mechanisms"), interrupted)
}
