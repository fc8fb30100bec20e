//! `ozols statics`.

use crate::cli::prelude::*;
use crate::file::read::workload::motion::parse_stroke;
use crate::grip::clamped::clamped_reactions;
use crate::grip::clamping::DiameterRow;
use crate::grip::jaw_loads::{Gripping, JawError};
use crate::model::loads::{Accuracy, Tolerances};
use crate::statics::contour_group::solutions::GroupMethod;
use crate::statics::cycle;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::contact::object_at;
use crate::statics::reactions::misfit::misfit;
use crate::statics::solve::{Model, SolvedReactions, StaticsError, solve_reactions};
use crate::view::grip::clamped::NotHeld;
use crate::view::reactions::misfit::MisfitView;
use crate::view::statics::Structures;
use crate::view::statics::charts::cycle_charts;
use crate::view::statics::told::{ToldReactions, ToldStatics};
use args::{Statics, StaticsMethod};

pub(crate) mod args;

pub(crate) fn run_statics(args: &Global, a: &Statics) -> anyhow::Result<Done> {
    let mut m = load::load_mechanism(&a.file)?;
    if a.planar {
        load::put_in_plane(&mut m)?;
    }
    let state = load::find_state(&m, &a.state)?;
    match Gripping::new(&m, state) {
        // The nominal part is out of reach, so nothing is held.
        Err(JawError::Nominal(why)) => {
            a.write_text(format!("{}: the part cannot be held: {why}\n", m.name))?;
            return Ok(Done::Nothing);
        }
        found => match found? {
            Some(gripping) if a.groups => return run_groups(&gripping.mechanism, state, a),
            Some(gripping) => return run_clamped(&gripping, a),
            None => {}
        },
    }
    if let Some(diameter) = a.diameter {
        bail!(
            "--diameter {diameter}: no grip loads state {} of {}; give [workload.grip] contacts, and --state one that has them",
            a.state,
            m.name
        );
    }
    if a.groups {
        return run_groups(&m, state, a);
    }
    if let Some(tolerances) = a.misfit {
        return run_misfit(&m, state, tolerances, a, args.seed);
    }
    let stroke = match &a.stroke {
        Some(text) => Some(parse_stroke(text)?),
        None => m.loads.stroke,
    };
    let own = matches!(a.method, StaticsMethod::Delta | StaticsMethod::Projective);
    let model = chosen_model(&m, state, own, a)?;
    let found = match solve_reactions(&m, state, stroke, model) {
        // Not held is an answer, and no failure.
        Err(StaticsError::Spatial(why @ Unsolved::Loose)) => {
            return report_loose(&m, state, &why, a);
        }
        found => found?,
    };
    let methods: &[GroupMethod] = match a.method {
        StaticsMethod::Delta => &[GroupMethod::Delta],
        StaticsMethod::Projective => &[GroupMethod::Projective],
        StaticsMethod::Equilibrium => &[GroupMethod::Equilibrium],
        StaticsMethod::All => &GroupMethod::ALL,
    };
    if let (true, SolvedReactions::Planar(s)) = (own, &found)
        && s.contour_groups.is_empty()
    {
        bail!(
            "{} has no four-link group with a closed loop, which --method delta and projective need; use --method equilibrium",
            m.name
        );
    }
    write(&m, &ToldStatics::new(&m, state, stroke, &found, methods), a)?;
    // A stroke that could not be finished is no success.
    Ok(Done::found_or_nothing(found.is_complete()))
}

/// Prints the assembly forces of inaccurate joints.
fn run_misfit(
    m: &Mechanism,
    state: StateId,
    tolerances: Option<Tolerances>,
    a: &Statics,
    seed: u64,
) -> anyhow::Result<Done> {
    let mut accuracy = m.loads.accuracy.clone().unwrap_or_default();
    if let Some(usual) = tolerances {
        let hand_force = accuracy.hand_force;
        accuracy = Accuracy::uniform(usual);
        accuracy.hand_force = hand_force;
    }
    accuracy.hand_force = a.hand_force.unwrap_or(accuracy.hand_force);
    ensure!(
        accuracy.hand_force >= 0.0 && accuracy.hand_force.is_finite(),
        "--hand-force must be a force in N, at least 0"
    );
    let view = MisfitView {
        mechanism: m,
        state,
        accuracy: &accuracy,
        found: &misfit(m, state, &accuracy, seed)?,
    };
    a.write_text(match a.format {
        TextJsonOrCsv::Text => view.text(output::output_width(a.output.as_deref())),
        TextJsonOrCsv::Json => output::json_text(&view.json())?,
        TextJsonOrCsv::Csv => bail!("assembly forces have no CSV; use --format json"),
    })?;
    Ok(Done::Found)
}

/// Returns the model that the options ask for; `own` is true if the method solves groups in the plane by itself.
fn chosen_model(m: &Mechanism, state: StateId, own: bool, a: &Statics) -> anyhow::Result<Model> {
    if a.unilateral && !m.joints_in(state).any(|j| object_at(m, j).is_some()) {
        bail!(
            "--unilateral is for contacts with a clamped part, and state {} of {} has none; add a \
            link of role = \"object\", and joints of type fixed, planar, cylinder-on-plane or \
            sphere-on-plane to it",
            a.state,
            m.name
        );
    }
    Ok(match (a.unilateral, a.spatial, own || a.svg.is_some()) {
        (true, ..) => Model::Pushing,
        (_, true, _) => Model::Spatial,
        (_, false, true) => Model::Planar,
        (_, false, false) => Model::Either,
    })
}

/// Says why nothing holds the mechanism: exit code 1.
fn report_loose(
    m: &Mechanism,
    state: StateId,
    why: &Unsolved,
    a: &Statics,
) -> anyhow::Result<Done> {
    a.write_text(match a.format {
        TextJsonOrCsv::Json => output::json_text(&NotHeld::because(m, state, &why.to_string()))?,
        TextJsonOrCsv::Csv | TextJsonOrCsv::Text => {
            format!("{}, state {}: {why}\n", m.name, a.state)
        }
    })?;
    Ok(Done::Nothing)
}

/// Writes what was found, with the charts where they are asked for.
fn write(m: &Mechanism, shown: &ToldStatics<'_>, a: &Statics) -> anyhow::Result<()> {
    if let (ToldReactions::Planar(s), Some(folder)) = (&shown.reactions, &a.svg) {
        output::write_charts(folder, Some(&m.name), cycle_charts(s))?;
    }
    a.put_reactions(shown, &next_steps(shown, a))?;
    Ok(())
}

/// Returns the next commands to suggest.
fn next_steps(shown: &ToldStatics<'_>, a: &Statics) -> Vec<NextCommand> {
    let next = |command, more, gives| NextCommand::new(command, &a.file.file, more, gives);
    match &shown.reactions {
        ToldReactions::Planar(s) if s.found.moments.iter().any(|x| !x.loads.is_empty()) => {
            let charts = next(
                "statics",
                "--svg charts",
                "charts of reactions and accelerations over the cycle",
            );
            let all = next(
                "statics",
                "--format csv -o reactions.csv",
                "every joint's reaction at every position",
            );
            let charts = a.svg.is_none().then_some(charts);
            charts.into_iter().chain([all]).collect()
        }
        ToldReactions::Pose(s) if s.is_unique() => vec![next(
            "statics",
            "--spatial --format csv -o reactions.csv",
            "the components of every joint's reaction",
        )],
        ToldReactions::Pose(_) => vec![next(
            "search",
            "",
            "redesigns without redundant constraints, whose reactions are unique",
        )],
        ToldReactions::Planar(_) | ToldReactions::Stroke(_) => Vec::new(),
    }
}

fn run_groups(m: &Mechanism, state: StateId, a: &Statics) -> anyhow::Result<Done> {
    let (planar, found) = cycle::drive_structures(m, state)?;
    let shown = Structures {
        mechanism: &m.name,
        planar: &planar,
        found: &found,
    };
    a.write_text(match a.format {
        TextJsonOrCsv::Json => output::json_text(&shown.json())?,
        TextJsonOrCsv::Csv => bail!("--groups has no CSV; use --format json"),
        TextJsonOrCsv::Text => shown.text(output::output_width(a.output.as_deref())),
    })?;
    Ok(Done::found_or_nothing(
        found.iter().any(|x| x.found.is_ok()),
    ))
}

/// Returns the diameter asked for, or the hardest one to hold. `None` if that part cannot be held.
fn chosen_diameter<'g>(g: &'g Gripping, a: &Statics) -> anyhow::Result<Option<&'g DiameterRow>> {
    let Some(diameter) = a.diameter else {
        return Ok(g.study.hardest_row());
    };
    let unit = g.mechanism.length_unit;
    let near =
        |r: &&DiameterRow| (r.diameter / unit.metres - diameter).abs() < 1e-6 * diameter.abs();
    let found = g.study.rows.iter().find(near);
    let known = || {
        let all = g.study.rows.iter().take(30);
        let all = all.map(|r| four_digits(r.diameter / unit.metres));
        all.collect::<Vec<_>>().join(", ")
    };
    let row = found.with_context(|| {
        format!(
            "--diameter {diameter} {} is not one of the diameters of [workload.grip]: {}",
            unit.symbol,
            known()
        )
    })?;
    Ok(Some(row).filter(|r| r.is_held()))
}

/// Refuses what makes no sense round a part.
fn check_options(a: &Statics) -> anyhow::Result<()> {
    for (given, flag) in [(a.stroke.is_some(), "--stroke"), (a.svg.is_some(), "--svg")] {
        ensure!(
            !given,
            "{flag} needs a motion, but the levers do not move around this part; choose another part with --diameter"
        );
    }
    ensure!(
        !matches!(a.method, StaticsMethod::Delta | StaticsMethod::Projective),
        "joints around a part are solved by equilibrium only; use --method equilibrium"
    );
    Ok(())
}

pub(crate) fn run_clamped(g: &Gripping, a: &Statics) -> anyhow::Result<Done> {
    check_options(a)?;
    let Some(row) = chosen_diameter(g, a)? else {
        return not_held(g, a);
    };
    let Some(found) = clamped_reactions(g, row, a.spatial)? else {
        return not_held(g, a);
    };
    let shown = ToldStatics::round_a_part(g, row, &found);
    a.put_reactions(&shown, &[])
}

/// Says why there are no forces: exit code 1.
fn not_held(g: &Gripping, a: &Statics) -> anyhow::Result<Done> {
    let shown = NotHeld::new(g);
    a.write_text(match a.format {
        TextJsonOrCsv::Json => output::json_text(&shown)?,
        TextJsonOrCsv::Csv | TextJsonOrCsv::Text => shown.text(),
    })?;
    Ok(Done::Nothing)
}
