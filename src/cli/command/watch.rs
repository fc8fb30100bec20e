//! `ozols watch`.

mod changes;

use crate::cli::command::report::{self, Report};
use crate::cli::done::Done;
use crate::cli::option::global::Global;
use crate::cli::option::load;
use crate::cli::terminal::interrupt;
use crate::cli::terminal::output;
use crate::cli::terminal::spinner;
use crate::file::lint::check;
use anyhow::ensure;
use changes::Changes;
use clap::Args as ClapArgs;
use std::path::Path;

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Watch {
    #[command(flatten)]
    report: Report,
}

pub(in crate::cli) fn run(args: &Global, a: &Watch) -> anyhow::Result<Done> {
    let file = a.report.file.file.clone();
    let path = file.path();
    ensure!(
        path.is_file(),
        "{file} is no file that could change; write one: `ozols new mine.toml`, or `ozols new mine.toml --from NAME` for a \
         copy of a built-in mechanism"
    );
    let page = match &a.report.output {
        Some(page) => page.clone(),
        None => path.with_extension("html"),
    };
    ensure!(
        page != Path::new("-"),
        "the page is written again and again: give a file with -o"
    );
    output::kept::keep(path);
    output::kept::apart(&page)?;
    let costs = a.report.checked.which.costs.as_deref();
    let mut changes = Changes::new([Some(path), costs].into_iter().flatten())?;
    loop {
        changes.take();
        look(args, &a.report, &page);
        if interrupt::exit_code().is_some() {
            return Ok(Done::Found);
        }
        changes.wait()?;
    }
}

/// Looks at the file as it is now; what is wrong with it is told, and may be mended.
fn look(args: &Global, a: &Report, page: &Path) {
    let file = &a.file.file;
    // Each look is a command of its own, which writes the page once.
    output::kept::begin();
    if !args.quiet
        && let Ok((name, bytes)) = load::named(&a.file)
        && let Ok(checked) = check(&name, &bytes)
        && !checked.warnings.warnings.is_empty()
    {
        output::coloured_note(&checked.warnings.render(true));
    }
    let written = report::write(args, a, Some(page), true);
    // From here on there is nothing to wait for: whoever is told so may end it.
    interrupt::be_impatient();
    match written {
        // What was cut short is told of where it is written.
        Ok(verdict) if interrupt::exit_code().is_some() => {
            output::note(&format!("{file}: {verdict}\n"));
        }
        Ok(verdict) => {
            output::note(&format!("{file}: {verdict}\n  {} is new\n", page.display()));
        }
        Err(e) => {
            output::complain(&e);
            output::note(&format!(
                "  {} stays as it was until {file} is mended\n",
                page.display()
            ));
        }
    }
    spinner::rest();
}
