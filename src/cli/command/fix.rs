//! `ozols fix`.

use crate::api::{self, MAX_DESCRIPTION_BYTES};
use crate::cli::Done;
use crate::cli::command::import::{Reading, description};
use crate::cli::command::lint;
use crate::cli::option::request::Which;
use crate::cli::option::variant;
use crate::cli::option::variant::Chosen;
use crate::cli::terminal::output;
use crate::cli::terminal::progress::note;
use crate::format::phrase::plural;
use crate::model::mechanism::JointId;
use crate::redundancy::analysis::StateAnalysis;
use crate::redundancy::release::{Release, added};
use crate::robots::{self, Imported};
use crate::view::robots::lint::words;
use crate::view::terminal::layout::fit;
use anyhow::{Context, bail, ensure};
use clap::{Args as ClapArgs, ValueHint};
use std::path::{Path, PathBuf};

#[derive(Debug, ClapArgs)]
pub(in crate::cli) struct Fix {
    /// A robot description: URDF, MJCF or SDF.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    #[command(flatten)]
    reading: Reading,
    /// A joint, loop or coupling that may be changed (repeatable); by default all but drives.
    #[arg(long, value_name = "NAME", conflicts_with = "chosen")]
    at: Vec<String>,
    #[command(flatten)]
    chosen: Chosen,
    #[command(flatten)]
    which: Which,
    /// Write to a file instead of standard output. Beside the description, so that its meshes and includes are found.
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// What is to be done, and the W and σ that are to come of it.
struct Plan {
    releases: Vec<Release>,
    mobility: usize,
    redundant: usize,
}

pub(in crate::cli) fn run(a: &Fix) -> anyhow::Result<Done> {
    let options = a.reading.options()?;
    let imported = description(&a.file, &options)?;
    let m = &imported.mechanism;
    let bytes = api::bytes(&a.file, MAX_DESCRIPTION_BYTES)?;
    let (before, plan) = match a.chosen.place() {
        Some(k) => of_search(&imported, a, k)?,
        None => cheapest(&imported, &a.at)?,
    };
    let told = |release: &Release| (*release, words(m, release));
    let releases: Vec<(Release, String)> = plan.releases.iter().map(told).collect();
    let edited = robots::fix(&imported, &releases)?;
    // The byte order mark is no part of the text.
    let mark = if bytes.starts_with("\u{feff}".as_bytes()) {
        "\u{feff}"
    } else {
        ""
    };
    let text = format!("{mark}{edited}");
    let again = api::description_of(&a.file, text.as_bytes(), &options).context(
        "the edited file cannot be read again; nothing is written; report this with the file",
    )?;
    let found = lint::look(&again.mechanism, Some(&again.origin))?;
    let (lasting, after) = (found.lasting, found.analysis);
    ensure!(
        (after.mobility, after.redundant) == (plan.mobility, plan.redundant),
        "read again, the edited file has W = {}, σ = {} where W = {}, σ = {} was to be; nothing is written",
        after.mobility,
        after.redundant,
        plan.mobility,
        plan.redundant
    );
    ensure!(
        a.chosen.place().is_some() || lasting == 0 || after.at_most().is_some(),
        "read again, the edited file has {lasting} redundant over its motion; nothing is written; look at another pose (--pose)"
    );
    output::to(a.output.as_deref(), |out| {
        out.write_all(text.as_bytes())?;
        Ok(Done::Found)
    })?;
    let mut lines = summary(&a.file, &releases, [&before, &after]);
    if after.redundant > lasting && after.at_most().is_none() {
        lines += &format!(
            "  {} redundant at this pose only, where the model is in a special place\n",
            after.redundant - lasting
        );
    }
    if let Some((_, most)) = after.at_most() {
        lines += &format!(
            "  as written; within their digits the coordinates leave open whether up to {most} stay redundant: look at other joints (--at), or give more digits\n"
        );
    }
    output::note(&fit(&lines, output::error_width()));
    Ok(Done::Found)
}

fn summary(
    file: &Path,
    releases: &[(Release, String)],
    [before, after]: [&StateAnalysis; 2],
) -> String {
    let file = file.display();
    if releases.is_empty() {
        let (w, sure) = (before.mobility, before.certainty.word());
        let redundant = match before.redundant {
            0 => "nothing is redundant".to_owned(),
            n => format!("{n} redundant"),
        };
        return format!("{file}: {redundant} (W = {w}, {sure}); written as it is\n");
    }
    let mut out = format!("{file}: {}\n", plural(releases.len(), "release"));
    for (_, words) in releases {
        out += &format!("  {words}\n");
    }
    let row = |name: &str, s: &StateAnalysis| {
        format!(
            "  {name:<7} rank {} of {} rows, W = {}, redundant {} ({})\n",
            s.rank,
            s.rows,
            s.mobility,
            s.redundant,
            s.certainty.word()
        )
    };
    out + &row("before:", before) + &row("after:", after)
}

/// The cheapest releases that remove all redundant constraints.
fn cheapest(imported: &Imported, at: &[String]) -> anyhow::Result<(StateAnalysis, Plan)> {
    let m = &imported.mechanism;
    let coupled = |q: usize| m.couplings[q].name(m);
    for name in at {
        let known = m.joints.iter().any(|j| j.id == *name)
            || (0..m.couplings.len()).any(|q| coupled(q) == *name);
        ensure!(
            known,
            "--at {name}: there is no such joint, loop or coupling; `ozols lint` names them"
        );
    }
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
        "what is redundant is not decided: coordinates are rounded too coarsely, or the pose is next to a special one; look at another pose (--pose), or give more digits (`ozols check` names the coordinates)"
    );
    let some = found.cheapest.len();
    if some < most {
        let of = if at.is_empty() {
            "that may be changed"
        } else {
            "of --at"
        };
        bail!(
            "the joints {of} remove {some} of {most} redundant constraints; `ozols lint` tells what removes each{}",
            if at.is_empty() {
                ", --at takes more joints"
            } else {
                ""
            }
        );
    }
    let releases = std::mem::take(&mut found.cheapest);
    let releases = releases.into_iter().map(|i| found.releases[i].1).collect();
    let plan = Plan {
        releases,
        mobility: found.analysis.mobility,
        // What is redundant at this pose only stays.
        redundant: found.analysis.redundant - most,
    };
    Ok((found.analysis, plan))
}

/// Those of a variant of the search. Where nothing is redundant there is nothing to mend: variants only let more move, and
/// are made where a mobility is asked for.
fn of_search(imported: &Imported, a: &Fix, k: usize) -> anyhow::Result<(StateAnalysis, Plan)> {
    let m = &imported.mechanism;
    let request = a.chosen.of(a.which.request(None)?);
    let before = api::analyze(m)?.remove(0);
    if before.redundant == 0 && before.at_most().is_none() && request.max_mobility.is_none() {
        note(format!(
            "nothing is redundant: variant {k} of the search would only let more move; --max-mobility makes it all the same"
        ));
        let plan = Plan {
            releases: Vec::new(),
            mobility: before.mobility,
            redundant: 0,
        };
        return Ok((before, plan));
    }
    // What is added is told against the mechanism as it is meant, which is the one that was searched.
    let (before_it, changed, w, sigma) = variant::kth(m.clone(), request, k, |v| {
        let searched = v.outcome().search.mechanism.clone();
        (searched, v.mechanism(), v.mobility(), v.redundant())
    })?;
    ensure!(
        changed.joints.len() == before_it.joints.len(),
        "variant {k} puts in joints that are not of one joint's kind; choose another"
    );
    let mut releases = Vec::new();
    for (i, (old, new)) in before_it.joints.iter().zip(&changed.joints).enumerate() {
        let all = added((&old.frame, &old.joint_type), (&new.frame, &new.joint_type))?;
        ensure!(
            old.joint_type.freedoms().len() + all.len() == new.joint_type.freedoms().len(),
            "variant {k} puts a joint in the place of \"{}\" that has not all of its freedoms; choose another",
            old.id
        );
        releases.extend(all.into_iter().map(|(slides, direction)| Release::Freedom {
            joint: JointId::new(i),
            slides,
            direction,
        }));
    }
    let plan = Plan {
        releases,
        mobility: usize::try_from(w)?,
        redundant: usize::try_from(sigma)?,
    };
    Ok((before, plan))
}
