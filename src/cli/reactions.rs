//! `ozols statics` of spatial and of redundant mechanisms.

use super::args::{Statics, StaticsFormat, StaticsMethod};
use super::{Done, output};
use crate::model::mechanism::{Mechanism, StateId};
use crate::report::next::{self, Step};
use crate::report::{reactions_data, reactions_text};
use crate::workload::assur::AssurError;
use crate::workload::planar::PlanarError;
use crate::workload::reactions::{Choice, Reactions};
use crate::workload::statics::StaticsError;

/// Whether the planar solver's refusal is a case for this one: the answer is asked for at one pose, by any method.
pub(super) fn takes(error: &StaticsError, a: &Statics) -> bool {
    let plain = a.stroke.is_none()
        && a.svg.is_none()
        && matches!(a.method, StaticsMethod::All | StaticsMethod::Equilibrium);
    plain
        && match error {
            StaticsError::Planar(e) => !matches!(e, PlanarError::Exact(_)),
            StaticsError::Assur(e) => matches!(e, AssurError::Overconstrained { .. }),
        }
}

pub(super) fn run(m: &Mechanism, state: StateId, a: &Statics) -> anyhow::Result<Done> {
    let found = Reactions::solve(m, state, &m.loads)?;
    output::to(a.output.as_deref(), |out| {
        match a.format {
            StaticsFormat::Json => {
                writeln!(out, "{:#}", reactions_data::json(m, state, &found))?;
            }
            StaticsFormat::Csv => write!(out, "{}", reactions_data::csv(m, &found))?,
            StaticsFormat::Text => {
                let width = output::width(a.output.as_deref());
                write!(out, "{}", reactions_text::solution(m, state, &found, width))?;
                let file = a.file.as_deref().unwrap_or(&m.name);
                let step = match found.choice {
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
        }
        Ok(Done::Found)
    })
}
