//! Forces over the stroke, where the file states loads.

use crate::model::loads::Stroke;
use crate::model::mechanism::{Mechanism, StateId};
use crate::page::moving::Moving;
use crate::statics::solve::{Model, SolvedReactions, solve};
use crate::view::reactions::stroke::ReactionsOverStroke as Reactions;
use serde_json::{Value, json};

/// Positions of a stroke that the file does not state.
const STEPS: usize = 24;

/// By state a chart as SVG, or why there is none; null where nothing loads it.
pub(super) fn charts(m: &Mechanism) -> Vec<Value> {
    m.state_ids().map(|s| chart(m, s)).collect()
}

fn chart(m: &Mechanism, state: StateId) -> Value {
    if !m.loads.acts_from_outside(state) {
        return Value::Null;
    }
    let stroke = m.loads.stroke.or_else(|| reach(m, state));
    match solve(m, state, stroke, Model::Spatial) {
        Ok(SolvedReactions::Spatial(found)) => {
            let svg = Reactions::new(m, state, &found).chart().map(|c| c.svg());
            json!({ "svg": svg })
        }
        Ok(SolvedReactions::Planar(_)) => Value::Null,
        Err(why) => json!({ "why": why.to_string() }),
    }
}

/// As far as the drive goes.
fn reach(m: &Mechanism, state: StateId) -> Option<Stroke> {
    let [from, to] = Moving::new(m, state, None, None).ok()?.reach()?;
    Some(Stroke {
        from,
        to,
        steps: STEPS,
    })
}
