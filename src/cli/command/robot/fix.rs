//! `ozols fix`.

use crate::cli::command::robot::types::{TypePlan, plan_variant};
use crate::cli::command::robot::{lint, types};
use crate::cli::option::reading::{Reading, import_description};
use crate::cli::option::request::Which;
use crate::cli::option::variant::{Chosen, print_note};
use crate::cli::prelude::*;
use crate::robots::{self, Imported};
use crate::view::lint::{TypeChange, describe_release};

#[derive(Debug, ClapArgs)]
pub(crate) struct Fix {
    /// Robot description (URDF, MJCF or SDF) or CAD assembly (FreeCAD, OndselSolver) whose joints get other types.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    #[command(flatten)]
    reading: Reading,
    /// Joint, loop or coupling that may be changed (repeatable) [default: all except drives].
    #[arg(long, value_name = "NAME", conflicts_with = "chosen")]
    at: Vec<String>,
    #[command(flatten)]
    chosen: Chosen,
    #[command(flatten)]
    which: Which,
    /// Write to a file instead of standard output. Put it next to the description, so that its meshes and includes are found.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(crate) fn run_fix(a: &Fix) -> anyhow::Result<Done> {
    let lines = fix_file(a)?;
    if output::is_caught() {
        return output::write_bytes(None, lines);
    }
    output::print_note(&fit_lines(&lines, output::error_width()));
    Ok(Done::Found)
}

/// Writes the file without its redundant constraints, and returns a summary of the changes.
fn fix_file(a: &Fix) -> anyhow::Result<String> {
    let options = a.reading.import_options()?;
    let imported = import_description(&a.file, &options)?;
    let m = &imported.mechanism;
    let bytes = api::bytes(&a.file, MAX_DESCRIPTION_BYTES)?;
    let (before, plan) = match a.chosen.list_place() {
        Some(k) => of_search(&imported, a, k)?,
        None if imported.origin.is_assembly() => other_types(&imported, a)?,
        None => plan_cheapest(&imported, &a.at)?,
    };
    let told = |release: &Release| (*release, describe_release(m, release));
    let releases: Vec<(Release, String)> = plan.releases.iter().map(told).collect();
    let edited = robots::apply_releases(&imported, &releases)?;
    let retyped = types::name_changes(m, &imported.origin, &plan.releases);
    // The byte order mark is no part of the text.
    let mark = "\u{feff}".as_bytes();
    let mark = if bytes.starts_with(mark) { mark } else { b"" };
    let text = [mark, &edited].concat();
    let again = api::description_of(&a.file, &text, &options).context(
        "the edited file cannot be read again; nothing was written; report this with the file",
    )?;
    let found = lint::find_duplicates(&again.mechanism, Some(&again.origin))?;
    let (lasting, after) = (found.lasting, found.analysis);
    as_planned(a, &plan, &after, lasting)?;
    output::write_bytes(a.output.as_deref(), text)?;
    let told = match retyped {
        Some(all) => all.iter().map(TypeChange::describe_change).collect(),
        None => releases
            .into_iter()
            .map(|(_, words)| words)
            .collect::<Vec<_>>(),
    };
    let what = if imported.origin.is_assembly() {
        "new joint type"
    } else {
        "release"
    };
    Ok(describe_changes(&a.file, &told, what, [&before, &after])
        + &describe_limits(&imported, &after, lasting))
}

/// Refuses an edited file that is not what was planned; `lasting` of what is redundant in it stays so over its motion.
fn as_planned(
    a: &Fix,
    plan: &TypePlan,
    after: &StateAnalysis,
    lasting: usize,
) -> anyhow::Result<()> {
    ensure!(
        (after.mobility, after.redundant) == (plan.mobility, plan.redundant),
        "the edited file has W = {}, σ = {} when read again, but W = {}, σ = {} was expected; nothing was written",
        after.mobility,
        after.redundant,
        plan.mobility,
        plan.redundant
    );
    ensure!(
        a.chosen.list_place().is_some() || lasting == 0 || after.at_most().is_some(),
        "the edited file still has {lasting} redundant over its motion when read again; nothing was written; try another pose (--pose)"
    );
    Ok(())
}

/// Returns the limits of the figures of the edited file, a line each.
fn describe_limits(imported: &Imported, after: &StateAnalysis, lasting: usize) -> String {
    let mut lines = String::new();
    if after.redundant > lasting && after.at_most().is_none() {
        lines += &format!(
            "  {} redundant at this pose only, because the model is in a special position\n",
            after.redundant - lasting
        );
    }
    if let n @ 1.. = imported.report.left_out {
        lines += &format!(
            "  {} of FILE omitted, which may be redundant and lower W; `ozols lint` lists them\n",
            count_noun(n, "row")
        );
    }
    if imported.origin.is_of_this_pose() {
        lines += "  figures hold in the pose of the file only, because joints are open there or have the freedoms of that pose; `ozols lint OUT --assemble` closes them\n";
    }
    if let Some((_, most)) = after.at_most() {
        lines += &format!(
            "  as written; within their digits the coordinates leave open whether up to {most} stay redundant; try other joints (--at), or give more digits\n"
        );
    }
    lines
}

fn describe_changes(
    file: &Path,
    told: &[String],
    what: &str,
    [before, after]: [&StateAnalysis; 2],
) -> String {
    let file = file.display();
    if told.is_empty() {
        let (w, sure) = (before.mobility, before.certainty.as_word());
        let redundant = match before.redundant {
            0 => "nothing is redundant".to_owned(),
            n => format!("{n} redundant"),
        };
        return format!("{file}: {redundant} (W = {w}, {sure}); written unchanged\n");
    }
    let n = told.len();
    let mut out = format!("{file}: {}\n", count_noun(n, what));
    for words in told {
        out += &format!("  {words}\n");
    }
    let row = |name: &str, s: &StateAnalysis| {
        format!(
            "  {name:<7} rank {} of {} rows, W = {}, redundant {} ({})\n",
            s.rank,
            s.rows,
            s.mobility,
            s.redundant,
            s.certainty.as_word()
        )
    };
    out + &row("before:", before) + &row("after:", after)
}

/// Checks that everything that may be changed exists.
fn check_names(m: &Mechanism, at: &[String]) -> anyhow::Result<()> {
    let coupled = |q: usize| m.couplings[q].name(m);
    for name in at {
        let known = m.joints.iter().any(|j| j.id == *name)
            || (0..m.couplings.len()).any(|q| coupled(q) == *name);
        ensure!(
            known,
            "--at {name}: no such joint, loop or coupling; `ozols lint` names them"
        );
    }
    Ok(())
}

/// Returns the cheapest releases that remove all redundant constraints.
fn plan_cheapest(imported: &Imported, at: &[String]) -> anyhow::Result<(StateAnalysis, TypePlan)> {
    let m = &imported.mechanism;
    let coupled = |q: usize| m.couplings[q].name(m);
    check_names(m, at)?;
    let wanted = |r: &Release| match *r {
        Release::Coupling(q) => at.is_empty() || at.contains(&coupled(q)),
        Release::Freedom { joint, .. } if at.is_empty() => {
            !lint::is_actuated(m, Some(&imported.origin), joint)
        }
        Release::Freedom { joint, .. } => at.contains(&m.joints[joint].id),
    };
    let mut found = lint::look_at(m, Some(&imported.origin), &wanted)?;
    let most = found.lasting;
    ensure!(
        found.analysis.at_most().is_none(),
        "redundancy is undecided, because coordinates are rounded too coarsely or the pose is next to a special one; try another pose (--pose), or give more digits (`ozols check` names the coordinates)"
    );
    let some = found.cheapest.len();
    if some < most {
        let of = if at.is_empty() {
            "that may be changed"
        } else {
            "of --at"
        };
        bail!(
            "the joints {of} remove {some} of {most} redundant constraints; `ozols lint` lists what removes each{}",
            if at.is_empty() {
                ", --at takes more joints"
            } else {
                ""
            }
        );
    }
    let releases = std::mem::take(&mut found.cheapest);
    let releases = releases.into_iter().map(|i| found.releases[i].1).collect();
    let plan = TypePlan {
        releases,
        mobility: found.analysis.mobility,
        // What is redundant at this pose only stays.
        redundant: found.analysis.redundant - most,
    };
    Ok((found.analysis, plan))
}

/// Returns the releases of a variant of the search. If nothing is redundant, variants only add mobility; they are applied if a
/// mobility is asked for.
fn of_search(imported: &Imported, a: &Fix, k: usize) -> anyhow::Result<(StateAnalysis, TypePlan)> {
    let m = &imported.mechanism;
    let request = a.chosen.list_request(a.which.request(None)?);
    let before = api::analyze(m)?.remove(0);
    if before.redundant == 0 && before.at_most().is_none() && request.max_mobility.is_none() {
        print_line(format!(
            "nothing is redundant, so {} {k} of the search would only add mobility; use --max-mobility to apply it nevertheless",
            request.noun_of_one()
        ));
        let plan = TypePlan::unchanged(before.mobility);
        return Ok((before, plan));
    }
    Ok((before, plan_variant(m, request, k, print_note)?))
}

/// Returns the first idea of the search among the types that the CAD program has, at the joints that may be changed.
fn other_types(imported: &Imported, a: &Fix) -> anyhow::Result<(StateAnalysis, TypePlan)> {
    let mut m = imported.mechanism.clone();
    let before = api::analyze(&m)?.remove(0);
    if before.redundant == 0 && before.at_most().is_none() {
        let plan = TypePlan::unchanged(before.mobility);
        return Ok((before, plan));
    }
    check_names(&m, &a.at)?;
    for joint in m
        .edit()
        .joints
        .iter_mut()
        .filter(|j| !a.at.is_empty() && !a.at.contains(&j.id))
    {
        joint.options.truncate(1);
    }
    let request = a.which.request(None)?;
    let plan = types::plan_first_idea(&m, request, print_note).context(
        "no choice of joint types removes all redundant constraints and keeps the output motion; `ozols search` explains why",
    )?;
    Ok((before, plan))
}
