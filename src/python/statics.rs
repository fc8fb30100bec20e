//! Joint reactions, as `ozols statics` finds them.

use crate::mechanism::Mechanism;
use crate::told::{Told, failed, json, state};
use ozols::file::read::workload::motion;
use ozols::grip::clamped::{ClampingReactions, clamped};
use ozols::grip::jaw_loads::{Gripping, JawError};
use ozols::model::mechanism::StateId;
use ozols::redundancy::stress::exact_self_stresses;
use ozols::statics::contour_group::solutions::GroupMethod;
use ozols::statics::reactions::Unsolved;
use ozols::statics::solve::{Model, SolvedReactions, StaticsError, solve};
use ozols::view::grip::clamped::{Clamped, NotHeld, pose};
use ozols::view::reactions::stroke::ReactionsOverStroke;
use ozols::view::reactions::{Reactions, text::reactions};
use ozols::view::statics::{StaticsData, csv::csv, text};
use pyo3::prelude::*;

/// As `ozols statics`.
#[pyfunction]
pub(crate) fn statics(
    py: Python<'_>,
    mechanism: &Bound<'_, Mechanism>,
    named: &str,
    stroke: Option<&str>,
    spatial: bool,
    unilateral: bool,
) -> PyResult<Told> {
    let m = &mechanism.get().0;
    py.detach(|| {
        let state = state(m, named)?;
        match Gripping::new(m, state) {
            Err(JawError::Nominal(why)) => not_held(&NotHeld::because(m, state, &why.to_string())),
            Err(e) => Err(failed(e)),
            Ok(Some(g)) if stroke.is_none() => round_a_part(&g, spatial),
            Ok(Some(_)) => Err(failed(
                "--stroke needs a motion, and the levers stand still round the part",
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
) -> PyResult<Told> {
    let stroke = match range {
        Some(text) => Some(motion::stroke(text).map_err(failed)?),
        None => m.loads.stroke,
    };
    let model = match model {
        (_, true) => Model::Pushing,
        (true, false) => Model::Spatial,
        (false, false) => Model::Either,
    };
    match solve(m, state, stroke, model) {
        Err(StaticsError::Spatial(why @ Unsolved::Loose)) => {
            not_held(&NotHeld::because(m, state, &why.to_string()))
        }
        Err(e) => Err(failed(e)),
        Ok(SolvedReactions::Planar(found)) => {
            let told = StaticsData::new(m, &found, &GroupMethod::ALL);
            let csv = csv(&told);
            Ok((json(&told)?, text::statics(&told, None), Some(csv), None))
        }
        Ok(SolvedReactions::Spatial(found)) => {
            if let ([(_, Ok(one))], None) = (&found.positions[..], stroke) {
                let exact = exact_self_stresses(m, state, &found.drives);
                let told = Reactions::new(m, state, one).with_exact(exact);
                let text = reactions(&told, "pose of the file", None);
                return Ok((json(&told)?, text, Some(told.csv()), None));
            }
            let told = ReactionsOverStroke::new(m, state, &found);
            Ok((json(&told)?, told.text(None), Some(told.csv()), None))
        }
    }
}

/// With the part that is hardest to hold.
fn round_a_part(g: &Gripping, spatial: bool) -> PyResult<Told> {
    let Some(row) = g.study.hardest() else {
        return not_held(&NotHeld::new(g));
    };
    let Some(found) = clamped(g, row, spatial).map_err(failed)? else {
        return not_held(&NotHeld::new(g));
    };
    let (m, found) = (&found.mechanism, &found);
    let grip = Clamped {
        grip: g,
        row,
        found,
    };
    let head = grip.text(matches!(found.found, ClampingReactions::Planar(_)), None);
    match &found.found {
        ClampingReactions::Planar(s) => {
            let told = StaticsData::new(m, s, &GroupMethod::ALL);
            let (body, csv) = (text::statics(&told, None), csv(&told));
            let told = grip.beside(&told, Some(&m.states[g.state]));
            Ok((json(&told)?, head + &body, Some(csv), None))
        }
        ClampingReactions::Spatial(s) => {
            let told = Reactions::new(m, g.state, s);
            let (body, csv) = (reactions(&told, &pose(g, row), None), told.csv());
            let told = grip.beside(&told, None);
            Ok((json(&told)?, head + &body, Some(csv), None))
        }
    }
}

fn not_held(told: &NotHeld<'_>) -> PyResult<Told> {
    Ok((json(told)?, told.text(), None, None))
}
