//! A search as JSON; the keys are a stable contract. Counts are strings, since they outgrow 2^53.

use crate::model::measured::Measured;
use crate::rank::measured::Verdicts;
use crate::score::ranking::RankedPool;
use crate::search::best::Variant;
use crate::search::certify::{Certified, Opinion, Summary};
use crate::search::counts::Counts;
use crate::search::diagram::Diagram;
use crate::search::over_stroke::OverStroke;
use crate::search::primes::Verdict;
use crate::search::relax::Relaxation;
use crate::search::request::Search;
use crate::search::space::choice_name;
use crate::view::ranking;
use num_bigint::BigUint;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// What a search found.
#[derive(Debug)]
pub struct Found<'a> {
    /// The search.
    pub search: &'a Search<'a>,
    /// Counts by the redundancy condition of the free state.
    pub determinate: Counts,
    /// Counts by every condition.
    pub admissible: Counts,
    /// Counts of the admissible by cost in thousandths; empty where not asked for.
    pub by_cost: BTreeMap<i64, BigUint>,
    /// The diagrams, determinate and admissible; `None` for brute force.
    pub diagrams: Option<(&'a Diagram, &'a Diagram)>,
    /// Why the search ended.
    pub stop: &'static str,
    /// The primes of the search and its twin, and whether they agree; `None` where there is no twin.
    pub check: Option<([u64; 2], Verdict)>,
    /// Why the geometry looks measured, with the verdicts on the mechanism as it is; `None` where it looks exact.
    pub measured: Option<(Measured, Vec<Verdicts>)>,
    /// Other poses asked for and reached; `None` where none were asked for.
    pub poses: Option<(usize, usize)>,
    /// The ranking under a workload; `None` where the order is that of cost.
    pub ranking: Option<RankedPool>,
}

fn counts<K: ToString>(of: &BTreeMap<K, BigUint>) -> Map<String, Value> {
    of.iter()
        .map(|(k, n)| (k.to_string(), Value::String(n.to_string())))
        .collect()
}

fn nested(of: &BTreeMap<(i64, u32), BigUint>) -> Map<String, Value> {
    let mut out: Map<String, Value> = Map::new();
    for ((w, c), n) in of {
        let by = out
            .entry(w.to_string())
            .or_insert_with(|| Value::Object(Map::new()));
        if let Value::Object(by) = by {
            by.insert(c.to_string(), Value::String(n.to_string()));
        }
    }
    out
}

/// One kind of variants, told apart in every way; keys begin with `prefix`.
fn put_counts<R>(put: &mut impl FnMut(&str, Value) -> R, prefix: &str, of: &Counts) {
    let told = [
        ("by_mobility", counts(&of.by_mobility)),
        (
            "by_mobility_and_changes",
            nested(&of.by_mobility_and_changes),
        ),
        ("by_redundant", counts(&of.by_redundant)),
        ("by_changes", counts(&of.by_changes)),
        ("by_freedoms", counts(&of.by_freedoms)),
    ];
    for (key, map) in told {
        put(&format!("{prefix}{key}"), Value::Object(map));
    }
}

/// Everything but the variants.
#[must_use]
pub fn header(found: &Found<'_>) -> Map<String, Value> {
    let mut out = Map::new();
    let mut put = |k: &str, v: Value| out.insert(k.to_owned(), v);
    put("mechanism", json!(found.search.mechanism.name));
    put("space", json!(found.search.size().to_string()));
    put("determinate", json!(found.determinate.total.to_string()));
    put_counts(&mut put, "", &found.determinate);
    put("admissible", json!(found.admissible.total.to_string()));
    put_counts(&mut put, "admissible_", &found.admissible);
    let by_cost = found
        .by_cost
        .iter()
        .map(|(c, n)| (crate::format::number::cost(*c), json!(n.to_string())));
    put("admissible_by_cost", Value::Object(by_cost.collect()));
    let sizes = |f: fn(&Diagram) -> usize| found.diagrams.map(|(d, a)| (f(d), f(a)));
    let largest = sizes(|d| d.largest_layer);
    let nodes = sizes(|d| d.nodes);
    put("largest_layer", json!(largest.map(|(d, a)| d.max(a))));
    put("nodes", json!(nodes.map(|(d, a)| d + a)));
    put(
        "determinate_diagram",
        json!({"largest_layer": largest.map(|x| x.0), "nodes": nodes.map(|x| x.0)}),
    );
    put(
        "admissible_diagram",
        json!({"largest_layer": largest.map(|x| x.1), "nodes": nodes.map(|x| x.1)}),
    );
    put("stop", json!(found.stop));
    let check = found.check.map(|(primes, verdict)| {
        // Interrupted diagrams stop at different places: neither yes nor no.
        let agree = (verdict == Verdict::Agree).then_some(true);
        json!({"primes": primes.map(|p| p.to_string()), "agree": agree})
    });
    put("check", json!(check));
    put("measured", json!(found.measured.as_ref().map(measured)));
    let poses = found.poses;
    put(
        "poses",
        json!(poses.map(|(asked, reached)| json!({"asked": asked, "reached": reached}))),
    );
    if let Some(p) = &found.ranking {
        put("ranking", ranking::json(found.search.mechanism, p));
    }
    put("exact", json!(found.stop == "exhausted"));
    out
}

fn measured((why, verdicts): &(Measured, Vec<Verdicts>)) -> Value {
    let figures = |(mobility, redundant): (usize, usize)| json!({"mobility": mobility, "redundant": redundant});
    let states = verdicts.iter().map(|v| {
        json!({
            "state": v.state,
            "exact": figures(v.figures(v.exact)),
            "svd": figures(v.figures(v.numeric.rank)),
            "smallest_kept": v.numeric.kept,
            "largest_dropped": v.numeric.dropped,
        })
    });
    json!({
        "coordinates": why.coordinates,
        "example": {"place": why.place, "value": why.value},
        "tolerance": why.tolerance(),
        "agree": verdicts.iter().all(Verdicts::agree),
        "states": states.collect::<Vec<_>>(),
    })
}

/// What follows the variants; `complete` unless their giving was interrupted.
#[must_use]
pub fn tail(summary: &Summary, complete: bool) -> Map<String, Value> {
    let mut out = Map::new();
    let mut put = |k: &str, v: Value| out.insert(k.to_owned(), v);
    put("variants_complete", json!(complete));
    put("variants_checked", json!(summary.checked));
    put("variants_disagreeing", json!(summary.disagreeing));
    put("variants_check_failed", json!(summary.failed));
    put("variants_posed", json!(summary.posed));
    put("variants_lucky", json!(summary.lucky));
    put("variants_dropped", json!(summary.dropped));
    out
}

/// One variant; `position` counts from 1.
#[must_use]
pub fn variant(found: &Found<'_>, certified: &Certified, position: usize) -> Value {
    let search = found.search;
    let ranked = found
        .ranking
        .as_ref()
        .and_then(|p| Some((p, p.of(&certified.variant)?)));
    let scores = ranked.map_or_else(Map::new, |(p, (place, r))| {
        ranking::variant(search.mechanism, p, r, place)
    });
    let (variant, opinion) = (&certified.variant, certified.second.opinion());
    let svd = |o: &Opinion| {
        json!({
            "mobility": o.mobility,
            "redundant": o.redundant,
            "external_redundant": o.external,
            "output_mobility": o.output,
            "smallest_kept": o.conditioning,
            "largest_dropped": o.dropped,
        })
    };
    let other = |s: &OverStroke| {
        let other = s.other.map(|(f, present)| {
            json!({
                "mobility": f.mobility,
                "redundant": f.redundant,
                "output_mobility": f.output,
                "present_output_mobility": present,
            })
        });
        json!({"poses": s.poses, "other": other})
    };
    json!({
        "position": position,
        "cost": cost_number(search.steps.milli(variant.key.cost())),
        "mobility": search.mobility(variant.key),
        "redundant": variant.key.internal(),
        "external_redundant": search.request.state.map(|_| variant.key.external()),
        "changes": changes(search, variant).into_iter()
            .map(|(joint, from, to)| json!({"joint": joint, "from": from, "to": to})).collect::<Vec<_>>(),
        "scores": scores,
        "conditioning": opinion.map(|o| o.conditioning),
        "agree": opinion.map(|o| o.agree),
        "svd": opinion.map(svd),
        "lucky": certified.stroke.and_then(|s| s.lucky()),
        "stroke": certified.stroke.as_ref().map(other),
    })
}

/// What easing one condition would leave, where nothing was found.
#[must_use]
pub fn eased(found: &[(Relaxation, BigUint)]) -> Value {
    let one = |(how, n): &(Relaxation, BigUint)| {
        let (what, to) = match how {
            Relaxation::Redundant(n) => ("max-redundant", json!(n)),
            Relaxation::External(n) => ("max-external", json!(n)),
            Relaxation::Mobility(n) => ("max-mobility", json!(n)),
            Relaxation::Changes(n) => ("max-changes", json!(n)),
            Relaxation::OutputChange => ("allow-output-change", json!(true)),
        };
        json!({"condition": what, "to": to, "admissible": n.to_string()})
    };
    found.iter().map(one).collect()
}

fn cost_number(milli: i64) -> Value {
    if milli % 1000 == 0 {
        json!(milli / 1000)
    } else {
        json!(
            crate::format::number::cost(milli)
                .parse::<f64>()
                .unwrap_or(0.0)
        )
    }
}

/// The changed joints of a variant: (joint, present type, new type), in file order.
#[must_use]
pub fn changes(search: &Search<'_>, variant: &Variant) -> Vec<(String, String, String)> {
    let mut out = Vec::new();
    for (v, &choice) in search
        .space
        .variables
        .iter()
        .zip(&variant.choices)
        .filter(|(_, c)| **c != 0)
    {
        for &j in &v.joints {
            let joint = &search.mechanism.joints[j];
            let to = choice_name(search.mechanism, j, &v.choices[choice]);
            out.push((
                j,
                (
                    joint.id.clone(),
                    choice_name(search.mechanism, j, &v.choices[0]),
                    to,
                ),
            ));
        }
    }
    out.sort_by_key(|(j, _)| *j);
    out.into_iter().map(|(_, change)| change).collect()
}
