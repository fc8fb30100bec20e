//! `ozols man`.

use crate::cli::done::Done;
use crate::cli::terminal::output;
use anyhow::Context;
use clap::Args as ClapArgs;
use clap::Command;
use clap_mangen::roff::{Roff, roman};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Man {
    /// Write a page for the program and one for each command into this folder.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// An apostrophe that no formatter turns into a quotation mark.
const APOSTROPHE: &str = ".ie \\n(.g .ds Aq \\(aq\n.el .ds Aq '\n";

pub(in crate::cli) fn run(a: &Man, program: Command) -> anyhow::Result<Done> {
    let mut main = program.disable_help_subcommand(true);
    main.build();
    let Some(folder) = &a.output else {
        let page = page(&main)?;
        return output::to(None, |out| {
            out.write_all(page.as_bytes())?;
            Ok(Done::Found)
        });
    };
    std::fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for command in std::iter::once(&main).chain(main.get_subcommands()) {
        let page = page(command)?;
        let path = folder.join(format!("{}.1", name(command)));
        output::to(Some(&path), |out| {
            out.write_all(page.as_bytes())?;
            Ok(Done::Found)
        })?;
    }
    Ok(Done::Found)
}

/// `ozols`, or `ozols-search` for a command of it.
fn name(command: &Command) -> &str {
    command
        .get_display_name()
        .unwrap_or_else(|| command.get_name())
}

/// The page of a command, what stands after its help kept line by line.
fn page(command: &Command) -> std::io::Result<String> {
    let man = clap_mangen::Man::new(command.clone())
        .source(concat!("ozols ", env!("CARGO_PKG_VERSION")))
        .manual("ozols manual");
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_description_section(&mut page)?;
    man.render_options_section(&mut page)?;
    if command.has_subcommands() {
        man.render_subcommands_section(&mut page)?;
    }
    let after = command.get_after_help().map(ToString::to_string);
    let after = after.unwrap_or_default();
    let (notes, examples) = after.split_once("Examples:\n").unwrap_or((&after, ""));
    for (heading, text) in [("NOTES", notes), ("EXAMPLES", examples)] {
        if text.trim().is_empty() {
            continue;
        }
        let mut roff = Roff::new();
        roff.control("SH", [heading]);
        roff.control("nf", []);
        for line in text.trim_end().lines() {
            roff.text([roman(line)]);
        }
        roff.control("fi", []);
        roff.to_writer(&mut page)?;
    }
    // Each section comes with a definition of the apostrophe; one is enough, and the title goes before it.
    let page = String::from_utf8_lossy(&page).replace(APOSTROPHE, "");
    let (title, rest) = page.split_once('\n').unwrap_or((&page, ""));
    Ok(format!("{title}\n{APOSTROPHE}{rest}"))
}
