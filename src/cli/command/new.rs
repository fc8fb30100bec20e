//! `ozols new`.

use crate::builtin;
use crate::cli::command::list;
use crate::cli::prelude::*;
use crate::file::template;

#[derive(Debug, ClapArgs)]
pub(crate) struct New {
    /// File to write, with the ending .toml; the mechanism is named after it. If omitted, the built-in mechanisms are listed.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: Option<PathBuf>,
    /// Built-in mechanism to start from [default: four-bar].
    #[arg(long, value_name = "NAME", requires = "file")]
    from: Option<String>,
    /// Replace an existing file.
    #[arg(long, requires = "file")]
    force: bool,
}

pub(crate) fn run_new(args: &Global, a: &New) -> anyhow::Result<Done> {
    if let Some(file) = &a.file {
        let from = a.from.as_deref().unwrap_or("four-bar");
        return write(args, file, from, a.force);
    }
    let done = list::list_all()?;
    output::print_note("to start from one of these: ozols new mine.toml --from NAME\n");
    Ok(done)
}

fn write(args: &Global, file: &Path, from: &str, force: bool) -> anyhow::Result<Done> {
    let shown = file.display();
    let toml = file.extension().is_some_and(|e| e == "toml");
    // The name of a file may be any bytes; that of a mechanism is text.
    let stem = file.file_stem().map(|s| s.to_string_lossy());
    let Some(name) = stem.filter(|_| toml) else {
        let like = file.with_extension("toml");
        bail!(
            "{shown} does not end in .toml; name it {}, because only TOML has comments",
            like.display()
        );
    };
    let Some(text) = builtin::text(from) else {
        bail!(load::no_built_in(from));
    };
    // A link that leads nowhere is there, too.
    if !force && file.symlink_metadata().is_ok() {
        bail!("{shown} already exists; choose another name or use --force");
    }
    let text = template::with_comments(text, from, &name)
        .with_context(|| format!("built-in mechanism {from}"))?;
    output::write_bytes(Some(file), text)?;
    if args.quiet {
        return Ok(Done::Found);
    }
    let next = ["check", "analyze", "search"].map(|c| format!("  ozols {c} {shown}\n"));
    let head = format!("{shown}: the built-in {from} with comments\n");
    output::write_bytes(None, head + &next.concat())
}
