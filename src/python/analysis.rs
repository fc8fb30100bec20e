//! Analyses of a mechanism in its pose and over a stroke.

use crate::answer::{Answer, failed, json, state};
use crate::mechanism::Mechanism;
use ozols::file::read::workload::motion;
use ozols::model::mechanism::StateId;
use ozols::rank::method::{RankOfJ, registry};
use ozols::rank::rounded::verdict::rank_verdict;
use ozols::rank::stroke::analysis::StrokeRequest;
use ozols::redundancy::analysis::{Method, analyse_states};
use ozols::view::analysis::Analysis;
use ozols::view::analysis::mobility::ByMethod;
use ozols::view::analysis::suggestions::advise_states;
use ozols::view::stroke::StrokeData;
use pyo3::prelude::*;

/// Returns what `ozols analyze` prints.
#[pyfunction]
pub(crate) fn analyze(
    py: Python<'_>,
    mechanism: &Bound<'_, Mechanism>,
    named: &str,
    method: &str,
    tolerance: Option<f64>,
) -> PyResult<Answer> {
    let m = &mechanism.get().0;
    py.detach(|| {
        let states: Vec<StateId> = match named {
            "all" if m.state_named(named).is_none() => m.state_ids().collect(),
            _ => vec![state(m, named)?],
        };
        let Some(by) = registry::by_name(method) else {
            let known = registry::ALL.map(|m| m.name()).join(", ");
            return Err(failed(format!("method {method:?} is none of {known}")));
        };
        if tolerance.is_some_and(|t| !(t > 0.0 && t < 1.0)) {
            return Err(failed("tolerance must be between 0 and 1"));
        }
        if tolerance.is_some() && matches!(by.rank, RankOfJ::Chosen) {
            return Err(failed(format!(
                "tolerance has no effect with method {method}, which uses the digits and the [tolerance] table of the \
                 file; omit it, or use svd"
            )));
        }
        let Some(rank) = Method::of_method(by, tolerance) else {
            let answer = |&s| Ok((s, by.answer(m, s).map_err(failed)?));
            let answers = states.iter().map(answer).collect::<PyResult<Vec<_>>>()?;
            let found = ByMethod {
                mechanism: m,
                method: by,
                answers,
            };
            return Ok((json(&found.json())?, found.text(), None, None));
        };
        let found = analyse_states(m, &states, rank).map_err(failed)?;
        let advice = advise_states(m, &states, &found).map_err(failed)?;
        let view = Analysis::new(m, &found, &advice);
        Ok((json(&view.json())?, view.text(None, false), None, None))
    })
}

/// Returns the stroke of `ozols analyze --stroke`.
#[pyfunction]
pub(crate) fn stroke(
    py: Python<'_>,
    mechanism: &Bound<'_, Mechanism>,
    range: &str,
    drive: Option<&str>,
    named: &str,
    tolerance: Option<f64>,
) -> PyResult<Answer> {
    let m = &mechanism.get().0;
    py.detach(|| {
        let state = state(m, named)?;
        let verdict = rank_verdict(m, state).map_err(failed)?;
        let read = motion::parse_stroke(range).map_err(failed)?;
        let asked = StrokeRequest::new(m, state, range, read, drive, &verdict, tolerance)
            .map_err(failed)?;
        let view = StrokeData::follow_stroke(&asked);
        Ok((
            json(&view.json())?,
            view.text(None),
            None,
            Some(view.chart().svg()),
        ))
    })
}
