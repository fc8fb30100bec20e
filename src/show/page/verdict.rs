//! The verdict in words.

use super::contents::{Page, Redesigns};
use crate::format::{count_noun, format_cost, group_thousands, join_and};
use crate::model::mechanism::{Mechanism, Role};
use crate::redundancy::stress::StressVerdict;
use crate::score::outcome::variant::Variant;
use crate::search::answer::k_best::Assignment;
use crate::view::analysis::{Analysis, State};
use crate::view::search::counts::in_state;
use crate::view::search::counts::where_kept;
use crate::view::search::numeric;
use crate::view::search::second_opinion;
use crate::view::search::stopped_early::format_count;
use itertools::Itertools;
use maud::{Markup, html};
use num_traits::{One, Zero};

/// The greatest number of idle motions listed.
const TOLD: usize = 4;

pub(super) fn verdict_html(page: &Page<'_>, analysis: &Analysis<'_>) -> Markup {
    let several = analysis.states.len() > 1;
    html! {
        @for (i, s) in analysis.states.iter().enumerate() {
            div class={ "verdict " (if s.found.redundant == 0 && s.found.at_most().is_none() { "good" } else { "bad" }) } {
                @if several { p.label { "State " (s.found.state) } }
                p.head { (verdict_head(s)) }
                p {
                    (state_sentences(s).join(" "))
                    @if i == 0 { " " (redesigns_sentence(page, s)) }
                }
            }
        }
    }
}

/// Returns the verdict in a few words.
///
/// # Examples
/// ```
/// use ozols::{page::verdict::verdict_head, view::analysis::Analysis};
/// let four_bar = ozols::built_in("four-bar")?;
/// let found = ozols::analyze(&four_bar)?;
/// assert_eq!(verdict_head(&Analysis::new(&four_bar, &found, &[]).states[0]), "3 redundant constraints");
/// # Ok::<(), ozols::Error>(())
/// ```
pub fn verdict_head(s: &State<'_>) -> String {
    capitalise_first(&s.verdict())
}

fn capitalise_first(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().map(|c| c.to_ascii_uppercase());
    first.into_iter().chain(rest).collect()
}

/// Returns the meaning of the verdict, in sentences.
pub fn state_sentences(told: &State<'_>) -> Vec<String> {
    let s = told.found;
    let mut out = Vec::new();
    if s.at_most().is_some() {
        return vec![format!("{}.", s.choice.as_deref().unwrap_or_default())];
    }
    out.push(
        if s.redundant == 0 {
            "Slightly inaccurate parts still assemble without strain, and the loads alone determine the joint forces."
        } else {
            "Slightly inaccurate parts bind: they must be forced together, and the joints carry load even without an external load."
        }
        .to_owned(),
    );
    if let Some(e) = s.external.as_ref().filter(|e| e.redundant > 0) {
        let of = |v: StressVerdict| {
            let external = s.self_stresses.iter().filter(|t| t.external);
            external.filter(|t| t.verdict == v).count()
        };
        let (harmless, harmful) = (of(StressVerdict::Harmless), of(StressVerdict::Harmful));
        let split = if harmless + harmful == 0 {
            String::new()
        } else {
            format!(": {harmless} harmless (friction shared between contacts), {harmful} harmful")
        };
        out.push(format!(
            "{} of them {} from the joints that this state adds{split}.",
            e.redundant,
            if e.redundant == 1 { "comes" } else { "come" }
        ));
    }
    out.push(mobility_sentence(told));
    out.extend(told.drive_faults().map(|f| capitalise_first(&f) + "."));
    let idle = told.idle_motions();
    let more = idle.len().saturating_sub(TOLD);
    if !idle.is_empty() {
        let list = idle.iter().take(TOLD).join("; ");
        let more = if more > 0 {
            format!("; and {more} more")
        } else {
            String::new()
        };
        out.push(format!("Idle: {list}{more}."));
    }
    out
}

fn mobility_sentence(told: &State<'_>) -> String {
    let s = told.found;
    let freedoms = |n: usize| match n {
        1 => "1 degree of freedom".to_owned(),
        n => format!("{n} degrees of freedom"),
    };
    let Some(finite) = told.finite_mobility() else {
        return format!(
            "W = {} in this pose; the finite mobility is undecided ({} to {}).",
            s.mobility,
            s.finite.mobility,
            s.finite.at_most()
        );
    };
    match (s.mobility, finite) {
        (0, _) => "Nothing moves in this state.".to_owned(),
        // At a dead point the motion of the drive is not idle.
        (w, f) if w == f && (s.idle.is_empty() || s.local_mobility == 0) => {
            format!("It has {} (W = {w}).", freedoms(w))
        }
        (w, f) if w == f => format!(
            "It has {} (W = {w}), {} of which {} not move the outputs.",
            freedoms(w),
            s.local_mobility,
            if s.local_mobility == 1 { "does" } else { "do" }
        ),
        (w, 0) => format!(
            "W = {w} in this pose only; no finite motion exists. The pose is shaky: small errors appear as play."
        ),
        (w, f) => format!(
            "W = {w} in this pose, but the finite mobility is {f}: the pose is singular or shaky."
        ),
    }
}

/// Returns the result of the search, in one or two sentences.
fn redesigns_sentence(page: &Page<'_>, s: &State<'_>) -> String {
    let r = match &page.redesigns {
        Ok(r) => r,
        Err(why) => return format!("Redesigns were not searched: {why}"),
    };
    let found = r.found;
    let size = found.search.size();
    if size == num_bigint::BigUint::from(1u8) {
        return "Nothing to search: no joint has options. List joint types under [search]."
            .to_owned();
    }
    let least = if found.is_counted() { "" } else { "at least " };
    let by_values: String = numeric::numeric_lines(found)
        .iter()
        .chain(&second_opinion::reasons_against(found))
        .map(|l| format!(". {l}"))
        .collect();
    let (all, good) = (group_thousands(&size), &found.listed_counts().total);
    let request = &found.search.conditions;
    let one = good.is_one();
    let goal = match (request.max_redundant, one) {
        (0, _) if s.found.redundant == 0 => {
            (if one { "is" } else { "are" }).to_owned() + " determinate"
        }
        (0, false) => "remove them all".to_owned(),
        (0, true) => "removes them all".to_owned(),
        (n, false) => format!("leave at most {n}"),
        (n, true) => format!("leaves at most {n}"),
    };
    let conditions = conditions_words(page.mechanism, r, one);
    if good.is_zero() && found.admissible_may_be_more() {
        let may = numeric::admissible_range(found);
        return capitalise_first(&format!(
            "{may} of {all} variants {goal}{conditions}{by_values}."
        ));
    }
    if good.is_zero() {
        let rest = &found.determinate.total;
        return if rest.is_zero() {
            format!("None of the {all} variants {goal}: allow more joint types{by_values}.")
        } else {
            format!(
                "None of the {all} variants {goal}{conditions}; {least}{} {goal}, but do not meet the other conditions{by_values}.",
                group_thousands(rest)
            )
        };
    }
    let estimate = found.estimates()[1].filter(|_| found.is_confirmed());
    let words = match found.numeric {
        Some(_) => numeric::admissible_range(found),
        None => format_count(good, found.is_counted(), estimate),
    };
    let out = format!("{words} of {all} variants {goal}{conditions}");
    let out = capitalise_first(&out) + &by_values;
    if s.found.redundant == 0 && r.variants.iter().any(|c| c.change_count() == 0) {
        return format!("Nothing needs changing. {out}.");
    }
    out + &best_words(r) + "."
}

/// Returns the conditions other than redundant constraints.
fn conditions_words(m: &Mechanism, r: &Redesigns<'_>, one: bool) -> String {
    let s = if one { "s" } else { "" };
    let have = if one { "has" } else { "have" };
    let request = &r.found.search.conditions;
    let outputs = m.links.iter().filter(|l| l.role == Role::Output);
    let outputs = outputs.map(|l| l.id.as_str()).collect_vec();
    let motion = match outputs.len() {
        0 => format!("keep{s} the motion"),
        1 => format!("keep{s} the motion of link {}", outputs[0]),
        _ => format!("keep{s} the motion of links {}", join_and(&outputs)),
    };
    let all = [
        request.keep_output.then(|| motion + where_kept(r.found)),
        request
            .max_mobility
            .map(|w| format!("{have} W at most {w}")),
        request
            .max_changes
            .map(|c| format!("change{s} at most {}", count_noun(c as usize, "joint"))),
    ];
    let all = all.into_iter().flatten();
    let all = all.chain(in_state(&r.found.search, one)).join(", ");
    if all.is_empty() {
        all
    } else {
        format!(" and {all}")
    }
}

/// Returns a description of the best variant.
fn best_words(r: &Redesigns<'_>) -> String {
    let search = &r.found.search;
    let like = |v: &Assignment| match v.key.changes() {
        0 => "changes nothing".to_owned(),
        n => format!(
            "changes {} at cost {}",
            count_noun(n as usize, "joint"),
            format_cost(search.steps.cost_in_milli(v.key.cost()))
        ),
    };
    let cheapest = r.variants.iter().map(Variant::assignment);
    match (&r.found.ranking, r.variants.first()) {
        (Some(p), Some(first)) => {
            let cheapest = p.cheapest.as_ref().map_or(String::new(), |c| {
                format!("; the cheapest that bears them {}", like(&c.variant))
            });
            format!(
                "; the best under the loads {}{cheapest}",
                like(first.assignment())
            )
        }
        (Some(_), None) => "; none of those scored is in equilibrium within the limits".to_owned(),
        (None, _) => cheapest
            .min_by_key(|v| v.key.cost())
            .map_or(String::new(), |v| format!("; the cheapest {}", like(v))),
    }
}
