//! Head of a search for people: how many variants there are, how that was checked, and their mobilities.

use crate::search::answer::estimate::{Drawn, Estimate};
use crate::search::check::singular_values::Summary;
use crate::search::question::throughout::PoseOnly;
use crate::view::prelude::*;
use crate::view::search::{numeric, second_opinion};
use num_traits::One;

/// Maximum number of mobilities in a text; JSON and the page have them all.
const MOBILITIES: usize = 12;

/// The heading of a list of ideas.
pub(super) const IDEAS: &str =
    "ideas, cheapest first; an idea includes all variants that add the same freedoms";

/// Returns the verdict and how it was checked; with `verbose` also which variants are minimal, and the counts by mobility.
pub(super) fn counts_text(outcome: &Outcome, width: Option<u16>, verbose: bool) -> String {
    let verbose = verbose || matches!(outcome.request.list, List::Nothing | List::Top(0));
    let mut out = Report::new(width);
    let mechanism = &outcome.search.mechanism.name;
    out.add_line(format!("{mechanism}: {}", verdict_line(outcome)));
    let minimal = minimal_line(outcome).filter(|_| verbose);
    let lines = pose_lines(outcome, verbose).into_iter().chain(minimal);
    let lines = lines.chain(certainty_lines(outcome));
    lines.for_each(|line| out.add_line(format!("  {line}")));
    let table = if verbose {
        by_mobility(outcome, width)
    } else {
        String::new()
    };
    out.text() + &fit_lines(&table, width)
}

/// Returns how sure the counts are, and what would give more.
pub(crate) fn certainty_lines(outcome: &Outcome) -> Vec<String> {
    let exact = outcome.numeric.is_none();
    // Two primes that agree on rounded digits prove nothing.
    let check = outcome.check.filter(|_| outcome.is_confirmed());
    let check = check.map(|check| {
        let done = "Checked: two runs with different primes agree";
        let open = "Not checked by a second prime: interrupted";
        if check.agree { done } else { open }.to_owned()
    });
    let lines = numeric::numeric_lines(outcome).into_iter();
    let lines = lines
        .chain(second_opinion::opinion_lines(outcome))
        .chain(check);
    let stopped = exact.then(|| stopped_line(outcome));
    let more = exact.then(|| more_line(outcome));
    let lines = lines.chain(stopped.flatten()).chain(estimate_line(outcome));
    lines.chain(more.flatten()).collect()
}

/// Returns "σ = 0", or the number of redundant constraints allowed.
fn redundancy_condition(outcome: &Outcome) -> String {
    match outcome.search.conditions.max_redundant {
        0 => "σ = 0".to_owned(),
        most => format!("σ ≤ {most}"),
    }
}

/// Returns what variants keep, in words.
fn keep_motion(mechanism: &Mechanism) -> &'static str {
    match (mechanism.kept_drives(), mechanism.locked_drives()) {
        (0, 0) => "keep the output motion",
        (_, 0) => "keep the motion of outputs and drives",
        _ => "have drives that decide the outputs, each freely",
    }
}

/// Returns what variants have to meet besides the number of redundant constraints, in words.
fn further_conditions(outcome: &Outcome) -> Vec<String> {
    let conditions = &outcome.search.conditions;
    let more = [
        conditions
            .keep_output
            .then(|| keep_motion(&outcome.search.mechanism).to_owned() + where_kept(outcome)),
        conditions.max_mobility.map(|w| format!("have W ≤ {w}")),
        conditions
            .max_changes
            .map(|c| format!("change at most {}", count_noun(c as usize, "joint"))),
    ];
    let more = more.into_iter().flatten();
    more.chain(in_state(&outcome.search)).collect()
}

/// Returns how many variants meet all conditions: "12 of 64 variants have σ = 0".
pub(crate) fn verdict_line(outcome: &Outcome) -> String {
    let least = if outcome.is_counted() {
        ""
    } else {
        "at least "
    };
    let (condition, more) = (redundancy_condition(outcome), further_conditions(outcome));
    let all = match more.split_last() {
        None => format!("have {condition}"),
        Some((last, rest)) => {
            let head = std::iter::once(format!("have {condition}")).chain(rest.iter().cloned());
            format!("{} and {last}", head.collect_vec().join(", "))
        }
    };
    let listed = &outcome.listed_counts().total;
    let good = if let Some(found) = &outcome.numeric {
        format!("numeric: {}", numeric::from_to(&found.admissible))
    } else if listed.is_zero() && least.is_empty() {
        "none".to_owned()
    } else if !outcome.is_confirmed() {
        format!("not exact: {least}{}", group_thousands(listed))
    } else {
        let [_, estimate] = outcome.estimates();
        format_count(listed, outcome.is_counted(), estimate)
    };
    let of = plural_of(&group_thousands(outcome.search.size()), "variant");
    format!("{good} of {of} {all}")
}

/// Returns what else there is to say of the counts: nothing to choose, other poses, and the number of determinate variants.
pub(crate) fn pose_lines(outcome: &Outcome, verbose: bool) -> Vec<String> {
    let fixed = (outcome.search.size() == BigUint::from(1u8)).then(|| {
        "no joint has an option with more freedoms than its own type; list some under [search], for example options = \
         [\"cylindrical\", \"spherical\"]"
            .to_owned()
    });
    let beside = verbose.then(|| but_in_the_pose(outcome)).flatten();
    let wanted = verbose || outcome.listed_counts().total.is_zero();
    let before = (wanted && !further_conditions(outcome).is_empty()).then(|| {
        let determinate = match &outcome.numeric {
            Some(found) => numeric::from_to(&found.determinate),
            None => determinate_count(outcome),
        };
        let condition = redundancy_condition(outcome);
        format!("{determinate} with {condition} before the other conditions")
    });
    let lines = fixed.into_iter().chain(in_the_pose(outcome));
    lines.chain(beside).chain(before).collect()
}

/// Describes where variants keep the motion, as far as it is known.
fn where_kept(outcome: &Outcome) -> &'static str {
    match &outcome.lasting {
        Ok(_) => " throughout the motion",
        Err(PoseOnly::Rests | PoseOnly::Numeric) => "",
        Err(_) => " in the drawn pose",
    }
}

/// Describes how many variants keep the motion in all poses but the drawn one. `None` if there are none or it is not known.
fn but_in_the_pose(outcome: &Outcome) -> Option<String> {
    let lasting = &outcome.lasting.as_ref().ok()?.total;
    let everywhere = outcome.count_everywhere().filter(|n| n > lasting)?;
    let more = everywhere - lasting;
    let keep = if more.is_one() { "keeps" } else { "keep" };
    let more = group_thousands(&more);
    Some(format!(
        "{more} more {keep} it in all poses near the drawn one, which is singular for these"
    ))
}

/// Describes how many variants keep the motion in the drawn pose, or why only these are counted. `None` if neither applies.
fn in_the_pose(outcome: &Outcome) -> Option<String> {
    let here = &outcome.admissible.total;
    match &outcome.lasting {
        Ok(lasting) if lasting.total == *here => None,
        Ok(lasting) => {
            let lost = here - &lasting.total;
            let lose = if lost.is_one() { "loses" } else { "lose" };
            let (here, lost) = (group_thousands(here), group_thousands(lost));
            let all = typed_option("pose-only", "");
            Some(format!(
                "{here} in the drawn pose; {lost} of these {lose} the motion in other poses ({all} lists them too)"
            ))
        }
        Err(
            PoseOnly::Asked
            | PoseOnly::OutputChange
            | PoseOnly::Rests
            | PoseOnly::Numeric
            | PoseOnly::NotCounted,
        ) => None,
        Err(_) if here.is_zero() => None,
        Err(why) => Some(format!("not followed along the motion: {why}")),
    }
}

/// Returns the number of determinate variants.
fn determinate_count(outcome: &Outcome) -> String {
    let [estimate, _] = outcome.estimates();
    let estimate = estimate.filter(|_| outcome.is_confirmed());
    let exact = outcome.is_determinate_counted();
    format_count(&outcome.determinate.total, exact, estimate)
}

/// Returns the counts by mobility. Empty if there are none.
fn by_mobility(outcome: &Outcome, width: Option<u16>) -> String {
    let exact = outcome.determinate.by_mobility.keys();
    let exact = exact.chain(outcome.admissible.by_mobility.keys()).copied();
    let mobilities: BTreeSet<i64> = match &outcome.numeric {
        Some(found) => numeric::all_mobilities(found),
        None => exact.collect(),
    };
    if mobilities.is_empty() {
        return String::new();
    }
    // Mobilities that no admissible variant has are of no use to a designer: they are told in one row.
    let may = |w: &i64| {
        let found = outcome.numeric.as_ref();
        found.is_some_and(|f| f.admissible.doubtful.by_mobility.contains_key(w))
    };
    let (shown, rest): (Vec<i64>, Vec<i64>) = mobilities.iter().partition(|w| {
        outcome.admissible.total.is_zero()
            || outcome.admissible.by_mobility.contains_key(w)
            || may(w)
    });
    // A column more where some variants lose the motion.
    let lasting = outcome.lasting.as_ref().ok();
    let lasting = lasting.filter(|l| l.total != outcome.admissible.total);
    let row = |name: String, of: &[i64]| {
        let sum = |m: &BTreeMap<i64, BigUint>| {
            group_thousands(of.iter().filter_map(|w| m.get(w)).sum::<BigUint>())
        };
        let (determinate, admissible) = (&outcome.determinate, &outcome.admissible);
        if let Some(lasting) = lasting {
            let of = [determinate, admissible, lasting];
            let sums = of.map(|counts| sum(&counts.by_mobility));
            return std::iter::once(name).chain(sums).collect();
        }
        if let Some(found) = &outcome.numeric {
            let of = |b| numeric::by_mobility(b, of);
            return vec![name, of(&found.determinate), of(&found.admissible)];
        }
        vec![
            name,
            sum(&determinate.by_mobility),
            sum(&admissible.by_mobility),
        ]
    };
    // Long tables are of robots with many joints; the least mobilities are those that let the least move idly.
    let told = if shown.len() > MOBILITIES {
        MOBILITIES - 1
    } else {
        shown.len()
    };
    let (told, folded) = shown.split_at(told);
    let each = told.iter().map(|w| row(w.to_string(), &[*w]));
    let folded = match folded {
        [least, .., most] => Some(row(format!("{least} to {most}"), folded)),
        _ => None,
    };
    let left_out = match (rest.first(), rest.last()) {
        (Some(least), Some(most)) if least == most => Some(row(least.to_string(), &rest)),
        (Some(least), Some(most)) => Some(row(format!("rest, {least} to {most}"), &rest)),
        _ => None,
    };
    let rows = each.chain(folded).chain(left_out);
    let admissible = match lasting {
        Some(_) => "in the drawn pose | throughout",
        None => "admissible",
    };
    let heads = format!("W | {} | {admissible}", redundancy_condition(outcome));
    format!("\n{}\n", text_table(&heads, rows, width))
}

/// Describes how many of the listed variants are minimal, and what the others are. `None` if they were not counted.
fn minimal_line(outcome: &Outcome) -> Option<String> {
    let minimal = outcome.count_minimal()?;
    let rest = &outcome.listed_counts().total - &minimal;
    if outcome.listed_counts().total.is_zero() {
        return None;
    }
    let all = group_thousands(&minimal);
    if rest.is_zero() {
        return Some("all are minimal: none has all the freedoms of another".to_owned());
    }
    let idle = match outcome.search.conditions.max_redundant {
        0 => "idle motion",
        _ => "freedoms",
    };
    let rest = group_thousands(&rest);
    Some(format!(
        "{all} minimal; the other {rest} are one of these plus {idle}"
    ))
}

/// Returns the conditions in a searched state: "hold a in state clamped" and "have external σ ≤ 2, harmful ≤ 0 in it".
fn in_state(search: &Search) -> Vec<String> {
    let Some(s) = search.conditions.state else {
        return Vec::new();
    };
    let m = &search.mechanism;
    let state = format!("in state {}", m.states[s.state]);
    let held = search
        .held_bodies()
        .map(|l| m.links[l].id.as_str())
        .join(", ");
    let limits = [
        s.max_external.map(|n| format!("external σ ≤ {n}")),
        s.max_harmful.map(|n| format!("harmful ≤ {n}")),
    ];
    let limits = limits.into_iter().flatten().join(", ");
    match (held.is_empty(), limits.is_empty()) {
        (true, true) => vec![format!("have any external σ {state}")],
        (true, false) => vec![format!("have {limits} {state}")],
        (false, true) => vec![format!("hold {held} {state}")],
        (false, false) => vec![
            format!("hold {held} {state}"),
            format!("have {limits} in it"),
        ],
    }
}

/// Describes why a search ended early, and what its counts and its list are. `None` if it did not end early.
pub(crate) fn stopped_line(outcome: &Outcome) -> Option<String> {
    let why = match outcome.stop {
        Stop::Exhausted => return None,
        Stop::NotCounted => format!("Not counted ({})", typed_option("no-count", "")),
        stop => format!("Stopped early ({})", stop.word()),
    };
    // What is proven of a list is told after it.
    let list = match outcome.known_up_to() {
        Some(_) if !outcome.request.distinct => "",
        _ => ", variants are valid but may not be the cheapest",
    };
    Some(format!("{why}: counts are lower bounds{list}"))
}

/// Formats a number of variants. One that is not exact is a lower bound, with an upper bound and an estimate if they are known.
pub(crate) fn format_count(counted: &BigUint, exact: bool, estimate: Option<&Estimate>) -> String {
    let own = group_thousands(counted);
    match estimate {
        _ if exact => own,
        None => format!("at least {own}"),
        Some(e) => match &e.at_most {
            None => format!("at least {own}, about {:.3e},", e.mean),
            Some(most) if most == counted => own,
            Some(most) => format!("{own} to {}, about {:.3e},", group_thousands(most), e.mean),
        },
    }
}

/// Describes how the numbers of variants that are not counted are known.
pub(crate) fn estimate_line(outcome: &Outcome) -> Option<String> {
    let [determinate, admissible] = outcome.estimates();
    let said = |e: &Estimate, what| {
        let [low, high] = e.between;
        let Drawn { of, found } = e.drawn;
        format!(
            "{low:.3e} to {high:.3e} {what} ({} of {} samples of those not ruled out)",
            group_thousands(found),
            group_thousands(of)
        )
    };
    let first = admissible.map(|e| said(e, "admissible"));
    let second = determinate.map(|e| said(e, "determinate"));
    let how = admissible.or(determinate)?;
    let parts: Vec<String> = first.into_iter().chain(second).collect();
    Some(format!(
        "Estimated, not counted, with 95 % confidence: {} ({})",
        parts.join(", "),
        typed_option("seed", how.seed)
    ))
}

/// Returns the price of a larger budget, if one ended the search: time and memory grow in proportion to nodes.
pub(crate) fn more_line(outcome: &Outcome) -> Option<String> {
    match outcome.stop {
        Stop::NodeBudget => {
            let nodes = typed_option("nodes", outcome.request.nodes.saturating_mul(10));
            Some(format!(
                "With {nodes} more is counted, in about ten times the time and memory"
            ))
        }
        Stop::Memory => Some(format!(
            "More is counted where there is more memory ({}), not with more nodes",
            typed_option("memory", "")
        )),
        Stop::Exhausted | Stop::Interrupted | Stop::NotCounted => None,
    }
}

/// Describes how much of a list by cost is proven, although the search ended early.
pub(crate) fn proven_line(summary: &Summary) -> Option<String> {
    match summary.proven? {
        0 => None,
        n if n == summary.given => Some(format!("Proven the cheapest: all {n}")),
        n => Some(format!(
            "Proven the cheapest: the first {n}; the others are valid"
        )),
    }
}

/// Returns an estimate as data; `between` is the interval with a confidence of 95 %.
pub(crate) fn estimate_json(e: &Estimate) -> Value {
    let Drawn { of, found } = e.drawn;
    json!({
        "mean": e.mean,
        "standard_error": e.standard_error,
        "between": e.between,
        "at_most": e.at_most.as_ref().map(ToString::to_string),
        "samples": { "of": of, "found": found },
        "seed": e.seed,
    })
}
