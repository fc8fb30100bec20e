//! `ozols catalog search`.

use super::build::report_built;
use crate::builtin;
use crate::catalog::drawn::{DrawnMechanism, id, search_drawn};
use crate::catalog::spec::Spec;
use crate::catalog::store::Store;
use crate::cli::prelude::*;

#[derive(Debug, ClapArgs)]
pub(crate) struct SearchDrawn {
    /// Mechanism files, robot files, or names of built-in mechanisms. Each is searched with its own options and workload.
    #[arg(value_hint = ValueHint::FilePath)]
    files: Vec<Named>,
    #[command(flatten)]
    loops: Loops,
    /// Include all built-in grippers.
    #[arg(long)]
    grippers: bool,
    /// Number of ideas kept per mechanism.
    #[arg(long, value_name = "K", default_value_t = Spec::default().ideas)]
    ideas: usize,
    /// Database to write; an existing one is extended.
    #[arg(long, short, value_name = "FILE", value_hint = ValueHint::FilePath)]
    output: PathBuf,
}

pub(super) fn run_search_drawn(args: &Global, a: &SearchDrawn) -> anyhow::Result<Done> {
    let mut files = a.files.clone();
    if a.grippers {
        files.extend(builtin::grippers().into_iter().map(Named::from));
    }
    ensure!(
        !files.is_empty(),
        "nothing to search; name a FILE, or use --grippers for all built-in grippers"
    );
    // Wrong files are told before any is searched, and the others are searched.
    let (mechanisms, mut well) = load::load_each(&files, &a.loops);
    if mechanisms.is_empty() {
        return Ok(Done::Partly);
    }
    let of = mechanisms.len();
    let mut store = Store::open_writable(&a.output)?;
    let mut added = 0;
    interrupt::be_patient();
    let mut bar = Bar::new(args.quiet);
    for (i, (file, mechanism)) in mechanisms.into_iter().enumerate() {
        if interrupt::is_pending() {
            break;
        }
        match search_one_drawn(&store, mechanism, a.ideas) {
            Ok(None) => {}
            Ok(Some(row)) => {
                store.add_drawn(&row)?;
                added += 1;
            }
            Err(e) => {
                well = false;
                output::print_error(&e.context(file.to_string()));
            }
        }
        bar.show_step("mechanisms", i + 1, of);
    }
    bar.clear();
    let done = report_built(&store, &a.output, added, "mechanisms")?;
    Ok(if well { done } else { Done::Partly })
}

/// Searches a mechanism. Returns `None` if the catalogue has it already.
fn search_one_drawn(
    store: &Store,
    m: Mechanism,
    ideas: usize,
) -> anyhow::Result<Option<DrawnMechanism>> {
    if store.has_drawn(&id(&m)?, ideas)? {
        return Ok(None);
    }
    Ok(Some(search_drawn(m, ideas, Spec::default().nodes)?))
}
