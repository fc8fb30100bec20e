//! The variants as columns for the script.

use crate::closure::Closure;
use crate::geom::exact::{ExactError, ExactField};
use crate::model::mechanism::{LinkId, Mechanism, Role, StateId};
use crate::model::ranking::Term;
use crate::page::contents::{Page, Redesigns};
use crate::rank::exact::modular;
use crate::redundancy::AnalysisError;
use crate::redundancy::contour_shares::contour_shares;
use crate::redundancy::local_mobility::idle_motions;
use crate::redundancy::motion::motion_basis;
use crate::score::evaluation::joint_loads::{Bearing, Bearings};
use crate::score::evaluation::terms::Scores;
use crate::score::outcome::ranking::RankedPool;
use crate::score::outcome::variant::Variant;
use crate::search::answer::ideas::freedom_patterns;
use crate::search::check::singular_values::CHECKED;
use crate::search::check::variant_mechanism;
use crate::search::question::space::{Choice, Variable, choice_name};
use crate::view::analysis::link_motions;
use crate::view::search::ranking::{ranking_head, ranking_notes};
use crate::view::search::variant::price_json;
use crate::view::search::{text, why};
use rayon::prelude::*;
use serde_json::{Value, json};

/// Ideas that a page says why of: two pages of its table. `ozols search --format json` says it of all.
const TOLD: usize = 50;

/// Figures that need a separate computation.
struct Further {
    states: Vec<(usize, usize)>,
    idle: String,
    contours: Option<Vec<usize>>,
}

fn compute_further(r: &Redesigns<'_>) -> Result<Vec<Further>, AnalysisError> {
    let search = &r.found.search;
    let exact = search.field();
    let one = |(i, c): (usize, &Variant<'_>)| -> Result<Further, AnalysisError> {
        let m = variant_mechanism::realize_variant(search, &c.assignment().choices);
        let states = m.state_ids().skip(1).map(|s| state_figures(exact, &m, s));
        Ok(Further {
            states: states.collect::<Result<_, _>>()?,
            idle: if i < CHECKED {
                idle_words_of(exact, &m)?
            } else {
                String::new()
            },
            contours: (c.redundant() > 0)
                .then(|| redundant_by_contour(exact, &m))
                .transpose()?,
        })
    };
    r.variants.par_iter().enumerate().map(one).collect()
}

/// Returns everything the script knows of the search: counts, what can be chosen, and a column for each figure of the variants.
pub(super) fn variant_columns(page: &Page<'_>, r: &Redesigns<'_>) -> Result<Value, AnalysisError> {
    let search = &r.found.search;
    let further = compute_further(r)?;
    let working = page.states.first().map(|s| s.working_mobility);
    let working = working.and_then(|w| i64::try_from(w).ok());
    let (idle_words, idle_word) = idle_words(&further);
    let state = |s: usize| {
        let of = further.iter().map(|f| f.states[s - 1]);
        let (mobility, redundant): (Vec<_>, Vec<_>) = of.unzip();
        json!({ "mobility": mobility, "redundant": redundant })
    };
    let changed = |c: &Variant<'_>| {
        let choices = c.assignment().choices.iter().enumerate();
        let changed = choices.filter(|(_, c)| **c != 0);
        changed.flat_map(|(v, &c)| [v, c]).collect::<Vec<_>>()
    };
    let added = |c: &Variant<'_>| {
        let idea = c.idea();
        idea.map(|i| freedom_patterns::in_words(&search.mechanism, &i.added))
    };
    let variables = search.space.variables.iter();
    let (conditions, mechanism) = (&search.conditions, &search.mechanism);
    Ok(json!({
        "space": search.size().to_string(),
        "determinate": r.found.determinate.total.to_string(),
        "admissible": r.found.listed_counts().total.to_string(),
        "max_redundant": conditions.max_redundant,
        "state": conditions.state.map(|s| s.state.index()),
        "variables": variables.map(|v| choices_json(mechanism, v)).collect::<Value>(),
        // Pairs of a variable and its choice, where that is not the present one.
        "choices": figure_column(r, changed),
        "cost": figure_column(r, |c| price_json(c.cost_milli())),
        "changes": figure_column(r, |c| c.change_count()),
        "mobility": figure_column(r, |c| c.mobility()),
        "redundant": figure_column(r, |c| c.redundant()),
        "external": conditions.state.map(|_| figure_column(r, |c| c.external_redundant())),
        "idle": conditions.keep_output.then(|| figure_column(r, |c| working.map(|w| c.mobility() - w))),
        // Idle motions repeat: each text once, and its number by variant.
        "idle_words": idle_words,
        "idle_word": idle_word,
        // The states but the free one.
        "states": (1..mechanism.states.len()).map(state).collect::<Value>(),
        "contours": further.iter().map(|f| f.contours.as_ref()).collect::<Vec<_>>(),
        "conditioning": figure_column(r, |c| c.second().opinion().map(|o| five_digits(o.conditioning))),
        "agree": figure_column(r, |c| c.second().opinion().map(|o| o.agree)),
        "lucky": figure_column(r, |c| c.over_stroke().and_then(|s| s.is_lucky())),
        "notes": figure_column(r, text::variant_footnote),
        // Whether everything was looked at, so that what ideas stand for is counted and no lower bound.
        "exact": r.found.is_exact(),
        "adds": figure_column(r, added),
        "symmetric": figure_column(r, |c| c.idea().and_then(|i| i.symmetric)),
        "stands_for": figure_column(r, |c| c.idea().map(|i| i.variants.to_string())),
        // Of the first ideas, line by line, what `ozols search` says of them.
        "why": why_ideas(r),
        "workload": workload_json(r),
    }))
}

/// Returns the texts on idle motions, each one once, and the number of its text by variant.
fn idle_words(further: &[Further]) -> (Vec<String>, Vec<usize>) {
    let mut words = vec![String::new()];
    let mut word = Vec::new();
    for f in further {
        let known = words.iter().position(|w| *w == f.idle);
        word.push(known.unwrap_or_else(|| {
            words.push(f.idle.clone());
            words.len() - 1
        }));
    }
    (words, word)
}

fn why_ideas(r: &Redesigns<'_>) -> Vec<Vec<(String, String)>> {
    let ideas = r.variants.iter().filter(|v| v.idea().is_some());
    let first: Vec<_> = ideas.take(TOLD).map(Variant::assignment).collect();
    why::rows_of_ideas(r.found, &first)
}

fn figure_column<T>(r: &Redesigns<'_>, of: impl Fn(&Variant<'_>) -> T) -> Vec<T> {
    r.variants.iter().map(of).collect()
}

/// Returns what can be put at a variable.
fn choices_json(m: &Mechanism, v: &Variable) -> Value {
    let choice = |c: &Choice| {
        let first = v.joints.first();
        let option = first.and_then(|&j| m.joints[j].options.get(c.option));
        json!({
            "names": v.joints.iter().map(|&j| choice_name(m, j, c)).collect::<Value>(),
            "class": option.map(|o| o.joint_type.class_numeral()),
            "unloading": c.unloading.is_some(),
        })
    };
    json!({
        "joints": v.joints.iter().map(|j| j.index()).collect::<Value>(),
        "choices": v.choices.iter().map(choice).collect::<Value>(),
    })
}

/// Returns W and σ of a state of a mechanism.
pub(super) fn state_figures(
    exact: &ExactField,
    m: &Mechanism,
    state: StateId,
) -> Result<(usize, usize), ExactError> {
    let closure = Closure::new(exact, m, state)?;
    let rank = modular::rank_modulo(exact, &closure);
    Ok((closure.columns.len() - rank, closure.rows() - rank))
}

/// Describes the idle motions of a mechanism in the free state.
pub(super) fn idle_words_of(exact: &ExactField, m: &Mechanism) -> Result<String, ExactError> {
    let closure = Closure::new(exact, m, StateId::FREE)?;
    let kernel = motion_basis(exact, &closure);
    let outputs: Vec<LinkId> = m
        .link_ids()
        .filter(|&l| m.links[l].role == Role::Output)
        .collect();
    let found = idle_motions(exact, m, &closure, &kernel, &outputs);
    Ok(link_motions::told_once(found.iter().map(|i| link_motions::describe_idle(m, i))).join("; "))
}

/// Returns σ of each contour of a mechanism in the free state.
pub(super) fn redundant_by_contour(
    exact: &ExactField,
    m: &Mechanism,
) -> Result<Vec<usize>, ExactError> {
    let closure = Closure::new(exact, m, StateId::FREE)?;
    Ok(contour_shares(exact, &closure)
        .iter()
        .map(|s| s.redundant)
        .collect())
}

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
        "total": all().map(|x| x.map(|r| five_digits(r.total))).collect::<Vec<_>>(),
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
