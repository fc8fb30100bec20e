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
use clap::builder::PossibleValuesParser;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum StaticsMethod {
    /// The δ-point method, for four-link groups with a closed loop.
    Delta,
    /// Its projective form.
    Projective,
    /// The equilibrium equations of every link, for any group.
    Equilibrium,
    /// All three methods, and the differences between them.
    All,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Statics {
    #[command(flatten)]
    file: File,
    /// Method for the reactions of four-link groups with a closed loop.
    #[arg(long, value_enum, default_value = "all")]
    method: StaticsMethod,
    /// Range of the first drive as FROM:TO:STEPS, for example 0:360deg:72 [default: the file's stroke]. Numbers without a unit
    /// are radians, or the file's length unit for sliding drives.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    stroke: Option<String>,
    /// State of the file.
    #[arg(long, default_value = "free")]
    state: String,
    /// In a state that [workload.grip] loads: part whose contact forces load the jaws, in the file's unit [default: the hardest
    /// to hold].
    #[arg(long, value_name = "D")]
    diameter: Option<f64>,
    /// Model the mechanism in its plane (normal z), even if the file is spatial.
    #[arg(long)]
    planar: bool,
    /// Compute all six components of each joint's reaction, even with redundant constraints [default if a mechanism is not planar
    /// or not determinate in its plane].
    #[arg(long, conflicts_with_all = ["planar", "groups", "svg"])]
    spatial: bool,
    /// Let contacts with a clamped part only push, with the friction and faces of [[workload.contact]]. Otherwise they are the
    /// joints of the file, and the report lists those that would pull.
    #[arg(long, conflicts_with_all = ["groups", "svg"])]
    unilateral: bool,
    /// Print the assembly forces of inaccurate joints. Their tolerances are those of the file's [tolerances], or the general ones of
    /// ISO 2768 for 30 to 120 mm: fine (0.15 mm, 0.5°), medium (0.3 mm, 0.5°) or coarse (0.8 mm, 1°) [default: those of the file,
    /// else fine].
    #[arg(long, value_name = "FIT", num_args = 0..=1, value_parser = PossibleValuesParser::new(Tolerances::NAMES), conflicts_with_all = ["planar", "spatial", "unilateral", "groups", "svg", "stroke", "diameter"])]
    misfit: Option<Option<String>>,
    /// Print only the Assur groups, under each possible drive.
    #[arg(long, conflicts_with_all = ["svg", "stroke"])]
    groups: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    format: TextJsonOrCsv,
    /// Also write charts of the cycle to this folder.
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    to: ToFile,
}

impl Statics {
    /// Writes reactions in the format asked for; a text ends with what to do next.
    fn put_reactions(&self, shown: &ToldStatics<'_>, next: &[NextCommand]) -> anyhow::Result<Done> {
        let width = self.to.width();
        self.to.write_all_of(match self.format {
            TextJsonOrCsv::Json => output::json_text(&shown.json())?,
            TextJsonOrCsv::Csv => shown.csv(),
            TextJsonOrCsv::Text => shown.text(width) + &self.file.next_steps(next, width),
        })
    }
}

pub(crate) fn run_statics(args: &Global, a: &Statics) -> anyhow::Result<Done> {
    let mut m = load::load_mechanism(&a.file)?;
    if a.planar {
        load::put_in_plane(&mut m)?;
    }
    let state = load::find_state(&m, &a.state)?;
    match Gripping::new(&m, state) {
        // The nominal part is out of reach, so nothing is held.
        Err(JawError::Nominal(why)) => {
            let why = why.to_string();
            let text = format!("{}: the part cannot be held: {why}\n", m.name);
            return report_not_held(&NotHeld::because(&m, state, &why), text, a);
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
    if let Some(fit) = &a.misfit {
        return run_misfit(&m, state, fit.as_deref(), a, args.seed);
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
            let why = why.to_string();
            let text = format!("{}, state {}: {why}\n", m.name, a.state);
            return report_not_held(&NotHeld::because(&m, state, &why), text, a);
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
    fit: Option<&str>,
    a: &Statics,
    seed: u64,
) -> anyhow::Result<Done> {
    let mut accuracy = m.loads.accuracy.clone().unwrap_or_default();
    if let Some(usual) = fit.and_then(Tolerances::named) {
        let hand_force = accuracy.hand_force;
        accuracy = Accuracy::uniform(usual);
        accuracy.hand_force = hand_force;
    }
    let view = MisfitView {
        mechanism: m,
        state,
        accuracy: &accuracy,
        found: &misfit(m, state, &accuracy, seed)?,
    };
    a.to.write_all_of(match a.format {
        TextJsonOrCsv::Text => view.text(a.to.width()),
        TextJsonOrCsv::Json => output::json_text(&view.json())?,
        TextJsonOrCsv::Csv => bail!("assembly forces have no CSV; use --format json"),
    })
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

/// Says why nothing is held: exit code 1.
fn report_not_held(why: &NotHeld<'_>, text: String, a: &Statics) -> anyhow::Result<Done> {
    a.to.write_all_of(match a.format {
        TextJsonOrCsv::Json => output::json_text(why)?,
        TextJsonOrCsv::Csv | TextJsonOrCsv::Text => text,
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
    a.to.write_all_of(match a.format {
        TextJsonOrCsv::Json => output::json_text(&shown.json())?,
        TextJsonOrCsv::Csv => bail!("--groups has no CSV; use --format json"),
        TextJsonOrCsv::Text => shown.text(a.to.width()),
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
        return report_not_held(&NotHeld::new(g), NotHeld::new(g).text(), a);
    };
    let Some(found) = clamped_reactions(g, row, a.spatial)? else {
        return report_not_held(&NotHeld::new(g), NotHeld::new(g).text(), a);
    };
    let shown = ToldStatics::round_a_part(g, row, &found);
    a.put_reactions(&shown, &[])
}
