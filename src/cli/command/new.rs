//! `ozols new`.

use crate::builtin;
use crate::cli::option::{Global, load};
use crate::cli::terminal::{Done, output};
use crate::file::template;
use anyhow::{Context, bail};
use clap::{Args as ClapArgs, ValueHint};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct New {
    /// File to write, with the ending .toml; the mechanism is named after it.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Built-in mechanism to start from.
    #[arg(long, value_name = "NAME", default_value = "four-bar")]
    from: String,
    /// Replace an existing file.
    #[arg(long)]
    force: bool,
}

pub(in crate::cli) fn run(args: &Global, a: &New) -> anyhow::Result<Done> {
    let shown = a.file.display();
    let toml = a.file.extension().is_some_and(|e| e == "toml");
    // The name of a file may be any bytes; that of a mechanism is text.
    let stem = a.file.file_stem().map(|s| s.to_string_lossy());
    let Some(name) = stem.filter(|_| toml) else {
        let like = a.file.with_extension("toml");
        bail!(
            "{shown} does not end in .toml; name it {}, because only TOML has comments",
            like.display()
        );
    };
    let Some(text) = builtin::text(&a.from) else {
        bail!(load::no_built_in(&a.from));
    };
    // A link that leads nowhere is there, too.
    if !a.force && a.file.symlink_metadata().is_ok() {
        bail!("{shown} already exists; choose another name or use --force");
    }
    let text = template::commented(text, &a.from, &name)
        .with_context(|| format!("built-in mechanism {}", a.from))?;
    output::to(Some(&a.file), |out| {
        write!(out, "{text}")?;
        Ok(Done::Found)
    })?;
    if args.quiet {
        return Ok(Done::Found);
    }
    output::to(None, |out| {
        writeln!(out, "{shown}: the built-in {} with comments", a.from)?;
        writeln!(out, "  ozols check {shown}")?;
        writeln!(out, "  ozols analyze {shown}")?;
        writeln!(out, "  ozols search {shown}")?;
        Ok(Done::Found)
    })
}
