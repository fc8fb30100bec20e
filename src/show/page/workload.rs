//! The joint loads and scores of each variant, if the file states loads.

use super::contents::Redesigns;
use crate::model::ranking::Term;
use crate::score::evaluation::joint_loads::{Bearing, Bearings};
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::ranking::RankedPool;
use crate::view::search::ranking::{ranking_head, ranking_notes};
use serde_json::{Value, json};

/// A column of what is known of some variants only.
type Column<T> = Vec<Option<T>>;

/// The scores of a variant, or `None` if its loads have no equilibrium.
type Scored = Option<(Scores, Vec<Option<Bearing>>)>;

/// A value below this share of the greatest of its kind is a rounding error.
const NOTHING: f64 = 1e-9;
/// A moment of the greatest force on an arm as short as this, in metres, is too.
const ARM: f64 = 1e-12;

/// Returns scores and bearings of the variants for the script, or `None` if the file states no loads and no ranking is
/// requested.
pub(super) fn workload_json(r: &Redesigns<'_>) -> Option<Value> {
    let Bearings {
        poses,
        stopped,
        of: scored,
    } = match r.found.bearings(&r.variants) {
        Ok(bearings) => bearings?,
        Err(why) => return Some(json!({ "failed": why.to_string() })),
    };
    let term = |t: Term| score_column(&scored, |s| five_digits(s.term_value(t)));
    Some(json!({
        "poses": poses,
        "stopped": stopped,
        "peak_force": term(Term::PeakForce),
        "peak_moment": term(Term::PeakMoment),
        "conditioning": term(Term::Conditioning),
        "output_error_mm": score_column(&scored, |s| five_digits(1e3 * s.output_error)),
        "minimum_norm": score_column(&scored, |s| s.minimum_norm),
        "force": joint_columns(&scored, |b| Some(b.force), 0.0),
        "moment": joint_columns(&scored, |b| Some(b.moment), ARM),
        "force_share": joint_columns(&scored, |b| Some(b.force_share), 0.0),
        "moment_share": joint_columns(&scored, |b| b.moment_share, 0.0),
        "ranked": r.found.ranking.as_ref().map(|p| ranked_json(r, p)),
    }))
}

/// Returns the places of the variants in a ranking.
fn ranked_json(r: &Redesigns<'_>, p: &RankedPool) -> Value {
    let m = &r.found.search.mechanism;
    let all = || r.variants.iter().map(|v| v.ranked());
    json!({
        "head": ranking_head(p),
        "notes": ranking_notes(m, p),
        "terms": p.ranking.terms.iter().map(|(t, _)| t.name()).collect::<Vec<_>>(),
        "by_cost": all().map(|x| x.map(|r| r.by_cost)).collect::<Vec<_>>(),
        "total": all().map(|x| x.and_then(|r| r.total).map(five_digits)).collect::<Vec<_>>(),
        "front": all().map(|x| x.and_then(|r| r.front)).collect::<Vec<_>>(),
        "reason": r.variants.iter().map(|v| v.place_reason()).collect::<Vec<_>>(),
    })
}

fn score_column<T>(scored: &[Scored], of: impl Fn(&Scores) -> T) -> Column<T> {
    let one = |s: &Scored| s.as_ref().map(|(s, _)| of(s));
    scored.iter().map(one).collect()
}

/// Returns a figure of every joint. Values below `beside` times the greatest force are rounding.
fn joint_columns(
    scored: &[Scored],
    of: fn(&Bearing) -> Option<f64>,
    beside: f64,
) -> Column<Column<Value>> {
    let one = |list: &Vec<Option<Bearing>>| {
        let values = list.iter().map(|b| b.as_ref().and_then(of));
        let greatest = values.clone().flatten().fold(0.0, f64::max);
        let forces = list.iter().flatten().map(|b| b.force);
        let least = (NOTHING * greatest).max(beside * forces.fold(0.0, f64::max));
        let clean = |x: f64| five_digits(if x < least { 0.0 } else { x });
        values.map(|x| x.map(clean)).collect()
    };
    let all = scored.iter();
    all.map(|s| s.as_ref().map(|(_, list)| one(list))).collect()
}

/// Returns a number with five digits; a whole one without a fraction.
pub(super) fn five_digits(x: f64) -> Value {
    let x: f64 = format!("{x:.4e}").parse().unwrap_or(f64::NAN);
    #[allow(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
    if x.fract() == 0.0 && x.abs() < 1e15 {
        json!(x as i64)
    } else {
        json!(x)
    }
}

#[cfg(test)]
mod tests {
    use super::five_digits;

    #[test]
    fn numbers_are_short() {
        let of = |x| five_digits(x).to_string();
        assert_eq!(of(2.0), "2");
        assert_eq!(of(0.022_345_678), "0.022346");
        assert_eq!(of(f64::NAN), "null");
    }
}
