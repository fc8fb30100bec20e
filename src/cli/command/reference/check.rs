//! `ozols check`, `show`, `schema` and `completions`.

use crate::cli::prelude::*;
use crate::file::lint::check_file;
use crate::file::locate::DocumentPath;
use crate::file::problem::Warnings;
use crate::file::read::workload::tables_alone;
use crate::grip::jaw_loads::{Gripping, JawError};
use crate::model::mechanism::Expected;
use crate::view::analysis::link_motions::drive_fault;
use crate::view::analysis::mechanism::describe_mechanism;
use crate::view::search::variant;

/// Name of the table of costs for `show`; no built-in mechanism has this name.
const COSTS: &str = "costs";

#[derive(Debug, ClapArgs)]
pub(crate) struct Show {
    /// Name of a built-in mechanism, or `costs` for the table of default costs that --costs takes.
    #[arg(value_name = "NAME")]
    name: String,
}

pub(crate) fn run_check(args: &Global, a: &File) -> anyhow::Result<Done> {
    let (name, bytes) = load::read_named(a)?;
    if let Some((name, tables)) = tables_alone(&name, &bytes)? {
        let tables = tables.join(", ");
        return output::write_bytes(None, format!("{name}: workload {tables}: valid\n"));
    }
    let mut checked = check_file(&name, &bytes)?;
    for state in checked.mechanism.state_ids() {
        match Gripping::new(&checked.mechanism, state) {
            // What cannot be held is for `ozols grip` to say; the file is valid.
            Ok(_) | Err(JawError::Nominal(_)) => {}
            Err(e) => return Err(e).with_context(|| format!("{name}: [workload.grip]")),
        }
    }
    warn_of_stale(&checked.mechanism, &mut checked.warnings);
    warn_of_drives(&checked.mechanism, &mut checked.warnings);
    let (m, warnings) = (&checked.mechanism, &checked.warnings);
    let (verdict, tone) = match warnings.warnings.len() {
        0 => ("valid".to_owned(), Tone::Good),
        n => (
            format!("valid, {}", count_noun(n, "warning")),
            Tone::Doubtful,
        ),
    };
    let head = fit_lines(
        &format!("{}: {verdict}\n", m.name),
        output::output_width(None),
    );
    output::write_bytes(None, colour_verdicts(head, None, [(verdict, tone)]))?;
    if !warnings.warnings.is_empty() && !args.quiet {
        output::coloured_note(&warnings.render(true));
    }
    let lines = describe_mechanism(m).into_iter();
    let tables = checked.tables.iter();
    let tables = tables.map(|table| format!("workload {table}: for `ozols {table}`"));
    let lines = lines.chain(tables).map(|line| format!("  {line}\n"));
    output::write_bytes(
        None,
        fit_lines(&lines.collect::<String>(), output::output_width(None)),
    )
}

/// Prints what to do next with a file.
pub(crate) fn tell_next(file: &str) -> anyhow::Result<Done> {
    let next = [
        ("analyze", "Show what is redundant, and where"),
        ("search", "Find the redesigns that remove it"),
        ("studio", "Draw and change it in the browser"),
    ];
    let next = next.map(|(command, gives)| NextCommand::new(command, file, "", gives));
    output::write_bytes(
        None,
        next_commands::steps_text(&next, output::output_width(None)),
    )
}

/// Warns of faults of the drives, in the words of `ozols analyze`.
fn warn_of_drives(m: &Mechanism, warnings: &mut Warnings) {
    let Some(first) = m.joints.iter().position(|j| j.drive) else {
        return;
    };
    // Why there is no analysis is for `ozols analyze` to say.
    let found = analyse_states(m, &[StateId::FREE], Method::Auto).unwrap_or_default();
    let faults = found.iter().flat_map(|s| &s.drives);
    let faults = faults.map(|fault| {
        let (_, joint, what) = drive_fault(m, fault);
        let joint = joint.and_then(|id| m.joints.iter().position(|j| j.id == id));
        let path = DocumentPath::root_key("joint").entry_at(joint.unwrap_or(first));
        (path.key("drive"), what.into())
    });
    warnings.add(faults.collect());
}

/// A key, the figure that the file states, and what the analysis finds.
type StatedFigure = (&'static str, Option<i64>, Option<i64>);

/// Returns the figures that a file can state of a state, in the order of their warnings.
fn stated_figures(e: &Expected, found: &StateAnalysis) -> [StatedFigure; 6] {
    let int = |n: usize| i64::try_from(n).ok();
    // A range is at odds with a figure only outside it.
    let finite = e.finite_mobility.filter(|&w| found.finite.could_be(w));
    let external = found.external.map(|x| x.by_rank);
    let finite = finite.or(int(found.finite.mobility));
    let [working, local] = [found.working_mobility, found.local_mobility].map(int);
    [
        ("mobility", e.mobility, int(found.mobility)),
        ("finite_mobility", e.finite_mobility, finite),
        ("working_mobility", e.working_mobility, working),
        ("local_mobility", e.local_mobility, local),
        ("redundant", e.redundant, int(found.redundant)),
        ("external_redundant", e.external_redundant, external),
    ]
}

/// Warns of the figures that the file states where the analysis finds others.
fn warn_of_stale(m: &Mechanism, warnings: &mut Warnings) {
    let mut stale = Vec::new();
    for (i, e) in m.expected.iter().enumerate() {
        let Some(s) = m.state_named(&e.state) else {
            continue;
        };
        // Why there is no analysis is for `ozols analyze` to say.
        let Ok(found) = analyse_states(m, &[s], Method::Auto) else {
            continue;
        };
        // What is not decided is not at odds with a figure.
        let Some(found) = found.first().filter(|f| f.at_most().is_none()) else {
            continue;
        };
        for (key, stated, found) in stated_figures(e, found) {
            let (Some(stated), Some(found)) = (stated, found) else {
                continue;
            };
            if stated != found {
                let path = DocumentPath::root_key("expected").entry_at(i).key(key);
                let message = format!(
                    "the file states {key} = {stated} in state {}, but the analysis finds {found}; correct the figure, or delete [[expected]] if the mechanism differs from the published one",
                    e.state
                );
                stale.push((path, message.into()));
            }
        }
    }
    warnings.add(stale);
}

pub(crate) fn run_show(a: &Show) -> anyhow::Result<Done> {
    let costs = (a.name == COSTS).then(variant::costs_toml);
    let Some(text) = costs.as_deref().or_else(|| builtin::text(&a.name)) else {
        bail!(load::no_built_in(&a.name))
    };
    output::write_bytes(None, text)
}

pub(crate) fn print_schema() -> anyhow::Result<Done> {
    output::write_bytes(None, format!("{:#}\n", crate::file::schema::json_schema()))
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Completions {
    /// Shell to complete for.
    #[arg(value_enum, value_name = "SHELL")]
    shell: clap_complete::Shell,
}

pub(crate) fn print_completions(
    a: &Completions,
    mut program: clap::Command,
) -> anyhow::Result<Done> {
    // The generator panics where it cannot write, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(a.shell, &mut program, "ozols", &mut script);
    output::write_bytes(None, script)
}
