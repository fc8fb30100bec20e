//! `ozols analyze`.

use super::args::{Analyze, AnalyzeFormat, Args, RankMethod};
use super::{Done, load, output, stroke, verify};
use crate::model::measured::looks_measured;
use crate::model::mechanism::{Mechanism, StateId};
use crate::rank::method;
use crate::rank::numeric::DEFAULT_TOLERANCE;
use crate::rank::scaled::Precision;
use crate::rank::snap::snap;
use crate::redundancy::analysis::{Elimination, Method, StateAnalysis, analyse};
use crate::search::suggest::single_changes;
use crate::view::layout::fit;
use crate::view::suggestions::{self, Advice};
use crate::view::{analysis_json, analysis_text, next};
use anyhow::{Context, bail};

pub(super) fn run(_: &Args, a: &Analyze) -> anyhow::Result<Done> {
    let mut mechanism = load::mechanism(&a.file.file)?;
    if a.planar {
        load::put_in_plane(&mut mechanism);
    }
    let states: Vec<StateId> = match (a.state.as_str(), mechanism.state(&a.state)) {
        (_, Some(s)) => vec![s],
        ("all", None) if a.stroke.is_some() => vec![StateId::FREE],
        ("all", None) => mechanism.state_ids().collect(),
        (other, None) => bail!(
            "{} has no state {other}; it has: {}",
            mechanism.name,
            mechanism.states.join(", ")
        ),
    };
    if let Some(t) = a.tolerance
        && !(t > 0.0 && t < 1.0)
    {
        bail!("--tolerance must be between 0 and 1");
    }
    let stroke = stroke::Asked::new(&mechanism, a)?;
    let eliminate = |e: Elimination, usual: f64| Method::Numeric(e, a.tolerance.unwrap_or(usual));
    let method = match a.method {
        RankMethod::Auto => Method::Auto {
            tolerance: a.tolerance,
        },
        RankMethod::Modular | RankMethod::Finite => Method::Modular,
        RankMethod::Svd => eliminate(Elimination::Svd, DEFAULT_TOLERANCE),
        RankMethod::Qr => eliminate(Elimination::Qr, f64::TOLERANCE),
        RankMethod::Qr32 => eliminate(Elimination::Qr32, f32::TOLERANCE),
        RankMethod::Lu => eliminate(Elimination::Lu, f64::TOLERANCE),
        RankMethod::Lu32 => eliminate(Elimination::Lu32, f32::TOLERANCE),
        RankMethod::Rational => return by(&mechanism, &states, "rational", a),
        RankMethod::Count => return by(&mechanism, &states, "count", a),
        RankMethod::CountPlanar => return by(&mechanism, &states, "count-planar", a),
        RankMethod::Loops => return by(&mechanism, &states, "loops", a),
        RankMethod::Generic => return by(&mechanism, &states, "generic", a),
    };
    let found = analyse(&mechanism, &states, method)?;
    if let Some(path) = &a.certificate {
        verify::write(path, &mechanism, &states)?;
    }
    let stroke = stroke.map(|s| s.follow()).transpose()?;
    if let (Some(s), Some(path)) = (&stroke, &a.svg) {
        s.chart(path)?;
    }
    let (advice, snapped) = advise(&mechanism, &states, &found, a.tolerance)?;
    let next = suggestions::next(&mechanism, &found, &advice, &a.file.file, snapped);
    let width = output::width(a.output.as_deref());
    output::to(a.output.as_deref(), |out| {
        match a.format {
            AnalyzeFormat::Json => {
                let mut value = analysis_json::analysis(&mechanism, &found, &advice);
                if let Some(s) = &stroke {
                    value["stroke"] = s.json();
                }
                writeln!(out, "{value:#}")?;
            }
            AnalyzeFormat::Text => {
                let text = analysis_text::analysis(&mechanism, &found, &advice, width);
                write!(out, "{text}")?;
                if let Some(s) = &stroke {
                    write!(out, "\n{}", fit(&s.text(width), width))?;
                }
                write!(out, "{}", next::text(&next, width))?;
            }
        }
        // A stroke that could not be finished is no success.
        Ok(match stroke {
            Some(s) if s.stopped() => Done::Nothing,
            _ => Done::Found,
        })
    })
}

/// What single changes would do in each state, on the geometry that the analysis is about: snapped, by the tolerance
/// given back, where it was.
fn advise(
    mechanism: &Mechanism,
    states: &[StateId],
    found: &[StateAnalysis],
    tolerance: Option<f64>,
) -> anyhow::Result<(Vec<Advice>, Option<f64>)> {
    let snapped = if found.iter().any(|s| !s.snapped.is_empty()) {
        let of_digits = looks_measured(mechanism).map(|m| m.tolerance());
        tolerance
            .or(of_digits)
            .map(|t| (snap(mechanism, t).mechanism, t))
    } else {
        None
    };
    let one = |(&state, s): (&StateId, &StateAnalysis)| {
        if suggestions::concerned(s) == 0 {
            return Ok(Advice::Nothing);
        }
        let exact = match &snapped {
            Some((m, _)) if !s.snapped.is_empty() => m,
            _ => mechanism,
        };
        let found = single_changes(exact, state)?;
        Ok(if found.redundant == s.redundant {
            Advice::Changes(found)
        } else {
            Advice::Silent(
                "the redundant constraints are there within the tolerance only, not as the coordinates are written",
            )
        })
    };
    let advice = states.iter().zip(found).map(one);
    let advice = advice.collect::<anyhow::Result<Vec<_>>>()?;
    Ok((advice, snapped.map(|(_, t)| t)))
}

/// A method that gives a mobility and nothing else.
fn by(mechanism: &Mechanism, states: &[StateId], name: &str, a: &Analyze) -> anyhow::Result<Done> {
    let method = method::by_name(name).with_context(|| format!("there is no method {name}"))?;
    if a.stroke.is_some() {
        bail!("--stroke needs the rank of J, which --method {name} does not give; use auto or svd");
    }
    let answers = states
        .iter()
        .map(|&s| Ok((s, method.answer(mechanism, s)?)))
        .collect::<anyhow::Result<Vec<_>>>()
        .with_context(|| format!("{} by {}", mechanism.name, method.title()))?;
    output::to(a.output.as_deref(), |out| {
        match a.format {
            AnalyzeFormat::Json => {
                let value = analysis_json::by_method(mechanism, method, &answers);
                writeln!(out, "{value:#}")?;
            }
            AnalyzeFormat::Text => write!(
                out,
                "{}",
                analysis_text::by_method(mechanism, method, &answers)
            )?,
        }
        Ok(Done::Found)
    })
}
