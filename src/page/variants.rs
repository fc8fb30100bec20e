//! The variants as columns for the script, and the frame of their part of the page.

use super::embed::{measured, text};
use super::{Page, Redesigns, figures, workload};
use crate::model::mechanism::Mechanism;
use crate::redundancy::analysis::{AnalysisError, exact_field};
use crate::search::certify::{CHECKED, Certified};
use crate::search::space::choice_name;
use crate::view::search_text;
use rayon::prelude::*;
use serde_json::{Value, json};

/// The joints, in file order.
pub(super) fn joints(m: &Mechanism) -> Value {
    let one = |j: &crate::model::mechanism::Joint| {
        json!({
            "id": j.id,
            "links": j.links.map(|l| m.links[l].id.as_str()),
            "type": j.joint_type.name(),
            "class": j.joint_type.class(),
        })
    };
    m.joints.iter().map(one).collect()
}

/// What takes a computation of its own.
struct Further {
    states: Vec<(usize, usize)>,
    idle: String,
    contours: Option<Vec<usize>>,
}

fn further(r: &Redesigns<'_>) -> Result<Vec<Further>, AnalysisError> {
    let search = r.found.search;
    let exact = exact_field(search.mechanism, 0)?;
    let one = |(i, c): (usize, &Certified)| -> Result<Further, AnalysisError> {
        let m = search.realize(&c.variant.choices);
        let states = m
            .state_ids()
            .skip(1)
            .map(|s| figures::figures(&exact, &m, s));
        Ok(Further {
            states: states.collect::<Result<_, _>>()?,
            idle: if i < CHECKED {
                figures::idle(&exact, &m)?
            } else {
                String::new()
            },
            contours: (c.variant.key.internal() > 0)
                .then(|| figures::redundant_by_contour(&exact, &m))
                .transpose()?,
        })
    };
    r.variants.par_iter().enumerate().map(one).collect()
}

/// Everything the script knows of the search.
pub(super) fn json(page: &Page<'_>, r: &Redesigns<'_>) -> Result<Value, AnalysisError> {
    let search = r.found.search;
    let m = search.mechanism;
    let further = further(r)?;
    let variables = search.space.variables.iter().map(|v| {
        let choices = v.choices.iter().map(|c| {
            let names = v.joints.iter().map(|&j| choice_name(m, j, c));
            let class = v
                .joints
                .first()
                .and_then(|&j| m.joints[j].options.get(c.option));
            json!({
                "names": names.collect::<Vec<_>>(),
                "class": class.map(|o| o.joint_type.class()),
                "unloading": c.unloading.is_some(),
            })
        });
        json!({"joints": v.joints, "choices": choices.collect::<Vec<_>>()})
    });
    let column =
        |of: &dyn Fn(&Certified) -> Value| -> Vec<Value> { r.variants.iter().map(of).collect() };
    let working = page.states.first().map(|s| s.working_mobility);
    let working = working.and_then(|w| i64::try_from(w).ok());
    // Idle motions repeat: each text once, and its number by variant.
    let mut words: Vec<&str> = vec![""];
    let idle: Vec<usize> = further
        .iter()
        .map(|f| {
            words.iter().position(|w| *w == f.idle).unwrap_or_else(|| {
                words.push(&f.idle);
                words.len() - 1
            })
        })
        .collect();
    let states: Vec<Value> = (1..m.states.len())
        .map(|s| {
            let of = |i: usize| {
                further
                    .iter()
                    .map(|f| f.states[s - 1])
                    .map(move |p| [p.0, p.1][i])
            };
            json!({"mobility": of(0).collect::<Vec<_>>(), "redundant": of(1).collect::<Vec<_>>()})
        })
        .collect();
    Ok(json!({
        "space": search.size().to_string(),
        "determinate": r.found.determinate.total.to_string(),
        "admissible": r.found.admissible.total.to_string(),
        "max_redundant": search.request.max_redundant,
        "state": search.request.state.map(|(s, _)| s),
        "variables": variables.collect::<Vec<_>>(),
        "choices": column(&|c| {
            let changed = c.variant.choices.iter().enumerate().filter(|(_, c)| **c != 0);
            changed.flat_map(|(v, &c)| [v, c]).collect()
        }),
        "cost": column(&|c| measured_cost(search.steps.milli(c.variant.key.cost()))),
        "changes": column(&|c| json!(c.variant.key.changes())),
        "mobility": column(&|c| json!(search.mobility(c.variant.key))),
        "redundant": column(&|c| json!(c.variant.key.internal())),
        "external": search.request.state.map(|_| column(&|c| json!(c.variant.key.external()))),
        "idle": search.request.keep_output.then(|| column(&|c| {
            json!(working.map(|w| search.mobility(c.variant.key) - w))
        })),
        "idle_words": words,
        "idle_word": idle,
        "states": states,
        "contours": further.iter().map(|f| f.contours.clone()).collect::<Vec<_>>(),
        "conditioning": column(&|c| c.second.opinion().map_or(Value::Null, |o| measured(o.conditioning))),
        "agree": column(&|c| json!(c.second.opinion().map(|o| o.agree))),
        "lucky": column(&|c| json!(c.stroke.and_then(|s| s.lucky()))),
        "notes": r.variants.iter().enumerate()
            .map(|(i, c)| search_text::note(c, i + 1)).collect::<Vec<_>>(),
        "workload": workload::json(r),
    }))
}

#[allow(clippy::cast_precision_loss, reason = "costs are small")]
fn measured_cost(milli: i64) -> Value {
    if milli % 1000 == 0 {
        json!(milli / 1000)
    } else {
        json!(milli as f64 / 1000.0)
    }
}

const FRAME: &str = include_str!("variants.html");

/// The frame that the script fills, or why there is nothing to fill it with.
pub(super) fn html(page: &Page<'_>) -> String {
    match &page.redesigns {
        Err(why) => format!("<p>Redesigns were not searched: {}</p>\n", text(why)),
        Ok(r) if r.variants.is_empty() => {
            "<p>There is no variant to show; the verdict at the top says why.</p>\n".to_owned()
        }
        Ok(_) => FRAME.to_owned(),
    }
}
