//! Joint reactions.

use crate::answer::{Answer, failed, json, state};
use crate::mechanism::Mechanism;
use ozols::file::read::workload::motion;
use ozols::grip::clamped::clamped_reactions;
use ozols::grip::jaw_loads::{Gripping, JawError};
use ozols::model::mechanism::StateId;
use ozols::statics::contour_group::solutions::GroupMethod;
use ozols::statics::reactions::Unsolved;
use ozols::statics::solve::{Model, StaticsError, solve_reactions};
use ozols::view::grip::clamped::NotHeld;
use ozols::view::statics::told::ToldStatics;
use pyo3::prelude::*;

/// Returns what `ozols statics` prints.
#[pyfunction]
pub(crate) fn statics(
    py: Python<'_>,
    mechanism: &Bound<'_, Mechanism>,
    named: &str,
    stroke: Option<&str>,
    spatial: bool,
    unilateral: bool,
) -> PyResult<Answer> {
    let m = &mechanism.get().0;
    py.detach(|| {
        let state = state(m, named)?;
        match Gripping::new(m, state) {
            Err(JawError::Nominal(why)) => not_held(&NotHeld::because(m, state, &why.to_string())),
            Err(e) => Err(failed(e)),
            Ok(Some(g)) if stroke.is_none() => round_a_part(&g, spatial),
            Ok(Some(_)) => Err(failed(
                "stroke needs a motion, but the levers are at rest on the part",
            )),
            Ok(None) => reactions_of(m, state, stroke, (spatial, unilateral)),
        }
    })
}

fn reactions_of(
    m: &ozols::Mechanism,
    state: StateId,
    range: Option<&str>,
    model: (bool, bool),
) -> PyResult<Answer> {
    let stroke = match range {
        Some(text) => Some(motion::parse_stroke(text).map_err(failed)?),
        None => m.loads.stroke,
    };
    let model = match model {
        (_, true) => Model::Pushing,
        (true, false) => Model::Spatial,
        (false, false) => Model::Either,
    };
    match solve_reactions(m, state, stroke, model) {
        Err(StaticsError::Spatial(why @ Unsolved::Loose)) => {
            not_held(&NotHeld::because(m, state, &why.to_string()))
        }
        Err(e) => Err(failed(e)),
        Ok(found) => {
            let methods = &GroupMethod::ALL;
            answer(&ToldStatics::new(m, state, stroke, &found, methods))
        }
    }
}

/// Returns the reactions with the part that is hardest to hold.
fn round_a_part(g: &Gripping, spatial: bool) -> PyResult<Answer> {
    let Some(row) = g.study.hardest_row() else {
        return not_held(&NotHeld::new(g));
    };
    match clamped_reactions(g, row, spatial).map_err(failed)? {
        None => not_held(&NotHeld::new(g)),
        Some(found) => answer(&ToldStatics::round_a_part(g, row, &found)),
    }
}

fn answer(view: &ToldStatics<'_>) -> PyResult<Answer> {
    Ok((json(&view.json())?, view.text(None), Some(view.csv()), None))
}

fn not_held(view: &NotHeld<'_>) -> PyResult<Answer> {
    Ok((json(view)?, view.text(), None, None))
}
