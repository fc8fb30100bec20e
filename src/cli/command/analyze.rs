//! `ozols analyze`.

use crate::cli::command::verify;
use crate::cli::prelude::*;
use crate::file::read::workload::motion::parse_stroke;
use crate::rank::method::{MobilityMethod, RankOfJ, registry};
use crate::rank::rounded::verdict::rank_verdict;
use crate::rank::stroke::analysis::StrokeRequest;
use crate::view::analysis::mobility::{ByMethod, next as steps};
use crate::view::analysis::{Analysis, State, suggestions};
use crate::view::stroke::StrokeData;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Parses the name of a rank method; lists the surest method first.
fn rank_method() -> impl TypedValueParser<Value = &'static MobilityMethod> {
    let each = registry::ALL.into_iter().rev();
    let values = each.map(|m| PossibleValue::new(m.name()).help(m.help));
    PossibleValuesParser::new(values)
        .try_map(|name| registry::by_name(&name).ok_or("unknown method"))
}

#[derive(Debug, ClapArgs)]
pub(crate) struct Analyze {
    #[command(flatten)]
    pub(crate) file: File,
    /// State to analyse, such as free or clamped, or all.
    #[arg(long, default_value = "all")]
    pub(crate) state: String,
    /// Method that computes the rank.
    #[arg(long, value_parser = rank_method(), default_value = "auto")]
    method: &'static MobilityMethod,
    /// Relative tolerance of the floating-point methods [default: depends on the method].
    #[arg(long, value_name = "T")]
    pub(crate) tolerance: Option<f64>,
    /// Model the mechanism in its plane (normal z) with 3 equations per loop, even if the file is spatial. Refused if a joint cannot
    /// move in that plane.
    #[arg(long)]
    pub(crate) planar: bool,
    /// Also report the motion of this link (repeatable).
    #[arg(long, value_name = "LINK")]
    link: Vec<String>,
    /// Report the motion of --link relative to this link instead of the frame.
    #[arg(long, value_name = "LINK", requires = "link")]
    relative_to: Option<String>,
    /// Also print the counts behind W and σ, the method, the self-stresses, and published claims one by one.
    #[arg(long, short)]
    pub(crate) verbose: bool,
    /// Output format.
    #[arg(long, value_enum, default_value = "text")]
    pub(crate) format: TextOrJson,
    #[command(flatten)]
    to: ToFile,
    /// Also write a proof of each state's rank to a JSON file, for `ozols verify`.
    #[arg(long, value_name = "FILE")]
    pub(crate) certificate: Option<PathBuf>,
    /// Also analyse the poses over a range of the drive, as FROM:TO:STEPS from the drawn pose, for example 0:360deg:72. Numbers
    /// without a unit are radians, or the file's length unit for sliding drives. Uses the first state unless --state names one.
    #[arg(long, value_name = "FROM:TO:STEPS", allow_hyphen_values = true)]
    pub(crate) stroke: Option<String>,
    /// Joint that moves over the stroke, as JOINT:FREEDOM if it has several freedoms [default: the file's first drive]. The
    /// file's other drives are locked, unless this joint is none of them.
    #[arg(long, value_name = "JOINT", requires = "stroke")]
    pub(crate) drive: Option<String>,
    /// Write a chart of the conditioning over the stroke to a file.
    #[arg(long, value_name = "FILE", requires = "stroke")]
    pub(crate) svg: Option<PathBuf>,
}

pub(crate) fn run_analyze(_: &Global, a: &Analyze) -> anyhow::Result<Done> {
    let mut mechanism = load::load_mechanism(&a.file)?;
    if a.planar {
        load::put_in_plane(&mut mechanism)?;
    }
    let states = states_asked(&mechanism, a)?;
    check_tolerance(a)?;
    let over = mechanism.state_named(&a.state).unwrap_or(StateId::FREE);
    let asked = a.stroke.as_ref().map(|_| rank_verdict(&mechanism, over));
    let asked = asked.transpose()?;
    let stroke = match (&a.stroke, &asked) {
        (Some(range), Some(verdict)) => Some(StrokeRequest::new(
            &mechanism,
            over,
            range,
            parse_stroke(range)?,
            a.drive.as_deref(),
            verdict,
            a.tolerance,
        )?),
        _ => None,
    };
    let Some(method) = Method::of_method(a.method, a.tolerance) else {
        return mobility_alone(&mechanism, &states, a);
    };
    let found = analyse_states(&mechanism, &states, method)?;
    if let Some(path) = &a.certificate {
        verify::write_certificates(path, &mechanism, &states, &found)?;
    }
    let stroke = stroke.as_ref().map(StrokeData::follow_stroke);
    if let (Some(s), Some(path)) = (&stroke, &a.svg) {
        output::write_bytes(Some(path), s.chart().svg())?;
    }
    let advice = suggestions::advise_states(&mechanism, &states, &found)?;
    let mut analysis = Analysis {
        stroke,
        ..Analysis::new(&mechanism, &found, &advice)
    };
    add_motions(&mut analysis, &mechanism, &found, a)?;
    let mut next = steps(&mechanism, &analysis.states, &a.file.file);
    if !a.verbose {
        let gives = "where W and σ come from: ranks, proofs and self-stresses";
        next.push(NextCommand::new(
            "analyze",
            &a.file.file,
            "--verbose",
            gives,
        ));
    }
    write(a, &analysis, &next)
}

/// Returns the states to analyse: the one named, or all. Over a stroke this is the free state unless another is named.
fn states_asked(mechanism: &Mechanism, a: &Analyze) -> anyhow::Result<Vec<StateId>> {
    Ok(match (a.state.as_str(), mechanism.state_named(&a.state)) {
        (_, Some(s)) => vec![s],
        ("all", None) if a.stroke.is_some() => vec![StateId::FREE],
        ("all", None) => mechanism.state_ids().collect(),
        (other, None) => vec![load::find_state(mechanism, other)?],
    })
}

/// Adds the motions of the links named by --link.
fn add_motions<'m>(
    analysis: &mut Analysis<'m>,
    mechanism: &'m Mechanism,
    found: &[StateAnalysis],
    a: &Analyze,
) -> anyhow::Result<()> {
    let link = |name: &String| {
        let known = || mechanism.links.iter().map(|l| l.id.as_str()).join(", ");
        let found = mechanism.link_named(name);
        found.with_context(|| format!("{} has no link {name}; it has: {}", mechanism.name, known()))
    };
    let links: Vec<LinkId> = a.link.iter().map(link).collect::<Result<_, _>>()?;
    let to = a.relative_to.as_ref().map(link).transpose()?;
    let to = to.unwrap_or(mechanism.frame_link());
    for (state, found) in analysis.states.iter_mut().zip(found) {
        let all = found.link_motions(mechanism, &links, to)?;
        state.asked.extend(all);
    }
    Ok(())
}

/// Refuses a tolerance that is none, or that the method has no use for.
fn check_tolerance(a: &Analyze) -> anyhow::Result<()> {
    if let Some(t) = a.tolerance
        && !(t > 0.0 && t < 1.0)
    {
        bail!("--tolerance must be between 0 and 1");
    }
    let why = match a.method.rank {
        RankOfJ::Numeric(_) => return Ok(()),
        RankOfJ::Chosen => "which uses the digits and the [tolerance] table of the file",
        RankOfJ::Exact | RankOfJ::NotFound => "which does not round",
    };
    ensure!(
        a.tolerance.is_none(),
        "--tolerance has no effect with --method {}, {why}; omit it, or use svd",
        a.method.name()
    );
    Ok(())
}

/// Writes what was found in the format asked for; text says what to do next.
fn write(a: &Analyze, analysis: &Analysis<'_>, next: &[NextCommand]) -> anyhow::Result<Done> {
    let width = a.to.width();
    a.to.write_all_of(match a.format {
        TextOrJson::Json => output::json_text(&analysis.json())?,
        TextOrJson::Text => {
            let verdicts = analysis
                .states
                .iter()
                .map(|s| (s.verdict(), verdict_tone(s)));
            let text = colour_verdicts(analysis.text(width, a.verbose), a.to.path(), verdicts);
            let stroke = analysis.stroke.as_ref();
            let stroke = stroke.map(|s| format!("\n{}", fit_lines(&s.text(width), width)));
            let next = a.file.with_loops(next_commands::steps_text(next, width));
            text + &stroke.unwrap_or_default() + &next
        }
    })?;
    // A stroke that could not be finished is no success.
    let stopped = analysis.stroke.as_ref().is_some_and(StrokeData::stops);
    Ok(Done::found_or_nothing(!stopped))
}

/// Returns the tone of a verdict: good news or bad.
fn verdict_tone(s: &State<'_>) -> Tone {
    match (s.found.redundant, s.found.at_most()) {
        (_, Some(_)) => Tone::Doubtful,
        (0, None) => Tone::Good,
        _ => Tone::Bad,
    }
}

/// Prints the result of a method that gives a mobility and nothing else.
fn mobility_alone(mechanism: &Mechanism, states: &[StateId], a: &Analyze) -> anyhow::Result<Done> {
    let method = a.method;
    if a.stroke.is_some() {
        bail!(
            "--stroke needs the rank of J, which --method {} does not give; use auto or svd",
            method.name()
        );
    }
    if a.certificate.is_some() {
        bail!(
            "--method {} counts without a rank, so it has no certificate; use auto, or omit --certificate",
            method.name()
        );
    }
    let answers = states
        .iter()
        .map(|&s| Ok((s, method.answer(mechanism, s)?)))
        .collect::<anyhow::Result<Vec<_>>>()
        .with_context(|| format!("{} by {}", mechanism.name, method.title))?;
    let found = ByMethod {
        mechanism,
        method,
        answers,
    };
    a.to.write_all_of(match a.format {
        TextOrJson::Json => output::json_text(&found.json())?,
        TextOrJson::Text => found.text(),
    })
}
