//! `ozols catalog merge`.

use super::build::report_built;
use crate::catalog::store::{Merged, Store};
use crate::cli::prelude::*;
use crate::shard::Shard;

#[derive(Debug, ClapArgs)]
pub(crate) struct Merge {
    /// Parts to merge.
    #[arg(required = true, value_hint = ValueHint::FilePath)]
    parts: Vec<PathBuf>,
    /// Catalogue to write; an existing one is extended.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: PathBuf,
}

pub(super) fn run_merge(a: &Merge) -> anyhow::Result<Done> {
    a.parts
        .iter()
        .for_each(|part| output::kept::keep_file(part));
    ensure!(
        !output::kept::is_kept(&a.output),
        "{} is one of the parts and the whole; choose another name for the whole",
        a.output.display()
    );
    let mut well = true;
    let merged = Store::merge_parts(&a.output, &a.parts, |e| {
        well = false;
        output::print_error(&e.into());
    })?;
    if merged.taken == 0 {
        return Ok(Done::Partly);
    }
    let whole = &a.output;
    let store = Store::open_readonly(whole)?;
    report_built(&store, whole, merged.added)?;
    if !merged.missing.is_empty() {
        output::print_note(&describe_missing(&merged, whole));
    }
    Ok(match merged.missing.is_empty() {
        _ if !well => Done::Partly,
        true => Done::Found,
        false => Done::Nothing,
    })
}

/// Number of parts that are named one by one.
const NAMED: usize = 12;

/// Lists the missing parts of the whole, and how to make them.
fn describe_missing(merged: &Merged, whole: &Path) -> String {
    let mut out = String::new();
    for file in &merged.unfinished {
        out += &format!(
            "{} is not marked as complete; run the command that made it again, which adds what is missing\n",
            file.display()
        );
    }
    let whole = whole.display();
    let all = merged.missing.len();
    if merged.missing == [Shard::WHOLE] {
        return out + &format!("{whole} is not known to be complete\n");
    }
    let more = match all.saturating_sub(NAMED) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    let parts = merged.missing.iter().take(NAMED).join(", ");
    out + &format!(
        "{whole} is incomplete: of {} parts {parts}{more} {} missing; make them with `ozols \
        catalog build --shard`, and merge them into the same file\n",
        merged.missing[0].of,
        if all == 1 { "is" } else { "are" },
    )
}
