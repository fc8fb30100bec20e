//! What the joints of each variant bear, and its scores, where the file states loads.

use super::Redesigns;
use super::embed::measured;
use crate::model::ranking::Term;
use crate::score::bearing::Bearing;
use crate::score::cases::is_loaded;
use crate::score::elimination::Scratch;
use crate::score::evaluate::Evaluator;
use crate::score::terms::Scores;
use rayon::prelude::*;
use serde_json::{Value, json};

/// What one variant scores; `None` where its loads have no equilibrium.
type Scored = Option<(Scores, Vec<Option<Bearing>>)>;

/// What is this small beside the greatest of its kind is rounding.
const NOTHING: f64 = 1e-9;
/// A moment of the greatest force on an arm as short as this, in metres, is too.
const ARM: f64 = 1e-12;

/// Scores and bearings of the variants for the script; null where the file states no loads and asks for no ranking.
pub(super) fn json(r: &Redesigns<'_>) -> Value {
    let search = &r.found.search;
    let m = &*search.mechanism;
    let ranking = r.found.ranking.as_ref();
    if !is_loaded(m) && ranking.is_none() {
        return Value::Null;
    }
    let clearance = ranking.map_or_else(Default::default, |p| p.ranking.clearance);
    let states = ranking.map_or(&[][..], |p| &p.ranking.states);
    let evaluator = match Evaluator::in_states(search, clearance, states) {
        Ok(e) => e,
        Err(why) => return json!({"failed": why.to_string()}),
    };
    let scored: Vec<Scored> = r
        .variants
        .par_iter()
        .map_init(Scratch::default, |scratch, v| {
            evaluator.bearings(v.assignment(), scratch).ok()
        })
        .collect();
    let column = |of: &dyn Fn(&Scores) -> Value| -> Vec<Value> {
        let one = |s: &Scored| s.as_ref().map_or(Value::Null, |(s, _)| of(s));
        scored.iter().map(one).collect()
    };
    let term = |t: Term| column(&|s| measured(s.value(t)));
    let joints = |of: fn(&Bearing) -> Option<f64>, beside: f64| -> Vec<Value> {
        let one = |s: &Scored| match s {
            None => Value::Null,
            Some((_, list)) => {
                let values = list.iter().map(|b| b.as_ref().and_then(of));
                let greatest = values.clone().flatten().fold(0.0, f64::max);
                let forces = list.iter().flatten().map(|b| b.force);
                let least = (NOTHING * greatest).max(beside * forces.fold(0.0, f64::max));
                let clean = |x: f64| if x < least { 0.0 } else { x };
                values
                    .map(|x| x.map_or(Value::Null, |x| measured(clean(x))))
                    .collect()
            }
        };
        scored.iter().map(one).collect()
    };
    let ranked = ranking.map(|p| {
        let all: Vec<_> = r.variants.iter().map(|v| v.ranked()).collect();
        json!({
            "head": crate::view::ranking::head(p),
            "notes": crate::view::ranking::notes(m, p).lines().map(str::trim)
                .filter(|l| !l.is_empty() && !l.starts_with("rank ")).collect::<Vec<_>>(),
            "terms": p.ranking.terms.iter().map(|(t, _)| t.name()).collect::<Vec<_>>(),
            "by_cost": all.iter().map(|x| x.map(|r| r.by_cost)).collect::<Vec<_>>(),
            "total": all.iter().map(|x| x.and_then(|r| r.total).map(measured)).collect::<Vec<_>>(),
            "front": all.iter().map(|x| x.and_then(|r| r.front)).collect::<Vec<_>>(),
            "reason": r.variants.iter().map(|v| v.reason()).collect::<Vec<_>>(),
        })
    });
    json!({
        "poses": evaluator.cases.list.len(),
        "stopped": evaluator.cases.stopped,
        "peak_force": term(Term::PeakForce),
        "peak_moment": term(Term::PeakMoment),
        "conditioning": term(Term::Conditioning),
        "output_error_mm": column(&|s| measured(1e3 * s.output_error)),
        "minimum_norm": column(&|s| json!(s.minimum_norm)),
        "force": joints(|b| Some(b.force), 0.0),
        "moment": joints(|b| Some(b.moment), ARM),
        "force_share": joints(|b| Some(b.force_share), 0.0),
        "moment_share": joints(|b| b.moment_share, 0.0),
        "ranked": ranked,
    })
}
