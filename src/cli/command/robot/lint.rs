//! `ozols lint`.

use crate::cli::command::robot::types;
use crate::cli::option::reading::{Reading, import_description};
use crate::cli::prelude::*;
use crate::file::problem::ImportError;
use crate::file::text::mechanism_from_bytes;
use crate::motion::pose::Pose;
use crate::rank::method::Certainty;
use crate::redundancy::duplicate_constraints::{HeldTwice, held_twice};
use crate::redundancy::other_poses::Where;
use crate::robots::{self, Origin};
use crate::view::lint::{self, Lint as Found, PassedOver};

#[derive(Debug, ClapArgs)]
pub(crate) struct Lint {
    /// Robot descriptions (URDF, MJCF, SDF), CAD assemblies (FreeCAD, OndselSolver), or mechanism files.
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath, required = true)]
    files: Vec<Named>,
    #[command(flatten)]
    reading: Reading,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextOrJson,
    #[command(flatten)]
    to: ToFile,
}

pub(crate) fn run_lint(a: &Lint) -> anyhow::Result<Done> {
    let mut failed = false;
    let all = lint_all(a, &mut |e| {
        failed = true;
        output::print_error(e);
    })?;
    a.to.write_all_of(match a.format {
        TextOrJson::Text => lint_text(a, &all),
        TextOrJson::Json => output::json_text(&lint_json(&all))?,
    })?;
    Ok(match all.iter().flatten().all(Found::is_in_order) {
        _ if failed => Done::Partly,
        in_order => Done::found_or_nothing(in_order),
    })
}

/// Examines each file. `tell` is called with what is wrong with a file; the others are examined nevertheless.
fn lint_all(
    a: &Lint,
    tell: &mut dyn FnMut(&anyhow::Error),
) -> anyhow::Result<Vec<Result<Found, PassedOver>>> {
    let options = a.reading.import_options()?;
    let one = |file: &Named| lint_file(file, &options).map_err(|e| passed_over(file, &e, tell));
    Ok(a.files.iter().map(one).collect())
}

fn lint_json(all: &[Result<Found, PassedOver>]) -> serde_json::Value {
    let found: Vec<&Found> = all.iter().flatten().collect();
    let others = all.iter().filter_map(|f| f.as_ref().err().cloned());
    lint::lint_json(&found, &others.collect::<Vec<_>>())
}

/// Returns a paragraph on each file, and how to fix those that can be fixed.
fn lint_text(a: &Lint, all: &[Result<Found, PassedOver>]) -> String {
    let width = a.to.width();
    let paragraph = |file: &Result<Found, PassedOver>| {
        let (text, verdict) = match file {
            Err(passed) => (passed.text(), passed.rigid.then_some(Tone::Good)),
            Ok(lint) if !lint.is_clean() => (lint.text(), Some(Tone::Bad)),
            Ok(lint) if lint.left_out > 0 => (lint.text(), Some(Tone::Doubtful)),
            Ok(lint) => (lint.text(), Some(Tone::Good)),
        };
        let words = match file {
            Ok(lint) if !lint.is_clean() => lint.sigma_words(),
            _ => lint::NONE.to_owned(),
        };
        colour_verdicts(
            fit_lines(&text, width),
            a.to.path(),
            verdict.map(|tone| (words, tone)),
        )
    };
    let fixed = all
        .iter()
        .flatten()
        .filter(|l| l.from_description && l.is_decided() && !l.cheapest.is_empty());
    let gives = "apply the cheapest fix; all else stays unchanged";
    let flags = a.reading.typed_flags();
    let steps = fixed
        .map(|l| NextCommand::fix_command(&l.file, &flags, gives))
        .collect_vec();
    all.iter().map(paragraph).collect::<String>() + &next_commands::steps_text(&steps, width)
}

/// Examines one file.
fn lint_file(file: &Named, options: &robots::Options) -> anyhow::Result<Found> {
    let (mechanism, imported) = if robots::is_description(file) && file.path().is_file() {
        let imported = import_description(file.path(), options)?;
        (imported.mechanism.clone(), Some(imported))
    } else {
        ensure!(
            options.loops.is_none(),
            load::unsuited_option("--loops", file)
        );
        let (name, bytes) = load::read_plain(file)?;
        (mechanism_from_bytes(&name, &bytes)?, None)
    };
    let found = find_duplicates(&mechanism, imported.as_ref().map(|i| &i.origin))?;
    let out = Found::new(file, &mechanism, imported.as_ref(), &found);
    let exact = !matches!(
        found.analysis.certainty,
        Certainty::Numeric { .. } | Certainty::Undecided { .. }
    );
    let assembly = imported.map(|i| i.origin).filter(Origin::is_assembly);
    Ok(match assembly {
        Some(origin) if !out.is_clean() => {
            out.with_changes(types::find_changes(&mechanism, &origin, exact))
        }
        _ => out,
    })
}

/// Records a skipped file, and reports at once if something is wrong with it.
fn passed_over(file: &str, e: &anyhow::Error, tell: &mut dyn FnMut(&anyhow::Error)) -> PassedOver {
    let rigid = output::file_problems(e).is_some_and(ImportError::is_rigid);
    if !rigid {
        tell(e);
    }
    PassedOver::new(file, &format!("{e:#}"), rigid)
}

/// Finds the redundant constraints of a mechanism. Drives, and joints that no format can change, stay unchanged.
pub(crate) fn find_duplicates(m: &Mechanism, origin: Option<&Origin>) -> anyhow::Result<HeldTwice> {
    look_at(m, origin, &|r| match *r {
        Release::Freedom { joint, .. } => !is_actuated(m, origin, joint),
        Release::Coupling(_) => true,
    })
}

/// Returns true if a joint is a drive, or is moved by an actuator that a mechanism cannot represent.
pub(crate) fn is_actuated(m: &Mechanism, origin: Option<&Origin>, joint: JointId) -> bool {
    m.joints[joint].drive || origin.is_some_and(|o| o.is_actuated(joint))
}

/// Finds the redundant constraints, with only the given releases.
pub(crate) fn look_at(
    m: &Mechanism,
    origin: Option<&Origin>,
    wanted: &dyn Fn(&Release) -> bool,
) -> anyhow::Result<HeldTwice> {
    let closes = |j: JointId| origin.is_some_and(|o| o.closes(j));
    let written = |r: &Release| match *r {
        Release::Freedom {
            joint,
            slides,
            direction,
        } => origin.is_none_or(|o| o.can_be_freed(joint, (slides, direction))),
        Release::Coupling(_) => origin.is_none_or(|o| !o.is_assembly()),
    };
    let inside = |pose: &Pose| origin.is_none_or(|o| o.is_inside(pose));
    let may = |r: &Release| written(r) && wanted(r);
    if !origin.is_some_and(Origin::is_of_this_pose) {
        return Ok(held_twice(m, &closes, &may, Some(&inside))?);
    }
    let mut found = held_twice(m, &closes, &may, None)?;
    found.over = (found.lasting > 0).then_some(Where::Unknown);
    Ok(found)
}
