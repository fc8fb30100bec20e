//! A search as JSON, and its variants as JSON lines, written as they come. The keys are a stable contract, in this order; counts are
//! strings, since they outgrow 2^53.

use crate::rank::rounded::verdict::RankVerdict;
use crate::score::outcome::listing::Variants;
use crate::score::outcome::remarks::Remarks;
use crate::score::outcome::why::Whys;
use crate::score::request::prepare::LooksRounded;
use crate::search::answer::why_none::Relaxation;
use crate::search::diagram::Diagram;
use crate::view::prelude::*;
use crate::view::pretty_json;
use crate::view::search::counts::estimate_json;
use crate::view::search::second_opinion::certainty_word;
use crate::view::search::variant::VariantData;
use crate::view::search::why::Teller;
use crate::view::search::{numeric, ranking, second_opinion, variant};
use std::io::{self, Write};

/// Calls `tell` on each variant of a list with its data until that fails. Ideas have their reasons.
///
/// # Errors
/// Returns an error if `tell` does.
pub fn for_each_variant<'a, E>(
    outcome: &Outcome,
    mut variants: impl Iterator<Item = Variant<'a>>,
    mut tell: impl FnMut(&Variant<'a>, &VariantData<'_, 'a>) -> Result<(), E>,
) -> Result<(), E> {
    let whys = outcome.request.distinct.then(|| Whys::new(outcome));
    let mut teller = whys
        .as_ref()
        .map(|w| (Teller::new(outcome, w), w.explain_each()));
    variants.try_for_each(|v| {
        let why = teller.as_mut();
        let why = why.map(|(teller, why)| teller.why_json(&why(v.assignment())));
        tell(
            &v,
            &VariantData {
                outcome,
                variant: &v,
                why,
            },
        )
    })
}

/// Returns an outcome with its variants and the remarks as one value, and passes each variant to `each`.
///
/// # Errors
/// No error is known.
pub fn search_value<'o>(
    outcome: &'o Outcome,
    mut variants: Variants<'o>,
    remarks: &Remarks,
    mut each: impl FnMut(&Variant<'o>),
) -> serde_json::Result<Value> {
    let mut list = Vec::new();
    for_each_variant(outcome, variants.by_ref(), |v, data| {
        each(v);
        list.push(serde_json::to_value(data)?);
        serde_json::Result::Ok(())
    })?;
    let tail = tail_json(outcome, &variants, remarks, None);
    Ok(join_objects([
        search_json(outcome),
        json!({ "variants": list }),
        tail,
    ]))
}

/// Writes an outcome with its variants and the remarks as one value; `seconds` where somebody has a
/// clock, asked once all else is written. No other key differs between runs.
///
/// # Errors
/// Those of the writer.
pub fn write_json(
    out: &mut dyn Write,
    outcome: &Outcome,
    mut variants: Variants<'_>,
    remarks: &Remarks,
    seconds: Option<&dyn Fn() -> f64>,
) -> io::Result<()> {
    // Variants stream: the closing brace of the header waits for them.
    let text = pretty_json(&search_json(outcome))?;
    let open = text.strip_suffix("\n}").unwrap_or(&text);
    write!(out, "{open},\n  \"variants\": [")?;
    for_each_variant(outcome, variants.by_ref(), |v, data| -> io::Result<()> {
        let comma = if v.position() == 1 { "" } else { "," };
        write!(out, "{comma}\n    ")?;
        Ok(serde_json::to_writer(&mut *out, data)?)
    })?;
    let seconds = seconds.map(|s| s());
    let tail = tail_json(outcome, &variants, remarks, seconds);
    let text = serde_json::to_string_pretty(&tail)?;
    let rest = text.strip_prefix("{\n").unwrap_or(&text);
    writeln!(out, "\n  ],\n{rest}")
}

/// Writes the variants, one a line, and a last line that says why where they are not all that was asked for.
///
/// # Errors
/// Those of the writer.
///
/// # Examples
/// ```
/// let outcome = ozols::search(&ozols::built_in("four-bar")?, &ozols::Request::default())?;
/// let mut lines = Vec::new();
/// ozols::view::search::json::write_lines(&mut lines, &outcome, outcome.variants())?;
/// assert_eq!(String::from_utf8(lines)?.lines().count(), 10); // A variant each.
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_lines(
    out: &mut dyn Write,
    outcome: &Outcome,
    mut variants: Variants<'_>,
) -> io::Result<()> {
    for v in variants.by_ref() {
        let (variant, why) = (&v, None);
        let data = VariantData {
            outcome,
            variant,
            why,
        };
        serde_json::to_writer(&mut *out, &data)?;
        writeln!(out)?;
    }
    if variants.stop() != Stop::Exhausted || outcome.numeric.is_some() || !outcome.is_confirmed() {
        serde_json::to_writer(&mut *out, &last_line(outcome, &variants))?;
        writeln!(out)?;
    }
    Ok(())
}

/// Returns counts by a property.
fn counts_json<K: ToString>(counts: &BTreeMap<K, BigUint>) -> Value {
    let text = |(k, n): (&K, &BigUint)| (k.to_string(), n.to_string());
    counts.iter().map(text).collect()
}

/// Returns counts by W, each by number of changes.
fn by_both(counts: &BTreeMap<(i64, u32), BigUint>) -> Value {
    let mut nested: BTreeMap<i64, BTreeMap<u32, String>> = BTreeMap::new();
    for ((w, c), n) in counts {
        nested.entry(*w).or_default().insert(*c, n.to_string());
    }
    json!(nested)
}

/// Returns counts by cost, the cheapest first.
fn by_cost(counts: &BTreeMap<i64, BigUint>) -> Value {
    let text = |(c, n): (&i64, &BigUint)| (format_cost(*c), n.to_string());
    counts.iter().map(text).collect()
}

/// Returns the size of a diagram.
fn diagram_size(diagram: Option<&Diagram>) -> Value {
    json!({
        "largest_layer": diagram.map(|d| d.largest_layer),
        "nodes": diagram.map(|d| d.nodes),
    })
}

/// Returns everything but the variants.
///
/// # Examples
/// ```
/// let outcome = ozols::search(&ozols::built_in("gripper-10")?, &ozols::Request::default())?;
/// let json = ozols::view::search::json::search_json(&outcome).to_string();
/// assert!(json.contains("\"25761436\"") && json.contains("\"21817629\""));
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn search_json(outcome: &Outcome) -> Value {
    let (determinate, admissible) = (&outcome.determinate, &outcome.admissible);
    let diagrams = outcome.diagrams.as_ref();
    let [first, second] = [
        diagrams.map(|d| &d.determinate),
        diagrams.map(|d| &d.admissible),
    ];
    let layer = |d: Option<&Diagram>| d.map(|d| d.largest_layer);
    let estimates = outcome.estimates().map(|e| e.map(estimate_json));
    let costs = outcome.admissible_by_cost();
    let left_out = [
        (determinate.only_total || admissible.only_total).then_some("counts by kind"),
        costs.is_none().then_some("counts by cost"),
    ];
    let mechanism = &outcome.search.mechanism;
    let counts_only = matches!(outcome.request.list, List::Nothing | List::Top(0));
    let everywhere = counts_only.then(|| outcome.count_everywhere()).flatten();
    let lasting = outcome.lasting.as_ref().ok();
    json!({
        "mechanism": mechanism.name,
        "space": outcome.search.size().to_string(),
        "determinate": determinate.to_string(),
        "determinate_exact": outcome.is_determinate_exact(),
        "determinate_estimate": estimates[0],
        "by_mobility": counts_json(&determinate.by_mobility),
        "by_mobility_and_changes": by_both(&determinate.by_mobility_and_changes),
        "by_redundant": counts_json(&determinate.by_redundant),
        "by_changes": counts_json(&determinate.by_changes),
        "by_freedoms": counts_json(&determinate.by_freedoms),
        "admissible": admissible.to_string(),
        "admissible_estimate": estimates[1],
        "admissible_by_mobility": counts_json(&admissible.by_mobility),
        "admissible_by_mobility_and_changes": by_both(&admissible.by_mobility_and_changes),
        "admissible_by_redundant": counts_json(&admissible.by_redundant),
        "admissible_by_changes": counts_json(&admissible.by_changes),
        "admissible_by_freedoms": counts_json(&admissible.by_freedoms),
        "admissible_by_cost": by_cost(&costs.unwrap_or_default()),
        // Those that keep the motion throughout the motion of the mechanism as built are the ones listed.
        "lasting": lasting.map(ToString::to_string),
        "everywhere": everywhere.as_ref().map(ToString::to_string),
        "lasting_by_mobility": lasting.map(|l| counts_json(&l.by_mobility)),
        "lasting_by_cost": outcome.lasting_by_cost().as_ref().map(by_cost),
        "pose_only": outcome.lasting.as_ref().err().map(ToString::to_string),
        "minimal": outcome.count_minimal().map(|n| n.to_string()),
        "largest_layer": layer(first).max(layer(second)),
        "nodes": first.zip(second).map(|(a, b)| a.nodes + b.nodes),
        // A list of one number.
        "rows_per_contour": diagrams.map(|d| [d.rows_per_contour]),
        "determinate_diagram": diagram_size(first),
        "admissible_diagram": diagram_size(second),
        "stop": outcome.stop.word(),
        "check": outcome.check.map(|c| json!({
            "primes": c.primes.map(|p| p.to_string()),
            // Two primes that agree on rounded digits prove nothing.
            "agree": (c.agree && outcome.is_confirmed()).then_some(true),
        })),
        "measured": outcome.measured.as_ref().map(measured_json),
        "poses": outcome.stroke.as_ref().map(|s| json!({ "asked": s.asked, "reached": s.count_reached() })),
        "ranking": outcome.ranking.as_ref().map(|p| ranking::ranking_json(mechanism, p)),
        "exact": outcome.is_exact() && mechanism.assumed.is_empty(),
        "assumptions": mechanism.assumed,
        // How sure counts are that are not exact, and not cut short.
        "certainty": certainty_word(outcome),
        "numeric": outcome.numeric.as_ref().map(numeric::numeric_json),
        "second_opinion": second_opinion::opinion_json(outcome),
        // Counts that would take more than the memory allowed.
        "left_out": left_out.into_iter().flatten().collect::<Vec<_>>(),
    })
}

/// Returns the ranks by singular values of coordinates that look rounded; `meant` is the mechanism searched: "as written", "snapped", "near",
/// "undecided".
fn measured_json((why, verdicts): &LooksRounded) -> Value {
    let figures = |(mobility, redundant): (usize, usize)| json!({ "mobility": mobility, "redundant": redundant });
    let state = |v: &RankVerdict| {
        json!({
            "state": v.state,
            "exact": figures(v.figures_at(v.as_written)),
            "svd": figures(v.figures_at(v.at_least())),
            "smallest_kept": v.numeric.unwrap_or_default().kept,
            "largest_dropped": v.numeric.unwrap_or_default().dropped,
            "meant": v.as_word(),
        })
    };
    json!({
        "coordinates": why.coordinates,
        "example": { "place": why.place, "value": why.value },
        "tolerance": verdicts.iter().fold(0.0, |a: f64, v| a.max(v.tolerance)),
        "agree": verdicts.iter().all(RankVerdict::agrees_as_written),
        "states": verdicts.iter().map(state).collect::<Vec<_>>(),
    })
}

/// Returns the data after the variants; `seconds` is the time of the whole run. Without any variant it has the numbers for eased
/// conditions, and the reasons why there is none.
pub(crate) fn tail_json(
    outcome: &Outcome,
    variants: &Variants<'_>,
    remarks: &Remarks,
    seconds: Option<f64>,
) -> Value {
    let (summary, stop) = (variants.summary(), variants.cut_short());
    let mut out = json!({
        "variants_complete": stop.is_none(),
        "variants_stop": stop.map(Stop::word),
        // How many, from the first on, are proven to be the cheapest, where the search ended early.
        "variants_proven": summary.proven,
        "variants_checked": summary.checked,
        "variants_disagreeing": summary.disagreeing,
        "variants_check_failed": summary.failed,
        "variants_posed": summary.posed,
        "variants_lucky": summary.lucky,
    });
    if outcome.listed_counts().total.is_zero() {
        let why = &remarks.hopeless;
        let named = |joints: &[JointId]| -> Vec<&str> {
            let ids = joints
                .iter()
                .map(|&j| outcome.search.mechanism.joints[j].id.as_str());
            ids.collect()
        };
        let eased = |(how, n): &(Relaxation, BigUint)| {
            let (condition, to) = condition_key(*how);
            let to = to.map_or(json!(true), Value::from);
            json!({ "condition": condition, "to": to, "admissible": n.to_string() })
        };
        out["relaxations"] = remarks.eased.iter().map(eased).collect();
        let offers = remarks.offered_options(&outcome.request).iter();
        let offers = offers.map(|o| json!({ "joint": o.joint, "options": o.names }));
        let nuts = remarks.offered_unloading(&outcome.request).iter();
        let nuts = nuts.map(|i| json!({ "joint": i.joints.join(","), "unloading": i.names }));
        out["offers"] = offers.chain(nuts).collect();
        out["least_redundant"] = json!(why.least_redundant);
        out["unchanged"] = json!(named(&why.unchanged));
        out["frozen"] = json!(named(&why.frozen));
    }
    out["symmetric"] = json!(remarks.symmetric.as_ref().map(variant::symmetric_data));
    if let Some(seconds) = seconds {
        out["seconds"] = json!(seconds);
    }
    out
}

/// Returns the last of some JSON lines, where the variants are not all that was asked for.
pub(crate) fn last_line(outcome: &Outcome, variants: &Variants<'_>) -> Value {
    json!({
        "stop": variants.stop().word(),
        "given": variants.summary().given,
        "proven": variants.summary().proven.unwrap_or(0),
        "admissible": outcome.admissible.to_string(),
        "admissible_exact": outcome.is_exact() && outcome.search.mechanism.assumed.is_empty(),
        "certainty": certainty_word(outcome),
        "numeric": outcome.numeric.as_ref().map(numeric::numeric_json),
    })
}

/// Returns the name of a condition that was eased, and the number it is eased to.
fn condition_key(how: Relaxation) -> (&'static str, Option<i64>) {
    match how {
        Relaxation::Redundant(n) => ("max-redundant", Some(i64::from(n))),
        Relaxation::External(n) => ("max-external", Some(i64::from(n))),
        Relaxation::Harmful(n) => ("max-harmful", Some(i64::from(n))),
        Relaxation::Mobility(n) => ("max-mobility", Some(n)),
        Relaxation::Changes(n) => ("max-changes", Some(i64::from(n))),
        Relaxation::OutputChange => ("allow-output-change", None),
        Relaxation::FreeDrives => ("drives", None),
        Relaxation::LooseObject => ("allow-loose-object", None),
        Relaxation::PoseOnly => ("pose-only", None),
    }
}
