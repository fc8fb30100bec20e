//! `ozols grip --closure`: how firmly the contacts of any clamped mechanism hold the part.

use crate::cli::command::grip::args::Grip;
use crate::cli::done::Done;
use crate::cli::option::format::TextOrJson;
use crate::cli::option::global::Global;
use crate::cli::option::load;
use crate::cli::terminal::output;
use crate::grip::clamped_part::ClampedPart;
use crate::grip::force_closure::{closure, shares};
use crate::model::mechanism::{Mechanism, StateId};
use crate::statics::reactions::contact::object_at;
use crate::view::grip::closure::ClosureData;
use anyhow::{Context, ensure};

/// The state asked for, or the first in which a part is clamped.
fn state(m: &Mechanism, asked: Option<&str>) -> anyhow::Result<StateId> {
    let Some(name) = asked else {
        let clamped = |s: &StateId| m.joints_in(*s).any(|j| object_at(m, j).is_some());
        return Ok(m.state_ids().find(clamped).unwrap_or(StateId::FREE));
    };
    m.state(name).with_context(|| {
        format!(
            "{} has no state {name}; it has: {}",
            m.name,
            m.states.join(", ")
        )
    })
}

pub(in crate::cli) fn run(args: &Global, a: &Grip) -> anyhow::Result<Done> {
    let m = load::mechanism(&a.file)?;
    let part = ClampedPart::new(&m, state(&m, a.state.as_deref())?)?;
    let force = closure(&part, &part.faces)?;
    let form = closure(&part, &part.smooth())?;
    let samples = match a.tolerance {
        None => None,
        Some(t) => {
            ensure!(
                t > 0.0 && t.is_finite(),
                "--tolerance must be a positive length"
            );
            ensure!(a.samples > 0, "--samples must be at least 1");
            Some(shares(
                &part,
                t * m.length_unit.metres,
                a.samples,
                args.seed,
            )?)
        }
    };
    let shown = ClosureData::new(&m, &part, [&force, &form], samples.as_ref());
    output::to(a.output.as_deref(), |out| {
        match a.format {
            TextOrJson::Json => output::json(out, &shown)?,
            TextOrJson::Text => {
                write!(out, "{}", shown.text(output::width(a.output.as_deref())))?;
            }
        }
        Ok(match shown.force_closure.closed {
            Some(true) => Done::Found,
            Some(false) => Done::Nothing,
            None => Done::Partly,
        })
    })
}
