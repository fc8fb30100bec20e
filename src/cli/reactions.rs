//! `ozols statics` of spatial and of redundant mechanisms.

use super::args::{Statics, StaticsFormat, StaticsMethod};
use super::{Done, output};
use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::assur::AssurError;
use crate::statics::cycle::StaticsError;
use crate::statics::planar::PlanarError;
use crate::statics::reactions::Choice;
use crate::statics::reactions::cycle::cycle;
use crate::view::next::{self, Step};
use crate::view::{reactions_cycle, reactions_data, reactions_text};

/// Whether the planar solver's refusal is a case for this one: the answer is asked for by any method, without charts.
pub(super) fn takes(error: &StaticsError, a: &Statics) -> bool {
    let plain =
        a.svg.is_none() && matches!(a.method, StaticsMethod::All | StaticsMethod::Equilibrium);
    plain
        && match error {
            StaticsError::Planar(e) => !matches!(e, PlanarError::Exact(_)),
            StaticsError::Assur(e) => matches!(e, AssurError::Overconstrained { .. }),
        }
}

pub(super) fn run(
    m: &Mechanism,
    state: StateId,
    stroke: Option<Stroke>,
    a: &Statics,
) -> anyhow::Result<Done> {
    let found = cycle(m, state, stroke)?;
    let one = match (&found.positions[..], stroke) {
        ([(_, Ok(one))], None) => Some(one),
        _ => None,
    };
    output::to(a.output.as_deref(), |out| {
        let width = output::width(a.output.as_deref());
        match (a.format, one) {
            (StaticsFormat::Json, Some(s)) => {
                writeln!(out, "{:#}", reactions_data::json(m, state, s))?;
            }
            (StaticsFormat::Csv, Some(s)) => write!(out, "{}", reactions_data::csv(m, s))?,
            (StaticsFormat::Text, Some(s)) => {
                let text = reactions_text::solution(m, state, "pose of the file", s, width);
                write!(out, "{text}")?;
                let file = a.file.as_deref().unwrap_or(&m.name);
                let step = match s.choice {
                    Choice::MinimumNorm => Step::new(
                        "search",
                        file,
                        "",
                        "redesigns without redundant constraints, whose reactions are the only ones",
                    ),
                    Choice::Unique => Step::new(
                        "statics",
                        file,
                        "--spatial --format csv -o reactions.csv",
                        "the components of every joint's reaction",
                    ),
                };
                write!(out, "{}", next::text(&[step], width))?;
            }
            (StaticsFormat::Json, None) => {
                writeln!(out, "{:#}", reactions_cycle::data(m, state, &found))?;
            }
            (StaticsFormat::Csv, None) => write!(out, "{}", reactions_cycle::csv(m, &found))?,
            (StaticsFormat::Text, None) => {
                write!(out, "{}", reactions_cycle::text(m, state, &found, width))?;
            }
        }
        // A stroke that could not be finished is no success.
        let whole = found.stopped.is_none() && found.positions.iter().all(|(_, s)| s.is_ok());
        Ok(if whole { Done::Found } else { Done::Nothing })
    })
}
